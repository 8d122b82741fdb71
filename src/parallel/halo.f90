!> Halo exchange of columns of forces or strains between neighbouring ranks.
!>
!> Each column is contiguous in one array. MPI data types describe the columns of each neighbour, so
!> that messages are sent from the array and received into it without copies.
module plydyn_parallel_halo
   use mpi_f08, only : mpi_comm_world, mpi_datatype, mpi_double_precision, mpi_irecv, mpi_isend, &
      & mpi_request, mpi_statuses_ignore, mpi_testall, mpi_type_commit, &
      & mpi_type_create_indexed_block, mpi_waitall
   use plydyn_base_precision, only : wp
   implicit none
   private

   public :: new_halo

   !> Tag of the messages
   integer, parameter :: tag = 1

   !> Exchange lists of one rank
   type, public :: halo_type
      !> Bytes sent by this rank in one exchange
      integer :: bytes = 0
      !> Ranks that receive columns from this one, and ranks that send columns to it
      integer, allocatable, private :: to(:), from(:)
      !> Data type of the columns of each of these ranks
      type(mpi_datatype), allocatable, private :: sent(:), received(:)
   contains
      procedure :: neighbours
      procedure :: start
      procedure :: progress
      procedure :: finish
   end type halo_type

   !> Pending messages of an exchange
   type, public :: messages_type
      type(mpi_request), allocatable, private :: request(:)
      !> Whether all have been sent and received
      logical, private :: are_done = .true.
   end type messages_type

contains

   !> Build the exchange lists
   function new_halo(ranks, height, sent, received) result(self)
      !> Number of ranks, and length of a column
      integer, intent(in) :: ranks, height
      !> Receiving rank and offset in the array of each column, in the order in which that rank
      !> receives them, (2, columns)
      integer, intent(in) :: sent(:, :)
      !> Sending rank and offset in the array of each column, in the same order, (2, columns)
      integer, intent(in) :: received(:, :)
      type(halo_type) :: self

      self%bytes = size(sent, 2)*height*storage_size(1.0_wp)/8
      call set_types(ranks, height, sent, self%to, self%sent)
      call set_types(ranks, height, received, self%from, self%received)
   end function new_halo

   !> Data types of the messages with each of the other ranks
   subroutine set_types(ranks, height, columns, partner, kind)
      integer, intent(in) :: ranks, height, columns(:, :)
      integer, allocatable, intent(out) :: partner(:)
      type(mpi_datatype), allocatable, intent(out) :: kind(:)

      integer, allocatable :: offset(:)
      integer :: i, r

      partner = pack([(r, r=0, ranks - 1)], [(any(columns(1, :) == r), r=0, ranks - 1)])
      allocate (kind(size(partner)))
      do i = 1, size(partner)
         offset = pack(columns(2, :), columns(1, :) == partner(i))
         call mpi_type_create_indexed_block(size(offset), height, offset, mpi_double_precision, &
            & kind(i))
         call mpi_type_commit(kind(i))
      end do
   end subroutine set_types

   !> Number of neighbouring ranks
   pure integer function neighbours(self)
      class(halo_type), intent(in) :: self

      neighbours = 0
      if (allocated(self%from)) neighbours = size(self%from)
   end function neighbours

   !> Start to send and receive columns (non-blocking)
   subroutine start(self, force, messages)
      class(halo_type), intent(in) :: self
      !> Array of columns; columns that are sent must not change before `finish`
      real(wp), intent(inout), contiguous, asynchronous :: force(:)
      !> Pending messages of an exchange
      type(messages_type), intent(inout) :: messages

      integer :: i

      associate (n => size(self%from))
         if (.not. allocated(messages%request)) allocate (messages%request(n + size(self%to)))
         messages%are_done = .false.
         do i = 1, n
            call mpi_irecv(force, 1, self%received(i), self%from(i), tag, mpi_comm_world, &
               & messages%request(i))
         end do
         do i = 1, size(self%to)
            call mpi_isend(force, 1, self%sent(i), self%to(i), tag, mpi_comm_world, &
               & messages%request(n + i))
         end do
      end associate
   end subroutine start

   !> Progress messages: without calls MPI may not transfer long ones
   subroutine progress(self, force, messages)
      class(halo_type), intent(in) :: self
      !> Array of columns
      real(wp), intent(inout), contiguous, asynchronous :: force(:)
      !> Pending messages of an exchange
      type(messages_type), intent(inout) :: messages

      if (messages%are_done) return
      call mpi_testall(size(messages%request), messages%request, messages%are_done, &
         & mpi_statuses_ignore)
   end subroutine progress

   !> Wait until all columns have been sent and received
   subroutine finish(self, force, messages)
      class(halo_type), intent(in) :: self
      !> Array of columns, complete on return
      real(wp), intent(inout), contiguous, asynchronous :: force(:)
      !> Pending messages of an exchange
      type(messages_type), intent(inout) :: messages

      if (messages%are_done) return
      call mpi_waitall(size(messages%request), messages%request, mpi_statuses_ignore)
      messages%are_done = .true.
   end subroutine finish

end module plydyn_parallel_halo
