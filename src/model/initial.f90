!> What is broken before the run begins.
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
   end type initial_damage_type

end module plydyn_model_initial
