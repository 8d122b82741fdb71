!> The kernels of layer-wise plates by side and order.
module plydyn_element_plate_kernels
   use plydyn_element_plate_layers, only : kernels_type
   use plydyn_element_plate_q4_le1, only : q4_le1 => kernels
   use plydyn_element_plate_q4_le2, only : q4_le2 => kernels
   use plydyn_element_plate_q4_le3, only : q4_le3 => kernels
   use plydyn_element_plate_q4_le4, only : q4_le4 => kernels
   use plydyn_element_plate_q9_le1, only : q9_le1 => kernels
   use plydyn_element_plate_q9_le2, only : q9_le2 => kernels
   use plydyn_element_plate_q9_le3, only : q9_le3 => kernels
   use plydyn_element_plate_q9_le4, only : q9_le4 => kernels
   implicit none
   private

   public :: new_kernels

contains

   !> The kernels of a side and an order
   pure type(kernels_type) function new_kernels(side, order) result(kernels)
      !> Nodes along a side of a quad, and order of the layers
      integer, intent(in) :: side, order

      select case (10*side + order)
      case (21); kernels = q4_le1()
      case (22); kernels = q4_le2()
      case (23); kernels = q4_le3()
      case (24); kernels = q4_le4()
      case (31); kernels = q9_le1()
      case (32); kernels = q9_le2()
      case (33); kernels = q9_le3()
      case default; kernels = q9_le4()
      end select
   end function new_kernels

end module plydyn_element_plate_kernels
