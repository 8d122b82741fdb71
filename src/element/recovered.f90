!> Layout of the values that are recovered at a point: strain, stress and the scalars of laws.
module plydyn_element_recovered
   use plydyn_law_law, only : scalars
   implicit none
   private

   !> Where each kind of recovered values begins, less one: strain and stress in the axes of the
   !> plate, then of the ply, each xx, yy, zz, xy, xz, yz with engineering shear; the scalars that
   !> laws show
   integer, parameter, public :: strain_at = 0, stress_at = 6, ply_strain_at = 12, &
      & ply_stress_at = 18, scalars_at = 24
   !> How many there are
   integer, parameter, public :: recovered = scalars_at + scalars

end module plydyn_element_recovered
