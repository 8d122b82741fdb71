!> Rows of a table in the order of the whole model: made by the ranks that have the elements, kept
!> by the ranks that write them.
!>
!> Every rank keeps a band of consecutive rows, as long as those of the others. A row to which
!> several ranks add gets their parts in the order of their keys, not of the ranks: the sum is the
!> same for any number of them.
module plydyn_parallel_owner_reduction
   use, intrinsic :: iso_fortran_env, only : int64
   use mpi_f08, only : mpi_alltoall, mpi_alltoallv, mpi_comm_world, mpi_datatype, &
      & mpi_double_precision, mpi_integer, mpi_type_commit, mpi_type_contiguous, mpi_type_free
   use plydyn_base_precision, only : wp
   use plydyn_base_sort, only : sorted_order
   use plydyn_parallel_comm, only : comm_type
   implicit none
   private

   public :: band_of, band_start, new_owner_reduction, starts

   !> How the parts come to their rows; all ranks take part in everything
   type, public :: owner_reduction_type
      !> Rows before the band of this rank, and rows in it
      integer :: first = 0, count = 0
      !> The ranks
      type(comm_type), private :: comm
      !> Parts of this rank by the rank that gets them, and how many each rank gets and sends
      integer, allocatable, private :: sent(:), to(:), from(:)
      !> Parts that come here in the order in which they are added, and the row of each
      integer, allocatable, private :: order(:), row(:)
   contains
      procedure :: sum => sum_parts
      procedure :: take_one
   end type owner_reduction_type

contains

   !> Rows before the band of a rank; all rows for the number of ranks
   pure integer function band_start(rows, rank, ranks) result(first)
      !> Rows of all bands
      integer, intent(in) :: rows
      !> The rank, from 0, and how many there are
      integer, intent(in) :: rank, ranks

      first = int(int(rows, int64)*rank/ranks)
   end function band_start

   !> The rank, from 0, in whose band a row lies
   elemental integer function band_of(row, rows, ranks) result(rank)
      !> The row, from 1
      integer, intent(in) :: row
      !> Rows of all bands, and how many ranks there are
      integer, intent(in) :: rows, ranks

      rank = int((int(row, int64)*ranks - 1)/rows)
   end function band_of

   !> Prepare for parts of rows
   function new_owner_reduction(comm, rows, row, key) result(self)
      type(comm_type), intent(in) :: comm
      !> Rows of the whole table
      integer, intent(in) :: rows
      !> Row of each part that this rank has, from 1, and its key among the parts of the row
      integer, intent(in) :: row(:), key(:)
      type(owner_reduction_type) :: self

      integer :: i, owner(size(row))
      integer, allocatable :: received(:, :)

      self%comm = comm
      self%first = band_start(rows, comm%rank, comm%ranks)
      self%count = band_start(rows, comm%rank + 1, comm%ranks) - self%first
      allocate (self%to(0:comm%ranks - 1), self%from(0:comm%ranks - 1))
      self%to(:) = 0
      do i = 1, size(row)
         owner(i) = band_of(row(i), rows, comm%ranks)
         self%to(owner(i)) = self%to(owner(i)) + 1
      end do
      self%sent = sorted_order(owner)
      self%from(:) = self%to
      if (comm%ranks > 1) call mpi_alltoall(self%to, 1, mpi_integer, self%from, 1, mpi_integer, &
         & mpi_comm_world)
      call exchange_keys(self, row(self%sent), key(self%sent), received)
      self%order = sorted_order(received(2, :))
      self%order(:) = self%order(sorted_order(received(1, self%order)))
      self%row = received(1, self%order) - self%first
   end function new_owner_reduction

   !> Send to the owners which rows they get parts of
   subroutine exchange_keys(self, row, key, received)
      type(owner_reduction_type), intent(in) :: self
      !> Of the parts that are sent, in their order
      integer, intent(in) :: row(:), key(:)
      !> Row and key of the parts that come, (2, parts)
      integer, allocatable, intent(out) :: received(:, :)

      integer :: own(2, size(row))

      own(1, :) = row
      own(2, :) = key
      if (self%comm%ranks == 1) then
         received = own
         return
      end if
      allocate (received(2, sum(self%from)))
      call mpi_alltoallv(own, 2*self%to, 2*starts(self%to), mpi_integer, received, 2*self%from, &
         & 2*starts(self%from), mpi_integer, mpi_comm_world)
   end subroutine exchange_keys

   !> Where each of several runs begins, from 0
   pure function starts(length)
      !> Length of each
      integer, intent(in) :: length(:)
      integer :: starts(size(length))
      integer :: i

      starts(1) = 0
      do i = 2, size(length)
         starts(i) = starts(i - 1) + length(i - 1)
      end do
   end function starts

   !> Exchange the parts: each goes to the owner of its row, in the order in which they are added
   subroutine exchange_parts(self, values, received)
      class(owner_reduction_type), intent(in) :: self
      real(wp), intent(in) :: values(:, :)
      real(wp), allocatable, intent(out) :: received(:, :)

      real(wp), allocatable :: arrived(:, :)
      type(mpi_datatype) :: kind

      if (self%comm%ranks == 1) then
         received = values(:, self%sent(self%order))
         return
      end if
      allocate (arrived(size(values, 1), sum(self%from)))
      call mpi_type_contiguous(size(values, 1), mpi_double_precision, kind)
      call mpi_type_commit(kind)
      call mpi_alltoallv(values(:, self%sent), self%to, starts(self%to), kind, arrived, self%from, &
         & starts(self%from), kind, mpi_comm_world)
      call mpi_type_free(kind)
      received = arrived(:, self%order)
   end subroutine exchange_parts

   !> Add up the parts of each row
   subroutine sum_parts(self, values, sums)
      class(owner_reduction_type), intent(in) :: self
      !> Parts of this rank, (width, parts)
      real(wp), intent(in) :: values(:, :)
      !> Rows of its band, (width, `count`)
      real(wp), intent(out) :: sums(:, :)

      real(wp), allocatable :: received(:, :)
      integer :: i

      call exchange_parts(self, values, received)
      sums(:, :) = 0.0_wp
      do i = 1, size(self%row)
         sums(:, self%row(i)) = sums(:, self%row(i)) + received(:, i)
      end do
   end subroutine sum_parts

   !> Take one part of each row, where all are alike
   subroutine take_one(self, values, taken)
      class(owner_reduction_type), intent(in) :: self
      !> Parts of this rank, (width, parts)
      real(wp), intent(in) :: values(:, :)
      !> Rows of its band, (width, `count`)
      real(wp), intent(out) :: taken(:, :)

      real(wp), allocatable :: received(:, :)

      call exchange_parts(self, values, received)
      taken(:, self%row) = received
   end subroutine take_one

end module plydyn_parallel_owner_reduction
