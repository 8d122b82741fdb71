!> The stable step of the whole domain, and which element sets it.
module plydyn_domain_step_limit
   use plydyn_base_precision, only : wp
   use plydyn_domain_critical_elements, only : find_slowest
   use plydyn_domain_domain, only : critical_element_type, domain_type, step_limit_type
   use plydyn_domain_pair_inertia, only : implicit_share
   use plydyn_model_control, only : all_explicit, implicit_thickness
   use plydyn_model_model, only : model_type
   implicit none
   private

   public :: find_step_limit, largest_point_factor

contains

   !> Largest eigenvalue of the elements, plus that of the springs between their points: their sum
   !> bounds the largest of the whole. All ranks must come here
   function find_step_limit(model, domain) result(limit)
      type(model_type), intent(in) :: model
      !> The domain; the elements of this rank are known
      type(domain_type), intent(in) :: domain
      type(step_limit_type) :: limit

      limit%slowest = find_slowest(domain%comm, element_rates(model, domain))
      call add_spring_rates(model, domain, limit%interface_rate, limit%interface_rest)
      associate (worst => limit%slowest(1), group => domain%groups(limit%slowest(1)%group)%item)
         limit%element_rate = worst%rate
         limit%step = 2.0_wp/sqrt(limit%element_rate + limit%interface_rest)
         limit%element_id = group%element_id(model%mesh, worst%element)
         limit%plane_rate = group%rate_without_thickness(model, worst%element, &
            & 4.0_wp*implicit_share)
      end associate
   end function find_step_limit

   !> Eigenvalues of all elements of this rank
   function element_rates(model, domain) result(elements)
      type(model_type), intent(in) :: model
      type(domain_type), intent(in) :: domain
      type(critical_element_type), allocatable :: elements(:)

      real(wp), allocatable :: rate(:)
      integer, allocatable :: layer(:)
      integer :: e, g

      allocate (elements(0))
      do g = 1, size(domain%groups)
         associate (group => domain%groups(g)%item)
            call group%find_rates(model, merge(4.0_wp*implicit_share, 0.0_wp, &
               & domain%control%scheme == implicit_thickness), rate, layer)
            elements = [elements, (critical_element_type(g, group%element(e), layer(e), rate(e)), &
               & e=1, size(rate))]
         end associate
      end do
   end function element_rates

   !> Bound on the eigenvalues of springs between points: stiffness over the mass per area of both
   !> faces, times the largest eigenvalue that the points of one element have against the areas of
   !> its nodes. Where interfaces are implicit the inertia that they add at the nodes outweighs all
   !> or most of that: with K the springs at the points and K' those at the nodes, dt**2 K/4 is no
   !> more than beta dt**2 K' as long as the eigenvalue of K against K' is no more than 4 beta
   subroutine add_spring_rates(model, domain, rate, rest)
      type(model_type), intent(in) :: model
      type(domain_type), intent(in) :: domain
      !> Of all springs, and of those that are not implicit
      real(wp), intent(out) :: rate, rest

      real(wp) :: factor
      integer :: g

      rate = 0.0_wp
      rest = 0.0_wp
      factor = largest_point_factor(model, domain)
      if (factor <= 0.0_wp) return
      do g = 1, size(domain%groups)
         rate = max(rate, domain%groups(g)%item%spring_rate(model, domain%columns, factor))
      end do
      rest = rate
      if (domain%control%scheme /= all_explicit) then
         rest = rate*max(0.0_wp, 1.0_wp - 4.0_wp*implicit_share/factor)
      end if
   end subroutine add_spring_rates

   !> Largest eigenvalue that the points of springs over one element have against the areas of its
   !> nodes; 0 without springs. All ranks must come here
   real(wp) function largest_point_factor(model, domain) result(factor)
      !> The model
      type(model_type), intent(in) :: model
      !> The domain; the elements of this rank are known
      type(domain_type), intent(in) :: domain

      logical :: has_springs(size(domain%groups))
      real(wp) :: largest(1)
      integer :: g

      factor = 0.0_wp
      has_springs(:) = [(domain%groups(g)%item%has_springs(), g=1, size(has_springs))]
      if (.not. any(has_springs)) return
      largest(:) = 0.0_wp
      do g = 1, size(domain%groups)
         largest(:) = max(largest, domain%groups(g)%item%point_factor(model%mesh))
      end do
      call domain%comm%max(largest)
      factor = largest(1)
   end function largest_point_factor

end module plydyn_domain_step_limit
