!> Keywords of supports, prescribed motions and initial velocities.
module plydyn_input_support
   use plydyn_base_precision, only : wp
   use plydyn_base_text, only : text
   use plydyn_deck_declaration, only : extension, standard
   use plydyn_input_card_visitor, only : card_visitor_type
   use plydyn_input_catalogue, only : a_curve, a_node, a_node_set
   use plydyn_input_constraint, only : add_constraints, led_node
   use plydyn_input_keyword_row, only : for_plates, keyword_list_type, stage_load, stage_support
   use plydyn_input_load, only : check_times, of_loads, visit_curve, visit_direction, &
      & visit_face, visit_factor
   use plydyn_model_layers, only : layers_type, new_layers
   use plydyn_model_layup, only : part_type
   use plydyn_model_support, only : bottom_face, support_type, initial_velocity_type, &
      & motion_type, one_plane, prescribes_displacement, top_face
   use plydyn_model_model, only : model_type
   implicit none
   private

   public :: add_supports

   !> What they are among the changes of a restart
   character(*), parameter :: of_supports = "supports", of_motions = "prescribed motions"

contains

   !> Add these keywords
   subroutine add_supports(list)
      type(keyword_list_type), intent(inout) :: list

      call list%add("BOUNDARY_SPC_SET", boundary_spc_set, stage_support)
      call list%add("BOUNDARY_FACE", boundary_face, stage_support, for_plates)
      call list%add("BOUNDARY_PRESCRIBED_MOTION_SET", boundary_prescribed_motion_set, stage_load, &
         & check=check_times)
      call list%add("BOUNDARY_FACE_MOTION", boundary_face_motion, stage_load, for_plates, &
         & check_times)
      call add_constraints(list)
      call list%add("INITIAL_VELOCITY", initial_velocity, stage_support)
      call list%add("INITIAL_VELOCITY_NODE", initial_velocity_node, stage_support)
   end subroutine add_supports

   !> Nodes held over the whole thickness
   subroutine boundary_spc_set(card, model)
      class(card_visitor_type), intent(inout) :: card
      type(model_type), intent(inout) :: model

      character(5), parameter :: rotations(3) = ["DOFRX", "DOFRY", "DOFRZ"]
      type(support_type) :: support
      logical :: is_held
      integer :: i

      call card%keyword(standard, "Fixes nodes over the whole thickness; clamped with all three " &
         & //"directions.", suffixes="ID", change=of_supports)
      call card%remark("A direction is fixed at all points through the thickness. The points " &
         & //"have no rotations: DOFRX to DOFRZ may be 1 where DOFX, DOFY and DOFZ are all 1 " &
         & //"(clamped), since the points cannot rotate there.")
      call card%example(of_loads, "1, , 1, 1, 1")
      do while (card%next())
         call card%members(a_node_set, "NSID", "node set", support%nodes)
         call card%unused("CID")
         call visit_directions(card, support)
         do i = 1, size(rotations)
            call card%flag(rotations(i), "1 only for clamped nodes", is_held)
            if (.not. card%reads .or. all(support%direction)) cycle
            if (is_held) call card%refuse(rotations(i), &
               & "the points of the plate have no rotations to hold", &
               & "0, or DOFX = DOFY = DOFZ = 1 to clamp the nodes")
         end do
         if (.not. card%reads) cycle
         support%name = "spc "//text(card%whole("NSID"))
         support%line = card%line_of("NSID")
         model%supports = [model%supports, support]
      end do
   end subroutine boundary_spc_set

   !> One face or plane held
   subroutine boundary_face(card, model)
      class(card_visitor_type), intent(inout) :: card
      type(model_type), intent(inout) :: model

      type(support_type) :: support

      call card%keyword(extension, "Fixes one face, or one plane of points, of some nodes.", &
         & change=of_supports)
      call card%example(of_loads, "1, -1, 0, 0, 0, 1")
      do while (card%next())
         call card%members(a_node_set, "NSID", "node set", support%nodes)
         call card%integer("FACE", "-1 bottom face, 1 top face, 0 the plane at height Z", &
            & support%face, allowed=[-1, 0, 1])
         call card%real("Z", "length", "height above the nodes, for FACE 0", support%height, &
            & default=0.0_wp)
         call visit_directions(card, support)
         if (.not. card%reads) cycle
         if (support%face /= one_plane .and. abs(support%height) > 0.0_wp) call card%refuse("Z", &
            & "Z is given for a face", "0; a height is for FACE 0 only")
         call find_plane(card, model%parts, support)
         support%name = "face "//text(card%whole("NSID"))//face_words(support%face, support%height)
         support%line = card%line_of("NSID")
         model%supports = [model%supports, support]
      end do
   end subroutine boundary_face

   !> Directions that a support holds
   subroutine visit_directions(card, support)
      class(card_visitor_type), intent(inout) :: card
      type(support_type), intent(inout) :: support

      call card%flag("DOFX", "1 holds x", support%direction(1))
      call card%flag("DOFY", "1 holds y", support%direction(2))
      call card%flag("DOFZ", "1 holds z", support%direction(3))
      if (.not. card%reads .or. any(support%direction)) return
      if (card%is_fine("DOFX")) call card%refuse("DOFX", "the support holds nothing", &
         & "1 for at least one of DOFX, DOFY, DOFZ")
   end subroutine visit_directions

   !> A plane meets thickness nodes; one at a face of the laminate is that face
   subroutine find_plane(card, parts, support)
      class(card_visitor_type), intent(inout) :: card
      !> All laminates: their points are at the same heights
      type(part_type), intent(in) :: parts(:)
      type(support_type), intent(inout) :: support

      type(layers_type) :: layers

      ! parts may not be whole where something was refused
      if (support%face /= one_plane .or. size(parts) == 0) return
      if (card%catalogue%report%has_errors()) return
      layers = new_layers(parts(1))
      associate (nearest => layers%nearest_node(support%height))
         if (.not. layers%coincide(nearest, support%height)) then
            call card%refuse("Z", "no thickness node lies at this height", &
               & "the height of one, such as "//text(nearest))
         else if (layers%coincide(nearest, layers%bottom(1))) then
            support%face = bottom_face
         else if (layers%coincide(nearest, layers%top(size(layers%top)))) then
            support%face = top_face
         end if
      end associate
   end subroutine find_plane

   !> Nodes moved over the whole thickness
   subroutine boundary_prescribed_motion_set(card, model)
      class(card_visitor_type), intent(inout) :: card
      type(model_type), intent(inout) :: model

      type(motion_type) :: motion

      call card%keyword(standard, "Moves nodes over the whole thickness.", suffixes="ID", &
         & change=of_motions)
      call card%example(of_loads, "2, 3, 2, 1, -0.1")
      do while (card%next())
         call card%members(a_node_set, "NSID", "node set", motion%nodes)
         call visit_motion(card, motion)
         call card%refer(a_curve, "LCID", "curve", motion%curve)
         call visit_factor(card, motion%scale)
         call card%unused("VID")
         call card%nonnegative("DEATH", "time", "it acts until then; 0 for ever", motion%death)
         call card%nonnegative("BIRTH", "time", "it acts from then on", motion%birth)
         if (.not. card%reads) cycle
         if (motion%death <= 0.0_wp) motion%death = huge(1.0_wp)
         if (motion%death <= motion%birth) call card%refuse("DEATH", "the motion ends before it " &
            & //"begins", "a time behind BIRTH, or 0 for ever")
         call place_times(card, motion)
         motion%name = "motion "//text(card%whole("NSID"))
         call add_motion(card, motion, model)
      end do
   end subroutine boundary_prescribed_motion_set

   !> Nodes of one face moved
   subroutine boundary_face_motion(card, model)
      class(card_visitor_type), intent(inout) :: card
      type(model_type), intent(inout) :: model

      type(motion_type) :: motion

      call card%keyword(extension, "Moves one face of some nodes.", change=of_motions)
      call card%example(of_loads, "2, 1, 3, 2, 1, -0.1")
      do while (card%next())
         call card%members(a_node_set, "NSID", "node set", motion%nodes)
         call visit_face(card, motion%face)
         call visit_motion(card, motion)
         call visit_curve(card, "curve; 0 for the constant 1", model%curves, motion%curve)
         call visit_factor(card, motion%scale)
         if (.not. card%reads) cycle
         motion%name = "face motion "//text(card%whole("NSID"))//face_words(motion%face, 0.0_wp)
         call add_motion(card, motion, model)
      end do
   end subroutine boundary_face_motion

   !> Times of a motion that count from the restart in a stage, as its curve does
   subroutine place_times(card, motion)
      class(card_visitor_type), intent(inout) :: card
      type(motion_type), intent(inout) :: motion

      associate (origin => card%catalogue%origin(card%root))
         if (motion%birth > 0.0_wp) motion%birth = motion%birth + origin
         if (motion%death < huge(1.0_wp)) motion%death = motion%death + origin
      end associate
      if (card%line_of("BIRTH") <= card%catalogue%stored_lines) return
      if (motion%death <= card%catalogue%start(card%root)) then
         call card%warn("DEATH", "the motion ends before the restart", "a later time, or " &
            & //"*CONTROL_STAGE, with which times count from the restart")
      end if
   end subroutine place_times

   !> Direction and quantity of a motion
   subroutine visit_motion(card, motion)
      class(card_visitor_type), intent(inout) :: card
      type(motion_type), intent(inout) :: motion

      call visit_direction(card, motion%direction)
      call card%integer("VAD", "0 velocity, 1 acceleration, 2 displacement", motion%quantity, &
         & allowed=[0, 1, 2])
   end subroutine visit_motion

   !> Words of a name that distinguish the faces of a set
   function face_words(face, height) result(words)
      !> Which thickness points
      integer, intent(in) :: face
      !> Height of a plane
      real(wp), intent(in) :: height
      character(:), allocatable :: words

      select case (face)
      case (bottom_face); words = " bottom"
      case (top_face); words = " top"
      case (one_plane); words = " z "//text(height)
      case default; words = ""
      end select
   end function face_words

   !> Add a motion whose points are not held or moved already; warn of a displacement that is not 0
   !> at the start, where that of the points is
   subroutine add_motion(card, motion, model)
      class(card_visitor_type), intent(inout) :: card
      type(motion_type), intent(in) :: motion
      type(model_type), intent(inout) :: model

      real(wp) :: jump
      integer :: node

      ! the points of a restart are somewhere
      if (motion%quantity == prescribes_displacement .and. .not. &
         & (card%catalogue%report%has_errors() .or. card%catalogue%stored_lines > 0)) then
         jump = motion%scale*model%curves(motion%curve)%at(motion%birth)
         if (motion%birth > 0.0_wp) then
            call card%warn("BIRTH", "the points move freely until then, and jump to " &
               & //text(jump)//" in one step", "BIRTH 0, or VAD 0 for a velocity")
         else if (abs(jump) > 0.0_wp) then
            call card%warn("LCID", "the points jump by "//text(jump)//" in the first step", &
               & "a curve that is 0 at time 0")
         end if
      end if
      node = 0
      if (motion%direction > 0) node = led_node(model, motion%direction, motion%face, motion%nodes)
      if (node > 0) call card%refuse("DOF", "node " &
         & //text(card%catalogue%registers(a_node)%id(node)) &
         & //" is held or moved in this direction already", "each point held or moved once")
      model%motions = [model%motions, motion]
      model%motions(size(model%motions))%line = card%line_of("NSID")
   end subroutine add_motion

   !> Initial velocity of a set
   subroutine initial_velocity(card, model)
      class(card_visitor_type), intent(inout) :: card
      type(model_type), intent(inout) :: model

      type(initial_velocity_type) :: initial
      integer :: i

      call card%keyword(standard, "Velocity of nodes at time zero, over the whole thickness.")
      call card%remark("A later keyword overrides an earlier one. Impactors have a velocity of " &
         & //"their own.")
      call card%example("9-central-differences", "2|0, 0, -1000.0")
      call card%members(a_node_set, "NSID", "node set; 0 for all nodes", initial%nodes, default=0, &
         & least=0)
      call card%unused("NSIDEX BOXID IRIGID ICID")
      call card%card()
      call visit_velocity(card, initial%velocity)
      call card%unused("VXR VYR VZR")
      if (.not. card%reads) return
      initial%line = card%line_of("NSID")
      if (.not. allocated(initial%nodes)) initial%nodes = [(i, i=1, size(model%mesh%node_id))]
      model%initial_velocities = [model%initial_velocities, initial]
   end subroutine initial_velocity

   !> Initial velocity of nodes
   subroutine initial_velocity_node(card, model)
      class(card_visitor_type), intent(inout) :: card
      type(model_type), intent(inout) :: model

      type(initial_velocity_type) :: new(max(1, card%sets()))

      call card%keyword(standard, "Velocity of single nodes at time zero, over the whole " &
         & //"thickness.")
      call card%example("9-central-differences", "13, 0, 0, -1000.0")
      do while (card%next())
         allocate (new(card%nth)%nodes(1))
         call card%refer(a_node, "NID", "node", new(card%nth)%nodes(1))
         call visit_velocity(card, new(card%nth)%velocity)
         call card%unused("VXR VYR VZR ICID")
         if (card%reads) new(card%nth)%line = card%line_of("NID")
      end do
      if (card%reads) model%initial_velocities = [model%initial_velocities, new(:card%sets())]
   end subroutine initial_velocity_node

   !> Components of a velocity
   subroutine visit_velocity(card, velocity)
      class(card_visitor_type), intent(inout) :: card
      real(wp), intent(inout) :: velocity(3)

      call card%real("VX", "length/time", "velocity along x", velocity(1), default=0.0_wp)
      call card%real("VY", "length/time", "velocity along y", velocity(2), default=0.0_wp)
      call card%real("VZ", "length/time", "velocity along z", velocity(3), default=0.0_wp)
   end subroutine visit_velocity

end module plydyn_input_support
