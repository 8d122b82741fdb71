!> What the interfaces of a model have lost: areas and energies, one by one from the bottom up.
module plydyn_domain_delamination
   use plydyn_base_exact_sum, only : exact_sums_type, new_exact_sums
   use plydyn_base_precision, only : lanes, wp
   use plydyn_domain_domain, only : domain_type
   use plydyn_element_interface, only : interface_sums_type, interface_type, sum_lanes
   use plydyn_law_cohesive_bilinear, only : damage_at
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

   !> Numbers of what one interface has lost
   integer, parameter :: losses = 5

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

   !> Losses of the interfaces above each ply but the last, (plies - 1). All ranks must come here,
   !> and get those of the whole model
   function delamination(domain, history) result(lost)
      !> The domain
      type(domain_type), intent(in) :: domain
      !> History of all Gauss points
      real(wp), intent(in) :: history(:)
      type(delamination_type) :: lost(maxval(domain%layers%ply) - 1)

      type(exact_sums_type) :: sums
      integer :: b, k

      sums = new_exact_sums(losses*size(lost))
      do b = 1, size(domain%interfaces)
         if (domain%interfaces(b)%law%histories == 0) cycle
         call count_batch(domain, domain%interfaces(b), &
            & history(domain%interfaces(b)%first_history:), sums)
      end do
      call domain%comm%sum(sums%limb)
      do k = 1, size(lost)
         associate (last => losses*k)
            lost(k) = delamination_type(begun=sums%value(last - 4), failed=sums%value(last - 3), &
               & fracture=sums%value(last - 2), closing=sums%value(last - 1), &
               & friction=sums%value(last))
         end associate
      end do
   end function delamination

   !> The share of a batch of interfaces, quad by quad
   pure subroutine count_batch(domain, batch, history, sums)
      type(domain_type), intent(in) :: domain
      type(interface_type), intent(in) :: batch
      real(wp), intent(in) :: history(lanes, size(batch%node, 1), size(batch%node, 2), &
         & batch%law%histories)
      type(exact_sums_type), intent(inout) :: sums

      type(interface_sums_type) :: part
      integer :: e, l

      do e = 1, size(batch%node, 2)
         part = sum_lanes(batch, e, history)
         do l = 1, lanes
            if (batch%lower(l) == 0) cycle
            associate (last => losses*interface_ply(domain, batch, l))
               call sums%add(last - 4, part%begun(l))
               call sums%add(last - 3, part%failed(l))
               call sums%add(last - 2, part%fracture(l))
               call sums%add(last - 1, part%closing(l))
               call sums%add(last, part%friction(l))
            end associate
         end do
      end do
   end subroutine count_batch

   !> Energies that interfaces have lost in failing, a falling penalty included, and in friction
   pure function interface_losses(lost) result(energies)
      !> What each of them has lost
      type(delamination_type), intent(in) :: lost(:)
      real(wp) :: energies(2)

      energies(:) = [sum(lost%fracture + lost%closing), sum(lost%friction)]
   end function interface_losses

   !> Area over which at least one interface has failed; Gauss points and nodes of a quad with the
   !> same place in tensor order count as one. All ranks must come here
   real(wp) function projected_area(domain, history) result(area)
      !> The domain
      type(domain_type), intent(in) :: domain
      !> History of all Gauss points
      real(wp), intent(in) :: history(:)

      real(wp), allocatable :: failed(:, :)
      type(exact_sums_type) :: sums
      integer :: b, e, p

      sums = new_exact_sums(1)
      do p = 1, size(domain%plates)
         allocate (failed(domain%plates(p)%side**2, size(domain%plates(p)%quad)), source=0.0_wp)
         do b = 1, size(domain%interfaces)
            associate (batch => domain%interfaces(b))
               if (batch%law%histories == 0 .or. batch%plate /= p) cycle
               call mark_failed(batch, history(batch%first_history:), failed)
            end associate
         end do
         do e = 1, size(failed, 2)
            call sums%add(1, sum(failed(:, e)))
         end do
         deallocate (failed)
      end do
      call domain%comm%sum(sums%limb)
      area = sums%value(1)
   end function projected_area

   !> Note the areas of the points of some interfaces that have failed
   pure subroutine mark_failed(batch, history, failed)
      type(interface_type), intent(in) :: batch
      !> History of these interfaces
      real(wp), intent(in) :: history(lanes, size(batch%node, 1), size(batch%node, 2), &
         & batch%law%histories)
      !> Area of the points at which an interface has failed, the largest of several, else 0;
      !> (points, quads of the plate)
      real(wp), intent(inout) :: failed(:, :)

      integer :: e, q

      do e = 1, size(batch%node, 2)
         do q = 1, size(batch%node, 1)
            if (any(history(:, q, e, damage_at) >= 1.0_wp .and. batch%lower > 0)) then
               failed(q, e) = max(failed(q, e), batch%metric(5, q, e))
            end if
         end do
      end do
   end subroutine mark_failed

end module plydyn_domain_delamination
