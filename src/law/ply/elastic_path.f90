!> Points of plies at which no damage begins or grows: most points, most of the time.
!>
!> Where none is damaged and all are far from onset, a few columns of their history tell so. Where
!> some are, all points are taken through the law as it is without growth. Neither changes the
!> history, but for that of shear while it grows. Everything else is left to the whole law, which
!> finds the history as it was.
module plydyn_law_ply_elastic_path
   use plydyn_base_precision, only : lanes, wp
   use plydyn_law_ply_history, only : give, largest_band
   use plydyn_law_ply_batch_constants, only : ply_batch_constants_type
   use plydyn_law_ply_shear_path, only : bend, keep_shear, most_points, shear_type
   use plydyn_law_ply_no_growth_path, only : hold
   implicit none
   private

   public :: stay

   !> Below this, with room for round-off, the sums of points far from onset are below 1
   real(wp), parameter :: near = 0.99_wp

contains

   !> Stress of points at which no lane begins to be damaged in a step, or is more than before
   pure subroutine stay(ply, points, pitch, strain, history, stress, quiet)
      !> Constants
      type(ply_batch_constants_type), intent(in) :: ply
      !> Number of points, `most_points` at most; rows of the history from one of their variables to
      !> the next
      integer, intent(in) :: points, pitch
      !> Total strain
      real(wp), intent(in) :: strain(lanes, 6, points)
      !> History from the first of the points on; changes only at points that are quiet
      real(wp), intent(inout) :: history(lanes, pitch, *)
      !> Stress of the lanes that the law owns; means nothing at points that are not quiet
      real(wp), intent(inout) :: stress(lanes, 6, points)
      !> Which points are quiet
      logical, intent(out) :: quiet(points)

      real(wp) :: all_lanes(lanes, 6, most_points)
      type(shear_type) :: shear
      integer :: m

      call bend(ply, points, pitch, strain, history, shear)
      if (ply%whole) then
         call find_stress(ply, points, pitch, strain, history, shear, stress, quiet)
      else
         call find_stress(ply, points, pitch, strain, history, shear, all_lanes, quiet)
         do m = 1, points
            call give(ply%own, 6, all_lanes(:, :, m), stress(:, :, m))
         end do
      end if
      if (.not. shear%grows) return
      do m = 1, points
         if (quiet(m)) call keep_shear(ply, m, pitch, shear, history)
      end do
   end subroutine stay

   !> Stress of all lanes: where nothing is damaged or near to it, or else
   pure subroutine find_stress(ply, points, pitch, strain, history, shear, stress, quiet)
      type(ply_batch_constants_type), intent(in) :: ply
      integer, intent(in) :: points, pitch
      real(wp), intent(in) :: strain(lanes, 6, points), history(lanes, pitch, *)
      !> What the step makes of the shear; gets the work that damage spares
      type(shear_type), intent(inout) :: shear
      real(wp), intent(out) :: stress(lanes, 6, points)
      logical, intent(out) :: quiet(points)

      logical :: far

      far = .not. shear%begun
      if (far) call resist(ply, points, pitch, strain, history, shear%set, stress, far)
      quiet(:) = far
      if (.not. far) call hold(ply, points, pitch, strain, history, shear, stress, quiet)
   end subroutine find_stress

   !> Stress of intact plies, and whether all points are so far from onset that little is needed to
   !> see it
   pure subroutine resist(ply, points, pitch, strain, history, set, stress, far)
      type(ply_batch_constants_type), intent(in) :: ply
      integer, intent(in) :: points, pitch
      real(wp), intent(in) :: strain(lanes, 6, points), history(lanes, pitch, *)
      !> Shear strain that stays
      real(wp), intent(in) :: set(lanes, most_points)
      real(wp), intent(out) :: stress(lanes, 6, points)
      !> All are
      logical, intent(out) :: far

      real(wp) :: across, along, each(lanes), elastic, most, s11, s22, tau
      integer :: l, m

      each(:) = 0.0_wp
      do m = 1, points
         associate (c => ply%secant%intact, g => ply%secant%shear, e => strain(:, :, m), &
            & a => ply%onset%far_fibre, b => ply%onset%far_matrix, s => stress(:, :, m), &
            & h => history(:, 1, largest_band))
            !$omp simd private(across, along, elastic, s11, s22, tau)
            do l = 1, lanes
               elastic = max(abs(e(l, 4)) - set(l, m), 0.0_wp)
               tau = g(l, 1)*elastic
               s11 = c(l, 1)*e(l, 1) + c(l, 2)*e(l, 2) + c(l, 3)*e(l, 3)
               s22 = c(l, 2)*e(l, 1) + c(l, 4)*e(l, 2) + c(l, 5)*e(l, 3)
               along = a(l, 1)*s11**2 + h(l)*(a(l, 2)*s11**2 + a(l, 3)*abs(s11*e(l, 1)))
               across = b(l, 1)*s22**2 + b(l, 2)*tau**2 + h(l)*(b(l, 3)*s22**2 &
                  & + b(l, 4)*(abs(s22*e(l, 2)) + tau*elastic))
               each(l) = max(each(l), along, across)
               s(l, 1) = s11
               s(l, 2) = s22
               s(l, 3) = c(l, 3)*e(l, 1) + c(l, 5)*e(l, 2) + c(l, 6)*e(l, 3)
               s(l, 4) = sign(tau, e(l, 4))
               s(l, 5) = g(l, 2)*e(l, 5)
               s(l, 6) = g(l, 3)*e(l, 6)
            end do
         end associate
      end do
      most = 0.0_wp
      !$omp simd reduction(max:most)
      do l = 1, lanes
         most = max(most, each(l))
      end do
      far = most <= near
   end subroutine resist

end module plydyn_law_ply_elastic_path
