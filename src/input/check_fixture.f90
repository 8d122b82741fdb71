!> What must hold between fixtures and the plate at time zero.
module plydyn_input_check_fixture
   use plydyn_base_precision, only : wp
   use plydyn_base_text, only : text
   use plydyn_deck_report, only : deck_location_type
   use plydyn_input_catalogue, only : a_fixture, catalogue_type
   use plydyn_model_body, only : fixture_type
   use plydyn_model_mesh, only : mesh_type
   use plydyn_model_model, only : model_type
   use plydyn_model_outer_faces, only : all_parts, faces_of_parts
   implicit none
   private

   public :: check_fixtures

   !> Share of the size of an element by which a mesh line may lie off an edge
   real(wp), parameter :: on_line = 0.05_wp

contains

   !> Every fixture meets the plate, none begins inside it, and mesh lines follow its edges
   subroutine check_fixtures(model, catalogue)
      !> A sound model
      type(model_type), intent(in) :: model
      !> Gets findings
      type(catalogue_type), intent(inout) :: catalogue

      integer, allocatable :: facet(:, :)
      integer :: i

      do i = 1, size(model%fixtures)
         facet = faces_of_parts(model%mesh, all_parts, model%fixtures(i)%face)
         call check_fixture(model, i, facet, catalogue)
      end do
   end subroutine check_fixtures

   !> Check one fixture
   subroutine check_fixture(model, i, facet, catalogue)
      type(model_type), intent(in) :: model
      !> Index of the fixture
      integer, intent(in) :: i
      !> Nodes of each facet of the face that it meets
      integer, intent(in) :: facet(:, :)
      type(catalogue_type), intent(inout) :: catalogue

      character(:), allocatable :: who
      type(deck_location_type) :: place
      real(wp) :: inside

      associate (fixture => model%fixtures(i))
         place = catalogue%location(a_fixture, i)
         who = "fixture "//text(fixture%id)
         if (.not. meets_node(fixture, model%mesh, facet)) then
            call catalogue%report%refuse(place, who//" lies over no node of the face", &
               & "a fixture over the plate, or a finer mesh under it")
            return
         end if
         if (fixture%motion(3) > 0) then
            inside = fixture%body%upward*model%curves(fixture%motion(3))%at(0.0_wp) - fixture%gap
            if (inside > 0.0_wp) call catalogue%report%refuse(place, who//" begins " &
               & //text(inside)//" inside the plate", "a larger GAP, or a curve LCZ that " &
               & //"begins at 0")
         end if
         ! a soft tip has no edge that a span depends on
         if (.not. fixture%is_clamp) call check_lines(fixture, model%mesh, facet, place, catalogue)
      end associate
   end subroutine check_fixture

   !> Whether a node of the face lies over a fixture
   pure logical function meets_node(fixture, mesh, facet)
      type(fixture_type), intent(in) :: fixture
      type(mesh_type), intent(in) :: mesh
      integer, intent(in) :: facet(:, :)

      integer :: f, k

      meets_node = .false.
      do f = 1, size(facet, 2)
         do k = 1, size(facet, 1)
            meets_node = fixture%body%covers(mesh%position(:2, facet(k, f)))
            if (meets_node) return
         end do
      end do
   end function meets_node

   !> Warn where the edge of the flat face cuts more elements than mesh lines follow it: points of
   !> the plate carry the contact, so that the span would be wrong by up to an element
   subroutine check_lines(fixture, mesh, facet, place, catalogue)
      type(fixture_type), intent(in) :: fixture
      type(mesh_type), intent(in) :: mesh
      integer, intent(in) :: facet(:, :)
      !> Where the deck has the fixture
      type(deck_location_type), intent(in) :: place
      type(catalogue_type), intent(inout) :: catalogue

      real(wp) :: depth(0:size(facet, 1)), inward(2), length
      integer :: cut, f, k, touched

      cut = 0
      touched = 0
      do f = 1, size(facet, 2)
         associate (xy => mesh%position(:2, facet(:, f)))
            ! the middle, and the nodes
            call fixture%body%find_depth(sum(xy, dim=2)/size(xy, 2), depth(0), inward)
            do k = 1, size(xy, 2)
               call fixture%body%find_depth(xy(:, k), depth(k), inward)
            end do
            length = norm2(xy(:, 3) - xy(:, 1))
            depth(:) = depth - fixture%body%edge
         end associate
         if (minval(depth) < -on_line*length .and. maxval(depth) > on_line*length) then
            cut = cut + 1
         else if (minval(abs(depth)) <= on_line*length) then
            touched = touched + 1
         end if
      end do
      if (cut <= touched) return
      call catalogue%report%warn(place, "no mesh line follows the edge of the face of fixture " &
         & //text(fixture%id)//": it cuts "//text(cut)//" elements", "nodes along the edge, as " &
         & //"contact is at points of the plate; the span is wrong by up to an element")
   end subroutine check_lines

end module plydyn_input_check_fixture
