!> Forces on the plate.
module plydyn_model_load
   use plydyn_base_precision, only : wp
   use plydyn_model_support, only : all_planes, top_face
   implicit none
   private

   !> A force at each of some nodes
   type, public :: point_load_type
      !> Nodes, indices into `mesh%node_id`
      integer, allocatable :: nodes(:)
      !> 1, 2, 3 for x, y, z
      integer :: direction = 0
      !> Index into `model%curves`
      integer :: curve = 0
      !> Factor on the curve; force per node
      real(wp) :: scale = 1.0_wp
      !> Where: a face, or shared by `all_planes` in proportion to their mass
      integer :: face = all_planes
   end type point_load_type

   !> A force along the quad edges between some nodes
   type, public :: line_load_type
      !> Nodes of the line, indices into `mesh%node_id`: every quad edge with all its nodes here
      integer, allocatable :: nodes(:)
      !> 1, 2, 3 for x, y, z
      integer :: direction = 0
      !> Index into `model%curves`
      integer :: curve = 0
      !> Factor on the curve; force per length
      real(wp) :: scale = 1.0_wp
      !> `bottom_face` or `top_face`
      integer :: face = top_face
   end type line_load_type

   !> A pressure that pushes onto a face of some quads, along the normal of the undeformed face
   type, public :: pressure_type
      !> Indices into `mesh%quad_id`
      integer, allocatable :: quads(:)
      !> Index into `model%curves`
      integer :: curve = 0
      !> Factor on the curve; force per area
      real(wp) :: scale = 1.0_wp
      !> `bottom_face` (pushes up) or `top_face` (pushes down)
      integer :: face = top_face
   end type pressure_type

   !> A pressure on a face between four nodes, against its normal in the undeformed shape
   type, public :: segment_load_type
      !> Nodes, indices into `mesh%node_id`, counter-clockwise seen from where the normal points
      integer :: node(4) = 0
      !> Index into `model%curves`
      integer :: curve = 0
      !> Factor on the curve; force per area
      real(wp) :: scale = 1.0_wp
   end type segment_load_type

   !> An acceleration of the frame: the body force is against it
   type, public :: body_load_type
      !> 1, 2, 3 for x, y, z
      integer :: direction = 0
      !> Index into `model%curves`
      integer :: curve = 0
      !> Factor on the curve; length per time squared
      real(wp) :: scale = 1.0_wp
      !> Line of the deck
      integer :: line = 0
   end type body_load_type

end module plydyn_model_load
