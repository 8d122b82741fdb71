!> The faces that bodies may touch, on the points that a rank has, and the fixtures there. Faces are
!> whole on every rank, since contact is not divided.
module plydyn_domain_build_surfaces
   use plydyn_base_precision, only : wp
   use plydyn_base_sort, only : sorted_order
   use plydyn_domain_build_inertia, only : couple_surface
   use plydyn_domain_domain, only : domain_type, face_type, placed_fixture_type
   use plydyn_domain_local_to_global, only : local_to_global_type
   use plydyn_domain_supports, only : face_point
   use plydyn_element_quad, only : quad_node_area, tensor_order
   use plydyn_fem_columns, only : columns_type
   use plydyn_model_layers, only : layers_type
   use plydyn_model_mesh, only : mesh_type
   use plydyn_model_model, only : model_type
   use plydyn_model_outer_faces, only : all_parts, faces_of_parts
   use plydyn_model_support, only : bottom_face, top_face
   use plydyn_parallel_comm, only : comm_type
   implicit none
   private

   public :: build_fixtures, build_surfaces

   !> The faces that a fixture may meet
   integer, parameter :: faces(2) = [bottom_face, top_face]

contains

   !> Faces that impactors may touch. All ranks must come here
   subroutine build_surfaces(model, numbering, domain)
      type(model_type), intent(in) :: model
      type(local_to_global_type), intent(in) :: numbering
      !> Has its masses, supports and inertia; gets faces
      type(domain_type), intent(inout) :: domain

      integer :: i

      allocate (domain%contact%surfaces(size(model%contacts)))
      do i = 1, size(model%contacts)
         associate (contact => model%contacts(i))
            call build_surface(model, contact%parts, contact%face, numbering, domain, &
               & domain%contact%surfaces(i))
         end associate
      end do
   end subroutine build_surfaces

   !> A face of the plate on the points that a rank has. All ranks must come here
   subroutine build_surface(model, parts, face, numbering, domain, surface)
      type(model_type), intent(in) :: model
      !> Indices of the parts, or `all_parts`
      integer, intent(in) :: parts(:)
      !> `bottom_face` or `top_face`
      integer, intent(in) :: face
      type(local_to_global_type), intent(in) :: numbering
      !> Has its masses, supports and inertia
      type(domain_type), intent(in) :: domain
      !> The face
      type(face_type), intent(out) :: surface

      integer :: point(2)

      point(:) = face_point(domain%layers, face)
      surface = new_surface(parts, face, model%mesh, domain%layers)
      call place_points(point, numbering, domain%comm%ranks, domain%columns, surface)
      call set_resistance(domain, point, surface)
   end subroutine build_surface

   !> Inverse masses of all points of a face, and what moves them
   subroutine set_resistance(domain, point, surface)
      type(domain_type), intent(in) :: domain
      !> Layer and thickness node of the face
      integer, intent(in) :: point(2)
      type(face_type), intent(inout) :: surface

      real(wp) :: values(6, size(surface%node))
      logical :: held(domain%columns%freedoms)
      integer :: c, i, motion(domain%columns%freedoms)

      held(:) = .false.
      held(domain%supports%held) = .true.
      motion(:) = 0
      do i = 1, size(domain%supports%motions)
         motion(domain%supports%motions(i)%freedom) = i
      end do
      ! points that the rank does not have get their values from those that count them
      associate (here => surface%here)
         do c = 1, 3
            values(c, here) = merge(0.0_wp, domain%inertia%inverse_mass( &
               & domain%columns%mass_of(point(1), &
               & point(2), surface%node(here))), held(surface%freedom(c, here)))
            values(3 + c, here) = real(motion(surface%freedom(c, here)), wp)
         end do
      end associate
      call couple_surface(domain, point, surface, values(:3, :))
      call collect_points(domain%comm, surface, values)
      surface%inverse_mass = values(:3, :)
      surface%motion = nint(values(4:, :))
   end subroutine set_resistance

   !> The face of a contact, as the whole model numbers its nodes: quads on the outer layer of a
   !> laminate, or outer faces of bricks
   pure function new_surface(parts, face, mesh, layers) result(self)
      !> Indices of the parts, or `all_parts`
      integer, intent(in) :: parts(:)
      !> `bottom_face` or `top_face`
      integer, intent(in) :: face
      type(mesh_type), intent(in) :: mesh
      type(layers_type), intent(in) :: layers
      type(face_type) :: self

      logical :: met(size(mesh%node_id))
      integer :: f, i, number(size(mesh%node_id)), point(2)
      integer, allocatable :: faces(:, :), node(:)

      faces = faces_of_parts(mesh, parts, face)
      met(:) = .false.
      do f = 1, size(faces, 2)
         met(faces(:, f)) = .true.
      end do
      node = pack([(i, i=1, size(met))], met)
      self%node = node
      number(:) = 0
      number(node) = [(i, i=1, size(node))]
      point(:) = face_point(layers, face)
      self%position = mesh%position(:, node)
      if (layers%order(point(1)) > 0) then
         self%position(3, :) = self%position(3, :) + layers%height(point(1), point(2))
      end if
      allocate (self%facet(size(faces, 1), size(faces, 2)))
      do f = 1, size(faces, 2)
         self%facet(:, f) = number(faces(:, f))
      end do
   end function new_surface

   !> Find the points of a face that a rank has in the arrays of motion
   pure subroutine place_points(point, numbering, ranks, columns, self)
      !> Layer and thickness node of the face
      integer, intent(in) :: point(2)
      type(local_to_global_type), intent(in) :: numbering
      !> How many ranks there are
      integer, intent(in) :: ranks
      type(columns_type), intent(in) :: columns
      !> The face with its nodes as the whole model numbers them, and then as the rank does
      type(face_type), intent(inout) :: self

      integer :: c, i, r
      integer, allocatable :: of_point(:)

      of_point = numbering%owner(numbering%column_of(self%node))
      self%counts = [(count(of_point == r), r=0, ranks - 1)]
      self%of_ranks = sorted_order(of_point)
      self%node(:) = numbering%node(self%node)
      self%here = pack([(i, i=1, size(self%node))], self%node > 0)
      self%own = spread(.false., 1, size(self%node))
      self%own(self%here) = numbering%own(1 + (self%node(self%here) - 1)/columns%nodes_per_column)
      allocate (self%freedom(3, size(self%node)), source=0)
      do c = 1, 3
         self%freedom(c, self%here) = columns%freedom(point(1), point(2), c, self%node(self%here))
      end do
   end subroutine place_points

   !> Give every rank a value of all points of a face
   subroutine collect_points(comm, self, values)
      type(comm_type), intent(in) :: comm
      !> The face
      type(face_type), intent(in) :: self
      !> Known at the points that the rank has in, at all points out, (numbers, points)
      real(wp), intent(inout) :: values(:, :)

      real(wp), allocatable :: all(:), part(:)
      integer :: i
      integer, allocatable :: own(:)

      own = pack([(i, i=1, size(self%own))], self%own)
      part = reshape(values(:, own), [size(values, 1)*size(own)])
      allocate (all(size(values)))
      call comm%allgather(part, size(values, 1)*self%counts, all)
      values(:, self%of_ranks) = reshape(all, shape(values))
   end subroutine collect_points

   !> Place all fixtures. All ranks must come here
   subroutine build_fixtures(model, numbering, domain)
      type(model_type), intent(in) :: model
      type(local_to_global_type), intent(in) :: numbering
      !> Has its masses, supports and inertia; gets fixtures and the faces that they meet
      type(domain_type), intent(inout) :: domain

      integer :: f, i

      allocate (domain%contact%fixtures(size(model%fixtures)))
      allocate (domain%contact%fixture_faces(size(faces)))
      do f = 1, size(faces)
         if (.not. any(model%fixtures%face == faces(f))) cycle
         associate (surface => domain%contact%fixture_faces(f))
            call build_surface(model, all_parts, faces(f), numbering, domain, surface)
            surface%area = point_areas(surface)
            do i = 1, size(model%fixtures)
               if (model%fixtures(i)%face /= faces(f)) cycle
               domain%contact%fixtures(i)%fixture_type = model%fixtures(i)
               domain%contact%fixtures(i)%surface = f
               call place_fixture(surface, domain%contact%fixtures(i))
            end do
         end associate
      end do
   end subroutine build_fixtures

   !> Height of a fixture, and the points under it
   pure subroutine place_fixture(surface, fixture)
      !> The face that it meets
      type(face_type), intent(in) :: surface
      type(placed_fixture_type), intent(inout) :: fixture

      integer :: k
      logical :: is_below(size(surface%node))

      associate (up => real(fixture%body%upward, wp))
         ! the outermost point of the face, seen from the fixture
         fixture%height = up*(minval(up*surface%position(3, :)) - fixture%gap)
      end associate
      do k = 1, size(is_below)
         is_below(k) = fixture%body%covers(surface%position(:2, k))
      end do
      fixture%area = sum(surface%area, is_below)
      fixture%below = pack(surface%here, is_below(surface%here))
   end subroutine place_fixture

   !> Area that belongs to each point of a face, in the plane
   pure function point_areas(surface) result(area)
      !> The face
      type(face_type), intent(in) :: surface
      real(wp) :: area(size(surface%node))

      integer :: f, point(size(surface%facet, 1)), side

      area(:) = 0.0_wp
      side = nint(sqrt(real(size(point), wp)))
      do f = 1, size(surface%facet, 2)
         point(:) = surface%facet(tensor_order(side), f)
         area(point) = area(point) + quad_node_area(side, surface%position(:2, point))
      end do
   end function point_areas

end module plydyn_domain_build_surfaces
