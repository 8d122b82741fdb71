!> What the interfaces of a model have lost: areas and energies, one by one from the bottom up.
module plydyn_domain_delamination
   use plydyn_base_exact_sum, only : exact_sums_type, new_exact_sums
   use plydyn_base_precision, only : wp
   use plydyn_domain_domain, only : domain_type
   use plydyn_element_group, only : losses
   implicit none
   private

   public :: can_fail, delamination, failing_interfaces, interface_losses, present_interfaces, &
      & projected_areas

   !> What one interface has lost, in all parts together
   type, public :: delamination_type
      !> Areas where damage has begun, where half of the toughness is spent, and where damage is
      !> complete
      real(wp) :: begun = 0.0_wp, delaminated = 0.0_wp, failed = 0.0_wp
      !> Energies lost in fracture, by a falling penalty, and in friction
      real(wp) :: fracture = 0.0_wp, closing = 0.0_wp, friction = 0.0_wp
   end type delamination_type

contains

   !> Interfaces of a domain, counted from the bottom
   pure function present_interfaces(domain) result(interfaces)
      type(domain_type), intent(in) :: domain
      integer, allocatable :: interfaces(:)

      interfaces = list_interfaces(domain, .false.)
   end function present_interfaces

   !> Interfaces that can fail, counted from the bottom
   pure function failing_interfaces(domain) result(interfaces)
      type(domain_type), intent(in) :: domain
      integer, allocatable :: interfaces(:)

      interfaces = list_interfaces(domain, .true.)
   end function failing_interfaces

   !> Plies above which there is an interface, or one that can fail
   pure function list_interfaces(domain, must_fail) result(interfaces)
      type(domain_type), intent(in) :: domain
      logical, intent(in) :: must_fail
      integer, allocatable :: interfaces(:)

      logical :: listed(maxval(domain%layers%ply))
      integer :: g, i

      listed(:) = .false.
      do g = 1, size(domain%groups)
         associate (group => domain%groups(g)%item)
            if (.not. allocated(group%springs)) cycle
            do i = 1, size(group%springs)
               associate (ply => domain%layers%ply(group%springs(i)%layer))
                  listed(ply) = listed(ply) .or. group%springs(i)%fails .or. .not. must_fail
               end associate
            end do
         end associate
      end do
      interfaces = pack([(i, i=1, size(listed))], listed)
   end function list_interfaces

   !> Whether some interface of a domain can fail
   pure logical function can_fail(domain)
      type(domain_type), intent(in) :: domain

      can_fail = size(failing_interfaces(domain)) > 0
   end function can_fail

   !> Losses of the interfaces above each ply but the last, (plies - 1). All ranks must come here,
   !> and get those of the whole model
   function delamination(domain, history) result(lost)
      type(domain_type), intent(in) :: domain
      !> History of all Gauss points
      real(wp), intent(in), contiguous :: history(:)
      type(delamination_type) :: lost(maxval(domain%layers%ply) - 1)

      type(exact_sums_type) :: sums
      integer :: g, k

      sums = new_exact_sums(losses*size(lost))
      do g = 1, size(domain%groups)
         call domain%groups(g)%item%add_losses(history, sums)
      end do
      call domain%comm%sum(sums%limb)
      do k = 1, size(lost)
         associate (last => losses*k)
            lost(k) = delamination_type(begun=sums%value(last - 5), &
               & delaminated=sums%value(last - 4), failed=sums%value(last - 3), &
               & fracture=sums%value(last - 2), closing=sums%value(last - 1), &
               & friction=sums%value(last))
         end associate
      end do
   end function delamination

   !> Energies that interfaces have lost in failing, a falling penalty included, and in friction
   pure function interface_losses(lost) result(energies)
      !> What each of them has lost
      type(delamination_type), intent(in) :: lost(:)
      real(wp) :: energies(2)

      energies(:) = [sum(lost%fracture + lost%closing), sum(lost%friction)]
   end function interface_losses

   !> Areas over which at least one interface is delaminated, and over which one has failed; Gauss
   !> points and nodes of a quad with the same place in tensor order count as one. All ranks must
   !> come here
   function projected_areas(domain, history) result(projected)
      type(domain_type), intent(in) :: domain
      !> History of all Gauss points
      real(wp), intent(in), contiguous :: history(:)
      real(wp) :: projected(2)

      real(wp), allocatable :: areas(:, :, :)
      type(exact_sums_type) :: sums
      integer :: e, g, k, s

      sums = new_exact_sums(2)
      do s = 1, maxval([0, (domain%groups(g)%item%set, g=1, size(domain%groups))])
         do g = 1, size(domain%groups)
            if (domain%groups(g)%item%set /= s) cycle
            call domain%groups(g)%item%add_losses(history, areas=areas)
         end do
         if (.not. allocated(areas)) cycle
         do e = 1, size(areas, 3)
            do k = 1, 2
               call sums%add(k, sum(areas(k, :, e)))
            end do
         end do
         deallocate (areas)
      end do
      call domain%comm%sum(sums%limb)
      projected(:) = [(sums%value(k), k=1, 2)]
   end function projected_areas

end module plydyn_domain_delamination
