!> Keyword of crack zones, and what they cannot go with.
module plydyn_input_crack_lines
   use plydyn_base_precision, only : wp
   use plydyn_base_text, only : text
   use plydyn_contact_solve_coulomb, only : largest_friction
   use plydyn_deck_declaration, only : extension
   use plydyn_input_card_visitor, only : card_visitor_type
   use plydyn_input_catalogue, only : a_part
   use plydyn_input_check_plies, only : strength_range
   use plydyn_input_check_units, only : of_matrix
   use plydyn_input_keyword_row, only : for_plates, keyword_list_type, stage_laminate
   use plydyn_input_units, only : si_factor
   use plydyn_model_control, only : all_explicit
   use plydyn_model_crack_zone, only : crack_zone_type
   use plydyn_model_cracks, only : prepare_cracks
   use plydyn_model_body, only : points_on_plate
   use plydyn_model_layup, only : faces_tied
   use plydyn_model_model, only : model_type
   implicit none
   private

   public :: add_crack_lines

contains

   !> Add the keyword
   subroutine add_crack_lines(list)
      type(keyword_list_type), intent(inout) :: list

      call list%add("CRACK_LINES", crack_lines, stage_laminate, for_plates, check_crack_lines)
   end subroutine add_crack_lines

   !> Cracks of the matrix along lines
   subroutine crack_lines(card, model)
      class(card_visitor_type), intent(inout) :: card
      type(model_type), intent(inout) :: model

      type(crack_zone_type) :: zone

      call card%keyword(extension, "Cracks of the matrix in every ply of a part, along lines " &
         & //"parallel to the fibres.")
      call card%remark("The quads of the part are equal parallelograms, and the fibres of each " &
         & //"ply lie along an edge or a diagonal of them.")
      call card%example("73-cracks-along-lines", "1, 5.0, 0.3, 0.3|60.0, 110.0, 60.0")
      call card%refer(a_part, "PID", "part whose plies crack", zone%part)
      call card%positive("SPACING", "length", "distance between cracks, rounded to lines of " &
         & //"nodes", zone%spacing)
      call card%positive("GC", "energy/length2", "energy per area of crack, in all modes", &
         & zone%toughness)
      call card%nonnegative("FS", "-", "coefficient of friction of closed cracks", zone%friction)
      call card%nonnegative("STIFF", "stress/length", "traction per opening of a crack; 0: ten " &
         & //"times E2 over the distance of lines of nodes", zone%stiffness)
      call card%card(optional=.true.)
      call card%nonnegative("YT", "stress", "strength across the fibres; 0: that of the ply", &
         & zone%strength(1))
      call card%nonnegative("SL", "stress", "shear strength along the fibres; 0: that of the ply", &
         & zone%strength(2))
      call card%nonnegative("ST", "stress", "strength in shear through the thickness; 0: YT of " &
         & //"the ply", zone%strength(3))
      call card%nonnegative("DEBRIS", "length", "largest opening of a crack that debris holds; 0 " &
         & //"for none", zone%debris)
      if (.not. card%reads .or. zone%part == 0) return
      if (model%crack_zone_of(zone%part) > 0) then
         call card%refuse("PID", "part "//text(model%parts(zone%part)%id)//" has crack lines " &
            & //"already", "one *CRACK_LINES for a part")
         return
      end if
      model%crack_zones = [model%crack_zones, zone]
   end subroutine crack_lines

   !> What a crack zone needs of the rest of the deck
   subroutine check_crack_lines(card, model)
      class(card_visitor_type), intent(inout) :: card
      type(model_type), intent(inout) :: model

      character(:), allocatable :: problem
      type(model_type) :: cracked
      integer :: z

      z = findloc(model%parts(model%crack_zones%part)%id, nint(card%number("PID")), 1)
      associate (zone => model%crack_zones(z))
         call check_plies(card, model, zone)
         call check_interfaces(card, model, zone)
         call check_scheme(card, model, zone)
         if (card%catalogue%report%has_errors()) return
         cracked = model
         call prepare_cracks(cracked, problem)
         if (len(problem) > 0) then
            call card%refuse("PID", problem, "equal parallelograms whose edges or diagonals lie " &
               & //"along the fibres of every ply of the part")
            return
         end if
         if (size(cracked%crack_zones(z)%node) == 0) then
            call card%refuse("SPACING", "no node lies on a crack line inside the part", &
               & "a smaller spacing, or a larger part")
            return
         end if
         call check_strengths(card, cracked%crack_zones(z))
         call check_sense(card, model, zone)
         call check_nodes(card, cracked, cracked%crack_zones(z))
      end associate
   end subroutine check_crack_lines

   !> One layer of order 1 in a ply, of a material whose matrix damage cracks can take over
   subroutine check_plies(card, model, zone)
      class(card_visitor_type), intent(inout) :: card
      type(model_type), intent(in) :: model
      type(crack_zone_type), intent(in) :: zone

      integer :: p

      do p = 1, size(model%parts(zone%part)%plies)
         associate (ply => model%parts(zone%part)%plies(p))
            if (ply%order /= 1 .or. ply%layers /= 1) then
               call card%refuse("PID", "ply "//text(ply%id)//" has "//text(ply%layers) &
                  & //" layers of order "//text(ply%order), "one layer of order 1 in each ply " &
                  & //"that cracks")
               return
            end if
            associate (material => model%materials(ply%material))
               if (material%law%may_crack()) cycle
               call card%refuse("PID", "material "//text(material%id)//" of ply " &
                  & //text(ply%id)//" is *"//material%keyword//", which does not leave its " &
                  & //"cracks to lines", "*MAT_PLY_CODAM2 without averages, " &
                  & //"*MAT_PLY_FRACTURE_3D, or an elastic ply")
               return
            end associate
         end associate
      end do
   end subroutine check_plies

   !> No plies that move as one, no strengths fitted to the mesh, no delaminations at time zero
   subroutine check_interfaces(card, model, zone)
      class(card_visitor_type), intent(inout) :: card
      type(model_type), intent(in) :: model
      type(crack_zone_type), intent(in) :: zone

      integer :: k

      do k = 1, size(model%parts(zone%part)%joint)
         associate (joint => model%parts(zone%part)%joint(k))
            if (joint == faces_tied) then
               call card%refuse("PID", "plies "//text(k)//" and "//text(k + 1) &
                  & //" are tied to each other, and crack each by itself", "*INTERFACE_COHESIVE " &
                  & //"between them, or one ply in place of both")
               return
            end if
            if (joint < 0) cycle
            if (.not. model%interface_materials(joint)%fitted) cycle
            call card%refuse("PID", "the strengths of interface material " &
               & //text(model%interface_materials(joint)%id)//" are fitted to the mesh", &
               & "FIT 0 on *INTERFACE_COHESIVE: cracks decide where delaminations begin")
            return
         end associate
      end do
      if (any(model%initial_damages%part == zone%part)) call card%refuse("PID", &
         & "the part has interfaces that are damaged at time zero", "no *INITIAL_DELAMINATION " &
         & //"and no *INITIAL_DAMAGE in a part with crack lines")
   end subroutine check_interfaces

   !> An explicit scheme without added mass, and contact by points
   subroutine check_scheme(card, model, zone)
      class(card_visitor_type), intent(inout) :: card
      type(model_type), intent(in) :: model
      type(crack_zone_type), intent(in) :: zone

      integer :: i

      if (model%control%scheme /= all_explicit) call card%refuse("PID", "interfaces or " &
         & //"thickness are implicit, which does not know of twins", "IMPL 0 on *CONTROL_LAYERWISE")
      do i = 1, size(model%contacts)
         associate (contact => model%contacts(i))
            if (contact%method == points_on_plate) cycle
            if (size(contact%parts) > 0 .and. .not. any(contact%parts == zone%part)) cycle
            call card%refuse("PID", "contact by METHOD 1 spreads forces over facets, " &
               & //"which a crack parts", "METHOD 2 on *CONTACT_IMPACTOR")
            return
         end associate
      end do
   end subroutine check_scheme

   !> Every ply has strengths
   subroutine check_strengths(card, zone)
      class(card_visitor_type), intent(inout) :: card
      type(crack_zone_type), intent(in) :: zone

      character(2), parameter :: names(3) = ["YT", "SL", "ST"]
      integer :: i, p

      do p = 1, size(zone%plies)
         do i = 1, size(names)
            if (zone%plies(p)%strength(i) > 0.0_wp) cycle
            call card%refuse(names(i), "the material of ply "//text(p)//" has no " &
               & //"strength of its own", "a strength above 0")
            return
         end do
      end do
   end subroutine check_strengths

   !> Warn of constants that no cracks have
   subroutine check_sense(card, model, zone)
      class(card_visitor_type), intent(inout) :: card
      type(model_type), intent(in) :: model
      type(crack_zone_type), intent(in) :: zone

      character(2), parameter :: names(3) = ["YT", "SL", "ST"]
      character(3), parameter :: moduli(3) = ["E2 ", "G12", "E2 "]
      integer :: i
      real(wp) :: energy, modulus(3)

      if (zone%friction > largest_friction) call card%warn("FS", "the friction coefficient of " &
         & //"closed cracks is "//text(zone%friction), "0.1 to 1, as materials have it")
      energy = zone%toughness*si_factor(model%control%units, [0, -2, 1])
      if (energy < of_matrix(1) .or. energy > of_matrix(2)) call card%warn("GC", "a fracture " &
         & //"energy of "//text(energy)//" J/m2 in the units of the deck", "numbers in these " &
         & //"units, or *CONTROL_UNITS with others")
      associate (law => model%materials(model%parts(zone%part)%plies(1)%material)%law)
         modulus(:) = [law%young(2), law%shear(1), law%young(2)]
      end associate
      do i = 1, size(names)
         ! those of plies are looked at on their cards
         if (zone%strength(i) <= 0.0_wp) cycle
         associate (ratio => modulus(i)/zone%strength(i))
            if (ratio < strength_range(1) .or. ratio > strength_range(2)) call card%warn( &
               & names(i), names(i)//" is "//trim(moduli(i))//"/"//text(ratio, 3), &
               & trim(moduli(i))//"/2000 to "//trim(moduli(i))//"/20, usually")
         end associate
      end do
   end subroutine check_sense

   !> Nothing holds, moves or loads one copy of a doubled node
   subroutine check_nodes(card, model, zone)
      class(card_visitor_type), intent(inout) :: card
      !> With its twins
      type(model_type), intent(in) :: model
      type(crack_zone_type), intent(in) :: zone

      integer :: i, k

      do i = 1, size(model%supports)
         call refuse_nodes(model%supports(i)%nodes, "held by "//trim(model%supports(i)%name))
      end do
      do i = 1, size(model%motions)
         call refuse_nodes(model%motions(i)%nodes, "moved by "//trim(model%motions(i)%name))
      end do
      do i = 1, size(model%constraints)
         call refuse_nodes(model%constraints(i)%terms%node, "part of a constraint")
      end do
      do i = 1, size(model%point_loads)
         call refuse_nodes(model%point_loads(i)%nodes, "loaded")
      end do
      do i = 1, size(model%line_loads)
         call refuse_nodes(model%line_loads(i)%nodes, "loaded")
      end do
      do i = 1, size(model%pressures)
         do k = 1, size(model%pressures(i)%quads)
            call refuse_nodes(model%mesh%quad_node(:, model%pressures(i)%quads(k)), "loaded")
         end do
      end do
      do i = 1, size(model%fixtures)
         associate (fixture => model%fixtures(i))
            if (fixture%is_clamp) call refuse_nodes(pack(zone%node, [(fixture%body%covers( &
               & model%mesh%position(:2, zone%node(k))), k=1, size(zone%node))]), "under clamp " &
               & //text(fixture%id))
         end associate
      end do
   contains
      !> Refuse the first doubled node among some
      subroutine refuse_nodes(nodes, what)
         integer, intent(in) :: nodes(:)
         character(*), intent(in) :: what
         integer :: n

         if (card%catalogue%report%has_errors()) return
         do n = 1, size(nodes)
            if (zone%place(nodes(n)) == 0) cycle
            call card%refuse("PID", "node "//text(model%mesh%node_id(nodes(n))) &
               & //" lies on a crack and is "//what, "a part with crack lines that leaves out " &
               & //"such nodes and the elements at them, or what acts beside it")
            return
         end do
      end subroutine refuse_nodes
   end subroutine check_nodes

end module plydyn_input_crack_lines
