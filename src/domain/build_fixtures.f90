!> Fixtures on the points that a rank has.
module plydyn_domain_build_fixtures
   use plydyn_base_precision, only : wp
   use plydyn_domain_build_points, only : build_surface
   use plydyn_domain_domain, only : domain_type, placed_fixture_type, surface_type
   use plydyn_domain_local_to_global, only : local_to_global_type
   use plydyn_element_quad, only : quad_node_area, tensor_order
   use plydyn_model_model, only : model_type
   use plydyn_model_outer_faces, only : all_parts
   use plydyn_model_support, only : bottom_face, top_face
   implicit none
   private

   public :: build_fixtures

   !> The faces that a fixture may meet
   integer, parameter :: faces(2) = [bottom_face, top_face]

contains

   !> Place all fixtures. All ranks must come here
   subroutine build_fixtures(model, numbering, owner, domain)
      type(model_type), intent(in) :: model
      !> The rank's numbers of columns
      type(local_to_global_type), intent(in) :: numbering
      !> Rank that counts each column
      integer, intent(in) :: owner(:)
      !> Has its masses, supports and inertia; gets fixtures and the faces that they meet
      type(domain_type), intent(inout) :: domain

      integer :: f, i

      allocate (domain%contact%fixtures(size(model%fixtures)))
      allocate (domain%contact%fixture_faces(size(faces)))
      do f = 1, size(faces)
         if (.not. any(model%fixtures%face == faces(f))) cycle
         associate (surface => domain%contact%fixture_faces(f))
            call build_surface(model, all_parts, faces(f), numbering, owner, domain, surface)
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
      type(surface_type), intent(in) :: surface
      type(placed_fixture_type), intent(inout) :: fixture

      real(wp) :: depth, inward(2)
      integer :: k
      logical :: is_below(size(surface%node))

      associate (up => real(fixture%body%upward, wp))
         ! the outermost point of the face, seen from the fixture
         fixture%height = up*(minval(up*surface%position(3, :)) - fixture%gap)
      end associate
      do k = 1, size(is_below)
         call fixture%body%find_depth(surface%position(:2, k), depth, inward)
         is_below(k) = depth >= 0.0_wp
      end do
      fixture%area = sum(surface%area, is_below)
      fixture%below = pack(surface%here, is_below(surface%here))
   end subroutine place_fixture

   !> Area that belongs to each point of a face, in the plane
   pure function point_areas(surface) result(area)
      !> The face
      type(surface_type), intent(in) :: surface
      real(wp) :: area(size(surface%node))

      integer :: f, point(size(surface%facet, 1)), side

      area(:) = 0.0_wp
      side = nint(sqrt(real(size(point), wp)))
      do f = 1, size(surface%facet, 2)
         point(:) = surface%facet(tensor_order(side), f)
         area(point) = area(point) + quad_node_area(side, surface%position(:2, point))
      end do
   end function point_areas

end module plydyn_domain_build_fixtures
