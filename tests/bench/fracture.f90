!> A line of points of eight plies with planes of fracture, in states that cost different work.
module plydyn_bench_fracture
   use fracture_point, only : fracture_ply
   use plydyn_bench_paths, only : line_points
   use plydyn_base_precision, only : lanes, wp
   use plydyn_law_ply_fracture_constants, only : fracture_constants_type
   use plydyn_law_ply_shear_curve, only : new_hardening_curve, new_power_curve
   use plydyn_law_ply_fracture_fracture, only : ply_fracture_type
   use plydyn_law_ply_fracture_history, only : crushed, histories, plane_cosine, plane_sine, &
      & plastic_shear
   implicit none
   private

   public :: prepare_fracture, update_fracture

   !> States: far from onset; torn open, below the strain reached; torn and sheared under pressure,
   !> also on debris and without friction
   integer, parameter, public :: intact = 1, opened = 2, closed = 3, on_debris = 4, smooth = 5
   !> And without cracks: below the permanent shear reached, far from onset and close to it, where
   !> the plane of fracture is looked for; permanent shear that grows, with linear hardening and on
   !> a power curve; crushing that grows
   integer, parameter, public :: sheared = 6, near_onset = 7, hardens = 8, on_curve = 9, &
      & crushes = 10
   !> Strain across the fibres far from onset, and at which cracks have been torn
   real(wp), parameter :: far_from_onset = 1.0e-3_wp, torn = 1.0e-2_wp
   !> Pressure and shear strain on closed cracks
   real(wp), parameter :: pressed = -1.0e-3_wp, slid = 4.0e-3_wp
   !> Yield stress and shear strain beyond it, so far below onset that no plane is looked for;
   !> permanent strain on a power curve at the strength
   real(wp), parameter :: hardening = 0.05_wp, first_yield = 30.0_wp, yielding = 1.0e-2_wp
   real(wp), parameter :: of_curve = 3.0e-2_wp, power = 5.9_wp
   !> Shear strain close to onset
   real(wp), parameter :: close_to_onset = 3.0e-2_wp
   !> Strain through the thickness that crushes at a pressure
   real(wp), parameter :: squeezed = -1.0e-2_wp, crush_stress = 50.0_wp
   !> Largest opening strain and share of the opening that debris holds
   real(wp), parameter :: debris(2) = [5.0e-3_wp, 0.2_wp]
   !> Growth of a strain from one update to the next: far above round-off, and little in all updates
   real(wp), parameter :: pace = 1.0e-9_wp
   !> Width of the crack band
   real(wp), parameter :: width = 1.0_wp

   type(ply_fracture_type) :: law
   real(wp) :: strain(lanes, 6, line_points), stress(lanes, 6, line_points)
   real(wp) :: history(lanes, line_points, histories)
   !> Strain that grows, 0 for none, and its growth
   integer :: growing = 0
   real(wp) :: growth = 0.0_wp

contains

   !> Lead the line to a state
   subroutine prepare_fracture(state)
      !> Which
      integer, intent(in) :: state

      type(ply_fracture_type) :: fresh
      real(wp) :: h(lanes, histories), length(lanes, 2)
      integer :: l, m

      law = fresh
      do l = 1, lanes
         call law%set_lane(l, ply_of(state))
      end do
      length(:, :) = width
      h(:, :) = 0.0_wp
      call law%start_history(length, length(:, 1), h)
      do m = 1, line_points
         history(:, m, :) = h
      end do
      stress(:, :, :) = 0.0_wp
      strain(:, :, :) = 0.0_wp
      growing = 0
      select case (state)
      case (intact)
         strain(:, 2, :) = far_from_onset
      case (opened:smooth)
         call tear(state)
      case default
         call deform(state)
      end select
   end subroutine prepare_fracture

   !> The ply of a state
   pure function ply_of(state) result(ply)
      integer, intent(in) :: state
      type(fracture_constants_type) :: ply

      ply = fracture_ply()
      select case (state)
      case (on_debris)
         ply%debris_limit = debris(1)
         ply%debris_share = debris(2)
      case (smooth)
         ply%friction = 0.0_wp
      case (on_curve)
         ply%curve = new_power_curve(ply%shear(1)*of_curve/ply%shear_strength**power, power)
      case (sheared, hardens)
         ply%curve = new_hardening_curve(ply%shear(1), first_yield, hardening)
      case (crushes)
         ply%crush_stress = crush_stress
      case default
         continue
      end select
   end function ply_of

   !> Tear the line, then unload it or press it
   subroutine tear(state)
      integer, intent(in) :: state

      strain(:, 2, :) = torn
      call update_fracture()
      strain(:, 2, :) = merge(0.9_wp*torn, pressed, state == opened)
      if (state /= opened) strain(:, 4, :) = slid
      if (all(abs(history(:, :, plane_cosine)) + abs(history(:, :, plane_sine)) > 0.0_wp)) return
      error stop "a bench of cracks has none"
   end subroutine tear

   !> Shear or crush the line beyond yield, then let the permanent strain stay or grow
   subroutine deform(state)
      integer, intent(in) :: state

      real(wp) :: before
      integer :: kept

      kept = merge(crushed, plastic_shear, state == crushes)
      growing = merge(3, 4, state == crushes)
      growth = merge(-pace, pace, state == crushes)
      strain(:, growing, :) = merge(squeezed, yielding, state == crushes)
      if (state == near_onset) strain(:, growing, :) = close_to_onset
      call update_fracture()
      before = history(1, 1, kept)
      if (any(state == [sheared, near_onset])) then
         growing = 0
         strain(:, 4, :) = 0.99_wp*strain(:, 4, :)
      end if
      call update_fracture()
      if (abs(history(1, 1, kept) - before) > 0.0_wp .neqv. growing > 0) then
         error stop "permanent strain of a bench does not grow, or not stay, as it should"
      end if
      if (any(abs(history(:, :, plane_cosine)) + abs(history(:, :, plane_sine)) > 0.0_wp)) then
         error stop "a bench without cracks has some"
      end if
   end subroutine deform

   !> Update the line
   subroutine update_fracture()
      if (growing > 0) strain(:, growing, :) = strain(:, growing, :) + growth
      call law%update_points(line_points, line_points, 0.0_wp, strain, history, stress)
   end subroutine update_fracture

end module plydyn_bench_fracture
