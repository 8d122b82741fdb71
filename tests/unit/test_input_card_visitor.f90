!> A visit of a keyword looks up what fields refer to, and reports findings where they stand.
program test_input_card_visitor
   use damping_ratio, only : visit_damping_ratio
   use plydyn_base_precision, only : wp
   use plydyn_deck_cards, only : is_absent, is_given
   use plydyn_input_card_visitor, only : card_visitor_type
   use plydyn_input_catalogue, only : a_node, a_node_set, new_catalogue
   use plydyn_model_model, only : model_type
   use testing, only : begin, check, finish
   implicit none

   type(card_visitor_type) :: card, reader
   type(model_type) :: model

   call begin("the example of the manual")
   call card%declare("DAMPING_RATIO")
   call visit_damping_ratio(card, model)
   call check(model%control%damping, 0.0_wp, 0.0_wp, "a declaration reads nothing")
   call make_reader(2, 1)
   reader%value(:, 1) = [0.02_wp, 500.0_wp]
   call visit_damping_ratio(reader, model)
   call check(model%control%damping, 2.0_wp*0.02_wp*2.0_wp*acos(-1.0_wp)*500.0_wp, 1.0e-12_wp, &
      & "twice the share times the angular frequency")
   call check(.not. reader%catalogue%report%has_errors(), "without an error")
   model%control%rest_share = 1.0e-4_wp
   call visit_damping_ratio(reader, model)
   call check(reader%catalogue%report%findings(1)%place%field == "RATIO", &
      & "what is refused is refused at its field")

   call check_references()
   call finish()

contains

   !> Cards of the keyword declared last, all of whose fields are given
   subroutine make_reader(fields, rows)
      integer, intent(in) :: fields, rows
      type(card_visitor_type) :: empty
      integer :: i

      reader = empty
      reader%reads = .true.
      reader%catalogue = new_catalogue()
      reader%name = card%name
      reader%line = 10
      reader%declaration = card%declaration
      reader%row_line = [(10 + i, i=1, rows)]
      allocate (reader%row_free(rows), source=.false.)
      allocate (reader%state(fields, rows), source=is_given)
      allocate (reader%value(fields, rows), source=0.0_wp)
   end subroutine make_reader

   !> Numbers, sets and lists
   subroutine check_references()
      type(card_visitor_type) :: other
      integer :: index, number
      integer, allocatable :: nodes(:), set(:)

      call begin("define, refer, members, list")
      other%declaration = card%declaration
      card = other
      call card%declare("PICK")
      call visit(card, number, index, set, nodes)
      call check(card%declaration%cards(2)%fields(2)%name == "NID2" &
         & .and. .not. card%declaration%cards(2)%fields(2)%required, "a list needs one member")
      call make_reader(3, 3)
      reader%value(:, 1) = [7.0_wp, 7.0_wp, 0.0_wp]
      reader%value(:2, 2) = [7.0_wp, 9.0_wp]
      reader%value(:2, 3) = [5.0_wp, 0.0_wp]
      reader%state(2, 3) = is_absent
      call visit(reader, number, index, set, nodes)
      call check(number == 7 .and. index == 1, "a number that was defined has an index")
      call check(.not. allocated(set), "a set of 0 is none")
      call check(reader%catalogue%report%findings(1)%place%field == "NID2", &
         & "a member that is not defined is reported")
      call check(reader%catalogue%report%findings(2)%place%line, 13, "in its row")
      call check(size(nodes), 1, "and left out")
   end subroutine check_references

   !> A card with a number, a reference and a set, and rows with a list
   subroutine visit(card, number, index, set, nodes)
      type(card_visitor_type), intent(inout) :: card
      integer, intent(inout) :: number, index
      integer, allocatable, intent(inout) :: set(:), nodes(:)

      call card%define(a_node, "ID", "number", number)
      call card%refer(a_node, "SAME", "node", index)
      call card%members(a_node_set, "NSID", "set; 0 for none", set, default=0, least=0)
      call card%card(repeated=.true.)
      call card%list(a_node, "NID", 2, "node", nodes)
   end subroutine visit

end program test_input_card_visitor
