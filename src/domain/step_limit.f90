!> The stable step of the whole domain, and the elements of all ranks that set it.
module plydyn_domain_step_limit
   use plydyn_base_precision, only : wp
   use plydyn_domain_domain, only : critical_element_type, domain_type, step_limit_type
   use plydyn_domain_pair_inertia, only : implicit_share
   use plydyn_domain_sheet, only : beam_period
   use plydyn_element_plate_stable_rate, only : largest_quad_factor
   use plydyn_model_control, only : all_explicit, implicit_thickness
   use plydyn_model_model, only : model_type
   use plydyn_parallel_comm, only : comm_type
   implicit none
   private

   public :: find_slowest, find_spring_rates, find_step_limit, implicit_thickness_share

   !> Most elements that are named
   integer, parameter :: most_named = 20
   !> Numbers of an element that ranks exchange
   integer, parameter :: numbers = 4

contains

   !> Largest eigenvalue of the elements, plus that of the springs between their points: their sum
   !> bounds the largest of the whole. All ranks must come here
   function find_step_limit(model, domain) result(limit)
      type(model_type), intent(in) :: model
      !> The domain; the elements of this rank are known
      type(domain_type), intent(in) :: domain
      type(step_limit_type) :: limit

      real(wp), allocatable :: mass(:, :), rate(:, :), spring(:, :)
      real(wp) :: explicit
      integer, allocatable :: layer(:)

      if (domain%control%rest_share > 0.0_wp) limit%bending_period = beam_period(model)
      limit%slowest = find_slowest(domain%comm, element_rates(model, domain))
      call find_spring_rates(model, domain, spring, explicit)
      limit%interface_rate = max(0.0_wp, maxval(spring))
      limit%interface_rest = explicit*limit%interface_rate
      associate (worst => limit%slowest(1), group => domain%groups(limit%slowest(1)%group)%item)
         limit%element_rate = worst%rate
         limit%step = 2.0_wp/sqrt(limit%element_rate + limit%interface_rest)
         limit%element_id = model%mesh%element_id(group%element_kind, worst%element)
         if (.not. allocated(group%layer_spring)) return
         call group%find_rates(model, [worst%element], 4.0_wp*implicit_share, rate, mass, layer)
         limit%plane_rate = maxval(rate)
      end associate
   end function find_step_limit

   !> Eigenvalues of all elements of this rank
   function element_rates(model, domain) result(elements)
      type(model_type), intent(in) :: model
      type(domain_type), intent(in) :: domain
      type(critical_element_type), allocatable :: elements(:)

      real(wp), allocatable :: mass(:, :), rate(:, :)
      integer, allocatable :: layer(:)
      integer :: e, g

      allocate (elements(0))
      do g = 1, size(domain%groups)
         associate (group => domain%groups(g)%item)
            call group%find_rates(model, group%element, implicit_thickness_share(domain), rate, &
               & mass, layer)
            elements = [elements, (critical_element_type(g, group%element(e), &
               & layer(maxloc(rate(:, e), 1)), maxval(rate(:, e))), e=1, size(rate, 2))]
         end associate
      end do
   end function element_rates

   !> Share of the stiffness through the thickness that is implicit, against the explicit limit
   pure real(wp) function implicit_thickness_share(domain) result(share)
      type(domain_type), intent(in) :: domain

      share = merge(4.0_wp*implicit_share, 0.0_wp, domain%control%scheme == implicit_thickness)
   end function implicit_thickness_share

   !> Bound on the eigenvalues of springs between points: stiffness over the mass per area of both
   !> faces, times the largest eigenvalue that the points of one element have against the areas of
   !> its nodes. Where interfaces are implicit the inertia that they add at the nodes outweighs all
   !> or most of that: with K the springs at the points and K' those at the nodes, dt**2 K/4 is no
   !> more than beta dt**2 K' as long as the eigenvalue of K against K' is no more than 4 beta
   subroutine find_spring_rates(model, domain, rate, explicit)
      type(model_type), intent(in) :: model
      !> The domain; the elements of this rank are known
      type(domain_type), intent(in) :: domain
      !> Largest eigenvalue at either face of each layer of each part, (layers, parts); bricks are
      !> one layer each
      real(wp), allocatable, intent(out) :: rate(:, :)
      !> Share of it that is not implicit
      real(wp), intent(out) :: explicit

      real(wp) :: factor, inverse
      integer :: g, i

      allocate (rate(max(1, size(domain%layers%order)), size(model%parts)), source=0.0_wp)
      explicit = 1.0_wp
      factor = largest_point_factor(model, domain)
      if (factor <= 0.0_wp) return
      if (domain%control%scheme /= all_explicit) then
         explicit = max(0.0_wp, 1.0_wp - 4.0_wp*implicit_share/factor)
      end if
      do g = 1, size(domain%groups)
         associate (group => domain%groups(g)%item)
            if (.not. allocated(group%springs)) cycle
            do i = 1, size(group%springs)
               associate (spring => group%springs(i), lower => group%springs(i)%layer, &
                  & upper => group%springs(i)%layer + 1, part => group%part)
                  inverse = 1.0_wp/face_density(model, domain, part, lower) &
                     & + 1.0_wp/face_density(model, domain, part, upper)
                  rate(lower:upper, part) = max(rate(lower:upper, part), &
                     & maxval(spring%stiffness)*factor*inverse)
               end associate
            end do
         end associate
      end do
   end subroutine find_spring_rates

   !> Mass per area that a layer has on one of its faces
   pure real(wp) function face_density(model, domain, part, layer) result(density)
      type(model_type), intent(in) :: model
      type(domain_type), intent(in) :: domain
      integer, intent(in) :: part, layer

      associate (layers => domain%layers, columns => domain%columns)
         associate (material => model%parts(part)%plies(layers%ply(layer))%material, &
            & expansion => columns%order_groups(columns%layer_slot(1, layer))%expansion)
            density = model%materials(material)%density*(layers%top(layer) - layers%bottom(layer)) &
               & *expansion%mass_share(1)
         end associate
      end associate
   end function face_density

   !> Largest eigenvalue that the points of springs over one element have against the areas of its
   !> nodes; 0 without springs. All ranks must come here
   real(wp) function largest_point_factor(model, domain) result(factor)
      type(model_type), intent(in) :: model
      type(domain_type), intent(in) :: domain

      real(wp) :: largest(1)
      integer :: g

      factor = 0.0_wp
      if (.not. any([(allocated(domain%groups(g)%item%springs), g=1, size(domain%groups))])) return
      ! points at the nodes have their areas
      largest(:) = 1.0_wp
      do g = 1, size(domain%groups)
         associate (group => domain%groups(g)%item)
            ! the layers stand for the springs over the same quads
            if (.not. allocated(group%layer_spring)) cycle
            largest(:) = max(largest, largest_quad_factor(model%mesh, group%element))
         end associate
      end do
      call domain%comm%max(largest)
      factor = largest(1)
   end function largest_point_factor

   !> The elements with the largest eigenvalues, the largest first; of equal ones the first of the
   !> mesh. All ranks must come here, and get the same
   function find_slowest(comm, elements) result(slowest)
      type(comm_type), intent(in) :: comm
      !> Elements of this rank
      type(critical_element_type), intent(in) :: elements(:)
      type(critical_element_type), allocatable :: slowest(:)

      type(critical_element_type), allocatable :: own(:)
      real(wp) :: all(numbers*most_named*comm%ranks), part(numbers, most_named)
      integer :: e, r

      own = foremost(elements)
      part(:, :) = 0.0_wp
      do e = 1, size(own)
         part(:, e) = [real([own(e)%group, own(e)%element, own(e)%layer], wp), own(e)%rate]
      end do
      call comm%allgather(reshape(part, [size(part)]), [(size(part), r=1, comm%ranks)], all)
      allocate (slowest(most_named*comm%ranks))
      do e = 1, size(slowest)
         associate (each => all(numbers*(e - 1) + 1:numbers*e))
            slowest(e) = critical_element_type(nint(each(1)), nint(each(2)), nint(each(3)), each(4))
         end associate
      end do
      slowest = foremost(pack(slowest, slowest%element > 0))
   end function find_slowest

   !> The slowest of some elements, the slowest first
   pure function foremost(elements) result(first)
      type(critical_element_type), intent(in) :: elements(:)
      type(critical_element_type), allocatable :: first(:)

      logical, allocatable :: is_left(:)
      integer :: e, i, next

      allocate (first(min(most_named, size(elements))))
      is_left = spread(.true., 1, size(elements))
      do i = 1, size(first)
         next = 0
         do e = 1, size(elements)
            if (.not. is_left(e)) cycle
            if (next == 0) next = e
            if (is_slower(elements(e), elements(next))) next = e
         end do
         is_left(next) = .false.
         first(i) = elements(next)
      end do
   end function foremost

   !> Whether an element comes before another one
   pure logical function is_slower(one, other)
      type(critical_element_type), intent(in) :: one, other

      is_slower = one%rate > other%rate .or. (.not. one%rate < other%rate &
         & .and. one%element < other%element)
   end function is_slower

end module plydyn_domain_step_limit
