!> Contact of one point with a body that gives no way, with Coulomb friction.
!>
!> The body of a fixture moves as prescribed, so the rows of its points are independent. With the
!> inverse mass M of the point, its gap g along the normal n and its slip s of the step, both of the
!> trial position, the multiplier p (force times the time step squared) satisfies
!> 0 <= p.n, g + n.M p >= 0, and either the slip s + M p is zero along the surface (stick) or the
!> share of p along the surface is against it and mu times p.n (slip). A slip against the share p_t
!> is -k p_t, so that both are (M + k P) p = -(g n + s) with P the projection onto the surface: k is
!> 0 for stick, else such that Coulomb's law holds. The loss is then never negative, p.M p/2 and
!> more, also where M differs between directions and p along the normal makes the point slip.
module plydyn_contact_solve_coulomb
   use plydyn_base_precision, only : wp
   implicit none
   private

   !> Most iterations for the speed that is left
   integer, parameter :: most_iterations = 100
   !> Coefficient of friction beyond which it is no longer one of materials that slide
   real(wp), parameter, public :: largest_friction = 2.0_wp

   !> Friction over the slip, mass, below which there is none: no quotient of them overflows
   real(wp), parameter :: least_ratio = tiny(1.0_wp)/epsilon(1.0_wp)

   public :: limit_friction, solve_row

   !> Friction coefficient that falls with the speed from a static to a dynamic one
   type, public :: friction_type
      !> Coefficients at rest and at high speed
      real(wp) :: static = 0.0_wp, dynamic = 0.0_wp
      !> Exponent of the decay, time/length
      real(wp) :: decay = 0.0_wp
   contains
      procedure :: coefficient
      procedure :: limit
      procedure, private :: sliding_coefficient
   end type friction_type

   !> A point in contact
   type, public :: contact_row_type
      !> Gap of the trial position, negative, length
      real(wp) :: gap = 0.0_wp
      !> Unit normal from the body to the plate
      real(wp) :: normal(3) = 0.0_wp
      !> Motion of the point over the step relative to the body, length
      real(wp) :: motion(3) = 0.0_wp
      !> Velocity of the body over the step
      real(wp) :: velocity(3) = 0.0_wp
      !> Inverse mass along x, y, z, zero where held
      real(wp) :: inverse_mass(3) = 0.0_wp
      !> Multiplier, mass times length
      real(wp) :: multiplier(3) = 0.0_wp
      !> Whether friction is at its limit
      logical :: slides = .false.
   contains
      procedure :: slip
      procedure :: normal_multiplier
   end type contact_row_type

contains

   !> Coefficient at a speed
   pure real(wp) function coefficient(self, speed)
      class(friction_type), intent(in) :: self
      !> Sliding speed, length/time
      real(wp), intent(in) :: speed

      coefficient = self%dynamic + (self%static - self%dynamic)*exp(-self%decay*speed)
   end function coefficient

   !> Coefficient at the speed that it leaves: of several solutions the one nearest to stick
   pure real(wp) function sliding_coefficient(self, speed, ratio) result(mu)
      class(friction_type), intent(in) :: self
      !> Speed without friction, length/time
      real(wp), intent(in) :: speed
      !> Normal multiplier over the one that would stop this speed
      real(wp), intent(in) :: ratio

      real(wp) :: last
      integer :: i

      mu = self%static
      do i = 1, most_iterations
         last = mu
         mu = self%coefficient(speed*max(0.0_wp, 1.0_wp - last*ratio))
         if (abs(mu - last) <= epsilon(mu)) exit
      end do
   end function sliding_coefficient

   !> Multiplier along the surface of a row that answers alike in all directions along it
   !>
   !> It sticks where the static coefficient suffices, else it slides.
   pure subroutine limit(self, slip, compliance, normal_part, dt, tangent, slides)
      class(friction_type), intent(in) :: self
      !> Slip of the step without the multiplier, length
      real(wp), intent(in) :: slip(3)
      !> Slip by a unit multiplier, one over mass
      real(wp), intent(in) :: compliance
      !> Normal multiplier, mass times length
      real(wp), intent(in) :: normal_part
      !> Time step
      real(wp), intent(in) :: dt
      !> The multiplier, mass times length, and whether it is at its limit
      real(wp), intent(out) :: tangent(3)
      logical, intent(out) :: slides

      real(wp) :: distance, mu

      distance = norm2(slip)
      slides = distance > self%static*normal_part*compliance
      tangent(:) = 0.0_wp
      if (.not. slides) then
         if (compliance > 0.0_wp) tangent(:) = -slip/compliance
         return
      end if
      mu = self%sliding_coefficient(distance/dt, normal_part*compliance/distance)
      tangent(:) = -slip*(mu*normal_part/distance)
   end subroutine limit

   !> Multiplier that closes the gap, with stick or slip; none where the point is held along the
   !> normal
   pure subroutine solve_row(row, friction, dt)
      !> The point; gets its multiplier
      type(contact_row_type), intent(inout) :: row
      type(friction_type), intent(in) :: friction
      !> Time step
      real(wp), intent(in) :: dt

      real(wp) :: compliance

      row%multiplier(:) = 0.0_wp
      row%slides = .false.
      compliance = sum(row%inverse_mass*row%normal**2)
      if (compliance <= 0.0_wp) return
      row%multiplier(:) = -row%gap/compliance*row%normal
      if (friction%static > 0.0_wp) call add_friction(row, 0.0_wp, friction, dt)
   end subroutine solve_row

   !> Friction of a point whose normal force is given, along z
   pure subroutine limit_friction(row, normal_part, friction, dt)
      !> The point, with no gap; gets its multiplier
      type(contact_row_type), intent(inout) :: row
      !> Normal force times the time step squared, not negative
      real(wp), intent(in) :: normal_part
      type(friction_type), intent(in) :: friction
      !> Time step
      real(wp), intent(in) :: dt

      row%multiplier(:) = normal_part*row%normal
      row%slides = .false.
      if (friction%static*normal_part > 0.0_wp) call add_friction(row, normal_part, friction, dt)
   end subroutine limit_friction

   !> Multiplier of a point that rubs: it sticks where the static coefficient suffices, else it
   !> slides with the coefficient of the speed that is left; of several the one nearest to stick
   pure subroutine add_friction(row, given, friction, dt)
      !> Has the multiplier without friction
      type(contact_row_type), intent(inout) :: row
      !> Share of the normal multiplier that is given
      real(wp), intent(in) :: given, dt
      type(friction_type), intent(in) :: friction

      real(wp) :: free, last, mu, normal_part, resistance, slip, tangent(3)
      integer :: i

      free = row%normal_multiplier()
      slip = norm2(row%slip())
      call yield_to(row, 0.0_wp, normal_part, tangent)
      mu = friction%static
      row%slides = norm2(tangent) > mu*(given + normal_part)
      if (row%slides) then
         do i = 1, most_iterations
            last = mu
            ! nothing is left of the coefficient, or the point hardly touches
            if (mu*free <= least_ratio*slip) then
               row%slides = .false.
               return
            end if
            resistance = resistance_of(row, given, mu, slip/(mu*free))
            call yield_to(row, resistance, normal_part, tangent)
            mu = friction%coefficient(resistance*norm2(tangent)/dt)
            if (abs(mu - last) <= epsilon(mu)) exit
         end do
      end if
      row%multiplier(:) = (given + normal_part)*row%normal + tangent
   end subroutine add_friction

   !> Resistance k with which a point slides by Coulomb's law, one over mass: a root of
   !> mu p_n/|p_t| - 1, which is linear in k where the inverse mass is the same in all directions
   pure real(wp) function resistance_of(row, given, mu, far) result(k)
      type(contact_row_type), intent(in) :: row
      !> The last is the root where it is far above the inverse masses
      real(wp), intent(in) :: given, mu, far

      real(wp) :: excess, high, high_excess, last, low, low_excess
      integer :: i

      low = 0.0_wp
      low_excess = excess_of(row, given, mu, low)
      high = max(far, maxval(row%inverse_mass))
      do i = 1, most_iterations
         high_excess = excess_of(row, given, mu, high)
         if (high_excess >= 0.0_wp) exit
         high = 2.0_wp*high
      end do
      k = high
      ! regula falsi, by Dowell and Jarratt's rule (1971) for an end that stays
      do i = 1, most_iterations
         last = k
         k = high - high_excess*(high - low)/(high_excess - low_excess)
         excess = excess_of(row, given, mu, k)
         if (abs(k - last) <= epsilon(k)*high .or. abs(excess) <= epsilon(k)) exit
         if (excess*high_excess < 0.0_wp) then
            low = high
            low_excess = high_excess
         else
            low_excess = 0.5_wp*low_excess
         end if
         high = k
         high_excess = excess
      end do
   end function resistance_of

   !> Limit of friction over the multiplier along the surface, less 1
   pure real(wp) function excess_of(row, given, mu, resistance) result(excess)
      type(contact_row_type), intent(in) :: row
      real(wp), intent(in) :: given, mu, resistance

      real(wp) :: normal_part, tangent(3)

      call yield_to(row, resistance, normal_part, tangent)
      excess = mu*(given + normal_part)/max(norm2(tangent), tiny(1.0_wp)) - 1.0_wp
   end function excess_of

   !> Multiplier that closes the gap and leaves a slip of -k p_t: (M + k P) p = -(g n + s) in the
   !> directions that are not held, by the formula of Sherman and Morrison
   pure subroutine yield_to(row, resistance, normal_part, tangent)
      type(contact_row_type), intent(in) :: row
      !> k
      real(wp), intent(in) :: resistance
      !> p along the normal, and along the surface
      real(wp), intent(out) :: normal_part, tangent(3)

      real(wp) :: normal(3), p(3), share, soft(3)

      normal(:) = merge(row%normal, 0.0_wp, row%inverse_mass > 0.0_wp)
      share = norm2(normal)
      normal(:) = normal/share
      soft(:) = 0.0_wp
      where (row%inverse_mass > 0.0_wp) soft = 1.0_wp/(row%inverse_mass + resistance)
      p(:) = merge(row%motion, 0.0_wp, row%inverse_mass > 0.0_wp)
      p(:) = -soft*(p - dot_product(p, normal)*normal + row%gap/share*normal)
      p(:) = p + soft*normal*(resistance*dot_product(normal, p) &
         & /sum(soft*row%inverse_mass*normal**2))
      tangent(:) = p - dot_product(p, normal)*normal
      normal_part = dot_product(p, normal)/share
   end subroutine yield_to

   !> Slip of the step, length
   pure function slip(self)
      class(contact_row_type), intent(in) :: self
      real(wp) :: slip(3)

      slip(:) = self%motion + self%inverse_mass*self%multiplier
      slip(:) = slip - dot_product(slip, self%normal)*self%normal
   end function slip

   !> Share of the multiplier along the normal, mass times length
   pure real(wp) function normal_multiplier(self)
      class(contact_row_type), intent(in) :: self

      normal_multiplier = dot_product(self%multiplier, self%normal)
   end function normal_multiplier

end module plydyn_contact_solve_coulomb
