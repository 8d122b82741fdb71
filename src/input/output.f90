!> Keywords of output and its intervals.
module plydyn_input_output
   use plydyn_base_precision, only : wp
   use plydyn_base_text, only : lower_case, text, upper_case
   use plydyn_deck_declaration, only : extension, standard
   use plydyn_deck_values, only : longest_word
   use plydyn_input_card_visitor, only : card_visitor_type
   use plydyn_input_catalogue, only : a_node, a_node_set, a_profile
   use plydyn_input_keyword_row, only : for_plates, keyword_list_type, stage_output
   use plydyn_law_law, only : shows_dissipated, shows_plastic_strain
   use plydyn_model_control, only : profile_type, request_type
   use plydyn_model_material, only : material_type
   use plydyn_model_mesh, only : mesh_type
   use plydyn_model_model, only : model_type
   implicit none
   private

   public :: add_output

   !> Nodes on a card
   integer, parameter :: list_fields = 8
   !> Most restart files that replace each other
   integer, parameter :: most_files = 99
   !> Names of the fields that can be written
   character(*), parameter :: field_names = &
      & "DISPLACEMENT VELOCITY STRESS STRAIN STRESS_PLY STRAIN_PLY PLASTIC_STRAIN " &
      & //"DAMAGE_FIBRE DAMAGE_MATRIX DAMAGE_SHEAR DISSIPATED"
   !> Heading of the manual on the history of nodes
   character(*), parameter :: of_nodes = "running.md#jobnodescsv"

contains

   !> Add these keywords
   subroutine add_output(list)
      type(keyword_list_type), intent(inout) :: list

      call list%add("DATABASE_GLSTAT", interval, stage_output, check=check_interval)
      call list%add("DATABASE_NODOUT", interval, stage_output, check=check_interval)
      call list%add("DATABASE_SPCFORC", interval, stage_output, check=check_interval)
      call list%add("DATABASE_BINARY_D3PLOT", database_binary_d3plot, stage_output, &
         & check=check_interval)
      call list%add("DATABASE_IMPACTOR", interval, stage_output, check=check_interval)
      call list%add("DATABASE_FIXTURE", interval, stage_output, check=check_interval)
      call list%add("DATABASE_HISTORY_NODE", database_history_node, stage_output)
      call list%add("DATABASE_HISTORY_NODE_SET", database_history_node, stage_output)
      call list%add("DATABASE_FIELD", database_field, stage_output)
      call list%add("DATABASE_PROFILE", database_profile, stage_output, for_plates)
      call list%add("DATABASE_DELAM", interval, stage_output, for_plates, check=check_interval)
      call list%add("DATABASE_BINARY_D3DUMP", database_binary_d3dump, stage_output)
      call list%add("DATABASE_BINARY_RUNRSF", database_binary_runrsf, stage_output)
   end subroutine add_output

   !> Time between two lines of a history
   subroutine interval(card, model)
      class(card_visitor_type), intent(inout) :: card
      type(model_type), intent(inout) :: model

      associate (request => model%request)
         select case (card%name)
         case ("DATABASE_GLSTAT")
            call visit_interval(card, standard, "energies", "energy history", &
               & request%energy_interval)
            call card%example("12-the-energy-balance", "1.0e-6")
         case ("DATABASE_NODOUT")
            call visit_interval(card, standard, "node histories", "node histories", &
               & request%node_interval)
            call card%example(of_nodes, "1.0e-6")
         case ("DATABASE_SPCFORC")
            call visit_interval(card, standard, "support forces", "support forces", &
               & request%support_interval)
            call card%remark("`JOB.supports.csv` has the force of all supports and prescribed " &
               & //"motions together, and that of each by its keyword and node set, as in `spc 3 " &
               & //"fx` or `motion 2 fx`: also what LS-DYNA writes to BNDOUT. Where several " &
               & //"supports hold a point in one direction, the first in the deck has its force.")
            call card%example("8-supports-motions-and-loads", "1.0e-6")
         case ("DATABASE_IMPACTOR")
            call visit_interval(card, extension, "lines of the impactor and contact histories", &
               & "impactor histories", request%impactor_interval)
            call card%example("11-contact", "1.0e-6")
         case ("DATABASE_FIXTURE")
            call visit_interval(card, extension, "lines of the fixture histories", &
               & "fixture histories", request%fixture_interval)
            call card%example("fixtures", "1.0e-6")
         case default ! *DATABASE_DELAM
            call visit_interval(card, extension, "histories of delamination", &
               & "delamination history", request%delamination_interval)
            call card%example("71-the-law-of-an-interface-that-fails", "1.0e-6")
         end select
      end associate
   end subroutine interval

   !> The time between two lines, and the other fields of histories that LS-DYNA has, too
   subroutine visit_interval(card, own, what, change, dt)
      class(card_visitor_type), intent(inout) :: card
      !> `extension` or `standard`
      logical, intent(in) :: own
      !> What is written, in the manual and among the changes of a restart
      character(*), intent(in) :: what, change
      real(wp), intent(inout) :: dt

      call card%keyword(own, "Time between two "//what//".", once=.true., change=change)
      call card%real("DT", "time", "time between two "//what//"; 0 for every step", dt, &
         & least=0.0_wp)
      if (own .eqv. extension) return
      call card%unused("BINARY", neutral=[0.0_wp, 1.0_wp, 2.0_wp, 3.0_wp])
      call card%unused("LCUR")
      call card%unused("IOOPT", neutral=[0.0_wp, 1.0_wp])
      call card%unused("OPTION1 OPTION2 OPTION3 OPTION4")
   end subroutine visit_interval

   !> Time between two field states
   subroutine database_binary_d3plot(card, model)
      class(card_visitor_type), intent(inout) :: card
      type(model_type), intent(inout) :: model

      call card%keyword(standard, "Time between two field states.", once=.true., change="fields")
      call card%example("running.md#jobvtkhdf", "2.0e-5")
      call card%positive("DT", "time", "time between two field states", &
         & model%request%field_interval)
      call card%unused("LCDT BEAM NPLTC PSETID")
      call card%card(optional=.true.)
      call card%unused("IOOPT RATE CUTOFF WINDOW TYPE PSET")
   end subroutine database_binary_d3plot

   !> Warn of a time that is longer than the run
   subroutine check_length(card, end_time)
      class(card_visitor_type), intent(inout) :: card
      !> That of the run
      real(wp), intent(in) :: end_time

      real(wp) :: length

      ! the end of an old deck may be another by now
      if (card%line_of("DT") <= card%catalogue%stored_lines) return
      length = end_time - card%catalogue%start(card%root)
      if (length > 0.0_wp .and. card%number("DT") > length) call card%warn("DT", "the run, of " &
         & //text(length)//", is shorter: nothing is written between its start and its end", &
         & "a time below that, in the unit of ENDTIM")
   end subroutine check_length

   !> Warn of intervals beyond the run and of histories of what is not there; refuse that of
   !> delamination
   subroutine check_interval(card, model)
      class(card_visitor_type), intent(inout) :: card
      type(model_type), intent(inout) :: model

      call check_length(card, model%control%end_time)
      select case (card%name)
      case ("DATABASE_GLSTAT", "DATABASE_BINARY_D3PLOT")
         continue
      case ("DATABASE_IMPACTOR")
         call warn_of_none(size(model%impactors), "impactors", "*IMPACTOR_SPHERE")
      case ("DATABASE_FIXTURE")
         call warn_of_none(size(model%fixtures), "fixtures", "*FIXTURE_PLANE")
      case ("DATABASE_NODOUT")
         call warn_of_none(size(model%request%nodes), "nodes", "nodes in *DATABASE_HISTORY_NODE")
      case ("DATABASE_SPCFORC")
         call warn_of_none(size(model%supports) + size(model%motions) &
            & + size(model%constraints), "supports", "*BOUNDARY_SPC_SET")
      case default ! *DATABASE_DELAM
         if (any(model%interface_materials%fails) .or. size(model%crack_zones) > 0) return
         call card%refuse("DT", "no interface of " &
            & //"the deck can fail", "an interface of a material such as " &
            & //"*MAT_COHESIVE_MIXED_MODE, or no *DATABASE_DELAM")
      end select

   contains

      !> Warn where there are none of them
      subroutine warn_of_none(number, names, remedy)
         integer, intent(in) :: number
         character(*), intent(in) :: names, remedy

         ! a stage may have removed what an old deck has
         if (card%line_of("DT") <= card%catalogue%stored_lines) return
         if (number == 0) call card%warn("DT", "there are no "//names//" to write", &
            & remedy//", or not this keyword")
      end subroutine warn_of_none

   end subroutine check_interval

   !> Nodes with a history, or sets of them
   subroutine database_history_node(card, model)
      class(card_visitor_type), intent(inout) :: card
      type(model_type), intent(inout) :: model

      integer, allocatable :: list(:)
      integer :: i
      logical :: lists_sets

      lists_sets = card%name == "DATABASE_HISTORY_NODE_SET"
      if (lists_sets) then
         call card%keyword(standard, "Sets of nodes whose history is written.")
         call card%example(of_nodes, "2")
      else
         call card%keyword(standard, "Nodes whose history is written.")
         call card%example(of_nodes, "8, 13")
      end if
      call card%card(repeated=.true.)
      call card%list(merge(a_node_set, a_node, lists_sets), "ID", list_fields, &
         & trim(merge("node set", "node    ", lists_sets)), list)
      if (.not. card%reads) return
      if (.not. lists_sets) call add_nodes(list, model%request)
      do i = 1, merge(size(list), 0, lists_sets)
         call add_nodes(card%catalogue%node_sets(list(i))%list, model%request)
      end do
   end subroutine database_history_node

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

   !> Fields of the field states
   subroutine database_field(card, model)
      class(card_visitor_type), intent(inout) :: card
      type(model_type), intent(inout) :: model

      character(longest_word), allocatable :: words(:)
      character(len(model%request%fields)) :: name
      integer :: i

      call card%keyword(extension, "Which fields the field states hold.")
      call card%remark("Names with blanks or commas between them, any number of lines. Without " &
         & //"the keyword: displacement, velocity and stress, and where a ply is damaged " &
         & //"DAMAGE_FIBRE, DAMAGE_MATRIX and DAMAGE_SHEAR, all from 0 to 1. PLASTIC_STRAIN, the " &
         & //"effective plastic strain, needs a material that yields; DISSIPATED is energy per " &
         & //"volume.")
      call card%example("13-recovery-of-strain-and-stress", "displacement stress")
      do while (card%next())
         call card%words("NAME", "name of a field", words, field_names)
         if (.not. card%reads) cycle
         do i = 1, size(words)
            name = lower_case(words(i))
            if (all(model%request%fields /= name)) model%request%fields = &
               & [model%request%fields, name]
            call check_field(card, name, model%materials)
         end do
      end do
   end subroutine database_field

   !> A field that no material has
   subroutine check_field(card, name, materials)
      class(card_visitor_type), intent(inout) :: card
      character(*), intent(in) :: name
      type(material_type), intent(in) :: materials(:)

      select case (name)
      case ("plastic_strain")
         if (.not. any(materials%shows(shows_plastic_strain))) call card%refuse("NAME", &
            & "no material yields: there is no PLASTIC_STRAIN", "a material that yields, such as " &
            & //"*MAT_PLASTIC_KINEMATIC, or not this field")
      case ("damage_fibre", "damage_matrix", "damage_shear")
         if (.not. any(materials%is_damaged())) call card%refuse("NAME", "no material is " &
            & //"damaged: there is no "//upper_case(name), "a material with damage, such as " &
            & //"*MAT_PLY_CODAM2, or not this field")
      case ("dissipated")
         if (.not. any(materials%shows(shows_dissipated))) call card%refuse("NAME", "no material " &
            & //"dissipates: there is no DISSIPATED", "a material that yields or is damaged, or " &
            & //"not this field")
      case default
         continue
      end select
   end subroutine check_field

   !> Stress through the thickness
   subroutine database_profile(card, model)
      class(card_visitor_type), intent(inout) :: card
      type(model_type), intent(inout) :: model

      type(profile_type) :: profile

      call card%keyword(extension, "Displacement, strain and stress through the thickness at a " &
         & //"place of the plate.")
      call card%example("13-recovery-of-strain-and-stress", "1, 20.0, 20.0, 5, 1.0e-5")
      do while (card%next())
         call card%define(a_profile, "ID", "number of the profile", profile%id)
         call card%real("X", "length", "x of the place", profile%position(1))
         call card%real("Y", "length", "y of the place", profile%position(2))
         call card%integer("NPT", "points in each numerical layer, its faces included", &
            & profile%points, default=5, least=2, most=100)
         call card%nonnegative("DT", "time", "time between two profiles; blank for a hundred in " &
            & //"the run, 0 for every step", profile%interval)
         if (.not. card%reads) cycle
         if (.not. card%has("DT")) profile%interval = -1.0_wp
         call check_length(card, model%control%end_time)
         profile%line = card%line_of("X")
         model%request%profiles = [model%request%profiles, profile]
         if (.not. card%catalogue%mesh_is_sound .or. .not. card%is_fine("X")) cycle
         if (.not. is_near(model%mesh, profile%position)) call card%refuse("X", "the place is " &
            & //"not on the plate", "a place within an element")
      end do
   end subroutine database_profile

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

   !> Restart files that are kept
   subroutine database_binary_d3dump(card, model)
      class(card_visitor_type), intent(inout) :: card
      type(model_type), intent(inout) :: model

      call card%keyword(standard, "Restart files that are kept.", once=.true., &
         & change="restart files kept")
      call card%remark("The files are JOB.dump01, JOB.dump02 and so on; there is one more at the " &
         & //"normal end. A run that is asked to stop writes the next one, with or without the " &
         & //"keyword.")
      call card%example("running.md#restarting", "10000")
      call card%integer("CYCL", "steps between two files", model%request%kept_cycles, least=1)
      call card%unused("LCDT BEAM NPLTC PSETID CID")
   end subroutine database_binary_d3dump

   !> Restart files that replace each other
   subroutine database_binary_runrsf(card, model)
      class(card_visitor_type), intent(inout) :: card
      type(model_type), intent(inout) :: model

      call card%keyword(standard, "Restart files that replace each other.", once=.true., &
         & change="restart files replaced")
      call card%remark("The file is JOB.runrsf, or JOB.runrsf1 to JOB.runrsfNR in turn. A new " &
         & //"file replaces the old one only when it is complete, so that there is a complete " &
         & //"file whenever the run is killed.")
      call card%example("running.md#restarting", "5000")
      call card%integer("CYCL", "steps between two files", model%request%running_cycles, least=1)
      call card%integer("NR", "how many files there are, the oldest is replaced", &
         & model%request%running_files, default=1, least=1, most=most_files)
      call card%zero_is_default()
      call card%unused("BEAM NPLTC PSETID CID")
   end subroutine database_binary_runrsf

end module plydyn_input_output
