!> Elements of the chunks of a domain, their histories, and masses of points.
module plydyn_domain_build_elements
   use plydyn_base_exact_sum, only : exact_sums_type, new_exact_sums
   use plydyn_base_precision, only : wp
   use plydyn_domain_decomposition, only : decomposition_type
   use plydyn_domain_domain, only : chunk_type, domain_type
   use plydyn_domain_local_to_global, only : local_to_global_type
   use plydyn_domain_subdomain, only : subdomain_type
   use plydyn_element_group, only : element_group_type
   use plydyn_fem_columns, only : alignment_offset
   use plydyn_model_model, only : model_type
   implicit none
   private

   public :: build_elements, build_masses, invert_masses, whole_mass

contains

   !> Elements of the domain's chunks, and where their histories lie
   subroutine build_elements(model, division, numbering, domain, subdomain)
      type(model_type), intent(in) :: model
      !> All elements
      type(decomposition_type), intent(in) :: division
      type(local_to_global_type), intent(in) :: numbering
      !> Has its chunks, still as the whole model has them
      type(domain_type), intent(inout) :: domain
      !> Gets the segments of history
      type(subdomain_type), intent(inout) :: subdomain

      integer, allocatable :: own(:)
      integer :: g

      domain%histories = alignment_offset
      allocate (subdomain%history(3, 0))
      do g = 1, size(domain%groups)
         associate (group => domain%groups(g)%item)
            own = places_of(domain%chunks%list, group%set)
            associate (element => division%parts(group%set)%element)
               call group%take_elements(model, element(own), numbering%node, domain%columns)
               call place_group(own, size(element), group, domain%histories, subdomain)
            end associate
         end associate
      end do
   end subroutine build_elements

   !> Places of the elements of a set in some chunks
   pure function places_of(chunks, set) result(places)
      type(chunk_type), intent(in) :: chunks(:)
      integer, intent(in) :: set
      integer, allocatable :: places(:)

      integer :: c, e, n

      n = 0
      do c = 1, size(chunks)
         if (chunks(c)%set == set) n = n + chunks(c)%elements(2) - chunks(c)%elements(1) + 1
      end do
      allocate (places(n))
      n = 0
      do c = 1, size(chunks)
         if (chunks(c)%set /= set) cycle
         do e = chunks(c)%elements(1), chunks(c)%elements(2)
            n = n + 1
            places(n) = e
         end do
      end do
   end function places_of

   !> Let the histories of a group follow those before it
   pure subroutine place_group(own, all, group, histories, subdomain)
      !> Places of the elements in the list of the set, and how long that is
      integer, intent(in) :: own(:), all
      class(element_group_type), intent(inout) :: group
      !> How many histories there are before, and with it
      integer, intent(inout) :: histories
      !> Gets the segments
      type(subdomain_type), intent(inout) :: subdomain

      integer, allocatable :: first(:)
      integer :: b

      if (.not. allocated(group%history_shape)) return
      associate (blocks => group%history_shape)
         allocate (first(size(blocks, 2)))
         do b = 1, size(first)
            call place_histories(own, blocks(1, b), blocks(2, b), all, first(b), histories, &
               & subdomain)
         end do
         group%intact_history = reshape([(first(b), first(b) - 1 + blocks(1, b)*blocks(3, b) &
            & *size(own), b=1, size(first))], [2, size(first)])
      end associate
      call group%set_history(first)
   end subroutine place_group

   !> Let the histories of some elements follow those before them, here and in the whole model: one
   !> variable of all of them after the other
   pure subroutine place_histories(own, length, variables, all, first, histories, subdomain)
      !> Places of the elements among all of their kind
      integer, intent(in) :: own(:)
      !> Length of a variable of an element, how many variables there are, and how many elements the
      !> whole model has
      integer, intent(in) :: length, variables, all
      !> Where these begin
      integer, intent(out) :: first
      !> How many histories there are before, and with them
      integer, intent(inout) :: histories
      !> Gets the segments
      type(subdomain_type), intent(inout) :: subdomain

      integer, allocatable :: segments(:, :)
      integer :: before, e, k, n, there
      logical :: follows

      first = histories + 1
      if (length*variables == 0) return
      before = size(subdomain%history, 2)
      n = before
      allocate (segments(3, n + variables*size(own)))
      segments(:, :n) = subdomain%history
      do k = 1, variables
         do e = 1, size(own)
            there = subdomain%histories + 1 + length*(all*(k - 1) + own(e) - 1)
            follows = .false.
            if (n > before) follows = segments(2, n) + segments(3, n) == there
            if (.not. follows) then
               n = n + 1
               segments(:, n) = [histories + 1, there, 0]
            end if
            segments(3, n) = segments(3, n) + length
            histories = histories + length
         end do
      end do
      subdomain%history = segments(:, :n)
      subdomain%histories = subdomain%histories + length*variables*all
   end subroutine place_histories

   !> Masses of the points that the rank has
   subroutine build_masses(model, division, numbering, domain)
      type(model_type), intent(in) :: model
      !> All elements: those of other ranks, too, add to nodes where ranks meet
      type(decomposition_type), intent(in) :: division
      type(local_to_global_type), intent(in) :: numbering
      !> Has its groups and columns
      type(domain_type), intent(inout) :: domain

      integer :: g

      allocate (domain%inertia%mass(domain%columns%masses), source=0.0_wp)
      do g = 1, size(domain%groups)
         associate (group => domain%groups(g)%item)
            call group%add_masses(model, division%parts(group%set)%element, numbering%node, &
               & domain%columns, domain%inertia%mass)
         end associate
      end do
   end subroutine build_masses

   !> Inverses of the masses that move with each point
   subroutine invert_masses(domain)
      !> Has its masses and tied faces
      type(domain_type), intent(inout) :: domain

      integer :: k

      allocate (domain%inertia%inverse_mass(size(domain%inertia%mass)), source=0.0_wp)
      allocate (domain%inertia%far_ties(2, 0))
      where (domain%inertia%mass > 0.0_wp)
         domain%inertia%inverse_mass(:) = 1.0_wp/domain%inertia%mass
      end where
      do k = 1, size(domain%inertia%ties)
         call tie_layers(domain, domain%inertia%ties(k))
      end do
   end subroutine invert_masses

   !> Let the top of a layer and the bottom of the next move as one: both get the inverse of the sum
   !> of their masses
   subroutine tie_layers(domain, layer)
      type(domain_type), intent(inout) :: domain
      integer, intent(in) :: layer

      integer :: above, below, c, n

      associate (columns => domain%columns)
         do n = 1, columns%nodes
            below = columns%mass_of(layer, columns%levels(layer), n)
            above = columns%mass_of(layer + 1, 1, n)
            domain%inertia%inverse_mass([below, above]) = &
               & 1.0_wp/(domain%inertia%mass(below) + domain%inertia%mass(above))
         end do
         if (columns%layer_slot(1, layer) == columns%layer_slot(1, layer + 1)) return
         domain%inertia%far_ties = reshape([domain%inertia%far_ties, &
            & ([([columns%freedom(layer, columns%levels(layer), c, n), &
            & columns%freedom(layer + 1, 1, c, n)], c=1, 3)], n=1, columns%nodes)], &
            & [2, size(domain%inertia%far_ties, 2) + 3*columns%nodes])
      end associate
   end subroutine tie_layers

   !> Mass of the whole model, each point counted once. All ranks must come here
   real(wp) function whole_mass(domain) result(mass)
      type(domain_type), intent(in) :: domain

      type(exact_sums_type) :: sums
      integer :: c, i, points

      sums = new_exact_sums(1)
      points = domain%columns%height/3
      do c = 1, domain%columns%count
         if (.not. domain%chunks%counted(c)) cycle
         do i = alignment_offset + points*(c - 1) + 1, alignment_offset + points*c
            call sums%add(1, domain%inertia%mass(i))
         end do
      end do
      call domain%comm%sum(sums%limb)
      mass = sums%value(1)
   end function whole_mass

end module plydyn_domain_build_elements
