!> What steers a run: the end that the user asks for, the end after the largest load, rest.
program test_method_step_control
   use plydyn_base_precision, only : wp
   use plydyn_method_simulation, only : simulation_type
   use plydyn_method_step_control, only : at_rest, control_step, load_has_fallen, &
      & looks_at_volumes, no_reason
   use testing, only : begin, check, finish
   implicit none

   !> No end that the user asks for
   real(wp), parameter :: none = -1.0_wp

   call asked_end()
   call fallen_load()
   call rest()
   call volumes()
   call finish()

contains

   !> The user moves the end
   subroutine asked_end()
      type(simulation_type) :: simulation

      call begin("end")
      simulation = steps_of(1.0_wp, 100.0_wp)
      call simulation%state%advance_clock()
      call control(simulation, none)
      call check(simulation%state%end%time, 100.0_wp, 0.0_wp, "stays")
      call control(simulation, 50.0_wp)
      call check(simulation%state%end%time, 50.0_wp, 0.0_wp, "is that of the user")
   end subroutine asked_end

   !> Loads whose power falls from 1 to 0.4 after 60 of 100 seconds: below a half, the run ends
   subroutine fallen_load()
      type(simulation_type) :: simulation
      integer :: k

      call begin("largest load")
      simulation = steps_of(1.0_wp, 100.0_wp)
      simulation%domain%control%load_share = 0.5_wp
      do k = 1, 90
         call simulation%state%advance_clock()
         associate (work => simulation%state%energies%external)
            work = work + merge(1.0_wp, 0.4_wp, k <= 60)
         end associate
         call control(simulation, none)
         if (simulation%early_end%reason /= no_reason) exit
      end do
      call check(simulation%early_end%reason, load_has_fallen, "ends the run")
      call check(simulation%early_end%cycle, 61, "when it falls")
      call check(simulation%early_end%share, 0.4_wp, 1.0e-12_wp, "to this share")
      call check(simulation%state%end%cycle, 62, "the run ends with the next step")
   end subroutine fallen_load

   !> A mass of 2 on a spring, at a velocity of 1, then of 0.1: after a change of the damping it is
   !> critical for the frequency of the spring, 2 w = 2/s
   subroutine rest()
      type(simulation_type) :: simulation
      integer :: k

      call begin("rest")
      simulation = steps_of(1.0_wp, 1000.0_wp)
      simulation%domain%control%rest_share = 0.02_wp
      do k = 1, 160
         call simulation%state%advance_clock()
         associate (v => merge(1.0_wp, 0.1_wp, k <= 50), state => simulation%state)
            state%sums%twice_kinetic = 2.0_wp*v**2
            ! v K v of a step, with a stiffness of 2
            state%relaxation%stiffening = state%step*2.0_wp*v**2
         end associate
         call control(simulation, none)
         if (k == 50) call check(simulation%state%relaxation%damping_at(k + 2), 2.0_wp, &
            & 1.0e-12_wp, "critical damping, two steps later")
         if (simulation%early_end%reason /= no_reason) exit
      end do
      call check(simulation%early_end%reason, at_rest, "ends the run")
      call check(simulation%early_end%cycle, 100, "at the first look with a hundredth of energy")
      call check(simulation%early_end%share, 0.01_wp, 1.0e-12_wp, "which it notes")
      call check(simulation%early_end%frequency, 1.0_wp/(8.0_wp*atan(1.0_wp)), 1.0e-12_wp, &
         & "with the frequency of the spring")
   end subroutine rest

   !> Volumes are looked at now and then
   subroutine volumes()

      call begin("volumes")
      call check(looks_at_volumes(400) .and. .not. looks_at_volumes(401), "every 200 steps")
   end subroutine volumes

   !> Steer a step
   subroutine control(simulation, end_time)
      type(simulation_type), intent(inout) :: simulation
      real(wp), intent(in) :: end_time

      call control_step(simulation%domain, end_time, simulation%state, simulation%early_end)
   end subroutine control

   !> Steps of a run without elements
   function steps_of(step, end_time) result(simulation)
      real(wp), intent(in) :: step, end_time
      type(simulation_type) :: simulation

      allocate (simulation%domain)
      simulation%state%step = step
      simulation%state%end%time = end_time
   end function steps_of

end program test_method_step_control
