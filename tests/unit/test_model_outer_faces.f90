!> The outer faces of bricks are those of one brick only, and look up or down.
program test_model_outer_faces
   use plydyn_base_precision, only : wp
   use plydyn_model_mesh, only : mesh_type
   use plydyn_model_outer_faces, only : all_parts, faces_of_parts
   use plydyn_model_support, only : bottom_face, top_face
   use testing, only : begin, check, finish
   implicit none

   !> Bricks along x, y and z
   integer, parameter :: n(3) = [3, 2, 2]
   type(mesh_type) :: mesh

   call make_bricks()

   call begin("faces of all bricks")
   call check_faces(all_parts, top_face, 2.0_wp, "of the upper layer look up")
   call check_faces(all_parts, bottom_face, 0.0_wp, "of the lower layer look down")

   call begin("faces of a part")
   call check_faces([2], top_face, 2.0_wp, "above are those of the upper part")
   call check_faces([1], bottom_face, 0.0_wp, "below are those of the lower part")
   call check(size(faces_of_parts(mesh, [1], top_face)), 0, "are none below another")
   call check(size(faces_of_parts(mesh, [2], bottom_face)), 0, "are none above another")
   call finish()

contains

   !> A block of bricks with sides of one; the upper ones are another part
   subroutine make_bricks()
      integer :: e, i, j, k

      mesh%node_id = [(i, i=1, product(n + 1))]
      mesh%position = reshape([(((real([i, j, k], wp), i=0, n(1)), j=0, n(2)), k=0, n(3))], &
         & [3, product(n + 1)])
      allocate (mesh%quad_part(0), mesh%quad_node(4, 0))
      mesh%brick_id = [(i, i=1, product(n))]
      mesh%brick_part = [(merge(2, 1, i > n(1)*n(2)), i=1, product(n))]
      allocate (mesh%brick_node(8, product(n)))
      e = 0
      do k = 0, n(3) - 1
         do j = 0, n(2) - 1
            do i = 0, n(1) - 1
               e = e + 1
               mesh%brick_node(:4, e) = [at(i, j, k), at(i + 1, j, k), at(i + 1, j + 1, k), &
                  & at(i, j + 1, k)]
               mesh%brick_node(5:, e) = mesh%brick_node(:4, e) + (n(1) + 1)*(n(2) + 1)
            end do
         end do
      end do
   end subroutine make_bricks

   !> Node at a place
   pure integer function at(i, j, k)
      integer, intent(in) :: i, j, k

      at = 1 + i + (n(1) + 1)*(j + (n(2) + 1)*k)
   end function at

   !> Faces are at some heights, one over each square, counter-clockwise seen from above
   subroutine check_faces(parts, side, height, what)
      integer, intent(in) :: parts(:), side
      !> Of the faces
      real(wp), intent(in) :: height
      character(*), intent(in) :: what

      integer, allocatable :: faces(:, :)
      logical :: is_covered(n(1), n(2))
      real(wp) :: a(2), b(2)
      integer :: f

      faces = faces_of_parts(mesh, parts, side)
      call check(size(faces, 2), n(1)*n(2), what//": how many")
      is_covered(:, :) = .false.
      do f = 1, size(faces, 2)
         associate (x => mesh%position(:, faces(:, f)))
            call check(x(3, :), spread(height, 1, 4), 0.0_wp, what//": their height")
            is_covered(nint(maxval(x(1, :))), nint(maxval(x(2, :)))) = .true.
            a(:) = x(:2, 3) - x(:2, 1)
            b(:) = x(:2, 4) - x(:2, 2)
            call check(0.5_wp*(a(1)*b(2) - a(2)*b(1)), 1.0_wp, 0.0_wp, what//": their area")
         end associate
      end do
      call check(all(is_covered), what//": each once")
   end subroutine check_faces

end program test_model_outer_faces
