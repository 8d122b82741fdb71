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
      !> The user's quad numbers
      integer, allocatable :: quad_id(:)
      !> Part of each quad, an index into `model%parts`
      integer, allocatable :: quad_part(:)
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
   end type mesh_type

end module plydyn_model_mesh
