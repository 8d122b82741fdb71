!> Inertia of the relative motion of two points.
module plydyn_domain_links
   use plydyn_base_precision, only : wp
   implicit none
   private

   !> Some of them
   type, public :: links_type
      !> Places in the arrays of motion, (2, links)
      integer, allocatable :: place(:, :)
      !> Inertia, (links)
      real(wp), allocatable :: inertia(:)
   contains
      procedure :: energy
   end type links_type

contains

   !> Kinetic energy
   pure real(wp) function energy(self, velocity)
      class(links_type), intent(in) :: self
      !> Velocity of all points
      real(wp), intent(in) :: velocity(:)

      energy = 0.5_wp*sum(self%inertia*(velocity(self%place(2, :)) &
         & - velocity(self%place(1, :)))**2)
   end function energy

end module plydyn_domain_links
