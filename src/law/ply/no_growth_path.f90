!> Points of plies that are damaged, or near to it, through a step in which no damage begins or
!> grows: the whole law without its growth.
!>
!> One point after the other, all stages of it: the linker can make one routine of them, which keeps
!> most of what they hand on in registers.
module plydyn_law_ply_no_growth_path
   use plydyn_base_precision, only : lanes, wp
   use plydyn_law_ply_history, only : fibre_damage, fibre_gate, matrix_damage, matrix_gate
   use plydyn_law_ply_batch_constants, only : ply_batch_constants_type
   use plydyn_law_ply_shear_path, only : most_points, shear_type, spare_work
   implicit none
   private

   public :: hold, take_intact

contains

   !> Stress of the points, and which of them are steady; where cracks close, those without damage
   pure subroutine hold(ply, points, pitch, strain, history, shear, stress, steady)
      !> Constants
      type(ply_batch_constants_type), intent(in) :: ply
      !> Number of points, `most_points` at most; rows of the history from one of their variables to
      !> the next
      integer, intent(in) :: points, pitch
      !> Total strain
      real(wp), intent(in) :: strain(lanes, 6, points)
      !> History from the first of the points on
      real(wp), intent(in) :: history(lanes, pitch, *)
      !> What the step makes of the shear; gets the work that damage spares
      type(shear_type), intent(inout) :: shear
      !> Stress; means nothing at points that are not steady, and in lanes of other laws
      real(wp), intent(out) :: stress(lanes, 6, points)
      !> Where no damage begins or grows
      logical, intent(out) :: steady(points)

      real(wp) :: busy(lanes, most_points), each(lanes), remains(lanes, 2, most_points)
      integer :: m

      each(:) = 0.0_wp
      do m = 1, points
         call hold_point(ply, strain(:, :, m), shear%set(:, m), &
            & history(:, m, fibre_damage), history(:, m, matrix_damage), &
            & history(:, m, fibre_gate), history(:, m, matrix_gate), &
            & remains(:, :, m), stress(:, :, m), busy(:, m))
         each(:) = max(each, busy(:, m))
      end do
      steady(:) = .not. highest(each) > 0.0_wp
      if (.not. steady(1)) then
         do m = 1, points
            steady(m) = .not. highest(busy(:, m)) > 0.0_wp
         end do
      end if
      if (shear%grows .and. shear%begun) then
         call spare_work(ply, points, pitch, history, remains, shear)
      end if
   end subroutine hold

   !> Stress of a point, and in which lanes damage begins or grows
   pure subroutine hold_point(ply, e, set, d1, d2, gate1, gate2, remains, s, busy)
      type(ply_batch_constants_type), intent(in) :: ply
      !> Total strain, and shear strain that stays
      real(wp), intent(in) :: e(lanes, 6), set(lanes)
      !> Damage of fibres and of matrix, and what its next growth depends on
      real(wp), intent(in) :: d1(lanes), d2(lanes), gate1(lanes), gate2(lanes)
      !> What remains of the stiffness along and across the fibres
      real(wp), intent(out) :: remains(lanes, 2)
      !> Stress
      real(wp), intent(out) :: s(lanes, 6)
      !> More than 0 where damage begins or grows
      real(wp), intent(out) :: busy(lanes)

      real(wp) :: drive(lanes, 2), excess(lanes, 2), normal(lanes, 3)
      real(wp) :: shear(lanes, 2), trial(lanes, 3)

      call prepare(ply, e, set, d1, d2, remains, shear, drive)
      call ply%secant%damaged_stress(e, remains, normal)
      trial(:, :) = normal
      if (ply%any_intact) call take_intact(ply, e, trial)
      call ply%onset%find_onset(trial, e, shear, gate1, gate2, excess)
      call judge(ply, gate1, gate2, drive, excess, busy)
      call give_stress(ply, e, remains, shear(:, 1), normal, s)
   end subroutine hold_point

   !> What remains, and the strains of the modes
   pure subroutine prepare(ply, e, set, d1, d2, remains, shear, drive)
      type(ply_batch_constants_type), intent(in) :: ply
      real(wp), intent(in) :: e(lanes, 6), set(lanes), d1(lanes), d2(lanes)
      real(wp), intent(out) :: remains(lanes, 2)
      !> Sizes of the shear stress 12 before damage and of the elastic shear strain
      real(wp), intent(out) :: shear(lanes, 2)
      !> Squares of the strains that drive the damage of fibres and of matrix
      real(wp), intent(out) :: drive(lanes, 2)

      real(wp) :: elastic
      integer :: l

      !$omp simd private(elastic)
      do l = 1, lanes
         remains(l, 1) = max(1.0_wp - ply%own(l)*d1(l), ply%residual(l))
         remains(l, 2) = max(1.0_wp - ply%own(l)*d2(l), ply%residual(l))
         elastic = max(abs(e(l, 4)) - set(l), 0.0_wp)
         shear(l, 2) = elastic
         shear(l, 1) = ply%secant%shear(l, 1)*elastic
         drive(l, 1) = e(l, 1)**2
         drive(l, 2) = e(l, 2)**2 + elastic**2
      end do
   end subroutine prepare

   !> Take the stresses of an intact ply where onset is by them. Where tension and compression have
   !> damage of their own, those of the sign of the stress that acts: another one's would begin
   pure subroutine take_intact(ply, e, trial)
      !> Constants
      type(ply_batch_constants_type), intent(in) :: ply
      !> Strains 11, 22, 33
      real(wp), intent(in) :: e(lanes, 3)
      !> Normal stresses on what remains in, of the intact ply out where they count
      real(wp), intent(inout) :: trial(lanes, 3)

      real(wp) :: intact(lanes, 3), kept, other
      integer :: k, l

      call ply%secant%intact_stress(e, intact)
      do k = 1, 3
         !$omp simd private(kept, other)
         do l = 1, lanes
            kept = trial(l, k)
            other = intact(l, k)
            trial(l, k) = merge(other, kept, ply%intact(l) > 0.0_wp &
               & .and. (ply%closes(l) <= 0.0_wp .or. other*kept > 0.0_wp))
         end do
      end do
   end subroutine take_intact

   !> Where damage begins or grows: what has begun grows beyond its strain, what has not begins from
   !> an excess of 0 on; where cracks close, what has begun may
   pure subroutine judge(ply, gate1, gate2, drive, excess, busy)
      type(ply_batch_constants_type), intent(in) :: ply
      real(wp), intent(in) :: gate1(lanes), gate2(lanes), drive(lanes, 2), excess(lanes, 2)
      real(wp), intent(out) :: busy(lanes)

      real(wp) :: across, along, fibre, matrix
      integer :: l

      !$omp simd private(along, across, fibre, matrix)
      do l = 1, lanes
         fibre = gate1(l)
         matrix = gate2(l)
         along = excess(l, 1) + tiny(along)
         along = merge(drive(l, 1) + fibre, along, fibre < 0.0_wp)
         across = excess(l, 2) + tiny(across)
         across = merge(drive(l, 2) + matrix, across, matrix < 0.0_wp)
         busy(l) = ply%own(l)*max(along, across)
      end do
      if (.not. ply%any_closes) return
      !$omp simd
      do l = 1, lanes
         busy(l) = max(busy(l), -ply%own(l)*ply%closes(l)*min(gate1(l), gate2(l)))
      end do
   end subroutine judge

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

   !> Stress of what remains
   pure subroutine give_stress(ply, e, remains, shear, normal, s)
      type(ply_batch_constants_type), intent(in) :: ply
      !> Size of the shear stress 12 before damage
      real(wp), intent(in) :: e(lanes, 6), remains(lanes, 2), shear(lanes), normal(lanes, 3)
      real(wp), intent(out) :: s(lanes, 6)

      real(wp) :: r1, r2
      integer :: l

      associate (firm => ply%firm, weak => ply%weak)
         !$omp simd private(r1, r2)
         do l = 1, lanes
            r1 = remains(l, 1)
            r2 = remains(l, 2)
            s(l, 1) = r1*normal(l, 1)
            s(l, 2) = r2*normal(l, 2)
            s(l, 3) = normal(l, 3)
            s(l, 4) = r1*r2*sign(shear(l), e(l, 4))
            s(l, 5) = (firm(l, 1) + r1*weak(l, 1))*e(l, 5)
            s(l, 6) = (firm(l, 2) + r2*weak(l, 2))*e(l, 6)
         end do
      end associate
   end subroutine give_stress

end module plydyn_law_ply_no_growth_path
