!> Layout of the history variables of the ply with matrix cracks on planes of fracture.
module plydyn_law_ply_fracture_history
   use plydyn_base_precision, only : wp
   implicit none
   private

   !> What has happened to a point
   integer, parameter, public :: state = 1
   !> Nothing, so that nothing else of its history counts; it is near onset, and its stress is kept;
   !> something permanent
   real(wp), parameter, public :: untouched = 0.0_wp, near_onset = 1.0_wp, changed = 2.0_wp
   !> Widths of the crack band for broken fibres and for matrix cracks
   integer, parameter, public :: fibre_width = 2, matrix_width = 3
   !> The variables up to here are those of untouched points; the others are zero there
   integer, parameter, public :: histories_intact = matrix_width
   !> Damage of the matrix: share of the plane of fracture that has cracked
   integer, parameter, public :: matrix_damage = 4
   !> Damage of fibres in tension; strain along them at onset, 0 before; strain at the end of
   !> softening. Those of compression, of which strains are sizes, are so much further on
   integer, parameter, public :: fibre_damage = 5, fibre_onset = 6, fibre_finish = 7
   integer, parameter, public :: to_compression = 29
   !> Cosine and sine of the angle of the plane of fracture about the fibres, both 0 without one
   integer, parameter, public :: plane_cosine = 8, plane_sine = 9
   !> Strain of the cracked share: opening, sliding across the fibres and along them
   integer, parameter, public :: slip = 10
   !> Opening that debris holds
   integer, parameter, public :: held_opening = 13
   !> Permanent shear strains 12, 13, 23, and sizes of the shear stresses from which they grow
   integer, parameter, public :: plastic_shear = 14, yield_stress = 17
   !> Permanent strain 33 by crushing
   integer, parameter, public :: crushed = 20
   !> Stress at the end of the step before
   integer, parameter, public :: last_stress = 21
   !> Traction on the cracked share at the end of the step before
   integer, parameter, public :: last_contact = 27
   !> Energies dissipated per volume by fibres, matrix, permanent strain, friction of cracks
   integer, parameter, public :: fibre_energy = 30, matrix_energy = 31, plastic_energy = 32, &
      & friction_energy = 33
   !> What the step before had lost of the integrity of fibres for normal stress
   integer, parameter, public :: lost_integrity = 37
   integer, parameter, public :: histories = 37

end module plydyn_law_ply_fracture_history
