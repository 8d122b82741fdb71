!> The least ratio of volumes, det F, of elements, and where it is.
module plydyn_element_least_volume
   use plydyn_base_precision, only : wp
   implicit none
   private

   !> The least of some ratios; of equal ones that of the first element, there of the lowest layer
   type, public :: least_volume_type
      !> Volume over that at time zero
      real(wp) :: ratio = huge(1.0_wp)
      !> Index of the element in the mesh; its ply from the bottom, 0 for an element without
      integer :: element = huge(1), layer = huge(1)
      !> Index of its element group
      integer :: group = 0
   contains
      procedure :: take
   end type least_volume_type

contains

   !> Take one more ratio into account
   elemental subroutine take(self, ratio, element, layer)
      class(least_volume_type), intent(inout) :: self
      !> The ratio
      real(wp), intent(in) :: ratio
      !> As in the type
      integer, intent(in) :: element, layer

      if (ratio > self%ratio) return
      if (ratio >= self%ratio) then
         if (element > self%element) return
         if (element == self%element .and. layer >= self%layer) return
      end if
      self%ratio = ratio
      self%element = element
      self%layer = layer
   end subroutine take

end module plydyn_element_least_volume
