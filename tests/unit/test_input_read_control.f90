!> The run is as long and as careful as told.
program test_input_read_control
   use plydyn_base_error, only : error_type
   use plydyn_base_precision, only : wp
   use plydyn_input_read_model, only : read_model
   use plydyn_model_control, only : all_explicit, implicit_interfaces, &
      & linear_strain, total_lagrangian
   use plydyn_model_model, only : model_type
   use testing, only : begin, check, finish
   implicit none

   !> A plate of one quad and three plies, and how long
   character(*), parameter :: plate = "*KEYWORD|*CONTROL_TERMINATION|1.0,|*NODE|1,0.,0.,0.|" &
      & //"2,1.,0.,0.|3,1.,1.,0.|4,0.,1.,0.|*ELEMENT_SHELL|11,7,1,2,3,4|*MAT_PLY_ELASTIC|" &
      & //"5,1.6e-9,1.4e5,1.0e4,1.0e4,0.3,0.3,0.45|5000.,4000.,3500.|*PART_COMPOSITE_LONG|plate|" &
      & //"7,|5,0.25|5,0.25,90.|5,0.5|"
   character(*), parameter :: path = "test_input_read_control.k"
   type(model_type) :: model
   type(error_type), allocatable :: error
   character(:), allocatable :: messages

   call begin("control")
   call read_plate("")
   associate (control => model%control)
      call check(control%end_time, 1.0_wp, 0.0_wp, "end time")
      call check(control%step_factor, 0.9_wp, 0.0_wp, "usual share of the step")
      call check(control%kinematics, total_lagrangian, "usual kinematics")
      call check(control%energy_limit, 0.05_wp, 0.0_wp, "usual limit of the balance")
      call check(control%scheme, all_explicit, "all explicit")
   end associate
   call read_plate("*CONTROL_TIMESTEP|1.e-6,0.0,0,0.,0.,3|*CONTROL_LAYERWISE|0,0.1,1,2.e-8|" &
      & //"*DAMPING_GLOBAL|0,25.|*CONTROL_ENERGY|2,2,2,2|*CONTROL_PARALLEL|4,0,1|" &
      & //"*DEFINE_CURVE|3,|0.,1.e-6|1.,1.e-6|*TITLE|A plate, flat|")
   call check(.not. allocated(error), "is read")
   associate (control => model%control)
      call check(control%first_step, 1.0e-6_wp, 0.0_wp, "first step")
      call check(control%step_factor, 0.9_wp, 0.0_wp, "a zero means the usual share, as in LS-DYNA")
      call check(control%step_curve, 1, "curve of the largest step")
      call check(control%kinematics, linear_strain, "kinematics")
      call check(control%energy_limit, 0.1_wp, 0.0_wp, "limit of the balance")
      call check(control%scheme, implicit_interfaces, "what is implicit")
      call check(control%largest_step, 2.0e-8_wp, 0.0_wp, "largest step")
      call check(control%threads, 4, "threads")
      call check(control%damping, 25.0_wp, 0.0_wp, "damping")
   end associate
   call check(model%title == "A plate, flat", "title")

   call begin("read_control_termination")
   call read_text("*KEYWORD|*CONTROL_TERMINATION|2.0,100,0.01,0.,0.,1|" &
      & //plate(index(plate, "*NODE"):)//"*END")
   call check(.not. allocated(error), "is read")
   call check(model%control%end_cycle, 100, "last cycle")
   call check(model%control%smallest_share, 0.01_wp, 0.0_wp, "smallest step")
   call check(model%control%check_only, "check only")

   call begin("read_control_units")
   call read_plate("*CONTROL_UNITS|m, ms, kg|")
   call check(.not. allocated(error), "is read")
   call check(model%control%units%force == "MN" .and. model%control%units%stress == "MPa", "units")

   call finish()

contains

   !> Write the plate and some more lines, parted by bars, and read it all
   subroutine read_plate(more)
      !> Lines behind those of the plate
      character(*), intent(in) :: more

      call read_text(plate//more//"*END")
   end subroutine read_plate

   !> Write a deck whose lines are parted by bars, and read it
   subroutine read_text(text)
      !> The deck
      character(*), intent(in) :: text

      integer :: i, unit

      open (newunit=unit, file=path, access="stream", form="unformatted", status="replace", &
         & action="write")
      do i = 1, len(text)
         write (unit) merge(achar(10), text(i:i), text(i:i) == "|")
      end do
      close (unit)
      call read_model(path, model, messages, error)
   end subroutine read_text

end program test_input_read_control
