!> Every point of every layer has a place of its own in the arrays of motion and of masses.
program test_fem_columns
   use plydyn_base_precision, only : lanes
   use plydyn_fem_columns, only : alignment_offset, columns_type, new_columns, new_solid_columns
   use testing, only : begin, check, finish
   implicit none

   integer, parameter :: nodes = 5
   integer :: k

   call begin("columns of a plate")
   call check_places(new_columns(nodes, [2, 1, 2, 3]))
   call begin("columns of more layers than lanes")
   call check_places(new_columns(nodes, [(1 + mod(k, 2), k=1, 5*lanes)]))
   call begin("columns of bricks")
   call check_places(new_solid_columns(2*lanes + 1))
   call finish()

contains

   !> Places are within the arrays, no two points have one, and all of them know their column
   subroutine check_places(columns)
      type(columns_type), intent(in) :: columns

      integer :: astray, direction, f, layer, level, node, place
      logical :: is_inside
      integer :: points(columns%freedoms), masses(columns%masses)

      points(:) = 0
      masses(:) = 0
      is_inside = .true.
      astray = 0
      do node = 1, columns%nodes
         do layer = 1, size(columns%layer_slot, 2)
            f = columns%layer_slot(1, layer)
            do level = 1, columns%order_groups(f)%order + 1
               place = columns%mass_of(layer, level, node)
               is_inside = is_inside .and. place > alignment_offset .and. place <= size(masses)
               if (is_inside) masses(place) = masses(place) + 1
               do direction = 1, 3
                  place = columns%freedom(layer, level, direction, node)
                  is_inside = is_inside .and. place > alignment_offset .and. place <= size(points)
                  if (.not. is_inside) cycle
                  points(place) = points(place) + 1
                  if (columns%column_of(place) == (node - 1)/columns%nodes_per_column + 1) cycle
                  astray = astray + 1
               end do
            end do
         end do
      end do
      call check(is_inside, "places lie behind the offset, within the arrays")
      call check(maxval(points), 1, "no two points have one place")
      call check(sum(points), 3*sum(masses), "three for each mass")
      call check(maxval(masses), 1, "no two points have one mass")
      call check(astray, 0, "places lie in the column of their node")
   end subroutine check_places

end program test_fem_columns
