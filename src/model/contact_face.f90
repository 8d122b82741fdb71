!> The face of the plate that an impactor meets, at time zero.
module plydyn_model_contact_face
   use plydyn_base_precision, only : wp
   use plydyn_model_impactor, only : contact_type
   use plydyn_model_model, only : model_type
   use plydyn_model_outer_faces, only : faces_of_parts
   use plydyn_model_support, only : top_face
   implicit none
   private

   public :: face_points, new_contact_face

   !> Facets of the face and their points
   type, public :: contact_face_type
      !> Nodes of each facet, counter-clockwise from above, (4 or 9, facets)
      integer, allocatable :: facet(:, :)
      !> Height of the face above its nodes, length
      real(wp) :: height = 0.0_wp
   end type contact_face_type

contains

   !> The face that a contact names
   pure type(contact_face_type) function new_contact_face(model, contact) result(self)
      !> A model with its parts and its mesh
      type(model_type), intent(in) :: model
      !> The contact
      type(contact_type), intent(in) :: contact

      self%facet = faces_of_parts(model%mesh, contact%parts, contact%face)
      ! a deck with errors may have none
      if (size(model%parts) == 0) return
      ! all parts have the same thickness, bricks have none of their own
      associate (part => model%parts(1))
         self%height = sum(part%plies%thickness) &
            & *(part%bottom_offset + merge(1.0_wp, 0.0_wp, contact%face == top_face))
      end associate
   end function new_contact_face

   !> Positions of the nodes of some facets, raised to the face, (3, nodes of all facets), length
   pure function face_points(model, face) result(points)
      !> The model
      type(model_type), intent(in) :: model
      !> The face
      type(contact_face_type), intent(in) :: face
      real(wp), allocatable :: points(:, :)

      points = model%mesh%position(:, reshape(face%facet, [size(face%facet)]))
      points(3, :) = points(3, :) + face%height
   end function face_points

end module plydyn_model_contact_face
