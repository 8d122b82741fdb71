!> How slowly a prescribed motion loads a plate along its plane, measured by waves.
!>
!> A bar of the length L and the wave speed c whose end has moved by d and moves at the speed v, all
!> other points in proportion, has the kinetic energy (v L / c d)^2 / 3 over the internal one.
module plydyn_domain_loading_rate
   use plydyn_base_matrix, only : invert
   use plydyn_base_precision, only : wp
   use plydyn_domain_sheet, only : sheet_of, sheet_type
   use plydyn_model_curve, only : curve_type
   use plydyn_model_model, only : model_type
   use plydyn_model_support, only : motion_type, prescribes_acceleration, prescribes_velocity
   implicit none
   private

   public :: find_loading_rate

   real(wp), parameter :: pi = acos(-1.0_wp)
   !> Intervals between the instants at which a motion is looked at
   integer, parameter :: intervals = 1000
   !> Share of the time with the loads after which `*CONTROL_QUASI_STATIC` compares energies
   real(wp), parameter :: start_share = 0.1_wp

   !> Loading by the motion along x or y with the largest speed
   type, public :: loading_rate_type
      !> Its index in `model%motions`; 0 where there is none, and nothing else is set
      integer :: motion = 0
      !> Length of the mesh along the motion; speed and time of a wave along it
      real(wp) :: length = 0.0_wp, wave_speed = 0.0_wp, wave_time = 0.0_wp
      !> Time over which the points move; their largest speed, and the stress behind its wave
      real(wp) :: loading_time = 0.0_wp, speed = 0.0_wp, wave_stress = 0.0_wp
      !> Largest kinetic energy over the internal one, after a tenth of the time
      real(wp) :: kinetic_share = 0.0_wp
      !> First period of a plate in bending, simply supported on all edges; 0 for bricks
      real(wp) :: period = 0.0_wp
   end type loading_rate_type

contains

   !> Find the motion, and measure it
   subroutine find_loading_rate(model, mass_ratio, rate)
      type(model_type), intent(in) :: model
      !> Mass with added mass over that without
      real(wp), intent(in) :: mass_ratio
      type(loading_rate_type), intent(out) :: rate

      type(sheet_type) :: sheet
      real(wp) :: flexibility(3, 3), modulus, size_of(2), unused
      integer :: axis, m, p

      do m = 1, size(model%motions)
         call take_faster(model, m, rate)
      end do
      if (rate%motion == 0) return
      axis = model%motions(rate%motion)%direction
      size_of(:) = maxval(model%mesh%position(:2, :), dim=2) &
         & - minval(model%mesh%position(:2, :), dim=2)
      rate%length = size_of(axis)
      rate%wave_speed = huge(1.0_wp)
      do p = 1, size(model%parts)
         sheet = sheet_of(model, p)
         sheet%mass = mass_ratio*sheet%mass
         call invert(sheet%a, flexibility, unused)
         modulus = 1.0_wp/(sheet%thickness*flexibility(axis, axis))
         rate%wave_speed = min(rate%wave_speed, sqrt(modulus*sheet%thickness/sheet%mass))
         rate%wave_stress = max(rate%wave_stress, rate%speed*sqrt(modulus*sheet%mass &
            & /sheet%thickness))
         if (sheet%bends) rate%period = max(rate%period, period_of(sheet, size_of))
      end do
      rate%wave_time = rate%length/rate%wave_speed
      ! until here the largest of (v/d)^2/3
      rate%kinetic_share = rate%kinetic_share*rate%wave_time**2
   end subroutine find_loading_rate

   !> Take a motion when it is faster than the one so far
   subroutine take_faster(model, m, rate)
      type(model_type), intent(in) :: model
      !> Index of the motion
      integer, intent(in) :: m
      type(loading_rate_type), intent(inout) :: rate

      real(wp) :: displacement, first, from, last, speed, squares, step, time, times(2), top
      integer :: i

      associate (motion => model%motions(m), curve => model%curves(model%motions(m)%curve))
         if (motion%direction > 2 .or. motion%quantity == prescribes_acceleration) return
         times(:) = times_of(motion, curve)
         first = max(motion%birth, times(1))
         last = min(motion%death, times(2), model%control%end_time)
         if (last <= first) return
         step = (last - first)/intervals
         from = first + start_share*(model%control%end_time - first)
         top = 0.0_wp
         squares = 0.0_wp
         displacement = 0.0_wp
         do i = 1, intervals - 1
            time = first + i*step
            if (motion%quantity == prescribes_velocity) then
               speed = motion%scale*curve%at(time)
               displacement = displacement + 0.5_wp*step*motion%scale*(curve%at(time) &
                  & + curve%at(time - step))
            else
               speed = motion%scale*(curve%at(time + step) - curve%at(time - step))/(2.0_wp*step)
               displacement = motion%scale*(curve%at(time) - curve%at(first))
            end if
            top = max(top, abs(speed))
            if (time < from - 0.01_wp*step .or. abs(displacement) <= 0.0_wp) cycle
            squares = max(squares, (speed/displacement)**2)
         end do
      end associate
      if (top <= rate%speed) return
      rate%motion = m
      rate%speed = top
      rate%loading_time = last - first
      rate%kinetic_share = squares/3.0_wp
   end subroutine take_faster

   !> Times at which a motion begins and ends: never, where a velocity stays
   pure function times_of(motion, curve) result(times)
      type(motion_type), intent(in) :: motion
      type(curve_type), intent(in) :: curve
      real(wp) :: times(2)

      logical :: moves(size(curve%x) - 1)

      associate (x => curve%x, y => curve%y, last => size(curve%x))
         times(:) = [x(last), x(1)]
         if (motion%quantity == prescribes_velocity) then
            moves(:) = max(abs(y(:last - 1)), abs(y(2:))) > 0.0_wp
            if (abs(y(last)) > 0.0_wp) times(2) = huge(1.0_wp)
         else
            moves(:) = abs(y(2:) - y(:last - 1)) > 0.0_wp
         end if
         if (.not. any(moves)) return
         times(1) = x(findloc(moves, .true., 1))
         times(2) = max(times(2), x(findloc(moves, .true., 1, back=.true.) + 1))
      end associate
   end function times_of

   !> First period of a rectangle, simply supported on all edges, without its coupling of bending
   !> and twisting
   pure real(wp) function period_of(sheet, size_of) result(period)
      type(sheet_type), intent(in) :: sheet
      !> Lengths along x and y
      real(wp), intent(in) :: size_of(2)

      associate (x => size_of(1)**2, y => size_of(2)**2, d => sheet%d)
         period = 2.0_wp/pi*sqrt(sheet%mass/(d(1, 1)/x**2 + 2.0_wp*(d(1, 2) &
            & + 2.0_wp*d(3, 3))/(x*y) + d(2, 2)/y**2))
      end associate
   end function period_of

end module plydyn_domain_loading_rate
