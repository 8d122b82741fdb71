!> A run that goes on from a restart file.
module plydyn_run_restart
   use plydyn_base_error, only : error_type, exit_input, fail
   use plydyn_base_memory, only : copy_pages
   use plydyn_base_precision, only : wp
   use plydyn_base_text, only : text
   use plydyn_domain_domain, only : domain_type
   use plydyn_io_checkpoint_dump_input, only : dump_input_type
   use plydyn_method_accelerations, only : begin_accelerations
   use plydyn_method_contact_setup, only : new_contacts
   use plydyn_method_energy, only : global_reduction_type, measure_energies
   use plydyn_method_fixture_step, only : place_new_fixtures
   use plydyn_run_setup, only : run_type
   use plydyn_method_supports, only : is_active, support_points
   use plydyn_model_support, only : prescribes_displacement
   use plydyn_state_state, only : relaxation_state_type, state_type
   implicit none
   private

   public :: jump_warning, resume

contains

   !> Take the state of a restart file
   subroutine resume(dump, run, kinetic, error)
      !> The file, open
      type(dump_input_type), intent(inout) :: dump
      !> All that a run needs; its state at time zero is replaced, and its contacts get their memory
      !> back
      type(run_type), intent(inout) :: run
      !> Kinetic energy of the plate before and after the changes of the deck
      real(wp), intent(out) :: kinetic(2)
      !> The file is not for this model; the same on all ranks
      type(error_type), allocatable, intent(out) :: error

      real(wp) :: end_time
      integer :: end_cycle

      associate (changes => run%model%changes, state => run%state)
         end_time = state%end%time
         end_cycle = state%end%cycle
         state%fixtures%height = huge(1.0_wp)
         kinetic(:) = 0.0_wp
         call dump%read_state(run%state_parts, changes, state, error)
         if (allocated(error)) return
         run%model%planes(:) = state%supports%planes
         if (changes%bodies) then
            call new_contacts(run%domain, state, run%contacts, error)
            call place_new_fixtures(run%domain, state)
         else
            call run%contacts%restore(state, error)
         end if
         if (allocated(error)) return
         if (changes%end) then
            state%end%time = end_time
            state%end%cycle = end_cycle
            call check_end(state, error)
            if (allocated(error)) return
         end if
         if (changes%relaxation) state%relaxation = relaxation_state_type()
         ! DTMIN counts from the new step
         if (changes%step) state%first_step = run%domain%step
         kinetic(1) = state%energies%kinetic
         if (changes%conditions .or. changes%bodies .or. changes%step) then
            call change_conditions(run%domain, changes%step, state)
         end if
         kinetic(2) = state%energies%kinetic
      end associate
   end subroutine resume

   !> A warning where a displacement that the deck of a restart prescribes is not that of its
   !> points, which then jump; empty otherwise. All ranks must come here
   function jump_warning(run) result(words)
      !> With the state of the restart file
      type(run_type), intent(in) :: run
      character(:), allocatable :: words

      !> Share of the largest displacement of the plate below which a jump is none
      real(wp), parameter :: round_off = 1.0e-6_wp
      integer :: m
      real(wp) :: jump(1), largest(1)

      words = ""
      largest(1) = maxval(abs(run%state%displacement))
      call run%domain%comm%max(largest)
      do m = 1, size(run%domain%supports%motions)
         jump(1) = 0.0_wp
         associate (motion => run%domain%supports%motions(m), state => run%state)
            if (motion%quantity /= prescribes_displacement .or. .not. is_active(motion, &
               & state%time)) cycle
            if (size(motion%freedom) > 0) jump(1) = maxval(abs(state%displacement(motion%freedom) &
               & - motion%scale*run%domain%curves(motion%curve)%at(state%time)))
            call run%domain%comm%max(jump)
         end associate
         if (jump(1) <= round_off*largest(1)) cycle
         words = "warning: "//trim(run%model%motions(m)%name)//" moves its points by up to " &
            & //text(jump(1), 4)//" in the first step: a displacement counts from the undeformed " &
            & //"plate; right would be a curve that begins where they are, or VAD 0 for a velocity"
         return
      end do
   end function jump_warning

   !> The end that the deck of a restart asks for is still to come
   subroutine check_end(state, error)
      !> The state of the restart file, with the new end
      type(state_type), intent(in) :: state
      !> The end has passed
      type(error_type), allocatable, intent(out) :: error

      if (state%end%time > state%time .and. (state%end%cycle == 0 &
         & .or. state%end%cycle > state%cycle)) return
      call fail(error, exit_input, "*CONTROL_TERMINATION ends the run before it goes on: the " &
         & //"restart file is of time "//text(state%time)//", cycle "//text(state%cycle) &
         & //"; ENDTIM and ENDCYC, if given, must lie behind")
   end subroutine check_end

   !> Change supports, loads, bodies, and masses. Energy that they take from the motion at once, or
   !> give to it, is external work: points keep their velocity when their mass changes
   subroutine change_conditions(domain, has_new_step, state)
      !> The domain with the new supports, loads and masses
      type(domain_type), intent(in) :: domain
      !> Whether the step and the masses may be others
      logical, intent(in) :: has_new_step
      type(state_type), intent(inout) :: state

      real(wp) :: total
      integer :: m
      type(global_reduction_type) :: reduction

      state%velocity(domain%supports%held) = 0.0_wp
      deallocate (state%supports%load_factor, state%supports%force, state%supports%velocity)
      allocate (state%supports%load_factor(size(domain%loads)))
      allocate (state%supports%force(support_points(domain)))
      associate (e => state%energies)
         total = e%total()
         if (has_new_step) call change_step(domain, state)
         allocate (state%supports%velocity(0))
         do m = 1, size(domain%supports%motions)
            state%supports%velocity = [state%supports%velocity, &
               & state%velocity(domain%supports%motions(m)%freedom)]
         end do
         call accelerate(domain, state, reduction)
         call measure_energies(domain, reduction, state%step_before, state)
         e%external = e%external + e%total() - total
         call e%raise_reference()
         state%end%begin = state%time
         state%end%largest_power = 0.0_wp
         state%end%look_time = state%time
         state%end%look_work = e%external
      end associate
   end subroutine change_conditions

   !> Let the velocity that is kept be that half a new step before, with the new masses: at the full
   !> step it stays what it was
   subroutine change_step(domain, state)
      type(domain_type), intent(in) :: domain
      type(state_type), intent(inout) :: state

      real(wp), allocatable :: before(:)
      type(global_reduction_type) :: reduction

      before = state%acceleration(:size(state%velocity))
      call accelerate(domain, state, reduction)
      state%velocity(:) = state%velocity + 0.5_wp*(state%step_before*before &
         & - domain%step*state%acceleration(:size(before)))
      state%velocity(domain%supports%held) = 0.0_wp
      state%step_before = domain%step
   end subroutine change_step

   !> Accelerations with the conditions of the deck; no step is made, and histories stay
   subroutine accelerate(domain, state, reduction)
      type(domain_type), intent(in) :: domain
      type(state_type), intent(inout) :: state
      !> Sums over all points
      type(global_reduction_type), intent(out) :: reduction

      real(wp), allocatable :: history(:)

      call copy_pages(state%history, history)
      call begin_accelerations(domain, state, reduction)
      call move_alloc(history, state%history)
   end subroutine accelerate

end module plydyn_run_restart
