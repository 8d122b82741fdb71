!> Points of plies that are damaged, or near to it, through a step in which no damage begins or
!> grows: the whole law without its growth, for all points at once.
module plydyn_law_ply_steady
   use plydyn_base_precision, only : lanes, wp
   use plydyn_law_ply_history, only : fibre_damage, fibre_gate, matrix_damage, matrix_gate
   use plydyn_law_ply_lanes, only : ply_lanes_type
   use plydyn_law_ply_shear, only : most_points, shear_type, spare_work
   implicit none
   private

   public :: hold

   !> What the stages of a step hand on, of each point
   type :: stages_type
      !> What remains of the stiffness along and across the fibres
      real(wp) :: remains(lanes, 2, most_points)
      !> Squares of the strains that drive the damage of fibres and of matrix
      real(wp) :: drive(lanes, 2, most_points)
      !> Sizes of the shear stress 12 before damage and of the elastic shear strain
      real(wp) :: shear(lanes, 2, most_points)
      !> Widths of the crack band
      real(wp) :: length(lanes, 2, most_points)
      !> Normal stresses on what remains
      real(wp) :: normal(lanes, 3, most_points)
   end type stages_type

contains

   !> Stress of the points, and which of them are steady; where cracks close, those without damage
   pure subroutine hold(ply, points, histories, strain, history, shear, stress, steady)
      !> Constants
      type(ply_lanes_type), intent(in) :: ply
      !> Number of points, `most_points` at most; history variables of each
      integer, intent(in) :: points, histories
      !> Total strain
      real(wp), intent(in) :: strain(lanes, 6, points)
      !> History
      real(wp), intent(in) :: history(lanes, histories, points)
      !> What the step makes of the shear; gets the work that damage spares
      type(shear_type), intent(inout) :: shear
      !> Stress; means nothing at points that are not steady, and in lanes of other laws
      real(wp), intent(out) :: stress(lanes, 6, points)
      !> Where no damage begins or grows
      logical, intent(out) :: steady(points)

      type(stages_type) :: now

      call prepare(ply, points, histories, strain, history, shear%set, now)
      call ply%secant%damaged_stress(points, 6, strain, now%remains, now%normal)
      call judge(ply, points, histories, strain, history, now, steady)
      call give_stress(ply, points, strain, now, stress)
      if (shear%grows .and. shear%begun) then
         call spare_work(ply, points, histories, history, now%remains, shear)
      end if
   end subroutine hold

   !> What remains, and the strains of the modes
   pure subroutine prepare(ply, points, histories, strain, history, set, now)
      type(ply_lanes_type), intent(in) :: ply
      integer, intent(in) :: points, histories
      real(wp), intent(in) :: strain(lanes, 6, points), history(lanes, histories, points)
      !> Shear strain that stays
      real(wp), intent(in) :: set(lanes, most_points)
      type(stages_type), intent(inout) :: now

      real(wp) :: elastic
      integer :: l, m

      do m = 1, points
         associate (own => ply%own, h => history(:, :, m), e => strain(:, :, m))
            !$omp simd private(elastic)
            do l = 1, lanes
               now%remains(l, 1, m) = max(1.0_wp - own(l)*h(l, fibre_damage), ply%residual(l))
               now%remains(l, 2, m) = max(1.0_wp - own(l)*h(l, matrix_damage), ply%residual(l))
               elastic = max(abs(e(l, 4)) - set(l, m), 0.0_wp)
               now%shear(l, 2, m) = elastic
               now%shear(l, 1, m) = ply%secant%shear(l, 1)*elastic
               now%drive(l, 1, m) = e(l, 1)**2
               now%drive(l, 2, m) = e(l, 2)**2 + elastic**2
               now%length(l, 1, m) = abs(h(l, fibre_gate))
               now%length(l, 2, m) = abs(h(l, matrix_gate))
            end do
         end associate
      end do
   end subroutine prepare

   !> Find the points at which damage neither begins nor grows
   pure subroutine judge(ply, points, histories, strain, history, now, steady)
      type(ply_lanes_type), intent(in) :: ply
      integer, intent(in) :: points, histories
      real(wp), intent(in) :: strain(lanes, 6, points), history(lanes, histories, points)
      type(stages_type), intent(in) :: now
      logical, intent(out) :: steady(points)

      real(wp) :: across, along, excess(lanes, 2, most_points), fibre, matrix, most
      real(wp) :: busy(lanes, most_points), each(lanes), trial(lanes, 3, most_points)
      integer :: l, m

      if (ply%any_intact) then
         call find_trial(ply, points, strain, now%normal, trial)
         call ply%onset%find_onset(points, 6, trial, strain, now%shear, now%length, excess)
      else
         call ply%onset%find_onset(points, 6, now%normal, strain, now%shear, now%length, excess)
      end if
      each(:) = 0.0_wp
      do m = 1, points
         associate (own => ply%own, closes => ply%closes, h => history(:, :, m))
            !$omp simd private(along, across, fibre, matrix)
            do l = 1, lanes
               fibre = h(l, fibre_gate)
               matrix = h(l, matrix_gate)
               ! what has begun grows beyond its strain, what has not begins from 0 on
               along = excess(l, 1, m) + tiny(along)
               along = merge(now%drive(l, 1, m) + fibre, along, fibre < 0.0_wp)
               across = excess(l, 2, m) + tiny(across)
               across = merge(now%drive(l, 2, m) + matrix, across, matrix < 0.0_wp)
               busy(l, m) = own(l)*max(along, across, -closes(l)*min(fibre, matrix))
               each(l) = max(each(l), busy(l, m))
            end do
         end associate
      end do
      most = highest(each)
      steady(:) = .not. most > 0.0_wp
      if (steady(1)) return
      do m = 1, points
         steady(m) = .not. highest(busy(:, m)) > 0.0_wp
      end do
   end subroutine judge

   !> Stresses that onset is by: of what remains, or of the intact ply
   pure subroutine find_trial(ply, points, strain, normal, trial)
      type(ply_lanes_type), intent(in) :: ply
      integer, intent(in) :: points
      real(wp), intent(in) :: strain(lanes, 6, points), normal(lanes, 3, points)
      real(wp), intent(out) :: trial(lanes, 3, points)

      real(wp) :: damaged
      integer :: k, l, m

      call ply%secant%intact_stress(points, 6, strain, trial)
      do m = 1, points
         do k = 1, 2
            !$omp simd private(damaged)
            do l = 1, lanes
               damaged = normal(l, k, m)
               trial(l, k, m) = merge(trial(l, k, m), damaged, ply%intact(l) > 0.0_wp)
            end do
         end do
      end do
   end subroutine find_trial

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
   pure subroutine give_stress(ply, points, strain, now, stress)
      type(ply_lanes_type), intent(in) :: ply
      integer, intent(in) :: points
      real(wp), intent(in) :: strain(lanes, 6, points)
      type(stages_type), intent(in) :: now
      real(wp), intent(out) :: stress(lanes, 6, points)

      real(wp) :: r1, r2
      integer :: l, m

      do m = 1, points
         associate (g => ply%secant%shear, across => ply%across, e => strain(:, :, m), &
            & n => now%normal(:, :, m), s => stress(:, :, m))
            !$omp simd private(r1, r2)
            do l = 1, lanes
               r1 = now%remains(l, 1, m)
               r2 = now%remains(l, 2, m)
               s(l, 1) = r1*n(l, 1)
               s(l, 2) = r2*n(l, 2)
               s(l, 3) = n(l, 3)
               s(l, 4) = r1*r2*sign(now%shear(l, 1, m), e(l, 4))
               s(l, 5) = (1.0_wp - across(l)*(1.0_wp - r1))*g(l, 2)*e(l, 5)
               s(l, 6) = (1.0_wp - across(l)*(1.0_wp - r2))*g(l, 3)*e(l, 6)
            end do
         end associate
      end do
   end subroutine give_stress

end module plydyn_law_ply_steady
