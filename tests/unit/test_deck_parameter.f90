!> Parameters are found by name.
program test_deck_parameter
   use plydyn_base_precision, only : wp
   use plydyn_deck_parameter, only : parameter_table_type, parameter_type
   use testing, only : begin, check, finish
   implicit none

   type(parameter_table_type) :: table
   character(3) :: name
   integer :: i

   call begin("find")
   call check(table%find("a"), 0, "finds nothing in an empty table")
   do i = 1, 40
      write (name, "(a,i2.2)") "P", i
      call table%add(parameter_type(name, real(i, wp)))
   end do
   call check(table%find("p33"), 33, "finds one of many")
   call check(table%find("P33"), 33, "in either case")
   call check(table%find("p3"), 0, "and by its whole name only")
   call check(table%list(40)%value, 40.0_wp, 0.0_wp, "with its value")

   call begin("advice")
   call check(index(table%advice("p3x"), "perhaps p") > 0, "names the nearest one")
   call check(index(table%advice("elephant"), "*PARAMETER") > 0, "or the keyword")

   call finish()
end program test_deck_parameter
