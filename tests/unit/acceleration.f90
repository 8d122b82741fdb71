!> Accelerations of a whole plate at once, as a step makes them chunk by chunk.
module acceleration
   use plydyn_base_exact_sum, only : new_exact_sums
   use plydyn_base_precision, only : wp
   use plydyn_domain_domain, only : domain_type
   use plydyn_method_central_difference, only : accelerate, count_sums
   use plydyn_state_state, only : state_type, sums_of, sums_type, tally_sums
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
      type(sums_type), intent(out) :: sums

      type(state_type) :: state

      state%tally = new_exact_sums(tally_sums)
      state%velocity = velocity
      state%acceleration = force
      allocate (state%chunk_sums(size(domain%chunks%list)))
      call accelerate(domain, step, state)
      force(:) = state%acceleration
      call count_sums(state%chunk_sums, state%tally)
      sums = sums_of(state%tally)
   end subroutine accelerate_points

end module acceleration
