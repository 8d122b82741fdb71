!> Faces of the plate that impactors may touch.
module plydyn_domain_surfaces
   use plydyn_base_precision, only : wp
   use plydyn_domain_columns, only : columns_type
   use plydyn_domain_domain, only : surface_type
   use plydyn_domain_supports, only : face_point
   use plydyn_model_impactor, only : contact_type
   use plydyn_model_layers, only : layers_type
   use plydyn_model_mesh, only : mesh_type
   use plydyn_model_outer_faces, only : faces_of_part
   implicit none
   private

   public :: new_brick_surface, new_surface

contains

   !> The face of a contact
   pure function new_surface(contact, mesh, layers, columns, inverse_mass, held) result(self)
      !> As the deck says
      type(contact_type), intent(in) :: contact
      !> Nodes and quads
      type(mesh_type), intent(in) :: mesh
      !> Layers of the laminate
      type(layers_type), intent(in) :: layers
      !> Where the points lie
      type(columns_type), intent(in) :: columns
      !> Inverse mass of each point
      real(wp), intent(in) :: inverse_mass(:)
      !> Whether each place in the arrays of motion is held
      logical, intent(in) :: held(:)
      type(surface_type) :: self

      logical :: in_part(size(mesh%node_id))
      integer :: c, e, i, node, number(size(mesh%node_id)), point(2)

      in_part(:) = .false.
      do e = 1, size(mesh%quad_id)
         if (mesh%quad_part(e) == contact%part) in_part(mesh%quad_node(:, e)) = .true.
      end do
      point(:) = face_point(layers, contact%face)
      allocate (self%freedom(3, count(in_part)), self%position(3, count(in_part)))
      allocate (self%inverse_mass(3, count(in_part)))
      self%node = pack([(i, i=1, size(in_part))], in_part)
      number(:) = 0
      i = 0
      do node = 1, size(in_part)
         if (.not. in_part(node)) cycle
         i = i + 1
         number(node) = i
         self%position(:, i) = mesh%position(:, node)
         self%position(3, i) = self%position(3, i) + layers%height(point(1), point(2))
         do c = 1, 3
            self%freedom(c, i) = columns%freedom(point(1), point(2), c, node)
            self%inverse_mass(c, i) = inverse_mass(columns%mass_of(point(1), point(2), node))
            if (held(self%freedom(c, i))) self%inverse_mass(c, i) = 0.0_wp
         end do
      end do
      allocate (self%facet(size(mesh%quad_node, 1), count(mesh%quad_part == contact%part)))
      i = 0
      do e = 1, size(mesh%quad_id)
         if (mesh%quad_part(e) /= contact%part) cycle
         i = i + 1
         self%facet(:, i) = number(mesh%quad_node(:, e))
      end do
   end function new_surface

   !> The outer faces of bricks that a contact is on
   pure function new_brick_surface(contact, mesh, columns, inverse_mass, held) result(self)
      !> As the deck says
      type(contact_type), intent(in) :: contact
      !> Nodes and bricks
      type(mesh_type), intent(in) :: mesh
      !> Where the points lie
      type(columns_type), intent(in) :: columns
      !> Inverse mass of each point
      real(wp), intent(in) :: inverse_mass(:)
      !> Whether each place in the arrays of motion is held
      logical, intent(in) :: held(:)
      type(surface_type) :: self

      integer :: c, f, i, number(size(mesh%node_id))
      integer, allocatable :: faces(:, :), node(:)
      logical :: met(size(mesh%node_id))

      faces = faces_of_part(mesh, contact%part, contact%face)
      met(:) = .false.
      do f = 1, size(faces, 2)
         met(faces(:, f)) = .true.
      end do
      node = pack([(i, i=1, size(met))], met)
      self%node = node
      number(:) = 0
      number(node) = [(i, i=1, size(node))]
      self%position = mesh%position(:, node)
      allocate (self%freedom(3, size(node)), self%inverse_mass(3, size(node)))
      do c = 1, 3
         self%freedom(c, :) = columns%freedom(1, 1, c, node)
         self%inverse_mass(c, :) = merge(0.0_wp, inverse_mass(columns%mass_of(1, 1, node)), &
            & held(self%freedom(c, :)))
      end do
      allocate (self%facet(4, size(faces, 2)))
      do f = 1, size(faces, 2)
         self%facet(:, f) = number(faces(:, f))
      end do
   end function new_brick_surface

end module plydyn_domain_surfaces
