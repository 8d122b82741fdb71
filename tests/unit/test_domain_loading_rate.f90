!> Waves and kinetic energy of a motion along the plane.
program test_domain_loading_rate
   use plydyn_base_precision, only : wp
   use plydyn_domain_loading_rate, only : find_loading_rate, loading_rate_type
   use plydyn_law_ply_elastic, only : add_ply_stiffness
   use plydyn_model_curve, only : curve_type
   use plydyn_model_model, only : model_type
   use plydyn_model_support, only : motion_type, prescribes_acceleration, prescribes_displacement, &
      & prescribes_velocity
   use sample, only : rectangle_mesh, rectangle_model
   use testing, only : begin, check, finish
   implicit none

   !> Lengths of the plate, thickness of a ply, end of the run
   real(wp), parameter :: length = 6.0_wp, width = 2.0_wp, thickness = 0.25_wp, end_time = 1.0e-4_wp
   !> Round-off
   real(wp), parameter :: digits = 1.0e-12_wp
   type(model_type) :: model
   type(loading_rate_type) :: rate

   model = rectangle_model(rectangle_mesh(3, 3, 2, length, width, 0.0_wp), &
      & [0.0_wp, 90.0_wp], thickness, [1, 1])
   model%curves = [curve_type(id=1, x=[0.0_wp, end_time], y=[0.0_wp, 1.0_wp]), &
      & curve_type(id=2, x=[0.0_wp, 0.25_wp*end_time, 0.75_wp*end_time, end_time], &
      & y=[0.0_wp, 0.0_wp, 1.0_wp, 1.0_wp]), curve_type(id=3, x=[0.0_wp], y=[1.0_wp])]
   call none()
   call growing()
   call partial()
   call velocity()
   call finish()

contains

   !> Nothing moves along the plane
   subroutine none()
      call begin("no loading along the plane")
      call find_loading_rate(model, 1.0_wp, rate)
      call check(rate%motion == 0, "without motions")
      model%motions = [new_motion(3, prescribes_displacement, 1, 1.0_wp), &
         & new_motion(1, prescribes_acceleration, 1, 1.0_wp), &
         & new_motion(1, prescribes_displacement, 3, 1.0_wp)]
      call find_loading_rate(model, 1.0_wp, rate)
      call check(rate%motion == 0, "across it, by an acceleration, or at rest")
   end subroutine none

   !> A displacement that grows steadily; the fastest of several
   subroutine growing()
      real(wp) :: modulus, density

      call begin("steady displacement")
      model%motions = [new_motion(2, prescribes_displacement, 1, 0.1_wp), &
         & new_motion(1, prescribes_displacement, 1, -0.3_wp)]
      call find_loading_rate(model, 1.0_wp, rate)
      modulus = stiffness_along_x()
      density = model%materials(1)%density
      call check(rate%motion == 2, "the fastest motion counts")
      call check(rate%speed, 0.3_wp/end_time, digits*rate%speed, "its speed")
      call check(rate%length, length, digits, "the plate along it")
      call check(rate%wave_speed, sqrt(modulus/density), digits*rate%wave_speed, "sqrt(E/rho)")
      call check(rate%wave_time, length/rate%wave_speed, digits*rate%wave_time, "L/c")
      call check(rate%wave_stress, density*rate%wave_speed*rate%speed, digits*rate%wave_stress, &
         & "rho c v")
      call check(rate%loading_time, end_time, digits*end_time, "all the time")
      call check(rate%kinetic_share, (10.0_wp*rate%wave_time/end_time)**2/3.0_wp, &
         & 1.0e-9_wp*rate%kinetic_share, "(L/c t)^2/3 at a tenth of it")
      call find_loading_rate(model, 4.0_wp, rate)
      call check(rate%wave_speed, 0.5_wp*sqrt(modulus/density), digits*rate%wave_speed, &
         & "four times the mass, half the speed")
   end subroutine growing

   !> A curve that rests before and after
   subroutine partial()
      call begin("rest before and after")
      model%motions = [new_motion(1, prescribes_displacement, 2, 0.3_wp)]
      call find_loading_rate(model, 1.0_wp, rate)
      call check(rate%loading_time, 0.5_wp*end_time, digits*end_time, "is no loading time")
      call check(rate%speed, 0.6_wp/end_time, 1.0e-9_wp*rate%speed, "the speed between")
      model%motions(1)%death = 0.5_wp*end_time
      call find_loading_rate(model, 1.0_wp, rate)
      call check(rate%loading_time, 0.25_wp*end_time, digits*end_time, "nor time after its death")
   end subroutine partial

   !> A velocity that stays
   subroutine velocity()
      call begin("velocity")
      model%motions = [new_motion(1, prescribes_velocity, 3, 100.0_wp)]
      call find_loading_rate(model, 1.0_wp, rate)
      call check(rate%loading_time, end_time, digits*end_time, "until the run ends")
      call check(rate%speed, 100.0_wp, digits*100.0_wp, "as given")
      call check(rate%kinetic_share, (10.0_wp*rate%wave_time/end_time)**2/3.0_wp, &
         & 1.0e-9_wp*rate%kinetic_share, "its integral is the displacement")
   end subroutine velocity

   !> A motion
   pure function new_motion(direction, quantity, curve, scale) result(motion)
      integer, intent(in) :: direction, quantity, curve
      real(wp), intent(in) :: scale
      type(motion_type) :: motion

      motion%nodes = [1]
      motion%direction = direction
      motion%quantity = quantity
      motion%curve = curve
      motion%scale = scale
   end function new_motion

   !> Modulus of the plies, free to become wider: both angles have no coupling with shear
   real(wp) function stiffness_along_x() result(modulus)
      real(wp) :: a(3, 3), b(3, 3), d(3, 3)

      a(:, :) = 0.0_wp
      b(:, :) = 0.0_wp
      d(:, :) = 0.0_wp
      associate (law => model%materials(1)%law)
         call add_ply_stiffness(law, 0.0_wp, [0.0_wp, thickness], a, b, d)
         call add_ply_stiffness(law, 90.0_wp, [0.0_wp, thickness], a, b, d)
      end associate
      modulus = (a(1, 1) - a(1, 2)**2/a(2, 2))/(2.0_wp*thickness)
   end function stiffness_along_x

end program test_domain_loading_rate
