!> Supports, loads, faces and shared inertia of one rank, cut out of those of the whole model.
module plydyn_domain_share_points
   use plydyn_domain_domain, only : domain_type, load_type, prescribed_type, surface_type
   use plydyn_domain_links, only : links_type
   use plydyn_domain_numbering, only : numbering_type
   implicit none
   private

   public :: take_inertia, take_loads, take_supports, take_surfaces, take_velocities

contains

   !> Held points and prescribed motions
   pure subroutine take_supports(whole, numbering, domain, support, own)
      !> The whole model
      type(domain_type), intent(in) :: whole
      !> The rank's numbers of columns
      type(numbering_type), intent(in) :: numbering
      !> Gets supports
      type(domain_type), intent(inout) :: domain
      !> Place of each in the list of supports of the whole model, and whether it is counted here
      integer, allocatable, intent(out) :: support(:)
      logical, allocatable, intent(out) :: own(:)

      integer :: first, m
      integer, allocatable :: some(:)

      support = indices(numbering%has(whole%held))
      own = numbering%counts(whole%held(support))
      domain%held = numbering%place(whole%held(support))
      first = size(whole%held)
      do m = 1, size(whole%motions)
         associate (all => whole%motions(m))
            some = indices(numbering%has(all%freedom))
            call cut_motion(all, some, numbering, domain%motions(m))
            support = [support, first + some]
            own = [own, domain%motions(m)%own]
            first = first + size(all%freedom)
         end associate
      end do
   end subroutine take_supports

   !> Some points of a prescribed motion
   pure subroutine cut_motion(whole, some, numbering, motion)
      type(prescribed_type), intent(in) :: whole
      integer, intent(in) :: some(:)
      type(numbering_type), intent(in) :: numbering
      type(prescribed_type), intent(inout) :: motion

      motion%freedom = numbering%place(whole%freedom(some))
      motion%mass = numbering%mass_place(whole%mass(some))
      motion%own = numbering%counts(whole%freedom(some))
   end subroutine cut_motion

   !> Where a mask is true
   pure function indices(mask) result(list)
      logical, intent(in) :: mask(:)
      integer, allocatable :: list(:)
      integer :: i

      list = pack([(i, i=1, size(mask))], mask)
   end function indices

   !> Forces on points
   pure subroutine take_loads(whole, numbering, domain)
      !> The whole model
      type(domain_type), intent(in) :: whole
      !> The rank's numbers of columns
      type(numbering_type), intent(in) :: numbering
      !> Gets loads
      type(domain_type), intent(inout) :: domain
      integer :: k

      do k = 1, size(whole%loads)
         call cut_load(whole%loads(k), numbering, domain%loads(k))
      end do
   end subroutine take_loads

   !> The columns of a load that the rank has
   pure subroutine cut_load(whole, numbering, load)
      type(load_type), intent(in) :: whole
      type(numbering_type), intent(in) :: numbering
      type(load_type), intent(inout) :: load

      logical, allocatable :: here(:)
      integer, allocatable :: column(:), some(:)
      integer :: c

      here = numbering%has(whole%freedom)
      column = indices(here(whole%last))
      some = indices(here)
      load%freedom = numbering%place(whole%freedom(some))
      load%force = whole%force(some)
      load%last = [(count(here(:whole%last(column(c)))), c=1, size(column))]
      load%own = numbering%counts(whole%freedom(whole%last(column)))
   end subroutine cut_load

   !> Velocities at time zero
   pure subroutine take_velocities(whole, numbering, domain)
      !> The whole model
      type(domain_type), intent(in) :: whole
      !> The rank's numbers of columns
      type(numbering_type), intent(in) :: numbering
      !> Gets the velocities
      type(domain_type), intent(inout) :: domain
      integer :: i

      do i = 1, size(whole%initial_velocities)
         associate (nodes => numbering%node(whole%initial_velocities(i)%nodes))
            domain%initial_velocities(i)%nodes = pack(nodes, nodes > 0)
         end associate
      end do
   end subroutine take_velocities

   !> Faces that impactors may touch: whole, with the points that the rank has
   pure subroutine take_surfaces(whole, numbering, owner, ranks, domain)
      !> The whole model
      type(domain_type), intent(in) :: whole
      !> The rank's numbers of columns
      type(numbering_type), intent(in) :: numbering
      !> Rank that adds to each column, and how many ranks there are
      integer, intent(in) :: owner(:), ranks
      !> Gets the faces
      type(domain_type), intent(inout) :: domain

      integer, allocatable :: of_point(:)
      integer :: i, r

      do i = 1, size(whole%surfaces)
         of_point = owner(whole%columns%column_of(whole%surfaces(i)%freedom(1, :)))
         domain%surfaces(i)%counts = [(count(of_point == r), r=0, ranks - 1)]
         domain%surfaces(i)%of_ranks = [(indices(of_point == r), r=0, ranks - 1)]
         call mark_points(whole%surfaces(i), numbering, domain%surfaces(i))
      end do
   end subroutine take_surfaces

   !> Points of a face that the rank has
   pure subroutine mark_points(whole, numbering, surface)
      type(surface_type), intent(in) :: whole
      type(numbering_type), intent(in) :: numbering
      type(surface_type), intent(inout) :: surface

      integer :: i

      surface%here = indices(numbering%has(whole%freedom(1, :)))
      surface%own = spread(.false., 1, size(whole%node))
      surface%own(surface%here) = numbering%counts(whole%freedom(1, surface%here))
      surface%freedom(:, :) = 0
      surface%node(:) = numbering%node(whole%node)
      do i = 1, size(surface%here)
         associate (k => surface%here(i))
            surface%freedom(:, k) = numbering%place(whole%freedom(:, k))
         end associate
      end do
   end subroutine mark_points

   !> Inertia that points share
   pure subroutine take_inertia(whole, numbering, domain)
      !> The whole model
      type(domain_type), intent(in) :: whole
      !> The rank's numbers of columns
      type(numbering_type), intent(in) :: numbering
      !> Has its supports; gets the inertia
      type(domain_type), intent(inout) :: domain
      integer :: k, n

      associate (pairs => domain%pairs, here => numbering%here)
         if (allocated(pairs%area)) then
            pairs%area = whole%pairs%area(here)
            pairs%class = whole%pairs%class(here)
            pairs%far = whole%pairs%far(:, :, here)
            do n = 1, size(pairs%far, 3)
               do k = 1, size(pairs%far, 2)
                  pairs%far(:, k, n) = numbering%place(pairs%far(:, k, n))
               end do
            end do
         end if
      end associate
      associate (thickness => domain%thickness, here => numbering%here)
         if (allocated(thickness%area)) then
            thickness%area = whole%thickness%area(here)
            thickness%class = whole%thickness%class(here)
            thickness%kind = whole%thickness%kind(:, here)
         end if
      end associate
      call cut_links(whole%moved_links, numbering, domain%moved_links)
      call cut_held_links(whole, numbering, domain)
   end subroutine take_inertia

   !> Links in the columns that the rank has
   pure subroutine cut_links(whole, numbering, links)
      type(links_type), intent(in) :: whole
      type(numbering_type), intent(in) :: numbering
      type(links_type), intent(inout) :: links

      integer, allocatable :: some(:)

      some = indices(numbering%has(whole%place(1, :)))
      links%place = whole%place(:, some)
      links%place(:, :) = numbering%place(links%place)
      links%inertia = whole%inertia(some)
      links%own = numbering%counts(whole%place(1, some))
   end subroutine cut_links

   !> The same for links of held points, which are places in their list
   pure subroutine cut_held_links(whole, numbering, domain)
      type(domain_type), intent(in) :: whole
      type(numbering_type), intent(in) :: numbering
      type(domain_type), intent(inout) :: domain

      integer :: i, number(size(whole%held))
      integer, allocatable :: some(:)

      number(:) = 0
      some = indices(numbering%has(whole%held))
      number(some) = [(i, i=1, size(some))]
      associate (all => whole%held_links, links => domain%held_links)
         some = indices(numbering%has(all%place(2, :)))
         links%place = all%place(:, some)
         links%place(1, :) = number(links%place(1, :))
         links%place(2, :) = numbering%place(links%place(2, :))
         links%inertia = all%inertia(some)
         links%own = numbering%counts(all%place(2, some))
      end associate
   end subroutine cut_held_links

end module plydyn_domain_share_points
