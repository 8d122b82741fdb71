!> How far the files of a job have been written: where a restart goes on with each of them.
module plydyn_state_file_positions
   use, intrinsic :: iso_fortran_env, only : int64
   use plydyn_base_precision, only : wp
   implicit none
   private

   !> Longest ending of a file
   integer, parameter :: ending_length = 64

   !> How far a file has been written
   type, public :: file_position_type
      !> Path of the file without that of the job, as in `.energy.csv`
      character(ending_length) :: ending = ""
      !> Bytes of a text, or states of a file of fields; negative for a file that is not known
      integer(int64) :: amount = -1_int64
      !> Time between two entries, and the multiple of it that comes next
      real(wp) :: interval = 0.0_wp
      integer(int64) :: next = -1_int64
   end type file_position_type

   !> Places of all files of a job; none for a job that begins
   type, public :: file_positions_type
      !> Path of the results without endings
      character(:), allocatable :: job
      !> The places
      type(file_position_type), allocatable :: list(:)
   contains
      procedure :: at
      procedure :: add
   end type file_positions_type

   public :: new_file_positions

contains

   !> No places yet
   pure function new_file_positions(job) result(self)
      !> Path of the results without endings
      character(*), intent(in) :: job
      type(file_positions_type) :: self

      self%job = job
      allocate (self%list(0))
   end function new_file_positions

   !> Place in a file; its amount is negative when the file is not known
   pure function at(self, path) result(place)
      class(file_positions_type), intent(in) :: self
      !> Path of the file
      character(*), intent(in) :: path
      type(file_position_type) :: place

      integer :: i

      do i = 1, size(self%list)
         if (self%job//trim(self%list(i)%ending) == path) place = self%list(i)
      end do
   end function at

   !> Note how far a file has been written
   pure subroutine add(self, path, place)
      class(file_positions_type), intent(inout) :: self
      !> Path of the file, which begins with that of the results
      character(*), intent(in) :: path
      !> Amount and instants
      type(file_position_type), intent(in) :: place

      self%list = [self%list, place]
      self%list(size(self%list))%ending = path(len(self%job) + 1:)
   end subroutine add

end module plydyn_state_file_positions
