!> Columns of points that share the inertia through the thickness, from the domain.
module plydyn_domain_build_columns
   use plydyn_base_precision, only : lanes, wp
   use plydyn_domain_column_inertia, only : column_inertia_type, number_rows, together
   use plydyn_domain_domain, only : domain_type
   use plydyn_domain_links, only : links_type
   use plydyn_domain_node_classes, only : find_classes, node_areas
   use plydyn_domain_pair_inertia, only : implicit_share
   use plydyn_element_thickness, only : layer_springs, level_table
   implicit none
   private

   public :: held_links, links_within, new_column_inertia

   !> LAPACK: solve with a symmetric positive definite matrix
   interface
      subroutine dposv(uplo, n, nrhs, a, lda, b, ldb, info)
         import :: wp
         implicit none
         character(1), intent(in) :: uplo
         integer, intent(in) :: n, nrhs, lda, ldb
         real(wp), intent(inout) :: a(lda, *), b(ldb, *)
         integer, intent(out) :: info
      end subroutine dposv
   end interface

   !> Directions
   integer, parameter :: directions = 3

contains

   !> Columns and their responses for the largest step of the domain
   function new_column_inertia(domain, joint) result(self)
      !> The domain; its masses, supports and step are known
      type(domain_type), intent(in) :: domain
      !> Springs along x, y, z between each layer and the next, (3, layers - 1)
      real(wp), intent(in) :: joint(:, :)
      type(column_inertia_type) :: self

      integer, allocatable :: first(:)
      logical, allocatable :: held(:, :)
      real(wp), allocatable :: density(:, :), spring(:, :, :)

      self%active = .true.
      call number_rows(self, domain%columns, domain%ties)
      self%area = sum(node_areas(domain%plates, domain%position), 2)
      density = densities(domain, self)
      spring = node_springs(domain, self%area)
      held = held_rows(domain, self)
      call classify(density, spring, held, self, first)
      call set_stretches(domain, spring, self)
      call set_responses(domain, held, joint, density, spring, first, self)
   end function new_column_inertia

   !> Mass per area of each row, (rows, nodes)
   pure function densities(domain, self) result(density)
      type(domain_type), intent(in) :: domain
      type(column_inertia_type), intent(in) :: self
      real(wp) :: density(size(self%freedom), size(self%area))
      integer :: n, r

      do n = 1, size(self%area)
         density(:, n) = domain%mass(self%mass_place(domain%columns, &
            & [(r, r=1, size(self%freedom))], n))/self%area(n)
      end do
   end function densities

   !> Springs of each layer per area along x, y, z; where parts meet, by their areas,
   !> (3, layers, nodes)
   pure function node_springs(domain, area) result(spring)
      type(domain_type), intent(in) :: domain
      !> Area of each node in all parts
      real(wp), intent(in) :: area(:)
      real(wp) :: spring(directions, size(domain%layers%order), size(area))

      real(wp) :: own(size(area), size(domain%plates)), part(directions, size(domain%layers%order))
      integer :: k, n, p

      own(:, :) = node_areas(domain%plates, domain%position)
      spring(:, :, :) = 0.0_wp
      do p = 1, size(domain%plates)
         do k = 1, size(part, 2)
            associate (home => domain%columns%home(:, k))
               part(:, k) = layer_springs(domain%plates(p)%batches(home(1)), home(3), home(2))
            end associate
         end do
         do n = 1, size(area)
            spring(:, :, n) = spring(:, :, n) + own(n, p)/area(n)*part
         end do
      end do
   end function node_springs

   !> Whether supports hold each freedom, (freedoms, 3*nodes)
   pure function held_rows(domain, self) result(held)
      type(domain_type), intent(in) :: domain
      type(column_inertia_type), intent(in) :: self
      logical :: held(size(self%row), directions*size(self%area))

      logical :: is_held(domain%columns%freedoms)
      integer :: i

      is_held(:) = .false.
      is_held(domain%held) = .true.
      do i = 1, size(held, 2)
         held(:, i) = is_held(self%place(domain%columns, self%row, direction_of(i), node_of(i)))
      end do
   end function held_rows

   !> Direction of a place among three for each node
   pure integer function direction_of(i)
      integer, intent(in) :: i

      direction_of = 1 + mod(i - 1, directions)
   end function direction_of

   !> Node of a place among three for each node
   pure integer function node_of(i)
      integer, intent(in) :: i

      node_of = 1 + (i - 1)/directions
   end function node_of

   !> Classes of nodes by masses and springs; kinds of responses by class, normal or shear, and
   !> supports
   pure subroutine classify(density, spring, held, self, first)
      real(wp), intent(in) :: density(:, :), spring(:, :, :)
      logical, intent(in) :: held(:, :)
      type(column_inertia_type), intent(inout) :: self
      !> First place of each kind among three for each node
      integer, allocatable, intent(out) :: first(:)

      integer :: i, kind(size(held, 2)), n
      real(wp), allocatable :: key(:, :)

      allocate (self%class(size(self%area)), key(size(density, 1) + size(spring(:, :, 1)), &
         & size(self%area)))
      do n = 1, size(self%area)
         key(:, n) = [density(:, n), spring(:, :, n)]
      end do
      call find_classes(key, self%class, first)
      deallocate (key, first)
      allocate (key(size(held, 1) + 2, size(held, 2)))
      do i = 1, size(held, 2)
         key(:, i) = [real(self%class(node_of(i)), wp), &
            & merge(1.0_wp, 0.0_wp, direction_of(i) == directions), &
            & merge(1.0_wp, 0.0_wp, held(:, i))]
      end do
      call find_classes(key, kind, first)
      self%kind = reshape(kind, [directions, size(self%area)])
   end subroutine classify

   !> Inertia inside the layers, for each class of nodes
   pure subroutine set_stretches(domain, spring, self)
      type(domain_type), intent(in) :: domain
      real(wp), intent(in) :: spring(:, :, :)
      type(column_inertia_type), intent(inout) :: self

      real(wp), allocatable :: table(:, :)
      integer :: f, k, lane, p, s, t, n

      allocate (self%stretches(size(domain%columns%families)))
      do f = 1, size(self%stretches)
         table = -implicit_share*domain%step**2 &
            & *level_table(domain%plates(1)%batches(f)%expansion)
         associate (family => domain%columns%families(f), stretch => self%stretches(f))
            p = family%order*(family%order + 1)/2
            stretch%level = reshape([(([s, t], s=1, t - 1), t=2, family%order + 1)], [2, p])
            allocate (stretch%inertia(lanes*family%blocks, p, directions, maxval(self%class)))
            stretch%inertia(:, :, :, :) = 0.0_wp
            do k = 1, size(spring, 2)
               if (domain%columns%home(1, k) /= f) cycle
               lane = domain%columns%home(3, k) + lanes*(domain%columns%home(2, k) - 1)
               do n = 1, size(self%class)
                  do p = 1, size(stretch%level, 2)
                     stretch%inertia(lane, p, :, self%class(n)) = spring(:, k, n) &
                        & *table(stretch%level(1, p), stretch%level(2, p))
                  end do
               end do
            end do
         end associate
      end do
   end subroutine set_stretches

   !> Added inertia of a column per area in one direction, (freedoms, freedoms)
   pure function added_inertia(domain, self, direction, joint, spring) result(added)
      type(domain_type), intent(in) :: domain
      type(column_inertia_type), intent(in) :: self
      integer, intent(in) :: direction
      !> Springs between the layers, (3, layers - 1), and inside them, (3, layers)
      real(wp), intent(in) :: joint(:, :), spring(:, :)
      real(wp) :: added(size(self%row), size(self%row))

      integer :: k, t
      integer, allocatable :: at(:)

      added(:, :) = 0.0_wp
      do k = 1, size(spring, 2)
         at = self%freedom(self%row_of(domain%columns, k, [(t, t=1, domain%columns%levels(k))]))
         added(at, at) = added(at, at) + spring(direction, k)*level_table( &
            & domain%plates(1)%batches(domain%columns%home(1, k))%expansion)
         if (k == size(spring, 2)) cycle
         if (joint(direction, k) <= 0.0_wp) cycle
         at = self%freedom(self%row_of(domain%columns, [k, k + 1], [domain%columns%levels(k), 1]))
         added(at, at) = added(at, at) &
            & + joint(direction, k)*reshape([1.0_wp, -1.0_wp, -1.0_wp, 1.0_wp], [2, 2])
      end do
      added(:, :) = implicit_share*domain%step**2*added
   end function added_inertia

   !> Responses of all kinds
   subroutine set_responses(domain, held, joint, density, spring, first, self)
      type(domain_type), intent(in) :: domain
      logical, intent(in) :: held(:, :)
      real(wp), intent(in) :: joint(:, :), density(:, :), spring(:, :, :)
      !> First place of each kind among three for each node
      integer, intent(in) :: first(:)
      type(column_inertia_type), intent(inout) :: self

      real(wp) :: full(size(self%row), size(self%row)), mass(size(self%row))
      integer :: d, j, k, r

      allocate (self%response(lanes, together*((size(self%row) + together - 1)/together), &
         & size(self%freedom)/lanes, size(first)))
      self%response(:, :, :, :) = 0.0_wp
      do k = 1, size(first)
         j = node_of(first(k))
         do d = 1, size(mass)
            mass(d) = sum(density(:, j), mask=self%freedom == d)
         end do
         full(:, :) = response(mass, held(:, first(k)), added_inertia(domain, self, &
            & direction_of(first(k)), joint, spring(:, :, j)))
         do r = 1, size(self%freedom)
            if (self%freedom(r) == 0) cycle
            self%response(1 + mod(r - 1, lanes), :size(mass), 1 + (r - 1)/lanes, k) = &
               & full(self%freedom(r), :)
         end do
      end do
   end subroutine set_responses

   !> Accelerations of coupled freedoms for those of free ones, (M + K)**-1 M
   function response(mass, held, added)
      !> Mass of each freedom, whether it is held, added inertia between them
      real(wp), intent(in) :: mass(:)
      logical, intent(in) :: held(:)
      real(wp), intent(in) :: added(:, :)
      real(wp) :: response(size(mass), size(mass))

      integer, allocatable :: free(:)
      real(wp), allocatable :: inertia(:, :), solution(:, :)
      integer :: d, info

      response(:, :) = 0.0_wp
      free = pack([(d, d=1, size(mass))], .not. held)
      if (size(free) == 0) return
      inertia = added(free, free)
      allocate (solution(size(free), size(free)))
      solution(:, :) = 0.0_wp
      do d = 1, size(free)
         inertia(d, d) = inertia(d, d) + mass(free(d))
         solution(d, d) = mass(free(d))
      end do
      ! the sum of a positive and a semi-definite matrix is positive definite: info is 0
      call dposv("U", size(free), size(free), inertia, size(free), solution, size(free), info)
      response(free, free) = solution
   end function response

   !> Added inertia between points that are both among some
   pure function links_within(domain, joint, chosen) result(links)
      !> The domain
      type(domain_type), intent(in) :: domain
      !> Springs along x, y, z between each layer and the next
      real(wp), intent(in) :: joint(:, :)
      !> Whether each place in the arrays of motion is one of them
      logical, intent(in) :: chosen(:)
      type(links_type) :: links

      real(wp), allocatable :: added(:, :), spring(:, :, :)
      integer :: c, i, j, n, place(size(domain%thickness%row))

      spring = node_springs(domain, domain%thickness%area)
      allocate (links%place(2, 0), links%inertia(0))
      do n = 1, domain%columns%nodes
         do c = 1, directions
            place(:) = domain%thickness%place(domain%columns, domain%thickness%row, c, n)
            if (count(chosen(place)) < 2) cycle
            added = added_inertia(domain, domain%thickness, c, joint, spring(:, :, n))
            do j = 2, size(place)
               do i = 1, j - 1
                  if (.not. all(chosen(place([i, j])))) cycle
                  if (abs(added(i, j)) <= 0.0_wp) cycle
                  links%inertia = [links%inertia, -domain%thickness%area(n)*added(i, j)]
                  links%place = reshape([links%place, place([i, j])], [2, size(links%inertia)])
               end do
            end do
         end do
      end do
   end function links_within

   !> Added inertia between held points and those of their columns that are free: a place in the
   !> list of held ones, and one in the arrays of motion
   pure function held_links(domain, joint) result(links)
      !> The domain
      type(domain_type), intent(in) :: domain
      !> Springs along x, y, z between each layer and the next
      real(wp), intent(in) :: joint(:, :)
      type(links_type) :: links

      real(wp), allocatable :: added(:, :), spring(:, :, :)
      integer :: d, i, j, number(domain%columns%freedoms), place(size(domain%thickness%row))

      spring = node_springs(domain, domain%thickness%area)
      number(:) = 0
      number(domain%held) = [(d, d=1, size(domain%held))]
      allocate (links%place(2, 0), links%inertia(0))
      do i = 1, directions*domain%columns%nodes
         place(:) = domain%thickness%place(domain%columns, domain%thickness%row, direction_of(i), &
            & node_of(i))
         if (all(number(place) > 0) .or. all(number(place) == 0)) cycle
         added = added_inertia(domain, domain%thickness, direction_of(i), joint, &
            & spring(:, :, node_of(i)))
         do d = 1, size(place)
            if (number(place(d)) == 0) cycle
            do j = 1, size(place)
               if (number(place(j)) > 0 .or. abs(added(d, j)) <= 0.0_wp) cycle
               links%inertia = [links%inertia, -domain%thickness%area(node_of(i))*added(d, j)]
               links%place = reshape([links%place, number(place(d)), place(j)], &
                  & [2, size(links%inertia)])
            end do
         end do
      end do
   end function held_links

end module plydyn_domain_build_columns
