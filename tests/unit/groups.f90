!> The parts of a domain by the family of their groups.
module groups
   use plydyn_base_precision, only : wp
   use plydyn_domain_domain, only : domain_type
   use plydyn_element_plate_group, only : plates_of
   use plydyn_element_plate_layers, only : plate_type
   implicit none
   private

   public :: add_spring_forces, plate_of, spring_groups

contains

   !> The plate of a part
   pure function plate_of(domain, part) result(plate)
      !> The domain
      type(domain_type), intent(in) :: domain
      !> Index of the part
      integer, intent(in) :: part
      type(plate_type) :: plate

      type(plate_type), allocatable :: plates(:)

      plates = plates_of(domain%groups)
      plate = plates(part)
   end function plate_of

   !> How many groups have springs
   pure integer function spring_groups(domain)
      !> The domain
      type(domain_type), intent(in) :: domain
      integer :: g

      spring_groups = count([(allocated(domain%groups(g)%item%springs), g=1, size(domain%groups))])
   end function spring_groups

   !> Subtract the forces of interfaces over the elements of a chunk
   subroutine add_spring_forces(domain, chunk, displacement, history, force)
      !> The domain
      type(domain_type), intent(in) :: domain
      !> Number of the chunk
      integer, intent(in) :: chunk
      !> Displacement of all points
      real(wp), intent(in), contiguous :: displacement(:)
      !> History of all Gauss points
      real(wp), intent(inout), contiguous :: history(:)
      !> Force on all points
      real(wp), intent(inout), contiguous :: force(:)
      integer :: g

      do g = 1, size(domain%groups)
         associate (group => domain%groups(g)%item, here => domain%chunks%list(chunk))
            if (.not. allocated(group%springs) .or. group%set /= here%set) cycle
            call group%add_forces(here%elements, 0.0_wp, displacement, displacement, history, force)
         end associate
      end do
   end subroutine add_spring_forces

end module groups
