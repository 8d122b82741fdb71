!> Areas and energies of interfaces come from the histories of their points.
program test_domain_delamination
   use plydyn_base_error, only : error_type
   use plydyn_base_precision, only : wp
   use plydyn_domain_build, only : build_domain, start_histories
   use plydyn_domain_delamination, only : can_fail, delamination, delamination_type, &
      & interface_losses, projected_areas
   use plydyn_domain_domain, only : domain_type
   use plydyn_law_cohesive_bilinear, only : cohesive_constants_type
   use plydyn_model_layup, only : initial_damage_type
   use plydyn_model_material, only : interface_material_type
   use plydyn_model_model, only : model_type
   use sample, only : rectangle_mesh, rectangle_model
   use testing, only : begin, check, finish
   implicit none

   type(domain_type) :: domain
   type(model_type) :: model
   type(error_type), allocatable :: error
   type(delamination_type) :: lost(3)
   real(wp), allocatable :: history(:)

   ! six quads of 2 mm2; interfaces that fail, springs, and again some that fail, of two families
   model = rectangle_model(rectangle_mesh(3, 3, 2, 6.0_wp, 2.0_wp, 0.0_wp), &
      & [0.0_wp, 90.0_wp, 0.0_wp, 90.0_wp], 0.25_wp, [2, 2, 2, 1])
   model%parts(1)%joint(:) = [1, 2, 1]
   model%interface_materials = [interface_material_type(id=6, title="bond", fails=.true., &
      & constants=cohesive_constants_type(stiffness=[1.3733e6_wp, 4.933e5_wp], &
      & strength=[62.3_wp, 92.3_wp], toughness=[0.28_wp, 0.79_wp], exponent=1.45_wp)), &
      & interface_material_type(id=7, title="springs", constants=cohesive_constants_type( &
      & stiffness=[1.0e6_wp, 1.0e6_wp]))]
   model%initial_damages = [new_damage([1, 1], [1, 2], 1.0_wp), &
      & new_damage([3, 3], [2, 3], 1.0_wp), new_damage([1, 3], [4, 4], 0.4_wp)]
   call build_domain(model, domain, error)

   call begin("delamination")
   call check(.not. allocated(error), "the domain is built")
   call check(can_fail(domain), "something can fail")
   allocate (history(domain%histories))
   history(:) = 0.0_wp
   call start_histories(model, domain, history)
   lost(:) = delamination(domain, history)
   call check(lost%failed, [4.0_wp, 0.0_wp, 4.0_wp], 1.0e-12_wp, "areas of two quads each")
   call check(lost%begun, [6.0_wp, 0.0_wp, 6.0_wp], 1.0e-12_wp, "and of a third that is damaged")
   call check(lost%delaminated, [4.0_wp, 0.0_wp, 4.0_wp], 1.0e-12_wp, &
      & "opening to a damage of 0.4 spends less than half of the toughness")
   call check(projected_areas(domain, history), [6.0_wp, 6.0_wp], 1.0e-12_wp, &
      & "three quads from above")
   call check(interface_losses(lost), [0.0_wp, 0.0_wp], 0.0_wp, &
      & "what was broken before has cost nothing")

   call begin("start_histories within a circle")
   model%initial_damages = [new_damage([1, 1], [1, 2], 1.0_wp)]
   model%initial_damages(1)%centre(:) = [0.0_wp, 0.0_wp]
   model%initial_damages(1)%radius = 0.7_wp
   history(:) = 0.0_wp
   call start_histories(model, domain, history)
   lost(:) = delamination(domain, history)
   ! the Gauss point in the corner, at 0.23 and 0.11 mm, and the next one along y, at 0.5 mm
   call check(lost(1)%failed, 2.0_wp*(25.0_wp + 40.0_wp)/324.0_wp, 1.0e-12_wp, "two points")

   ! the node in the corner has 1/36 of the quad, the Gauss point beside it 25/324
   call begin("projected_areas of points and nodes")
   call test_quadratures([.false., .true.])
   call test_quadratures([.true., .false.])
   call finish()

contains

   !> Two interfaces that fail in one corner, with points of their own each
   subroutine test_quadratures(nodal)
      !> Points at the nodes, by interface material
      logical, intent(in) :: nodal(2)

      model%parts(1)%joint(:) = [1, 2, 1]
      model%interface_materials(2) = model%interface_materials(1)
      model%interface_materials(:)%nodal = nodal
      model%initial_damages = [new_damage([1, 2], [1], 1.0_wp)]
      model%initial_damages(1)%centre(:) = [0.0_wp, 0.0_wp]
      model%initial_damages(1)%radius = 0.3_wp
      call build_domain(model, domain, error)
      deallocate (history)
      allocate (history(domain%histories), source=0.0_wp)
      call start_histories(model, domain, history)
      call check(projected_areas(domain, history), spread(2.0_wp*25.0_wp/324.0_wp, 1, 2), &
         & 1.0e-12_wp, "the larger of both is seen")
   end subroutine test_quadratures

   !> Damage of some interfaces and quads
   function new_damage(interfaces, quads, damage) result(initial)
      !> First and last interface; quads; damage
      integer, intent(in) :: interfaces(2), quads(:)
      real(wp), intent(in) :: damage
      type(initial_damage_type) :: initial

      initial%part = 1
      initial%interfaces(:) = interfaces
      initial%quads = quads
      initial%damage = damage
   end function new_damage

end program test_domain_delamination
