!> Tables and sections: heads, sides, values that do not fit.
program test_io_listing_table
   use plydyn_base_precision, only : wp
   use plydyn_io_listing_table, only : table_type, write_section
   use testing, only : begin, check, finish
   implicit none

   type(table_type) :: table
   integer :: unit

   open (newunit=unit, status="scratch", action="readwrite")
   call write_section(unit, "Plies")
   call table%start(unit)
   call table%add_column("ply", 5, "i0")
   call table%add_column("material", 8, "a")
   call table%add_column("angle [deg]", 8, "f6.1")
   call table%write_heads()
   call table%put(1)
   call table%put("tape")
   call table%put(-45.0_wp)
   call table%put(12)
   call table%put("long material")
   call table%put(1.25e9_wp)
   rewind (unit)

   call begin("table")
   call expect("", "a section begins after a blank line")
   call expect("Plies", "with its title")
   call expect("-----", "underlined")
   call expect("", "and a blank line")
   call expect("  ply  material  angle [deg]", "a head widens its column")
   call expect("-----  --------  -----------", "heads are underlined")
   call expect("    1  tape            -45.0", "numbers to the right, texts to the left")
   call expect("   12  long material   1.2500E+09", "nothing is cut off")
   close (unit)
   call finish()

contains

   !> Check the next line
   subroutine expect(line, what)
      !> What it must be
      character(*), intent(in) :: line
      !> What must hold
      character(*), intent(in) :: what

      character(100) :: found

      read (unit, "(a)") found
      call check(found == line, what//": '"//trim(found)//"'")
   end subroutine expect

end program test_io_listing_table
