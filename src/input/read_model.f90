!> From a deck to a model: every keyword has one reader, and what it refers to is read before it.
module plydyn_input_read_model
   use plydyn_base_archive, only : archive_type
   use plydyn_base_error, only : error_type
   use plydyn_deck_cards, only : cards_type
   use plydyn_deck_deck, only : conclude, deck_type, read_decks
   use plydyn_input_catalogue, only : catalogue_type, new_catalogue
   use plydyn_input_changes, only : apply_changes, changes_of
   use plydyn_input_check_model, only : check_model
   use plydyn_input_check_solid, only : refuse_for_bricks
   use plydyn_input_defaults, only : begin_model, end_model
   use plydyn_input_keywords, only : all_keywords
   use plydyn_input_manual, only : keyword_manual
   use plydyn_input_read_control, only : read_control_layerwise, read_control_parallel, &
      & read_control_termination, read_control_timestep, read_control_units
   use plydyn_input_read_damage, only : read_mat_ply_codam2
   use plydyn_input_read_impact, only : read_contact_impactor, read_database_field, &
      & read_database_history_node, read_database_history_node_set, read_database_profile, &
      & read_impactor_sphere
   use plydyn_input_read_initial, only : read_initial_damage
   use plydyn_input_read_interface, only : read_database_delam, read_interface_cohesive, &
      & read_mat_cohesive_elastic, read_mat_cohesive_general, read_mat_cohesive_mixed_mode
   use plydyn_input_read_load, only : read_load_body, read_load_face_line, read_load_face_point, &
      & read_load_face_pressure, read_load_node_point, read_load_node_set, read_load_shell_set
   use plydyn_input_read_material, only : read_mat_elastic, &
      & read_mat_orthotropic_elastic, read_mat_ply_elastic
   use plydyn_input_read_metal, only : read_define_table, read_define_table_2d, &
      & read_mat_piecewise_linear_plasticity, read_mat_plastic_kinematic, &
      & read_mat_simplified_johnson_cook
   use plydyn_input_read_mesh, only : read_element_plate_q9, read_element_shell, read_node
   use plydyn_input_read_part, only : read_part_composite, &
      & read_part_composite_long, read_section_layerwise
   use plydyn_input_read_set, only : read_define_box, read_define_curve, read_set_node_general, &
      & read_set_node_list, read_set_shell_list
   use plydyn_input_read_solid, only : read_control_hourglass, read_element_solid, &
      & read_hourglass, read_load_segment, read_part_of_bricks, read_section_solid
   use plydyn_input_read_support, only : read_boundary_face, read_boundary_face_motion, &
      & read_boundary_prescribed_motion_set, read_boundary_spc_set, read_initial_velocity, &
      & read_initial_velocity_node
   use plydyn_model_model, only : model_type
   implicit none
   private

   public :: read_decks_of_run, read_model, keyword_manual

   abstract interface
      !> Take the cards of one keyword into the model, if the keyword is one of the stage
      subroutine stage(cards, catalogue, model)
         import :: cards_type, catalogue_type, model_type
         implicit none
         !> The keyword
         type(cards_type), intent(in) :: cards
         !> Numbers of everything so far; gets new ones, and findings
         type(catalogue_type), intent(inout) :: catalogue
         !> The model
         type(model_type), intent(inout) :: model
      end subroutine stage
   end interface

contains

   !> Read a deck and check it
   subroutine read_model(path, model, messages, error)
      !> Path of the deck
      character(*), intent(in) :: path
      !> The model
      type(model_type), intent(out) :: model
      !> Warnings and notes for the listing, empty without any
      character(:), allocatable, intent(out) :: messages
      !> Everything that is wrong with the deck, in one text
      type(error_type), allocatable, intent(out) :: error

      type(archive_type) :: archive

      allocate (archive%bundles(0))
      archive%parameters = ""
      call read_decks_of_run(archive, path, model, messages, error)
   end subroutine read_model

   !> Read the stored decks of a run, and one that begins or changes it
   subroutine read_decks_of_run(archive, path, model, messages, error)
      !> The decks so far, and numbers for parameters; gets the files of the new one
      type(archive_type), intent(inout) :: archive
      !> Path of the new deck, empty for none
      character(*), intent(in) :: path
      !> The model
      type(model_type), intent(out) :: model
      !> Warnings and notes for the listing, empty without any
      character(:), allocatable, intent(out) :: messages
      !> Everything that is wrong with the decks, in one text
      type(error_type), allocatable, intent(out) :: error

      type(catalogue_type) :: catalogue
      type(deck_type) :: deck

      catalogue = new_catalogue()
      call read_decks(archive, path, all_keywords(), deck, catalogue%report)
      call apply_changes(deck, catalogue)
      call begin_model(model)
      if (len(path) > 0) model%changes = changes_of(deck)
      call read_stage(deck, read_independent, catalogue, model)
      call read_stage(deck, read_table, catalogue, model)
      call read_stage(deck, read_material, catalogue, model)
      call read_stage(deck, read_part, catalogue, model)
      call read_stage(deck, read_element, catalogue, model)
      call read_stage(deck, check_elements, catalogue, model)
      call read_stage(deck, read_set, catalogue, model)
      call read_stage(deck, read_laminate, catalogue, model)
      call read_stage(deck, read_support, catalogue, model)
      call read_stage(deck, read_load, catalogue, model)
      call read_stage(deck, read_run, catalogue, model)
      call end_model(deck, model)
      call check_model(model, catalogue)
      call conclude(deck, catalogue%report, messages, error)
      if (len(path) > 0) call archive%add_bundle(deck%source%bundle(size(archive%bundles) + 1))
   end subroutine read_decks_of_run

   !> Let one stage see all keywords of the deck in their order
   subroutine read_stage(deck, take, catalogue, model)
      !> The deck
      type(deck_type), intent(in) :: deck
      !> The stage
      procedure(stage) :: take
      !> Numbers of everything so far
      type(catalogue_type), intent(inout) :: catalogue
      !> The model
      type(model_type), intent(inout) :: model

      integer :: i

      do i = 1, size(deck%keywords)
         call take(deck%keywords(i), catalogue, model)
      end do
   end subroutine read_stage

   !> Keywords that refer to nothing
   subroutine read_independent(cards, catalogue, model)
      type(cards_type), intent(in) :: cards
      type(catalogue_type), intent(inout) :: catalogue
      type(model_type), intent(inout) :: model

      select case (cards%name)
      case ("TITLE")
         model%title = cards%word("TITLE")
      case ("CONTROL_UNITS")
         call read_control_units(cards, model%control%units)
      case ("NODE")
         call read_node(cards, catalogue, model%mesh)
      case ("DEFINE_CURVE")
         call read_define_curve(cards, catalogue, model%curves)
      case ("SECTION_SOLID")
         call read_section_solid(cards, catalogue)
      case ("HOURGLASS")
         call read_hourglass(cards, catalogue)
      case ("CONTROL_HOURGLASS")
         call read_control_hourglass(cards, catalogue%usual_hourglass)
      case ("DEFINE_BOX")
         call read_define_box(cards, catalogue)
      case ("MAT_ELASTIC")
         call read_mat_elastic(cards, catalogue, model%materials)
      case ("MAT_PLASTIC_KINEMATIC")
         call read_mat_plastic_kinematic(cards, catalogue, model%materials)
      case ("MAT_SIMPLIFIED_JOHNSON_COOK")
         call read_mat_simplified_johnson_cook(cards, catalogue, model%materials)
      case ("MAT_ORTHOTROPIC_ELASTIC")
         call read_mat_orthotropic_elastic(cards, catalogue, model%materials)
      case ("MAT_PLY_ELASTIC")
         call read_mat_ply_elastic(cards, catalogue, model%materials)
      case ("MAT_COHESIVE_ELASTIC")
         call read_mat_cohesive_elastic(cards, catalogue, model%interface_materials)
      case ("MAT_COHESIVE_MIXED_MODE")
         call read_mat_cohesive_mixed_mode(cards, catalogue, model%interface_materials)
      case ("IMPACTOR_SPHERE")
         call read_impactor_sphere(cards, catalogue, model%impactors)
      case default
         continue
      end select
   end subroutine read_independent

   !> Keywords that refer to curves
   subroutine read_table(cards, catalogue, model)
      type(cards_type), intent(in) :: cards
      type(catalogue_type), intent(inout) :: catalogue
      type(model_type), intent(inout) :: model

      select case (cards%name)
      case ("DEFINE_TABLE")
         call read_define_table(cards, catalogue, size(model%curves))
      case ("DEFINE_TABLE_2D")
         call read_define_table_2d(cards, catalogue)
      case default
         continue
      end select
   end subroutine read_table

   !> Materials that refer to curves and tables
   subroutine read_material(cards, catalogue, model)
      type(cards_type), intent(in) :: cards
      type(catalogue_type), intent(inout) :: catalogue
      type(model_type), intent(inout) :: model

      select case (cards%name)
      case ("MAT_PIECEWISE_LINEAR_PLASTICITY")
         call read_mat_piecewise_linear_plasticity(cards, catalogue, model%curves, model%materials)
      case ("MAT_COHESIVE_GENERAL")
         call read_mat_cohesive_general(cards, catalogue, model%curves, model%interface_materials)
      case ("MAT_PLY_CODAM2")
         call read_mat_ply_codam2(cards, catalogue, model%curves, model%materials)
      case default
         continue
      end select
   end subroutine read_material

   !> Keywords that refer to materials
   subroutine read_part(cards, catalogue, model)
      type(cards_type), intent(in) :: cards
      type(catalogue_type), intent(inout) :: catalogue
      type(model_type), intent(inout) :: model

      select case (cards%name)
      case ("PART")
         call read_part_of_bricks(cards, catalogue, model%materials, model%parts)
      case ("PART_COMPOSITE")
         call read_part_composite(cards, catalogue, model%materials, model%parts)
      case ("PART_COMPOSITE_LONG")
         call read_part_composite_long(cards, catalogue, model%materials, model%parts)
      case default
         continue
      end select
   end subroutine read_part

   !> Keywords that refer to nodes and parts
   subroutine read_element(cards, catalogue, model)
      type(cards_type), intent(in) :: cards
      type(catalogue_type), intent(inout) :: catalogue
      type(model_type), intent(inout) :: model

      select case (cards%name)
      case ("ELEMENT_SHELL")
         call read_element_shell(cards, catalogue, model%mesh)
      case ("ELEMENT_PLATE_Q9")
         call read_element_plate_q9(cards, catalogue, model%mesh)
      case ("ELEMENT_SOLID")
         call read_element_solid(cards, catalogue, model%mesh)
      case default
         continue
      end select
   end subroutine read_element

   !> Keywords that do not go with the elements of the deck
   subroutine check_elements(cards, catalogue, model)
      type(cards_type), intent(in) :: cards
      type(catalogue_type), intent(inout) :: catalogue
      type(model_type), intent(inout) :: model

      call refuse_for_bricks(cards%name, cards%head(), model%mesh, catalogue%report)
   end subroutine check_elements

   !> Keywords that refer to nodes and elements by their numbers
   subroutine read_set(cards, catalogue, model)
      type(cards_type), intent(in) :: cards
      type(catalogue_type), intent(inout) :: catalogue
      type(model_type), intent(inout) :: model

      select case (cards%name)
      case ("SET_NODE_LIST")
         call read_set_node_list(cards, catalogue)
      case ("SET_NODE_GENERAL")
         call read_set_node_general(cards, catalogue, model%mesh)
      case ("SET_SHELL_LIST")
         call read_set_shell_list(cards, catalogue)
      case default
         continue
      end select
   end subroutine read_set

   !> Keywords that refer to plies
   subroutine read_laminate(cards, catalogue, model)
      type(cards_type), intent(in) :: cards
      type(catalogue_type), intent(inout) :: catalogue
      type(model_type), intent(inout) :: model

      select case (cards%name)
      case ("SECTION_LAYERWISE")
         call read_section_layerwise(cards, catalogue, model%mesh, model%parts)
      case ("INTERFACE_COHESIVE")
         call read_interface_cohesive(cards, catalogue, model%interface_materials, model%parts)
      case ("CONTACT_IMPACTOR")
         call read_contact_impactor(cards, catalogue, model%contacts)
      case default
         continue
      end select
   end subroutine read_laminate

   !> Keywords that hold the plate, and how it starts
   subroutine read_support(cards, catalogue, model)
      type(cards_type), intent(in) :: cards
      type(catalogue_type), intent(inout) :: catalogue
      type(model_type), intent(inout) :: model

      select case (cards%name)
      case ("BOUNDARY_SPC_SET")
         call read_boundary_spc_set(cards, catalogue, model%holds)
      case ("BOUNDARY_FACE")
         call read_boundary_face(cards, catalogue, model%holds)
      case ("INITIAL_DELAMINATION", "INITIAL_DAMAGE")
         call read_initial_damage(cards, catalogue, model)
      case ("INITIAL_VELOCITY")
         call read_initial_velocity(cards, catalogue, size(model%mesh%node_id), &
            & model%initial_velocities)
      case ("INITIAL_VELOCITY_NODE")
         call read_initial_velocity_node(cards, catalogue, model%initial_velocities)
      case default
         continue
      end select
   end subroutine read_support

   !> Keywords that move or load the plate
   subroutine read_load(cards, catalogue, model)
      type(cards_type), intent(in) :: cards
      type(catalogue_type), intent(inout) :: catalogue
      type(model_type), intent(inout) :: model

      select case (cards%name)
      case ("BOUNDARY_PRESCRIBED_MOTION_SET")
         call read_boundary_prescribed_motion_set(cards, catalogue, model%holds, model%motions)
      case ("BOUNDARY_FACE_MOTION")
         call read_boundary_face_motion(cards, catalogue, model%curves, model%holds, model%motions)
      case ("LOAD_NODE_SET")
         call read_load_node_set(cards, catalogue, model%point_loads)
      case ("LOAD_NODE_POINT")
         call read_load_node_point(cards, catalogue, model%point_loads)
      case ("LOAD_FACE_POINT")
         call read_load_face_point(cards, catalogue, model%curves, model%point_loads)
      case ("LOAD_FACE_LINE")
         call read_load_face_line(cards, catalogue, model%mesh, model%curves, model%line_loads)
      case ("LOAD_SHELL_SET")
         call read_load_shell_set(cards, catalogue, model%pressures)
      case ("LOAD_FACE_PRESSURE")
         call read_load_face_pressure(cards, catalogue, size(model%mesh%quad_id), model%curves, &
            & model%pressures)
      case ("LOAD_SEGMENT")
         call read_load_segment(cards, catalogue, model%segment_loads)
      case ("LOAD_BODY_X")
         call read_load_body(cards, 1, catalogue, model%body_loads)
      case ("LOAD_BODY_Y")
         call read_load_body(cards, 2, catalogue, model%body_loads)
      case ("LOAD_BODY_Z")
         call read_load_body(cards, 3, catalogue, model%body_loads)
      case default
         continue
      end select
   end subroutine read_load

   !> Keywords that say how to run and what to write
   subroutine read_run(cards, catalogue, model)
      type(cards_type), intent(in) :: cards
      type(catalogue_type), intent(inout) :: catalogue
      type(model_type), intent(inout) :: model

      select case (cards%name)
      case ("CONTROL_TERMINATION")
         call read_control_termination(cards, catalogue%report, model%control)
      case ("CONTROL_TIMESTEP")
         call read_control_timestep(cards, catalogue, model%curves, model%control)
      case ("CONTROL_PARALLEL")
         call read_control_parallel(cards, model%control)
      case ("CONTROL_LAYERWISE")
         call read_control_layerwise(cards, model%control)
      case ("DAMPING_GLOBAL")
         model%control%damping = cards%real("VALDMP")
      case ("DATABASE_GLSTAT")
         model%request%energy_interval = cards%real("DT")
      case ("DATABASE_IMPACTOR")
         model%request%impactor_interval = cards%real("DT")
      case ("DATABASE_DELAM")
         call read_database_delam(cards, catalogue, model%interface_materials, model%request)
      case ("DATABASE_NODOUT")
         model%request%node_interval = cards%real("DT")
      case ("DATABASE_SPCFORC")
         model%request%support_interval = cards%real("DT")
      case ("DATABASE_BINARY_D3PLOT")
         model%request%field_interval = cards%real("DT")
      case ("DATABASE_BINARY_D3DUMP")
         model%request%kept_cycles = cards%integer("CYCL")
      case ("DATABASE_BINARY_RUNRSF")
         model%request%running_cycles = cards%integer("CYCL")
         model%request%running_files = cards%integer("NR")
      case ("DATABASE_FIELD")
         call read_database_field(cards, catalogue, model%materials, model%request)
      case ("DATABASE_PROFILE")
         call read_database_profile(cards, catalogue, model%mesh, model%request%profiles)
      case ("DATABASE_HISTORY_NODE")
         call read_database_history_node(cards, catalogue, model%request)
      case ("DATABASE_HISTORY_NODE_SET")
         call read_database_history_node_set(cards, catalogue, model%request)
      case default
         continue
      end select
   end subroutine read_run

end module plydyn_input_read_model
