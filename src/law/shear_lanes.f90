!> Shear in the plane of some plies up to the first matrix crack, along their curves.
!>
!> Stress follows the curve while the strain grows beyond all it has been, to either side. Below
!> that it unloads with the first modulus down to the strain that stays, and is zero between
!> there and its mirror image (the paper's eqs 7 and 8, the sign of the strain put in).
module plydyn_law_shear_lanes
   use plydyn_base_precision, only : lanes, wp
   use plydyn_law_shear_curve, only : shape_exponential, shape_line, shape_power, shape_table, &
      & shear_curve_type
   implicit none
   private

   !> Curves of the lanes of a batch
   type, public :: shear_lanes_type
      private
      !> Shape of each lane
      integer :: shape(lanes) = shape_line
      !> 1 in lanes with a curve that is no line, else 0
      real(wp), public :: curved(lanes) = 0.0_wp
      !> Whether any lane has a shape, by shape
      logical :: has(shape_exponential:shape_power) = .false.
      !> Modulus at the origin, and its inverse
      real(wp) :: modulus(lanes) = 1.0_wp, compliance(lanes) = 1.0_wp
      !> Modulus where the curve is a line, 0 elsewhere
      real(wp) :: straight(lanes) = 0.0_wp
      !> Stress that an exponential tends to, 0 for other shapes, and the rate at which it does:
      !> modulus/asymptote
      real(wp) :: asymptote(lanes) = 0.0_wp, rate(lanes) = 0.0_wp
      !> Growth of the strain up to which `go_on` has all digits in all lanes
      real(wp) :: short = huge(1.0_wp)
      !> Ramberg and Osgood
      real(wp) :: coefficient(lanes) = 0.0_wp, exponent(lanes) = 1.0_wp
      !> Strains where a table bends, and change of its slope there, (lanes, points)
      real(wp), allocatable :: bend(:, :), change(:, :)
   contains
      procedure :: set_lane
      procedure :: advance
      procedure :: grow
      procedure :: curve_stress
   end type shear_lanes_type

   !> Relative change of stress that ends the search on a power curve, and most steps of it
   real(wp), parameter :: close_enough = 1.0e-13_wp
   integer, parameter :: most_steps = 100
   !> Where 1 - exp(-x) is 1 to the last digit, and the series of (1 - exp(-x))/x: -1/2!, 1/3!, ...
   real(wp), parameter :: beyond_rise = 40.0_wp
   real(wp), parameter :: series(9) = 1.0_wp/[-2.0_wp, 6.0_wp, -24.0_wp, 120.0_wp, -720.0_wp, &
      & 5040.0_wp, -40320.0_wp, 362880.0_wp, -3628800.0_wp]
   !> Where the first four of these give it to the last digit
   real(wp), parameter :: short_way = 1.0e-3_wp

contains

   !> Give a lane its curve
   pure subroutine set_lane(self, lane, modulus, curve)
      class(shear_lanes_type), intent(inout) :: self
      !> Lane
      integer, intent(in) :: lane
      !> Shear modulus at the origin
      real(wp), intent(in) :: modulus
      !> Its curve
      type(shear_curve_type), intent(in) :: curve

      self%shape(lane) = curve%shape
      self%modulus(lane) = modulus
      self%compliance(lane) = 1.0_wp/modulus
      self%straight(lane) = merge(modulus, 0.0_wp, curve%shape == shape_line)
      if (curve%shape == shape_line) return
      self%has(curve%shape) = .true.
      self%curved(lane) = 1.0_wp
      if (curve%shape /= shape_exponential) self%short = 0.0_wp
      select case (curve%shape)
      case (shape_exponential)
         self%asymptote(lane) = curve%asymptote
         self%rate(lane) = modulus/curve%asymptote
         self%short = min(self%short, short_way/self%rate(lane))
      case (shape_table)
         call set_table(self, lane, curve%strain, curve%stress)
      case default
         self%coefficient(lane) = curve%coefficient
         self%exponent(lane) = curve%exponent
      end select
   end subroutine set_lane

   !> Keep a table as a sum of ramps: where it bends and by how much
   pure subroutine set_table(self, lane, strain, stress)
      class(shear_lanes_type), intent(inout) :: self
      integer, intent(in) :: lane
      real(wp), intent(in) :: strain(:), stress(:)

      real(wp), allocatable :: bend(:, :), change(:, :)
      real(wp) :: before, slope
      integer :: i, known

      known = 0
      if (allocated(self%bend)) known = size(self%bend, 2)
      allocate (bend(lanes, max(known, size(strain) - 1)), source=0.0_wp)
      allocate (change, source=bend)
      if (known > 0) then
         bend(:, :known) = self%bend
         change(:, :known) = self%change
      end if
      bend(lane, :) = 0.0_wp
      change(lane, :) = 0.0_wp
      before = 0.0_wp
      do i = 1, size(strain) - 1
         slope = (stress(i + 1) - stress(i))/(strain(i + 1) - strain(i))
         bend(lane, i) = strain(i)
         change(lane, i) = slope - before
         before = slope
      end do
      call move_alloc(bend, self%bend)
      call move_alloc(change, self%change)
   end subroutine set_table

   !> Follow the curve where the strain has grown: largest strain, strain that stays, work lost
   pure subroutine advance(self, points, strain, peak, set, work, grows)
      class(shear_lanes_type), intent(in) :: self
      !> Number of points
      integer, intent(in) :: points
      !> Size of the shear strain; 0 where nothing is to change
      real(wp), intent(in) :: strain(lanes, points)
      !> Largest size of the shear strain so far
      real(wp), intent(inout) :: peak(lanes, points)
      !> Shear strain that stays on unloading
      real(wp), intent(inout) :: set(lanes, points)
      !> Work per volume spent on what stays
      real(wp), intent(out) :: work(lanes, points)
      !> Whether any strain is larger than it has been
      logical, intent(out) :: grows

      real(wp) :: ahead(lanes), most
      integer :: l, m

      ahead(:) = 0.0_wp
      do m = 1, points
         !$omp simd
         do l = 1, lanes
            ! nothing changes along a line
            ahead(l) = max(ahead(l), self%curved(l)*(strain(l, m) - peak(l, m)))
         end do
      end do
      most = 0.0_wp
      !$omp simd reduction(max:most)
      do l = 1, lanes
         most = max(most, ahead(l))
      end do
      grows = most > 0.0_wp
      if (grows) then
         call self%grow(points, most, strain, peak, set, work)
      else
         work(:, :) = 0.0_wp
      end if
   end subroutine advance

   !> `advance` where the largest growth of the strain is known, which is more than 0
   pure subroutine grow(self, points, most, strain, peak, set, work)
      class(shear_lanes_type), intent(in) :: self
      !> As in `advance`
      integer, intent(in) :: points
      !> Largest growth of the strain in all lanes at all points
      real(wp), intent(in) :: most
      !> As in `advance`
      real(wp), intent(in) :: strain(lanes, points)
      real(wp), intent(inout) :: peak(lanes, points), set(lanes, points)
      real(wp), intent(out) :: work(lanes, points)

      if (most <= self%short) then
         call go_on(self, points, strain, peak, set, work)
      else
         call start_anew(self, points, strain, peak, set, work)
      end if
   end subroutine grow

   !> A short way along exponentials, from where they have been left: of the growth g of the strain
   !> stays q + y - q*y, with q = stress/asymptote before it and y = 1 - (1 - exp(-x))/x of
   !> x = g*modulus/asymptote. Exact but for round-off, and nothing cancels
   pure subroutine go_on(self, points, strain, peak, set, work)
      class(shear_lanes_type), intent(in) :: self
      !> As in `advance`
      integer, intent(in) :: points
      real(wp), intent(in) :: strain(lanes, points)
      real(wp), intent(inout) :: peak(lanes, points), set(lanes, points)
      real(wp), intent(out) :: work(lanes, points)

      real(wp) :: before, growth, stays, x, y
      integer :: l, m

      do m = 1, points
         !$omp simd private(before, growth, stays, x, y)
         do l = 1, lanes
            before = peak(l, m) - set(l, m)
            growth = max(self%curved(l)*strain(l, m) - peak(l, m), 0.0_wp)
            x = self%rate(l)*growth
            y = -x*(series(1) + x*(series(2) + x*(series(3) + x*series(4))))
            stays = growth*(y + (1.0_wp - y)*self%rate(l)*before)
            work(l, m) = self%modulus(l)*stays*(before + 0.5_wp*(growth - stays))
            set(l, m) = set(l, m) + stays
            peak(l, m) = max(self%curved(l)*strain(l, m), peak(l, m))
         end do
      end do
   end subroutine go_on

   !> Any way along any curve
   pure subroutine start_anew(self, points, strain, peak, set, work)
      class(shear_lanes_type), intent(in) :: self
      !> As in `advance`
      integer, intent(in) :: points
      real(wp), intent(in) :: strain(lanes, points)
      real(wp), intent(inout) :: peak(lanes, points), set(lanes, points)
      real(wp), intent(out) :: work(lanes, points)

      real(wp) :: grown(lanes, points), kept, stress(lanes, points)
      integer :: l, m

      do m = 1, points
         grown(:, m) = max(peak(:, m), self%curved*strain(:, m))
      end do
      call self%curve_stress(points, grown, set, stress)
      do m = 1, points
         !$omp simd private(kept)
         do l = 1, lanes
            kept = max(set(l, m), grown(l, m) - stress(l, m)*self%compliance(l))
            kept = merge(kept, set(l, m), grown(l, m) > peak(l, m))
            work(l, m) = 0.5_wp*(kept - set(l, m)) &
               & *(stress(l, m) + self%modulus(l)*(peak(l, m) - set(l, m)))
            set(l, m) = kept
            peak(l, m) = grown(l, m)
         end do
      end do
   end subroutine start_anew

   !> Stress on the curve: a sum, in which what belongs to other shapes is zero
   pure subroutine curve_stress(self, points, strain, set, stress)
      class(shear_lanes_type), intent(in) :: self
      !> Number of points
      integer, intent(in) :: points
      !> Size of the shear strain
      real(wp), intent(in) :: strain(lanes, points)
      !> A strain that the curve leaves behind on the way there, to start a search from
      real(wp), intent(in) :: set(lanes, points)
      !> Stress
      real(wp), intent(out) :: stress(lanes, points)

      integer :: k, l, m

      do m = 1, points
         !$omp simd
         do l = 1, lanes
            stress(l, m) = self%straight(l)*strain(l, m) &
               & + self%asymptote(l)*rise_to_one(self%rate(l)*strain(l, m))
         end do
         if (self%has(shape_table)) then
            do k = 1, size(self%bend, 2)
               stress(:, m) = stress(:, m) &
                  & + self%change(:, k)*max(strain(:, m) - self%bend(:, k), 0.0_wp)
            end do
         end if
         if (self%has(shape_power)) then
            call find_power_stress(self, strain(:, m), set(:, m), stress(:, m))
         end if
      end do
   end subroutine curve_stress

   !> 1 - exp(-x) for x of 0 or more, with all digits but the last two, be x ever so small: the
   !> series for a 32nd part of x, then 1 - exp(-2y) = (1 - exp(-y))*(2 - (1 - exp(-y))) five times.
   !> Arithmetic alone, the same in every lane, where a function of the library would be a call
   pure real(wp) function rise_to_one(x) result(rise)
      !> A number, 0 or more
      real(wp), intent(in) :: x

      real(wp) :: part

      part = min(x, beyond_rise)/32.0_wp
      rise = part*(1.0_wp + part*(series(1) + part*(series(2) + part*(series(3) + part*(series(4) &
         & + part*(series(5) + part*(series(6) + part*(series(7) + part*(series(8) &
         & + part*series(9))))))))))
      rise = rise*(2.0_wp - rise)
      rise = rise*(2.0_wp - rise)
      rise = rise*(2.0_wp - rise)
      rise = rise*(2.0_wp - rise)
      rise = rise*(2.0_wp - rise)
   end function rise_to_one

   !> Stress of Ramberg and Osgood by Newton's method, from the elastic guess above it
   pure subroutine find_power_stress(self, strain, set, stress)
      class(shear_lanes_type), intent(in) :: self
      real(wp), intent(in) :: strain(lanes), set(lanes)
      real(wp), intent(inout) :: stress(lanes)

      real(wp) :: bent, change, found(lanes), most
      integer :: i, l

      found(:) = self%modulus*max(strain - set, 0.0_wp)
      do i = 1, most_steps
         most = 0.0_wp
         associate (coefficient => self%coefficient, exponent => self%exponent, &
            & modulus => self%modulus)
            !$omp simd reduction(max:most) private(bent, change)
            do l = 1, lanes
               bent = coefficient(l)*found(l)**(exponent(l) - 1.0_wp)
               change = (found(l)*(1.0_wp + bent) - modulus(l)*strain(l)) &
                  & /(1.0_wp + exponent(l)*bent)
               most = max(most, abs(change) - close_enough*found(l))
               found(l) = max(found(l) - change, 0.0_wp)
            end do
         end associate
         if (.not. most > 0.0_wp) exit
      end do
      stress(:) = merge(found, stress, self%shape == shape_power)
   end subroutine find_power_stress

end module plydyn_law_shear_lanes
