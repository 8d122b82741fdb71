!> Layer-wise plates: the one way from the layers of a part to the kernel of their side and order.
module plydyn_element_plate_kernels
   use plydyn_base_precision, only : wp
   use plydyn_element_least_volume, only : least_volume_type
   use plydyn_element_plate_layers, only : plate_type
   use plydyn_element_plate_q4_le1, only : large_q4_le1 => add_large_forces, &
      & law_q4_le1 => add_law_forces, linear_q4_le1 => add_linear_forces, &
      & volume_q4_le1 => find_least_volume
   use plydyn_element_plate_q4_le2, only : large_q4_le2 => add_large_forces, &
      & law_q4_le2 => add_law_forces, linear_q4_le2 => add_linear_forces, &
      & volume_q4_le2 => find_least_volume
   use plydyn_element_plate_q4_le3, only : large_q4_le3 => add_large_forces, &
      & law_q4_le3 => add_law_forces, linear_q4_le3 => add_linear_forces, &
      & volume_q4_le3 => find_least_volume
   use plydyn_element_plate_q4_le4, only : large_q4_le4 => add_large_forces, &
      & law_q4_le4 => add_law_forces, linear_q4_le4 => add_linear_forces, &
      & volume_q4_le4 => find_least_volume
   use plydyn_element_plate_q9_le1, only : large_q9_le1 => add_large_forces, &
      & law_q9_le1 => add_law_forces, linear_q9_le1 => add_linear_forces, &
      & volume_q9_le1 => find_least_volume
   use plydyn_element_plate_q9_le2, only : large_q9_le2 => add_large_forces, &
      & law_q9_le2 => add_law_forces, linear_q9_le2 => add_linear_forces, &
      & volume_q9_le2 => find_least_volume
   use plydyn_element_plate_q9_le3, only : large_q9_le3 => add_large_forces, &
      & law_q9_le3 => add_law_forces, linear_q9_le3 => add_linear_forces, &
      & volume_q9_le3 => find_least_volume
   use plydyn_element_plate_q9_le4, only : large_q9_le4 => add_large_forces, &
      & law_q9_le4 => add_law_forces, linear_q9_le4 => add_linear_forces, &
      & volume_q9_le4 => find_least_volume
   implicit none
   private

   public :: add_layer_forces, find_least_volume, linear_forces

contains

   !> Subtract the internal forces of some quads of a batch of layers
   pure subroutine add_layer_forces(plate, number, quads, large, step, displacement, history, force)
      !> The part
      type(plate_type), intent(in) :: plate
      !> Batch of the part
      integer, intent(in) :: number
      !> First and last quad
      integer, intent(in) :: quads(2)
      !> Large displacement (total Lagrangian) instead of linear strain
      logical, intent(in) :: large
      !> Time step
      real(wp), intent(in) :: step
      !> Displacement of all points
      real(wp), intent(in), contiguous :: displacement(:)
      !> History of all Gauss points; those of a batch are
      !> (lanes, levels, points of the plane, blocks, quads, histories)
      real(wp), intent(inout), contiguous :: history(:)
      !> Force on all points
      real(wp), intent(inout), contiguous :: force(:)

      associate (batch => plate%batches(number), u => displacement(plate%batches(number)%first:), &
         & f => force(plate%batches(number)%first:))
         if (size(batch%laws) > 0) then
            call law_forces(plate, number, quads, large, step, u, history(batch%first_history:), f)
         else if (large) then
            call large_forces(plate, number, quads, u, f)
         else
            call linear_forces(plate, number, quads, u, f)
         end if
      end associate
   end subroutine add_layer_forces

   !> To the kernel of linear strain for this side and order
   pure subroutine linear_forces(plate, number, quads, u, f)
      !> The part
      type(plate_type), intent(in) :: plate
      !> Batch of the part; first and last quad
      integer, intent(in) :: number, quads(2)
      !> Displacement of the points of the batch
      real(wp), intent(in) :: u(*)
      !> Force on them
      real(wp), intent(inout) :: f(*)

      select case (10*plate%side + plate%batches(number)%expansion%order)
      case (21); call linear_q4_le1(plate, number, quads, u, f)
      case (22); call linear_q4_le2(plate, number, quads, u, f)
      case (23); call linear_q4_le3(plate, number, quads, u, f)
      case (24); call linear_q4_le4(plate, number, quads, u, f)
      case (31); call linear_q9_le1(plate, number, quads, u, f)
      case (32); call linear_q9_le2(plate, number, quads, u, f)
      case (33); call linear_q9_le3(plate, number, quads, u, f)
      case default; call linear_q9_le4(plate, number, quads, u, f)
      end select
   end subroutine linear_forces

   !> To the kernel of large displacement for this side and order
   pure subroutine large_forces(plate, number, quads, u, f)
      type(plate_type), intent(in) :: plate
      integer, intent(in) :: number, quads(2)
      real(wp), intent(in) :: u(*)
      real(wp), intent(inout) :: f(*)

      select case (10*plate%side + plate%batches(number)%expansion%order)
      case (21); call large_q4_le1(plate, number, quads, u, f)
      case (22); call large_q4_le2(plate, number, quads, u, f)
      case (23); call large_q4_le3(plate, number, quads, u, f)
      case (24); call large_q4_le4(plate, number, quads, u, f)
      case (31); call large_q9_le1(plate, number, quads, u, f)
      case (32); call large_q9_le2(plate, number, quads, u, f)
      case (33); call large_q9_le3(plate, number, quads, u, f)
      case default; call large_q9_le4(plate, number, quads, u, f)
      end select
   end subroutine large_forces

   !> To the kernel of material laws for this side and order
   pure subroutine law_forces(plate, number, quads, large, step, u, history, f)
      type(plate_type), intent(in) :: plate
      integer, intent(in) :: number, quads(2)
      logical, intent(in) :: large
      real(wp), intent(in) :: step, u(*)
      !> History of the batch
      real(wp), intent(inout) :: history(*)
      real(wp), intent(inout) :: f(*)

      select case (10*plate%side + plate%batches(number)%expansion%order)
      case (21); call law_q4_le1(plate, number, quads, large, step, u, history, f)
      case (22); call law_q4_le2(plate, number, quads, large, step, u, history, f)
      case (23); call law_q4_le3(plate, number, quads, large, step, u, history, f)
      case (24); call law_q4_le4(plate, number, quads, large, step, u, history, f)
      case (31); call law_q9_le1(plate, number, quads, large, step, u, history, f)
      case (32); call law_q9_le2(plate, number, quads, large, step, u, history, f)
      case (33); call law_q9_le3(plate, number, quads, large, step, u, history, f)
      case default; call law_q9_le4(plate, number, quads, large, step, u, history, f)
      end select
   end subroutine law_forces

   !> Find the least ratio of volumes of the layers over all quads
   pure subroutine find_least_volume(plate, displacement, least)
      !> The part
      type(plate_type), intent(in) :: plate
      !> Displacement of all points
      real(wp), intent(in), contiguous :: displacement(:)
      !> Least ratio of volumes so far
      type(least_volume_type), intent(inout) :: least
      integer :: b

      do b = 1, size(plate%batches)
         call volume_of_batch(plate, b, [1, size(plate%node, 2)], &
            & displacement(plate%batches(b)%first:), least)
      end do
   end subroutine find_least_volume

   !> To the kernel of ratios of volumes for this side and order
   pure subroutine volume_of_batch(plate, number, quads, u, least)
      type(plate_type), intent(in) :: plate
      integer, intent(in) :: number, quads(2)
      real(wp), intent(in) :: u(*)
      type(least_volume_type), intent(inout) :: least

      select case (10*plate%side + plate%batches(number)%expansion%order)
      case (21); call volume_q4_le1(plate, number, quads, u, least)
      case (22); call volume_q4_le2(plate, number, quads, u, least)
      case (23); call volume_q4_le3(plate, number, quads, u, least)
      case (24); call volume_q4_le4(plate, number, quads, u, least)
      case (31); call volume_q9_le1(plate, number, quads, u, least)
      case (32); call volume_q9_le2(plate, number, quads, u, least)
      case (33); call volume_q9_le3(plate, number, quads, u, least)
      case default; call volume_q9_le4(plate, number, quads, u, least)
      end select
   end subroutine volume_of_batch

end module plydyn_element_plate_kernels
