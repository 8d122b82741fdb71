!> Permanent shear by the points of measured curves, of the lanes of a batch.
!>
!> Between its points a curve is straight, and so is the permanent strain over the stress. Beyond
!> the yield stress a step moves along the curve: from the total strain of monotone loading that
!> belongs to the yield stress, by the elastic strain beyond it. Both functions are sums of ramps,
!> so that nothing is searched for.
module plydyn_law_ply_fracture_shear_points
   use plydyn_base_precision, only : lanes, wp
   use plydyn_law_ply_shear_curve, only : shear_curve_type, table_slopes
   implicit none
   private

   public :: stress_at_set

   !> Curves of the lanes; strains are times the modulus, which makes stresses of them
   type, public :: shear_points_type
      !> Whether any lane has a curve; 1 in lanes that have one, else 0
      logical :: any = .false.
      real(wp) :: has(lanes) = 0.0_wp
      !> Stress at the beginning of each line, and change there of the slope of the permanent strain
      !> over the stress, (lanes, lines, shears 12, 13 and 23)
      real(wp), allocatable, private :: stress(:, :, :), give(:, :, :)
      !> Total strain there, and change of the slope of the stress over it
      real(wp), allocatable, private :: strain(:, :, :), slope(:, :, :)
   contains
      procedure :: set_lane
      procedure :: follow
   end type shear_points_type

contains

   !> Give a lane its curve. That of 13 is that of 12, that of 23 has stresses in a ratio to it: the
   !> permanent strains at them are the same
   pure subroutine set_lane(self, lane, curve, modulus, ratio)
      class(shear_points_type), intent(inout) :: self
      !> Lane
      integer, intent(in) :: lane
      !> Curve of 12, checked
      type(shear_curve_type), intent(in) :: curve
      !> Shear moduli 12, 13, 23
      real(wp), intent(in) :: modulus(3)
      !> Stress of 23 over that of 12 at the same permanent strain
      real(wp), intent(in) :: ratio

      real(wp) :: scale(3), slopes(size(curve%strain) - 1)
      integer :: k

      slopes(:) = table_slopes(curve%strain, curve%stress, modulus(1))
      scale(:) = [1.0_wp, 1.0_wp, ratio]
      self%any = .true.
      self%has(lane) = 1.0_wp
      call widen(self%stress, lane, size(slopes))
      call widen(self%give, lane, size(slopes))
      call widen(self%strain, lane, size(slopes))
      call widen(self%slope, lane, size(slopes))
      do k = 1, 3
         call set_component(self, lane, k, slopes*(curve%strain(2:) &
            & - curve%strain(:size(slopes)))*scale(k), modulus(k)*softness(slopes, modulus(1)) &
            & /scale(k))
      end do
   end subroutine set_lane

   !> Growth of the permanent strain over that of the stress on lines of some slopes
   elemental real(wp) function softness(slope, modulus)
      !> Slope of the stress over the total strain, and the modulus that it does not exceed
      real(wp), intent(in) :: slope, modulus

      softness = 1.0_wp/slope - 1.0_wp/modulus
   end function softness

   !> Make room for the lines of a lane, which has none yet
   pure subroutine widen(table, lane, lines)
      real(wp), allocatable, intent(inout) :: table(:, :, :)
      integer, intent(in) :: lane, lines

      real(wp), allocatable :: wider(:, :, :)
      integer :: known

      known = 0
      if (allocated(table)) known = size(table, 2)
      allocate (wider(lanes, max(known, lines), 3), source=0.0_wp)
      if (known > 0) wider(:, :known, :) = table
      wider(lane, :, :) = 0.0_wp
      call move_alloc(wider, table)
   end subroutine widen

   !> Lines of one shear as ramps
   pure subroutine set_component(self, lane, k, rise, give)
      class(shear_points_type), intent(inout) :: self
      integer, intent(in) :: lane, k
      !> Growth of the stress along each line, and growth of the permanent strain over it
      real(wp), intent(in) :: rise(:), give(:)

      real(wp) :: slope(size(give))
      integer :: i

      slope(:) = 1.0_wp/(1.0_wp + give)
      self%give(lane, 1, k) = give(1)
      self%slope(lane, 1, k) = slope(1)
      do i = 2, size(give)
         self%stress(lane, i, k) = sum(rise(:i - 1))
         self%strain(lane, i, k) = sum(rise(:i - 1)*(1.0_wp + give(:i - 1)))
         self%give(lane, i, k) = give(i) - give(i - 1)
         self%slope(lane, i, k) = slope(i) - slope(i - 1)
      end do
   end subroutine set_component

   !> Stress on the curves from a trial stress beyond them
   pure subroutine follow(self, k, over, trial, reached)
      class(shear_points_type), intent(in) :: self
      !> Which shear
      integer, intent(in) :: k
      !> What the trial stress has beyond the yield stress
      real(wp), intent(in) :: over(lanes)
      !> Trial stress
      real(wp), intent(in) :: trial(lanes)
      !> Stress, set in the lanes with a curve
      real(wp), intent(inout) :: reached(lanes)

      real(wp) :: found(lanes), strain(lanes)
      integer :: i, l

      strain(:) = trial
      found(:) = 0.0_wp
      do i = 1, size(self%give, 2)
         !$omp simd
         do l = 1, lanes
            strain(l) = strain(l) + self%give(l, i, k) &
               & *max(trial(l) - over(l) - self%stress(l, i, k), 0.0_wp)
         end do
      end do
      do i = 1, size(self%slope, 2)
         !$omp simd
         do l = 1, lanes
            found(l) = found(l) + self%slope(l, i, k)*max(strain(l) - self%strain(l, i, k), 0.0_wp)
         end do
      end do
      !$omp simd
      do l = 1, lanes
         reached(l) = self%has(l)*found(l) + (1.0_wp - self%has(l))*reached(l)
      end do
   end subroutine follow

   !> Stress 12 at which a curve has left some permanent strain; huge where it never does
   pure real(wp) function stress_at_set(curve, modulus, set) result(stress)
      !> Curve of 12, checked
      type(shear_curve_type), intent(in) :: curve
      !> Shear modulus 12
      real(wp), intent(in) :: modulus
      !> Permanent strain, above 0
      real(wp), intent(in) :: set

      real(wp) :: give(size(curve%strain) - 1), left, rise(size(curve%strain) - 1)
      integer :: i

      rise(:) = table_slopes(curve%strain, curve%stress, modulus)
      give(:) = softness(rise, modulus)
      rise(:) = rise*(curve%strain(2:) - curve%strain(:size(rise)))
      stress = 0.0_wp
      left = set
      do i = 1, size(rise)
         ! the last line goes on
         if (give(i)*rise(i) >= left .or. (i == size(rise) .and. give(i) > 0.0_wp)) then
            stress = stress + left/give(i)
            return
         end if
         stress = stress + rise(i)
         left = left - give(i)*rise(i)
      end do
      stress = huge(stress)
   end function stress_at_set

end module plydyn_law_ply_fracture_shear_points
