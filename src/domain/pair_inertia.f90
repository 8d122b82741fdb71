!> Inertia across interfaces: what lets their springs be stepped over (pair-implicit interfaces).
!>
!> The traction of an interface taken half at the end of the step instead of at its beginning adds
!> beta dt**2 K, per area, to the inertia of the relative motion of its faces. It couples the two
!> points of a pair and nothing else: the sum of their momenta does not feel it.
module plydyn_domain_pair_inertia
   use plydyn_base_exact_sum, only : exact_sum_type
   use plydyn_base_precision, only : lanes, wp
   use plydyn_fem_columns, only : columns_type
   use plydyn_domain_node_classes, only : find_classes
   use plydyn_element_group, only : group_item_type
   use plydyn_parallel_comm, only : comm_type
   implicit none
   private

   public :: joint_stiffness, new_pair_inertia

   !> Share of the stiffness that is taken at the end of the step
   real(wp), parameter, public :: implicit_share = 0.5_wp

   !> Inertia of the relative motion of two points, of some of them
   type, public :: inertia_links_type
      !> Places in the arrays of motion, (2, links)
      integer, allocatable :: place(:, :)
      !> Inertia, (links)
      real(wp), allocatable :: inertia(:)
      !> Whether this rank counts each
      logical, allocatable :: own(:)
   contains
      procedure :: count_energy
   end type inertia_links_type

   !> Pairs between lanes side by side in an order group; zero where there is none
   type :: pair_table_type
      !> Inertia per area of the relative motion along x, y, z above each lane,
      !> (lanes*blocks, 3)
      real(wp), allocatable :: inertia(:, :)
      !> Shares of the relative acceleration of the uncoupled points that the lower and the upper
      !> point lose, (lanes*blocks, 3, classes of nodes)
      real(wp), allocatable :: below(:, :, :), above(:, :, :)
   end type pair_table_type

   !> Pairs of all interfaces
   type, public :: pair_inertia_type
      !> Whether there are any
      logical :: active = .false.
      !> Lower layers of the pairs; inertia per area along x, y, z, (3, pairs)
      integer, allocatable :: joint(:)
      real(wp), allocatable :: inertia(:, :)
      !> Area and class of each node
      real(wp), allocatable :: area(:)
      integer, allocatable :: class(:)
      !> Pairs side by side, one for each order group
      type(pair_table_type), allocatable :: tables(:)
      !> Pairs whose layers are of different order groups: points below and above,
      !> (2, 3*pairs, nodes), with inertia and shares as above
      integer, allocatable :: far(:, :, :)
      real(wp), allocatable :: far_inertia(:), far_share(:, :, :)
   contains
      procedure :: links_between
   end type pair_inertia_type

contains

   !> Stiffness of the springs between each layer and the next along x, y, z; zero without any
   pure function joint_stiffness(groups, joints) result(stiffness)
      type(group_item_type), intent(in) :: groups(:)
      !> Number of layers less one
      integer, intent(in) :: joints
      real(wp) :: stiffness(3, joints)
      integer :: g, i

      stiffness(:, :) = 0.0_wp
      do g = 1, size(groups)
         if (.not. allocated(groups(g)%item%springs)) cycle
         do i = 1, size(groups(g)%item%springs)
            associate (spring => groups(g)%item%springs(i))
               stiffness(:, spring%layer) = spring%stiffness
            end associate
         end do
      end do
   end function joint_stiffness

   !> Inertia of all pairs for one step. All ranks must come here
   function new_pair_inertia(comm, number, columns, mass, area, stiffness, step) result(self)
      type(comm_type), intent(in) :: comm
      !> What number each node has in the whole model
      integer, intent(in) :: number(:)
      type(columns_type), intent(in) :: columns
      !> Mass of each point; area of each node
      real(wp), intent(in) :: mass(:), area(:)
      !> Springs along x, y, z between each layer and the next, (3, layers - 1)
      real(wp), intent(in) :: stiffness(:, :)
      real(wp), intent(in) :: step
      type(pair_inertia_type) :: self

      real(wp), allocatable :: density(:, :), first(:, :)
      integer :: f, j, n

      self%active = .true.
      self%joint = pack([(j, j=1, size(stiffness, 2))], maxval(stiffness, 1) > 0.0_wp)
      allocate (density(2*size(self%joint), size(area)), self%class(size(area)))
      do n = 1, size(area)
         density(1::2, n) = &
            & mass(columns%mass_of(self%joint, columns%levels(self%joint), n))/area(n)
         density(2::2, n) = mass(columns%mass_of(self%joint + 1, 1, n))/area(n)
      end do
      self%area = area
      call find_classes(comm, number, density, self%class, first)
      allocate (self%tables(size(columns%order_groups)))
      do f = 1, size(columns%order_groups)
         associate (width => lanes*columns%order_groups(f)%blocks, table => self%tables(f))
            allocate (table%inertia(width, 3), source=0.0_wp)
            allocate (table%below(width, 3, size(first, 2)), source=0.0_wp)
            allocate (table%above(width, 3, size(first, 2)), source=0.0_wp)
         end associate
      end do
      self%inertia = implicit_share*step**2*stiffness(:, self%joint)
      call place_pairs(self, columns, first)
   end function new_pair_inertia

   !> Put every joint into the table of its order group, or among the far ones
   pure subroutine place_pairs(self, columns, density)
      type(pair_inertia_type), intent(inout) :: self
      type(columns_type), intent(in) :: columns
      !> Mass per area of lower and upper points, (2*pairs, classes)
      real(wp), intent(in) :: density(:, :)

      real(wp) :: share(2, 3, size(density, 2))
      integer :: far, i, lane

      far = 3*count(columns%layer_slot(1, self%joint) /= columns%layer_slot(1, self%joint + 1))
      allocate (self%far(2, far, columns%nodes), self%far_inertia(far))
      allocate (self%far_share(2, far, size(density, 2)))
      far = 0
      do i = 1, size(self%joint)
         share(:, :, :) = shares(self%inertia(:, i), density(2*i - 1:2*i, :))
         associate (slot => columns%layer_slot(:, self%joint(i)))
            if (slot(1) == columns%layer_slot(1, self%joint(i) + 1)) then
               lane = slot(3) + lanes*(slot(2) - 1)
               associate (table => self%tables(slot(1)))
                  table%inertia(lane, :) = self%inertia(:, i)
                  table%below(lane, :, :) = share(1, :, :)
                  table%above(lane, :, :) = share(2, :, :)
               end associate
            else
               self%far(:, far + 1:far + 3, :) = places(columns, self%joint(i))
               self%far_inertia(far + 1:far + 3) = self%inertia(:, i)
               self%far_share(:, far + 1:far + 3, :) = share
               far = far + 3
            end if
         end associate
      end do
   end subroutine place_pairs

   !> Shares of the relative acceleration that both points lose, in closed form
   pure function shares(inertia, density) result(share)
      !> Inertia per area along x, y, z; mass per area of both points, (2, classes)
      real(wp), intent(in) :: inertia(3), density(:, :)
      real(wp) :: share(2, 3, size(density, 2))
      integer :: c

      do c = 1, size(density, 2)
         share(1, :, c) = inertia/density(1, c)/(1.0_wp + inertia*sum(1.0_wp/density(:, c)))
         share(2, :, c) = inertia/density(2, c)/(1.0_wp + inertia*sum(1.0_wp/density(:, c)))
      end do
   end function shares

   !> Places of the lower and the upper points of a pair, (2, 3, nodes)
   pure function places(columns, layer) result(place)
      type(columns_type), intent(in) :: columns
      !> The lower layer
      integer, intent(in) :: layer
      integer, allocatable :: place(:, :, :)
      integer :: c, n

      allocate (place(2, 3, columns%nodes))
      do n = 1, columns%nodes
         do c = 1, 3
            place(:, c, n) = [columns%freedom(layer, columns%levels(layer), c, n), &
               & columns%freedom(layer + 1, 1, c, n)]
         end do
      end do
   end function places

   !> Pairs of which both points are among some
   pure function links_between(self, columns, chosen) result(links)
      class(pair_inertia_type), intent(in) :: self
      type(columns_type), intent(in) :: columns
      !> Whether each place in the arrays of motion is one of them
      logical, intent(in) :: chosen(:)
      type(inertia_links_type) :: links

      integer :: c, i, n, place(2, 3, columns%nodes)

      allocate (links%place(2, 0), links%inertia(0))
      do i = 1, size(self%joint)
         place(:, :, :) = places(columns, self%joint(i))
         do n = 1, columns%nodes
            do c = 1, 3
               if (.not. all(chosen(place(:, c, n)))) cycle
               links%inertia = [links%inertia, self%area(n)*self%inertia(c, i)]
               links%place = reshape([links%place, place(:, c, n)], [2, size(links%inertia)])
            end do
         end do
      end do
   end function links_between

   !> Add the kinetic energy of all links, times a factor, to a sum
   pure subroutine count_energy(self, velocity, factor, sum)
      class(inertia_links_type), intent(in) :: self
      !> Velocity of all points; the factor
      real(wp), intent(in) :: velocity(:), factor
      type(exact_sum_type), intent(inout) :: sum

      integer :: i

      do i = 1, size(self%inertia)
         if (.not. self%own(i)) cycle
         associate (first => velocity(self%place(1, i)), second => velocity(self%place(2, i)))
            call sum%add(0.5_wp*factor*self%inertia(i)*(second - first)**2)
         end associate
      end do
   end subroutine count_energy

end module plydyn_domain_pair_inertia
