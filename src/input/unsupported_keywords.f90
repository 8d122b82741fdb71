!> Keywords of LS-DYNA that are known and not read: ignored, or refused with advice.
module plydyn_input_unsupported_keywords
   use plydyn_deck_declaration, only : is_ignored, is_refused, keyword_type, new_keyword, standard
   implicit none
   private

   public :: ignored_keywords, refused_keywords

   !> Longest name in the lists below
   integer, parameter :: longest_name = 40

   !> Output and display only: a warning
   character(longest_name), parameter :: ignored(*) = [character(longest_name) :: &
      & "CONTROL_ACCURACY", "CONTROL_MPP_DECOMPOSITION_AUTOMATIC", "CONTROL_MPP_IO_NODUMP", &
      & "CONTROL_OUTPUT", "CONTROL_SOLUTION", "DATABASE_ABSTAT", "DATABASE_ATDOUT", &
      & "DATABASE_BINARY_D3PART", "DATABASE_BINARY_D3THDT", "DATABASE_BINARY_INTFOR", &
      & "DATABASE_DEFORC", "DATABASE_DISBOUT", "DATABASE_ELOUT", "DATABASE_EXTENT_BINARY", &
      & "DATABASE_EXTENT_INTFOR", "DATABASE_FORMAT", "DATABASE_HISTORY_SHELL", &
      & "DATABASE_HISTORY_SHELL_SET", "DATABASE_HISTORY_SOLID", "DATABASE_JNTFORC", &
      & "DATABASE_MATSUM", "DATABASE_NODFOR", "DATABASE_RBDOUT", "DATABASE_RWFORC", &
      & "DATABASE_SECFORC", "DATABASE_SLEOUT", "DATABASE_SWFORC", "DATABASE_TRHIST"]
   !> The same, where plydyn has another way to what they write
   character(longest_name), parameter :: boundary_forces(*) = [character(longest_name) :: &
      & "DATABASE_BNDOUT"]
   character(longest_name), parameter :: contact_forces(*) = [character(longest_name) :: &
      & "DATABASE_NCFORC", "DATABASE_RCFORC"]

   !> Would change the results: an error with advice
   character(longest_name), parameter :: whole_laminates(*) = [character(longest_name) :: &
      & "SECTION_SHELL", "INTEGRATION_SHELL", "ELEMENT_SHELL_COMPOSITE", &
      & "ELEMENT_SHELL_THICKNESS", "ELEMENT_SHELL_BETA", "SECTION_TSHELL", "ELEMENT_TSHELL*", &
      & "PART_COMPOSITE_TSHELL", "INTEGRATION_*", "ELEMENT_SHELL_*"]
   character(longest_name), parameter :: no_solids(*) = [character(longest_name) :: &
      & "ELEMENT_BEAM", "ELEMENT_BEAM_ELBOW", "SECTION_BEAM", &
      & "ELEMENT_DISCRETE", "ELEMENT_MASS"]
   character(longest_name), parameter :: other_damage(*) = [character(longest_name) :: &
      & "MAT_054", "MAT_055", "MAT_058", "MAT_022", "MAT_059", "MAT_158", "MAT_221", &
      & "MAT_261", "MAT_262", "MAT_LAMINATED_FRACTURE_*", "MAT_COMPOSITE_FAILURE_*", &
      & "MAT_RATE_SENSITIVE_COMPOSITE_FABRIC", "MAT_ORTHOTROPIC_SIMPLIFIED_DAMAGE", &
      & "MAT_ENHANCED_COMPOSITE_DAMAGE", "MAT_LAMINATED_COMPOSITE_FABRIC", "MAT_COMPOSITE_DAMAGE"]
   character(longest_name), parameter :: other_bonds(*) = [character(longest_name) :: &
      & "MAT_COHESIVE_TH", "MAT_185", "MAT_240", "MAT_279", "MAT_COHESIVE_*", &
      & "MAT_ARUP_ADHESIVE", "MAT_169"]
   !> What holds parts together there, and plies of one part here
   character(longest_name), parameter :: ties(*) = [character(longest_name) :: &
      & "CONTACT_*TIE", "CONTACT_*COHESIVE", "ELEMENT_*COHESIVE", "SECTION_*COHESIVE"]
   character(longest_name), parameter :: own_impactor(*) = [character(longest_name) :: &
      & "MAT_RIGID", "RIGIDWALL_GEOMETRIC_SPHERE_MOTION", "CONTACT_AUTOMATIC_SURFACE_TO_SURFACE", &
      & "CONTACT_AUTOMATIC_SINGLE_SURFACE", "CONTACT_AUTOMATIC_NODES_TO_SURFACE", &
      & "CONTACT_ENTITY", "INITIAL_VELOCITY_GENERATION", "INITIAL_VELOCITY_RIGID_BODY", &
      & "MAT_020", "MAT_RIGID_*", "RIGIDWALL_*", "PART_INERTIA", "CONSTRAINED_RIGID_BODIES", &
      & "CONSTRAINED_NODAL_RIGID_BODY*", "CONSTRAINED_EXTRA_NODES*", &
      & "BOUNDARY_PRESCRIBED_MOTION_RIGID*"]
   !> Behind all other families of contacts
   character(longest_name), parameter :: contacts(*) = [character(longest_name) :: &
      & "CONTACT_AUTOMATIC_*", "CONTACT_ERODING_*", "CONTACT_SURFACE_*", "CONTACT_NODES_*", &
      & "CONTACT_ONE_WAY_*", "CONTACT_SINGLE_*", "CONTACT_RIGID_*"]
   character(longest_name), parameter :: other_elements(*) = [character(longest_name) :: &
      & "CONTROL_SHELL", "CONTROL_SOLID", "CONTROL_BULK_VISCOSITY", "CONTROL_CONTACT"]
   character(longest_name), parameter :: erosion(*) = [character(longest_name) :: &
      & "MAT_ADD_*", "DEFINE_ELEMENT_DEATH_*", "MAT_NONLOCAL"]
   character(longest_name), parameter :: damping(*) = [character(longest_name) :: &
      & "DAMPING_PART_*", "DAMPING_FREQUENCY_*", "DAMPING_RELATIVE"]
   character(longest_name), parameter :: sets_of_elements(*) = [character(longest_name) :: &
      & "SET_SHELL_GENERAL", "SET_SEGMENT*"]
   character(longest_name), parameter :: sets_of_parts(*) = [character(longest_name) :: "SET_PART*"]
   character(longest_name), parameter :: transforms(*) = [character(longest_name) :: &
      & "INCLUDE_TRANSFORM*", "NODE_TRANSFORM*", "DEFINE_TRANSFORMATION*"]

contains

   !> Keywords that do not change the results
   function ignored_keywords() result(keywords)
      type(keyword_type), allocatable :: keywords(:)

      keywords = [listed(ignored, is_ignored, ""), &
         & listed(boundary_forces, is_ignored, &
         & "*DATABASE_SPCFORC, which writes the forces of prescribed motions, too"), &
         & listed(contact_forces, is_ignored, &
         & "*DATABASE_IMPACTOR, which writes the force of contact; it does so without a keyword")]
   end function ignored_keywords

   !> Keywords that plydyn has another way for
   function refused_keywords() result(keywords)
      type(keyword_type), allocatable :: keywords(:)

      keywords = [listed(whole_laminates, is_refused, &
         & "a part with its plies in *PART_COMPOSITE, and *SECTION_LAYERWISE"), &
         & listed(no_solids, is_refused, &
         & "*ELEMENT_SHELL, *ELEMENT_PLATE_Q9 or *ELEMENT_SOLID"), &
         & listed(other_damage, is_refused, &
         & "strengths and toughnesses of each ply in *MAT_PLY_CODAM2, or *MAT_PLY_ELASTIC"), &
         & listed(other_bonds, is_refused, "a bilinear law, *MAT_COHESIVE_MIXED_MODE"), &
         & listed(ties, is_refused, "plies of one *PART_COMPOSITE with *INTERFACE_COHESIVE " &
         & //"between them and, where they may come apart, *MAT_COHESIVE_MIXED_MODE"), &
         & listed(contacts, is_refused, "a rigid *IMPACTOR_SPHERE with *CONTACT_IMPACTOR"), &
         & listed(own_impactor, is_refused, "a rigid *IMPACTOR_SPHERE with *CONTACT_IMPACTOR"), &
         & listed(other_elements, is_refused, &
         & "nothing: plydyn has no elements that this keyword is for"), &
         & listed(erosion, is_refused, "nothing: no element is deleted, and damage belongs to " &
         & //"the material of a ply, as in *MAT_PLY_CODAM2"), &
         & listed(damping, is_refused, "*DAMPING_GLOBAL, for the whole model"), &
         & listed(["CONTROL_DYNAMIC_RELAXATION"], is_refused, "*DAMPING_RELAXATION"), &
         & listed(["TERMINATION_CONTACT"], is_refused, "*CONTROL_END_OF_CONTACT"), &
         & listed(["PLY_SCATTER"], is_refused, "no scatter of plies, which was removed, or " &
         & //"*INTERFACE_SCATTER for the strengths of interfaces"), &
         & listed(sets_of_elements, is_refused, "*SET_SHELL_LIST, or *LOAD_SEGMENT with nodes"), &
         & listed(sets_of_parts, is_refused, "the number of each part where the set is used"), &
         & listed(transforms, is_refused, "a mesh in its place, by *INCLUDE")]
   end function refused_keywords

   !> Declarations of the names in a list
   function listed(names, status, advice) result(keywords)
      !> Names of keywords
      character(*), intent(in) :: names(:)
      !> `is_ignored` or `is_refused`
      integer, intent(in) :: status
      !> What would be right
      character(*), intent(in) :: advice
      type(keyword_type) :: keywords(size(names))

      integer :: i

      do i = 1, size(names)
         keywords(i) = new_keyword(trim(names(i)), standard, "")
         keywords(i)%status = status
         keywords(i)%remark = advice
      end do
   end function listed

end module plydyn_input_unsupported_keywords
