!> Parameters are found by name.
program test_deck_parameter
   use plydyn_base_precision, only : wp
   use plydyn_deck_parameter, only : parameter_table_type, parameter_type
   use plydyn_deck_report, only : report_type
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

   call settings()
   call finish()

contains

   !> Numbers from the command line
   subroutine settings()
      character(*), parameter :: feed = new_line("a")
      type(parameter_table_type) :: chosen
      type(report_type) :: report
      real(wp) :: value

      call begin("set")
      call chosen%set("Speed=-8e3"//feed//"mass=2"//feed, report)
      value = 1.0_wp
      call chosen%choose("speed", value)
      call check(value, -8.0e3_wp, 0.0_wp, "a number replaces that of the deck")
      call chosen%choose("radius", value)
      call check(value, -8.0e3_wp, 0.0_wp, "of no other parameter")
      call check(.not. report%has_errors(), "all is well so far")
      call chosen%check_settings(report)
      call check(report%has_errors(), "a number that no parameter takes is refused")

      call begin("set refuses")
      call refuse("speed")
      call refuse("speed=")
      call refuse("speed=fast")
      call refuse("=3.0")
   end subroutine settings

   !> What is no setting
   subroutine refuse(word)
      character(*), intent(in) :: word

      type(parameter_table_type) :: chosen
      type(report_type) :: report

      call chosen%set(word//new_line("a"), report)
      call check(report%has_errors(), word)
   end subroutine refuse

end program test_deck_parameter
