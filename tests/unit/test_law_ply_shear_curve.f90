!> Curves of shear: their constants, and what no curve can be.
program test_law_ply_shear_curve
   use plydyn_base_error, only : error_type
   use plydyn_base_precision, only : wp
   use plydyn_law_ply_shear_curve, only : check_curve, new_exponential_curve, new_power_curve, &
      & new_table_curve, shape_exponential, shear_curve_type, table_slopes
   use testing, only : begin, check, check_error, finish
   implicit none

   !> Modulus and strength of the paper's Table 5
   real(wp), parameter :: modulus = 6.0e3_wp, strength = 90.0_wp

   call test_new_exponential_curve()
   call test_check_curve()
   call test_table_slopes()
   call finish()

contains

   !> The strength is reached at the strain asked for
   subroutine test_new_exponential_curve()
      type(shear_curve_type) :: curve

      call begin("new_exponential_curve")
      curve = new_exponential_curve(modulus, strength, 0.05_wp)
      call check(curve%asymptote, 93.84_wp, 5.0e-3_wp, "has the asymptote of another program")
      call check(curve%asymptote*(1.0_wp - exp(-modulus*0.05_wp/curve%asymptote)), strength, &
         & 1.0e-12_wp, "reaches the strength at the strain asked for")
      curve = new_exponential_curve(modulus, strength, 0.0508_wp)
      call check(curve%asymptote, 93.6_wp, 0.05_wp, "the same at 5.08 %")
      curve = new_exponential_curve(modulus, strength, 0.0396_wp)
      call check(curve%asymptote, 99.0_wp, 0.05_wp, "the same at 3.96 %")
      curve = new_exponential_curve(modulus, strength, 1.01_wp*strength/modulus)
      call check(curve%asymptote > 40.0_wp*strength, "is nearly a line just beyond it")
   end subroutine test_new_exponential_curve

   !> Curves that cannot be are refused
   subroutine test_check_curve()
      type(shear_curve_type) :: curve
      type(error_type), allocatable :: error

      call begin("check_curve")
      call check_curve(curve, modulus, strength, error)
      call check(.not. allocated(error), "takes a line")
      call check_curve(new_exponential_curve(modulus, strength, 0.05_wp), modulus, strength, error)
      call check(.not. allocated(error), "takes an exponential that reaches the strength")
      curve%shape = shape_exponential
      curve%asymptote = strength
      call check_curve(curve, modulus, strength, error)
      call check_error(error, "never reaches the strength", "refuses one that does not")
      call check_curve(new_table_curve([0.0_wp], [0.0_wp]), modulus, strength, error)
      call check_error(error, "two points", "refuses a single point")
      call check_curve(new_table_curve([0.01_wp, 0.02_wp], [0.0_wp, 9.0_wp]), modulus, strength, &
         & error)
      call check_error(error, "start at strain 0", "refuses a curve away from the origin")
      call check_curve(new_table_curve([0.0_wp, 0.02_wp, 0.03_wp], [0.0_wp, 80.0_wp, 80.0_wp]), &
         & modulus, strength, error)
      call check_error(error, "point 3", "refuses a curve that does not rise")
      call check_curve(new_table_curve([0.0_wp, 0.01_wp], [0.0_wp, 61.0_wp]), modulus, strength, &
         & error)
      call check_error(error, "more than the modulus", "refuses a slope above the modulus")
      call check_curve(new_power_curve(0.0_wp, 5.0_wp), modulus, strength, error)
      call check_error(error, "Ramberg", "refuses a power curve without a coefficient")
   end subroutine test_check_curve

   !> A slope little above the modulus is the modulus, and the next line leads to its point
   subroutine test_table_slopes()
      call begin("table_slopes")
      call check(table_slopes([0.0_wp, 0.01_wp, 0.02_wp, 0.04_wp], [0.0_wp, 60.3_wp, 80.0_wp, &
         & 90.0_wp], modulus), [6000.0_wp, 2000.0_wp, 500.0_wp], 1.0e-9_wp, "of a table")
   end subroutine test_table_slopes

end program test_law_ply_shear_curve
