!> What happens to a plate and what is written about it, in stages that follow those of the plate.
!> A stage takes the cards of one keyword into the model, if the keyword is one of its own.
module plydyn_input_run_readers
   use plydyn_deck_cards, only : cards_type
   use plydyn_input_catalogue, only : catalogue_type
   use plydyn_input_read_control, only : read_control_layerwise, read_control_parallel, &
      & read_control_termination, read_control_timestep
   use plydyn_input_read_impact, only : read_database_field, read_database_history_node, &
      & read_database_history_node_set, read_database_profile
   use plydyn_input_read_initial, only : read_initial_damage
   use plydyn_input_read_interface, only : read_database_delam
   use plydyn_input_read_load, only : read_load_body, read_load_face_line, read_load_face_point, &
      & read_load_face_pressure, read_load_node_point, read_load_node_set, read_load_shell_set
   use plydyn_input_read_solid, only : read_load_segment
   use plydyn_input_read_support, only : read_boundary_face, read_boundary_face_motion, &
      & read_boundary_prescribed_motion_set, read_boundary_spc_set, read_initial_velocity, &
      & read_initial_velocity_node
   use plydyn_model_model, only : model_type
   implicit none
   private

   public :: read_support, read_load, read_control, read_request, check_request

contains

   !> Keywords that hold the plate, and how it starts
   subroutine read_support(cards, catalogue, model)
      type(cards_type), intent(in) :: cards
      type(catalogue_type), intent(inout) :: catalogue
      type(model_type), intent(inout) :: model

      select case (cards%name)
      case ("BOUNDARY_SPC_SET")
         call read_boundary_spc_set(cards, catalogue, model%holds)
      case ("BOUNDARY_FACE")
         call read_boundary_face(cards, catalogue, model%parts, model%holds)
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
         call read_boundary_prescribed_motion_set(cards, catalogue, model%curves, model%holds, &
            & model%motions)
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

   !> Keywords that say how to run
   subroutine read_control(cards, catalogue, model)
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
         call read_control_layerwise(cards, catalogue, model)
      case ("DAMPING_GLOBAL")
         model%control%damping = cards%real("VALDMP")
      case default
         continue
      end select
   end subroutine read_control

   !> Keywords that say what to write
   subroutine read_request(cards, catalogue, model)
      type(cards_type), intent(in) :: cards
      type(catalogue_type), intent(inout) :: catalogue
      type(model_type), intent(inout) :: model

      select case (cards%name)
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
   end subroutine read_request

   !> What is to be written is there
   subroutine check_request(cards, catalogue, model)
      type(cards_type), intent(in) :: cards
      type(catalogue_type), intent(inout) :: catalogue
      type(model_type), intent(inout) :: model

      if (catalogue%report%has_errors()) return
      select case (cards%name)
      case ("DATABASE_NODOUT")
         if (size(model%request%nodes) == 0) call catalogue%warn(cards, "DT", &
            & "there are no nodes to write", "nodes in *DATABASE_HISTORY_NODE, or not this keyword")
      case ("DATABASE_IMPACTOR")
         if (size(model%impactors) == 0) call catalogue%warn(cards, "DT", &
            & "there are no impactors to write", "*IMPACTOR_SPHERE, or not this keyword")
      case ("DATABASE_SPCFORC")
         if (size(model%holds) + size(model%motions) == 0) call catalogue%warn(cards, "DT", &
            & "there are no supports to write", "*BOUNDARY_SPC_SET, or not this keyword")
      case default
         continue
      end select
   end subroutine check_request

end module plydyn_input_run_readers
