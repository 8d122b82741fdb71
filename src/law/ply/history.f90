!> Layout of the history variables of the ply-damage law.
!>
!> The signs of three variables are a state beside their size, so that an intact point reads few
!> variables in a step: `has_begun` and `began_in_compression` test for it.
module plydyn_law_ply_history
   use plydyn_base_precision, only : lanes, wp
   implicit none
   private

   public :: band_width, began_in_compression, begun_shear, begun_threshold, find_integrity, &
      & growth_threshold, has_begun, integrity_of, largest_shear, load_lanes, &
      & store_columns, store_lanes, strain_excess, swap_closed, with_largest_shear

   !> Largest shear strain up to the onset of matrix damage; its sign says whether any mode has
   !> begun, see `has_begun`
   integer, parameter, public :: shear_peak = 1
   !> Largest width of the crack bands of all points of the element, the same at each of them
   integer, parameter, public :: largest_band = 2
   !> Growth threshold of a mode: before onset the width of its crack band; then the equivalent
   !> strain beyond which damage grows or, where cracks close, the width again, beside limits of its
   !> own; see `has_begun`
   integer, parameter, public :: fibre_threshold = 3, matrix_threshold = 4
   !> Permanent shear strain
   integer, parameter, public :: shear_set = 5
   !> The variables up to here are those of intact points; what follows is zero until damage begins
   integer, parameter, public :: histories_intact = shear_set
   !> History of fibres and of matrix: damage; equivalent strain at onset, 0 before, see
   !> `began_in_compression`; equivalent strain at the end of softening
   integer, parameter, public :: fibre_damage = 6, fibre_onset = 7, fibre_finish = 8, &
      & matrix_damage = 9, matrix_onset = 10, matrix_finish = 11
   !> Energies dissipated per volume by fibres and by matrix; plastic work per volume that damage
   !> has spared
   integer, parameter, public :: fibre_energy = 12, matrix_energy = 13, spared_work = 14
   !> Where cracks close, damage, onset and finish are of tension; those of compression are so much
   !> further on
   integer, parameter, public :: to_compression = 9
   !> Where cracks close, strains beyond which damage of fibres and of matrix grows in tension, and
   !> behind them those in compression; 0 before onset
   integer, parameter, public :: growth_limit = 21, limit_to_compression = 2

   !> Largest shear strain that marks a mode that has begun where there has been none
   real(wp), parameter :: no_strain = 1.0e-30_wp

   !> Strains that are averaged: 11, 22, 33 and the elastic shear strain 12
   integer, parameter, public :: driving_strains = 4
   !> Histories without and with cracks that close; the most, of which some are those of averages,
   !> with which cracks do not close
   integer, parameter, public :: histories_open = 14, histories_closing = 24, &
      & histories_most = histories_closing

contains

   !> Whether damage of a mode has begun, or that of any at a point
   elemental logical function has_begun(mark)
      !> Growth threshold of the mode; variable `shear_peak` of the point, or the least of some
      real(wp), intent(in) :: mark

      has_begun = mark < 0.0_wp
   end function has_begun

   !> Width of the crack band of a mode that has not begun, or of any mode where cracks close
   elemental real(wp) function band_width(threshold)
      !> Growth threshold of the mode
      real(wp), intent(in) :: threshold

      band_width = abs(threshold)
   end function band_width

   !> Growth threshold of a mode that begins, with the width of its crack band
   elemental real(wp) function begun_threshold(width)
      !> Width of the crack band
      real(wp), intent(in) :: width

      begun_threshold = -width
   end function begun_threshold

   !> Growth threshold of a mode that has begun, with the strain beyond which its damage grows
   elemental real(wp) function growth_threshold(strain)
      !> Equivalent strain
      real(wp), intent(in) :: strain

      growth_threshold = -strain**2
   end function growth_threshold

   !> More than 0 where the strain of a mode that has begun is beyond its growth threshold
   elemental real(wp) function strain_excess(square, threshold)
      !> Square of the equivalent strain; growth threshold of the mode
      real(wp), intent(in) :: square, threshold

      strain_excess = square + threshold
   end function strain_excess

   !> Largest size of the shear strain of a point up to the onset of matrix damage
   elemental real(wp) function largest_shear(peak)
      !> Variable `shear_peak`
      real(wp), intent(in) :: peak

      largest_shear = abs(peak)
   end function largest_shear

   !> Variable `shear_peak` with another largest strain, and the same modes begun
   elemental real(wp) function with_largest_shear(strain, peak)
      !> Largest size of the shear strain; the variable before
      real(wp), intent(in) :: strain, peak

      with_largest_shear = sign(strain, peak)
   end function with_largest_shear

   !> Variable `shear_peak` of a point at which a mode begins
   elemental real(wp) function begun_shear(peak)
      !> The variable before
      real(wp), intent(in) :: peak

      begun_shear = -max(abs(peak), no_strain)
   end function begun_shear

   !> Whether damage of a mode began in compression
   elemental logical function began_in_compression(onset)
      !> Equivalent strain at onset, as the history has it
      real(wp), intent(in) :: onset

      began_in_compression = onset < 0.0_wp
   end function began_in_compression

   !> Part of a stiffness that damage leaves
   elemental real(wp) function integrity_of(damage, residual)
      !> Damage; least part
      real(wp), intent(in) :: damage, residual

      integrity_of = max(1.0_wp - damage, residual)
   end function integrity_of

   !> Strain and history of some lanes of a point; zero in the others
   pure subroutine load_lanes(own, pitch, histories, strain, history, e, h)
      !> 1 in the lanes to load, else 0
      real(wp), intent(in) :: own(lanes)
      !> As in `update_points` of a law; histories of a point
      integer, intent(in) :: pitch, histories
      !> Total strain; history from the point on
      real(wp), intent(in) :: strain(lanes, 6), history(lanes, pitch, *)
      !> Strain and history
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
   end subroutine load_lanes

   !> Store history and stress of a point in some lanes
   pure subroutine store_lanes(own, pitch, histories, h, s, history, stress)
      !> 1 in the lanes to store, else 0
      real(wp), intent(in) :: own(lanes)
      !> As in `update_points` of a law; histories of a point
      integer, intent(in) :: pitch, histories
      !> What is stored
      real(wp), intent(in) :: h(lanes, histories), s(lanes, 6)
      !> History from the point on; stress
      real(wp), intent(inout) :: history(lanes, pitch, *), stress(lanes, 6)

      integer :: k

      do k = 1, histories
         call store_columns(own, 1, h(:, k), history(:, 1, k))
      end do
      call store_columns(own, 6, s, stress)
   end subroutine store_lanes

   !> Store columns of numbers in some lanes
   pure subroutine store_columns(own, columns, from, to)
      !> 1 in the lanes to store, else 0
      real(wp), intent(in) :: own(lanes)
      !> Numbers of a lane
      integer, intent(in) :: columns
      !> Numbers to store, and where
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
   end subroutine store_columns

   !> Swap the damages of tension and of compression so that the active one is first; a second call
   !> undoes it
   pure subroutine swap_closed(closes, trial, h)
      !> 1 in lanes where cracks close, else 0
      real(wp), intent(in) :: closes(lanes)
      !> Trial stresses along and across the fibres, whose signs say which damage is active
      real(wp), intent(in) :: trial(lanes, 2)
      !> History in which tension and compression change places where the stress is negative
      real(wp), intent(inout) :: h(lanes, histories_closing)

      integer :: k, mode

      do k = fibre_damage, matrix_finish
         mode = merge(1, 2, k <= fibre_finish)
         call swap_pair(closes, trial(:, mode), h(:, k), h(:, k + to_compression))
      end do
      do mode = 1, 2
         k = growth_limit - 1 + mode
         call swap_pair(closes, trial(:, mode), h(:, k), h(:, k + limit_to_compression))
      end do
   end subroutine swap_closed

   !> Swap a variable of tension and that of compression where the stress is negative
   pure subroutine swap_pair(closes, trial, one, other)
      !> As in `swap_closed`, of one mode
      real(wp), intent(in) :: closes(lanes), trial(lanes)
      !> The variables
      real(wp), intent(inout) :: one(lanes), other(lanes)

      real(wp) :: first, second
      integer :: l

      !$omp simd private(first, second)
      do l = 1, lanes
         first = one(l)
         second = other(l)
         one(l) = merge(second, first, closes(l)*trial(l) < 0.0_wp)
         other(l) = merge(first, second, closes(l)*trial(l) < 0.0_wp)
      end do
   end subroutine swap_pair

   !> Integrity along and across the fibres, for normal stress and for shear. Where cracks close,
   !> damage of compression is also open in tension, and shear has both
   pure subroutine find_integrity(residual, any_closes, h, sense, integrity)
      !> Least integrity
      real(wp), intent(in) :: residual(lanes)
      !> Whether cracks close in any lane
      logical, intent(in) :: any_closes
      !> History, the active damage first
      real(wp), intent(in) :: h(lanes, *)
      !> Stresses along and across whose signs count; not used unless cracks close
      real(wp), intent(in) :: sense(lanes, 2)
      !> R1 and R2 for normal stress, R1 and R2 for shear
      real(wp), intent(out) :: integrity(lanes, 4)

      real(wp) :: own
      integer :: from, k, l

      !$omp simd
      do l = 1, lanes
         integrity(l, 1) = integrity_of(h(l, fibre_damage), residual(l))
         integrity(l, 2) = integrity_of(h(l, matrix_damage), residual(l))
         integrity(l, 3) = integrity(l, 1)
         integrity(l, 4) = integrity(l, 2)
      end do
      if (.not. any_closes) return
      do k = 1, 2
         from = merge(fibre_damage, matrix_damage, k == 1) + to_compression
         !$omp simd private(own)
         do l = 1, lanes
            own = integrity(l, k)
            integrity(l, k + 2) = min(own, integrity_of(h(l, from), residual(l)))
            integrity(l, k) = merge(integrity(l, k + 2), own, sense(l, k) >= 0.0_wp)
         end do
      end do
   end subroutine find_integrity

end module plydyn_law_ply_history
