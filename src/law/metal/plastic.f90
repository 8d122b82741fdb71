!> Metal plasticity (von Mises, associated) in three dimensions, by radial return.
!>
!> Stress is elastic in strain less plastic strain, and plastic strain grows along the relative
!> stress (deviatoric stress less back stress) so that the effective relative stress never exceeds
!> the yield stress. What a material adds is its yield stress, as a function of effective plastic
!> strain and its rate. Hardening that moves the yield surface is linear (Prager): the back stress
!> is two thirds of the kinematic modulus times the plastic strain, and needs no history.
!>
!> Energy per volume: work of the stress = what unloading gives back (elastic, and what the back
!> stress stores: a third of the kinematic modulus times the plastic strain squared) + the last
!> history variable, the yield stress integrated over effective plastic strain.
!> All that isotropic hardening and rate take counts as dissipated: nothing gives it back.
module plydyn_law_metal_plastic
   use plydyn_base_precision, only : lanes, wp
   use plydyn_law_law, only : by_metal_plasticity, law_constants_type, law_type, scalars, &
      & shows_dissipated, shows_plastic_strain
   implicit none
   private

   !> History variables: the first of six of plastic strain, in the order and with the engineering
   !> shear of strain; effective plastic strain; energy dissipated per volume
   integer, parameter, public :: plastic_strain = 1, effective_plastic_strain = 7, dissipated = 8
   !> How many there are
   integer, parameter :: histories = dissipated

   !> Share of the stress by which it may miss the yield surface
   real(wp), parameter :: tolerance = 1.0e-12_wp
   !> Between the values of a mask
   real(wp), parameter :: half = 0.5_wp
   !> Steps of the search: 6 are usual, 40 are needed over 60 decades
   integer, parameter :: steps_allowed = 100
   !> Most that hardening may count at the start, as a multiple of stiffness: powers start upright
   real(wp), parameter :: most_hardening = 10.0_wp
   !> Largest change in one step of the search, as the logarithm of the increment
   real(wp), parameter :: longest_step = 50.0_wp
   !> Least share of the stress to take away that an increment takes for certain
   real(wp), parameter :: least_taken = 1.0e-3_wp
   !> Share of its upper bound under which the search does not fall by halving
   real(wp), parameter :: least_share = 1.0e-6_wp

   !> Constants of a metal; the yield stress is left to its law
   type, abstract, public, extends(law_constants_type) :: metal_constants_type
   contains
      procedure :: shows
   end type metal_constants_type

   !> Elastic constants and kinematic hardening; the yield stress is left to the material
   type, abstract, public, extends(law_type) :: plastic_type
      !> Bulk and shear modulus; rise of the back stress over plastic strain in tension
      real(wp) :: bulk(lanes) = 1.0_wp, shear(lanes) = 1.0_wp, kinematic(lanes) = 0.0_wp
      !> 1 in the lanes of this law, 0 in others: a mask that runs side by side with reals
      real(wp) :: owned(lanes) = 0.0_wp
      !> Smallest yield stress there can be: nothing flows below it
      real(wp) :: onset(lanes) = huge(1.0_wp)
   contains
      procedure :: update
      procedure :: update_points
      procedure :: stress_at
      procedure :: output_variables
      procedure :: stored_energy
      procedure :: own_lane
      procedure :: search
      procedure :: flow => search
      procedure(yield_batch), deferred :: yield_stress
   end type plastic_type

   abstract interface
      !> Yield stress and its slopes
      pure subroutine yield_batch(self, strain, rate, yield, hardening, viscosity)
         import :: lanes, plastic_type, wp
         implicit none
         class(plastic_type), intent(in) :: self
         !> Effective plastic strain, and its rate; 0 without time
         real(wp), intent(in) :: strain(lanes), rate(lanes)
         !> Yield stress; its derivatives by effective plastic strain and by the rate
         real(wp), intent(out) :: yield(lanes), hardening(lanes), viscosity(lanes)
      end subroutine yield_batch
   end interface

contains

   !> Scalars that the law has for the fields
   pure function shows(self)
      class(metal_constants_type), intent(in) :: self
      logical :: shows(scalars)

      shows(:) = .false.
      shows([shows_plastic_strain, shows_dissipated]) = .true.
   end function shows

   !> Give a lane to this law
   pure subroutine own_lane(self, lane, metal, onset)
      class(plastic_type), intent(inout) :: self
      !> Place in the batch
      integer, intent(in) :: lane
      !> Its metal
      class(metal_constants_type), intent(in) :: metal
      !> Smallest yield stress
      real(wp), intent(in) :: onset

      self%owns(lane) = .true.
      self%owned(lane) = 1.0_wp
      self%histories = histories
      self%energy_variable(by_metal_plasticity) = histories
      associate (young => metal%young(1), poisson => metal%poisson(1))
         self%bulk(lane) = young/(3.0_wp*(1.0_wp - 2.0_wp*poisson))
         self%shear(lane) = young/(2.0_wp*(1.0_wp + poisson))
      end associate
      self%onset(lane) = onset
   end subroutine own_lane

   !> Scalars of a lane that its fields show
   pure function output_variables(self, lane, history) result(values)
      class(plastic_type), intent(in) :: self
      integer, intent(in) :: lane
      real(wp), intent(in) :: history(lanes, *)
      real(wp) :: values(scalars)

      values(:) = 0.0_wp
      values(shows_plastic_strain) = history(lane, effective_plastic_strain)
      values(shows_dissipated) = history(lane, dissipated)
   end function output_variables

   !> Energy per volume that unloading gives back, elastic and by the back stress
   pure function stored_energy(self, strain, history) result(energy)
      class(plastic_type), intent(in) :: self
      real(wp), intent(in) :: strain(lanes, 6), history(lanes, *)
      real(wp) :: energy(lanes), stress(lanes, 6)
      integer :: l

      stress(:, :) = 0.0_wp
      call self%stress_at(strain, history, stress)
      do l = 1, lanes
         energy(l) = 0.5_wp*sum(stress(l, :)*(strain(l, :) - history(l, :6))) &
            & + self%kinematic(l)/3.0_wp*norm_squared(history(l, :6))
      end do
   end function stored_energy

   !> Stress and history at the end of a step
   pure subroutine update(self, step, strain, history, stress)
      class(plastic_type), intent(in) :: self
      real(wp), intent(in) :: step, strain(lanes, 6)
      real(wp), intent(inout) :: history(lanes, *), stress(lanes, 6)

      logical :: flows

      call update_point(self, step, strain, history, stress, flows)
   end subroutine update

   !> The same for some points of an element, of which few may flow
   pure subroutine update_points(self, points, pitch, step, strain, history, stress)
      class(plastic_type), intent(in) :: self
      integer, intent(in) :: points, pitch
      real(wp), intent(in) :: step, strain(lanes, 6, points)
      real(wp), intent(inout) :: history(lanes, pitch, *), stress(lanes, 6, points)

      real(wp) :: h(lanes, histories)
      integer :: m
      logical :: flows

      do m = 1, points
         h(:, :) = history(:, m, :histories)
         call update_point(self, step, strain(:, :, m), h, stress(:, :, m), flows)
         if (flows) history(:, m, :histories) = h
      end do
   end subroutine update_points

   !> Stress and history of a point, and whether it flows in any lane
   pure subroutine update_point(self, step, strain, history, stress, flows)
      class(plastic_type), intent(in) :: self
      real(wp), intent(in) :: step, strain(lanes, 6)
      real(wp), intent(inout) :: history(lanes, histories), stress(lanes, 6)
      logical, intent(out) :: flows

      real(wp) :: before(lanes), effective(lanes), increment(lanes), relative(lanes, 6)
      real(wp) :: resistance(lanes)

      call find_trial_stress(self%shear, self%kinematic, strain, history, relative, effective)
      flows = any(effective > self%onset)
      if (flows) then
         before(:) = merge(history(:, effective_plastic_strain), 0.0_wp, self%owned > half)
         call self%flow(step, effective, before, increment, resistance)
         call advance(relative, effective, increment, resistance, history)
      end if
      call find_stress(self%owned, self%bulk, self%shear, strain, history, stress)
   end subroutine update_point

   !> Stress that belongs to a strain and its history, also where a rate has raised it
   pure subroutine stress_at(self, strain, history, stress)
      class(plastic_type), intent(in) :: self
      real(wp), intent(in) :: strain(lanes, 6), history(lanes, *)
      real(wp), intent(inout) :: stress(lanes, 6)

      call find_stress(self%owned, self%bulk, self%shear, strain, history, stress)
   end subroutine stress_at

   !> A strain, as a tensor, times itself
   pure real(wp) function norm_squared(strain)
      !> With engineering shear
      real(wp), intent(in) :: strain(6)

      norm_squared = sum(strain(:3)**2) + 0.5_wp*sum(strain(4:)**2)
   end function norm_squared

   !> Relative stress if nothing flowed, and its effective value
   pure subroutine find_trial_stress(shear, kinematic, strain, history, relative, effective)
      !> Shear modulus and kinematic modulus
      real(wp), intent(in) :: shear(lanes), kinematic(lanes)
      !> Total strain; history before the step
      real(wp), intent(in) :: strain(lanes, 6), history(lanes, histories)
      !> Deviatoric stress less back stress; its von Mises value
      real(wp), intent(out) :: relative(lanes, 6), effective(lanes)

      real(wp) :: both(lanes), mean(lanes), normal(lanes), sheared(lanes)
      integer :: i, l

      do l = 1, lanes
         mean(l) = (strain(l, 1) + strain(l, 2) + strain(l, 3))/3.0_wp
         both(l) = 2.0_wp*shear(l) + 2.0_wp/3.0_wp*kinematic(l)
         normal(l) = 0.0_wp
         sheared(l) = 0.0_wp
      end do
      do i = 1, 3
         do l = 1, lanes
            relative(l, i) = 2.0_wp*shear(l)*(strain(l, i) - mean(l)) - both(l)*history(l, i)
            normal(l) = normal(l) + relative(l, i)**2
         end do
      end do
      do i = 4, 6
         do l = 1, lanes
            relative(l, i) = shear(l)*strain(l, i) - 0.5_wp*both(l)*history(l, i)
            sheared(l) = sheared(l) + relative(l, i)**2
         end do
      end do
      do l = 1, lanes
         effective(l) = sqrt(1.5_wp*normal(l) + 3.0_wp*sheared(l))
      end do
   end subroutine find_trial_stress

   !> Plastic strain and dissipation of an increment along the relative stress
   pure subroutine advance(relative, effective, increment, resistance, history)
      !> Relative stress if nothing flowed, and its effective value
      real(wp), intent(in) :: relative(lanes, 6), effective(lanes)
      !> Increment of effective plastic strain; 0 in lanes that do not flow
      real(wp), intent(in) :: increment(lanes)
      !> Mean yield stress over the increment
      real(wp), intent(in) :: resistance(lanes)
      !> History of the point
      real(wp), intent(inout) :: history(lanes, histories)

      real(wp) :: along(lanes)
      integer :: i, l

      do l = 1, lanes
         along(l) = 1.5_wp*increment(l)/max(effective(l), tiny(1.0_wp))
         history(l, effective_plastic_strain) = history(l, effective_plastic_strain) + increment(l)
         history(l, dissipated) = history(l, dissipated) + resistance(l)*increment(l)
      end do
      do i = 1, 3
         do l = 1, lanes
            history(l, i) = history(l, i) + along(l)*relative(l, i)
         end do
      end do
      do i = 4, 6
         do l = 1, lanes
            history(l, i) = history(l, i) + 2.0_wp*along(l)*relative(l, i)
         end do
      end do
   end subroutine advance

   !> Stress of the elastic part of strain, in the lanes of this law
   pure subroutine find_stress(owned, bulk, shear, strain, history, stress)
      !> 1 in lanes of this law; bulk and shear modulus
      real(wp), intent(in) :: owned(lanes), bulk(lanes), shear(lanes)
      !> Total strain; history after the step
      real(wp), intent(in) :: strain(lanes, 6), history(lanes, histories)
      !> Stress
      real(wp), intent(inout) :: stress(lanes, 6)

      real(wp) :: new, pressed(lanes), volume
      integer :: i, l

      do l = 1, lanes
         volume = strain(l, 1) + strain(l, 2) + strain(l, 3)
         pressed(l) = (bulk(l) - 2.0_wp/3.0_wp*shear(l))*volume
      end do
      do i = 1, 3
         !$omp simd
         do l = 1, lanes
            new = pressed(l) + 2.0_wp*shear(l)*(strain(l, i) - history(l, i))
            stress(l, i) = merge(new, stress(l, i), owned(l) > half)
         end do
      end do
      do i = 4, 6
         !$omp simd
         do l = 1, lanes
            new = shear(l)*(strain(l, i) - history(l, i))
            stress(l, i) = merge(new, stress(l, i), owned(l) > half)
         end do
      end do
   end subroutine find_stress

   !> Increment of effective plastic strain that brings the stress back to the yield surface, for
   !> any yield stress: Newton's method within bounds, for the logarithm of the resistance over
   !> that of the increment. Powers of strain and of rate are straight lines there, and the way
   !> over many decades is short.
   pure subroutine search(self, step, effective, before, increment, resistance)
      class(plastic_type), intent(in) :: self
      real(wp), intent(in) :: step
      !> Effective relative stress if nothing flowed; effective plastic strain before the step
      real(wp), intent(in) :: effective(lanes), before(lanes)
      !> Its increment; 0 in lanes that do not flow
      real(wp), intent(out) :: increment(lanes)
      !> Mean yield stress over the increment
      real(wp), intent(out) :: resistance(lanes)

      real(wp) :: beyond(lanes), excess(lanes), flows(lanes), hardening(lanes), least(lanes)
      real(wp) :: most(lanes), per_step, slope(lanes), viscosity(lanes), yield(lanes)
      integer :: i

      per_step = 0.0_wp
      if (step > 0.0_wp) per_step = 1.0_wp/step
      call self%yield_stress(before, spread(0.0_wp, 1, lanes), yield, hardening, viscosity)
      ! from the tangent at the start, and below the increment that would leave no stress
      slope(:) = 3.0_wp*self%shear + self%kinematic
      beyond(:) = max(effective - yield, tolerance*yield)
      flows(:) = merge(self%owned, 0.0_wp, effective - yield > tolerance*effective)
      increment(:) = beyond/(slope + min(max(hardening, 0.0_wp), most_hardening*slope))
      least(:) = 0.0_wp
      most(:) = effective/slope
      do i = 1, steps_allowed
         call self%yield_stress(before + increment, per_step*increment, yield, hardening, viscosity)
         excess(:) = flows*(effective - slope*increment - yield)
         excess(:) = merge(excess, 0.0_wp, abs(excess) > tolerance*effective)
         if (all(abs(excess) <= 0.0_wp)) exit
         call take_newton_step(beyond, excess, slope + hardening + per_step*viscosity, least, &
            & most, increment)
      end do
      increment(:) = flows*increment
      resistance(:) = yield - 0.5_wp*hardening*increment
   end subroutine search

   !> One step of the search
   pure subroutine take_newton_step(beyond, excess, slope, least, most, increment)
      !> Stress that the increment must take away
      real(wp), intent(in) :: beyond(lanes)
      !> What it leaves of that; 0 in lanes that have arrived
      real(wp), intent(in) :: excess(lanes)
      !> Fall of the excess over the increment
      real(wp), intent(in) :: slope(lanes)
      !> Bounds of the increment
      real(wp), intent(inout) :: least(lanes), most(lanes)
      !> Increment
      real(wp), intent(inout) :: increment(lanes)

      real(wp) :: far, growth, higher, logarithm, lower, next, now, taken, w
      integer :: l

      !$omp simd
      do l = 1, lanes
         now = increment(l)
         lower = merge(now, least(l), excess(l) > 0.0_wp)
         higher = merge(most(l), now, excess(l) > 0.0_wp)
         ! logarithm and exponential by as many terms as keep the order of the method
         taken = max(beyond(l) - excess(l), least_taken*beyond(l))
         w = abs(beyond(l) - taken)/(beyond(l) + taken)
         logarithm = 2.0_wp*w*(1.0_wp + w**2*(1.0_wp/3.0_wp + w**2/5.0_wp))
         far = min(logarithm*abs(taken/(slope(l)*now)), longest_step)/8.0_wp
         growth = (1.0_wp + far*(1.0_wp + far/2.0_wp*(1.0_wp + far/3.0_wp)))**8
         next = merge(now*growth, now/growth, excess(l) > 0.0_wp)
         ! half way, in the logarithm, when the slope misleads
         w = max(sqrt(lower*higher), least_share*higher)
         next = merge(next, w, next > lower .and. next < higher .and. slope(l) > 0.0_wp)
         increment(l) = merge(next, now, abs(excess(l)) > 0.0_wp)
         least(l) = lower
         most(l) = higher
      end do
   end subroutine take_newton_step

end module plydyn_law_metal_plastic
