!> What acts on the points of the plate: supports, prescribed motions, linear constraints between
!> displacements, loads, and initial velocities.
module plydyn_model_support
   use plydyn_base_precision, only : wp
   implicit none
   private

   !> Thickness points that a support or load acts on
   integer, parameter, public :: bottom_face = -1, one_plane = 0, top_face = 1, all_planes = 2

   public :: holds_all, share_points

   !> What a prescribed motion prescribes, numbered as on the card
   integer, parameter, public :: prescribes_velocity = 0, prescribes_acceleration = 1, &
      & prescribes_displacement = 2

   !> Most characters of the name of a support or motion
   integer, parameter, public :: name_length = 60

   !> What a curve drives over time
   type, public :: amplitude_type
      !> Index into `model%curves`
      integer :: curve = 0
      !> Factor on the curve
      real(wp) :: scale = 1.0_wp
   end type amplitude_type

   !> Points that do not move in some directions
   type, public :: support_type
      !> Nodes, indices into `mesh%node_id`
      integer, allocatable :: nodes(:)
      !> Held in x, y, z
      logical :: direction(3) = .false.
      !> Which thickness points
      integer :: face = all_planes
      !> Height of the plane above the nodes, length; for `one_plane`
      real(wp) :: height = 0.0_wp
      !> Name among the forces of supports, from the keyword, its set and its face
      character(name_length) :: name = ""
      !> Line of the deck
      integer :: line = 0
   end type support_type

   !> Points that move as prescribed
   type, public, extends(amplitude_type) :: motion_type
      !> Nodes, indices into `mesh%node_id`
      integer, allocatable :: nodes(:)
      !> 1, 2, 3 for x, y, z
      integer :: direction = 0
      !> `prescribes_velocity`, `prescribes_acceleration` or `prescribes_displacement`
      integer :: quantity = prescribes_velocity
      !> Time at which it begins and ends to act
      real(wp) :: birth = 0.0_wp, death = huge(1.0_wp)
      !> Which thickness points
      integer :: face = all_planes
      !> As in `support_type`
      character(name_length) :: name = ""
      integer :: line = 0
   end type motion_type

   !> Velocity at time zero
   type, public :: initial_velocity_type
      !> Nodes, indices into `mesh%node_id`
      integer, allocatable :: nodes(:)
      !> Length per time
      real(wp) :: velocity(3) = 0.0_wp
      !> Line of the deck
      integer :: line = 0
   end type initial_velocity_type

   !> A displacement and its coefficient
   type, public :: constraint_term_type
      !> Index into `mesh%node_id`; 1, 2, 3 for x, y, z
      integer :: node = 0, direction = 0
      !> `bottom_face`, `top_face`, or `all_planes` for the mean over the thickness, by mass
      integer :: face = all_planes
      !> The coefficient
      real(wp) :: coefficient = 0.0_wp
   end type constraint_term_type

   !> The sum of displacements times coefficients is prescribed; zero without a curve
   type, public, extends(amplitude_type) :: constraint_type
      !> The user's number
      integer :: id = 0
      !> The sum
      type(constraint_term_type), allocatable :: terms(:)
      !> `prescribes_velocity` or `prescribes_displacement`
      integer :: quantity = prescribes_velocity
   end type constraint_type

   !> A force at each of some nodes, force per node
   type, public, extends(amplitude_type) :: point_load_type
      !> Nodes, indices into `mesh%node_id`
      integer, allocatable :: nodes(:)
      !> 1, 2, 3 for x, y, z, and where: a face, or shared by `all_planes` in proportion to mass
      integer :: direction = 0, face = all_planes
   end type point_load_type

   !> A force along the quad edges between some nodes, force per length
   type, public, extends(amplitude_type) :: line_load_type
      !> Nodes of the line, indices into `mesh%node_id`: every quad edge with all its nodes here
      integer, allocatable :: nodes(:)
      !> 1, 2, 3 for x, y, z; `bottom_face` or `top_face`
      integer :: direction = 0, face = top_face
   end type line_load_type

   !> A pressure that pushes onto a face of some quads, along the normal of the undeformed face
   type, public, extends(amplitude_type) :: pressure_type
      !> Indices into `mesh%quad_id`
      integer, allocatable :: quads(:)
      !> `bottom_face` (pushes up) or `top_face` (pushes down)
      integer :: face = top_face
   end type pressure_type

   !> A pressure on a face between four nodes, against its normal in the undeformed shape
   type, public, extends(amplitude_type) :: segment_load_type
      !> Nodes, indices into `mesh%node_id`, counter-clockwise seen from where the normal points
      integer :: node(4) = 0
   end type segment_load_type

   !> An acceleration of the frame, length per time squared: the body force is against it
   type, public, extends(amplitude_type) :: body_load_type
      !> 1, 2, 3 for x, y, z, and line of the deck
      integer :: direction = 0, line = 0
   end type body_load_type

contains

   !> Whether supports hold all of some points in a direction
   pure logical function holds_all(supports, nodes, direction, face)
      type(support_type), intent(in) :: supports(:)
      !> Nodes, 1, 2, 3 for x, y, z, and which thickness points
      integer, intent(in) :: nodes(:), direction, face

      logical, allocatable :: held(:)
      integer :: i

      holds_all = .false.
      if (size(nodes) == 0 .or. minval([nodes, 1]) < 1) return
      allocate (held(maxval(nodes)), source=.false.)
      do i = 1, size(supports)
         if (.not. supports(i)%direction(direction)) cycle
         if (.not. any(supports(i)%face == [all_planes, face])) cycle
         associate (own => supports(i)%nodes)
            held(pack(own, own <= size(held))) = .true.
         end associate
      end do
      holds_all = all(held(nodes))
   end function holds_all

   !> True when two choices of faces have points in common; planes are none of the faces
   elemental logical function share_points(one, other)
      !> Which thickness points
      integer, intent(in) :: one, other

      share_points = one == other .or. one == all_planes .or. other == all_planes
   end function share_points

end module plydyn_model_support
