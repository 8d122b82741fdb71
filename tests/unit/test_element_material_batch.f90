!> Lanes get the laws of their materials, whatever those are: an example law that extends the
!> abstract types runs beside elastic and yielding layers.
program test_element_material_batch
   use brittle, only : brittle_constants_type, brittle_type
   use plydyn_base_precision, only : lanes, wp
   use plydyn_element_material_batch, only : new_laws
   use plydyn_law_law, only : block_law_type, by_matrix_damage, shows_dissipated, shows_fibre_damage
   use plydyn_law_metal_kinematic, only : kinematic_constants_type
   use plydyn_law_ply_elastic, only : elastic_constants_type
   use plydyn_model_material, only : add_material, material_type
   use testing, only : begin, check, finish
   implicit none

   !> Without Poisson's effect, a stress is its own modulus times its own strain
   real(wp), parameter :: young = 2.0e3_wp, strength_strain = 0.01_wp
   !> Indices of the materials
   integer, parameter :: elastic = 1, weak = 2, strong = 3, metal = 4
   type(material_type), allocatable :: materials(:)

   call make_materials()
   call test_grouping()
   call test_update()
   call test_shows()
   call finish()

contains

   !> An elastic material, two that break at different strains, and a metal
   subroutine make_materials()
      type(material_type) :: material
      real(wp), parameter :: none(3) = 0.0_wp
      real(wp) :: all_young(3), all_shear(3)

      all_young(:) = young
      all_shear(:) = 0.5_wp*young
      allocate (materials(0))
      call add_material(materials, material, elastic_constants_type(young=all_young, poisson=none, &
         & shear=all_shear))
      call add_material(materials, material, brittle_constants_type(young=all_young, poisson=none, &
         & shear=all_shear, limit=strength_strain))
      call add_material(materials, material, brittle_constants_type(young=all_young, poisson=none, &
         & shear=all_shear, limit=2.0_wp*strength_strain))
      call add_material(materials, material, kinematic_constants_type(young=all_young, &
         & poisson=none, shear=all_shear, yield=young*strength_strain))
   end subroutine make_materials

   !> Lanes of materials of one type share a law, each block has its own
   subroutine test_grouping()
      type(block_law_type), allocatable :: laws(:)
      integer :: l, lane_material(lanes, 2)

      call begin("new_laws")
      lane_material(:, :) = elastic
      laws = new_laws(materials, lane_material)
      call check(size(laws), 0, "elastic layers need no law")
      lane_material(:, 1) = [weak, strong, metal, elastic, (weak, l=5, lanes)]
      lane_material(:, 2) = 0
      lane_material(1:2, 2) = metal
      laws = new_laws(materials, lane_material)
      call check(size(laws), 4, "three laws in the first block, one in the second")
      call check(all(laws%block == [1, 1, 1, 2]), "block by block")
      call check(all(laws(1)%law%owns .eqv. lane_material(:, 1) == weak &
         & .or. lane_material(:, 1) == strong), "materials of one type share a law")
      call check(all(laws(4)%law%owns .eqv. lane_material(:, 2) == metal), &
         & "lanes without a layer have none")
   end subroutine test_grouping

   !> Each lane breaks at its own strain, for good, and its energy is dissipated
   subroutine test_update()
      type(block_law_type), allocatable :: laws(:)
      real(wp) :: energy(lanes), history(lanes, 1, 2), strain(lanes, 6, 1), stress(lanes, 6, 1)
      integer :: lane_material(lanes, 1)

      call begin("update_points")
      lane_material(:, :) = elastic
      lane_material(1:2, 1) = [weak, strong]
      laws = new_laws(materials, lane_material)
      select type (law => laws(1)%law)
      type is (brittle_type)
         call check(law%limit(:2), [1.0_wp, 2.0_wp]*strength_strain, 0.0_wp, "constants of lanes")
      class default
         call check(.false., "is the law of the material")
      end select
      history(:, :, :) = 0.0_wp
      stress(:, :, :) = -1.0_wp
      strain(:, :, :) = 0.0_wp
      strain(:, 1, 1) = 1.5_wp*strength_strain
      call laws(1)%law%update_points(1, 1, 0.0_wp, strain, history, stress)
      call check(stress(:3, 1, 1), [0.0_wp, 1.5_wp*young*strength_strain, -1.0_wp], 1.0e-12_wp, &
         & "beyond the limit, below it, and in a lane of another law")
      energy(:) = laws(1)%law%dissipated_energy(by_matrix_damage, history(:, 1, :))
      call check(energy(:2), [0.5_wp*young*(1.5_wp*strength_strain)**2, 0.0_wp], 1.0e-12_wp, &
         & "what it stored is dissipated")
      strain(:, 1, 1) = 0.5_wp*strength_strain
      call laws(1)%law%update_points(1, 1, 0.0_wp, strain, history, stress)
      call check(stress(:2, 1, 1), [0.0_wp, 0.5_wp*young*strength_strain], 1.0e-12_wp, &
         & "what is broken stays broken")
   end subroutine test_update

   !> Fields and outputs ask the material
   subroutine test_shows()
      call begin("shows")
      call check(all(materials%shows(shows_dissipated) .eqv. [.false., .true., .true., .true.]), &
         & "all but the elastic one dissipate")
      call check(.not. any(materials%shows(shows_fibre_damage)), "none has damage of fibres")
      call check(.not. any(materials%is_damaged()), "none is damaged")
   end subroutine test_shows

end program test_element_material_batch
