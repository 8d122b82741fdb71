!> Initial damage of interfaces.
module plydyn_model_initial
   use plydyn_base_precision, only : wp
   implicit none
   private

   !> Damage of some interfaces of a part at time zero
   type, public :: initial_damage_type
      !> Index into `model%parts`
      integer :: part = 0
      !> First and last interface, counted from the bottom
      integer :: interfaces(2) = 0
      !> Indices into `mesh%quad_id`
      integer, allocatable :: quads(:)
      !> From 0 to 1; 1 where the faces are apart
      real(wp) :: damage = 1.0_wp
      !> Only points within a circle of the plane: its centre and its radius
      real(wp) :: centre(2) = 0.0_wp, radius = huge(1.0_wp)
   contains
      procedure :: encloses
   end type initial_damage_type

contains

   !> Whether points of the plane lie in the circle
   pure function encloses(self, point)
      class(initial_damage_type), intent(in) :: self
      !> The points, (2, points)
      real(wp), intent(in) :: point(:, :)
      logical :: encloses(size(point, 2))

      integer :: i

      do i = 1, size(point, 2)
         encloses(i) = norm2(point(:, i) - self%centre) <= self%radius
      end do
   end function encloses

end module plydyn_model_initial
