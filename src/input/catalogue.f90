!> Numbers that a deck defines, and the errors and warnings found so far.
!>
!> Readers define numbers with `define` and resolve references with `find`, which reports an
!> undefined one at its place in the deck and gives index 0.
module plydyn_input_catalogue
   use plydyn_base_precision, only : wp
   use plydyn_base_text, only : text
   use plydyn_deck_cards, only : cards_type
   use plydyn_deck_report, only : deck_location_type, report_type
   use plydyn_input_register, only : register_type
   use plydyn_model_layup, only : brick_section_type
   implicit none
   private

   public :: new_catalogue

   !> Kinds of things that have a number
   integer, parameter, public :: a_node = 1, a_quad = 2, a_node_set = 3, a_quad_set = 4, &
      & a_box = 5, a_curve = 6, a_material = 7, an_interface_material = 8, a_part = 9, &
      & an_impactor = 10, a_contact = 11, a_profile = 12, a_section = 13, a_table = 14, &
      & a_solid_section = 15, an_hourglass = 16, a_brick = 17, a_fixture = 18, a_constraint = 19
   integer, parameter :: kinds = 19

   !> Some nodes or quads
   type :: members_type
      !> Indices into the nodes or quads of the mesh
      integer, allocatable :: list(:)
   end type members_type

   !> A stretch of space along the axes
   type, public :: box_type
      !> Smallest and largest x, y, z
      real(wp) :: low(3) = 0.0_wp, high(3) = 0.0_wp
   end type box_type

   !> A curve for each of some values
   type, public :: table_type
      !> The values, increasing
      real(wp), allocatable :: value(:)
      !> Indices of their curves, 0 for one that is not defined
      integer, allocatable :: curve(:)
   end type table_type

   !> Numbers, sets and findings
   type, public :: catalogue_type
      !> Numbers of each kind
      type(register_type) :: registers(kinds)
      !> Nodes of each node set and quads of each quad set, in the order of definition
      type(members_type), allocatable :: node_sets(:), quad_sets(:)
      !> Boxes and tables, in the order of definition
      type(box_type), allocatable :: boxes(:)
      type(table_type), allocatable :: tables(:)
      !> Points of bricks by their sections, and hourglass controls
      type(brick_section_type), allocatable :: solid_sections(:), hourglasses(:)
      !> Hourglass control of parts that name none
      type(brick_section_type) :: usual_hourglass
      !> All nodes and elements could be read: what is said about their shape can be trusted
      logical :: mesh_is_sound = .true.
      !> Lines of stored decks: what they define need not be used, as a restart may have replaced
      !> what used it
      integer :: stored_lines = 0
      !> Line of the last deck that deletes fixtures, 0 without one
      integer :: removal_line = 0
      !> Of each deck, the time of the run from which its times count, and from which the run
      !> follows it
      real(wp), allocatable :: origin(:), start(:)
      !> Parts of the deck could not be read: what is missing may be in them
      logical :: has_unread = .false.
      !> A file of the deck could not be read; all keywords of plies and their joints could be
      logical :: is_incomplete = .false., parts_are_sound = .true.
      !> The deck has solids that are none here, of rigid bodies or cohesive layers, which has been
      !> reported: its mesh and parts are not to be blamed for them
      logical :: has_other_solids = .false.
      !> Kinds of which nothing is defined, and the end time: that they are missing was reported
      logical :: missing_is_reported(kinds) = .false., end_is_reported = .false.
      !> Findings
      type(report_type) :: report
   contains
      procedure :: define
      procedure :: find
      procedure :: find_set
      procedure :: add_set
      procedure :: location
      procedure :: check_duplicates
      procedure :: check_unused
   end type catalogue_type

contains

   !> An empty catalogue
   function new_catalogue() result(catalogue)
      type(catalogue_type) :: catalogue

      call register_kind(a_node, "node", "*NODE")
      call register_kind(a_quad, "element", "*ELEMENT_SHELL or *ELEMENT_PLATE_Q9")
      call register_kind(a_node_set, "node set", "*SET_NODE_LIST or *SET_NODE_GENERAL")
      call register_kind(a_quad_set, "shell set", "*SET_SHELL_LIST")
      call register_kind(a_box, "box", "*DEFINE_BOX")
      call register_kind(a_curve, "curve", "*DEFINE_CURVE")
      call register_kind(a_material, "ply material", "a ply material such as *MAT_PLY_ELASTIC")
      call register_kind(an_interface_material, "interface material", &
         & "an interface material such as *MAT_COHESIVE_MIXED_MODE")
      call register_kind(a_part, "part", "*PART_COMPOSITE or *PART")
      call register_kind(an_impactor, "impactor", "*IMPACTOR_SPHERE or another *IMPACTOR_")
      call register_kind(a_contact, "contact", "*CONTACT_IMPACTOR")
      call register_kind(a_fixture, "fixture", "*FIXTURE_PLANE or another *FIXTURE_")
      call register_kind(a_profile, "profile", "*DATABASE_PROFILE")
      call register_kind(a_table, "table", "*DEFINE_TABLE or *DEFINE_TABLE_2D")
      call register_kind(a_brick, "brick", "*ELEMENT_SOLID")
      call register_kind(a_solid_section, "solid section", "*SECTION_SOLID")
      call register_kind(an_hourglass, "hourglass control", "*HOURGLASS")
      call register_kind(a_constraint, "constraint", "*CONSTRAINED_FACE_LINEAR")
      call register_kind(a_section, "the section of part", "*SECTION_LAYERWISE")
      catalogue%origin = [0.0_wp]
      catalogue%start = [0.0_wp]
      allocate (catalogue%node_sets(0), catalogue%quad_sets(0), catalogue%boxes(0))
      allocate (catalogue%tables(0), catalogue%solid_sections(0), catalogue%hourglasses(0))

   contains

      !> Say what the things of a kind are called and which keyword defines them
      subroutine register_kind(kind, what, keyword)
         integer, intent(in) :: kind
         character(*), intent(in) :: what
         character(*), intent(in) :: keyword

         catalogue%registers(kind)%what = what
         catalogue%registers(kind)%keyword = keyword
      end subroutine register_kind

   end function new_catalogue

   !> Define the number in a field; 0 stands for one that is wrong
   subroutine define(self, kind, cards, name)
      class(catalogue_type), intent(inout) :: self
      integer, intent(in) :: kind
      !> The keyword, and the name of the field
      type(cards_type), intent(in) :: cards
      character(*), intent(in) :: name

      call self%registers(kind)%add(cards%whole(name), cards%line_of(name))
   end subroutine define

   !> Index of what a field refers to; where nothing of the kind is defined in a deck with errors,
   !> the cause has been reported and is not repeated at every reference
   subroutine find(self, kind, cards, name, index, nth)
      class(catalogue_type), intent(inout) :: self
      integer, intent(in) :: kind
      !> The keyword, and the name of the field
      type(cards_type), intent(in) :: cards
      character(*), intent(in) :: name
      !> Index in the order of definition; 0 if there is none, which is reported
      integer, intent(out) :: index
      !> Which set of cards; the first if absent
      integer, intent(in), optional :: nth

      index = 0
      if (.not. cards%has(name, nth)) return
      associate (register => self%registers(kind))
         call register%refer(cards%whole(name, nth), index)
         if (index > 0) return
         if (register%count > 0) then
            ! where no number is right, that has been reported; so have other solids
            if (first_number(register) <= register%count .and. .not. (kind == a_part &
               & .and. self%has_other_solids)) call refuse_missing()
         else if (.not. (self%has_unread .or. self%missing_is_reported(kind))) then
            self%missing_is_reported(kind) = .true.
            call refuse_missing()
         end if
      end associate

   contains

      !> Report that there is no such thing
      subroutine refuse_missing()
         associate (register => self%registers(kind))
            call self%report%refuse(cards%place(name, nth), register%what//" " &
               & //text(cards%whole(name, nth))//" is not defined", range_of(register))
         end associate
      end subroutine refuse_missing

   end subroutine find

   !> Members of the set that a field refers to; none if there is no such set, which is reported
   subroutine find_set(self, kind, cards, name, members)
      class(catalogue_type), intent(inout) :: self
      !> `a_node_set` or `a_quad_set`
      integer, intent(in) :: kind
      !> The keyword, and the name of the field
      type(cards_type), intent(in) :: cards
      character(*), intent(in) :: name
      !> Indices of the nodes or quads
      integer, allocatable, intent(out) :: members(:)

      integer :: set

      allocate (members(0))
      call self%find(kind, cards, name, set)
      if (set == 0) return
      if (kind == a_node_set) members = self%node_sets(set)%list
      if (kind == a_quad_set) members = self%quad_sets(set)%list
   end subroutine find_set

   !> Append a set
   subroutine add_set(self, kind, list)
      class(catalogue_type), intent(inout) :: self
      !> `a_node_set` or `a_quad_set`, and indices of the nodes or quads
      integer, intent(in) :: kind, list(:)

      if (kind == a_node_set) call append_members(self%node_sets, list)
      if (kind == a_quad_set) call append_members(self%quad_sets, list)
   end subroutine add_set

   !> Append some members without copying the others
   subroutine append_members(sets, list)
      !> Sets so far
      type(members_type), allocatable, intent(inout) :: sets(:)
      !> Members of the new one
      integer, intent(in) :: list(:)

      type(members_type), allocatable :: longer(:)
      integer :: i

      allocate (longer(size(sets) + 1))
      do i = 1, size(sets)
         call move_alloc(sets(i)%list, longer(i)%list)
      end do
      longer(size(longer))%list = list
      call move_alloc(longer, sets)
   end subroutine append_members

   !> Report numbers of a kind that are defined twice
   subroutine check_duplicates(self, kind)
      class(catalogue_type), intent(inout) :: self
      integer, intent(in) :: kind

      integer :: k

      call self%registers(kind)%sort()
      associate (register => self%registers(kind), order => self%registers(kind)%order)
         do k = 2, register%count
            associate (id => register%id(order(k)))
               if (id == 0 .or. id /= register%id(order(k - 1))) cycle
               call self%report%refuse(self%location(kind, order(k)), register%what//" " &
                  & //text(id)//" is defined twice", "a number of its own", &
                  & register%line(order(k - 1)))
            end associate
         end do
      end associate
   end subroutine check_duplicates

   !> Report things of a kind that nothing refers to; a number of 0 is an error of its own
   subroutine check_unused(self, kind, advice)
      class(catalogue_type), intent(inout) :: self
      integer, intent(in) :: kind
      !> What would be right
      character(*), intent(in) :: advice

      integer :: i

      associate (register => self%registers(kind))
         do i = 1, register%count
            if (register%used(i) .or. register%id(i) == 0 &
               & .or. register%line(i) <= self%stored_lines) cycle
            call self%report%refuse(self%location(kind, i), register%what//" " &
               & //text(register%id(i))//" is never used", advice)
         end do
      end associate
   end subroutine check_unused

   !> Numbers that are defined, in words
   function range_of(register) result(words)
      !> Numbers of one kind, sorted
      type(register_type), intent(in) :: register
      character(:), allocatable :: words

      integer :: first

      words = "the number of "//register%keyword
      first = first_number(register)
      if (first > register%count) then
         words = words//"; the deck has none"
      else if (first == register%count) then
         words = words//"; the only one is "//text(register%id(register%order(first)))
      else
         words = words//"; they run from "//text(register%id(register%order(first)))//" to " &
            & //text(register%id(register%order(register%count)))
      end if
   end function range_of

   !> Line that defines something that has a number
   pure type(deck_location_type) function location(self, kind, i)
      !> The catalogue
      class(catalogue_type), intent(in) :: self
      !> What it is, such as `a_node`, and its index
      integer, intent(in) :: kind, i

      location%line = self%registers(kind)%line(i)
   end function location

   !> Place in the order of the first number that is one; behind the last where there is none
   pure integer function first_number(register) result(first)
      !> Numbers of one kind, sorted; 0 stands for one that is wrong
      type(register_type), intent(in) :: register

      do first = 1, register%count
         if (register%id(register%order(first)) > 0) return
      end do
   end function first_number

end module plydyn_input_catalogue
