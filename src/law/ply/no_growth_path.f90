!> Fast paths of the ply-damage law, for points at which no damage begins or grows in a step.
!>
!> The elastic path takes intact points that are far from onset, to be seen from a few history
!> variables. The no-growth path takes the others, damaged ones too. Both leave the history as it
!> is, but for that of the shear. Points where damage begins or grows are left to the whole law.
!>
!> While all points are intact the elastic path saves 18 % of a whole step of 192 Q9/LE2, where all
!> are damaged the no-growth path 53 % (tests/bench/paths.py). The stages of the latter are called
!> point by point, so that the compiler inlines them and their results stay in registers.
module plydyn_law_ply_no_growth_path
   use plydyn_base_precision, only : lanes, wp
   use plydyn_law_ply_batch_constants, only : ply_batch_constants_type
   use plydyn_law_ply_closing_path, only : update_closing_point
   use plydyn_law_ply_history, only : fibre_damage, fibre_threshold, has_begun, integrity_of, &
      & largest_band, matrix_damage, matrix_threshold, store_columns, strain_excess
   use plydyn_law_ply_shear_path, only : elastic_shear, find_spared_work, most_points, &
      & shear_type, store_shear, update_shear
   implicit none
   private

   public :: update_undamaged, update_without_growth

   !> Largest sum of the onset criteria of a point that is far from onset; 1 less room for round-off
   real(wp), parameter :: far_limit = 0.99_wp

contains

   !> Stress of the points at which no damage begins or grows
   pure subroutine update_undamaged(ply, points, pitch, strain, history, stress, updated)
      !> As in `update_shear`
      type(ply_batch_constants_type), intent(in) :: ply
      integer, intent(in) :: points, pitch
      real(wp), intent(in) :: strain(lanes, 6, points)
      !> History from the first of the points on; changes only at points that are updated
      real(wp), intent(inout) :: history(lanes, pitch, *)
      !> Stress of the lanes that the law owns; means nothing at points that are not updated
      real(wp), intent(inout) :: stress(lanes, 6, points)
      !> Points that are updated; the others need the whole law
      logical, intent(out) :: updated(points)

      real(wp) :: all_lanes(lanes, 6, most_points)
      type(shear_type) :: shear
      integer :: m

      call update_shear(ply, points, pitch, strain, history, shear)
      if (ply%whole) then
         call update_without_growth(ply, points, pitch, strain, history, shear, stress, updated)
      else
         call update_without_growth(ply, points, pitch, strain, history, shear, all_lanes, updated)
         do m = 1, points
            call store_columns(ply%own, 6, all_lanes(:, :, m), stress(:, :, m))
         end do
      end if
      if (.not. shear%grows) return
      do m = 1, points
         if (updated(m)) call store_shear(ply, m, pitch, shear, history)
      end do
   end subroutine update_undamaged

   !> Stress of intact plies, and whether all points are far from onset. The formula of the normal
   !> stresses is that of `intact_stress`: a call of it makes the kernel 10 % slower
   pure subroutine find_intact_stress(ply, points, pitch, strain, history, set, stress, far)
      type(ply_batch_constants_type), intent(in) :: ply
      integer, intent(in) :: points, pitch
      real(wp), intent(in) :: strain(lanes, 6, points), history(lanes, pitch, *)
      !> Permanent shear strain
      real(wp), intent(in) :: set(lanes, most_points)
      real(wp), intent(out) :: stress(lanes, 6, points)
      !> All points are far from onset
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
               elastic = elastic_shear(e(l, 4), set(l, m))
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
      far = most <= far_limit
   end subroutine find_intact_stress

   !> Stress of all lanes, and at which points no damage begins or grows: by the elastic path if it
   !> takes all points, else by the no-growth path
   pure subroutine update_without_growth(ply, points, pitch, strain, history, shear, stress, &
      & unchanged)
      !> As in `update_shear`
      type(ply_batch_constants_type), intent(in) :: ply
      integer, intent(in) :: points, pitch
      real(wp), intent(in) :: strain(lanes, 6, points)
      !> History from the first of the points on
      real(wp), intent(in) :: history(lanes, pitch, *)
      !> Shear after the step; gets the plastic work that damage spares
      type(shear_type), intent(inout) :: shear
      !> Stress; means nothing at points whose damage grows, and in lanes of other laws
      real(wp), intent(out) :: stress(lanes, 6, points)
      !> No damage begins or grows
      logical, intent(out) :: unchanged(points)

      real(wp) :: each(lanes), growth(lanes, most_points), integrity(lanes, 2, most_points)
      integer :: m
      logical :: far

      if (.not. shear%begun) then
         call find_intact_stress(ply, points, pitch, strain, history, shear%set, stress, far)
         unchanged(:) = far
         if (far) return
      end if
      each(:) = 0.0_wp
      do m = 1, points
         call update_point(ply, pitch, strain(:, :, m), shear%set(:, m), history(1, m, 1), &
            & integrity(:, :, m), stress(:, :, m), growth(:, m))
         each(:) = max(each, growth(:, m))
      end do
      unchanged(:) = .not. highest(each) > 0.0_wp
      if (.not. unchanged(1)) then
         do m = 1, points
            unchanged(m) = .not. highest(growth(:, m)) > 0.0_wp
         end do
      end if
      if (shear%grows .and. shear%begun) then
         call find_spared_work(ply, points, pitch, history, integrity, shear)
      end if
   end subroutine update_without_growth

   !> Stress of a point, and in which lanes damage begins or grows
   pure subroutine update_point(ply, pitch, e, set, history, integrity, s, growth)
      type(ply_batch_constants_type), intent(in) :: ply
      integer, intent(in) :: pitch
      !> Total strain, and permanent shear strain; history from the point on
      real(wp), intent(in) :: e(lanes, 6), set(lanes), history(lanes, pitch, *)
      !> Integrity for shear, along and across the fibres; stress
      real(wp), intent(out) :: integrity(lanes, 2), s(lanes, 6)
      !> More than 0 where damage begins or grows
      real(wp), intent(out) :: growth(lanes)

      real(wp) :: drive(lanes, 2), excess(lanes, 2), shear(lanes, 2)

      associate (fibre => history(:, 1, fibre_threshold), matrix => history(:, 1, matrix_threshold))
         call find_driving_strains(ply, e, set, history(:, 1, fibre_damage), &
            & history(:, 1, matrix_damage), integrity, shear, drive)
         if (ply%any_closes) then
            call update_closing_point(ply, pitch, e, shear, history, integrity, s, growth)
            return
         end if
         call ply%secant%damaged_stress(e, integrity, s)
         call ply%onset%find_onset(s, e, shear, fibre, matrix, excess)
         call detect_growth(ply, fibre, matrix, drive, excess, growth)
         call ply%secant%degrade_stress(e, shear(:, 1), integrity, integrity, s)
      end associate
   end subroutine update_point

   !> Integrity, and the strains that drive damage
   pure subroutine find_driving_strains(ply, e, set, fibre, matrix, integrity, shear, drive)
      type(ply_batch_constants_type), intent(in) :: ply
      real(wp), intent(in) :: e(lanes, 6), set(lanes)
      !> Damage of fibres and of matrix
      real(wp), intent(in) :: fibre(lanes), matrix(lanes)
      real(wp), intent(out) :: integrity(lanes, 2)
      !> Sizes of the shear stress 12 before damage and of the elastic shear strain
      real(wp), intent(out) :: shear(lanes, 2)
      !> Squares of the strains that drive the damage of fibres and of matrix
      real(wp), intent(out) :: drive(lanes, 2)

      real(wp) :: elastic
      integer :: l

      !$omp simd private(elastic)
      do l = 1, lanes
         integrity(l, 1) = integrity_of(ply%own(l)*fibre(l), ply%residual(l))
         integrity(l, 2) = integrity_of(ply%own(l)*matrix(l), ply%residual(l))
         elastic = elastic_shear(e(l, 4), set(l))
         shear(l, 2) = elastic
         shear(l, 1) = ply%secant%shear(l, 1)*elastic
         drive(l, 1) = e(l, 1)**2
         drive(l, 2) = e(l, 2)**2 + elastic**2
      end do
   end subroutine find_driving_strains

   !> Where damage begins or grows: a mode that has begun grows beyond its strain, one that has not
   !> begins from an excess of 0 on
   pure subroutine detect_growth(ply, fibre, matrix, drive, excess, growth)
      type(ply_batch_constants_type), intent(in) :: ply
      !> Growth thresholds of fibres and of matrix
      real(wp), intent(in) :: fibre(lanes), matrix(lanes)
      real(wp), intent(in) :: drive(lanes, 2), excess(lanes, 2)
      real(wp), intent(out) :: growth(lanes)

      real(wp) :: across, along, other, this
      integer :: l

      !$omp simd private(along, across, other, this)
      do l = 1, lanes
         this = fibre(l)
         other = matrix(l)
         along = excess(l, 1) + tiny(along)
         along = merge(strain_excess(drive(l, 1), this), along, has_begun(this))
         across = excess(l, 2) + tiny(across)
         across = merge(strain_excess(drive(l, 2), other), across, has_begun(other))
         growth(l) = ply%own(l)*max(along, across)
      end do
   end subroutine detect_growth

   !> The largest of the lanes
   pure real(wp) function highest(each)
      real(wp), intent(in) :: each(lanes)

      integer :: l

      highest = 0.0_wp
      !$omp simd reduction(max:highest)
      do l = 1, lanes
         highest = max(highest, each(l))
      end do
   end function highest

end module plydyn_law_ply_no_growth_path
