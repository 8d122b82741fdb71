!> Readers of supports, prescribed motions and initial velocities.
module plydyn_input_read_support
   use plydyn_base_precision, only : wp
   use plydyn_base_text, only : text
   use plydyn_deck_cards, only : cards_type
   use plydyn_input_catalogue, only : a_curve, a_node, a_node_set, catalogue_type
   use plydyn_input_read_load, only : find_curve
   use plydyn_model_curve, only : curve_type
   use plydyn_model_layers, only : layers_type, new_layers
   use plydyn_model_layup, only : part_type
   use plydyn_model_support, only : bottom_face, support_type, initial_velocity_type, &
      & motion_type, one_plane, prescribes_displacement, share_points, top_face
   use plydyn_model_model, only : model_type
   implicit none
   private

   public :: read_boundary_spc_set, read_boundary_face, read_boundary_motion, &
      & read_initial_velocity, read_initial_velocity_node

   !> Fields of directions, of rotations and of a velocity
   character(4), parameter :: direction_names(3) = ["DOFX", "DOFY", "DOFZ"]
   character(5), parameter :: rotation_names(3) = ["DOFRX", "DOFRY", "DOFRZ"]
   character(2), parameter :: velocity_names(3) = ["VX", "VY", "VZ"]

contains

   !> *BOUNDARY_SPC_SET: nodes held over the whole thickness
   subroutine read_boundary_spc_set(cards, catalogue, model)
      type(cards_type), intent(in) :: cards
      type(catalogue_type), intent(inout) :: catalogue
      type(model_type), intent(inout) :: model

      type(support_type) :: support
      integer :: i, nth

      do nth = 1, cards%sets()
         call read_support(cards, nth, catalogue, support)
         support%name = "spc "//text(cards%integer("NSID", nth))
         do i = 1, size(rotation_names)
            if (cards%integer(rotation_names(i), nth) == 0 .or. all(support%direction)) cycle
            call catalogue%refuse(cards, rotation_names(i), &
               & "the points of the plate have no rotations to hold", &
               & "0, or DOFX = DOFY = DOFZ = 1 to clamp the nodes", nth)
         end do
         model%supports = [model%supports, support]
      end do
   end subroutine read_boundary_spc_set

   !> *BOUNDARY_FACE: one face or plane held
   subroutine read_boundary_face(cards, catalogue, model)
      type(cards_type), intent(in) :: cards
      type(catalogue_type), intent(inout) :: catalogue
      type(model_type), intent(inout) :: model

      type(support_type) :: support
      integer :: nth

      do nth = 1, cards%sets()
         call read_support(cards, nth, catalogue, support)
         support%face = cards%integer("FACE", nth)
         support%height = cards%real("Z", nth)
         if (support%face /= one_plane .and. abs(support%height) > 0.0_wp) then
            call catalogue%refuse(cards, "Z", "Z is given for a face", &
               & "0; a height is for FACE 0 only", nth)
         end if
         call find_plane(cards, nth, catalogue, model%parts, support)
         support%name = "face "//text(cards%integer("NSID", nth))&
            & //face_words(support%face, support%height)
         model%supports = [model%supports, support]
      end do
   end subroutine read_boundary_face

   !> A plane meets thickness nodes; one at a face of the laminate is that face
   subroutine find_plane(cards, nth, catalogue, parts, support)
      type(cards_type), intent(in) :: cards
      !> Which set of cards
      integer, intent(in) :: nth
      type(catalogue_type), intent(inout) :: catalogue
      !> All laminates: their points are at the same heights
      type(part_type), intent(in) :: parts(:)
      !> The support
      type(support_type), intent(inout) :: support

      type(layers_type) :: layers

      ! parts may not be whole where something was refused
      if (support%face /= one_plane .or. size(parts) == 0 .or. catalogue%report%has_errors()) return
      layers = new_layers(parts(1))
      associate (nearest => layers%nearest_node(support%height))
         if (.not. layers%coincide(nearest, support%height)) then
            call catalogue%refuse(cards, "Z", "no thickness node lies at this height", &
               & "the height of one, such as "//text(nearest), nth)
         else if (layers%coincide(nearest, layers%bottom(1))) then
            support%face = bottom_face
         else if (layers%coincide(nearest, layers%top(size(layers%top)))) then
            support%face = top_face
         end if
      end associate
   end subroutine find_plane

   !> *BOUNDARY_PRESCRIBED_MOTION_SET, *BOUNDARY_FACE_MOTION: nodes moved over the whole thickness,
   !> or on one face
   subroutine read_boundary_motion(cards, catalogue, model)
      type(cards_type), intent(in) :: cards
      type(catalogue_type), intent(inout) :: catalogue
      type(model_type), intent(inout) :: model

      type(motion_type) :: motion
      integer :: nth

      do nth = 1, cards%sets()
         call read_motion(cards, nth, catalogue, motion)
         if (cards%name == "BOUNDARY_FACE_MOTION") then
            call find_curve(cards, nth, catalogue, model%curves, motion%curve)
            motion%face = cards%integer("FACE", nth)
            motion%name = "face motion "//text(cards%integer("NSID", nth)) &
               & //face_words(motion%face, 0.0_wp)
         else
            call catalogue%find(a_curve, cards, "LCID", motion%curve, nth)
            motion%name = "motion "//text(cards%integer("NSID", nth))
            call read_duration(cards, nth, catalogue, motion)
         end if
         call check_jump(cards, nth, catalogue, model%curves, motion)
         call check_free(cards, nth, catalogue, model%supports, model%motions, motion)
         model%motions = [model%motions, motion]
      end do
   end subroutine read_boundary_motion

   !> When a motion begins and ends
   subroutine read_duration(cards, nth, catalogue, motion)
      type(cards_type), intent(in) :: cards
      !> Which set of cards
      integer, intent(in) :: nth
      type(catalogue_type), intent(inout) :: catalogue
      type(motion_type), intent(inout) :: motion

      motion%birth = cards%real("BIRTH", nth)
      if (cards%real("DEATH", nth) > 0.0_wp) motion%death = cards%real("DEATH", nth)
      if (motion%death <= motion%birth) then
         call catalogue%refuse(cards, "DEATH", "the motion ends before it begins", &
            & "a time behind BIRTH, or 0 for ever", nth)
      end if
   end subroutine read_duration

   !> *INITIAL_VELOCITY: velocity of a set
   subroutine read_initial_velocity(cards, catalogue, model)
      type(cards_type), intent(in) :: cards
      type(catalogue_type), intent(inout) :: catalogue
      type(model_type), intent(inout) :: model

      type(initial_velocity_type) :: velocity
      integer :: i

      if (cards%integer("NSID") == 0) then
         velocity%nodes = [(i, i=1, size(model%mesh%node_id))]
      else
         call catalogue%find_set(a_node_set, cards, "NSID", velocity%nodes)
      end if
      velocity%velocity(:) = cards%reals(velocity_names)
      model%initial_velocities = [model%initial_velocities, velocity]
   end subroutine read_initial_velocity

   !> *INITIAL_VELOCITY_NODE: velocities of nodes
   subroutine read_initial_velocity_node(cards, catalogue, model)
      type(cards_type), intent(in) :: cards
      type(catalogue_type), intent(inout) :: catalogue
      type(model_type), intent(inout) :: model

      type(initial_velocity_type) :: new(cards%sets())
      integer :: nth

      do nth = 1, cards%sets()
         allocate (new(nth)%nodes(1))
         call catalogue%find(a_node, cards, "NID", new(nth)%nodes(1), nth)
         new(nth)%velocity(:) = cards%reals(velocity_names, nth)
      end do
      model%initial_velocities = [model%initial_velocities, new]
   end subroutine read_initial_velocity_node

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

   !> Nodes and directions of a support
   subroutine read_support(cards, nth, catalogue, support)
      type(cards_type), intent(in) :: cards
      !> Which set of cards
      integer, intent(in) :: nth
      type(catalogue_type), intent(inout) :: catalogue
      !> The support
      type(support_type), intent(out) :: support

      call catalogue%find_set(a_node_set, cards, "NSID", support%nodes, nth)
      support%direction(:) = cards%integers(direction_names, nth) == 1
      if (any(support%direction) .or. .not. cards%is_fine("DOFX", nth)) return
      call catalogue%refuse(cards, "DOFX", "the support holds nothing", &
         & "1 for at least one of DOFX, DOFY, DOFZ", nth)
   end subroutine read_support

   !> Nodes, direction, quantity and factor of a motion
   subroutine read_motion(cards, nth, catalogue, motion)
      type(cards_type), intent(in) :: cards
      !> Which set of cards
      integer, intent(in) :: nth
      type(catalogue_type), intent(inout) :: catalogue
      type(motion_type), intent(out) :: motion

      call catalogue%find_set(a_node_set, cards, "NSID", motion%nodes, nth)
      motion%direction = cards%integer("DOF", nth)
      motion%quantity = cards%integer("VAD", nth)
      motion%scale = cards%real("SF", nth)
   end subroutine read_motion

   !> Warn of a displacement that is not 0 at the start, where that of the points is
   subroutine check_jump(cards, nth, catalogue, curves, motion)
      type(cards_type), intent(in) :: cards
      !> Which set of cards
      integer, intent(in) :: nth
      type(catalogue_type), intent(inout) :: catalogue
      type(curve_type), intent(in) :: curves(:)
      type(motion_type), intent(in) :: motion

      real(wp) :: jump

      if (motion%quantity /= prescribes_displacement .or. motion%birth > 0.0_wp) return
      ! the points of a restart are somewhere
      if (catalogue%report%has_errors() .or. catalogue%stored_lines > 0) return
      jump = motion%scale*curves(motion%curve)%at(0.0_wp)
      if (abs(jump) > 0.0_wp) call catalogue%warn(cards, "LCID", "the points jump by " &
         & //text(jump)//" in the first step", "a curve that is 0 at time 0", nth)
   end subroutine check_jump

   !> A point cannot be held and moved, or moved twice, in one direction
   subroutine check_free(cards, nth, catalogue, supports, motions, motion)
      type(cards_type), intent(in) :: cards
      !> Which set of cards
      integer, intent(in) :: nth
      type(catalogue_type), intent(inout) :: catalogue
      !> All supports
      type(support_type), intent(in) :: supports(:)
      !> The motions before this one
      type(motion_type), intent(in) :: motions(:)
      type(motion_type), intent(in) :: motion

      integer :: i, node

      if (motion%direction == 0) return
      node = 0
      do i = 1, size(supports)
         if (node > 0 .or. .not. supports(i)%direction(motion%direction)) cycle
         if (share_points(supports(i)%face, motion%face)) then
            node = common_node(supports(i)%nodes, motion%nodes)
         end if
      end do
      do i = 1, size(motions)
         if (node > 0 .or. motions(i)%direction /= motion%direction) cycle
         if (share_points(motions(i)%face, motion%face)) then
            node = common_node(motions(i)%nodes, motion%nodes)
         end if
      end do
      if (node == 0) return
      call catalogue%refuse(cards, "DOF", "node "//text(catalogue%registers(a_node)%id(node)) &
         & //" is held or moved in this direction already", "each point held or moved once", &
         & nth)
   end subroutine check_free

   !> A node that is in both of two sets; 0 when there is none
   pure integer function common_node(one, other) result(node)
      !> Indices of nodes
      integer, intent(in) :: one(:), other(:)

      logical, allocatable :: inside(:)
      integer :: i

      node = 0
      if (size(one) == 0 .or. size(other) == 0) return
      if (max(minval(one), minval(other)) > min(maxval(one), maxval(other))) return
      allocate (inside(max(maxval(one), maxval(other))))
      inside(:) = .false.
      inside(one) = .true.
      do i = 1, size(other)
         if (inside(other(i))) node = other(i)
         if (node > 0) return
      end do
   end function common_node

end module plydyn_input_read_support
