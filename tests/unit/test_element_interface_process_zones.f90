!> Zones that soften have the lengths of closed forms, the worst of the interfaces of a material.
program test_domain_process_zones
   use plydyn_base_precision, only : wp
   use plydyn_element_interface_process_zones, only : new_process_zone, process_zone_type
   use plydyn_law_cohesive_bilinear, only : cohesive_constants_type, normal, shear
   use plydyn_model_layup, only : faces_tied
   use plydyn_model_material, only : interface_material_type
   use plydyn_model_model, only : model_type
   use sample, only : rectangle_mesh, rectangle_model
   use testing, only : begin, check, finish
   implicit none

   real(wp), parameter :: pi = acos(-1.0_wp), across = 9000.0_wp, along = 165.0e3_wp
   type(model_type) :: model
   type(process_zone_type) :: zone

   ! quads of 2 by 1 mm: 1 mm between nodes; four plies of 0.25 mm, the upper interface is tied
   model = rectangle_model(rectangle_mesh(3, 3, 2, 6.0_wp, 2.0_wp, 0.0_wp), &
      & [0.0_wp, 90.0_wp, 0.0_wp, 90.0_wp], 0.25_wp, [2, 2, 2, 2])
   model%parts(1)%joint(:) = [1, 1, faces_tied]
   model%interface_materials = [interface_material_type(id=6, title="bond", fails=.true., &
      & constants=cohesive_constants_type(stiffness=[1.3733e6_wp, 4.933e5_wp], &
      & strength=[62.3_wp, 92.3_wp], toughness=[0.28_wp, 0.79_wp], exponent=1.45_wp))]

   call begin("new_process_zone")
   zone = new_process_zone(model, 1)
   call check(zone%interfaces, 2, "counts its interfaces")
   call check(zone%spacing, 1.0_wp, 1.0e-12_wp, "the largest distance between nodes")
   call check(zone%thickness, 0.25_wp, 1.0e-12_wp, "the ply below is the thinnest stack")
   call check(zone%across, across, 0.0_wp, "modulus across")
   call check(zone%strength, [62.3_wp, 92.3_wp], 0.0_wp, "strengths as given")
   call check(zone%length(normal), min(9.0_wp*pi/32.0_wp*across*0.28_wp/62.3_wp**2, &
      & (along*0.28_wp*0.25_wp**3/62.3_wp**2)**0.25_wp), 1.0e-12_wp, "zone of opening")
   call check(zone%length(shear), min(9.0_wp*pi/32.0_wp*across*0.79_wp/92.3_wp**2, &
      & sqrt(along*0.79_wp*0.25_wp)/92.3_wp), 1.0e-12_wp, "zone of sliding")

   call begin("strengths fitted to the mesh")
   model%interface_materials(1)%fitted = .true.
   zone = new_process_zone(model, 1)
   ! Turon: tau = sqrt(9 pi E G / (32 N l)) with three distances between nodes, the mode that needs
   ! more, and the same factor for the other
   call check(zone%strength(normal), sqrt(9.0_wp*pi/32.0_wp*across*0.28_wp/3.0_wp), 1.0e-10_wp, &
      & "opening, which has the shorter zone")
   call check(zone%strength(shear)/zone%strength(normal), 92.3_wp/62.3_wp, 1.0e-12_wp, &
      & "one factor for both")
   call finish()

end program test_domain_process_zones
