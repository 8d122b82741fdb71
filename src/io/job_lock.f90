!> Lock of a job: one run at a time writes the results of a job in a folder.
!>
!> The run holds `JOB.lock` with the lock of the operating system (`flock`), which ends with the
!> process, however it ends, so that a killed job leaves nothing to clear away. The file says who
!> holds it. Where the file system knows no locks, that line alone decides: a process of this host
!> that is still there holds the job; one of another host cannot be asked, and the run says so.
module plydyn_io_job_lock
   use, intrinsic :: iso_c_binding, only : c_associated, c_char, c_int, c_loc, c_null_char, &
      & c_null_ptr, c_ptr, c_size_t
   use, intrinsic :: iso_fortran_env, only : int64
   use plydyn_base_error, only : error_type, exit_output, fail
   use plydyn_base_file_identity, only : file_identity_type, identity_of, identity_of_open, &
      & is_same_file
   use plydyn_base_files, only : bytes_of_file, c_fclose, c_fileno, c_fopen, remove_file
   use plydyn_base_text, only : text
   use plydyn_io_csv_text_file, only : close_text, create_text, try_text
   implicit none
   private

   !> The lock of a job, held from `take` to `release`
   type, public :: job_lock_type
      private
      !> The file, and its open stream of C
      character(:), allocatable :: path
      type(c_ptr) :: stream = c_null_ptr
      !> What the user must know of it; empty for nothing
      character(:), allocatable, public :: warning
   contains
      procedure :: take
      procedure :: release
      procedure :: is_held
   end type job_lock_type

   !> Exclusive, and without waiting, as `flock` numbers them
   integer(c_int), parameter :: exclusive = 2, at_once = 4
   !> Number of the error of a lock that another process holds, and of a process that is not there
   integer(c_int), parameter :: would_block = 11, no_such_process = 3
   !> Outcome of an attempt; the file is another one where the run before removed it meanwhile
   integer, parameter :: taken = 0, held = 1, no_locks = 2, removed = 3
   !> Longest line about a holder, and longest name of a host
   integer, parameter :: longest_line = 300, longest_name = 256
   !> How often a file that is removed meanwhile is opened anew
   integer, parameter :: most_attempts = 100

   interface
      integer(c_int) function c_flock(descriptor, operation) bind(c, name="flock")
         import :: c_int
         implicit none
         integer(c_int), value :: descriptor, operation
      end function c_flock

      integer(c_int) function c_getpid() bind(c, name="getpid")
         import :: c_int
         implicit none
      end function c_getpid

      integer(c_int) function c_gethostname(name, length) bind(c, name="gethostname")
         import :: c_char, c_int, c_size_t, longest_name
         implicit none
         character(kind=c_char), intent(inout) :: name(longest_name)
         integer(c_size_t), value :: length
      end function c_gethostname

      integer(c_int) function c_kill(process, signal) bind(c, name="kill")
         import :: c_int
         implicit none
         integer(c_int), value :: process, signal
      end function c_kill

      !> Where the number of the last error of a call stands
      type(c_ptr) function c_errno() bind(c, name="__errno_location")
         import :: c_ptr
         implicit none
      end function c_errno

      type(c_ptr) function c_memcpy(to, from, bytes) bind(c, name="memcpy")
         import :: c_ptr, c_size_t
         implicit none
         type(c_ptr), value :: to, from
         integer(c_size_t), value :: bytes
      end function c_memcpy
   end interface

contains

   !> Take the lock of a job; nothing but `JOB.lock` is touched
   subroutine take(self, job, error)
      class(job_lock_type), intent(inout) :: self
      !> Path of the results without endings; their folder must exist
      character(*), intent(in) :: job
      !> Another run holds it, or the folder cannot be written
      type(error_type), allocatable, intent(out) :: error

      character(:), allocatable :: holder
      integer :: attempt, outcome

      self%path = job//".lock"
      self%warning = ""
      do attempt = 1, most_attempts
         call try_text(self%path, error)
         if (allocated(error)) return
         self%stream = c_fopen(self%path//c_null_char, "a+e"//c_null_char)
         outcome = removed
         if (c_associated(self%stream)) outcome = lock_stream(self)
         if (outcome /= removed) exit
         call close_stream(self)
      end do
      holder = holder_of(self%path)
      if (outcome == no_locks) then
         if (is_here(holder)) outcome = held
         self%warning = "warning: the folder of "//self%path//" has a file system without locks: " &
            & //"two runs of this job on two hosts would mix their results unseen"
         if (len(holder) > 0) self%warning = self%warning//"; the last run there, " &
            & //holder//", has not ended as it should, or it still runs"
      end if
      if (outcome == held .or. outcome == removed) then
         call close_stream(self)
         if (len(holder) == 0) holder = "one that has just begun or ended"
         call fail(error, exit_output, "another run of job "//job//" is active: "//holder//" (" &
            & //self%path//"); its results are as they were. Wait for its end, or give this run " &
            & //"another name, as in -j JOB, or another folder")
         return
      end if
      call write_holder(self)
   end subroutine take

   !> Give the lock back, and remove its file
   subroutine release(self)
      class(job_lock_type), intent(inout) :: self

      if (.not. self%is_held()) return
      call remove_file(self%path)
      call close_stream(self)
   end subroutine release

   !> Whether this process holds the lock
   logical function is_held(self)
      class(job_lock_type), intent(in) :: self

      is_held = c_associated(self%stream)
   end function is_held

   !> Try to lock the open file
   integer function lock_stream(self) result(outcome)
      class(job_lock_type), intent(in) :: self

      integer(c_int) :: descriptor

      descriptor = c_fileno(self%stream)
      if (c_flock(descriptor, ior(exclusive, at_once)) /= 0) then
         outcome = merge(held, no_locks, last_error() == would_block)
         return
      end if
      outcome = merge(taken, removed, is_same_file(identity_of_open(int(descriptor)), &
         & identity_of(self%path, follow=.false.)))
   end function lock_stream

   !> Close the file, which ends the lock
   subroutine close_stream(self)
      class(job_lock_type), intent(inout) :: self

      integer(c_int) :: status

      if (.not. c_associated(self%stream)) return
      status = c_fclose(self%stream)
      self%stream = c_null_ptr
   end subroutine close_stream

   !> Say in the file who holds it; on a full disk it stays empty, and the lock holds all the same
   subroutine write_holder(self)
      class(job_lock_type), intent(in) :: self

      character(8) :: date
      character(10) :: time
      type(error_type), allocatable :: unused
      integer :: unit

      call create_text(self%path, unit, unused)
      if (allocated(unused)) return
      call date_and_time(date, time)
      write (unit, "(a)") "process "//text(int(c_getpid()))//" on "//host()//" since "//date(:4) &
         & //"-"//date(5:6)//"-"//date(7:)//" "//time(:2)//":"//time(3:4)//":"//time(5:6)
      call close_text(self%path, unit, unused)
   end subroutine write_holder

   !> First line of the file, with what can be printed of it; empty when there is none
   function holder_of(path) result(holder)
      !> Path of the file
      character(*), intent(in) :: path
      character(:), allocatable :: holder

      type(file_identity_type) :: identity
      integer :: i

      identity = identity_of(path, follow=.false.)
      holder = bytes_of_file(path, before=0_int64, &
         & count=int(min(identity%length, int(longest_line, int64))))
      do i = 1, len(holder)
         if (holder(i:i) < " " .or. holder(i:i) > "~") exit
      end do
      holder = holder(:i - 1)
   end function holder_of

   !> Whether a holder is a process of this host that is still there
   logical function is_here(holder)
      !> The line of `write_holder`, or anything
      character(*), intent(in) :: holder

      character(longest_name) :: words(4)
      character(:), allocatable :: own
      integer :: process, status

      is_here = .false.
      own = host()
      read (holder, *, iostat=status) words
      if (status /= 0) return
      read (words(2), *, iostat=status) process
      if (status /= 0 .or. words(1) /= "process" .or. words(4) /= own) return
      ! signal 0 only looks
      is_here = c_kill(int(process, c_int), 0_c_int) == 0
      if (.not. is_here) is_here = last_error() /= no_such_process
   end function is_here

   !> Name of this host
   function host() result(name)
      character(:), allocatable :: name

      character(kind=c_char) :: buffer(longest_name)
      integer :: length

      name = "unknown"
      buffer(:) = c_null_char
      if (c_gethostname(buffer, int(longest_name - 1, c_size_t)) /= 0) return
      length = findloc(buffer, c_null_char, 1) - 1
      if (length > 0) name = transfer(buffer(:length), repeat(" ", length))
   end function host

   !> Number of the error of the last call of the operating system
   integer(c_int) function last_error() result(number)
      integer(c_int), target :: copy
      type(c_ptr) :: unused

      unused = c_memcpy(c_loc(copy), c_errno(), int(storage_size(copy)/8, c_size_t))
      number = copy
   end function last_error

end module plydyn_io_job_lock
