!> A run ends at its time or after its steps, and energies are added up with their signs.
program test_state_state
   use plydyn_base_precision, only : wp
   use plydyn_state_state, only : energies_type, relaxation_state_type, state_type
   use testing, only : begin, check, finish
   implicit none

   call test_last_step()
   call test_end_time()
   call test_balance()
   call test_change_of_damping()
   call finish()

contains

   subroutine test_last_step()
      type(state_type) :: state

      call begin("number of steps")
      state%end%time = 1.0_wp
      state%step = 0.01_wp
      state%end%cycle = 3
      call check(.not. state%ends_after(), "is not reached by the first one")
      call state%advance_clock()
      call state%advance_clock()
      call check(state%cycle, 2, "is counted")
      call check(state%ends_after(), "is reached by the last one")
      call check(.not. state%is_finished(), "is not reached before it")
      call state%advance_clock()
      call check(state%is_finished(), "is reached after it")
      call check(state%time, 3*0.01_wp, 1.0e-15_wp, "advances the time, too")
      call check(state%step_before, 0.01_wp, 0.0_wp, "leaves the step behind it")
      state%end%cycle = 0
      call check(.not. state%is_finished(), "of zero is no limit")
   end subroutine test_last_step

   subroutine test_end_time()
      type(state_type) :: state

      call begin("end time")
      state%end%time = 1.0_wp
      state%time = 0.8_wp
      state%step = 0.1_wp
      call check(.not. state%ends_after(), "is not reached by a step that is too short")
      state%step = 0.2_wp
      call check(state%ends_after(), "is reached by a step up to it")
      call check(.not. state%is_finished(), "is not reached before that")
      call state%advance_clock()
      call check(state%is_finished(), "is reached after it")
      state%end%begin = 0.5_wp
      call check(state%end%has_just_begun(0.54_wp), "lies far from a time soon after the beginning")
      call check(.not. state%end%has_just_begun(0.56_wp), "lies no longer far after a tenth")
   end subroutine test_end_time

   !> Each energy is a power of 2, so that each sum of them is one of a kind
   subroutine test_balance()
      type(energies_type) :: energies

      call begin("energy balance")
      energies%kinetic = 1.0_wp
      energies%added = 2.0_wp
      energies%half_step_correction = 4.0_wp
      energies%step_change = 8.0_wp
      energies%internal = 16.0_wp
      energies%impactor = 32.0_wp
      energies%damping = 64.0_wp
      energies%contact = 128.0_wp
      energies%friction = 256.0_wp
      call check(energies%total(), 511.0_wp - 2*4.0_wp, 0.0_wp, &
         & "holds what is stored, dissipated and lost")
      call check(energies%kinetic_share(), 1.0_wp/16.0_wp, 1.0e-15_wp, &
         & "gives the kinetic share of the internal energy")
      call check(energies%error(), 0.0_wp, 0.0_wp, "has no error while nothing went in")
      energies%start = 100.0_wp
      energies%external = -400.0_wp
      call energies%raise_reference()
      call check(energies%error(), (503.0_wp - 100.0_wp + 400.0_wp)/500.0_wp, 1.0e-15_wp, &
         & "has an error as a share of what went in")
      energies%external = 300.0_wp
      call energies%raise_reference()
      call check(energies%reference, 500.0_wp, 0.0_wp, "keeps the largest energy that went in")
   end subroutine test_balance

   subroutine test_change_of_damping()
      type(relaxation_state_type) :: relaxation

      call begin("damping of relaxation")
      relaxation%damping = 1.0_wp
      relaxation%next_damping = 2.0_wp
      relaxation%change_cycle = 5
      call check(relaxation%damping_at(4), 1.0_wp, 0.0_wp, "stays up to its change")
      call check(relaxation%damping_at(5), 2.0_wp, 0.0_wp, "changes in the step of its change")
   end subroutine test_change_of_damping

end program test_state_state
