!> Stiffness of laminates: closed forms of one material, of one ply off its axes, of two plies.
program test_law_ply_elastic_laminate
   use plydyn_base_precision, only : wp
   use plydyn_law_ply_elastic, only : add_ply_stiffness, elastic_constants_type
   use testing, only : begin, check, finish
   implicit none

   !> A ply of carbon: E1 and E2, nu12, G12, thickness
   real(wp), parameter :: young(2) = [165.0e3_wp, 9.0e3_wp], poisson = 0.34_wp, shear = 5.6e3_wp
   real(wp), parameter :: thick = 0.125_wp
   real(wp) :: a(3, 3), b(3, 3), d(3, 3)

   call one_material()
   call off_axis()
   call all_directions()
   call two_plies()
   call finish()

contains

   !> Plies from the bottom up, the reference plane in the middle
   subroutine stack(e, nu, g, angles)
      real(wp), intent(in) :: e(2), nu, g, angles(:)

      type(elastic_constants_type) :: constants
      integer :: ply
      real(wp) :: bottom

      constants%young(:2) = e
      constants%poisson(1) = nu
      constants%shear(1) = g
      a(:, :) = 0.0_wp
      b(:, :) = 0.0_wp
      d(:, :) = 0.0_wp
      do ply = 1, size(angles)
         bottom = (ply - 1 - 0.5_wp*size(angles))*thick
         call add_ply_stiffness(constants, angles(ply), [bottom, bottom + thick], a, b, d)
      end do
   end subroutine stack

   !> Three plies of steel make a plate of steel, whatever their angles
   subroutine one_material()
      real(wp), parameter :: e = 210.0e3_wp, nu = 0.3_wp, h = 3.0_wp*thick
      real(wp), parameter :: q(9) = e/(1.0_wp - nu**2) &
         & *[1.0_wp, nu, 0.0_wp, nu, 1.0_wp, 0.0_wp, 0.0_wp, 0.0_wp, 0.5_wp*(1.0_wp - nu)]

      call begin("add_ply_stiffness")
      call stack([e, e], nu, e/(2.0_wp*(1.0_wp + nu)), [0.0_wp, 30.0_wp, -77.0_wp])
      call check(reshape(a, [9]), h*q, 1.0e-9_wp, "one material: A is E h/(1 - nu**2)")
      call check(reshape(b, [9]), 0.0_wp*q, 1.0e-9_wp, "one material: no coupling")
      call check(reshape(d, [9]), h**3/12.0_wp*q, 1.0e-9_wp, &
         & "one material: D is E h**3/12/(1 - nu**2)")
   end subroutine one_material

   !> Pulled at 30 degrees to its fibres, with free sides and angles, a ply has the modulus of
   !> 1/E = c**4/E1 + (1/G12 - 2 nu12/E1) s**2 c**2 + s**4/E2
   subroutine off_axis()
      real(wp), parameter :: c2 = 0.75_wp, s2 = 0.25_wp
      real(wp) :: compliance

      call stack(young, poisson, shear, [30.0_wp])
      compliance = c2**2/young(1) + (1.0_wp/shear - 2.0_wp*poisson/young(1))*s2*c2 &
         & + s2**2/young(2)
      call check(free_stiffness(a)/thick, 1.0_wp/compliance, 1.0e-8_wp, "modulus off the fibres")
      call check(free_stiffness(d)*12.0_wp/thick**3, 1.0_wp/compliance, 1.0e-8_wp, &
         & "the same in bending")
      call check(a(1, 3) > 0.0_wp, "fibres to the left of x: stretch comes with positive shear")
   end subroutine off_axis

   !> Force for a unit strain along x where no other force acts
   real(wp) function free_stiffness(stiffness) result(force)
      real(wp), intent(in) :: stiffness(3, 3)

      real(wp) :: rest

      rest = stiffness(2, 2)*stiffness(3, 3) - stiffness(2, 3)**2
      force = stiffness(1, 1) - (stiffness(1, 2)**2*stiffness(3, 3) &
         & - 2.0_wp*stiffness(1, 2)*stiffness(1, 3)*stiffness(2, 3) &
         & + stiffness(1, 3)**2*stiffness(2, 2))/rest
   end function free_stiffness

   !> Plies at 0, 45, -45 and 90 degrees are together alike in all directions
   subroutine all_directions()
      call stack(young, poisson, shear, [0.0_wp, 45.0_wp, -45.0_wp, 90.0_wp])
      call check(a(1, 1), a(2, 2), 1.0e-9_wp, "quasi-isotropic: as stiff along y as along x")
      call check(a(3, 3), 0.5_wp*(a(1, 1) - a(1, 2)), 1.0e-9_wp, &
         & "quasi-isotropic: shear follows")
      call check(a(1:2, 3), [0.0_wp, 0.0_wp], 1.0e-9_wp, "quasi-isotropic: no shear of a pull")
   end subroutine all_directions

   !> A ply along x below one along y
   subroutine two_plies()
      real(wp) :: part

      call stack(young, poisson, shear, [0.0_wp, 90.0_wp])
      part = 1.0_wp/(1.0_wp - poisson**2*young(2)/young(1))
      call check(b(1, 1), part*(young(2) - young(1))*thick**2/2.0_wp, 1.0e-9_wp, &
         & "two plies: stretch comes with bending")
      call check(b(2, 2), -b(1, 1), 1.0e-9_wp, "two plies: the other way across")
      call check([b(1, 2), b(3, 3)], [0.0_wp, 0.0_wp], 1.0e-9_wp, "two plies: in no other way")
   end subroutine two_plies

end program test_law_ply_elastic_laminate
