!> Faces of parts that something may touch: its quads, or faces of bricks that no other brick has.
module plydyn_model_outer_faces
   use plydyn_base_matrix, only : cross
   use plydyn_base_precision, only : wp
   use plydyn_base_sort, only : sorted_order
   use plydyn_model_mesh, only : mesh_type
   use plydyn_model_support, only : top_face
   implicit none
   private

   public :: faces_of_parts

   !> Stands for all parts
   integer, parameter, public :: all_parts(0) = [integer ::]

   !> Corners of the faces of a brick, counter-clockwise seen from outside
   integer, parameter :: face_corner(4, 6) = reshape([1, 4, 3, 2, 5, 6, 7, 8, 1, 2, 6, 5, 2, 3, 7, &
      & 6, 3, 4, 8, 7, 4, 1, 5, 8], [4, 6])
   !> Least share of the normal along z of a face that looks up or down
   real(wp), parameter :: least_slope = 0.5_wp

contains

   !> Quads of parts, in the order of the deck, or their outer faces that look up or down,
   !> counter-clockwise seen from above, (nodes, faces)
   pure function faces_of_parts(mesh, parts, side) result(faces)
      type(mesh_type), intent(in) :: mesh
      !> Indices of the parts, or `all_parts`; `bottom_face` or `top_face`
      integer, intent(in) :: parts(:), side
      integer, allocatable :: faces(:, :)

      integer :: e
      logical :: is_chosen(size(mesh%quad_part))

      is_chosen(:) = [(is_of(mesh%quad_part(e), parts), e=1, size(is_chosen))]
      if (any(is_chosen)) then
         associate (chosen => pack([(e, e=1, size(is_chosen))], is_chosen))
            if (allocated(mesh%face_node)) then
               faces = mesh%face_node(:, chosen, merge(2, 1, side == top_face))
            else
               faces = mesh%quad_node(:, chosen)
            end if
         end associate
      else
         faces = brick_faces(mesh, parts, side)
      end if
   end function faces_of_parts

   !> Whether an element of a part is chosen
   pure logical function is_of(part, chosen)
      !> Part of the element, and the chosen ones, or `all_parts`
      integer, intent(in) :: part, chosen(:)

      is_of = any(part == chosen) .or. size(chosen) == 0
   end function is_of

   !> Outer faces of parts of bricks that look up or down
   pure function brick_faces(mesh, parts, side) result(faces)
      type(mesh_type), intent(in) :: mesh
      integer, intent(in) :: parts(:), side
      integer, allocatable :: faces(:, :)

      integer :: corner(4, 6*size(mesh%brick_id)), kept
      logical :: outer(6*size(mesh%brick_id))
      integer :: e, f, k

      call find_outer(mesh, outer)
      kept = 0
      do e = 1, size(mesh%brick_id)
         if (.not. is_of(mesh%brick_part(e), parts)) cycle
         do f = 1, 6
            k = f + 6*(e - 1)
            if (.not. outer(k)) cycle
            associate (node => mesh%brick_node(face_corner(:, f), e))
               if (real(side, wp)*slope(mesh%position(:, node)) < least_slope) cycle
               kept = kept + 1
               corner(:, kept) = merge(node, node(4:1:-1), side == top_face)
            end associate
         end do
      end do
      faces = corner(:, :kept)
   end function brick_faces

   !> Which faces of all bricks belong to one brick only, face by face
   pure subroutine find_outer(mesh, outer)
      type(mesh_type), intent(in) :: mesh
      logical, intent(out) :: outer(:)

      integer :: first(size(mesh%node_id)), next(size(outer)), sorted(4, size(outer))
      integer :: e, f, k, other

      ! faces in a chain by their lowest node
      first(:) = 0
      outer(:) = .true.
      do e = 1, size(mesh%brick_id)
         do f = 1, 6
            k = f + 6*(e - 1)
            associate (node => mesh%brick_node(face_corner(:, f), e))
               sorted(:, k) = node(sorted_order(node))
            end associate
            other = first(sorted(1, k))
            do while (other > 0)
               if (all(sorted(:, other) == sorted(:, k))) then
                  outer([k, other]) = .false.
                  exit
               end if
               other = next(other)
            end do
            next(k) = first(sorted(1, k))
            first(sorted(1, k)) = k
         end do
      end do
   end subroutine find_outer

   !> Share of the normal of a face along z
   pure real(wp) function slope(x)
      !> Corners, (3, 4)
      real(wp), intent(in) :: x(:, :)

      real(wp) :: normal(3)

      normal(:) = cross(x(:, 3) - x(:, 1), x(:, 4) - x(:, 2))
      slope = normal(3)/norm2(normal)
   end function slope

end module plydyn_model_outer_faces
