!> Example cards of the keywords, and the sections of the manual that explain them.
!>
!> The examples fit the deck of `manual/decks.md`, with nodes 1 to 25 and elements 1 to 4.
module plydyn_input_examples
   use plydyn_deck_declaration, only : keyword_type
   implicit none
   private

   public :: add_example

   !> Longest row of the table below
   integer, parameter :: row_length = 260
   !> Name of the keyword, section of `manual/theory.md` or page and section, lines of the example;
   !> all before a bar
   character(row_length), parameter :: examples(*) = [character(row_length) :: &
      & "KEYWORD|decks.md#a-whole-deck|", &
      & "COMMENT|decks.md#a-whole-deck|what a reader should know|", &
      & "END|decks.md#a-whole-deck|", &
      & "INCLUDE|decks.md#includes-parameters-and-sets|mesh.k|", &
      & "INCLUDE_PATH|decks.md#includes-parameters-and-sets|meshes|", &
      & "PARAMETER|decks.md#includes-parameters-and-sets|R speed, -2000.0|", &
      & "PARAMETER_EXPRESSION|decks.md#includes-parameters-and-sets|" &
      & //"R speed, -sqrt(2*4.0/2.0e-6)|", &
      & "TITLE|decks.md#a-whole-deck|A ball on a clamped plate|", &
      & "CONTROL_UNITS|decks.md#a-whole-deck|mm, s, t|", &
      & "CONTROL_TERMINATION|9-central-differences|4.0e-4|", &
      & "CONTROL_STAGE|running.md#restarting|1|", &
      & "DELETE_IMPACTOR|running.md#restarting|1|", &
      & "DELETE_FIXTURE|running.md#restarting|1|", &
      & "CONTROL_TIMESTEP|10-the-stable-step|0.0, 0.8|", &
      & "CONTROL_ENERGY|12-the-energy-balance|2, 1, 2, 2|", &
      & "CONTROL_PARALLEL|running.md#threads-and-ranks|1|", &
      & "CONTROL_LAYERWISE|3-strain-and-stress|0, 0.05|", &
      & "DAMPING_GLOBAL|9-central-differences|0, 2.0e3|", &
      & "DAMPING_RELAXATION|9-central-differences|1.0e-4|", &
      & "CONTROL_QUASI_STATIC|static.md#the-loading-rate-of-a-compression-or-tension-test|0.05|", &
      & "NODE|2-layer-wise-kinematics|1, 0, 0, 0|2, 10, 0, 0|", &
      & "ELEMENT_SHELL|2-layer-wise-kinematics|1, 1, 1, 2, 7, 6|2, 1, 2, 3, 8, 7|", &
      & "ELEMENT_PLATE_Q9|2-layer-wise-kinematics|1, 1|1, 3, 13, 11, 2, 8, 12, 6, 7|", &
      & "SET_NODE_LIST|decks.md#includes-parameters-and-sets|" &
      & //"1|1, 2, 3, 4, 5, 6, 10, 11|15, 16, 20, 21, 22, 23, 24, 25|", &
      & "SET_NODE_GENERAL|decks.md#includes-parameters-and-sets|1|BOX, 1|NODE, 13|", &
      & "SET_SHELL_LIST|decks.md#includes-parameters-and-sets|1|1, 2|", &
      & "DEFINE_BOX|decks.md#includes-parameters-and-sets|1, -1.0, 1.0, -1.0, 41.0, -1.0, 1.0|", &
      & "DEFINE_CURVE|decks.md#includes-parameters-and-sets|1|0.0, 0.0|1.0e-4, 1.0|", &
      & "PART_COMPOSITE|2-layer-wise-kinematics|plate|1|1, 0.25, 0.0, 0, 1, 0.25, 90.0|" &
      & //"1, 0.25, 90.0, 0, 1, 0.25, 0.0|", &
      & "PART_COMPOSITE_LONG|2-layer-wise-kinematics|plate|1|1, 0.25, 0.0|1, 0.25, 90.0|" &
      & //"1, 0.25, 90.0|1, 0.25, 0.0|", &
      & "SECTION_LAYERWISE|2-layer-wise-kinematics|1, 0, 3|", &
      & "MAT_ELASTIC|elastic-plies|1, 7.8e-9, 210.0e3, 0.3|", &
      & "MAT_ORTHOTROPIC_ELASTIC|elastic-plies|1, 1.6e-9, 153.0e3, 10.3e3, 10.3e3, 0.02, 0.02," &
      & //" 0.4|6.0e3, 3.7e3, 6.0e3, 2|0, 0, 0, 1.0, 0, 0|0, 0, 0, 0, 1.0, 0|", &
      & "MAT_PLY_ELASTIC|elastic-plies|1, 1.6e-9, 153.0e3, 10.3e3, 10.3e3, 0.3, 0.3, 0.4|" &
      & //"6.0e3, 6.0e3, 3.7e3|", &
      & "MAT_PLASTIC_KINEMATIC|metals-that-yield|1, 7.8e-9, 210.0e3, 0.3, 210.0, 2.0e3, 1.0|", &
      & "MAT_PIECEWISE_LINEAR_PLASTICITY|metals-that-yield|1, 7.8e-9, 210.0e3, 0.3|0, 0, 1|", &
      & "MAT_SIMPLIFIED_JOHNSON_COOK|metals-that-yield|1, 7.8e-9, 210.0e3, 0.3, 1.0|" &
      & //"210.0, 300.0, 0.4, 0.03, 1.0e17, 0, 0, 0.5|", &
      & "DEFINE_TABLE|metals-that-yield|1|10.0|4.0e4|", &
      & "DEFINE_TABLE_2D|metals-that-yield|1|10.0, 2|4.0e4, 3|", &
      & "MAT_PLY_CODAM2|plies-that-are-damaged|1, 1.6e-9, 153.0e3, 10.3e3, 10.3e3, 0.3, 0.3, 0.4|" &
      & //"6.0e3, 6.0e3, 3.7e3|2537.0, 1580.0, 82.0, 236.0, 90.0|91.6, 79.9, 0.22, 1.1|" &
      & //"1, 0, 0.05|", &
      & "MAT_CODAM2|plies-damaged-between-given-strains|1, 1.6e-9, 130.0e3, 9.0e3, 0, 0.02, 0," &
      & //" 0.4|5.0e3, 0, 0, 1|0, 0, 0, 1.0, 0, 0, 2|0, 0, 0, 0, 1.0, 0|0.0|" &
      & //"0.008, 0.015, 0.06, 0, 0.032, 0.06, 0.08|0.020, 0.011, 0.09, 0, 0.07, 0.09, 0.11|", &
      & "MAT_PLY_FRACTURE_3D|plies-that-crack-on-planes-of-fracture|1, 1.58e-9, 171.42e3, 9.08e3," &
      & //" 9.08e3, 0.32, 0.32, 0.45|5.29e3, 5.29e3, 3.131e3|2326.2, 1200.1, 62.3, 199.8, 92.3|" &
      & //"97.8, 106.3, 0.277, 0.788|4, 0, 0, 66.9, 0.05|0.3|", &
      & "PLY_SCATTER|plies-that-are-damaged|1, 1, 10.0, 2.0, 30.0|", &
      & "ELEMENT_SOLID|bricks|1, 1, 1, 2, 3, 4, 5, 6, 7, 8|", &
      & "ELEMENT_SOLID_ORTHO|bricks|1, 1, 1, 2, 3, 4, 5, 6, 7, 8|1.0, 0, 0|0, 1.0, 0|", &
      & "PART|bricks|block|1, 1, 1|", &
      & "SECTION_SOLID|bricks|1, 1|", &
      & "HOURGLASS|bricks|1, 6, 0.1|", &
      & "CONTROL_HOURGLASS|bricks|6, 0.1|", &
      & "LOAD_SEGMENT|8-supports-motions-and-loads|1, 2.0, 0, 5, 6, 7, 8|", &
      & "INTERFACE_COHESIVE|7-joints-of-layers|1, 0, 0, 100|", &
      & "INTERFACE_LAW|71-the-law-of-an-interface-that-fails|100, 1, 0.3|", &
      & "INTERFACE_SCATTER|71-the-law-of-an-interface-that-fails|100, 1, 12.0, 2.0|", &
      & "MAT_COHESIVE_ELASTIC|7-joints-of-layers|100, 0, 0, 0, 5.0e5, 1.0e6|", &
      & "MAT_COHESIVE_MIXED_MODE|71-the-law-of-an-interface-that-fails|" &
      & //"100, 0, 0, 0, 1.3733e6, 4.933e5, 0.28, 0.79|-1.45, 62.3, 92.3|", &
      & "MAT_COHESIVE_GENERAL|71-the-law-of-an-interface-that-fails|" &
      & //"100, 0, 0, 0, 2, 1, 0.28, 0.79|0, 62.3, 92.3|", &
      & "INITIAL_DELAMINATION|71-the-law-of-an-interface-that-fails|1, 1, 1, 0, 20.0, 20.0, 5.0|", &
      & "INITIAL_DAMAGE|71-the-law-of-an-interface-that-fails|1, 1, 1, 0, 0.5, 20.0, 20.0, 5.0|", &
      & "BOUNDARY_SPC_SET|8-supports-motions-and-loads|1, , 1, 1, 1|", &
      & "BOUNDARY_FACE|8-supports-motions-and-loads|1, -1, 0, 0, 0, 1|", &
      & "BOUNDARY_PRESCRIBED_MOTION_SET|8-supports-motions-and-loads|2, 3, 2, 1, -0.1|", &
      & "BOUNDARY_FACE_MOTION|8-supports-motions-and-loads|2, 1, 3, 2, 1, -0.1|", &
      & "CONSTRAINED_LINEAR_GLOBAL|8-supports-motions-and-loads|1|7, 3, 1.0|8, 3, -2.0|", &
      & "CONSTRAINED_FACE_LINEAR|8-supports-motions-and-loads|1, 2, 1, -0.5|7, -1, 3, -0.4|" &
      & //"13, -1, 3, 1.4|", &
      & "INITIAL_VELOCITY|9-central-differences|2|0, 0, -1000.0|", &
      & "INITIAL_VELOCITY_NODE|9-central-differences|13, 0, 0, -1000.0|", &
      & "LOAD_NODE_SET|8-supports-motions-and-loads|2, 3, 1, -10.0|", &
      & "LOAD_NODE_POINT|8-supports-motions-and-loads|13, 3, 1, -10.0|", &
      & "LOAD_FACE_POINT|8-supports-motions-and-loads|13, 1, 3, 1, -10.0|", &
      & "LOAD_FACE_LINE|8-supports-motions-and-loads|2, 1, 3, 1, -2.0|", &
      & "LOAD_SHELL_SET|8-supports-motions-and-loads|1, 1, 2.0|", &
      & "LOAD_FACE_PRESSURE|8-supports-motions-and-loads|0, 1, 1, 2.0|", &
      & "LOAD_BODY_X|8-supports-motions-and-loads|1, 9810.0|", &
      & "LOAD_BODY_Y|8-supports-motions-and-loads|1, 9810.0|", &
      & "LOAD_BODY_Z|8-supports-motions-and-loads|1, 9810.0|", &
      & "IMPACTOR_SPHERE|11-contact|1, 8.0, 2.0e-6, 20.0, 20.0, 8.5|0.0, 0.0, -2000.0|", &
      & "IMPACTOR_TUP|11-contact|1, 8.0, 2.0e-6, 20.0, 20.0, 8.5|40.0|0.0, 0.0, -2000.0|", &
      & "IMPACTOR_CYLINDER|11-contact|1, 5.0, 2.0e-6, 20.0, 20.0, 5.5|10.0, 1.0|" &
      & //"0.0, 0.0, -2000.0|", &
      & "IMPACTOR_CONE|11-contact|1, 5.0, 2.0e-6, 20.0, 20.0, 5.5|45.0, 1.0|" &
      & //"0.0, 0.0, -2000.0|", &
      & "CONTACT_IMPACTOR|11-contact|1, 1, 1, 1|", &
      & "FIXTURE_PLANE|fixtures|1, -1, 0, 0, 0.3|1, 20.0, 20.0, 30.0, 30.0, 2.0|", &
      & "FIXTURE_RING|fixtures|1, -1|20.0, 20.0, 13.0, 25.0|", &
      & "FIXTURE_PUNCH|fixtures|1, -1|2, 20.0, 20.0, 0, 0, 6.0|0, 0, 1|", &
      & "FIXTURE_BAR|fixtures|1, -1, 0, 2.0|10.0, 0, 10.0, 40.0|", &
      & "FIXTURE_CLAMP|fixtures|1, 1, 100.0, 0, 0, 0.3|10.0, 10.0, 0, 3.0|", &
      & "DATABASE_GLSTAT|12-the-energy-balance|1.0e-6|", &
      & "DATABASE_NODOUT|running.md#jobnodescsv|1.0e-6|", &
      & "DATABASE_SPCFORC|8-supports-motions-and-loads|1.0e-6|", &
      & "DATABASE_BINARY_D3PLOT|running.md#jobvtkhdf|2.0e-5|", &
      & "DATABASE_IMPACTOR|11-contact|1.0e-6|", &
      & "DATABASE_FIXTURE|fixtures|1.0e-6|", &
      & "DATABASE_HISTORY_NODE|running.md#jobnodescsv|8, 13|", &
      & "DATABASE_HISTORY_NODE_SET|running.md#jobnodescsv|2|", &
      & "DATABASE_FIELD|13-recovery-of-strain-and-stress|displacement stress|", &
      & "DATABASE_PROFILE|13-recovery-of-strain-and-stress|1, 20.0, 20.0, 5, 1.0e-5|", &
      & "DATABASE_DELAM|71-the-law-of-an-interface-that-fails|1.0e-6|", &
      & "DATABASE_BINARY_D3DUMP|running.md#restarting|10000|", &
      & "DATABASE_BINARY_RUNRSF|running.md#restarting|5000|"]
   character(*), parameter :: bar = "|", line_feed = achar(10)

contains

   !> Give a keyword its example and its section of the manual, where the table has them
   pure subroutine add_example(keyword)
      !> The keyword
      type(keyword_type), intent(inout) :: keyword

      integer :: i
      character(:), allocatable :: row

      do i = 1, size(examples)
         row = trim(examples(i))
         if (index(row, keyword%name//bar) /= 1) cycle
         row = row(len(keyword%name) + 2:)
         keyword%theory = row(:index(row, bar) - 1)
         keyword%example = lines_of(row(index(row, bar) + 1:))
      end do
   end subroutine add_example

   !> Lines that end with a bar, each with a line feed instead
   pure function lines_of(row) result(lines)
      !> The lines
      character(*), intent(in) :: row
      character(:), allocatable :: lines

      integer :: i

      lines = row
      do i = 1, len(lines)
         if (lines(i:i) == bar) lines(i:i) = line_feed
      end do
   end function lines_of

end module plydyn_input_examples
