!> Averages, within a layer, of the strains that drive damage over the Gauss points around each.
!>
!> The points of an average lie in the same layer, at the same height in it, and in the same part.
!> Weights fall from the middle of an ellipse to nothing on its border; they are found once, and add
!> up to one. Neighbours are added in the order of the whole model, those of other ranks among them:
!> the same bits in any run.
module plydyn_element_average
   use plydyn_base_precision, only : lanes, wp
   implicit none
   private

   public :: average_points, row_of

   !> The averages of the layers of a block that have a law
   type, public :: average_type
      !> Plate, batch and block of it
      integer :: plate = 0, batch = 0, block = 0
      !> First history of the batch in the state; rows from one variable to the next, points of the
      !> thickness, points of the plane of a quad, blocks of the batch
      integer :: first_history = 0, pitch = 0, levels = 0, plane = 0, blocks = 0
      !> Strains that are averaged; the history variables of a point's own and of the averages are
      !> those behind these
      integer :: strains = 0, behind_own = 0, behind_mean = 0
      !> Lanes that have the law, and their layers
      logical :: owns(lanes) = .false.
      integer :: layer(lanes) = 0
      !> Place in the lists of the first neighbour of each point of the plane, those of a quad one
      !> after the other; one more at the end
      integer, allocatable :: first(:)
      !> Rows of the history before the first of the own strains of each neighbour at the lowest
      !> height, the point itself among them; their number is a multiple of `neighbours_at_once`
      integer, allocatable :: row(:)
      !> Rows before those that hold the strains of other ranks' points, and nothing else
      integer :: first_ghost = huge(1)
      !> Their shares in the average of each lane, (lanes, neighbours); 0 outside of its ellipse
      real(wp), allocatable :: weight(:, :)
   end type average_type

   !> Neighbours that are added at a time
   integer, parameter, public :: neighbours_at_once = 4
   !> Most strains of a law, and most points of the thickness
   integer, parameter :: most_strains = 4, most_levels = 5

contains

   !> Average over the neighbours of the points of some quads
   pure subroutine average_points(self, quads, history)
      !> The averages
      type(average_type), intent(in) :: self
      !> First and last quad
      integer, intent(in) :: quads(2)
      !> History of the batch: a row for each variable of a point, in the order of
      !> the kernels
      real(wp), intent(inout) :: history(lanes, *)

      real(wp) :: mean(lanes, most_strains, most_levels)
      integer :: i, n

      do i = 1 + self%plane*(quads(1) - 1), self%plane*quads(2)
         mean(:, :, :) = 0.0_wp
         do n = self%first(i), self%first(i + 1) - 1, neighbours_at_once
            call add_shares(self, self%weight(:, n:n + neighbours_at_once - 1), &
               & self%row(n:n + neighbours_at_once - 1), history, mean)
         end do
         call keep_mean(self, row_of(self, i, self%behind_mean + 1), mean, history)
      end do
   end subroutine average_points

   !> Row before that of a variable of a point of the plane, at the lowest point of the thickness
   pure integer function row_of(self, point, variable) result(row)
      !> The averages
      type(average_type), intent(in) :: self
      !> The point, and the variable
      integer, intent(in) :: point, variable

      integer :: quad

      quad = (point - 1)/self%plane
      row = self%levels*(mod(point - 1, self%plane) + self%plane*(self%block - 1 &
         & + self%blocks*quad)) + self%pitch*(variable - 1)
   end function row_of

   !> Add the shares of some neighbours at all heights
   pure subroutine add_shares(self, weight, row, history, mean)
      type(average_type), intent(in) :: self
      real(wp), intent(in) :: weight(lanes, neighbours_at_once)
      !> Rows before their own strains
      integer, intent(in) :: row(neighbours_at_once)
      real(wp), intent(in) :: history(lanes, *)
      real(wp), intent(inout) :: mean(lanes, most_strains, most_levels)

      integer :: k, l, m, pitch(neighbours_at_once), r(neighbours_at_once)

      ! rows from one strain to the next
      pitch(:) = merge(self%levels, self%pitch, row >= self%first_ghost)
      do m = 1, self%levels
         do k = 1, self%strains
            r(:) = row + pitch*(k - 1) + m
            !$omp simd
            do l = 1, lanes
               mean(l, k, m) = mean(l, k, m) &
                  & + (weight(l, 1)*history(l, r(1)) + weight(l, 2)*history(l, r(2))) &
                  & + (weight(l, 3)*history(l, r(3)) + weight(l, 4)*history(l, r(4)))
            end do
         end do
      end do
   end subroutine add_shares

   !> Keep the averages of a point at all heights
   pure subroutine keep_mean(self, row, mean, history)
      type(average_type), intent(in) :: self
      !> Row before the first of its averages at the lowest height
      integer, intent(in) :: row
      real(wp), intent(in) :: mean(lanes, most_strains, most_levels)
      real(wp), intent(inout) :: history(lanes, *)

      integer :: k, m, r

      do m = 1, self%levels
         do k = 1, self%strains
            r = row + self%pitch*(k - 1) + m
            where (self%owns) history(:, r) = mean(:, k, m)
         end do
      end do
   end subroutine keep_mean

end module plydyn_element_average
