!> Keywords of interfaces between plies: where their materials are, and how they fail.
module plydyn_input_interface
   use plydyn_base_precision, only : wp
   use plydyn_base_text, only : text
   use plydyn_contact_solve_coulomb, only : largest_friction
   use plydyn_deck_declaration, only : extension
   use plydyn_input_card_visitor, only : card_visitor_type
   use plydyn_input_catalogue, only : an_interface_material
   use plydyn_input_cohesive, only : add_interface_materials, of_failure
   use plydyn_input_initial_damage, only : add_initial_damage, visit_range
   use plydyn_input_keyword_row, only : for_plates, keyword_list_type, stage_laminate, stage_part
   use plydyn_law_cohesive_bilinear, only : cohesive_constants_type
   use plydyn_law_cohesive_check, only : check_cohesive, finding_type
   use plydyn_law_scatter, only : period, scatter_type
   use plydyn_model_layup, only : faces_apart, faces_tied
   use plydyn_model_material, only : interface_material_type
   use plydyn_model_mesh, only : mesh_type
   use plydyn_model_model, only : model_type
   implicit none
   private

   public :: add_interfaces

   !> What is right where a material is on a card twice
   character(*), parameter :: one_row = "one row for each material"

contains

   !> Add these keywords
   subroutine add_interfaces(list)
      type(keyword_list_type), intent(inout) :: list

      call list%add("INTERFACE_COHESIVE", interface_cohesive, stage_laminate, for_plates)
      call list%add("INTERFACE_LAW", interface_law, stage_part, for_plates)
      call list%add("INTERFACE_SCATTER", interface_scatter, stage_part, for_plates, look_at_length)
      call add_interface_materials(list)
      call add_initial_damage(list)
   end subroutine add_interfaces

   !> What joins two plies
   subroutine interface_cohesive(card, model)
      class(card_visitor_type), intent(inout) :: card
      type(model_type), intent(inout) :: model

      type(interface_material_type) :: material
      integer :: joint, number, part, range(2)

      call card%keyword(extension, "Interfaces between the plies of a laminate: cohesive zones, " &
         & //"springs, or none.")
      call card%remark("Interface k lies between plies k and k + 1, counted from the bottom. " &
         & //"Interfaces that no card names are perfectly tied. CLOSE, FRIC and FIT need a " &
         & //"material that fails. CLOSE 1 is the classical law; failed faces that close again " &
         & //"can then gain energy if the time step is near the stable step, see the theory. FIT " &
         & //"1 replaces the shear stiffness by EN GIC/GIIC (S/T)**2, FIT 2 lowers both " &
         & //"strengths by one factor, so that the process zone (cohesive zone) spans three " &
         & //"distances between nodes, FIT 3 does both; the listing prints the fitted constants. " &
         & //"The constants of the material itself must be valid, too. All parts have the same " &
         & //"interfaces, materials and options.")
      call card%example("7-joints-of-layers", "1, 0, 0, 100")
      do while (card%next())
         call visit_range(card, model, part, range)
         call card%integer("MID", "interface material; -1 for no connection", number, least=-1)
         joint = faces_apart
         material = interface_material_type()
         if (card%reads .and. number > 0) then
            call card%look_up(an_interface_material, "MID", joint)
            if (joint > 0) material = model%interface_materials(joint)
         else if (card%reads .and. number == 0) then
            if (card%is_fine("MID")) call card%refuse("MID", "MID cannot be 0", &
               & "an interface material, or -1 for nothing; tied interfaces need no card")
         end if
         call visit_options(card, joint > 0, material)
         if (.not. card%reads) cycle
         if (joint > 0) call find_alike(material, model%interface_materials, joint)
         if (part == 0) cycle
         if (any(model%parts(part)%joint(range(1):range(2)) /= faces_tied)) call card%refuse( &
            & "IFAC1", "some of these interfaces have a card already", "each interface on one card")
         model%parts(part)%joint(range(1):range(2)) = joint
      end do
   end subroutine interface_cohesive

   !> Options of the material at these interfaces
   subroutine visit_options(card, is_known, material)
      class(card_visitor_type), intent(inout) :: card
      !> Whether there is a material
      logical, intent(in) :: is_known
      !> Gets the options
      type(interface_material_type), intent(inout) :: material

      character(*), parameter :: names(3) = ["CLOSE", "FRIC ", "FIT  "]
      type(finding_type), allocatable :: findings(:)
      logical :: is_constant
      integer :: fit, i

      associate (constants => material%constants)
         call card%flag("NQ", "quadrature: 0 Gauss points, 1 nodes", material%nodal)
         call card%flag("CLOSE", "stiffness against closing of a damaged face: 0 falls with the " &
            & //"damage, down to 10 %; 1 is constant", is_constant)
         call card%nonnegative("FRIC", "-", "coefficient of friction of failed faces", &
            & constants%friction)
         call card%integer("FIT", "constants that are fitted: 0 none, 1 the shear stiffness, to " &
            & //"the energy, 2 the strengths, to the mesh, 3 both", fit, default=0, least=0, most=3)
         if (.not. card%reads) return
         do i = 1, size(names)
            if (material%fails .or. card%number(names(i)) <= 0.0_wp) cycle
            call card%refuse(names(i), trim(names(i))//" needs an interface that fails", &
               & "0, or a material such as *MAT_COHESIVE_MIXED_MODE")
         end do
         if (constants%friction > largest_friction) call card%warn("FRIC", "the friction " &
            & //"coefficient of the faces is "//text(constants%friction), &
            & "0.1 to 1, as materials have it")
         if (.not. is_known) return
         material%fitted = fit >= 2
         constants%falling_penalty = material%fails .and. .not. is_constant
         constants%consistent = modulo(fit, 2) == 1
         if (.not. constants%consistent .or. card%catalogue%report%has_errors()) return
         call check_cohesive(constants, findings)
         if (size(findings) > 0) call card%refuse("FIT", "with the fitted shear stiffness, " &
            & //findings(1)%wrong, findings(1)%right)
      end associate
   end subroutine visit_options

   !> Index of a material with the same number and options; a new one if there is none
   subroutine find_alike(material, materials, index)
      type(interface_material_type), intent(in) :: material
      type(interface_material_type), allocatable, intent(inout) :: materials(:)
      integer, intent(out) :: index

      do index = 1, size(materials)
         associate (other => materials(index), a => material%constants, &
            & b => materials(index)%constants)
            if (material%id == other%id .and. (material%nodal .eqv. other%nodal) &
               & .and. (material%fitted .eqv. other%fitted) &
               & .and. (a%consistent .eqv. b%consistent) &
               & .and. (a%falling_penalty .eqv. b%falling_penalty) &
               & .and. abs(a%friction - b%friction) <= 0.0_wp) return
         end associate
      end do
      materials = [materials, material]
   end subroutine find_alike

   !> How an interface material fails where the mode changes, and under pressure
   subroutine interface_law(card, model)
      class(card_visitor_type), intent(inout) :: card
      type(model_type), intent(inout) :: model

      logical :: by_work
      integer :: material
      real(wp) :: gain

      call card%keyword(extension, "Failure of an interface material under varying mode mixity " &
         & //"and under pressure.")
      call card%remark("MIX 0 takes the mode mixity from the present opening. Where it changes " &
         & //"during loading, as ahead of a crack in a bent beam, the work of failure differs " &
         & //"from the fracture energy by some 10 %. MIX 1 takes it from the work of both modes " &
         & //"so far: the work of failure is then the fracture energy of its own mode mixity on " &
         & //"every path. Both are the same in pure modes and on straight paths. With ETA a " &
         & //"pressure p increases the shear strength to S + ETA p, and the fracture energy of " &
         & //"mode II grows with the square of the strength.")
      call card%example(of_failure, "100, 1, 0.3")
      do while (card%next())
         call visit_failing(card, model, material)
         call card%flag("MIX", "mode mixity: 0 of the present opening, 1 of the work so far", &
            & by_work)
         call card%nonnegative("ETA", "-", "growth of the shear strength with the pressure", gain)
         if (.not. card%reads .or. material == 0) cycle
         if (model%interface_materials(material)%has_law) call card%refuse("MID", &
            & "the material has a law already", one_row)
         model%interface_materials(material)%has_law = .true.
         model%interface_materials(material)%constants%by_work = by_work
         model%interface_materials(material)%constants%pressure_gain = gain
      end do
   end subroutine interface_law

   !> Scatter of the strengths of an interface material
   subroutine interface_scatter(card, model)
      class(card_visitor_type), intent(inout) :: card
      type(model_type), intent(inout) :: model

      type(cohesive_constants_type) :: strongest
      type(finding_type), allocatable :: findings(:)
      type(scatter_type) :: scatter
      integer :: material

      call card%keyword(extension, "Random scatter of the strengths of an interface material.")
      call card%remark("Both strengths are multiplied by a Weibull-distributed factor of mean " &
         & //"1; the fracture energy does not change. The correlation of two points at the " &
         & //"distance LENGTH is some 0.6; different interfaces are not correlated. The factor " &
         & //"depends only on the position, the interface and SEED, not on the mesh or the " &
         & //"number of ranks. The coefficient of variation is some 1.2/M.")
      call card%example(of_failure, "100, 1, 12.0, 20.0")
      do while (card%next())
         call visit_failing(card, model, material)
         call card%integer("SEED", "number of the realisation", scatter%seed, least=0)
         call card%real("M", "-", "modulus of Weibull", scatter%modulus, least=2.0_wp)
         call card%positive("LENGTH", "length", "length of the correlation", scatter%length)
         if (.not. card%reads) cycle
         call check_scatter_length(card, scatter%length, model%mesh)
         if (material == 0 .or. card%catalogue%report%has_errors()) cycle
         if (model%interface_materials(material)%scatter%modulus > 0.0_wp) call card%refuse( &
            & "MID", "the strengths of the material scatter already", one_row)
         model%interface_materials(material)%scatter = scatter
         strongest = model%interface_materials(material)%constants
         strongest%strength(:) = scatter%largest_factor()*strongest%strength
         call check_cohesive(strongest, findings)
         if (size(findings) > 0) call card%refuse("M", "at the strongest points " &
            & //findings(1)%wrong, findings(1)%right)
      end do
   end subroutine interface_scatter

   !> Refuse a length so short that the field of strengths repeats itself on the plate, where it
   !> would be the same at all points in the end
   subroutine check_scatter_length(card, length, mesh)
      class(card_visitor_type), intent(inout) :: card
      !> Length of the correlation, of the field LENGTH
      real(wp), intent(in) :: length
      !> Nodes, which have been read
      type(mesh_type), intent(in) :: mesh

      associate (farthest => maxval(abs(mesh%position(:2, :))))
         if (farthest < 0.5_wp*period*length .or. .not. card%is_fine("LENGTH")) return
         call card%refuse("LENGTH", "the strengths cannot scatter over "//text(length) &
            & //" on nodes at up to "//text(farthest), &
            & "a length that is not far below the sides of the quads")
      end associate
   end subroutine check_scatter_length

   !> Warn of a length of the correlation that no quad sees, or no plate
   subroutine look_at_length(card, model)
      class(card_visitor_type), intent(inout) :: card
      type(model_type), intent(inout) :: model

      real(wp) :: length, plate, quad

      if (size(model%mesh%quad_id) == 0) return
      quad = least_side(model%mesh)
      plate = maxval(maxval(model%mesh%position(:2, :), dim=2) &
         & - minval(model%mesh%position(:2, :), dim=2))
      do while (card%next())
         length = card%number("LENGTH")
         if (length < quad) then
            call card%warn("LENGTH", "the strengths scatter over "//text(length)//", below the " &
               & //"sides of all quads: every point has a strength of its own", &
               & text(quad, 3)//", the shortest side, or more")
         else if (length > plate) then
            call card%warn("LENGTH", "the strengths scatter over "//text(length)//", above the " &
               & //"sides of the plate: all of it has about the same strength", "less than " &
               & //text(plate, 3))
         end if
      end do
   end subroutine look_at_length

   !> Shortest side of all quads, length
   pure real(wp) function least_side(mesh)
      !> Has quads
      type(mesh_type), intent(in) :: mesh

      integer, parameter :: corners = 4
      integer :: k, q

      least_side = huge(1.0_wp)
      do q = 1, size(mesh%quad_id)
         associate (corner => mesh%position(:, mesh%quad_node(:corners, q)))
            do k = 1, corners
               least_side = min(least_side, norm2(corner(:, k) - corner(:, 1 + modulo(k, corners))))
            end do
         end associate
      end do
   end function least_side

   !> Interface material of a row
   subroutine visit_failing(card, model, material)
      class(card_visitor_type), intent(inout) :: card
      type(model_type), intent(in) :: model
      !> Its index; 0 for one that is undefined or does not fail
      integer, intent(inout) :: material

      call card%refer(an_interface_material, "MID", "interface material that fails", material)
      if (.not. card%reads .or. material == 0) return
      if (model%interface_materials(material)%fails) return
      call card%refuse("MID", "the material does not fail", &
         & "a material such as *MAT_COHESIVE_MIXED_MODE")
      material = 0
   end subroutine visit_failing

end module plydyn_input_interface
