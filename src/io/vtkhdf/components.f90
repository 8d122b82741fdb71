!> Components of the fields on points.
module plydyn_io_vtkhdf_components
   use plydyn_base_precision, only : wp
   use plydyn_law_law, only : scalar_names
   implicit none
   private

   public :: field_components, tensor

   !> Numbers of a symmetric tensor
   integer, parameter, public :: tensor_components = 6

   !> Order of VTK's symmetric tensors, xx yy zz xy yz xz, in that of the recovered values
   integer, parameter :: vtk_order(6) = [1, 2, 3, 4, 6, 5]
   !> From engineering shear to tensor shear
   real(wp), parameter, public :: tensor_share(6) = [1.0_wp, 1.0_wp, 1.0_wp, 0.5_wp, 0.5_wp, 0.5_wp]

contains

   !> Numbers that a field has at a point
   elemental integer function field_components(name) result(components)
      !> Name of the field
      character(*), intent(in) :: name

      select case (name)
      case ("displacement", "velocity"); components = 3
      case default; components = merge(1, tensor_components, any(scalar_names == name))
      end select
   end function field_components

   !> Six of the recovered values in VTK's order
   pure function tensor(values, before, share) result(six)
      !> Values at the points, (recovered, points)
      real(wp), intent(in) :: values(:, :)
      !> Where the six begin, less one
      integer, intent(in) :: before
      !> Factors of the six, in our order
      real(wp), intent(in), optional :: share(6)
      real(wp) :: six(6, size(values, 2))
      integer :: i

      do i = 1, 6
         six(i, :) = values(before + vtk_order(i), :)
         if (present(share)) six(i, :) = share(vtk_order(i))*six(i, :)
      end do
   end function tensor

end module plydyn_io_vtkhdf_components
