!> Parts: stacks of plies, from the bottom up, and the damage between them at time zero.
module plydyn_model_layup
   use plydyn_base_precision, only : wp
   implicit none
   private

   !> How the faces of two plies meet, where no interface material lies between them
   integer, parameter, public :: faces_tied = 0, faces_apart = -1

   !> One ply
   type, public :: ply_type
      !> The user's number, its place in the stack if none was given; index into `model%materials`
      integer :: id = 0, material = 0
      !> Length; fibre direction, degrees from the x axis (the material's own axis included)
      real(wp) :: thickness = 0.0_wp, angle = 0.0_wp
      !> Order of the Lagrange expansion in each numerical layer, 1 to 4, and number of these layers
      integer :: order = 1, layers = 1
   end type ply_type

   !> How hourglass control holds bricks of one point, numbered as on the card
   integer, parameter, public :: hourglass_viscous = 3, hourglass_stiffness = 6

   !> Bricks: their points and their hourglass control
   type, public :: brick_section_type
      !> Points of a brick, 1 or 8; 0 in a laminate
      integer :: points = 0
      !> `hourglass_viscous` or `hourglass_stiffness`; for one point
      integer :: control = hourglass_stiffness
      !> Its coefficient
      real(wp) :: coefficient = 0.1_wp
   end type brick_section_type

   !> A laminate, or bricks of one material (one ply without thickness)
   type, public :: part_type
      !> The user's number
      integer :: id = 0
      !> Title, empty without one
      character(:), allocatable :: title
      !> Plies from the bottom up
      type(ply_type), allocatable :: plies(:)
      !> What joins ply k to ply k + 1: `faces_tied`, `faces_apart`, or an index into
      !> `model%interface_materials`; (plies - 1)
      integer, allocatable :: joint(:)
      !> Height of the bottom face above the plane of the nodes, in thicknesses of the laminate:
      !> -1/2 when the nodes lie in the mid-plane
      real(wp) :: bottom_offset = -0.5_wp
      !> Thickness nodes at Gauss-Lobatto points instead of equal spacing
      logical :: lobatto = .false.
      !> Bricks instead of a laminate
      type(brick_section_type) :: brick
   end type part_type

   !> Damage of some interfaces of a part at time zero
   type, public :: initial_damage_type
      !> Index into `model%parts`; first and last interface, counted from the bottom
      integer :: part = 0, interfaces(2) = 0
      !> Indices into `mesh%quad_id`
      integer, allocatable :: quads(:)
      !> From 0 to 1; 1 where the faces are apart
      real(wp) :: damage = 1.0_wp
      !> Only points within a circle of the plane: its centre and its radius
      real(wp) :: centre(2) = 0.0_wp, radius = huge(1.0_wp)
   contains
      procedure :: encloses
   end type initial_damage_type

contains

   !> Whether points of the plane lie in the circle
   pure function encloses(self, point)
      class(initial_damage_type), intent(in) :: self
      !> The points, (2, points)
      real(wp), intent(in) :: point(:, :)
      logical :: encloses(size(point, 2))

      integer :: i

      do i = 1, size(point, 2)
         encloses(i) = norm2(point(:, i) - self%centre) <= self%radius
      end do
   end function encloses

end module plydyn_model_layup
