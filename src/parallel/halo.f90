!> Columns of numbers that ranks send each other where they meet: of forces, or of strains.
!>
!> Columns lie in one array, each in one piece; they are sent from their place and received into it,
!> without any copy.
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

   !> What one rank exchanges with the others
   type, public :: halo_type
      !> Bytes that this rank sends in a step
      integer :: bytes = 0
      !> Ranks that get columns from here, and those that send some
      integer, allocatable, private :: to(:), from(:)
      !> Where the columns are, one for each of these ranks
      type(mpi_datatype), allocatable, private :: sent(:), received(:)
   contains
      procedure :: is_empty
      procedure :: neighbours
      procedure :: start
      procedure :: push_on
      procedure :: finish
   end type halo_type

   !> Messages on their way
   type, public :: messages_type
      type(mpi_request), allocatable, private :: request(:)
      !> Whether all have come and gone
      logical, private :: are_done = .true.
   end type messages_type

contains

   !> What is to be exchanged
   function new_halo(ranks, height, sent, received) result(self)
      !> How many ranks there are
      integer, intent(in) :: ranks
      !> Length of a column
      integer, intent(in) :: height
      !> Rank that gets a column, and the first place of the column in the array less 1, in the
      !> order in which that rank expects them, (2, columns)
      integer, intent(in) :: sent(:, :)
      !> Rank that sends a column, and where it goes, in the same order, (2, columns)
      integer, intent(in) :: received(:, :)
      type(halo_type) :: self

      self%bytes = size(sent, 2)*height*storage_size(1.0_wp)/8
      call set_types(ranks, height, sent, self%to, self%sent)
      call set_types(ranks, height, received, self%from, self%received)
   end function new_halo

   !> A type of messages for each of the other ranks
   subroutine set_types(ranks, height, columns, partner, kind)
      integer, intent(in) :: ranks, height, columns(:, :)
      integer, allocatable, intent(out) :: partner(:)
      type(mpi_datatype), allocatable, intent(out) :: kind(:)

      integer, allocatable :: place(:)
      integer :: i, r

      partner = pack([(r, r=0, ranks - 1)], [(any(columns(1, :) == r), r=0, ranks - 1)])
      allocate (kind(size(partner)))
      do i = 1, size(partner)
         place = pack(columns(2, :), columns(1, :) == partner(i))
         call mpi_type_create_indexed_block(size(place), height, place, mpi_double_precision, &
            & kind(i))
         call mpi_type_commit(kind(i))
      end do
   end subroutine set_types

   !> Whether there is nothing to exchange
   pure logical function is_empty(self)
      class(halo_type), intent(in) :: self

      is_empty = .true.
      if (allocated(self%from)) is_empty = size(self%from) == 0
   end function is_empty

   !> How many ranks this one meets
   pure integer function neighbours(self)
      class(halo_type), intent(in) :: self

      neighbours = 0
      if (allocated(self%from)) neighbours = size(self%from)
   end function neighbours

   !> Send this rank's columns, and begin to wait for those of the others
   subroutine start(self, force, messages)
      class(halo_type), intent(in) :: self
      !> The forces; what is sent must stay as it is until `finish`
      real(wp), intent(inout), contiguous, asynchronous :: force(:)
      !> Messages on their way
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

   !> Let messages get on: without a call now and then MPI may leave long ones where they are
   subroutine push_on(self, force, messages)
      class(halo_type), intent(in) :: self
      !> The forces
      real(wp), intent(inout), contiguous, asynchronous :: force(:)
      !> Messages on their way
      type(messages_type), intent(inout) :: messages

      if (messages%are_done) return
      call mpi_testall(size(messages%request), messages%request, messages%are_done, &
         & mpi_statuses_ignore)
   end subroutine push_on

   !> Wait until all columns have come and gone
   subroutine finish(self, force, messages)
      class(halo_type), intent(in) :: self
      !> The forces, with the columns of the other ranks
      real(wp), intent(inout), contiguous, asynchronous :: force(:)
      !> Messages on their way
      type(messages_type), intent(inout) :: messages

      if (messages%are_done) return
      call mpi_waitall(size(messages%request), messages%request, mpi_statuses_ignore)
      messages%are_done = .true.
   end subroutine finish

end module plydyn_parallel_halo
