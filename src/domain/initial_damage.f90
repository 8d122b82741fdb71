!> Damage of interfaces before the first step.
module plydyn_domain_initial_damage
   use plydyn_base_precision, only : lanes, wp
   use plydyn_domain_delamination, only : interface_ply
   use plydyn_domain_domain, only : domain_type
   use plydyn_element_interface, only : history_size, interface_type, point_positions, set_damage
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
                     call set_damage(batch, l, chosen_points(domain, batch, initial), &
                        & initial%damage, history(batch%first_history:batch%first_history - 1 &
                        & + history_size(batch)))
                  end do
               end associate
            end do
         end associate
      end do
   end subroutine set_initial_damage

   !> Points of the elements that are meant, within the circle, (points, quads)
   pure function chosen_points(domain, batch, initial) result(chosen)
      type(domain_type), intent(in) :: domain
      type(interface_type), intent(in) :: batch
      type(initial_damage_type), intent(in) :: initial
      logical :: chosen(size(batch%node, 1), size(batch%node, 2))

      real(wp) :: place(2, size(batch%node, 1), size(batch%node, 2))
      logical :: named(max(maxval(batch%quad), maxval(initial%quads)))
      integer :: e, q

      named(:) = .false.
      named(initial%quads) = .true.
      place(:, :, :) = point_positions(batch, domain%position)
      do e = 1, size(batch%node, 2)
         do q = 1, size(batch%node, 1)
            chosen(q, e) = named(batch%quad(e)) &
               & .and. norm2(place(:, q, e) - initial%centre) <= initial%radius
         end do
      end do
   end function chosen_points

end module plydyn_domain_initial_damage
