!> Histories of all Gauss points at time zero.
module plydyn_domain_initial_history
   use plydyn_base_precision, only : wp
   use plydyn_domain_domain, only : domain_type
   use plydyn_model_model, only : model_type
   implicit none
   private

   public :: set_initial_damage, start_histories

contains

   !> Let the laws of all elements start their histories
   pure subroutine start_histories(domain, history)
      type(domain_type), intent(in) :: domain
      !> History of all Gauss points, zero in
      real(wp), intent(inout), contiguous :: history(:)
      integer :: g

      do g = 1, size(domain%groups)
         call domain%groups(g)%item%start_history(history)
      end do
   end subroutine start_histories

   !> Begin with the damage that the deck asks for
   subroutine set_initial_damage(model, domain, history)
      type(model_type), intent(in) :: model
      type(domain_type), intent(in) :: domain
      !> History of all Gauss points
      real(wp), intent(inout), contiguous :: history(:)
      integer :: g, i

      do i = 1, size(model%initial_damages)
         do g = 1, size(domain%groups)
            call domain%groups(g)%item%set_damage(model%mesh, model%initial_damages(i), history)
         end do
      end do
   end subroutine set_initial_damage

end module plydyn_domain_initial_history
