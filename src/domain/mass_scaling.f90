!> Mass scaling: mass for elements whose stable step is below the one that the deck asks for.
!>
!> An element is a layer over a quad, or a brick. Its mass is raised in proportion, so that its
!> eigenvalue, and that of the springs at its faces, fall by the same factor. Springs are divided
!> between the layers at either side in proportion to the inverse masses that they had, by
!> k (a - b)**2 <= k (1/m + 1/n) (m a**2 + n b**2): so each layer is scaled by itself.
module plydyn_domain_mass_scaling
   use plydyn_base_exact_sum, only : exact_sums_type, new_exact_sums
   use plydyn_base_precision, only : wp
   use plydyn_domain_decomposition, only : decomposition_type
   use plydyn_domain_domain, only : added_mass_type, domain_type
   use plydyn_domain_local_to_global, only : local_to_global_type
   use plydyn_domain_step_limit, only : find_spring_rates, implicit_thickness_share
   use plydyn_model_model, only : model_type
   implicit none
   private

   public :: scale_masses

   !> Sums of a part: masses without and that are added, elements, and those that get mass
   integer, parameter :: own_at = 1, added_at = 2, elements_at = 3, raised_at = 4
   integer, parameter :: sums_of_part = 4

   !> What the groups of a model have in common
   type :: scaling_type
      !> Largest eigenvalue that is left, 1/time squared
      real(wp) :: most = 0.0_wp
      !> Eigenvalue of the springs at the faces of each layer, as far as they are explicit,
      !> (layers, parts)
      real(wp), allocatable :: spring(:, :)
      !> Sums of each part over the elements of this rank
      type(exact_sums_type) :: sums
      !> Largest ratio of masses of each part
      real(wp), allocatable :: largest(:)
      !> Largest eigenvalue of elements with added mass, without springs
      real(wp) :: rate(1) = 0.0_wp
   end type scaling_type

contains

   !> Add mass where the deck asks for it. All ranks must come here
   subroutine scale_masses(model, division, numbering, domain)
      type(model_type), intent(in) :: model
      !> All elements
      type(decomposition_type), intent(in) :: division
      type(local_to_global_type), intent(in) :: numbering
      !> Has its elements, the masses of its points and the limit of the step; both may change
      type(domain_type), intent(inout) :: domain

      type(scaling_type) :: scaling
      real(wp) :: explicit, kept(2)
      integer :: g

      domain%limit%unscaled_step = domain%limit%step
      allocate (domain%inertia%added(0))
      if (domain%control%mass_scaled_step <= domain%limit%step) return
      call find_spring_rates(model, domain, scaling%spring, explicit)
      scaling%spring(:, :) = explicit*scaling%spring
      kept(:) = largest_kept(model, domain, scaling%spring)
      scaling%most = max(4.0_wp/domain%control%mass_scaled_step**2, kept(2))
      scaling%sums = new_exact_sums(sums_of_part*size(model%parts))
      scaling%largest = spread(1.0_wp, 1, size(model%parts))
      do g = 1, size(domain%groups)
         call scale_group(model, division, numbering, g, scaling, domain)
      end do
      call domain%comm%max(scaling%rate)
      domain%limit%element_rate = max(scaling%rate(1), kept(1))
      domain%limit%step = domain%control%mass_scaled_step
      if (kept(2) >= scaling%most) domain%limit%step = 2.0_wp/sqrt(kept(2))
      call sum_over_ranks(model, scaling, domain)
   end subroutine scale_masses

   !> Largest eigenvalue of elements of families that take no mass, without and with the springs at
   !> their faces: quads that may crack. No other element needs more mass than lets it keep their
   !> step. All ranks must come here
   function largest_kept(model, domain, spring) result(kept)
      type(model_type), intent(in) :: model
      type(domain_type), intent(in) :: domain
      !> As in `scaling_type`
      real(wp), intent(in) :: spring(:, :)
      real(wp) :: kept(2)

      real(wp), allocatable :: mass(:, :), rate(:, :)
      integer, allocatable :: layer(:)
      integer :: g

      kept(:) = 0.0_wp
      do g = 1, size(domain%groups)
         associate (group => domain%groups(g)%item)
            call group%find_rates(model, group%element, implicit_thickness_share(domain), rate, &
               & mass, layer)
            if (size(mass, 1) > 0 .or. size(rate) == 0) cycle
            kept(:) = max(kept, maxval(rate) + [0.0_wp, maxval(spring(:, group%part))])
         end associate
      end do
      call domain%comm%max(kept)
   end function largest_kept

   !> Add mass to the elements of a group, layer by layer
   subroutine scale_group(model, division, numbering, g, scaling, domain)
      type(model_type), intent(in) :: model
      type(decomposition_type), intent(in) :: division
      type(local_to_global_type), intent(in) :: numbering
      !> Index of the group
      integer, intent(in) :: g
      type(scaling_type), intent(inout) :: scaling
      type(domain_type), intent(inout) :: domain

      real(wp), allocatable :: mass(:, :), rate(:, :), share(:), whole(:)
      integer, allocatable :: layer(:)
      integer :: k

      allocate (whole(size(model%mesh%quad_id) + size(model%mesh%brick_id)))
      associate (group => domain%groups(g)%item)
         call group%find_rates(model, group%element, implicit_thickness_share(domain), rate, mass, &
            & layer)
         do k = 1, size(mass, 1)
            share = max(0.0_wp, (rate(k, :) + scaling%spring(k, group%part))/scaling%most - 1.0_wp)
            scaling%rate(1) = max(scaling%rate(1), maxval([0.0_wp, rate(k, :)/(1.0_wp + share)]))
            call count_layer(group%part, share, mass(k, :), scaling)
            ! elements of other ranks add to nodes where ranks meet
            whole(:) = 0.0_wp
            whole(group%element) = share
            call domain%comm%max(whole)
            if (any(whole > 0.0_wp)) call group%add_masses(model, &
               & division%parts(group%set)%element, numbering%node, domain%columns, &
               & domain%inertia%mass, k, whole)
         end do
      end associate
   end subroutine scale_group

   !> Add the elements of a layer to the sums of their part
   pure subroutine count_layer(part, share, mass, scaling)
      !> Index of the part
      integer, intent(in) :: part
      !> Share of its mass that each element gets, and its mass
      real(wp), intent(in) :: share(:), mass(:)
      type(scaling_type), intent(inout) :: scaling
      integer :: e, first

      first = sums_of_part*(part - 1)
      do e = 1, size(share)
         call scaling%sums%add(first + own_at, mass(e))
         call scaling%sums%add(first + added_at, share(e)*mass(e))
         call scaling%sums%add(first + elements_at, 1.0_wp)
         call scaling%sums%add(first + raised_at, merge(1.0_wp, 0.0_wp, share(e) > 0.0_wp))
      end do
      scaling%largest(part) = max(scaling%largest(part), 1.0_wp + maxval([0.0_wp, share]))
   end subroutine count_layer

   !> Sums over all ranks
   subroutine sum_over_ranks(model, scaling, domain)
      type(model_type), intent(in) :: model
      type(scaling_type), intent(inout) :: scaling
      !> Gets what was added to each part
      type(domain_type), intent(inout) :: domain
      integer :: p

      call domain%comm%sum(scaling%sums%limb)
      call domain%comm%max(scaling%largest)
      deallocate (domain%inertia%added)
      allocate (domain%inertia%added(size(model%parts)))
      do p = 1, size(model%parts)
         associate (sums => scaling%sums, first => sums_of_part*(p - 1))
            domain%inertia%added(p) = added_mass_type(model%parts(p)%id, &
               & sums%value(first + own_at), sums%value(first + added_at), &
               & nint(sums%value(first + elements_at)), nint(sums%value(first + raised_at)), &
               & scaling%largest(p))
         end associate
      end do
   end subroutine sum_over_ranks

end module plydyn_domain_mass_scaling
