!> Nodes of the reference plane and the quads between them, or nodes of bricks in space.
module plydyn_model_mesh
   use plydyn_base_precision, only : wp
   implicit none
   private

   !> A plane mesh, all quads with the same number of nodes, or a mesh of bricks
   type, public :: mesh_type
      !> The user's node numbers
      integer, allocatable :: node_id(:)
      !> Position of each node, (3, nodes), length
      real(wp), allocatable :: position(:, :)
      !> The user's quad numbers, and part of each quad, an index into `model%parts`
      integer, allocatable :: quad_id(:), quad_part(:)
      !> Nodes of each quad, (4 or 9, quads), indices into `node_id`: corners, mid-sides, centre,
      !> counter-clockwise from above
      integer, allocatable :: quad_node(:, :)
      !> The user's brick numbers, and the part of each brick
      integer, allocatable :: brick_id(:), brick_part(:)
      !> Nodes of each brick, (8, bricks): one face, counter-clockwise seen from the opposite one,
      !> then that one
      integer, allocatable :: brick_node(:, :)
      !> Direction of the fibres of each brick, degrees from the x axis
      real(wp), allocatable :: brick_angle(:)
      !> Twin of each node that a crack may part, else 0; not allocated without cracks
      integer, allocatable :: twin(:)
      !> Nodes of each quad as its bottom and its top face have them, (4, quads, 2); likewise
      integer, allocatable :: face_node(:, :, :)
   contains
      procedure :: element_id
      procedure :: list_elements
      procedure :: twins_of
   end type mesh_type

   !> Kinds of elements of a mesh
   character(*), parameter, public :: a_quad = "quad", a_brick = "brick"

contains

   !> The user's number of an element; its index if the mesh has no elements of this kind
   pure integer function element_id(self, kind, element) result(id)
      class(mesh_type), intent(in) :: self
      !> Kind of element
      character(*), intent(in) :: kind
      !> Its index
      integer, intent(in) :: element

      select case (kind)
      case (a_quad)
         id = self%quad_id(element)
      case (a_brick)
         id = self%brick_id(element)
      case default
         id = element
      end select
   end function element_id

   !> Twins of those of some nodes that have one
   pure function twins_of(self, nodes) result(twins)
      class(mesh_type), intent(in) :: self
      !> Indices into `node_id`
      integer, intent(in) :: nodes(:)
      integer, allocatable :: twins(:)

      allocate (twins(0))
      if (.not. allocated(self%twin)) return
      twins = self%twin(nodes)
      twins = pack(twins, twins > 0)
   end function twins_of

   !> All elements of one kind: their parts, and their nodes in the order of the deck
   pure subroutine list_elements(self, kind, part, node)
      class(mesh_type), intent(in) :: self
      !> Kind of element
      character(*), intent(in) :: kind
      !> Part of each element, and its nodes, (nodes of an element, elements)
      integer, allocatable, intent(out) :: part(:), node(:, :)

      select case (kind)
      case (a_quad)
         part = self%quad_part
         node = self%quad_node
      case (a_brick)
         part = self%brick_part
         node = self%brick_node
      case default
         allocate (part(0), node(0, 0))
      end select
   end subroutine list_elements

end module plydyn_model_mesh
