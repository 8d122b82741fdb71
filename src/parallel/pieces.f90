!> Arrays of the whole model on the root, of which every rank has pieces.
module plydyn_parallel_pieces
   use mpi_f08, only : mpi_comm_world, mpi_datatype, mpi_double_precision, mpi_integer, mpi_irecv, &
      & mpi_isend, mpi_recv, mpi_request, mpi_send, mpi_status_ignore, mpi_statuses_ignore, &
      & mpi_type_commit, mpi_type_indexed, mpi_waitall
   use plydyn_base_precision, only : wp
   use plydyn_parallel_comm, only : comm_type
   implicit none
   private

   public :: new_pieces

   !> Tags of lists and of values
   integer, parameter :: list_tag = 2, value_tag = 3
   integer, parameter :: root = 0

   !> The pieces of an array
   type, public :: pieces_type
      private
      !> Where they are here
      type(mpi_datatype) :: here
      !> Where those of each rank are in the array of the whole model; on the root only
      type(mpi_datatype), allocatable :: there(:)
   contains
      procedure :: gather
      procedure :: scatter
   end type pieces_type

contains

   !> Say which pieces this rank has; all ranks must come here
   function new_pieces(comm, piece) result(self)
      !> The ranks
      type(comm_type), intent(in) :: comm
      !> First place here, first place in the whole model and length of each piece, (3, pieces)
      integer, intent(in) :: piece(:, :)
      type(pieces_type) :: self

      integer, allocatable :: list(:, :)
      integer :: count(1), r

      self%here = piece_type(piece(1, :), piece(3, :))
      if (.not. comm%is_root()) then
         count(1) = size(piece, 2)
         list = piece
         call mpi_send(count, 1, mpi_integer, root, list_tag, mpi_comm_world)
         call mpi_send(list, size(list), mpi_integer, root, list_tag, mpi_comm_world)
         return
      end if
      allocate (self%there(0:comm%ranks - 1))
      self%there(0) = piece_type(piece(2, :), piece(3, :))
      do r = 1, comm%ranks - 1
         call mpi_recv(count, 1, mpi_integer, r, list_tag, mpi_comm_world, mpi_status_ignore)
         if (allocated(list)) deallocate (list)
         allocate (list(3, count(1)))
         call mpi_recv(list, size(list), mpi_integer, r, list_tag, mpi_comm_world, &
            & mpi_status_ignore)
         self%there(r) = piece_type(list(2, :), list(3, :))
      end do
   end function new_pieces

   !> Type of messages from or to some pieces of an array
   function piece_type(first, length) result(kind)
      integer, intent(in) :: first(:), length(:)
      type(mpi_datatype) :: kind

      call mpi_type_indexed(size(first), length, first - 1, mpi_double_precision, kind)
      call mpi_type_commit(kind)
   end function piece_type

   !> Bring the pieces of all ranks to the root
   subroutine gather(self, values, whole)
      class(pieces_type), intent(in) :: self
      !> The array of this rank
      real(wp), intent(in), contiguous, asynchronous :: values(:)
      !> That of the whole model, on the root
      real(wp), intent(inout), contiguous, asynchronous :: whole(:)

      type(mpi_request), allocatable :: request(:)
      integer :: r

      allocate (request(0:0))
      if (allocated(self%there)) then
         deallocate (request)
         allocate (request(0:size(self%there)))
         do r = 0, size(self%there) - 1
            call mpi_irecv(whole, 1, self%there(r), r, value_tag, mpi_comm_world, request(r + 1))
         end do
      end if
      call mpi_isend(values, 1, self%here, root, value_tag, mpi_comm_world, request(0))
      call mpi_waitall(size(request), request, mpi_statuses_ignore)
   end subroutine gather

   !> Take the pieces of this rank from the root
   subroutine scatter(self, whole, values)
      class(pieces_type), intent(in) :: self
      !> The array of the whole model, on the root
      real(wp), intent(in), contiguous, asynchronous :: whole(:)
      !> That of this rank
      real(wp), intent(inout), contiguous, asynchronous :: values(:)

      type(mpi_request), allocatable :: request(:)
      integer :: r

      allocate (request(0:0))
      if (allocated(self%there)) then
         deallocate (request)
         allocate (request(0:size(self%there)))
         do r = 0, size(self%there) - 1
            call mpi_isend(whole, 1, self%there(r), r, value_tag, mpi_comm_world, request(r + 1))
         end do
      end if
      call mpi_irecv(values, 1, self%here, root, value_tag, mpi_comm_world, request(0))
      call mpi_waitall(size(request), request, mpi_statuses_ignore)
   end subroutine scatter

end module plydyn_parallel_pieces
