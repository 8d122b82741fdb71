!> Fixtures: what must hold between them and the plate at time zero, and those that are in each
!> other's place, that hold nothing, or that nothing stands against.
module plydyn_input_check_fixture
   use plydyn_base_precision, only : wp
   use plydyn_base_text, only : text
   use plydyn_contact_bodies_flat_body, only : outline_type
   use plydyn_deck_report, only : deck_location_type
   use plydyn_input_catalogue, only : a_fixture, catalogue_type
   use plydyn_input_check_motion, only : leads_away, moves_plate
   use plydyn_model_body, only : fixture_type
   use plydyn_model_mesh, only : mesh_type
   use plydyn_model_model, only : model_type
   use plydyn_model_outer_faces, only : all_parts, faces_of_parts
   use plydyn_model_support, only : all_planes
   implicit none
   private

   public :: check_fixtures, check_holding

   !> Share of the size of an element by which a mesh line may lie off an edge
   real(wp), parameter :: on_line = 0.05_wp
   !> Share of the size of an outline by which equal ones may differ
   real(wp), parameter :: round_off = 1.0e-9_wp

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
      !> Index of the fixture, and nodes of each facet of the face that it meets
      integer, intent(in) :: i, facet(:, :)
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

   !> Refuse fixtures in one place, and warn of those that do nothing
   subroutine check_holding(model, catalogue)
      !> A sound model
      type(model_type), intent(in) :: model
      !> Gets findings
      type(catalogue_type), intent(inout) :: catalogue

      type(deck_location_type) :: place
      integer :: i

      do i = 1, size(model%fixtures)
         call check_twice(model, i, catalogue)
         place = catalogue%location(a_fixture, i)
         associate (own => model%fixtures(i))
            if (any(own%body%outlines%is_hole)) call check_window(model, own, place, catalogue)
            if (leads_away(model, own%motion(3), own%face)) call report_path(model, own, place, &
               & catalogue)
            if (.not. own%is_clamp) cycle
            if (own%curve > 0) call check_force(own, model%curves(own%curve)%y, place, catalogue)
            if (.not. is_held(model)) call check_opposite(model, own, place, catalogue)
         end associate
      end do
   end subroutine check_holding

   !> No fixture has the outlines of one before it; clamps add their forces
   subroutine check_twice(model, i, catalogue)
      type(model_type), intent(in) :: model
      !> Index of the fixture
      integer, intent(in) :: i
      type(catalogue_type), intent(inout) :: catalogue

      type(deck_location_type) :: place
      integer :: k

      place = catalogue%location(a_fixture, i)
      associate (own => model%fixtures(i), all => model%fixtures)
         do k = 1, i - 1
            if (all(k)%face /= own%face) cycle
            if (.not. are_equal(all(k)%body%outlines, own%body%outlines)) cycle
            if (own%is_clamp .and. all(k)%is_clamp) then
               call catalogue%report%warn(place, "clamp "//text(own%id)//" is in the place of " &
                  & //"clamp "//text(all(k)%id)//", and adds its force", "another place, or one " &
                  & //"clamp", catalogue%registers(a_fixture)%line(k))
            else
               call catalogue%report%refuse(place, "fixture "//text(own%id)//" is in the place " &
                  & //"of fixture "//text(all(k)%id), "one of them, or another place or face", &
                  & catalogue%registers(a_fixture)%line(k))
            end if
         end do
      end associate
   end subroutine check_twice

   !> Whether all outlines of two bodies are the same
   pure logical function are_equal(one, other)
      type(outline_type), intent(in) :: one(:), other(:)

      real(wp) :: tolerance
      integer :: k

      are_equal = size(one) == size(other)
      if (.not. are_equal) return
      do k = 1, size(one)
         tolerance = round_off*maxval(one(k)%half)
         are_equal = are_equal .and. (one(k)%is_hole .eqv. other(k)%is_hole) &
            & .and. norm2(one(k)%centre - other(k)%centre) <= tolerance &
            & .and. norm2(one(k)%half - other(k)%half) <= tolerance &
            & .and. norm2(one(k)%axis - other(k)%axis) <= round_off &
            & .and. abs(one(k)%corner - other(k)%corner) <= tolerance
      end do
   end function are_equal

   !> A window opens under the plate, and lets an impactor bend it
   subroutine check_window(model, own, place, catalogue)
      type(model_type), intent(in) :: model
      type(fixture_type), intent(in) :: own
      type(deck_location_type), intent(in) :: place
      type(catalogue_type), intent(inout) :: catalogue

      real(wp) :: wide
      integer :: c, n

      if (maxval([(way_to_hole(own, model%mesh%position(:2, n)), n=1, &
         & size(model%mesh%node_id))]) <= 0.0_wp) then
         call catalogue%report%warn(place, "the window of fixture "//text(own%id) &
            & //" is open under no node of the plate", "a window over the plate")
         return
      end if
      do c = 1, size(model%contacts)
         associate (body => model%impactors(model%contacts(c)%impactor))
            wide = way_to_hole(own, body%centre(:2))
            if (wide <= 0.0_wp .or. wide >= body%body%radius) cycle
            call catalogue%report%warn(place, "the window of fixture "//text(own%id) &
               & //" begins "//text(wide)//" beside the axis of impactor "//text(body%id) &
               & //", inside of its radius of "//text(body%body%radius), &
               & "a window wider than the impactor")
         end associate
      end do
   end subroutine check_window

   !> Distance of a place in a hole from the edge of the hole, 0 elsewhere, length
   pure real(wp) function way_to_hole(fixture, place) result(way)
      type(fixture_type), intent(in) :: fixture
      !> Place in the plane, length
      real(wp), intent(in) :: place(2)

      real(wp) :: depth, inward(2)
      integer :: k

      way = 0.0_wp
      associate (outlines => fixture%body%outlines)
         do k = 1, size(outlines)
            if (.not. outlines(k)%is_hole) cycle
            call outlines(k)%find_depth(place, depth, inward)
            way = max(way, -depth)
         end do
      end associate
   end function way_to_hole

   !> A fixture that moves along z only leaves the plate
   subroutine report_path(model, own, place, catalogue)
      type(model_type), intent(in) :: model
      type(fixture_type), intent(in) :: own
      type(deck_location_type), intent(in) :: place
      type(catalogue_type), intent(inout) :: catalogue

      character(*), parameter :: remedy = "the other sign of its values, or the other FACE"
      character(:), allocatable :: words

      words = "the curve of fixture "//text(own%id)//" along z leads away from the plate"
      if (catalogue%stored_lines > 0 .or. moves_plate(model, all_planes, 0)) then
         call catalogue%report%warn(place, words, remedy)
      else
         call catalogue%report%refuse(place, words//"; nothing else moves the plate, so that " &
            & //"nothing can happen", remedy)
      end if
   end subroutine report_path

   !> A clamp presses
   subroutine check_force(own, factor, place, catalogue)
      type(fixture_type), intent(in) :: own
      !> Ordinates of the curve of its force
      real(wp), intent(in) :: factor(:)
      type(deck_location_type), intent(in) :: place
      type(catalogue_type), intent(inout) :: catalogue

      if (maxval(factor*own%force) <= 0.0_wp) then
         call catalogue%report%warn(place, "clamp "//text(own%id)//" never presses: its force is " &
            & //"at most zero", "values above 0 in its curve")
      else if (minval(factor*own%force) < 0.0_wp) then
         call catalogue%report%warn(place, "the force of clamp "//text(own%id)//" is below zero " &
            & //"at times: it does not pull, and counts as none", &
            & "values of 0 or more in its curve")
      end if
   end subroutine check_force

   !> Supports hold what a clamp presses, or fixtures stand against it under its tip
   subroutine check_opposite(model, own, place, catalogue)
      type(model_type), intent(in) :: model
      type(fixture_type), intent(in) :: own
      type(deck_location_type), intent(in) :: place
      type(catalogue_type), intent(inout) :: catalogue

      character(:), allocatable :: who

      who = "clamp "//text(own%id)
      if (any(model%fixtures%face /= own%face)) then
         if (.not. is_opposed(model, own)) call catalogue%report%warn(place, who//" presses the " &
            & //"plate where no fixture of the other face stands against it", "a place over " &
            & //"such a fixture")
      else if (catalogue%removal_line > 0) then
         call catalogue%report%warn(deck_location_type(line=catalogue%removal_line), who &
            & //" stays and presses the plate, and nothing holds it from the other face any more", &
            & "*DELETE_FIXTURE for the clamps, too, or another base", place%line)
      else
         call catalogue%report%warn(place, who//" presses the plate, and nothing holds it " &
            & //"from the other face", "a fixture on the other face, or supports")
      end if
   end subroutine check_opposite

   !> Whether supports, motions or constraints act on the plate along z
   pure logical function is_held(model)
      type(model_type), intent(in) :: model

      integer :: k

      is_held = any(model%motions%direction == 3) .or. size(model%constraints) > 0
      do k = 1, size(model%supports)
         is_held = is_held .or. model%supports(k)%direction(3)
      end do
   end function is_held

   !> Whether a node under the tip of a clamp lies over a fixture of the other face
   pure logical function is_opposed(model, clamp)
      type(model_type), intent(in) :: model
      type(fixture_type), intent(in) :: clamp

      integer, allocatable :: facet(:, :)
      integer :: f, k, n

      facet = faces_of_parts(model%mesh, all_parts, clamp%face)
      is_opposed = .true.
      do f = 1, size(facet, 2)
         do n = 1, size(facet, 1)
            associate (place => model%mesh%position(:2, facet(n, f)))
               if (.not. clamp%body%covers(place)) cycle
               do k = 1, size(model%fixtures)
                  if (model%fixtures(k)%face == clamp%face) cycle
                  if (model%fixtures(k)%body%covers(place)) return
               end do
            end associate
         end do
      end do
      is_opposed = .false.
   end function is_opposed

end module plydyn_input_check_fixture
