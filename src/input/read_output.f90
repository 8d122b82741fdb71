!> Readers of output and its intervals.
module plydyn_input_read_output
   use plydyn_base_precision, only : wp
   use plydyn_base_text, only : lower_case, upper_case
   use plydyn_deck_cards, only : cards_type
   use plydyn_deck_values, only : longest_word
   use plydyn_input_catalogue, only : a_node, a_node_set, a_profile, catalogue_type
   use plydyn_law_law, only : shows_dissipated, shows_plastic_strain
   use plydyn_model_control, only : profile_type, request_type
   use plydyn_model_material, only : material_type
   use plydyn_model_mesh, only : mesh_type
   use plydyn_model_model, only : model_type
   implicit none
   private

   public :: read_interval, check_interval, read_restart_cycles, read_database_delam, &
      & read_database_field, read_database_profile, read_database_history_node

contains

   !> *DATABASE_GLSTAT, _IMPACTOR, _FIXTURE, _NODOUT, _SPCFORC: time between two lines of a history;
   !> *DATABASE_BINARY_D3PLOT: time between two field states
   subroutine read_interval(cards, catalogue, model)
      type(cards_type), intent(in) :: cards
      type(catalogue_type), intent(inout) :: catalogue
      type(model_type), intent(inout) :: model

      associate (request => model%request)
         select case (cards%name)
         case ("DATABASE_GLSTAT"); request%energy_interval = cards%real("DT")
         case ("DATABASE_IMPACTOR"); request%impactor_interval = cards%real("DT")
         case ("DATABASE_FIXTURE"); request%fixture_interval = cards%real("DT")
         case ("DATABASE_NODOUT"); request%node_interval = cards%real("DT")
         case ("DATABASE_SPCFORC"); request%support_interval = cards%real("DT")
         case default; request%field_interval = cards%real("DT")
         end select
      end associate
   end subroutine read_interval

   !> Warn of histories of what is not there
   subroutine check_interval(cards, catalogue, model)
      type(cards_type), intent(in) :: cards
      type(catalogue_type), intent(inout) :: catalogue
      type(model_type), intent(inout) :: model

      select case (cards%name)
      case ("DATABASE_IMPACTOR")
         call warn_of_none(size(model%impactors), "impactors", "*IMPACTOR_SPHERE")
      case ("DATABASE_FIXTURE")
         call warn_of_none(size(model%fixtures), "fixtures", "*FIXTURE_PLANE")
      case ("DATABASE_NODOUT")
         call warn_of_none(size(model%request%nodes), "nodes", "nodes in *DATABASE_HISTORY_NODE")
      case ("DATABASE_SPCFORC")
         call warn_of_none(size(model%supports) + size(model%motions) &
            & + size(model%constraints), "supports", "*BOUNDARY_SPC_SET")
      case default
         continue
      end select

   contains

      !> Warn where there are none of them
      subroutine warn_of_none(number, names, remedy)
         integer, intent(in) :: number
         character(*), intent(in) :: names, remedy

         if (number == 0) call catalogue%warn(cards, "DT", "there are no "//names//" to write", &
            & remedy//", or not this keyword")
      end subroutine warn_of_none

   end subroutine check_interval

   !> *DATABASE_BINARY_D3DUMP, *DATABASE_BINARY_RUNRSF: steps between two restart files that are
   !> kept, or that replace older ones
   subroutine read_restart_cycles(cards, catalogue, model)
      type(cards_type), intent(in) :: cards
      type(catalogue_type), intent(inout) :: catalogue
      type(model_type), intent(inout) :: model

      if (cards%name == "DATABASE_BINARY_D3DUMP") then
         model%request%kept_cycles = cards%integer("CYCL")
      else
         model%request%running_cycles = cards%integer("CYCL")
         model%request%running_files = cards%integer("NR")
      end if
   end subroutine read_restart_cycles

   !> *DATABASE_DELAM: time between two lines of the history of delamination
   subroutine read_database_delam(cards, catalogue, model)
      type(cards_type), intent(in) :: cards
      type(catalogue_type), intent(inout) :: catalogue
      type(model_type), intent(inout) :: model

      model%request%delamination_interval = cards%real("DT")
      if (any(model%interface_materials%fails)) return
      call catalogue%refuse(cards, "DT", "no interface of the deck can fail", &
         & "an interface of a material such as *MAT_COHESIVE_MIXED_MODE, or no *DATABASE_DELAM")
   end subroutine read_database_delam

   !> *DATABASE_HISTORY_NODE, *DATABASE_HISTORY_NODE_SET: nodes with a history, or sets of them
   subroutine read_database_history_node(cards, catalogue, model)
      type(cards_type), intent(in) :: cards
      type(catalogue_type), intent(inout) :: catalogue
      type(model_type), intent(inout) :: model

      integer, allocatable :: found(:)
      integer :: i

      if (cards%name == "DATABASE_HISTORY_NODE") then
         call catalogue%find_all(a_node, cards, "ID", found)
         call add_nodes(found, model%request)
         return
      end if
      call catalogue%find_all(a_node_set, cards, "ID", found)
      do i = 1, size(found)
         call add_nodes(catalogue%node_sets(found(i))%list, model%request)
      end do
   end subroutine read_database_history_node

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
   subroutine read_database_field(cards, catalogue, model)
      type(cards_type), intent(in) :: cards
      type(catalogue_type), intent(inout) :: catalogue
      type(model_type), intent(inout) :: model

      character(longest_word), allocatable :: words(:)
      character(len(model%request%fields)) :: name
      integer :: i

      words = cards%words("NAME")
      do i = 1, size(words)
         name = lower_case(words(i))
         if (all(model%request%fields /= name)) model%request%fields = [model%request%fields, name]
         call check_field(cards, name, model%materials, catalogue)
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
         if (any(materials%shows(shows_plastic_strain))) return
         call catalogue%refuse(cards, "NAME", "no material yields: there is no PLASTIC_STRAIN", &
            & "a material that yields, such as *MAT_PLASTIC_KINEMATIC, or not this field")
      case ("damage_fibre", "damage_matrix", "damage_shear")
         if (any(materials%is_damaged())) return
         call catalogue%refuse(cards, "NAME", "no material is damaged: there is no " &
            & //upper_case(name), "a material with damage, such as *MAT_PLY_CODAM2, or not this " &
            & //"field")
      case ("dissipated")
         if (any(materials%shows(shows_dissipated))) return
         call catalogue%refuse(cards, "NAME", "no material dissipates: there is no DISSIPATED", &
            & "a material that yields or is damaged, or not this field")
      case default
         continue
      end select
   end subroutine check_field

   !> *DATABASE_PROFILE: stress through the thickness
   subroutine read_database_profile(cards, catalogue, model)
      type(cards_type), intent(in) :: cards
      type(catalogue_type), intent(inout) :: catalogue
      type(model_type), intent(inout) :: model

      type(profile_type) :: new(cards%sets())
      integer :: nth

      do nth = 1, cards%sets()
         call catalogue%define(a_profile, cards, "ID", nth)
         new(nth)%id = cards%integer("ID", nth)
         new(nth)%position(:) = cards%reals(["X", "Y"], nth)
         new(nth)%points = cards%integer("NPT", nth)
         new(nth)%interval = cards%real("DT", nth)
         if (.not. cards%has("DT", nth)) new(nth)%interval = -1.0_wp
         new(nth)%line = cards%line_of("X", nth)
         if (.not. catalogue%mesh_is_sound .or. .not. cards%is_fine("X", nth)) cycle
         if (is_near(model%mesh, new(nth)%position)) cycle
         call catalogue%refuse(cards, "X", "the place is not on the plate", &
            & "a place within an element", nth)
      end do
      model%request%profiles = [model%request%profiles, new]
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

end module plydyn_input_read_output
