!> Plasticity with a tabulated yield stress: *MAT_PIECEWISE_LINEAR_PLASTICITY.
!>
!> A lane has one curve of yield stress over effective plastic strain, or one for each of some
!> rates. Between points and between rates the yield stress is linear (between rates, on request,
!> in the logarithm of the rate). Past its last point a curve goes on as it ended, but not down;
!> outside the rates given, the nearest curve holds.
module plydyn_law_metal_tabulated
   use plydyn_base_precision, only : lanes, wp
   use plydyn_law_law, only : law_type
   use plydyn_law_metal_cowper_symonds, only : cowper_symonds_type
   use plydyn_law_metal_plastic, only : metal_constants_type, plastic_type
   implicit none
   private

   public :: common_strains, is_yield_curve, stress_at

   !> Strain where a lane has no more segments
   real(wp), parameter :: never = huge(1.0_wp)
   !> Least rate of which a logarithm is taken
   real(wp), parameter :: least_rate = 1.0e-290_wp

   !> Points of a curve, straight in between
   type, public :: yield_curve_type
      !> Rate of effective plastic strain that it belongs to
      real(wp) :: rate = 0.0_wp
      !> Effective plastic strain of the points; yield stress there
      real(wp), allocatable :: strain(:), stress(:)
   end type yield_curve_type

   !> Constants of a metal with a tabulated yield stress, besides the elastic ones
   type, public, extends(metal_constants_type) :: tabulated_constants_type
      !> Yield stress over effective plastic strain for each of some rates that rise; one alone
      !> holds at all rates
      type(yield_curve_type), allocatable :: curves(:)
      !> Between two rates their logarithm counts
      logical :: logarithmic = .false.
      !> Stress that rises with the rate besides (SIGY)
      real(wp) :: yield = 0.0_wp
      !> Rate at which that rise is one, 0 for none, and its power (Cowper and Symonds)
      real(wp) :: rate = 0.0_wp, power = 0.0_wp
   contains
      procedure :: new_batch
      procedure :: set_lane
   end type tabulated_constants_type

   !> Curves of the lanes, as straight segments, and the way from curve to curve
   type, public, extends(plastic_type) :: plastic_curve_type
      !> Effective plastic strain where a segment starts, (lanes, segments)
      real(wp), allocatable :: start(:, :)
      !> Yield stress of the segment's line at no strain, (lanes, segments, curves)
      real(wp), allocatable :: offset(:, :, :)
      !> Rise of the yield stress along it, (lanes, segments, curves)
      real(wp), allocatable :: slope(:, :, :)
      !> Rate of the curve before, or its logarithm, (lanes, curves)
      real(wp), allocatable :: from(:, :)
      !> One over the distance from there; 0 where there is nothing to go to, (lanes, curves)
      real(wp), allocatable :: inverse_length(:, :)
      !> Lanes in which the logarithm of the rate counts
      logical :: logarithmic(lanes) = .false.
      !> Rise with the rate, besides
      type(cowper_symonds_type) :: rate
   contains
      procedure :: yield_stress
   end type plastic_curve_type

contains

   !> A law without lanes
   subroutine new_batch(self, law)
      class(tabulated_constants_type), intent(in) :: self
      class(law_type), allocatable, intent(out) :: law

      allocate (plastic_curve_type :: law)
   end subroutine new_batch

   !> Give a lane of a batch its metal
   pure subroutine set_lane(self, lane, law)
      class(tabulated_constants_type), intent(in) :: self
      integer, intent(in) :: lane
      class(law_type), intent(inout) :: law

      select type (law)
      type is (plastic_curve_type)
         call set_curves(law, lane, self)
         if (self%rate > 0.0_wp) call law%rate%set_lane(lane, self%rate, self%power, self%yield)
      end select
   end subroutine set_lane

   !> Give a lane its curves; it is the law's own from then on
   pure subroutine set_curves(self, lane, metal)
      type(plastic_curve_type), intent(inout) :: self
      integer, intent(in) :: lane
      !> Its metal
      class(tabulated_constants_type), intent(in) :: metal

      real(wp), allocatable :: strain(:)
      real(wp) :: lowest, rate_measure(size(metal%curves))
      integer :: c, last

      associate (curves => metal%curves)
         strain = common_strains(curves)
         last = size(strain)
         call reserve(self, last, size(curves))
         self%start(lane, :) = never
         self%start(lane, :last) = strain
         lowest = never
         do c = 1, size(curves)
            call cut(curves(c), strain, self%offset(lane, :last, c), self%slope(lane, :last, c))
            lowest = min(lowest, minval(curves(c)%stress))
         end do
         rate_measure(:) = curves%rate
      end associate
      call self%own_lane(lane, metal, onset=lowest)
      self%logarithmic(lane) = metal%logarithmic
      if (metal%logarithmic) rate_measure(:) = log(rate_measure)
      self%inverse_length(lane, :) = 0.0_wp
      do c = 2, size(rate_measure)
         self%from(lane, c) = rate_measure(c - 1)
         self%inverse_length(lane, c) = 1.0_wp/(rate_measure(c) - rate_measure(c - 1))
      end do
   end subroutine set_curves

   !> Enlarge the arrays for segments and curves, which keep their values
   pure subroutine reserve(self, segments, curves)
      class(plastic_curve_type), intent(inout) :: self
      !> Segments and curves that a lane needs
      integer, intent(in) :: segments, curves

      type(plastic_curve_type) :: old
      integer :: extent(2)

      extent(:) = [segments, curves]
      if (allocated(self%slope)) then
         old = self
         extent(:) = max(extent, [size(old%slope, 2), size(old%slope, 3)])
         deallocate (self%start, self%offset, self%slope, self%from, self%inverse_length)
      end if
      allocate (self%start(lanes, extent(1)), source=never)
      allocate (self%offset(lanes, extent(1), extent(2)), source=1.0_wp)
      allocate (self%slope(lanes, extent(1), extent(2)), source=0.0_wp)
      allocate (self%from(lanes, extent(2)), self%inverse_length(lanes, extent(2)), source=0.0_wp)
      if (.not. allocated(old%slope)) return
      extent(:) = [size(old%slope, 2), size(old%slope, 3)]
      self%start(:, :extent(1)) = old%start
      self%offset(:, :extent(1), :extent(2)) = old%offset
      self%slope(:, :extent(1), :extent(2)) = old%slope
      self%from(:, :extent(2)) = old%from
      self%inverse_length(:, :extent(2)) = old%inverse_length
   end subroutine reserve

   !> Cut a curve at strains among which are all of its own
   pure subroutine cut(curve, strain, offset, slope)
      !> Curve to cut
      type(yield_curve_type), intent(in) :: curve
      !> Where segments start
      real(wp), intent(in) :: strain(:)
      !> Yield stress of the segments at no strain; rise along them
      real(wp), intent(out) :: offset(:), slope(:)

      real(wp) :: stress(size(strain) + 1), until(size(strain) + 1)
      integer :: last

      last = size(strain)
      until(:) = [strain, strain(last) + 1.0_wp]
      stress(:) = stress_at(curve, until)
      slope(:) = (stress(2:) - stress(:last))/(until(2:) - strain)
      offset(:) = stress(:last) - slope*strain
   end subroutine cut

   !> Yield stress and its slopes
   pure subroutine yield_stress(self, strain, rate, yield, hardening, viscosity)
      class(plastic_curve_type), intent(in) :: self
      real(wp), intent(in) :: strain(lanes), rate(lanes)
      real(wp), intent(out) :: yield(lanes), hardening(lanes), viscosity(lanes)

      call look_up(size(self%slope, 2), self%start, self%offset(:, :, 1), self%slope(:, :, 1), &
         & strain, yield, hardening)
      viscosity(:) = 0.0_wp
      if (size(self%slope, 3) > 1) then
         call interpolate_rates(self, strain, rate, yield, hardening, viscosity)
      end if
      if (self%rate%acts) call self%rate%raise(rate, yield, hardening, viscosity)
   end subroutine yield_stress

   !> Yield stress and hardening of one curve
   pure subroutine look_up(segments, start, offset, slope, strain, yield, hardening)
      !> Number of segments
      integer, intent(in) :: segments
      !> Effective plastic strain where they start
      real(wp), intent(in) :: start(lanes, segments)
      !> Yield stress of their lines at no strain, and rise along them
      real(wp), intent(in) :: offset(lanes, segments), slope(lanes, segments)
      !> Effective plastic strain
      real(wp), intent(in) :: strain(lanes)
      !> Yield stress, and its derivative by effective plastic strain
      real(wp), intent(out) :: yield(lanes), hardening(lanes)

      real(wp) :: at_none(lanes)
      integer :: k, l

      at_none(:) = offset(:, 1)
      hardening(:) = slope(:, 1)
      do k = 2, segments
         !$omp simd
         do l = 1, lanes
            at_none(l) = merge(offset(l, k), at_none(l), start(l, k) <= strain(l))
            hardening(l) = merge(slope(l, k), hardening(l), start(l, k) <= strain(l))
         end do
      end do
      do l = 1, lanes
         yield(l) = at_none(l) + hardening(l)*strain(l)
      end do
   end subroutine look_up

   !> Go from the first curve towards those of higher rates, as far as the rate has gone
   pure subroutine interpolate_rates(self, strain, rate, yield, hardening, viscosity)
      class(plastic_curve_type), intent(in) :: self
      !> Effective plastic strain; its rate
      real(wp), intent(in) :: strain(lanes), rate(lanes)
      !> Yield stress, and its derivative by effective plastic strain: of the first curve in
      real(wp), intent(inout) :: yield(lanes), hardening(lanes)
      !> Derivative of the yield stress by the rate
      real(wp), intent(out) :: viscosity(lanes)

      real(wp) :: above(lanes), below(lanes), flatter(lanes), rate_measure(lanes), steeper(lanes)
      real(wp) :: steep(lanes)
      integer :: c

      rate_measure(:) = rate
      steep(:) = 1.0_wp
      if (any(self%logarithmic)) then
         rate_measure(:) = merge(log(max(rate, least_rate)), rate, self%logarithmic)
         steep(:) = merge(1.0_wp/max(rate, least_rate), 1.0_wp, self%logarithmic)
      end if
      viscosity(:) = 0.0_wp
      below(:) = yield
      flatter(:) = hardening
      do c = 2, size(self%slope, 3)
         call look_up(size(self%slope, 2), self%start, self%offset(:, :, c), &
            & self%slope(:, :, c), strain, above, steeper)
         call add_rate_interval(self%from(:, c), self%inverse_length(:, c), rate_measure, &
            & above - below, steeper - flatter, yield, hardening, viscosity)
         below(:) = above
         flatter(:) = steeper
      end do
      viscosity(:) = steep*viscosity
   end subroutine interpolate_rates

   !> Add the change from one curve to the next, the part of it below the rate
   pure subroutine add_rate_interval(from, inverse_length, rate_measure, rise, steepening, &
      & yield, hardening, viscosity)
      !> Where the change starts, and one over its length
      real(wp), intent(in) :: from(lanes), inverse_length(lanes)
      !> Rate, or its logarithm
      real(wp), intent(in) :: rate_measure(lanes)
      !> What yield stress and hardening grow by from curve to curve
      real(wp), intent(in) :: rise(lanes), steepening(lanes)
      !> Sums of yield stress, hardening, and derivative by the rate or its logarithm
      real(wp), intent(inout) :: yield(lanes), hardening(lanes), viscosity(lanes)

      real(wp) :: share
      integer :: l

      do l = 1, lanes
         share = (rate_measure(l) - from(l))*inverse_length(l)
         viscosity(l) = viscosity(l) &
            & + merge(rise(l)*inverse_length(l), 0.0_wp, share >= 0.0_wp .and. share < 1.0_wp)
         share = min(max(share, 0.0_wp), 1.0_wp)
         yield(l) = yield(l) + share*rise(l)
         hardening(l) = hardening(l) + share*steepening(l)
      end do
   end subroutine add_rate_interval

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

end module plydyn_law_metal_tabulated
