!> Fixtures are as on their cards, and those that cannot be are refused.
program test_input_fixture
   use decks, only : plate, read_lines
   use plydyn_base_error, only : error_type
   use plydyn_base_precision, only : wp
   use plydyn_model_model, only : model_type
   use testing, only : begin, check, check_error, finish
   implicit none

   character(*), parameter :: path = "test_input_fixture.k"
   character(*), parameter :: curve = "*DEFINE_CURVE|3,|0.,0.|1.,2.|"
   type(model_type) :: model
   type(error_type), allocatable :: error
   character(:), allocatable :: messages

   call begin("read_fixture, plane")
   call read_plate(curve//"*FIXTURE_PLANE_TITLE|frame|2,-1,0.1,0.05,0.3,0.2,0.01|" &
      & //"1,0.5,0.4,1.0,0.8,0.2|0,0,3|")
   call check(.not. allocated(error), "is read")
   associate (fixture => model%fixtures(1))
      call check(fixture%id == 2 .and. fixture%face == -1, "number and face")
      call check(fixture%body%upward, 1, "a body below pushes up")
      call check([fixture%gap, fixture%body%edge], [0.1_wp, 0.05_wp], 0.0_wp, "gap and edge")
      call check([fixture%friction%static, fixture%friction%dynamic, fixture%friction%decay], &
         & [0.3_wp, 0.2_wp, 0.01_wp], 0.0_wp, "friction")
      call check(fixture%displacement(model%curves, 0.5_wp), [0.0_wp, 0.0_wp, 1.0_wp], 0.0_wp, &
         & "motion")
      associate (window => fixture%body%outlines(1))
         call check([window%centre, window%half, window%corner], &
            & [0.5_wp, 0.4_wp, 0.5_wp, 0.4_wp, 0.2_wp], 0.0_wp, "window")
         call check(window%is_hole, "a window is a hole")
      end associate
   end associate
   call read_plate("*FIXTURE_PLANE|2,-1|1,0.5,0.4,1.0,0.8,0.5|")
   call check_error(error, "rounder than the rectangle", "corners that meet")
   call read_plate("*FIXTURE_PLANE|2,-1|2,0.5,0.5|")
   call check_error(error, "no radius", "a round window without a radius")
   call read_plate(curve//"*FIXTURE_PLANE|2,1,0.1|0|0,0,3|*FIXTURE_PLANE|2,1|0|")
   call check_error(error, "defined twice", "numbers are unique")

   call begin("check_fixtures")
   call read_plate("*FIXTURE_RING|1,1|20.,20.,1.,2.|")
   call check_error(error, "lies over no node", "a ring beside the plate")
   call read_plate("*DEFINE_CURVE|3,|0.,-0.2|1.,0.|*FIXTURE_PLANE|2,1,0.1|0|0,0,3|")
   call check_error(error, "inside the plate", "a curve that begins in the plate")
   call read_plate("*FIXTURE_PLANE|1,-1|2,0.5,0.5,0.,0.,0.6|")
   call check(index(messages, "no mesh line") > 0, "a window across the only quad")
   call read_plate("*FIXTURE_PLANE|1,-1|1,0.5,0.5,1.,1.,0.|")
   call check(index(messages, "no mesh line") == 0, "a window along the mesh lines")
   call read_plate("*FIXTURE_PLANE|1,-1|1,0.,0.,0.5,0.5,0.|")
   call check(index(messages, "open under no node") == 0, "a window under a node")
   call read_plate("*FIXTURE_PLANE|1,-1|1,5.,5.,0.5,0.5,0.|")
   call check(index(messages, "is open under no node") > 0, "a window beside the plate")

   call begin("read_fixture, ring, bar, clamp")
   call read_plate("*FIXTURE_RING|1,1,0.,0.6|0.,0.,1.,2.|")
   call check_error(error, "narrower than its two edges", "edges that meet")
   call read_plate("*FIXTURE_BAR|1,-1,0.,0.5|0.5,0.,0.5,0.|")
   call check_error(error, "no length", "a bar without length")
   call read_plate("*FIXTURE_CLAMP|4,1,100.,0,50.,0.4|0.,0.,0.,0.3|")
   call check(.not. allocated(error), "a clamp is read")
   associate (clamp => model%fixtures(1))
      call check(clamp%is_clamp .and. clamp%body%upward == -1, "which presses down")
      call check([clamp%force, clamp%stiffness], [100.0_wp, 50.0_wp], 0.0_wp, "force, stiffness")
      call check(model%curves(clamp%curve)%at(3.0_wp), 1.0_wp, 0.0_wp, "constant without a curve")
      call check(size(clamp%body%outlines), 1, "a round tip has one outline")
   end associate

   call finish()

contains

   !> Write the plate and some more lines, parted by bars, and read it all
   subroutine read_plate(more)
      !> Lines behind those of the plate
      character(*), intent(in) :: more

      call read_lines(path, plate//more//"*END", model, messages, error)
   end subroutine read_plate

end program test_input_fixture
