!> Columns of points that share the inertia through the thickness, from the domain.
module plydyn_domain_build_columns
   use plydyn_base_precision, only : lanes, wp
   use plydyn_domain_column_inertia, only : column_inertia_type, number_rows, together
   use plydyn_domain_domain, only : domain_type
   use plydyn_domain_node_classes, only : find_classes
   use plydyn_domain_pair_inertia, only : implicit_share, inertia_links_type
   use plydyn_fem_expansion, only : level_table
   implicit none
   private

   public :: column_links, is_held, new_column_inertia

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

   !> Columns that differ by more than their areas, the same on all ranks
   type :: classes_type
      !> Mass per area of each row, (rows, classes)
      real(wp), allocatable :: density(:, :)
      !> Springs of each layer per area along x, y, z, (3, layers, classes)
      real(wp), allocatable :: spring(:, :, :)
      !> Class of each kind of responses, its direction, x standing for y, too
      integer, allocatable :: class(:), direction(:)
      !> Whether supports hold each freedom, (freedoms, kinds)
      logical, allocatable :: held(:, :)
   end type classes_type

contains

   !> Columns and their responses for the largest step of the domain. All ranks must come here
   function new_column_inertia(domain, number, area, joint) result(self)
      !> The domain; its masses, supports and step are known
      type(domain_type), intent(in) :: domain
      !> What number each node has in the whole model
      integer, intent(in) :: number(:)
      !> Area of each node in each part, (nodes, parts)
      real(wp), intent(in) :: area(:, :)
      !> Springs along x, y, z between each layer and the next, (3, layers - 1)
      real(wp), intent(in) :: joint(:, :)
      type(column_inertia_type) :: self

      type(classes_type) :: classes

      self%active = .true.
      call number_rows(self, domain%columns, domain%inertia%ties)
      self%area = sum(area, 2)
      call classify(domain, number, node_springs(domain, area), self, classes)
      call set_stretches(domain, classes, self)
      call set_responses(domain, joint, classes, self)
   end function new_column_inertia

   !> Springs of each layer per area along x, y, z; where parts meet, by their areas,
   !> (3, layers, nodes)
   pure function node_springs(domain, area) result(spring)
      type(domain_type), intent(in) :: domain
      !> Area of each node in each part
      real(wp), intent(in) :: area(:, :)
      real(wp), allocatable :: spring(:, :, :)

      real(wp) :: part(directions, size(domain%layers%order)), total
      integer :: k, n, p

      allocate (spring(directions, size(part, 2), size(area, 1)), source=0.0_wp)
      do p = 1, size(area, 2)
         do k = 1, size(part, 2)
            part(:, k) = springs_of(domain, p, k)
         end do
         do n = 1, size(area, 1)
            total = sum(area(n, :))
            spring(:, :, n) = spring(:, :, n) + area(n, p)/total*part
         end do
      end do
   end function node_springs

   !> Stiffness of a layer of an element set through its thickness
   pure function springs_of(domain, set, layer) result(spring)
      type(domain_type), intent(in) :: domain
      integer, intent(in) :: set, layer
      real(wp) :: spring(directions)
      integer :: g

      spring(:) = 0.0_wp
      do g = 1, size(domain%groups)
         associate (group => domain%groups(g)%item)
            if (group%set == set .and. allocated(group%layer_spring)) then
               spring(:) = spring + group%layer_spring(:, layer)
            end if
         end associate
      end do
   end function springs_of

   !> Whether supports hold each place in the arrays of motion
   pure function is_held(domain) result(held)
      type(domain_type), intent(in) :: domain
      logical :: held(domain%columns%freedoms)

      held(:) = .false.
      held(domain%supports%held) = .true.
   end function is_held

   !> Classes of nodes by masses and springs; kinds of responses by class, normal or shear, and
   !> supports
   subroutine classify(domain, number, spring, self, classes)
      type(domain_type), intent(in) :: domain
      !> What number each node has in the whole model
      integer, intent(in) :: number(:)
      !> Springs of the layers above each node
      real(wp), intent(in) :: spring(:, :, :)
      type(column_inertia_type), intent(inout) :: self
      type(classes_type), intent(out) :: classes

      integer :: c, kind(directions*size(self%area)), n, r, rows
      logical, allocatable :: held(:)
      real(wp), allocatable :: first(:, :), key(:, :)

      rows = size(self%freedom)
      allocate (self%class(size(self%area)), key(rows + size(spring(:, :, 1)), size(self%area)))
      do n = 1, size(self%area)
         ! masses per area
         key(:, n) = [domain%inertia%mass(self%mass_place(domain%columns, [(r, r=1, rows)], n)) &
            & /self%area(n), spring(:, :, n)]
      end do
      call find_classes(domain%comm, number, key, self%class, first)
      classes%density = first(:rows, :)
      classes%spring = reshape(first(rows + 1:, :), &
         & [size(spring, 1), size(spring, 2), size(first, 2)])
      deallocate (key, first)
      held = is_held(domain)
      allocate (key(2 + size(self%row), size(kind)))
      do n = 1, size(self%area)
         do c = 1, directions
            key(:, directions*(n - 1) + c) = [real([self%class(n), merge(directions, 1, &
               & c == directions)], wp), merge(1.0_wp, 0.0_wp, held(self%place(domain%columns, &
               & self%row, c, n)))]
         end do
      end do
      call find_classes(domain%comm, [((directions*(number(n) - 1) + c, c=1, directions), n=1, &
         & size(number))], key, kind, first)
      self%kind = reshape(kind, [directions, size(self%area)])
      classes%class = nint(first(1, :))
      classes%direction = nint(first(2, :))
      classes%held = first(3:, :) > 0.5_wp
   end subroutine classify

   !> Inertia inside the layers, for each class of nodes
   pure subroutine set_stretches(domain, classes, self)
      type(domain_type), intent(in) :: domain
      type(classes_type), intent(in) :: classes
      type(column_inertia_type), intent(inout) :: self

      real(wp), allocatable :: table(:, :)
      integer :: c, f, k, lane, p, s, t

      allocate (self%stretches(size(domain%columns%order_groups)))
      do f = 1, size(self%stretches)
         table = -implicit_share*domain%step**2 &
            & *level_table(domain%columns%order_groups(f)%expansion)
         associate (order_group => domain%columns%order_groups(f), stretch => self%stretches(f))
            p = order_group%order*(order_group%order + 1)/2
            stretch%level = reshape([(([s, t], s=1, t - 1), t=2, order_group%order + 1)], [2, p])
            allocate (stretch%inertia(lanes*order_group%blocks, p, directions, &
               & size(classes%spring, 3)), source=0.0_wp)
            do k = 1, size(classes%spring, 2)
               if (domain%columns%layer_slot(1, k) /= f) cycle
               lane = domain%columns%layer_slot(3, k) + lanes*(domain%columns%layer_slot(2, k) - 1)
               do c = 1, size(classes%spring, 3)
                  do p = 1, size(stretch%level, 2)
                     stretch%inertia(lane, p, :, c) = classes%spring(:, k, c) &
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
            & domain%columns%order_groups(domain%columns%layer_slot(1, k))%expansion)
         if (k == size(spring, 2)) cycle
         if (joint(direction, k) <= 0.0_wp) cycle
         at = self%freedom(self%row_of(domain%columns, [k, k + 1], [domain%columns%levels(k), 1]))
         added(at, at) = added(at, at) &
            & + joint(direction, k)*reshape([1.0_wp, -1.0_wp, -1.0_wp, 1.0_wp], [2, 2])
      end do
      added(:, :) = implicit_share*domain%step**2*added
   end function added_inertia

   !> Responses of all kinds
   subroutine set_responses(domain, joint, classes, self)
      type(domain_type), intent(in) :: domain
      real(wp), intent(in) :: joint(:, :)
      type(classes_type), intent(in) :: classes
      type(column_inertia_type), intent(inout) :: self

      real(wp) :: full(size(self%row), size(self%row)), mass(size(self%row))
      integer :: d, k, r

      allocate (self%response(lanes, together*((size(self%row) + together - 1)/together), &
         & size(self%freedom)/lanes, size(classes%class)), source=0.0_wp)
      do k = 1, size(classes%class)
         do d = 1, size(mass)
            mass(d) = sum(classes%density(:, classes%class(k)), mask=self%freedom == d)
         end do
         full(:, :) = response(mass, classes%held(:, k), added_inertia(domain, self, &
            & classes%direction(k), joint, classes%spring(:, :, classes%class(k))))
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
      allocate (solution(size(free), size(free)), source=0.0_wp)
      do d = 1, size(free)
         inertia(d, d) = inertia(d, d) + mass(free(d))
         solution(d, d) = mass(free(d))
      end do
      ! the sum of a positive and a semi-definite matrix is positive definite: info is 0
      call dposv("U", size(free), size(free), inertia, size(free), solution, size(free), info)
      response(free, free) = solution
   end function response

   !> Added inertia between points of a column, from some of them to some, each pair once
   pure function column_links(domain, area, joint, from, to) result(links)
      type(domain_type), intent(in) :: domain
      !> Area of each node in each part, (nodes, parts)
      real(wp), intent(in) :: area(:, :)
      !> Springs along x, y, z between each layer and the next
      real(wp), intent(in) :: joint(:, :)
      !> Whether each place in the arrays of motion is among the first and among the others
      logical, intent(in) :: from(:), to(:)
      type(inertia_links_type) :: links

      real(wp), allocatable :: added(:, :), spring(:, :, :)
      integer :: c, i, j, n, place(size(domain%inertia%thickness%row))

      spring = node_springs(domain, area)
      allocate (links%place(2, 0), links%inertia(0))
      associate (columns => domain%inertia%thickness)
         do n = 1, domain%columns%nodes
            do c = 1, directions
               place(:) = columns%place(domain%columns, columns%row, c, n)
               if (.not. (any(from(place)) .and. any(to(place)))) cycle
               added = added_inertia(domain, columns, c, joint, spring(:, :, n))
               do i = 1, size(place)
                  if (.not. from(place(i))) cycle
                  do j = 1, size(place)
                     if (.not. to(place(j)) .or. abs(added(i, j)) <= 0.0_wp) cycle
                     if (j <= i .and. from(place(j)) .and. to(place(i))) cycle
                     links%inertia = [links%inertia, -columns%area(n)*added(i, j)]
                     links%place = reshape([links%place, place([i, j])], [2, size(links%inertia)])
                  end do
               end do
            end do
         end do
      end associate
   end function column_links

end module plydyn_domain_build_columns
