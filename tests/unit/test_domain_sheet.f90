!> Stiffness and mass of plates and of bricks over their area, and the period of a beam.
program test_domain_sheet
   use plydyn_base_precision, only : wp
   use plydyn_domain_sheet, only : beam_period, sheet_of, sheet_type
   use plydyn_law_ply_elastic, only : elastic_constants_type
   use plydyn_model_model, only : model_type
   use sample, only : rectangle_mesh, rectangle_model
   use testing, only : begin, check, finish
   implicit none

   real(wp), parameter :: pi = acos(-1.0_wp), digits = 1.0e-12_wp
   !> Lengths of the plate, thickness of a ply; aluminium
   real(wp), parameter :: length = 6.0_wp, width = 2.0_wp, thickness = 0.25_wp
   real(wp), parameter :: young = 70.0e3_wp, poisson = 0.3_wp, density = 2.7e-9_wp
   !> Stiffness of plane stress
   real(wp), parameter :: plane = young/(1.0_wp - poisson**2)
   type(model_type) :: model
   type(sheet_type) :: sheet
   real(wp) :: rigidity

   model = rectangle_model(rectangle_mesh(2, 3, 2, length, width, 0.0_wp), [0.0_wp, 30.0_wp], &
      & thickness, [1, 1])
   model%materials(1)%density = density
   deallocate (model%materials(1)%law)
   allocate (model%materials(1)%law, source=elastic_constants_type(young=spread(young, 1, 3), &
      & poisson=spread(poisson, 1, 3), shear=spread(young/(2.0_wp*(1.0_wp + poisson)), 1, 3)))

   call begin("sheet of a plate")
   sheet = sheet_of(model, 1)
   rigidity = plane*(2.0_wp*thickness)**3/12.0_wp
   call check(sheet%bends, "bends")
   call check(sheet%thickness, 2.0_wp*thickness, digits, "thickness")
   call check(sheet%mass/(density*2.0_wp*thickness), 1.0_wp, digits, "mass per area")
   call check(sheet%a(1, 1)/(plane*2.0_wp*thickness), 1.0_wp, digits, "stiffness along")
   call check(sheet%a(1, 2)/sheet%a(1, 1), poisson, digits, "and across")
   call check(sheet%d(2, 2)/rigidity, 1.0_wp, digits, "in bending, about the mid-plane")

   call begin("beam_period")
   ! a beam on two supports twice as long as the plate: 2 L**2/pi sqrt(m/D)
   call check(beam_period(model)/(2.0_wp*(2.0_wp*length)**2/pi &
      & *sqrt(density*2.0_wp*thickness/rigidity)), 1.0_wp, digits, "of the longer side")

   call begin("sheet of bricks")
   model%parts(1)%brick%points = 8
   model%mesh%brick_part = [1, 2, 1, 1]
   model%mesh%brick_angle = spread(0.0_wp, 1, 4)
   sheet = sheet_of(model, 1)
   call check(.not. sheet%bends, "does not bend")
   call check(sheet%thickness, 3.0_wp, digits, "has the thickness of so many units")
   call check(sheet%a(1, 1)/sheet%thickness, plane, digits*plane, "stiffness of one")
   call check(sheet%mass/sheet%thickness, density, digits*density, "mass of one")
   call check(beam_period(model), 0.0_wp, 0.0_wp, "and no period")
   call finish()
end program test_domain_sheet
