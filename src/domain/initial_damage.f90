!> Damage of interfaces before the first step.
module plydyn_domain_initial_damage
   use plydyn_base_precision, only : lanes, wp
   use plydyn_domain_delamination, only : interface_ply
   use plydyn_domain_domain, only : domain_type
   use plydyn_element_interface, only : history_size, interface_type, set_damage
   use plydyn_fem_quad_points, only : quad_points
   use plydyn_model_initial, only : initial_damage_type
   use plydyn_model_model, only : model_type
   implicit none
   private

   public :: set_initial_damage

contains

   !> Let interfaces begin as the deck says
   subroutine set_initial_damage(model, domain, history)
      !> The model
      type(model_type), intent(in) :: model
      !> The domain
      type(domain_type), intent(in) :: domain
      !> History of all Gauss points
      real(wp), intent(inout) :: history(:)

      integer :: b, i, l, ply

      do i = 1, size(model%initial_damages)
         associate (initial => model%initial_damages(i))
            do b = 1, size(domain%interfaces)
               associate (batch => domain%interfaces(b))
                  if (batch%plate /= initial%part) cycle
                  do l = 1, lanes
                     if (batch%lower(l) == 0 .or. batch%law%histories == 0) cycle
                     ply = interface_ply(domain, batch, l)
                     if (ply < initial%interfaces(1) .or. ply > initial%interfaces(2)) cycle
                     call set_damage(batch, l, chosen_points(model, batch, initial), &
                        & initial%damage, history(batch%first_history:batch%first_history - 1 &
                        & + history_size(batch)))
                  end do
               end associate
            end do
         end associate
      end do
   end subroutine set_initial_damage

   !> Points of the elements that are meant, within the circle, (points, quads)
   pure function chosen_points(model, batch, initial) result(chosen)
      type(model_type), intent(in) :: model
      type(interface_type), intent(in) :: batch
      type(initial_damage_type), intent(in) :: initial
      logical :: chosen(size(batch%node, 1), size(batch%node, 2))

      logical :: named(max(maxval(batch%quad), maxval(initial%quads)))
      integer :: e

      named(:) = .false.
      named(initial%quads) = .true.
      chosen(:, :) = .false.
      do e = 1, size(batch%quad)
         if (.not. named(batch%quad(e))) cycle
         associate (nodes => model%mesh%quad_node(:, batch%quad(e)))
            chosen(:, e) = initial%encloses(quad_points(model%mesh%position(:2, nodes), &
               & batch%nodal))
         end associate
      end do
   end function chosen_points

end module plydyn_domain_initial_damage
