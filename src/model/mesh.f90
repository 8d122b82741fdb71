!> Nodes of the reference plane and the quads between them.
module plydyn_model_mesh
   use plydyn_base_precision, only : wp
   implicit none
   private

   !> A plane mesh, all quads with the same number of nodes
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
   end type mesh_type

end module plydyn_model_mesh
