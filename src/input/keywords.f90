!> The list of all keywords, in the order of the manual, and what it prints.
!>
!> A new keyword is a routine that visits its fields, and its row in the list of its family. Those
!> without a family are here: keywords that the parser reads itself, and keywords of LS-DYNA that it
!> knows and does not read, ignored or refused with advice.
module plydyn_input_keywords
   use plydyn_base_error, only : error_type, exit_usage, fail
   use plydyn_base_text, only : upper_case
   use plydyn_deck_declaration, only : is_ignored, is_read, is_refused, keyword_type, new_keyword, &
      & standard
   use plydyn_deck_keyword_json, only : keywords_json
   use plydyn_deck_lookup, only : find_keyword, keyword_advice
   use plydyn_deck_manual, only : keyword_index, keyword_list, keyword_page
   use plydyn_input_card_visitor, only : card_visitor_type
   use plydyn_input_control, only : add_control
   use plydyn_input_crack_lines, only : add_crack_lines
   use plydyn_input_damage, only : add_damaged_materials
   use plydyn_input_fixture, only : add_fixtures
   use plydyn_input_impactor, only : add_impactors
   use plydyn_input_interface, only : add_interfaces
   use plydyn_input_keyword_row, only : keyword_list_type, keyword_row_type
   use plydyn_input_load, only : add_loads
   use plydyn_input_material, only : add_elastic_materials
   use plydyn_input_mesh, only : add_mesh
   use plydyn_input_metal, only : add_metals
   use plydyn_input_output, only : add_output
   use plydyn_input_part, only : add_parts
   use plydyn_input_solid, only : add_solids
   use plydyn_input_support, only : add_supports
   use plydyn_model_model, only : model_type
   implicit none
   private

   public :: all_keywords, all_rows, keyword_manual

   character(*), parameter :: line_feed = achar(10)
   !> What stands in the place of a name to get all declarations as JSON
   character(*), parameter :: as_json = "--json"

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
      & "ELEMENT_BEAM", "ELEMENT_BEAM_ELBOW", "SECTION_BEAM", "ELEMENT_DISCRETE", "ELEMENT_MASS"]
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

   !> Rows of all keywords, in the order of the manual
   function all_rows() result(rows)
      type(keyword_row_type), allocatable :: rows(:)

      type(keyword_list_type) :: list

      call list%add("KEYWORD", frame)
      call list%add("COMMENT", frame)
      call list%add("END", frame)
      call list%add("INCLUDE", frame)
      call list%add("INCLUDE_PATH", frame)
      call list%add("PARAMETER", frame)
      call list%add("PARAMETER_EXPRESSION", frame)
      call add_control(list)
      call add_mesh(list)
      call add_parts(list)
      call add_elastic_materials(list)
      call add_metals(list)
      call add_damaged_materials(list)
      call add_solids(list)
      call add_interfaces(list)
      call add_crack_lines(list)
      call add_supports(list)
      call add_loads(list)
      call add_impactors(list)
      call add_fixtures(list)
      call add_output(list)
      call list%add_unread(ignored_keywords())
      call list%add_unread(refused_keywords())
      rows = list%rows(:list%count)
   end function all_rows

   !> Declarations of all keywords
   function all_keywords() result(keywords)
      type(keyword_type), allocatable :: keywords(:)

      type(keyword_row_type), allocatable :: rows(:)

      rows = all_rows()
      keywords = rows%declaration
   end function all_keywords

   !> Pages of all keywords, or the page of one, in markdown; all declarations as JSON
   subroutine keyword_manual(name, pages, error)
      !> Name of a keyword with or without star, in either case; empty for all; `--json`
      character(*), intent(in) :: name
      !> The pages
      character(:), allocatable, intent(out) :: pages
      !> There is no such keyword
      type(error_type), allocatable, intent(out) :: error

      character(:), allocatable :: bare
      type(keyword_type), allocatable :: keywords(:)
      integer :: i

      keywords = all_keywords()
      if (len_trim(name) == 0) then
         pages = all_pages(keywords)
         return
      else if (name == as_json) then
         pages = keywords_json(keywords)
         return
      end if
      bare = upper_case(trim(name))
      if (bare(1:1) == "*") bare = bare(2:)
      i = find_keyword(bare, keywords)
      if (i > 0) then
         pages = keyword_page(keywords(i))
      else
         call fail(error, exit_usage, "there is no keyword *"//bare//": right would be " &
            & //keyword_advice(bare, keywords))
      end if
   end subroutine keyword_manual

   !> Pages of all keywords
   function all_pages(keywords) result(pages)
      type(keyword_type), intent(in) :: keywords(:)
      character(:), allocatable :: pages

      integer :: i

      pages = "# Keywords"//line_feed//line_feed//"The examples fit the deck of [Writing a " &
         & //"deck](decks.md#a-whole-deck), with what they name, such as a curve, beside them." &
         & //line_feed//line_feed//keyword_index(keywords)
      do i = 1, size(keywords)
         if (keywords(i)%status == is_read) pages = pages//keyword_page(keywords(i))
      end do
      pages = pages//"# Keywords that are known and ignored"//line_feed//line_feed &
         & //keyword_list(keywords, is_ignored) &
         & //line_feed//"# Keywords that are refused with advice"//line_feed//line_feed &
         & //keyword_list(keywords, is_refused)
   end function all_pages

   !> Keywords that the parser reads itself
   subroutine frame(card, model)
      class(card_visitor_type), intent(inout) :: card
      type(model_type), intent(inout) :: model

      select case (card%name)
      case ("KEYWORD")
         call card%keyword(standard, "First keyword of a deck; LONG=Y behind it gives every " &
            & //"field 20 columns.")
         call card%example("decks.md#a-whole-deck", "")
      case ("COMMENT")
         call card%keyword(standard, "Lines of comment, up to the next keyword.")
         call card%example("decks.md#a-whole-deck", "what a reader should know")
      case ("END")
         call card%keyword(standard, "Last keyword of a deck. A deck without it is an error, " &
            & //"since its end may be missing.")
         call card%example("decks.md#a-whole-deck", "")
      case ("INCLUDE")
         call card%keyword(standard, "Files that are read in place of this keyword.")
         call card%remark("One path per line, relative to the file that includes it; the " &
            & //"folders of *INCLUDE_PATH come next. A file must not include itself.")
         call card%example("decks.md#includes-parameters-and-sets", "mesh.k")
      case ("INCLUDE_PATH")
         call card%keyword(standard, "Folders in which include files are looked for, one per " &
            & //"line.", alias="INCLUDE_PATH_RELATIVE")
         call card%example("decks.md#includes-parameters-and-sets", "meshes")
      case ("PARAMETER")
         call card%keyword(standard, "Names for numbers.", alias="PARAMETER_LOCAL")
         call card%remark("Up to four pairs on a line: in the first field R (real) or I " &
            & //"(integer) and the name, in the second the number. Any later field may hold " &
            & //"&name or -&name.")
         call card%example("decks.md#includes-parameters-and-sets", "R speed, -2000.0")
      case default ! *PARAMETER_EXPRESSION
         call card%keyword(standard, "Names for computed numbers.", &
            & alias="PARAMETER_EXPRESSION_LOCAL")
         call card%remark("One on a line: R or I and the name in the first field, then the " &
            & //"expression to the end of the line; a line with a blank first field goes on with " &
            & //"it. Numbers, earlier parameters, pi, + - * / ** ( ), sqrt, sin, cos, tan " &
            & //"(radians), abs, exp, log (natural), min and max with two arguments. All " &
            & //"arithmetic is real.")
         call card%example("decks.md#includes-parameters-and-sets", "R speed, -sqrt(2*4.0/2.0e-6)")
      end select
   end subroutine frame

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
         & listed(no_solids, is_refused, "*ELEMENT_SHELL, *ELEMENT_PLATE_Q9 or *ELEMENT_SOLID"), &
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
      character(*), intent(in) :: names(:)
      !> `is_ignored` or `is_refused`
      integer, intent(in) :: status
      !> What would be right
      character(*), intent(in) :: advice
      type(keyword_type) :: keywords(size(names))

      integer :: i

      do i = 1, size(names)
         keywords(i) = new_keyword(trim(names(i)))
         keywords(i)%status = status
         keywords(i)%remark = advice
      end do
   end function listed

end module plydyn_input_keywords
