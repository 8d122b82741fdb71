!> Zones that soften have the lengths of closed forms, the worst of the interfaces of a material.
program test_domain_process_zones
   use plydyn_base_precision, only : wp
   use plydyn_element_interface_process_zones, only : find_weakness, new_process_zone, &
      & process_zone_type
   use plydyn_law_cohesive_bilinear, only : cohesive_constants_type
   use plydyn_law_cohesive_softening, only : normal, shear
   use plydyn_fem_quadrature, only : quad_points
   use plydyn_law_scatter, only : scatter_type
   use plydyn_model_layup, only : faces_tied
   use plydyn_model_material, only : interface_material_type
   use plydyn_model_model, only : model_type
   use sample, only : rectangle_mesh, rectangle_model
   use testing, only : begin, check, finish
   implicit none

   real(wp), parameter :: pi = acos(-1.0_wp), across = 9000.0_wp, along = 165.0e3_wp
   type(model_type) :: model
   type(process_zone_type) :: zone
   real(wp), allocatable :: weakness(:, :, :)
   real(wp) :: place(2, 9)

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
   call find_weakness(model, 1, [1, 2, 3, 4, 5, 6], [1, 2, 0, 0, 0, 0, 0, 0], weakness)
   call check(.not. allocated(weakness), "quads of one size have the strengths of the law")

   call begin("strengths fitted to a graded mesh")
   ! the quads beyond x = 2 become twice as long
   associate (x => model%mesh%position(1, :))
      x(:) = merge(x, 2.0_wp*x - 2.0_wp, x < 2.5_wp)
   end associate
   zone = new_process_zone(model, 1)
   call check(zone%strength(normal), sqrt(9.0_wp*pi/32.0_wp*across*0.28_wp/6.0_wp), 1.0e-10_wp, &
      & "the lowest are those of the coarsest quad")
   call check(zone%highest(normal), sqrt(9.0_wp*pi/32.0_wp*across*0.28_wp/3.0_wp), 1.0e-10_wp, &
      & "the highest those of the finest")
   call check(zone%quads, 6, "quads of the material")
   call find_weakness(model, 1, [1, 2, 3, 4, 5, 6], [1, 2, 0, 0, 0, 0, 0, 0], weakness)
   call check(weakness(1, 1, [1, 4]), [0.5_wp, 0.5_wp], 1.0e-12_wp, &
      & "the square of the strength falls with the distance of the nodes")
   call check(weakness(2, 9, [2, 3, 5, 6]), [1.0_wp, 1.0_wp, 1.0_wp, 1.0_wp], 1.0e-12_wp, &
      & "of each quad")
   model%interface_materials(1)%fitted = .false.
   zone = new_process_zone(model, 1)
   call check(all(zone%coarse == 6), "with the strengths of the material all are too coarse")

   call begin("strengths that scatter")
   model%interface_materials(1)%scatter = scatter_type(seed=1, modulus=10.0_wp, length=1.0_wp)
   call find_weakness(model, 1, [2, 1], [2, 1, 0, 0, 0, 0, 0, 0], weakness)
   place(:, :) = quad_points(model%mesh%position(:2, model%mesh%quad_node(:, 1)), .false.)
   call check(weakness(1, 5, 2), 1.0_wp/model%interface_materials(1)%scatter%factor( &
      & place(:, 5), 2)**2, 1.0e-12_wp, "are those of the place and the interface")
   call check(weakness(3, 5, 2), 1.0_wp, 0.0_wp, "lanes without an interface have none")
   call finish()

end program test_domain_process_zones
