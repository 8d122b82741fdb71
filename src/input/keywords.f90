!> The list of all keywords: one row each, in the order of the manual.
!>
!> A new keyword is a declaration in `declare_….f90`, a reader in `read_….f90`, and its row here.
module plydyn_input_keywords
   use plydyn_deck_declaration, only : keyword_type, extension, standard
   use plydyn_input_declare_load, only : boundary_face, boundary_face_motion, &
      & boundary_prescribed_motion_set, boundary_spc_set, constrained_face_linear, &
      & constrained_linear_global, initial_velocity, initial_velocity_node, load_body, &
      & load_face_line, load_face_point, load_face_pressure, load_node, load_shell_set
   use plydyn_input_declare_control, only : control_energy, control_layerwise, control_parallel, &
      & control_quasi_static, control_stage, control_termination, control_timestep, control_units, &
      & damping_global, damping_relaxation, database_binary_d3dump, database_binary_runrsf, &
      & delete_body, frame_keywords, title
   use plydyn_input_declare_damage, only : mat_codam2, mat_ply_codam2, mat_ply_fracture_3d, &
      & ply_scatter
   use plydyn_input_declare_fixture, only : fixture_bar, fixture_clamp, fixture_plane, &
      & fixture_punch, fixture_ring
   use plydyn_input_declare_impact, only : contact_impactor, database, database_field, &
      & database_history_node, database_history_node_set, database_profile, database_spcforc
   use plydyn_input_declare_impactor, only : impactor_cone, impactor_cylinder, impactor_sphere, &
      & impactor_tup
   use plydyn_input_declare_interface, only : initial_damage, initial_delamination, &
      & interface_cohesive, interface_law, interface_scatter, mat_cohesive_elastic, &
      & mat_cohesive_general, mat_cohesive_mixed_mode
   use plydyn_input_declare_mesh, only : define_box, define_curve, element_plate_q9, &
      & element_shell, node, set_node_general, set_node_list, set_shell_list
   use plydyn_input_declare_metal, only : define_table, define_table_2d, &
      & mat_piecewise_linear_plasticity, mat_plastic_kinematic, mat_simplified_johnson_cook
   use plydyn_input_declare_part, only : mat_elastic, mat_orthotropic_elastic, mat_ply_elastic, &
      & part_composite, part_composite_long, section_layerwise
   use plydyn_input_declare_solid, only : control_hourglass, element_solid, element_solid_ortho, &
      & hourglass, load_segment, part, section_solid
   use plydyn_input_examples, only : add_example
   use plydyn_input_keyword_row, only : for_bricks, for_plates, keyword_list_type, &
      & keyword_row_type, stage_constraint, stage_control, stage_definition, stage_element, &
      & stage_laminate, stage_load, stage_material, stage_output, stage_part, stage_set, &
      & stage_support, stage_table
   use plydyn_input_read_constraint, only : read_constrained_linear
   use plydyn_input_read_control, only : check_control_timestep, read_control_layerwise, &
      & read_control_termination, read_control_timestep, read_control_units, read_plain_control
   use plydyn_input_read_damage, only : read_mat_codam2, read_mat_ply_codam2, read_ply_scatter
   use plydyn_input_read_fixture, only : read_fixture
   use plydyn_input_read_fracture, only : read_mat_ply_fracture_3d
   use plydyn_input_read_impact, only : read_contact_impactor, read_impactor
   use plydyn_input_read_initial, only : read_initial_damage
   use plydyn_input_read_interface, only : read_interface_cohesive, read_interface_law, &
      & read_interface_scatter, read_mat_cohesive_elastic, read_mat_cohesive_general, &
      & read_mat_cohesive_mixed_mode
   use plydyn_input_read_load, only : read_load_body, read_load_face_line, read_load_node, &
      & read_load_pressure
   use plydyn_input_read_material, only : read_mat_elastic, read_mat_orthotropic_elastic
   use plydyn_input_read_mesh, only : read_element_quad, read_node
   use plydyn_input_read_metal, only : read_define_table, read_define_table_2d, &
      & read_mat_piecewise_linear_plasticity, read_mat_plastic_kinematic, &
      & read_mat_simplified_johnson_cook
   use plydyn_input_read_output, only : check_interval, read_database_delam, read_database_field, &
      & read_database_history_node, read_database_profile, read_interval, read_restart_cycles
   use plydyn_input_read_part, only : read_part_composite, read_section_layerwise
   use plydyn_input_read_set, only : read_define_box, read_define_curve, read_set_list, &
      & read_set_node_general
   use plydyn_input_read_solid, only : read_control_hourglass, read_element_solid, &
      & read_hourglass, read_load_segment, read_part_of_bricks, read_section_solid
   use plydyn_input_read_support, only : read_boundary_face, read_boundary_motion, &
      & read_boundary_spc_set, read_initial_velocity, read_initial_velocity_node
   use plydyn_input_unsupported_keywords, only : ignored_keywords, refused_keywords
   implicit none
   private

   public :: all_keywords, all_rows

contains

   !> Rows of all keywords, in the order of the manual
   function all_rows() result(rows)
      type(keyword_row_type), allocatable :: rows(:)

      type(keyword_list_type) :: list

      call add_frame_rows(list)
      call add_mesh_rows(list)
      call add_part_rows(list)
      call add_material_rows(list)
      call add_solid_rows(list)
      call add_interface_rows(list)
      call add_support_rows(list)
      call add_load_rows(list)
      call add_impact_rows(list)
      call add_fixture_rows(list)
      call add_output_rows(list)
      call list%add_unread(ignored_keywords())
      call list%add_unread(refused_keywords())
      rows = list%rows(:list%count)
   end function all_rows

   !> Declarations of all keywords
   function all_keywords() result(keywords)
      type(keyword_type), allocatable :: keywords(:)

      type(keyword_row_type), allocatable :: rows(:)

      integer :: i

      rows = all_rows()
      keywords = rows%declaration
      do i = 1, size(keywords)
         call add_example(keywords(i))
      end do
   end function all_keywords

   !> Title, units, end, time step
   subroutine add_frame_rows(list)
      type(keyword_list_type), intent(inout) :: list

      call list%add_unread(frame_keywords())
      call list%add(title(), read_plain_control, stage_definition)
      call list%add(control_units(), read_control_units, stage_definition)
      call list%add(control_termination(), read_control_termination, stage_control)
      call list%add_unread([control_stage(), delete_body("IMPACTOR", "IID"), &
         & delete_body("FIXTURE", "FID")])
      call list%add(control_timestep(), read_control_timestep, stage_control, &
         & check=check_control_timestep)
      call list%add_unread([control_energy()])
      call list%add(control_parallel(), read_plain_control, stage_control)
      call list%add(control_layerwise(), read_control_layerwise, stage_control)
      call list%add(damping_global(), read_plain_control, stage_control)
      call list%add(damping_relaxation(), read_plain_control, stage_control)
      call list%add(control_quasi_static(), read_plain_control, stage_control)
   end subroutine add_frame_rows

   !> Nodes, elements, sets and curves
   subroutine add_mesh_rows(list)
      type(keyword_list_type), intent(inout) :: list

      call list%add(node(), read_node, stage_definition)
      call list%add(element_shell(), read_element_quad, stage_element, for_plates)
      call list%add(element_plate_q9(), read_element_quad, stage_element, for_plates)
      call list%add(set_node_list(), read_set_list, stage_set)
      call list%add(set_node_general(), read_set_node_general, stage_set)
      call list%add(set_shell_list(), read_set_list, stage_set, for_plates)
      call list%add(define_box(), read_define_box, stage_definition)
      call list%add(define_curve(), read_define_curve, stage_definition)
   end subroutine add_mesh_rows

   !> Laminates
   subroutine add_part_rows(list)
      type(keyword_list_type), intent(inout) :: list

      call list%add(part_composite(), read_part_composite, stage_part, for_plates)
      call list%add(part_composite_long(), read_part_composite, stage_part, for_plates)
      call list%add(section_layerwise(), read_section_layerwise, stage_laminate, for_plates)
   end subroutine add_part_rows

   !> Materials of plies and of metals; the table of a yield curve
   subroutine add_material_rows(list)
      type(keyword_list_type), intent(inout) :: list

      call list%add(mat_elastic(), read_mat_elastic, stage_material)
      call list%add(mat_orthotropic_elastic(), read_mat_orthotropic_elastic, stage_material)
      call list%add(mat_ply_elastic(), read_mat_elastic, stage_material)
      call list%add(mat_plastic_kinematic(), read_mat_plastic_kinematic, stage_material)
      call list%add(mat_piecewise_linear_plasticity(), &
         & read_mat_piecewise_linear_plasticity, stage_material)
      call list%add(mat_simplified_johnson_cook(), read_mat_simplified_johnson_cook, stage_material)
      call list%add(define_table(), read_define_table, stage_table)
      call list%add(define_table_2d(), read_define_table_2d, stage_table)
      call list%add(mat_ply_codam2(), read_mat_ply_codam2, stage_material)
      call list%add(mat_codam2(), read_mat_codam2, stage_material)
      call list%add(mat_ply_fracture_3d(), read_mat_ply_fracture_3d, stage_material)
      call list%add(ply_scatter(), read_ply_scatter, stage_part, for_plates)
   end subroutine add_material_rows

   !> Bricks
   subroutine add_solid_rows(list)
      type(keyword_list_type), intent(inout) :: list

      call list%add(element_solid(), read_element_solid, stage_element)
      call list%add(element_solid_ortho(), read_element_solid, stage_element)
      call list%add(part(), read_part_of_bricks, stage_part, for_bricks)
      call list%add(section_solid(), read_section_solid, stage_definition, for_bricks)
      call list%add(hourglass(), read_hourglass, stage_definition, for_bricks)
      call list%add(control_hourglass(), read_control_hourglass, stage_definition, for_bricks)
      call list%add(load_segment(), read_load_segment, stage_load, for_bricks)
   end subroutine add_solid_rows

   !> Interfaces between plies
   subroutine add_interface_rows(list)
      type(keyword_list_type), intent(inout) :: list

      call list%add(interface_cohesive(), read_interface_cohesive, stage_laminate, for_plates)
      call list%add(interface_law(), read_interface_law, stage_part, for_plates)
      call list%add(interface_scatter(), read_interface_scatter, stage_part, for_plates)
      call list%add(mat_cohesive_elastic(), read_mat_cohesive_elastic, stage_material)
      call list%add(mat_cohesive_mixed_mode(), read_mat_cohesive_mixed_mode, stage_material)
      call list%add(mat_cohesive_general(), read_mat_cohesive_general, stage_material)
      call list%add(initial_delamination(), read_initial_damage, stage_support)
      call list%add(initial_damage(), read_initial_damage, stage_support)
   end subroutine add_interface_rows

   !> Supports, prescribed motions, constraints, initial velocities
   subroutine add_support_rows(list)
      type(keyword_list_type), intent(inout) :: list

      call list%add(boundary_spc_set(), read_boundary_spc_set, stage_support)
      call list%add(boundary_face(), read_boundary_face, stage_support, for_plates)
      call list%add(boundary_prescribed_motion_set(), read_boundary_motion, stage_load)
      call list%add(boundary_face_motion(), read_boundary_motion, stage_load, for_plates)
      call list%add(constrained_linear_global(), read_constrained_linear, stage_constraint)
      call list%add(constrained_face_linear(), read_constrained_linear, stage_constraint, &
         & for_plates)
      call list%add(initial_velocity(), read_initial_velocity, stage_support)
      call list%add(initial_velocity_node(), read_initial_velocity_node, stage_support)
   end subroutine add_support_rows

   !> Forces
   subroutine add_load_rows(list)
      type(keyword_list_type), intent(inout) :: list

      call list%add(load_node("LOAD_NODE_SET", "NSID", "node set"), read_load_node, stage_load)
      call list%add(load_node("LOAD_NODE_POINT", "NID", "node"), read_load_node, stage_load)
      call list%add(load_face_point(), read_load_node, stage_load, for_plates)
      call list%add(load_face_line(), read_load_face_line, stage_load, for_plates)
      call list%add(load_shell_set(), read_load_pressure, stage_load, for_plates)
      call list%add(load_face_pressure(), read_load_pressure, stage_load, for_plates)
      call list%add(load_body("LOAD_BODY_X", "x"), read_load_body, stage_load)
      call list%add(load_body("LOAD_BODY_Y", "y"), read_load_body, stage_load)
      call list%add(load_body("LOAD_BODY_Z", "z"), read_load_body, stage_load)
   end subroutine add_load_rows

   !> Impactors
   subroutine add_impact_rows(list)
      type(keyword_list_type), intent(inout) :: list

      call list%add(impactor_sphere(), read_impactor, stage_part)
      call list%add(impactor_tup(), read_impactor, stage_part)
      call list%add(impactor_cylinder(), read_impactor, stage_part)
      call list%add(impactor_cone(), read_impactor, stage_part)
      call list%add(contact_impactor(), read_contact_impactor, stage_laminate)
   end subroutine add_impact_rows

   !> Rigid bodies that the plate lies on, and clamps
   subroutine add_fixture_rows(list)
      type(keyword_list_type), intent(inout) :: list

      call list%add(fixture_plane(), read_fixture, stage_laminate)
      call list%add(fixture_ring(), read_fixture, stage_laminate)
      call list%add(fixture_punch(), read_fixture, stage_laminate)
      call list%add(fixture_bar(), read_fixture, stage_laminate)
      call list%add(fixture_clamp(), read_fixture, stage_laminate)
   end subroutine add_fixture_rows

   !> Output and its intervals
   subroutine add_output_rows(list)
      type(keyword_list_type), intent(inout) :: list

      call list%add(database("DATABASE_GLSTAT", standard, "energies", "BINARY LCUR IOOPT"), &
         & read_interval, stage_output)
      call list%add(database("DATABASE_NODOUT", standard, "node histories", "BINARY LCUR IOOPT"), &
         & read_interval, stage_output, check=check_interval)
      call list%add(database_spcforc(), read_interval, stage_output, check=check_interval)
      call list%add(database("DATABASE_BINARY_D3PLOT", standard, "field states", &
         & "LCDT BEAM NPLTC PSETID"), &
         & read_interval, stage_output)
      call list%add(database("DATABASE_IMPACTOR", extension, &
         & "lines of the impactor and contact histories", ""), &
         & read_interval, stage_output, check=check_interval)
      call list%add(database("DATABASE_FIXTURE", extension, "lines of the fixture histories", ""), &
         & read_interval, stage_output, check=check_interval)
      call list%add(database_history_node(), read_database_history_node, stage_output)
      call list%add(database_history_node_set(), read_database_history_node, stage_output)
      call list%add(database_field(), read_database_field, stage_output)
      call list%add(database_profile(), read_database_profile, stage_output, for_plates)
      call list%add(database("DATABASE_DELAM", extension, "histories of delamination", ""), &
         & read_database_delam, stage_output, for_plates)
      call list%add(database_binary_d3dump(), read_restart_cycles, stage_output)
      call list%add(database_binary_runrsf(), read_restart_cycles, stage_output)
   end subroutine add_output_rows

end module plydyn_input_keywords
