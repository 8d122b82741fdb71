!> Broadcast of the data of a job that goes on from the root to the ranks that write its files.
module plydyn_io_checkpoint_broadcast_job
   use, intrinsic :: iso_fortran_env, only : int64
   use plydyn_base_precision, only : wp
   use plydyn_io_job, only : job_type
   use plydyn_state_file_positions, only : new_file_positions, file_position_type, &
      & file_positions_type
   use plydyn_parallel_comm, only : comm_type
   implicit none
   private

   public :: broadcast_job, broadcast_file_positions

   !> Numbers of a place
   integer, parameter :: numbers = 3

contains

   !> Let all ranks have the names of the job, its count of restart files, and the places in its
   !> files
   subroutine broadcast_job(comm, job)
      !> The ranks
      type(comm_type), intent(in) :: comm
      !> The root's in, the same on all ranks out
      type(job_type), intent(inout) :: job

      integer :: dumps(1)

      call comm%broadcast(job%path)
      call comm%broadcast(job%deck)
      call comm%broadcast(job%version)
      dumps(1) = job%dumps
      call comm%broadcast(dumps)
      job%dumps = dumps(1)
      call broadcast_file_positions(comm, job%path, job%places)
   end subroutine broadcast_job

   !> Let all ranks have the places
   subroutine broadcast_file_positions(comm, path, places)
      !> The ranks
      type(comm_type), intent(in) :: comm
      !> Path of the results without endings
      character(*), intent(in) :: path
      !> The root's in, the same on all ranks out
      type(file_positions_type), intent(inout) :: places

      character(:), allocatable :: ending
      type(file_position_type) :: place
      real(wp) :: table(numbers)
      integer :: count(1), i

      if (comm%ranks == 1) return
      count(1) = size(places%list)
      call comm%broadcast(count)
      if (.not. comm%is_root()) places = new_file_positions(path)
      do i = 1, count(1)
         if (comm%is_root()) then
            place = places%list(i)
            ending = trim(place%ending)
            table(:) = [real(place%amount, wp), place%interval, real(place%next, wp)]
         end if
         call comm%broadcast(ending)
         call comm%broadcast(table)
         if (comm%is_root()) cycle
         call places%add(path//ending, file_position_type(amount=nint(table(1), int64), &
            & interval=table(2), next=nint(table(3), int64)))
      end do
   end subroutine broadcast_file_positions

end module plydyn_io_checkpoint_broadcast_job
