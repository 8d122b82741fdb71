!> Plates and interfaces with kernels that are wrong on purpose.
module wrong_plates
   use plydyn_base_precision, only : wp
   use plydyn_domain_domain, only : domain_type
   use plydyn_element_interface_group, only : interface_group_type
   use plydyn_element_plate_group, only : plate_group_type
   implicit none
   private

   public :: spoil_interfaces, spoil_plates

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

   !> Let all plates of a domain be too stiff by a share
   subroutine spoil_plates(domain, stiffer)
      !> The domain
      type(domain_type), intent(inout) :: domain
      !> The share
      real(wp), intent(in) :: stiffer

      type(wrong_plate_group_type) :: wrong
      integer :: g

      do g = 1, size(domain%groups)
         select type (group => domain%groups(g)%item)
         type is (plate_group_type)
            wrong%plate_group_type = group
         class default
            cycle
         end select
         wrong%stiffer = stiffer
         deallocate (domain%groups(g)%item)
         allocate (domain%groups(g)%item, source=wrong)
      end do
   end subroutine spoil_plates

   !> The same of all interfaces
   subroutine spoil_interfaces(domain, stiffer)
      type(domain_type), intent(inout) :: domain
      real(wp), intent(in) :: stiffer

      type(wrong_interface_group_type) :: wrong
      integer :: g

      do g = 1, size(domain%groups)
         select type (group => domain%groups(g)%item)
         type is (interface_group_type)
            wrong%interface_group_type = group
         class default
            cycle
         end select
         wrong%stiffer = stiffer
         deallocate (domain%groups(g)%item)
         allocate (domain%groups(g)%item, source=wrong)
      end do
   end subroutine spoil_interfaces

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
