!> Zones of a plate in which the matrix of every ply cracks along lines parallel to its fibres.
!>
!> A zone is a part whose quads are equal parallelograms. The fibres of each of its plies lie along
!> an edge or a diagonal of the quads, so that lines of nodes follow them. On every so many of these
!> lines the nodes of the ply are doubled; see `plydyn_model_crack_lines`.
module plydyn_model_crack_zone
   use plydyn_base_precision, only : wp
   implicit none
   private

   public :: corner_direction, line_corners, sees_twin

   !> Which diagonal divides the quads of a ply into wedges: that from the first corner, that from
   !> the second one, or either by turns along the second edge
   integer, parameter, public :: first_diagonal = 1, second_diagonal = 2, by_turns = 0

   !> One ply of a zone
   type, public :: cracking_ply_type
      !> Strengths: tension across the fibres, shear along them, shear through the thickness
      real(wp) :: strength(3) = 0.0_wp
      !> Traction per opening
      real(wp) :: stiffness = 0.0_wp
      !> Directions of the fibres and across them, towards the twins
      real(wp) :: along(2) = 0.0_wp, across(2) = 0.0_wp
      !> Distance between neighbouring lines of nodes, and how many of them to the next crack
      real(wp) :: pitch = 0.0_wp
      integer :: every = 1
      !> How the quads are divided
      integer :: diagonal = by_turns
   end type cracking_ply_type

   !> One zone
   type, public :: crack_zone_type
      !> Index into `model%parts`
      integer :: part = 0
      !> Distance between cracks that the deck asks for, length; see `every` of the plies
      real(wp) :: spacing = 0.0_wp
      !> Strengths as in `cracking_ply_type`, 0: those of the ply; traction per opening, 0: derived
      real(wp) :: strength(3) = 0.0_wp, stiffness = 0.0_wp
      !> Energy per area of crack, and coefficient of friction of closed ones
      real(wp) :: toughness = 0.0_wp, friction = 0.0_wp
      !> Largest opening of a crack that debris holds
      real(wp) :: debris = 0.0_wp
      !> Edges of its quads, (2, edges), and node from which lines are counted
      real(wp) :: edge(2, 2) = 0.0_wp, origin(2) = 0.0_wp
      !> Its plies from the bottom up
      type(cracking_ply_type), allocatable :: plies(:)
      !> Doubled nodes and their twins, indices into the mesh
      integer, allocatable :: node(:), twin(:)
      !> Length of crack at each of them in each ply, 0 where that is not doubled, (plies, nodes)
      real(wp), allocatable :: length(:, :)
      !> Whether the line of a ply goes on to one side alone there, (plies, nodes)
      logical, allocatable :: is_end(:, :)
      !> Place of each node of the mesh in these lists, 0 for none
      integer, allocatable :: place(:)
   end type crack_zone_type

contains

   !> Whether a ply, seen from a node into some direction, lies beyond the crack there
   pure logical function sees_twin(self, ply, node, direction)
      class(crack_zone_type), intent(in) :: self
      !> Ply from the bottom, node of the mesh
      integer, intent(in) :: ply, node
      !> Direction in the plane
      real(wp), intent(in) :: direction(2)

      sees_twin = .false.
      if (self%place(node) == 0) return
      if (self%length(ply, self%place(node)) <= 0.0_wp) return
      sees_twin = dot_product(direction, self%plies(ply)%across) > 0.0_wp
   end function sees_twin

   !> Direction in which the middle of half of a corner of a quad lies, seen from the node there;
   !> the diagonal through the corner parts the halves
   pure function corner_direction(edge, corner, half) result(direction)
      !> Edges of the quad
      real(wp), intent(in) :: edge(2, 2)
      !> Corner in tensor order, and which half: 1 beside the first edge, 2 beside the second
      integer, intent(in) :: corner, half
      real(wp) :: direction(2)

      real(wp) :: inward(2)

      inward(:) = [merge(1.0_wp, -1.0_wp, mod(corner, 2) == 1), merge(1.0_wp, -1.0_wp, corner <= 2)]
      inward(half) = 2.0_wp*inward(half)
      direction(:) = matmul(edge, inward)
   end function corner_direction

   !> Two corners of each quad between which a crack line of a ply may run, in the order of the deck
   pure function line_corners(self, ply) result(corners)
      class(crack_zone_type), intent(in) :: self
      !> Ply from the bottom
      integer, intent(in) :: ply
      integer :: corners(2)

      associate (lines => self%plies(ply))
         select case (lines%diagonal)
         case (first_diagonal)
            corners(:) = [1, 3]
         case (second_diagonal)
            corners(:) = [2, 4]
         case default
            corners(:) = [1, 2]
            if (abs(dot_product(self%edge(:, 2), lines%across)) &
               & < abs(dot_product(self%edge(:, 1), lines%across))) corners(:) = [1, 4]
         end select
      end associate
   end function line_corners

end module plydyn_model_crack_zone
