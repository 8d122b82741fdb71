!> Histories of all Gauss points at time zero.
module plydyn_domain_initial_history
   use plydyn_base_precision, only : wp
   use plydyn_domain_domain, only : domain_type
   use plydyn_model_model, only : model_type
   implicit none
   private

   public :: start_histories

contains

   !> Let the laws of all elements start their histories, with the damage that the deck asks for
   pure subroutine start_histories(model, domain, history)
      !> The model
      type(model_type), intent(in) :: model
      !> The domain
      type(domain_type), intent(in) :: domain
      !> History of all Gauss points, zero in
      real(wp), intent(inout), contiguous :: history(:)
      integer :: g

      do g = 1, size(domain%groups)
         call domain%groups(g)%item%start_history(model, history)
      end do
   end subroutine start_histories

end module plydyn_domain_initial_history
