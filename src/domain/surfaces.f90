!> Faces that impactors may touch: whole on every rank, since contact is not divided.
module plydyn_domain_surfaces
   use plydyn_base_precision, only : wp
   use plydyn_base_sort, only : sorted_order
   use plydyn_fem_columns, only : columns_type
   use plydyn_domain_domain, only : surface_type
   use plydyn_domain_local_to_global, only : local_to_global_type
   use plydyn_domain_supports, only : face_point
   use plydyn_model_layers, only : layers_type
   use plydyn_model_mesh, only : mesh_type
   use plydyn_model_outer_faces, only : faces_of_parts
   use plydyn_parallel_comm, only : comm_type
   implicit none
   private

   public :: collect_points, new_surface, place_points

contains

   !> The face of a contact, as the whole model numbers its nodes: quads on the outer layer of a
   !> laminate, or outer faces of bricks
   pure function new_surface(parts, face, mesh, layers) result(self)
      !> Indices of the parts, or `all_parts`
      integer, intent(in) :: parts(:)
      !> `bottom_face` or `top_face`
      integer, intent(in) :: face
      type(mesh_type), intent(in) :: mesh
      !> Layers of the laminate
      type(layers_type), intent(in) :: layers
      type(surface_type) :: self

      logical :: met(size(mesh%node_id))
      integer :: f, i, number(size(mesh%node_id)), point(2)
      integer, allocatable :: faces(:, :), node(:)

      faces = faces_of_parts(mesh, parts, face)
      met(:) = .false.
      do f = 1, size(faces, 2)
         met(faces(:, f)) = .true.
      end do
      node = pack([(i, i=1, size(met))], met)
      self%node = node
      number(:) = 0
      number(node) = [(i, i=1, size(node))]
      point(:) = face_point(layers, face)
      self%position = mesh%position(:, node)
      if (layers%order(point(1)) > 0) then
         self%position(3, :) = self%position(3, :) + layers%height(point(1), point(2))
      end if
      allocate (self%facet(size(faces, 1), size(faces, 2)))
      do f = 1, size(faces, 2)
         self%facet(:, f) = number(faces(:, f))
      end do
   end function new_surface

   !> Find the points of a face that a rank has in the arrays of motion
   pure subroutine place_points(point, numbering, owner, ranks, columns, self)
      !> Layer and thickness node of the face
      integer, intent(in) :: point(2)
      !> Numbers of the nodes that the rank has
      type(local_to_global_type), intent(in) :: numbering
      !> Rank that counts each column, and how many ranks there are
      integer, intent(in) :: owner(:), ranks
      !> Where the points lie
      type(columns_type), intent(in) :: columns
      !> The face with its nodes as the whole model numbers them, and then as the rank does
      type(surface_type), intent(inout) :: self

      integer :: c, i, r
      integer, allocatable :: of_point(:)

      of_point = owner(numbering%column_of(self%node))
      self%counts = [(count(of_point == r), r=0, ranks - 1)]
      self%of_ranks = sorted_order(of_point)
      self%node(:) = numbering%node(self%node)
      self%here = pack([(i, i=1, size(self%node))], self%node > 0)
      self%own = spread(.false., 1, size(self%node))
      self%own(self%here) = numbering%own(1 + (self%node(self%here) - 1)/columns%nodes_per_column)
      allocate (self%freedom(3, size(self%node)))
      self%freedom(:, :) = 0
      do c = 1, 3
         self%freedom(c, self%here) = columns%freedom(point(1), point(2), c, self%node(self%here))
      end do
   end subroutine place_points

   !> Give every rank a value of all points of a face
   subroutine collect_points(comm, self, values)
      !> The ranks
      type(comm_type), intent(in) :: comm
      !> The face
      type(surface_type), intent(in) :: self
      !> Known at the points that the rank has in, at all points out, (numbers, points)
      real(wp), intent(inout) :: values(:, :)

      real(wp), allocatable :: all(:), part(:)
      integer :: i
      integer, allocatable :: own(:)

      own = pack([(i, i=1, size(self%own))], self%own)
      part = reshape(values(:, own), [size(values, 1)*size(own)])
      allocate (all(size(values)))
      call comm%allgather(part, size(values, 1)*self%counts, all)
      values(:, self%of_ranks) = reshape(all, shape(values))
   end subroutine collect_points

end module plydyn_domain_surfaces
