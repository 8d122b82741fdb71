!> References are resolved, or reported where they stand.
program test_input_catalogue
   use plydyn_deck_cards, only : cards_type, is_given
   use plydyn_deck_declaration, only : integer_field, new_field, new_keyword
   use plydyn_input_catalogue, only : a_node, a_node_set, a_part, catalogue_type, new_catalogue
   use testing, only : begin, check, finish
   implicit none

   type(catalogue_type) :: catalogue
   type(cards_type) :: cards
   integer, allocatable :: members(:)
   integer :: index_found

   catalogue = new_catalogue()
   call make_cards([30, 10, 20, 99])

   call begin("find")
   call catalogue%find(a_part, cards, "ID", index_found, 1)
   call check(catalogue%report%has_errors(), "an undefined reference is an error")
   call check(index_found, 0, "with index 0")
   call catalogue%find(a_part, cards, "ID", index_found, 2)
   call check(catalogue%report%count(1), 1, "reported once where nothing of the kind is defined")
   catalogue = new_catalogue()
   call define(a_node, 1)
   call define(a_node, 2)
   call define(a_node, 3)
   call catalogue%find(a_node, cards, "ID", index_found, 2)
   call check(index_found, 2, "a defined one has its index")
   call catalogue%find(a_node, cards, "ID", index_found, 4)
   call check(index_found == 0 .and. catalogue%report%has_errors(), "an undefined one has none")
   call check(index(catalogue%report%findings(1)%right, "from 10 to 30") > 0, &
      & "and the range is reported")
   call check(catalogue%report%findings(1)%place%line, 104, "with the line of the reference")

   call begin("find_set")
   call define(a_node_set, 4)
   call catalogue%add_set(a_node_set, [3, 1])
   cards%nth = 4
   call catalogue%find_set(a_node_set, cards, "ID", members)
   call check(all(members == [3, 1]), "gives the members of a set")
   cards%nth = 1
   call catalogue%find_set(a_node_set, cards, "ID", members)
   call check(size(members), 0, "and none of a set that is not there")

   call begin("check_unused, check_duplicates")
   catalogue = new_catalogue()
   call define(a_node, 1)
   call define(a_node, 2)
   call catalogue%find(a_node, cards, "ID", index_found, 1)
   call catalogue%check_unused(a_node, "a use")
   call check(catalogue%report%count(1), 1, "one is unused")
   call check(catalogue%report%findings(1)%place%line, 102, "reported where it is defined")
   call catalogue%check_duplicates(a_node)
   call check(catalogue%report%count(1), 1, "none is defined twice")
   call define(a_node, 1)
   call catalogue%check_duplicates(a_node)
   call check(catalogue%report%findings(2)%also, 101, "one is, and both lines are reported")

   call finish()

contains

   !> Define the number of one of the cards
   subroutine define(kind, nth)
      integer, intent(in) :: kind, nth

      cards%nth = nth
      call catalogue%define(kind, cards, "ID")
   end subroutine define

   !> Cards with one number each, from line 101 on
   subroutine make_cards(ids)
      !> The numbers
      integer, intent(in) :: ids(:)

      integer :: i

      cards%declaration = new_keyword("IDS")
      cards%declaration%repeated = .true.
      call cards%declaration%append(new_field("ID", integer_field, "number", .true.))
      cards%name = "IDS"
      cards%line = 100
      cards%row_line = [(100 + i, i=1, size(ids))]
      allocate (cards%row_free(size(ids)), cards%state(1, size(ids)), cards%text(1, 0))
      cards%row_free(:) = .false.
      cards%state(:, :) = is_given
      allocate (cards%value(1, size(ids)))
      cards%value(1, :) = ids
   end subroutine make_cards

end program test_input_catalogue
