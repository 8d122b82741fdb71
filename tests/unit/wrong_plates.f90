!> Plates and interfaces with kernels that are wrong on purpose.
module wrong_plates
   use plydyn_base_precision, only : wp
   use plydyn_domain_domain, only : domain_type
   use plydyn_element_group, only : element_group_type
   use plydyn_element_interface_group, only : interface_group_type
   use plydyn_element_plate_group, only : plate_group_type
   implicit none
   private

   public :: spoil

   !> Plates whose forces are those of other displacements
   type, extends(plate_group_type) :: wrong_plate_group_type
      !> By how much, as a share
      real(wp) :: stiffer = 0.0_wp
   contains
      procedure :: add_forces => add_wrong_plate_forces
   end type wrong_plate_group_type

   !> The same of interfaces
   type, extends(interface_group_type) :: wrong_interface_group_type
      real(wp) :: stiffer = 0.0_wp
   contains
      procedure :: add_forces => add_wrong_interface_forces
   end type wrong_interface_group_type

contains

   !> Let all plates of a domain, or all its interfaces, be too stiff by a share
   subroutine spoil(domain, interfaces, stiffer)
      !> The domain
      type(domain_type), intent(inout) :: domain
      !> Interfaces in place of plates
      logical, intent(in) :: interfaces
      !> The share
      real(wp), intent(in) :: stiffer

      class(element_group_type), allocatable :: wrong
      integer :: g

      do g = 1, size(domain%groups)
         select type (group => domain%groups(g)%item)
         type is (plate_group_type)
            if (interfaces) cycle
            wrong = wrong_plate_group_type(plate_group_type=group, stiffer=stiffer)
         type is (interface_group_type)
            if (.not. interfaces) cycle
            wrong = wrong_interface_group_type(interface_group_type=group, stiffer=stiffer)
         class default
            cycle
         end select
         call move_alloc(wrong, domain%groups(g)%item)
      end do
   end subroutine spoil

   pure subroutine add_wrong_plate_forces(self, elements, step, displacement, velocity, history, &
      & force)
      class(wrong_plate_group_type), intent(in) :: self
      integer, intent(in) :: elements(2)
      real(wp), intent(in) :: step
      real(wp), intent(in), contiguous :: displacement(:), velocity(:)
      real(wp), intent(inout), contiguous :: history(:), force(:)

      call self%plate_group_type%add_forces(elements, step, (1.0_wp + self%stiffer)*displacement, &
         & velocity, history, force)
   end subroutine add_wrong_plate_forces

   pure subroutine add_wrong_interface_forces(self, elements, step, displacement, velocity, &
      & history, force)
      class(wrong_interface_group_type), intent(in) :: self
      integer, intent(in) :: elements(2)
      real(wp), intent(in) :: step
      real(wp), intent(in), contiguous :: displacement(:), velocity(:)
      real(wp), intent(inout), contiguous :: history(:), force(:)

      call self%interface_group_type%add_forces(elements, step, &
         & (1.0_wp + self%stiffer)*displacement, velocity, history, force)
   end subroutine add_wrong_interface_forces

end module wrong_plates
