!> Arrays of the whole model in bands of consecutive places, one on each rank, of which every rank
!> has segments wherever they lie: from the segments to the bands, and back to all that have them.
!>
!> No rank ever has the whole array. Nothing is copied on the way but into the band and out of it.
module plydyn_parallel_distributed_array
   use mpi_f08, only : mpi_alltoall, mpi_alltoallv, mpi_comm_world, mpi_datatype, &
      & mpi_datatype_null, mpi_double_precision, mpi_integer, mpi_irecv, mpi_isend, mpi_request, &
      & mpi_statuses_ignore, mpi_type_commit, mpi_type_indexed, mpi_waitall, operator(==)
   use plydyn_base_precision, only : wp
   use plydyn_base_sort, only : sorted_order
   use plydyn_parallel_comm, only : comm_type
   use plydyn_parallel_owner_reduction, only : band_of, band_start, starts
   implicit none
   private

   public :: new_distributed_array

   !> Tag of messages
   integer, parameter :: value_tag = 3

   !> The segments of an array
   type, public :: distributed_array_type
      !> Length of the whole array, places before the band of this rank, and places in it
      integer :: whole = 0, first = 0, count = 0
      !> Where segments are here that belong to the band of each rank, and where those of each rank
      !> are in the band of this one; null where there are none. Not allocated with one rank
      type(mpi_datatype), allocatable, private :: here(:), there(:)
   contains
      procedure :: gather
      procedure :: scatter
   end type distributed_array_type

contains

   !> Say which segments this rank has; all ranks must come here
   function new_distributed_array(comm, whole, segment) result(self)
      type(comm_type), intent(in) :: comm
      !> Length of the whole array
      integer, intent(in) :: whole
      !> First place here, first place in the whole model and length of each segment, (3, segments)
      integer, intent(in) :: segment(:, :)
      type(distributed_array_type) :: self

      integer :: from(0:comm%ranks - 1), r, to(0:comm%ranks - 1)
      integer, allocatable :: band(:), got(:, :), own(:, :)

      self%whole = whole
      self%first = band_start(whole, comm%rank, comm%ranks)
      self%count = band_start(whole, comm%rank + 1, comm%ranks) - self%first
      if (comm%ranks == 1) return
      own = cut(joined(segment), whole, comm%ranks)
      band = band_of(own(2, :), whole, comm%ranks)
      own = own(:, sorted_order(band))
      to(:) = [(count(band == r), r=0, comm%ranks - 1)]
      call mpi_alltoall(to, 1, mpi_integer, from, 1, mpi_integer, mpi_comm_world)
      allocate (got(3, sum(from)))
      call mpi_alltoallv(own, 3*to, 3*starts(to), mpi_integer, got, 3*from, 3*starts(from), &
         & mpi_integer, mpi_comm_world)
      call make_types(own(1, :), own(3, :), to, self%here)
      call make_types(got(2, :) - self%first, got(3, :), from, self%there)
   end function new_distributed_array

   !> Make one segment of those that follow each other both here and in the whole model
   pure function joined(segment) result(longer)
      integer, intent(in) :: segment(:, :)
      integer, allocatable :: longer(:, :)

      integer :: i, list(3, size(segment, 2)), n

      n = 0
      do i = 1, size(segment, 2)
         if (n > 0) then
            if (all(list(:2, n) + list(3, n) == segment(:2, i))) then
               list(3, n) = list(3, n) + segment(3, i)
               cycle
            end if
         end if
         n = n + 1
         list(:, n) = segment(:, i)
      end do
      longer = list(:, :n)
   end function joined

   !> Cut segments where bands end
   pure function cut(segment, whole, ranks) result(parts)
      integer, intent(in) :: segment(:, :), whole, ranks
      integer, allocatable :: parts(:, :)

      integer :: before, i, length, n

      ! bands that the first and the last place of a segment lie in, and those between
      allocate (parts(3, sum(1 + band_of(segment(2, :) + segment(3, :) - 1, whole, ranks) &
         & - band_of(segment(2, :), whole, ranks))))
      n = 0
      do i = 1, size(segment, 2)
         before = 0
         do while (before < segment(3, i))
            associate (place => segment(2, i) + before)
               length = min(segment(3, i) - before, 1 - place &
                  & + band_start(whole, 1 + band_of(place, whole, ranks), ranks))
               n = n + 1
               parts(:, n) = [segment(1, i) + before, place, length]
            end associate
            before = before + length
         end do
      end do
   end function cut

   !> Make types of messages from or to some segments of an array, one for each rank
   subroutine make_types(first, length, segments, kind)
      !> First place and length of each segment, rank by rank
      integer, intent(in) :: first(:), length(:)
      !> Segments for each rank
      integer, intent(in) :: segments(0:)
      type(mpi_datatype), allocatable, intent(out) :: kind(:)

      integer :: before, r

      allocate (kind(0:size(segments) - 1))
      before = 0
      do r = 0, size(segments) - 1
         kind(r) = mpi_datatype_null
         if (segments(r) == 0) cycle
         call mpi_type_indexed(segments(r), length(before + 1:), first(before + 1:) - 1, &
            & mpi_double_precision, kind(r))
         call mpi_type_commit(kind(r))
         before = before + segments(r)
      end do
   end subroutine make_types

   !> Gather the segments of all ranks into the bands; all ranks of several must come here
   subroutine gather(self, values, band)
      class(distributed_array_type), intent(in) :: self
      !> The array of this rank
      real(wp), intent(in), contiguous, asynchronous :: values(:)
      !> Its band, (`count`); places that no rank has stay as they are
      real(wp), intent(inout), contiguous, asynchronous :: band(:)

      call exchange(values, self%here, band, self%there)
   end subroutine gather

   !> Take the segments of this rank from the bands; all ranks of several must come here
   subroutine scatter(self, band, values)
      class(distributed_array_type), intent(in) :: self
      !> The band of this rank, (`count`)
      real(wp), intent(in), contiguous, asynchronous :: band(:)
      !> Its array
      real(wp), intent(inout), contiguous, asynchronous :: values(:)

      call exchange(band, self%there, values, self%here)
   end subroutine scatter

   !> Send numbers to other ranks and to this one, and receive from them
   subroutine exchange(sent, to, received, from)
      real(wp), intent(in), contiguous, asynchronous :: sent(:)
      !> What each rank gets of them, and where what it sends goes
      type(mpi_datatype), intent(in) :: to(0:), from(0:)
      real(wp), intent(inout), contiguous, asynchronous :: received(:)

      type(mpi_request) :: request(2*size(to))
      integer :: n, r

      n = 0
      do r = 0, size(from) - 1
         if (from(r) == mpi_datatype_null) cycle
         n = n + 1
         call mpi_irecv(received, 1, from(r), r, value_tag, mpi_comm_world, request(n))
      end do
      do r = 0, size(to) - 1
         if (to(r) == mpi_datatype_null) cycle
         n = n + 1
         call mpi_isend(sent, 1, to(r), r, value_tag, mpi_comm_world, request(n))
      end do
      call mpi_waitall(n, request, mpi_statuses_ignore)
   end subroutine exchange

end module plydyn_parallel_distributed_array
