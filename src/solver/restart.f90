!> A run that goes on from a restart file.
module plydyn_solver_restart
   use plydyn_base_error, only : error_type
   use plydyn_base_precision, only : wp
   use plydyn_domain_domain, only : domain_type
   use plydyn_model_control, only : changes_type
   use plydyn_output_dump_input, only : dump_input_type
   use plydyn_solver_explicit, only : find_accelerations
   use plydyn_solver_energies, only : balance
   use plydyn_solver_setup, only : run_type
   use plydyn_solver_start, only : new_state
   use plydyn_solver_supports, only : support_points
   use plydyn_state_state, only : state_type
   implicit none
   private

   public :: resume

contains

   !> Take the state of a restart file
   subroutine resume(dump, run, error)
      !> The file, open on the root
      type(dump_input_type), intent(inout) :: dump
      !> All that a run needs; its state at time zero is replaced, and its contacts get their memory
      !> back
      type(run_type), intent(inout) :: run
      !> The file is not for this model; the same on all ranks
      type(error_type), allocatable, intent(out) :: error

      real(wp) :: end_time
      integer :: end_cycle

      associate (changes => run%model%changes, state => run%state)
         end_time = state%end_time
         end_cycle = state%end_cycle
         if (run%domain%comm%ranks == 1) then
            call read_state(dump, changes, state, error)
         else
            call share_state(dump, run, error)
         end if
         if (allocated(error)) return
         call run%contacts%recall(state, error)
         if (allocated(error)) return
         if (changes%end) then
            state%end_time = end_time
            state%end_cycle = end_cycle
         end if
         if (changes%conditions) call change_conditions(run%domain, state)
      end associate
   end subroutine resume

   !> Read a state; supports and loads are not those of the model where a deck changes them
   subroutine read_state(dump, changes, state, error)
      type(dump_input_type), intent(inout) :: dump
      type(changes_type), intent(in) :: changes
      !> At time zero
      type(state_type), intent(inout) :: state
      type(error_type), allocatable, intent(out) :: error

      if (changes%conditions) then
         deallocate (state%load_factor, state%support_force, state%support_velocity)
      end if
      call dump%read_state(state, error)
   end subroutine read_state

   !> Let the root read the state of the whole model, and give every rank its part
   subroutine share_state(dump, run, error)
      type(dump_input_type), intent(inout) :: dump
      type(run_type), intent(inout) :: run
      type(error_type), allocatable, intent(out) :: error

      type(state_type) :: whole

      if (run%domain%comm%is_root()) then
         whole = new_state(run%model, run%whole)
         call read_state(dump, run%model%changes, whole, error)
      end if
      call run%domain%comm%tell(error)
      if (allocated(error)) return
      call run%assembly%scatter(whole, .not. run%model%changes%conditions, run%state)
   end subroutine share_state

   !> Let other supports and loads act from now on
   !>
   !> What they take from the motion at once, or give to it, is work from outside.
   subroutine change_conditions(domain, state)
      !> The domain with the new supports and loads
      type(domain_type), intent(in) :: domain
      !> The state
      type(state_type), intent(inout) :: state

      real(wp), allocatable :: history(:)
      real(wp) :: external, internal, total
      integer :: m

      state%velocity(domain%held) = 0.0_wp
      deallocate (state%load_factor, state%support_force, state%support_velocity)
      allocate (state%load_factor(size(domain%loads)), state%support_force(support_points(domain)))
      allocate (state%support_velocity(0))
      do m = 1, size(domain%motions)
         state%support_velocity = [state%support_velocity, &
            & state%velocity(domain%motions(m)%freedom)]
      end do
      associate (e => state%energies)
         total = e%total()
         external = e%external
         internal = e%internal
         history = state%history
         call find_accelerations(domain, state)
         call balance(domain, state)
         ! no step was made: what is stored and dissipated is what it was
         state%history(:) = history
         e%internal = internal
         e%external = external + e%total() - total
      end associate
   end subroutine change_conditions

end module plydyn_solver_restart
