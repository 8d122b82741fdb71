!> Shear in the plane of some plies up to the first matrix crack, along their curves.
!>
!> Stress follows the curve while the strain is the largest so far, in either sense. Below that it
!> unloads with the first modulus down to the permanent strain, and is zero between there and its
!> mirror image (the paper's eqs 7 and 8, with the sign of the strain).
!>
!> The history needs the largest strain only: the permanent strain and the plastic work follow. The
!> permanent strain is needed in every step and is a history variable, too; the work is not. A law
!> that knows the stress of yield in its place asks for `curve_strain`.
module plydyn_law_ply_batch_shear
   use plydyn_base_precision, only : lanes, wp
   use plydyn_law_ply_shear_curve, only : shape_exponential, shape_line, shape_power, shape_table, &
      & shear_curve_type, table_slopes
   implicit none
   private

   !> Curves of the lanes of a batch
   type, public :: batch_shear_type
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
      !> Stress that an exponential tends to, 0 for other shapes, the rate at which it does,
      !> modulus/asymptote, and 1 over that
      real(wp) :: asymptote(lanes) = 0.0_wp, rate(lanes) = 0.0_wp, yield_strain(lanes) = 0.0_wp
      !> Ramberg and Osgood
      real(wp) :: coefficient(lanes) = 0.0_wp, exponent(lanes) = 1.0_wp
      !> Strains where a table bends, and change of its slope there, (lanes, points)
      real(wp), allocatable :: bend(:, :), change(:, :)
      !> Stresses where it bends, and change there of the slope of its permanent strain over stress
      real(wp), allocatable :: knee(:, :), give(:, :)
   contains
      procedure :: set_lane
      procedure :: find_set
      procedure :: plastic_work
      procedure :: curve_stress
      procedure :: curve_strain
   end type batch_shear_type

   !> Least slope of a table, of which the strain at a stress is asked, as a share of the modulus
   real(wp), parameter :: least_slope = 1.0e-9_wp
   !> Relative change of stress that ends the search on a power curve, and most steps of it
   real(wp), parameter :: stress_tolerance = 1.0e-13_wp
   integer, parameter :: most_steps = 100
   !> Where 1 - exp(-x) is 1 to the last digit, and the series of (1 - exp(-x))/x: -1/2!, 1/3!, ...
   real(wp), parameter :: saturation = 40.0_wp
   real(wp), parameter :: series(9) = 1.0_wp/[-2.0_wp, 6.0_wp, -24.0_wp, 120.0_wp, -720.0_wp, &
      & 5040.0_wp, -40320.0_wp, 362880.0_wp, -3628800.0_wp]
   !> Up to here these give it to the last digit
   real(wp), parameter :: series_limit = 0.125_wp

contains

   !> Give a lane its curve
   pure subroutine set_lane(self, lane, modulus, curve)
      class(batch_shear_type), intent(inout) :: self
      integer, intent(in) :: lane
      !> Shear modulus at the origin
      real(wp), intent(in) :: modulus
      type(shear_curve_type), intent(in) :: curve

      self%shape(lane) = curve%shape
      self%modulus(lane) = modulus
      self%compliance(lane) = 1.0_wp/modulus
      self%straight(lane) = merge(modulus, 0.0_wp, curve%shape == shape_line)
      if (curve%shape == shape_line) return
      self%has(curve%shape) = .true.
      self%curved(lane) = 1.0_wp
      select case (curve%shape)
      case (shape_exponential)
         self%asymptote(lane) = curve%asymptote
         self%rate(lane) = modulus/curve%asymptote
         self%yield_strain(lane) = curve%asymptote/modulus
      case (shape_table)
         call set_table(self, lane, curve%strain, curve%stress)
      case default
         self%coefficient(lane) = curve%coefficient
         self%exponent(lane) = curve%exponent
      end select
   end subroutine set_lane

   !> Keep a table as a sum of ramps: where it bends and by how much
   pure subroutine set_table(self, lane, strain, stress)
      class(batch_shear_type), intent(inout) :: self
      integer, intent(in) :: lane
      real(wp), intent(in) :: strain(:), stress(:)

      real(wp) :: before, reached, slope, slopes(size(strain) - 1), soft
      integer :: i

      call make_room(self%bend, lane, size(slopes))
      call make_room(self%change, lane, size(slopes))
      call make_room(self%knee, lane, size(slopes))
      call make_room(self%give, lane, size(slopes))
      before = 0.0_wp
      reached = 0.0_wp
      soft = 0.0_wp
      slopes(:) = table_slopes(strain, stress, self%modulus(lane))
      do i = 1, size(slopes)
         self%bend(lane, i) = strain(i)
         self%change(lane, i) = slopes(i) - before
         before = slopes(i)
         self%knee(lane, i) = reached
         reached = reached + slopes(i)*(strain(i + 1) - strain(i))
         slope = max(slopes(i), least_slope*self%modulus(lane))
         self%give(lane, i) = 1.0_wp/slope - self%compliance(lane) - soft
         soft = 1.0_wp/slope - self%compliance(lane)
      end do
   end subroutine set_table

   !> Make room for the lines of a lane, which has none yet
   pure subroutine make_room(table, lane, lines)
      real(wp), allocatable, intent(inout) :: table(:, :)
      integer, intent(in) :: lane, lines

      real(wp), allocatable :: wider(:, :)
      integer :: known

      known = 0
      if (allocated(table)) known = size(table, 2)
      allocate (wider(lanes, max(known, lines)), source=0.0_wp)
      if (known > 0) wider(:, :known) = table
      wider(lane, :) = 0.0_wp
      call move_alloc(wider, table)
   end subroutine make_room

   !> Permanent shear strain that belongs to a largest one
   pure subroutine find_set(self, points, peak, set)
      class(batch_shear_type), intent(in) :: self
      !> Number of points
      integer, intent(in) :: points
      !> Largest size of the shear strain; 0 along a line
      real(wp), intent(in) :: peak(lanes, points)
      !> Permanent strain; in: that before the step, from which a search starts
      real(wp), intent(inout) :: set(lanes, points)

      real(wp) :: each(lanes), farthest
      integer :: l, m

      if (self%has(shape_table) .or. self%has(shape_power)) then
         call search_set(self, points, peak, set)
         return
      end if
      if (.not. self%has(shape_exponential)) then
         set(:, :) = 0.0_wp
         return
      end if
      each(:) = 0.0_wp
      do m = 1, points
         !$omp simd
         do l = 1, lanes
            each(l) = max(each(l), self%rate(l)*peak(l, m))
         end do
      end do
      farthest = 0.0_wp
      !$omp simd reduction(max:farthest)
      do l = 1, lanes
         farthest = max(farthest, each(l))
      end do
      if (farthest <= series_limit) then
         call expand_set(self, points, peak, set)
      else
         do m = 1, points
            !$omp simd
            do l = 1, lanes
               set(l, m) = max(peak(l, m) &
                  & - self%yield_strain(l)*one_minus_exp(self%rate(l)*peak(l, m)), 0.0_wp)
            end do
         end do
      end if
   end subroutine find_set

   !> `find_set` for exponentials not far from the origin: the permanent share of the strain is
   !> 1 - (1 - exp(-x))/x with x = strain*modulus/asymptote
   pure subroutine expand_set(self, points, peak, set)
      class(batch_shear_type), intent(in) :: self
      integer, intent(in) :: points
      real(wp), intent(in) :: peak(lanes, points)
      real(wp), intent(out) :: set(lanes, points)

      real(wp) :: x
      integer :: l, m

      do m = 1, points
         !$omp simd private(x)
         do l = 1, lanes
            x = self%rate(l)*peak(l, m)
            set(l, m) = -peak(l, m)*x*(series(1) + x*(series(2) + x*(series(3) + x*(series(4) &
               & + x*(series(5) + x*(series(6) + x*(series(7) + x*(series(8) + x*series(9)))))))))
         end do
      end do
   end subroutine expand_set

   !> `find_set` for curves of any shape: never less than before
   pure subroutine search_set(self, points, peak, set)
      class(batch_shear_type), intent(in) :: self
      integer, intent(in) :: points
      real(wp), intent(in) :: peak(lanes, points)
      real(wp), intent(inout) :: set(lanes, points)

      real(wp) :: stress(lanes, points)
      integer :: l, m

      call self%curve_stress(points, peak, set, stress)
      do m = 1, points
         !$omp simd
         do l = 1, lanes
            set(l, m) = max(set(l, m), peak(l, m) - stress(l, m)*self%compliance(l))
         end do
      end do
   end subroutine search_set

   !> Plastic work per volume of an intact ply since the beginning: the area under
   !> the curve up to the largest strain, less what unloading from there gives back
   pure function plastic_work(self, peak, set) result(work)
      class(batch_shear_type), intent(in) :: self
      !> Largest strain; permanent strain, as from `find_set`
      real(wp), intent(in) :: peak(lanes), set(lanes)
      real(wp) :: work(lanes)

      real(wp) :: stress(lanes)
      integer :: k

      stress(:) = self%modulus*(peak - set)
      work(:) = self%asymptote*set
      if (self%has(shape_table)) then
         do k = 1, size(self%bend, 2)
            work(:) = work + 0.5_wp*self%change(:, k)*max(peak - self%bend(:, k), 0.0_wp)**2
         end do
      end if
      ! round-off must not make the little that a small strain leaves less than nothing
      work(:) = self%curved*max(work - 0.5_wp*stress**2*self%compliance, 0.0_wp)
      if (self%has(shape_power)) work(:) = merge(stress*set*self%exponent &
         & /(self%exponent + 1.0_wp), work, self%shape == shape_power)
   end function plastic_work

   !> Stress on the curve: a sum, in which what belongs to other shapes is zero
   pure subroutine curve_stress(self, points, strain, set, stress)
      class(batch_shear_type), intent(in) :: self
      !> Number of points
      integer, intent(in) :: points
      !> Size of the shear strain
      real(wp), intent(in) :: strain(lanes, points)
      !> A strain that the curve leaves behind on the way there, to start a search from
      real(wp), intent(in) :: set(lanes, points)
      !> Stress
      real(wp), intent(out) :: stress(lanes, points)

      integer :: l, m

      do m = 1, points
         if (self%has(shape_exponential)) then
            !$omp simd
            do l = 1, lanes
               stress(l, m) = self%straight(l)*strain(l, m) &
                  & + self%asymptote(l)*one_minus_exp(self%rate(l)*strain(l, m))
            end do
         else
            !$omp simd
            do l = 1, lanes
               stress(l, m) = self%straight(l)*strain(l, m)
            end do
         end if
         if (self%has(shape_power)) then
            call find_power_stress(self, strain(:, m), set(:, m), stress(:, m))
         end if
      end do
      if (self%has(shape_table)) call add_ramps(self, points, strain, stress)
   end subroutine curve_stress

   !> Add the ramps of tables, as far as one of the strains has come
   pure subroutine add_ramps(self, points, strain, stress)
      class(batch_shear_type), intent(in) :: self
      integer, intent(in) :: points
      real(wp), intent(in) :: strain(lanes, points)
      real(wp), intent(inout) :: stress(lanes, points)

      real(wp) :: beyond, each(lanes)
      integer :: k, l, m

      do k = 1, size(self%bend, 2)
         each(:) = 0.0_wp
         do m = 1, points
            !$omp simd
            do l = 1, lanes
               each(l) = max(each(l), strain(l, m) - self%bend(l, k))
               stress(l, m) = stress(l, m) &
                  & + self%change(l, k)*max(strain(l, m) - self%bend(l, k), 0.0_wp)
            end do
         end do
         ! strains that have not come to this bend have come to none behind it
         beyond = 0.0_wp
         !$omp simd reduction(max:beyond)
         do l = 1, lanes
            beyond = max(beyond, each(l))
         end do
         if (.not. beyond > 0.0_wp) exit
      end do
   end subroutine add_ramps

   !> Total strain of monotone loading at a stress on the curve, which is not an exponential
   pure function curve_strain(self, stress) result(strain)
      class(batch_shear_type), intent(in) :: self
      !> Size of the stress
      real(wp), intent(in) :: stress(lanes)
      real(wp) :: strain(lanes)

      integer :: k

      strain(:) = self%compliance*stress
      if (self%has(shape_table)) then
         do k = 1, size(self%knee, 2)
            strain(:) = strain + self%give(:, k)*max(stress - self%knee(:, k), 0.0_wp)
         end do
      end if
      if (self%has(shape_power)) strain(:) = strain &
         & + self%compliance*self%coefficient*stress**self%exponent
   end function curve_strain

   !> 1 - exp(-x) for x of 0 or more, with all digits but the last two, be x ever so small: the
   !> series for a 32nd part of x, then 1 - exp(-2y) = (1 - exp(-y))*(2 - (1 - exp(-y))) five times.
   !> Arithmetic alone, the same in every lane, where a function of the library would be a call
   pure real(wp) function one_minus_exp(x) result(rise)
      !> A number, 0 or more
      real(wp), intent(in) :: x

      real(wp) :: part

      part = min(x, saturation)/32.0_wp
      rise = part*(1.0_wp + part*(series(1) + part*(series(2) + part*(series(3) + part*(series(4) &
         & + part*(series(5) + part*(series(6) + part*(series(7) + part*(series(8) &
         & + part*series(9))))))))))
      rise = rise*(2.0_wp - rise)
      rise = rise*(2.0_wp - rise)
      rise = rise*(2.0_wp - rise)
      rise = rise*(2.0_wp - rise)
      rise = rise*(2.0_wp - rise)
   end function one_minus_exp

   !> Stress of Ramberg and Osgood by Newton's method, from the elastic guess above it
   pure subroutine find_power_stress(self, strain, set, stress)
      class(batch_shear_type), intent(in) :: self
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
               most = max(most, abs(change) - stress_tolerance*found(l))
               found(l) = max(found(l) - change, 0.0_wp)
            end do
         end associate
         if (.not. most > 0.0_wp) exit
      end do
      stress(:) = merge(found, stress, self%shape == shape_power)
   end subroutine find_power_stress

end module plydyn_law_ply_batch_shear
