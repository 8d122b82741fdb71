!> Accelerations of a whole plate at once, as a step makes them chunk by chunk.
module acceleration
   use plydyn_base_exact_sum, only : exact_sums_type, new_exact_sums
   use plydyn_base_precision, only : wp
   use plydyn_domain_domain, only : domain_type
   use plydyn_solver_motion, only : accelerate, count_sums
   use plydyn_state_state, only : sums_of, sums_type, tally_sums
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

      type(exact_sums_type) :: tally
      type(sums_type) :: chunk_sums(size(domain%chunks))

      tally = new_exact_sums(tally_sums)
      call accelerate(domain, step, velocity, force, chunk_sums)
      call count_sums(chunk_sums, tally)
      sums = sums_of(tally)
   end subroutine accelerate_points

end module acceleration
