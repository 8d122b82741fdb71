!> Readers of impactors, contacts and output.
module plydyn_input_read_impact
   use plydyn_base_precision, only : wp
   use plydyn_base_text, only : lower_case, upper_case
   use plydyn_deck_cards, only : cards_type
   use plydyn_deck_values, only : longest_word
   use plydyn_input_catalogue, only : a_contact, a_node, a_node_set, a_part, a_profile, &
      & an_impactor, catalogue_type
   use plydyn_model_control, only : profile_type, request_type
   use plydyn_model_impactor, only : contact_type, impactor_type
   use plydyn_model_material, only : law_elastic, material_type
   use plydyn_model_mesh, only : mesh_type
   implicit none
   private

   public :: read_impactor_sphere, read_contact_impactor, read_database_history_node, &
      & read_database_history_node_set, read_database_field, read_database_profile

contains

   !> *IMPACTOR_SPHERE: a rigid sphere
   subroutine read_impactor_sphere(cards, catalogue, impactors)
      type(cards_type), intent(in) :: cards
      type(catalogue_type), intent(inout) :: catalogue
      type(impactor_type), allocatable, intent(inout) :: impactors(:)

      type(impactor_type) :: impactor

      call catalogue%define(an_impactor, cards, "IID")
      impactor%id = cards%integer("IID")
      impactor%title = cards%word("TITLE")
      impactor%radius = cards%real("RADIUS")
      impactor%mass = cards%real("MASS")
      impactor%centre(:) = cards%reals(["XC", "YC", "ZC"])
      impactor%velocity(:) = cards%reals(["VX", "VY", "VZ"])
      impactor%guided = cards%integer("DOF") == 1
      impactor%gravity = cards%real("GRAVZ")
      impactor%hemisphere = cards%integer("SHAPE") == 1
      if (impactor%guided .and. any(abs(impactor%velocity(:2)) > 0.0_wp)) then
         call catalogue%refuse(cards, "VX", "a guided impactor moves along z only", &
            & "VX = VY = 0, or DOF 0 for a free impactor")
      end if
      impactors = [impactors, impactor]
   end subroutine read_impactor_sphere

   !> *CONTACT_IMPACTOR: an impactor against a face of a part
   subroutine read_contact_impactor(cards, catalogue, contacts)
      type(cards_type), intent(in) :: cards
      type(catalogue_type), intent(inout) :: catalogue
      type(contact_type), allocatable, intent(inout) :: contacts(:)

      type(contact_type) :: contact

      call catalogue%define(a_contact, cards, "CID")
      call catalogue%find(an_impactor, cards, "IID", contact%impactor)
      call catalogue%find(a_part, cards, "PID", contact%part)
      if (contact%impactor > 0 .and. any(contacts%impactor == contact%impactor)) then
         call catalogue%refuse(cards, "IID", "the impactor has a contact already", &
            & "one contact for each impactor")
      end if
      contact%id = cards%integer("CID")
      contact%face = cards%integer("FACE")
      contact%method = cards%integer("METHOD")
      contact%spacing = cards%real("SPACING")
      contact%line = cards%line_of("METHOD")
      contacts = [contacts, contact]
   end subroutine read_contact_impactor

   !> *DATABASE_HISTORY_NODE: nodes with a history
   subroutine read_database_history_node(cards, catalogue, request)
      type(cards_type), intent(in) :: cards
      type(catalogue_type), intent(inout) :: catalogue
      type(request_type), intent(inout) :: request

      integer, allocatable :: nodes(:)

      call catalogue%find_all(a_node, cards, "ID", nodes)
      call add_nodes(nodes, request)
   end subroutine read_database_history_node

   !> *DATABASE_HISTORY_NODE_SET: sets of nodes with a history
   subroutine read_database_history_node_set(cards, catalogue, request)
      type(cards_type), intent(in) :: cards
      type(catalogue_type), intent(inout) :: catalogue
      type(request_type), intent(inout) :: request

      integer, allocatable :: sets(:)
      integer :: i

      call catalogue%find_all(a_node_set, cards, "ID", sets)
      do i = 1, size(sets)
         call add_nodes(catalogue%node_sets(sets(i))%list, request)
      end do
   end subroutine read_database_history_node_set

   !> Nodes that have no history yet
   subroutine add_nodes(nodes, request)
      !> Indices of nodes
      integer, intent(in) :: nodes(:)
      type(request_type), intent(inout) :: request

      integer :: i

      do i = 1, size(nodes)
         if (any(request%nodes == nodes(i))) cycle
         request%nodes = [request%nodes, nodes(i)]
      end do
   end subroutine add_nodes

   !> *DATABASE_FIELD: fields of the field states
   subroutine read_database_field(cards, catalogue, materials, request)
      type(cards_type), intent(in) :: cards
      type(catalogue_type), intent(inout) :: catalogue
      !> Materials of the model
      type(material_type), intent(in) :: materials(:)
      type(request_type), intent(inout) :: request

      character(longest_word), allocatable :: words(:)
      character(len(request%fields)) :: name
      integer :: i

      words = cards%words("NAME")
      do i = 1, size(words)
         name = lower_case(words(i))
         if (all(request%fields /= name)) request%fields = [request%fields, name]
         call check_field(cards, name, materials, catalogue)
      end do
   end subroutine read_database_field

   !> A field that no material has
   subroutine check_field(cards, name, materials, catalogue)
      type(cards_type), intent(in) :: cards
      !> Name of the field
      character(*), intent(in) :: name
      type(material_type), intent(in) :: materials(:)
      type(catalogue_type), intent(inout) :: catalogue

      select case (name)
      case ("plastic_strain")
         if (any(materials%law /= law_elastic .and. .not. materials%is_damaged())) return
         call catalogue%refuse(cards, "NAME", "no material yields: there is no PLASTIC_STRAIN", &
            & "a material that yields, such as *MAT_PLASTIC_KINEMATIC, or not this field")
      case ("damage_fibre", "damage_matrix", "damage_shear")
         if (any(materials%is_damaged())) return
         call catalogue%refuse(cards, "NAME", "no material is damaged: there is no " &
            & //upper_case(name), "a material with damage, such as *MAT_PLY_CODAM2, or not this " &
            & //"field")
      case ("dissipated")
         if (any(materials%law /= law_elastic)) return
         call catalogue%refuse(cards, "NAME", "no material dissipates: there is no DISSIPATED", &
            & "a material that yields or is damaged, or not this field")
      case default
         continue
      end select
   end subroutine check_field

   !> *DATABASE_PROFILE: stress through the thickness
   subroutine read_database_profile(cards, catalogue, mesh, profiles)
      type(cards_type), intent(in) :: cards
      type(catalogue_type), intent(inout) :: catalogue
      type(mesh_type), intent(in) :: mesh
      type(profile_type), allocatable, intent(inout) :: profiles(:)

      type(profile_type) :: new(cards%sets())
      integer :: nth

      do nth = 1, cards%sets()
         call catalogue%define(a_profile, cards, "ID", nth)
         new(nth)%id = cards%integer("ID", nth)
         new(nth)%position(:) = cards%reals(["X", "Y"], nth)
         new(nth)%points = cards%integer("NPT", nth)
         new(nth)%interval = cards%real("DT", nth)
         new(nth)%line = cards%line_of("X", nth)
         if (.not. catalogue%mesh_is_sound .or. .not. cards%is_fine("X", nth)) cycle
         if (is_near(mesh, new(nth)%position)) cycle
         call catalogue%refuse(cards, "X", "the place is not on the plate", &
            & "a place within an element", nth)
      end do
      profiles = [profiles, new]
   end subroutine read_database_profile

   !> True when a place lies in or close to an element, judged by the extents of elements
   pure logical function is_near(mesh, place)
      type(mesh_type), intent(in) :: mesh
      !> x and y
      real(wp), intent(in) :: place(2)

      !> Share of the extent by which the edge of a quad may bulge
      real(wp), parameter :: bulge = 0.25_wp
      real(wp) :: high(2), low(2), margin(2)
      integer :: e

      is_near = .true.
      do e = 1, size(mesh%quad_id)
         low(:) = minval(mesh%position(:2, mesh%quad_node(:, e)), dim=2)
         high(:) = maxval(mesh%position(:2, mesh%quad_node(:, e)), dim=2)
         margin(:) = bulge*(high - low)
         if (all(place >= low - margin .and. place <= high + margin)) return
      end do
      is_near = size(mesh%quad_id) == 0
   end function is_near

end module plydyn_input_read_impact
