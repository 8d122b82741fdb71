!> Toughness of an interface in a mix of opening and sliding.
module plydyn_law_cohesive_toughness
   use plydyn_base_precision, only : lanes, wp
   implicit none
   private

   public :: find_toughness, least_ratio

   !> Toughness between the pure modes: Benzeggagh and Kenane, or a sum of powers of G/G_c
   integer, parameter, public :: benzeggagh_kenane = 1, power_law = 2

   !> Smallest share of a mode whose power is taken
   real(wp), parameter :: smallest = 1.0e-60_wp

   !> Intervals of the mix in which the final over onset opening is bounded from below, and the part
   !> of the bound that is sure: the curve of a power law below 1 bends a little below both ends
   integer, parameter :: intervals = 64
   real(wp), parameter :: sure = 0.99_wp

contains

   !> Energies per crack area at mixes of modes
   pure subroutine find_toughness(criterion, exponent, each, mix, toughness)
      !> `benzeggagh_kenane` or `power_law`
      integer, intent(in) :: criterion
      !> Its exponent, above 0
      real(wp), intent(in) :: exponent
      !> Energies per crack area of opening and of sliding
      real(wp), intent(in) :: each(2)
      !> Share of the energy that is of shear, from 0 to 1
      real(wp), intent(in) :: mix(lanes)
      !> Energy per crack area
      real(wp), intent(out) :: toughness(lanes)

      real(wp) :: opening, sliding
      integer :: l

      if (criterion == benzeggagh_kenane) then
         !$omp simd private(sliding)
         do l = 1, lanes
            sliding = exp(exponent*log(max(mix(l), smallest)))
            toughness(l) = each(1)*(1.0_wp - sliding) + each(2)*sliding
         end do
      else
         !$omp simd private(opening, sliding)
         do l = 1, lanes
            opening = exp(exponent*log(max(1.0_wp - mix(l), smallest)/each(1)))
            sliding = exp(exponent*log(max(mix(l), smallest)/each(2)))
            toughness(l) = exp(-log(opening + sliding)/exponent)
         end do
      end if
   end subroutine find_toughness

   !> A number that the final over onset opening is not below for any mix of modes: in an interval
   !> the least toughness is at an end, and so is the least of what it is multiplied with
   pure real(wp) function least_ratio(criterion, exponent, each, onset) result(least)
      !> As in `find_toughness`
      integer, intent(in) :: criterion
      real(wp), intent(in) :: exponent, each(2)
      !> Square of the load per twice the elastic energy of each mode
      real(wp), intent(in) :: onset(2)

      real(wp) :: ends(2), mix(lanes), toughness(lanes)
      integer :: i

      least = huge(least)
      do i = 1, intervals
         ends(:) = real([i - 1, i], wp)/intervals
         mix(:) = ends(2)
         mix(1) = ends(1)
         call find_toughness(criterion, exponent, each, mix, toughness)
         least = min(least, sure*2.0_wp*minval(toughness) &
            & *minval(onset(1)*(1.0_wp - ends) + onset(2)*ends))
      end do
   end function least_ratio

end module plydyn_law_cohesive_toughness
