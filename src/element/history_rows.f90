!> Where the histories of the Gauss points of layers lie, in rows of lanes.
!>
!> The points of a line of a quad and those above it lie side by side, one variable after the other:
!> (lanes, levels*side, histories, side, blocks, quads). A law takes a line at a time, and what it
!> looks at in every step is one piece of memory, however much else a point remembers.
module plydyn_element_history_rows
   implicit none
   private

   public :: history_row

contains

   !> Rows before a variable of a Gauss point
   pure integer function history_row(side, levels, histories, cell, q, m, variable) result(row)
      !> Points along a side of the quad, points of the thickness, variables of a point
      integer, intent(in) :: side, levels, histories
      !> Blocks of layers before the one of the point, those of the quads before among them
      integer, intent(in) :: cell
      !> Point of the plane, point of the thickness, variable
      integer, intent(in) :: q, m, variable

      integer :: line

      line = side*cell + (q - 1)/side
      row = levels*side*(histories*line + variable - 1) + levels*mod(q - 1, side) + m - 1
   end function history_row

end module plydyn_element_history_rows
