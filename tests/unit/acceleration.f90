!> Accelerations of a whole plate at once, as a step makes them chunk by chunk.
module acceleration
   use plydyn_base_precision, only : wp
   use plydyn_domain_domain, only : domain_type
   use plydyn_method_central_difference, only : add_chunk_sums, apply_masses
   use plydyn_method_energy, only : global_reduction_type
   use plydyn_method_workspace, only : new_workspace, workspace_type
   use plydyn_state_state, only : motion_sums_type, state_type
   implicit none
   private

   public :: accelerate_points

contains

   !> Accelerations of all points, and their sums
   subroutine accelerate_points(domain, step, velocity, force, sums)
      !> The plate
      type(domain_type), intent(in) :: domain
      !> The step just made
      real(wp), intent(in) :: step
      !> Velocity of all points, half a step before
      real(wp), intent(in) :: velocity(:)
      !> Force in, acceleration out
      real(wp), intent(inout) :: force(:)
      !> Sums over all points
      type(motion_sums_type), intent(out) :: sums

      type(global_reduction_type) :: reduction
      type(state_type) :: state
      type(workspace_type) :: work

      state%step_before = step
      state%velocity = velocity
      state%acceleration = force
      call new_workspace(domain, state, work)
      call apply_masses(domain, work, state)
      force(:) = state%acceleration
      call add_chunk_sums(work%chunk_sums, reduction)
      sums = reduction%motion_sums()
   end subroutine accelerate_points

end module acceleration
