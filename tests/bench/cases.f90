!> Plates of eight plies for the timing of kernels and steps.
module plydyn_bench_cases
   use metals, only : linear_metal
   use plydyn_base_error, only : error_type
   use plydyn_base_precision, only : lanes, wp
   use plydyn_domain_build, only : build_domain
   use plydyn_fem_columns, only : alignment_offset
   use plydyn_domain_domain, only : domain_type
   use plydyn_law_law, only : law_type
   use plydyn_law_ply_constants, only : ply_constants_type
   use plydyn_law_ply_damage, only : ply_damage_type
   use plydyn_law_metal_kinematic, only : kinematic_constants_type, plastic_kinematic_type
   use plydyn_model_layup, only : faces_apart
   use plydyn_model_material, only : interface_material_type
   use plydyn_model_model, only : model_type
   use ply_point, only : paper_ply
   use sample, only : rectangle_mesh, rectangle_model
   use plydyn_element_plate_group, only : plate_group_type
   implicit none
   private

   public :: averaged_case, damage_laws, plate_case, press, yield_laws

   !> Plies, of a width that fills one batch
   real(wp), parameter :: angles(8) = [0.0_wp, 45.0_wp, 90.0_wp, -45.0_wp, -45.0_wp, 90.0_wp, &
      & 45.0_wp, 0.0_wp]
   !> Ply thickness and size of the plate
   real(wp), parameter :: thickness = 0.25_wp, size_of_plate = 16.0_wp

contains

   !> A plate of elastic plies that are apart, or joined by springs
   subroutine plate_case(side, quads, order, kinematics, joined, domain)
      !> Nodes along a side of a quad, quads along x and y, order of the plies, strain measure
      integer, intent(in) :: side, quads(2), order, kinematics
      !> Whether springs join the plies
      logical, intent(in) :: joined
      !> The plate
      type(domain_type), intent(out) :: domain

      type(error_type), allocatable :: error
      type(model_type) :: model

      model = rectangle_model(rectangle_mesh(side, quads(1), quads(2), size_of_plate, &
         & size_of_plate, 0.05_wp), &
         & angles, thickness, spread(order, 1, size(angles)))
      model%parts(1)%joint(:) = faces_apart
      if (joined) call join(model)
      model%control%kinematics = kinematics
      call build_domain(model, domain, error)
      if (allocated(error)) error stop "the plate of a benchmark cannot be built"
   end subroutine plate_case

   !> A plate whose plies are joined by springs and have the damage law of the paper's ply, with
   !> averages over neighbours
   subroutine averaged_case(quads, order, radius, domain)
      !> Quads of nine nodes along x and y, order of the plies
      integer, intent(in) :: quads(2), order
      !> Radii of the ellipse; 0 for no average
      real(wp), intent(in) :: radius
      !> The plate
      type(domain_type), intent(out) :: domain

      type(error_type), allocatable :: error
      type(model_type) :: model
      type(ply_constants_type) :: ply

      model = rectangle_model(rectangle_mesh(3, quads(1), quads(2), size_of_plate, size_of_plate, &
         & 0.05_wp), angles, thickness, spread(order, 1, size(angles)))
      call join(model)
      ply = paper_ply()
      ply%radius(:) = radius
      deallocate (model%materials(1)%law)
      allocate (model%materials(1)%law, source=ply)
      call build_domain(model, domain, error)
      if (allocated(error)) error stop "the plate of averages cannot be built"
   end subroutine averaged_case

   !> Let springs join the plies
   subroutine join(model)
      type(model_type), intent(inout) :: model

      model%interface_materials = [interface_material_type(id=1)]
      model%interface_materials(1)%constants%stiffness(:) = [1.0e5_wp, 1.0e5_wp]
      model%parts(1)%joint(:) = 1
   end subroutine join

   !> Displacement that presses each ply to a share of its thickness, the ratio of volumes
   subroutine press(domain, order, ratio, displacement)
      !> Plies that are apart
      type(domain_type), intent(in) :: domain
      !> Order of the plies, at most 2: points are equally spaced
      integer, intent(in) :: order
      !> Ratio of volumes
      real(wp), intent(in) :: ratio
      !> Displacement of all points
      real(wp), intent(inout) :: displacement(:)

      integer :: layer, level, node
      real(wp) :: height

      do level = 1, order + 1
         height = thickness*real(level - 1, wp)/real(order, wp)
         do layer = 1, size(angles)
            do node = 1, domain%columns%nodes
               displacement(domain%columns%freedom(layer, level, 3, node)) = (ratio - 1.0_wp)*height
            end do
         end do
      end do
   end subroutine press

   !> Give all plies the damage law of the paper's ply
   subroutine damage_laws(domain)
      !> The plate
      type(domain_type), intent(inout) :: domain

      type(ply_damage_type) :: law
      integer :: l

      do l = 1, lanes
         call law%set_lane(l, paper_ply())
      end do
      call give_law(domain, law)
   end subroutine damage_laws

   !> Give all plies a metal that never yields
   subroutine yield_laws(domain)
      !> The plate
      type(domain_type), intent(inout) :: domain

      type(kinematic_constants_type) :: metal
      type(plastic_kinematic_type) :: law
      integer :: l

      metal = linear_metal(70.0e3_wp, 0.3_wp, 1.0e6_wp, 700.0_wp, 0.5_wp)
      do l = 1, lanes
         call metal%set_lane(l, law)
      end do
      call give_law(domain, law)
   end subroutine yield_laws

   !> Give all plies a law, and make room for its histories
   subroutine give_law(domain, law)
      type(domain_type), intent(inout) :: domain
      class(law_type), intent(in) :: law

      select type (group => domain%groups(1)%item)
      type is (plate_group_type)
         associate (batch => group%plate%batches(1))
            deallocate (batch%laws)
            allocate (batch%laws(1))
            batch%laws(1)%block = 1
            allocate (batch%laws(1)%law, source=law)
            batch%histories = law%histories
            batch%first_history = alignment_offset + 1
            domain%histories = alignment_offset + lanes*batch%histories*batch%pitch
         end associate
      end select
   end subroutine give_law

end module plydyn_bench_cases
