!> What the interfaces of a model have lost: areas and energies, one by one from the bottom up.
module plydyn_domain_delamination
   use plydyn_base_precision, only : lanes, wp
   use plydyn_domain_domain, only : domain_type
   use plydyn_element_interface, only : add_lanes, history_size, interface_sums_type, interface_type
   use plydyn_law_cohesive, only : damage_at
   implicit none
   private

   public :: can_fail, delamination, interface_losses, interface_ply, projected_area

   !> What one interface has lost, in all parts together
   type, public :: delamination_type
      !> Area where damage has begun, and where it is complete
      real(wp) :: begun = 0.0_wp, failed = 0.0_wp
      !> Energies lost in fracture, by a falling penalty, and in friction
      real(wp) :: fracture = 0.0_wp, closing = 0.0_wp, friction = 0.0_wp
   end type delamination_type

contains

   !> Whether some interface of a domain can fail
   pure logical function can_fail(domain)
      !> The domain
      type(domain_type), intent(in) :: domain

      can_fail = any(domain%interfaces%law%histories > 0)
   end function can_fail

   !> Ply below the interface in a lane, counted from the bottom: the number of the interface
   pure integer function interface_ply(domain, batch, lane) result(ply)
      !> The domain
      type(domain_type), intent(in) :: domain
      !> A batch of its interfaces
      type(interface_type), intent(in) :: batch
      !> A lane that has an interface
      integer, intent(in) :: lane

      ply = domain%layers%ply(batch%lower(lane))
   end function interface_ply

   !> Losses of the interfaces above each ply but the last, (plies - 1)
   pure function delamination(domain, history) result(lost)
      !> The domain
      type(domain_type), intent(in) :: domain
      !> History of all Gauss points
      real(wp), intent(in) :: history(:)
      type(delamination_type) :: lost(maxval(domain%layers%ply) - 1)

      type(interface_sums_type) :: sums
      integer :: b, k, l

      do b = 1, size(domain%interfaces)
         associate (batch => domain%interfaces(b))
            if (batch%law%histories == 0) cycle
            sums = interface_sums_type()
            call add_lanes(batch, history(batch%first_history:batch%first_history - 1 &
               & + history_size(batch)), sums)
            do l = 1, lanes
               if (batch%lower(l) == 0) cycle
               k = interface_ply(domain, batch, l)
               lost(k)%begun = lost(k)%begun + sums%begun(l)
               lost(k)%failed = lost(k)%failed + sums%failed(l)
               lost(k)%fracture = lost(k)%fracture + sums%fracture(l)
               lost(k)%closing = lost(k)%closing + sums%closing(l)
               lost(k)%friction = lost(k)%friction + sums%friction(l)
            end do
         end associate
      end do
   end function delamination

   !> Energies that all interfaces have lost in failing, a falling penalty included, and in friction
   pure function interface_losses(domain, history) result(losses)
      !> The domain
      type(domain_type), intent(in) :: domain
      !> History of all Gauss points
      real(wp), intent(in) :: history(:)
      real(wp) :: losses(2)

      type(delamination_type) :: lost(maxval(domain%layers%ply) - 1)

      losses(:) = 0.0_wp
      if (.not. can_fail(domain)) return
      lost(:) = delamination(domain, history)
      losses(:) = [sum(lost%fracture + lost%closing), sum(lost%friction)]
   end function interface_losses

   !> Area over which at least one interface has failed; Gauss points and nodes of a quad with the
   !> same place in tensor order count as one
   pure real(wp) function projected_area(domain, history) result(area)
      !> The domain
      type(domain_type), intent(in) :: domain
      !> History of all Gauss points
      real(wp), intent(in) :: history(:)

      real(wp), allocatable :: failed(:, :)
      integer :: b, p

      allocate (failed(domain%plates(1)%side**2, sum([(size(domain%plates(p)%quad), &
         & p=1, size(domain%plates))])))
      failed(:, :) = 0.0_wp
      do b = 1, size(domain%interfaces)
         associate (batch => domain%interfaces(b))
            if (batch%law%histories == 0) cycle
            call mark_failed(batch, history(batch%first_history:batch%first_history - 1 &
               & + history_size(batch)), failed)
         end associate
      end do
      area = sum(failed)
   end function projected_area

   !> Note the areas of the points of some interfaces that have failed
   pure subroutine mark_failed(batch, history, failed)
      type(interface_type), intent(in) :: batch
      !> History of these interfaces
      real(wp), intent(in) :: history(lanes, batch%law%histories, size(batch%node, 1), &
         & size(batch%node, 2))
      !> Area of the points at which an interface has failed, else 0; (points, quads of the mesh)
      real(wp), intent(inout) :: failed(:, :)

      integer :: e, q

      do e = 1, size(batch%node, 2)
         do q = 1, size(batch%node, 1)
            if (any(history(:, damage_at, q, e) >= 1.0_wp .and. batch%lower > 0)) then
               failed(q, batch%quad(e)) = batch%metric(5, q, e)
            end if
         end do
      end do
   end subroutine mark_failed

end module plydyn_domain_delamination
