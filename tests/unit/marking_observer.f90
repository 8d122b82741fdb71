!> An observer that marks the steps of which it is notified.
module marking_observer
   use plydyn_base_error, only : error_type
   use plydyn_base_precision, only : wp
   use plydyn_method_observer, only : observer_type, requests_type
   use plydyn_method_simulation, only : simulation_type
   implicit none
   private

   !> Marks a step, or makes a request in it
   type, public, extends(observer_type) :: marking_observer_type
      !> Whether it requests a line of progress, and marks nothing
      logical :: has_request = .false.
   contains
      procedure :: pass_requests
      procedure :: notify
   end type marking_observer_type

contains

   !> Pass a request for a flush
   subroutine pass_requests(self, simulation, requests)
      class(marking_observer_type), intent(inout) :: self
      class(simulation_type), intent(in) :: simulation
      type(requests_type), intent(inout) :: requests

      requests%flush = .true.
   end subroutine pass_requests

   !> Leave the number of the step in place of the least volume
   subroutine notify(self, simulation, requests, error)
      class(marking_observer_type), intent(inout) :: self
      class(simulation_type), intent(in) :: simulation
      type(requests_type), intent(inout) :: requests
      type(error_type), allocatable, intent(out) :: error

      if (self%has_request) then
         requests%progress = .true.
      else
         requests%least_volume = real(simulation%state%cycle, wp)
      end if
   end subroutine notify

end module marking_observer
