!> What never moves: impactors that never meet the plate, a plate that nothing acts on or that is
!> held; and what supports and prescribed motions leave free.
module plydyn_input_check_motion
   use plydyn_base_precision, only : wp
   use plydyn_base_text, only : text
   use plydyn_deck_report, only : deck_location_type
   use plydyn_input_catalogue, only : an_impactor, catalogue_type
   use plydyn_model_body, only : contact_type, fixture_type, impactor_type
   use plydyn_model_mesh, only : mesh_type
   use plydyn_model_model, only : model_type
   use plydyn_model_support, only : all_planes, holds_all
   implicit none
   private

   public :: check_acted_on, check_motion, check_supports, leads_away, moves_plate

   !> Sizes of the plate and the body beyond which their distance drowns the sizes in round-off
   real(wp), parameter :: far = 1.0e9_wp
   !> Share of the radius below which a gap may be none
   real(wp), parameter :: surely = 1.0e-3_wp
   !> Corners of a quad, and nodes of one that has nodes between them
   integer, parameter :: corners = 4, with_middles = 9

contains

   !> An impactor is there, or something else moves the plate; a laminate may be looked at without
   subroutine check_acted_on(model, catalogue)
      !> A sound model
      type(model_type), intent(in) :: model
      !> Gets findings
      type(catalogue_type), intent(inout) :: catalogue

      call check_velocities(model, catalogue)
      ! what a restart finds may move
      if (catalogue%stored_lines > 0 .or. size(model%contacts) > 0) return
      if (moves_plate(model, all_planes, 0)) return
      call catalogue%report%warn(deck_location_type(), "the deck has no impactor, no load and no " &
         & //"motion: nothing will happen in a run", "*CONTACT_IMPACTOR, a load, a motion or " &
         & //"*INITIAL_VELOCITY")
   end subroutine check_acted_on

   !> Warn of initial velocities of nodes that supports hold in all their directions
   subroutine check_velocities(model, catalogue)
      type(model_type), intent(in) :: model
      type(catalogue_type), intent(inout) :: catalogue

      integer :: c, i
      logical :: is_idle

      do i = 1, size(model%initial_velocities)
         associate (own => model%initial_velocities(i))
            if (own%line <= catalogue%stored_lines) cycle
            is_idle = .true.
            do c = 1, size(own%velocity)
               if (abs(own%velocity(c)) > 0.0_wp) is_idle = is_idle .and. holds_all( &
                  & model%supports, own%nodes, c, all_planes)
            end do
            if (is_idle) call catalogue%report%warn(deck_location_type(line=own%line), "the " &
               & //"velocity moves nothing: it is 0, or all its nodes are held", "a velocity of " &
               & //"nodes that are free")
         end associate
      end do
   end subroutine check_velocities

   !> An impactor can come to the plate. An error where nothing else moves the plate, so that
   !> nothing can happen; a warning where the motion of the plate could bring them together
   subroutine check_motion(model, contact, points, place, is_sound, catalogue, is_off)
      type(model_type), intent(in) :: model
      !> The impactor and the face
      type(contact_type), intent(in) :: contact
      !> Points of the face, (3, points)
      real(wp), intent(in) :: points(:, :)
      !> Where the deck has the impactor
      type(deck_location_type), intent(in) :: place
      !> Whether no error was found before
      logical, intent(in) :: is_sound
      !> Gets findings
      type(catalogue_type), intent(inout) :: catalogue
      !> Whether that has been reported
      logical, intent(out) :: is_off

      character(:), allocatable :: cause, remedy
      real(wp) :: beside

      associate (own => model%impactors(contact%impactor))
         ! from its centre to the rectangle around the plate
         beside = norm2(max(minval(points(:2, :), dim=2) - own%centre(:2), &
            & own%centre(:2) - maxval(points(:2, :), dim=2), 0.0_wp))
         is_off = beside > far*(own%body%radius + maxval(points(:2, :)) - minval(points(:2, :)))
         if (is_off) then
            call catalogue%report%refuse(place, "impactor "//text(own%id)//" begins " &
               & //text(beside)//" beside the plate", "a centre near the plate")
            return
         end if
         call find_cause(model, contact, points, beside, cause, remedy)
         is_off = len(cause) > 0
         cause = "impactor "//text(own%id)//" "//cause
      end associate
      if (.not. is_off) return
      ! what a restart finds may move, and a field that is wrong may have been a motion
      if (catalogue%stored_lines > 0 .or. moves_plate(model, contact%face, contact%impactor)) then
         if (index(cause, " is at rest") == 0) call catalogue%report%warn(place, cause, remedy)
      else if (is_sound) then
         call catalogue%report%refuse(place, cause//"; nothing moves the plate, either, so that " &
            & //"nothing can happen", remedy)
      end if
   end subroutine check_motion

   !> Why an impactor does not come to a plate at rest, empty where it may
   subroutine find_cause(model, contact, points, beside, cause, remedy)
      type(model_type), intent(in) :: model
      type(contact_type), intent(in) :: contact
      !> Points of the face, (3, points); way from its centre to the rectangle around them, length
      real(wp), intent(in) :: points(:, :), beside
      character(:), allocatable, intent(out) :: cause, remedy

      real(wp) :: gap

      associate (own => model%impactors(contact%impactor))
         gap = contact%face*own%centre(3) + own%body%lowest_height(contact%face) &
            & - maxval(contact%face*points(3, :))
         cause = ""
         remedy = "a velocity, a weight or a motion of the impactor towards the plate"
         if (beside > own%body%radius .and. .not. (is_driven(model, own, 1) &
            & .or. is_driven(model, own, 2))) then
            cause = "passes by: its centre lies "//text(beside)//" beside the plate"
            remedy = "a centre above or below the plate"
         else if (.not. (is_driven(model, own, 1) .or. is_driven(model, own, 2) &
            & .or. is_driven(model, own, 3))) then
            cause = "is at rest"
         else if (leads_away(model, own%motion(3), contact%face)) then
            cause = "moves away from the plate: its curve along z leads away"
            remedy = "the other sign of its values, or the other FACE on *CONTACT_IMPACTOR"
         else if (own%motion(3) == 0 .and. contact%face*own%velocity(3) > 0.0_wp &
            & .and. contact%face*own%gravity(3) >= 0.0_wp) then
            cause = "moves away from the plate"
            remedy = "the other sign of VZ, or the other FACE on *CONTACT_IMPACTOR"
         else if (gap > surely*own%body%radius .and. .not. is_driven(model, own, 3)) then
            cause = "moves along the plate alone, and does not touch it"
         end if
      end associate
   end subroutine find_cause

   !> Whether anything moves an impactor along a direction
   pure logical function is_driven(model, own, direction)
      type(model_type), intent(in) :: model
      type(impactor_type), intent(in) :: own
      !> 1, 2, 3 for x, y, z
      integer, intent(in) :: direction

      if (own%motion(direction) > 0) then
         is_driven = acts(model, own%motion(direction), 1.0_wp)
      else
         is_driven = abs(own%velocity(direction)) > 0.0_wp .or. abs(own%gravity(direction)) > 0.0_wp
      end if
   end function is_driven

   !> Whether a curve along z leads a body away from the face that it touches, and never back
   pure logical function leads_away(model, curve, face)
      type(model_type), intent(in) :: model
      !> Index of the curve, 0 for none; `bottom_face` or `top_face` of `plydyn_model_support`
      integer, intent(in) :: curve, face

      leads_away = .false.
      if (curve == 0) return
      associate (y => face*model%curves(curve)%y)
         leads_away = minval(y) >= 0.0_wp .and. maxval(y) > 0.0_wp
      end associate
   end function leads_away

   !> Whether loads, motions, fixtures, other impactors or an initial velocity move the plate
   pure logical function moves_plate(model, face, besides)
      type(model_type), intent(in) :: model
      !> Face of which clamps are not looked at, since they press the plate away from it;
      !> `all_planes` for none
      integer, intent(in) :: face
      !> Index of an impactor that is not looked at; 0 for none
      integer, intent(in) :: besides

      integer :: k

      ! a sum that stays zero moves nothing
      moves_plate = any(model%constraints%curve > 0 .and. acts(model, model%constraints%curve, &
         & model%constraints%scale)) .or. any(acts(model, model%motions%curve, &
         & model%motions%scale)) .or. any(acts(model, model%point_loads%curve, &
         & model%point_loads%scale)) .or. any(acts(model, model%line_loads%curve, &
         & model%line_loads%scale)) .or. any(acts(model, model%pressures%curve, &
         & model%pressures%scale)) .or. any(acts(model, model%segment_loads%curve, &
         & model%segment_loads%scale)) .or. any(acts(model, model%body_loads%curve, &
         & model%body_loads%scale))
      do k = 1, size(model%initial_velocities)
         moves_plate = moves_plate .or. norm2(model%initial_velocities(k)%velocity) > 0.0_wp
      end do
      do k = 1, size(model%fixtures)
         if (model%fixtures(k)%is_clamp .and. model%fixtures(k)%face == face) cycle
         moves_plate = moves_plate .or. presses(model, model%fixtures(k))
      end do
      do k = 1, size(model%contacts)
         if (any(model%contacts(k)%impactor == [0, besides])) cycle
         moves_plate = moves_plate .or. comes(model, model%contacts(k))
      end do
   end function moves_plate

   !> Whether a fixture is more than a body that stands still or leaves the plate
   pure logical function presses(model, fixture)
      type(model_type), intent(in) :: model
      type(fixture_type), intent(in) :: fixture

      presses = any(acts(model, pack(fixture%motion, fixture%motion > 0), 1.0_wp)) &
         & .and. .not. leads_away(model, fixture%motion(3), fixture%face)
      if (fixture%is_clamp) presses = acts(model, fixture%curve, fixture%force)
   end function presses

   !> Whether an impactor moves towards its face
   pure logical function comes(model, contact)
      type(model_type), intent(in) :: model
      type(contact_type), intent(in) :: contact

      associate (own => model%impactors(contact%impactor))
         if (own%motion(3) > 0) then
            comes = acts(model, own%motion(3), 1.0_wp) &
               & .and. .not. leads_away(model, own%motion(3), contact%face)
         else
            comes = min(contact%face*own%velocity(3), contact%face*own%gravity(3)) < 0.0_wp
         end if
      end associate
   end function comes

   !> Whether a curve with a factor is anything but zero
   elemental logical function acts(model, curve, scale)
      type(model_type), intent(in) :: model
      !> Index of the curve; 0 for the constant 1
      integer, intent(in) :: curve
      real(wp), intent(in) :: scale

      acts = abs(scale) > 0.0_wp
      if (curve > 0) acts = acts .and. maxval(abs(model%curves(curve)%y)) > 0.0_wp
   end function acts

   !> Warn of a plate that cannot move and of held corners alone, and note one that nothing holds
   subroutine check_supports(model, catalogue)
      !> A sound model
      type(model_type), intent(in) :: model
      !> Gets findings
      type(catalogue_type), intent(inout) :: catalogue

      integer :: i
      logical :: is_led(size(model%mesh%node_id))

      call check_freedom(model, catalogue)
      if (size(model%mesh%quad_id) == 0) return
      call check_struck(model, catalogue)
      is_led(:) = .false.
      do i = 1, size(model%supports)
         is_led(model%supports(i)%nodes) = .true.
      end do
      do i = 1, size(model%motions)
         is_led(model%motions(i)%nodes) = .true.
      end do
      do i = 1, size(model%supports)
         call check_middles(model%mesh, model%supports(i)%nodes, is_led, &
            & model%supports(i)%line, "held", catalogue)
      end do
      do i = 1, size(model%motions)
         call check_middles(model%mesh, model%motions(i)%nodes, is_led, model%motions(i)%line, &
            & "moved", catalogue)
      end do
   end subroutine check_supports

   !> Some points can move, and something keeps an impactor from taking the plate along
   subroutine check_freedom(model, catalogue)
      type(model_type), intent(in) :: model
      type(catalogue_type), intent(inout) :: catalogue

      integer :: c, i
      logical :: is_held(3)

      associate (nodes => [(i, i=1, size(model%mesh%node_id))])
         is_held(:) = [(holds_all(model%supports, nodes, c, all_planes), c=1, 3)]
      end associate
      if (all(is_held)) call catalogue%report%warn( &
         & deck_location_type(line=maxval(model%supports%line)), "all nodes are held along x, y " &
         & //"and z: the plate cannot move", "supports of some nodes, unless it is a rigid body")
      ! what an earlier deck holds is listed with the changes
      if (catalogue%stored_lines > 0 .or. size(model%contacts) == 0) return
      if (size(model%fixtures) + size(model%constraints) > 0) return
      if (any(model%motions%direction == 3)) return
      if (any([(model%supports(i)%direction(3), i=1, size(model%supports))])) return
      call catalogue%report%note(deck_location_type(), "nothing holds the plate along z", &
         & "it moves on with what hits it")
   end subroutine check_freedom

   !> Warn of an impactor whose centre is over a node that supports hold along z
   subroutine check_struck(model, catalogue)
      type(model_type), intent(in) :: model
      type(catalogue_type), intent(inout) :: catalogue

      integer :: i, n

      if (catalogue%stored_lines > 0) return
      do i = 1, size(model%contacts)
         associate (own => model%impactors(model%contacts(i)%impactor))
            n = minloc(norm2(model%mesh%position(:2, :) - spread(own%centre(:2), 2, &
               & size(model%mesh%node_id)), dim=1), 1)
            if (.not. holds_all(model%supports, [n], 3, all_planes)) cycle
            call catalogue%report%warn(catalogue%location(an_impactor, &
               & model%contacts(i)%impactor), "impactor "//text(own%id)//" comes down at node " &
               & //text(model%mesh%node_id(n))//", which is held along z", &
               & "a centre over the part of the plate that can move")
         end associate
      end do
   end subroutine check_struck

   !> Warn of nodes that are all corners of quads of nine nodes, where the nodes between two of them
   !> are left out
   subroutine check_middles(mesh, nodes, is_led, line, what, catalogue)
      type(mesh_type), intent(in) :: mesh
      !> Indices of the nodes
      integer, intent(in) :: nodes(:)
      !> Whether each node of the mesh is held or moved by any
      logical, intent(in) :: is_led(:)
      !> Line of the deck, and what is done with them
      integer, intent(in) :: line
      character(*), intent(in) :: what
      type(catalogue_type), intent(inout) :: catalogue

      integer :: k, q
      logical :: inside(size(mesh%node_id))

      if (size(mesh%quad_node, 1) < with_middles .or. line <= catalogue%stored_lines) return
      inside(:) = .false.
      inside(nodes) = .true.
      if (any(inside(pack(mesh%quad_node(corners + 1:, :), .true.)))) return
      do q = 1, size(mesh%quad_id)
         do k = 1, corners
            associate (one => mesh%quad_node(k, q), &
               & other => mesh%quad_node(modulo(k, corners) + 1, q), &
               & middle => mesh%quad_node(corners + k, q))
               if (.not. (inside(one) .and. inside(other)) .or. is_led(middle)) cycle
               call catalogue%report%warn(deck_location_type(line=line), "nodes " &
                  & //text(mesh%node_id(one))//" and "//text(mesh%node_id(other))//" are "//what &
                  & //", and node "//text(mesh%node_id(middle))//" between them is free", &
                  & "the nodes in the middle of sides, too, or corners that are apart")
               return
            end associate
         end do
      end do
   end subroutine check_middles

end module plydyn_input_check_motion
