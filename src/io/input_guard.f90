!> Keeps the inputs of a job from its results: no result takes the place of a deck, of a file that
!> a deck includes, or of the restart file.
!>
!> All results of a job begin with its name and end with one of a few endings. An input whose name
!> does both is refused before the first result is created. What has another name is safe: results
!> are never written through a link (`plydyn_io_csv_text_file`).
module plydyn_io_input_guard
   use plydyn_base_error, only : error_type, exit_usage, fail
   use plydyn_base_file_identity, only : identity_of, is_same_file, no_file, real_path
   use plydyn_base_files, only : is_same_path
   use plydyn_io_job, only : job_type
   implicit none
   private

   public :: check_inputs, number_of_dump, spare_restart

   !> What stands behind the last point in the name of a result
   character(6), parameter :: endings(6) = &
      & [character(6) :: "out", "csv", "vtkhdf", "ctl", "read", "lock"]
   !> What stands there for a file that is not whole yet, and for restart files
   character(*), parameter :: unfinished = "part"
   character(6), parameter :: restarts(2) = [character(6) :: "dump", "runrsf"]

contains

   !> Refuse inputs that a result would replace; the root has their names
   subroutine check_inputs(job, restart, error)
      !> The job with its decks
      type(job_type), intent(in) :: job
      !> Path of the restart file, empty for none
      character(*), intent(in) :: restart
      !> Which file would be lost
      type(error_type), allocatable, intent(out) :: error

      integer :: b, d

      do b = 1, size(job%archive%bundles)
         do d = 1, size(job%archive%bundles(b)%documents)
            associate (path => job%archive%bundles(b)%documents(d)%path)
               call check_input(job%path, path, .false., error)
               if (.not. allocated(error)) call check_input(job%path, real_path(path), .false., &
                  & error)
               if (allocated(error)) return
            end associate
         end do
      end do
      if (len(restart) == 0) return
      call check_input(job%path, restart, .true., error)
      if (.not. allocated(error)) call check_input(job%path, real_path(restart), .true., error)
   end subroutine check_inputs

   !> Number the restart files that are kept behind the one that the run goes on from, where that
   !> has the name of one of them
   subroutine spare_restart(restart, job)
      !> Path of the restart file
      character(*), intent(in) :: restart
      !> Gets how many restart files there are
      type(job_type), intent(inout) :: job

      if (is_name_of_result(job%path, restart, with_restarts=.true.)) then
         job%dumps = max(job%dumps, number_of_dump(restart))
      end if
   end subroutine spare_restart

   !> Number of a kept restart file, as its name ends with; 0 for another name
   pure integer function number_of_dump(path) result(number)
      !> Path of the file
      character(*), intent(in) :: path

      integer :: first, status

      number = 0
      first = index(path, ".dump", back=.true.) + len(".dump")
      if (first == len(".dump") .or. verify(path(first:), "0123456789") > 0) return
      read (path(first:), *, iostat=status) number
      if (status /= 0) number = 0
   end function number_of_dump

   !> Refuse an input that a result would replace
   subroutine check_input(job, path, is_restart, error)
      !> Path of the results without endings, and of the input
      character(*), intent(in) :: job, path
      !> Whether the input is a restart file, which newer restart files may replace once they are
      !> whole
      logical, intent(in) :: is_restart
      !> Says which file would be lost
      type(error_type), allocatable, intent(out) :: error

      logical :: is_lost

      ! a deck out of an archive need not be on the disk any more
      associate (identity => identity_of(path, follow=.true.))
         if (identity%kind == no_file) return
         is_lost = is_same_file(identity, identity_of(job//".out", follow=.true.)) .and. is_restart
      end associate
      if (.not. is_lost) is_lost = is_name_of_result(job, path, with_restarts=.not. is_restart)
      if (is_lost) call fail(error, exit_usage, "results of the job would replace its input " &
         & //path//": the job needs another name, as in -j JOB")
   end subroutine check_input

   !> Whether a result of a job may have some path
   logical function is_name_of_result(job, path, with_restarts) result(is_result)
      !> Path of the results without endings, and of a file
      character(*), intent(in) :: job, path
      !> Whether restart files count
      logical, intent(in) :: with_restarts

      character(:), allocatable :: ending
      integer :: digits, i, name, point

      is_result = .false.
      name = index(path, "/", back=.true.) + 1
      associate (own => job(index(job, "/", back=.true.) + 1:)//".")
         if (index(path(name:), own) /= 1) return
         point = name + len(own) - 1
      end associate
      if (.not. is_same_path(path(:point), job//".")) return
      ending = path(index(path, ".", back=.true.) + 1:)
      is_result = any(endings == ending) .or. ending == unfinished
      if (.not. with_restarts) return
      digits = len(ending) - verify(ending, "0123456789", back=.true.)
      do i = 1, size(restarts)
         is_result = is_result .or. ending(:len(ending) - digits) == restarts(i)
      end do
   end function is_name_of_result

end module plydyn_io_input_guard
