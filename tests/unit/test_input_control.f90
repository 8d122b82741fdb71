!> The run is as long and as careful as the deck says.
program test_input_control
   use decks, only : plate, read_lines
   use plydyn_base_error, only : error_type
   use plydyn_base_precision, only : wp
   use plydyn_model_control, only : all_explicit, implicit_thickness, &
      & linear_strain, total_lagrangian
   use plydyn_model_model, only : model_type
   use testing, only : begin, check, check_error, finish
   implicit none

   character(*), parameter :: path = "test_input_control.k"
   type(model_type) :: model
   type(error_type), allocatable :: error
   character(:), allocatable :: messages

   call begin("control")
   call read_plate("")
   associate (control => model%control)
      call check(control%end_time, 1.0_wp, 0.0_wp, "end time")
      call check(control%step_share(), 0.8_wp, 0.0_wp, "usual share with large displacement")
      call check(control%kinematics, total_lagrangian, "usual kinematics")
      call check(control%energy_limit, 0.05_wp, 0.0_wp, "usual limit of the balance")
      call check(control%kinetic_limit, 0.0_wp, 0.0_wp, "no limit of the kinetic energy")
      call check(control%scheme, all_explicit, "all explicit")
   end associate
   call read_plate("*CONTROL_TIMESTEP|1.e-6,0.0,0,0.,0.,3|*CONTROL_LAYERWISE|0,0.1,2,2.e-8|" &
      & //"*DAMPING_GLOBAL|0,25.|*DAMPING_RELAXATION|1.e-5|*CONTROL_ENERGY|2,2,2,2|" &
      & //"*CONTROL_QUASI_STATIC|0.02|" &
      & //"*CONTROL_PARALLEL|4,0,1|" &
      & //"*DEFINE_CURVE|3,|0.,1.e-6|1.,1.e-6|*TITLE|A plate, flat|")
   call check(.not. allocated(error), "is read")
   associate (control => model%control)
      call check(control%first_step, 1.0e-6_wp, 0.0_wp, "first step")
      call check(control%step_share(), 0.9_wp, 0.0_wp, "a zero means that of linear strain")
      call check(control%step_curve, 1, "curve of the largest step")
      call check(control%kinematics, linear_strain, "kinematics")
      call check(control%energy_limit, 0.1_wp, 0.0_wp, "limit of the balance")
      call check(control%scheme, implicit_thickness, "what is implicit")
      call check(control%rest_share, 1.0e-5_wp, 0.0_wp, "kinetic energy at rest")
      call check(control%kinetic_limit, 0.02_wp, 0.0_wp, "limit of the kinetic energy")
      call check(control%largest_step, 2.0e-8_wp, 0.0_wp, "largest step")
      call check(control%threads, 4, "threads")
      call check(control%damping, 25.0_wp, 0.0_wp, "damping")
   end associate
   call check(model%title == "A plate, flat", "title")
   call check(model%control%mass_scaled_step, 0.0_wp, 0.0_wp, "no mass is added")

   call begin("read_control_timestep")
   call read_plate("*CONTROL_TIMESTEP|0.,0.8,0,0.,-2.e-6|")
   call check(.not. allocated(error), "is read")
   call check(model%control%mass_scaled_step, 2.0e-6_wp, 0.0_wp, "step for which mass is added")
   call read_plate("*CONTROL_TIMESTEP|0.,0.8,0,0.,2.e-6|")
   call check_error(error, "DT2MS: a positive value", "one step for all is refused")
   call read_plate("*CONTROL_TIMESTEP|0.,0.5,0,0.,-2.e-6|*CONTROL_LAYERWISE|0,0.1,0,1.e-6|")
   call check(.not. allocated(error), "DTMAX may be the step")
   call read_plate("*CONTROL_TIMESTEP|0.,0.8,0,0.,-2.e-6|*CONTROL_LAYERWISE|0,0.1,0,1.e-6|")
   call check_error(error, "but DTMAX of *CONTROL_LAYERWISE", "mass for nothing is refused")
   call read_plate("*CONTROL_TIMESTEP|0.,0.8,0,0.,-2.e-6,3|*DEFINE_CURVE|3,|0.,1.e-6|1.,1.e-6|")
   call check_error(error, "or the curve LCTM keeps it at 1e-6", "a curve counts as well")

   call begin("read_control_termination")
   call read_lines(path, "*KEYWORD|*CONTROL_TERMINATION|2.0,100,0.01,0.,0.,1|" &
      & //plate(index(plate, "*NODE"):)//"*END", model, messages, error)
   call check(.not. allocated(error), "is read")
   call check(model%control%end_cycle, 100, "last cycle")
   call check(model%control%smallest_share, 0.01_wp, 0.0_wp, "smallest step")
   call check(model%control%check_only, "check only")

   call begin("read_control_end_of_contact")
   call read_plate("")
   call check(model%control%contact_pause, 0.0_wp, 0.0_wp, "no end after the contact")
   call read_plate("*CONTROL_END_OF_CONTACT|2.e-4|")
   call check(model%control%contact_pause, 2.0e-4_wp, 0.0_wp, "time after the contact")
   call read_plate("*CONTROL_END_OF_CONTACT|-2.e-4|")
   call check_error(error, "DUR", "a negative time is refused")
   call read_plate("*TERMINATION_CONTACT|1,0.,1.e-4|")
   call check_error(error, "CONTROL_END_OF_CONTACT", "LS-DYNA's keyword has another way")

   call begin("keywords of a run")
   call read_twice("*TITLE|a plate")
   call read_twice("*CONTROL_UNITS|m, ms, kg")
   call read_twice("*CONTROL_TERMINATION|1.")
   call read_twice("*CONTROL_TIMESTEP|1.e-6")
   call read_twice("*CONTROL_ENERGY|2,2,2,2")
   call read_twice("*CONTROL_PARALLEL|1")
   call read_twice("*CONTROL_LAYERWISE|0")
   call read_twice("*CONTROL_QUASI_STATIC|0.05")
   call read_twice("*CONTROL_END_OF_CONTACT|2.e-4")
   call read_twice("*CONTROL_HOURGLASS|5")
   call read_twice("*DAMPING_GLOBAL|0,25.")
   call read_twice("*DAMPING_RELAXATION|1.e-5")
   call read_twice("*LOAD_BODY_Z|0,9.8")
   call read_twice("*DATABASE_GLSTAT|1.")
   call read_twice("*DATABASE_BINARY_D3PLOT|1.")
   call read_twice("*DATABASE_BINARY_D3DUMP|10.")
   call read_twice("*DATABASE_BINARY_RUNRSF|10.")

   call begin("read_control_units")
   call read_plate("*CONTROL_UNITS|m, ms, kg|")
   call check(.not. allocated(error), "is read")
   call check(model%control%units%force == "MN" .and. model%control%units%stress == "MPa", "units")

   call finish()

contains

   !> Read the plate with a keyword and the same again
   subroutine read_twice(lines)
      !> The keyword and its card, parted by a bar
      character(*), intent(in) :: lines

      call read_plate(lines//"|"//lines//"|")
      call check_error(error, "the keyword occurs twice in the deck", &
         & lines(:index(lines, "|") - 1)//" is refused a second time")
   end subroutine read_twice

   !> Write the plate and some more lines, parted by bars, and read it all
   subroutine read_plate(more)
      !> Lines behind those of the plate
      character(*), intent(in) :: more

      call read_lines(path, plate//more//"*END", model, messages, error)
   end subroutine read_plate

end program test_input_control
