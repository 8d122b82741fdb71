!> What a plate or a body is made of, in stages: each refers to what stages before it have read.
!> A stage takes the cards of one keyword into the model, if the keyword is one of its own.
module plydyn_input_model_readers
   use plydyn_deck_cards, only : cards_type
   use plydyn_input_catalogue, only : catalogue_type
   use plydyn_input_check_solid, only : refuse_for_bricks
   use plydyn_input_read_control, only : read_control_units
   use plydyn_input_read_damage, only : read_mat_codam2, read_mat_ply_codam2
   use plydyn_input_read_impact, only : read_contact_impactor, read_impactor_sphere
   use plydyn_input_read_interface, only : read_interface_cohesive, read_mat_cohesive_elastic, &
      & read_mat_cohesive_general, read_mat_cohesive_mixed_mode
   use plydyn_input_read_material, only : read_mat_elastic, read_mat_orthotropic_elastic, &
      & read_mat_ply_elastic
   use plydyn_input_read_metal, only : read_define_table, read_define_table_2d, &
      & read_mat_piecewise_linear_plasticity, read_mat_plastic_kinematic, &
      & read_mat_simplified_johnson_cook
   use plydyn_input_read_mesh, only : read_element_plate_q9, read_element_shell, read_node
   use plydyn_input_read_part, only : read_part_composite, read_part_composite_long, &
      & read_section_layerwise
   use plydyn_input_read_set, only : read_define_box, read_define_curve, read_set_node_general, &
      & read_set_node_list, read_set_shell_list
   use plydyn_input_read_solid, only : read_control_hourglass, read_element_solid, read_hourglass, &
      & read_part_of_bricks, read_section_solid
   use plydyn_model_model, only : model_type
   implicit none
   private

   public :: read_independent, read_plain_material, read_table, read_material, read_part, &
      & read_element, check_elements, read_set, read_laminate

contains

   !> Keywords that refer to nothing, but materials
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
      case ("IMPACTOR_SPHERE")
         call read_impactor_sphere(cards, catalogue, model%impactors)
      case default
         continue
      end select
   end subroutine read_independent

   !> Materials that refer to nothing
   subroutine read_plain_material(cards, catalogue, model)
      type(cards_type), intent(in) :: cards
      type(catalogue_type), intent(inout) :: catalogue
      type(model_type), intent(inout) :: model

      select case (cards%name)
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
      case ("MAT_CODAM2")
         call read_mat_codam2(cards, catalogue, model%materials)
      case ("MAT_COHESIVE_ELASTIC")
         call read_mat_cohesive_elastic(cards, catalogue, model%interface_materials)
      case ("MAT_COHESIVE_MIXED_MODE")
         call read_mat_cohesive_mixed_mode(cards, catalogue, model%interface_materials)
      case default
         continue
      end select
   end subroutine read_plain_material

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
      case ("ELEMENT_SOLID", "ELEMENT_SOLID_ORTHO")
         call read_element_solid(cards, catalogue, model%parts, model%mesh)
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

end module plydyn_input_model_readers
