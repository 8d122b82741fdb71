!> Inertia of the relative motion of two points.
module plydyn_domain_inertia_links
   use plydyn_base_exact_sum, only : exact_sum_type
   use plydyn_base_precision, only : wp
   implicit none
   private

   !> Some of them
   type, public :: inertia_links_type
      !> Places in the arrays of motion, (2, links)
      integer, allocatable :: place(:, :)
      !> Inertia, (links)
      real(wp), allocatable :: inertia(:)
      !> Whether this rank counts each
      logical, allocatable :: own(:)
   contains
      procedure :: count_energy
   end type inertia_links_type

contains

   !> Add the kinetic energy of all links, times a factor, to a sum
   pure subroutine count_energy(self, velocity, factor, sum)
      class(inertia_links_type), intent(in) :: self
      !> Velocity of all points
      real(wp), intent(in) :: velocity(:)
      !> The factor
      real(wp), intent(in) :: factor
      type(exact_sum_type), intent(inout) :: sum

      integer :: i

      do i = 1, size(self%inertia)
         if (.not. self%own(i)) cycle
         associate (first => velocity(self%place(1, i)), second => velocity(self%place(2, i)))
            call sum%add(0.5_wp*factor*self%inertia(i)*(second - first)**2)
         end associate
      end do
   end subroutine count_energy

end module plydyn_domain_inertia_links
