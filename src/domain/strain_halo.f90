!> Halo exchange of strains for averages over points on both sides of a rank boundary.
!>
!> What a rank receives lies behind its own histories, in rows like those: for each point of another
!> rank that it averages over, in the order of the whole model, one strain after the other, each at
!> all heights.
module plydyn_domain_strain_halo
   use plydyn_base_precision, only : lanes
   use plydyn_domain_neighbourhood, only : neighbourhood_type
   use plydyn_element_average, only : average_type, row_of
   implicit none
   private

   public :: add_halo

   !> Rows of histories that a rank sends and receives
   type, public :: strain_halo_type
      !> Rank that receives a row, or sends it, and the place of the row in the histories less 1, in
      !> the order of the whole model for each rank, (2, rows)
      integer, allocatable :: sent(:, :), received(:, :)
   end type strain_halo_type

contains

   !> Let an average find its neighbours in the histories, those of other ranks behind
   pure subroutine add_halo(around, point, length, average, strain_halo)
      !> Points of the plane
      type(neighbourhood_type), intent(in) :: around
      !> Neighbours of all points of this rank, as `first` of the average has them
      integer, intent(in) :: point(:)
      !> Length of the histories with what is received so far, and then with this average
      integer, intent(inout) :: length
      !> Has its lists, but for the rows
      type(average_type), intent(inout) :: average
      !> Gets what this average sends and receives
      type(strain_halo_type), intent(inout) :: strain_halo

      integer :: number(size(around%area)), n, own
      integer, allocatable :: ghost(:)

      number(:) = 0
      number(point) = 1
      ghost = pack([(n, n=1, size(number))], number > 0 &
         & .and. around%own_point([(n, n=1, size(number))]) == 0)
      number(ghost) = [(n, n=1, size(ghost))]
      average%first_ghost = (length - average%first_history + 1)/lanes
      allocate (average%row(size(point)))
      do n = 1, size(point)
         own = around%own_point(point(n))
         if (own > 0) then
            average%row(n) = row_of(average, own, average%behind_own + 1)
         else
            average%row(n) = ghost_row(average, number(point(n)))
         end if
      end do
      strain_halo%received = reshape([strain_halo%received, (strain_places(average, &
         & ghost_row(average, n), average%levels, around%rank_of(ghost(n))), n=1, size(ghost))], &
         & [2, size(strain_halo%received, 2) + average%strains*average%levels*size(ghost)])
      call find_sent(around, point, ghost, average, strain_halo)
      length = length + lanes*average%strains*average%levels*size(ghost)
   end subroutine add_halo

   !> Row before the strains of a point of another rank
   pure integer function ghost_row(average, number) result(row)
      type(average_type), intent(in) :: average
      !> How many such points there are, with it
      integer, intent(in) :: number

      row = average%first_ghost + average%strains*average%levels*(number - 1)
   end function ghost_row

   !> A rank sends what another one receives: if a point is averaged over its neighbour, so is the
   !> neighbour over the point
   pure subroutine find_sent(around, point, ghost, average, strain_halo)
      type(neighbourhood_type), intent(in) :: around
      !> Neighbours of all points of this rank, and those of other ranks among them, each once
      integer, intent(in) :: point(:), ghost(:)
      type(average_type), intent(in) :: average
      type(strain_halo_type), intent(inout) :: strain_halo

      logical :: is_met(0:maxval([0, around%rank]))
      integer, allocatable :: sent(:)
      integer :: i, n, r

      is_met(:) = .false.
      is_met(around%rank_of(ghost)) = .true.
      do r = 0, size(is_met) - 1
         if (.not. is_met(r)) cycle
         sent = pack([(i, i=1, size(average%first) - 1)], [(any(around%rank_of( &
            & point(average%first(i):average%first(i + 1) - 1)) == r), &
            & i=1, size(average%first) - 1)])
         strain_halo%sent = reshape([strain_halo%sent, (strain_places(average, row_of(average, &
            & sent(n), average%behind_own + 1), average%pitch, r), n=1, size(sent))], &
            & [2, size(strain_halo%sent, 2) + average%strains*average%levels*size(sent)])
      end do
   end subroutine find_sent

   !> A rank, and the places of the strains of a point less 1, (2, strains at all heights)
   pure function strain_places(average, row, pitch, rank) result(places)
      type(average_type), intent(in) :: average
      !> Row before the first at the lowest height, rows from strain to strain, and the rank
      integer, intent(in) :: row, pitch, rank
      integer :: places(2, average%strains*average%levels)
      integer :: k, m

      places(1, :) = rank
      places(2, :) = [((average%first_history - 1 + lanes*(row + pitch*(k - 1) + m - 1), &
         & m=1, average%levels), k=1, average%strains)]
   end function strain_places

end module plydyn_domain_strain_halo
