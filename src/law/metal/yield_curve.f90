!> Curves of yield stress over effective plastic strain.
module plydyn_law_metal_yield_curve
   use plydyn_base_precision, only : wp
   implicit none
   private

   public :: common_strains, is_yield_curve, stress_at

   !> Points of a curve, straight in between
   type, public :: yield_curve_type
      !> Rate of effective plastic strain that it belongs to
      real(wp) :: rate = 0.0_wp
      !> Effective plastic strain of the points
      real(wp), allocatable :: strain(:)
      !> Yield stress there
      real(wp), allocatable :: stress(:)
   end type yield_curve_type

contains

   !> Whether a curve can be: strain from zero on, rising; stress always positive
   pure logical function is_yield_curve(curve)
      !> The curve
      type(yield_curve_type), intent(in) :: curve

      integer :: points

      is_yield_curve = .false.
      points = size(curve%strain)
      if (points < 1 .or. size(curve%stress) /= points) return
      is_yield_curve = abs(curve%strain(1)) <= 0.0_wp .and. all(curve%stress > 0.0_wp) &
         & .and. all(curve%strain(2:) > curve%strain(:points - 1))
   end function is_yield_curve

   !> Yield stress at some strain; past its last point a curve goes on as it ended, but not down
   pure elemental real(wp) function stress_at(curve, strain)
      !> Curve that can be
      type(yield_curve_type), intent(in) :: curve
      !> Effective plastic strain
      real(wp), intent(in) :: strain

      real(wp) :: slope
      integer :: k, points

      points = size(curve%strain)
      k = count(curve%strain <= strain)
      if (points == 1) then
         slope = 0.0_wp
      else if (k < points) then
         slope = (curve%stress(k + 1) - curve%stress(k))/(curve%strain(k + 1) - curve%strain(k))
      else
         slope = max(curve%stress(k) - curve%stress(k - 1), 0.0_wp) &
            & /(curve%strain(k) - curve%strain(k - 1))
      end if
      stress_at = curve%stress(k) + slope*(strain - curve%strain(k))
   end function stress_at

   !> The strains of the points of several curves, each once, rising
   pure function common_strains(curves) result(common)
      !> Curves that can be
      type(yield_curve_type), intent(in) :: curves(:)
      real(wp), allocatable :: common(:)

      real(wp), allocatable :: left(:)
      integer :: c

      left = [(curves(c)%strain, c=1, size(curves))]
      allocate (common(0))
      do while (size(left) > 0)
         common = [common, minval(left)]
         left = pack(left, left > common(size(common)))
      end do
   end function common_strains

end module plydyn_law_metal_yield_curve
