!> Fast path of the ply with planes of fracture: points that nothing has happened to, far from
!> onset.
module plydyn_law_ply_fracture_intact_path
   use plydyn_base_precision, only : lanes, wp
   use plydyn_law_ply_fracture_constants, only : fracture_batch_type
   use plydyn_law_ply_fracture_history, only : changed, fibre_width, matrix_width, state, untouched
   use plydyn_law_ply_history, only : store_columns
   implicit none
   private

   public :: update_intact

   !> Square of the largest share of a stress of onset at which a point is far from it: a step takes
   !> no point over the rest
   real(wp), parameter :: far_limit = 0.64_wp

contains

   !> Stress of the points that nothing has happened to and that are far from onset
   pure subroutine update_intact(ply, points, pitch, strain, history, stress, updated)
      type(fracture_batch_type), intent(in) :: ply
      !> Number of points; rows of the history from one of their variables to the next
      integer, intent(in) :: points, pitch
      !> Total strain
      real(wp), intent(in) :: strain(lanes, 6, points)
      !> History from the first of the points on
      real(wp), intent(inout) :: history(lanes, pitch, *)
      !> Stress; means nothing at points that are not updated
      real(wp), intent(inout) :: stress(lanes, 6, points)
      !> Points that are updated; the others need the whole law
      logical, intent(out) :: updated(points)

      real(wp) :: each(lanes), kept, most, past, s(lanes, 6)
      integer :: l, m

      do m = 1, points
         past = untouched
         !$omp simd private(kept) reduction(max:past)
         do l = 1, lanes
            kept = history(l, m, state)
            past = max(past, merge(kept, untouched, ply%own(l) > 0.0_wp))
         end do
         updated(m) = past < changed
         if (.not. updated(m)) cycle
         call find_stress(ply, strain(:, :, m), history(:, m, fibre_width), &
            & history(:, m, matrix_width), s, each)
         most = 0.0_wp
         !$omp simd private(kept) reduction(max:most)
         do l = 1, lanes
            kept = each(l)
            most = max(most, merge(kept, 0.0_wp, ply%own(l) > 0.0_wp))
         end do
         updated(m) = most <= far_limit
         if (.not. updated(m)) cycle
         call store_columns(ply%own, 6, s, stress(:, :, m))
         ! points that have left the neighbourhood of onset keep no stress
         if (past > untouched) call store_columns(ply%own, 1, spread(untouched, 1, lanes), &
            & history(:, m, state))
      end do
   end subroutine update_intact

   !> Stress of an intact ply, and the largest square of its shares of the stresses of onset
   pure subroutine find_stress(ply, e, fibre_band, matrix_band, s, largest)
      type(fracture_batch_type), intent(in) :: ply
      !> Strain; widths of the crack band
      real(wp), intent(in) :: e(lanes, 6), fibre_band(lanes), matrix_band(lanes)
      real(wp), intent(out) :: s(lanes, 6), largest(lanes)

      real(wp) :: across, along, both, fibre, radius, shear
      integer :: l

      associate (c => ply%stiffness, g => ply%shear, a => ply%far_fibre, b => ply%far_matrix, &
         & y => ply%far_yield)
         !$omp simd private(across, along, both, fibre, radius, shear)
         do l = 1, lanes
            s(l, 1) = c(l, 1)*e(l, 1) + c(l, 2)*e(l, 2) + c(l, 3)*e(l, 3)
            s(l, 2) = c(l, 2)*e(l, 1) + c(l, 4)*e(l, 2) + c(l, 5)*e(l, 3)
            s(l, 3) = c(l, 3)*e(l, 1) + c(l, 5)*e(l, 2) + c(l, 6)*e(l, 3)
            s(l, 4) = g(l, 1)*e(l, 4)
            s(l, 5) = g(l, 2)*e(l, 5)
            s(l, 6) = g(l, 3)*e(l, 6)
            fibre = s(l, 1)**2*max(a(l, 1), fibre_band(l)*a(l, 2))
            radius = (0.5_wp*(s(l, 2) - s(l, 3)))**2 + s(l, 6)**2
            across = radius + max(0.5_wp*(s(l, 2) + s(l, 3)) + sqrt(radius), 0.0_wp)**2
            along = s(l, 4)**2 + s(l, 5)**2
            both = max(b(l, 1)*across + b(l, 2)*along, matrix_band(l)*b(l, 3)*(across + along))
            shear = max(y(l, 1)*s(l, 4)**2, y(l, 2)*s(l, 5)**2, y(l, 3)*s(l, 6)**2)
            largest(l) = max(fibre, both, shear, -ply%far_crush(l)*s(l, 3))
         end do
      end associate
   end subroutine find_stress

end module plydyn_law_ply_fracture_intact_path
