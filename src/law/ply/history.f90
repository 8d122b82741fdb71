!> Where the history of a damaged ply keeps what.
module plydyn_law_ply_history
   use plydyn_base_precision, only : lanes, wp
   implicit none
   private

   public :: find_remains, find_share, give, give_own, keep_driving, swap_closed, take_mean, &
      & take_own

   !> What an intact point looks at in every step, with the shear strain that stays: the largest
   !> shear strain up to the onset of matrix damage, less than 0 once a mode has begun
   integer, parameter, public :: shear_peak = 1
   !> Largest width of the crack bands of all points of the element, the same at each: one look
   !> serves for all of them
   integer, parameter, public :: largest_band = 2
   !> What the next growth of a mode depends on: before onset the width of its crack band; then, as
   !> less than 0, the square of the equivalent strain beyond which damage grows, or, where cracks
   !> close, the width
   integer, parameter, public :: fibre_gate = 3, matrix_gate = 4
   !> History of fibres and of matrix: damage; equivalent strain at onset, negative in compression,
   !> 0 before; equivalent strain at the end of softening
   integer, parameter, public :: fibre_damage = 5, fibre_onset = 6, fibre_finish = 7, &
      & matrix_damage = 8, matrix_onset = 9, matrix_finish = 10
   !> Energies dissipated per volume by fibres and by matrix
   integer, parameter, public :: fibre_energy = 11, matrix_energy = 12
   !> Shear strain that stays; work per volume that it would have cost an intact ply beyond what it
   !> has
   integer, parameter, public :: shear_set = 13, shear_spared = 14
   !> Where cracks close, damage, onset and finish are of tension; those of compression are so much
   !> further on
   integer, parameter, public :: to_compression = 10

   !> Largest shear strain that marks a mode that has begun where there has been none
   real(wp), parameter, public :: no_strain = 1.0e-30_wp

   !> Where strains are averaged: strains 11, 22, 33 and elastic shear strain 12 of the point, and
   !> their averages; cracks do not close there
   integer, parameter, public :: driving_strains = 4, own_strain = 15, mean_strain = 19

   !> Histories without and with cracks that close, with averages, and the most of all
   integer, parameter, public :: histories_open = 14, histories_closing = 20, &
      & histories_average = 22, histories_most = 22

contains

   !> Strain and history of some lanes of a point; zero in the others
   pure subroutine take_own(own, pitch, histories, strain, history, e, h)
      !> 1 in the lanes to take, else 0
      real(wp), intent(in) :: own(lanes)
      !> As in `update_points` of a law; histories of a point
      integer, intent(in) :: pitch, histories
      !> Total strain
      real(wp), intent(in) :: strain(lanes, 6)
      !> History from the point on
      real(wp), intent(in) :: history(lanes, pitch, *)
      !> What is taken
      real(wp), intent(out) :: e(lanes, 6), h(lanes, histories)

      real(wp) :: value
      integer :: k, l

      do k = 1, 6
         !$omp simd private(value)
         do l = 1, lanes
            value = strain(l, k)
            e(l, k) = merge(value, 0.0_wp, own(l) > 0.0_wp)
         end do
      end do
      do k = 1, histories
         !$omp simd private(value)
         do l = 1, lanes
            value = history(l, 1, k)
            h(l, k) = merge(value, 0.0_wp, own(l) > 0.0_wp)
         end do
      end do
   end subroutine take_own

   !> Give history and stress of a point back to some lanes
   pure subroutine give_own(own, pitch, histories, h, s, history, stress)
      !> 1 in the lanes to give, else 0
      real(wp), intent(in) :: own(lanes)
      !> As in `update_points` of a law; histories of a point
      integer, intent(in) :: pitch, histories
      !> What is given
      real(wp), intent(in) :: h(lanes, histories), s(lanes, 6)
      !> History from the point on
      real(wp), intent(inout) :: history(lanes, pitch, *)
      !> Stress
      real(wp), intent(inout) :: stress(lanes, 6)

      integer :: k

      do k = 1, histories
         call give(own, 1, h(:, k), history(:, 1, k))
      end do
      call give(own, 6, s, stress)
   end subroutine give_own

   !> Give numbers to some lanes
   pure subroutine give(own, columns, from, to)
      !> 1 in the lanes to give, else 0
      real(wp), intent(in) :: own(lanes)
      !> Numbers of a lane
      integer, intent(in) :: columns
      !> What is given, and what gets it
      real(wp), intent(in) :: from(lanes, columns)
      real(wp), intent(inout) :: to(lanes, columns)

      real(wp) :: given, kept
      integer :: k, l

      do k = 1, columns
         !$omp simd private(given, kept)
         do l = 1, lanes
            given = from(l, k)
            kept = to(l, k)
            to(l, k) = merge(given, kept, own(l) > 0.0_wp)
         end do
      end do
   end subroutine give

   !> Strains that drive damage, from their averages over neighbours
   pure subroutine take_mean(modulus, mean, strain, shear)
      !> G12
      real(wp), intent(in) :: modulus(lanes)
      !> Averages
      real(wp), intent(in) :: mean(lanes, driving_strains)
      !> Strains 11, 22, 33
      real(wp), intent(out) :: strain(lanes, 3)
      !> Sizes of the shear stress 12 before damage and of the elastic shear strain
      real(wp), intent(out) :: shear(lanes, 2)

      integer :: l

      !$omp simd
      do l = 1, lanes
         strain(l, 1) = mean(l, 1)
         strain(l, 2) = mean(l, 2)
         strain(l, 3) = mean(l, 3)
         shear(l, 2) = abs(mean(l, 4))
         shear(l, 1) = modulus(l)*shear(l, 2)
      end do
   end subroutine take_mean

   !> Mean of the driving forces of a step over their values at the end, where damage grows with
   !> the strain of neighbours: strain before over strain now, which is what the work of the step
   !> less what is stored comes to
   pure subroutine find_share(e, elastic, own, share)
      !> Total strain
      real(wp), intent(in) :: e(lanes, 6)
      !> Size of the elastic shear strain 12
      real(wp), intent(in) :: elastic(lanes)
      !> Strains of the point before
      real(wp), intent(in) :: own(lanes, driving_strains)
      !> Of fibres and of matrix
      real(wp), intent(out) :: share(lanes, 2)

      real(wp) :: shear
      integer :: l

      !$omp simd private(shear)
      do l = 1, lanes
         shear = sign(elastic(l), e(l, 4))
         share(l, 1) = max(own(l, 1)*e(l, 1), 0.0_wp)/max(e(l, 1)**2, tiny(shear))
         share(l, 2) = max(own(l, 2)*e(l, 2) + own(l, 4)*shear, 0.0_wp) &
            & /max(e(l, 2)**2 + shear**2, tiny(shear))
      end do
   end subroutine find_share

   !> Keep what neighbours average in the next step
   pure subroutine keep_driving(e, elastic, own)
      !> Total strain
      real(wp), intent(in) :: e(lanes, 6)
      !> Size of the elastic shear strain 12
      real(wp), intent(in) :: elastic(lanes)
      !> Strains of the point
      real(wp), intent(inout) :: own(lanes, driving_strains)

      integer :: l

      !$omp simd
      do l = 1, lanes
         own(l, 1) = e(l, 1)
         own(l, 2) = e(l, 2)
         own(l, 3) = e(l, 3)
         own(l, 4) = sign(elastic(l), e(l, 4))
      end do
   end subroutine keep_driving

   !> Put first the damage that acts, of tension or of compression; a second call undoes it
   pure subroutine swap_closed(closes, trial, h)
      !> 1 in lanes where cracks close, else 0
      real(wp), intent(in) :: closes(lanes)
      !> Trial stresses along and across the fibres: their signs say what acts
      real(wp), intent(in) :: trial(lanes, 2)
      !> History in which tension and compression change places where the stress is negative
      real(wp), intent(inout) :: h(lanes, histories_closing)

      real(wp) :: first, second
      integer :: k, l, mode

      do k = fibre_damage, matrix_finish
         mode = merge(1, 2, k <= fibre_finish)
         !$omp simd private(first, second)
         do l = 1, lanes
            first = h(l, k)
            second = h(l, k + to_compression)
            h(l, k) = merge(second, first, closes(l)*trial(l, mode) < 0.0_wp)
            h(l, k + to_compression) = merge(first, second, closes(l)*trial(l, mode) < 0.0_wp)
         end do
      end do
   end subroutine swap_closed

   !> What remains of the stiffness along and across the fibres, for normal stress and for shear.
   !> Where cracks close, damage of compression is also open in tension, and shear has both.
   pure subroutine find_remains(residual, any_closes, h, sense, remains)
      !> Least part that remains
      real(wp), intent(in) :: residual(lanes)
      !> Whether cracks close in any lane
      logical, intent(in) :: any_closes
      !> History, the damage that acts first
      real(wp), intent(in) :: h(lanes, *)
      !> Stresses along and across of which the signs count; not looked at unless cracks close
      real(wp), intent(in) :: sense(lanes, 2)
      !> R1 and R2 for normal stress, R1 and R2 for shear
      real(wp), intent(out) :: remains(lanes, 4)

      real(wp) :: own
      integer :: from, k, l

      !$omp simd
      do l = 1, lanes
         remains(l, 1) = max(1.0_wp - h(l, fibre_damage), residual(l))
         remains(l, 2) = max(1.0_wp - h(l, matrix_damage), residual(l))
         remains(l, 3) = remains(l, 1)
         remains(l, 4) = remains(l, 2)
      end do
      if (.not. any_closes) return
      do k = 1, 2
         from = merge(fibre_damage, matrix_damage, k == 1) + to_compression
         !$omp simd private(own)
         do l = 1, lanes
            own = remains(l, k)
            remains(l, k + 2) = min(own, max(1.0_wp - h(l, from), residual(l)))
            remains(l, k) = merge(remains(l, k + 2), own, sense(l, k) >= 0.0_wp)
         end do
      end do
   end subroutine find_remains

end module plydyn_law_ply_history
