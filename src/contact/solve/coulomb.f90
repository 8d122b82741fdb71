!> Contact of one point with a body that gives no way, with Coulomb friction: a closed form.
!>
!> The body of a fixture moves as prescribed, so the rows of its points are independent. With the
!> inverse mass M of the point, its gap g along the normal n and its slip s of the step, both of the
!> trial position, the multiplier p (force times the time step squared) satisfies
!> 0 <= p.n, g + n.M p >= 0, and either the slip s + M p is zero along the surface (stick) or the
!> share of p along the surface is against it and mu times p.n (slip).
module plydyn_contact_solve_coulomb
   use plydyn_base_precision, only : wp
   implicit none
   private

   !> Most iterations for the speed that is left
   integer, parameter :: most_iterations = 100
   !> Coefficient of friction beyond which it is no longer one of materials that slide
   real(wp), parameter, public :: largest_friction = 2.0_wp

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
      !> Friction coefficients
      type(friction_type), intent(in) :: friction
      !> Time step
      real(wp), intent(in) :: dt

      real(wp) :: compliance, coupled, mu, normal_part, tangent(3)

      row%multiplier(:) = 0.0_wp
      row%slides = .false.
      compliance = sum(row%inverse_mass*row%normal**2)
      if (compliance <= 0.0_wp) return
      tangent(:) = sticking(row)
      coupled = sum(row%normal*row%inverse_mass*tangent)
      normal_part = (-row%gap - coupled)/compliance
      associate (size_of => norm2(tangent))
         if (size_of <= friction%static*normal_part) then
            row%multiplier(:) = normal_part*row%normal + tangent
         else
            mu = friction%sliding_coefficient(norm2(row%slip())/dt, normal_part/size_of)
            tangent(:) = mu*tangent/size_of
            coupled = sum(row%normal*row%inverse_mass*tangent)
            ! the friction of a point that is held in some directions must not turn the sign
            normal_part = -row%gap/max(compliance + coupled, 0.5_wp*compliance)
            row%multiplier(:) = normal_part*(row%normal + tangent)
            row%slides = mu > 0.0_wp
         end if
      end associate
   end subroutine solve_row

   !> Friction of a point whose normal force is given
   pure subroutine limit_friction(row, normal_part, friction, dt)
      !> The point; gets its multiplier
      type(contact_row_type), intent(inout) :: row
      !> Normal force times the time step squared, not negative
      real(wp), intent(in) :: normal_part
      !> Friction coefficients
      type(friction_type), intent(in) :: friction
      !> Time step
      real(wp), intent(in) :: dt

      real(wp) :: most, tangent(3)

      row%multiplier(:) = 0.0_wp
      tangent(:) = sticking(row)
      most = normal_part*friction%static
      if (norm2(tangent) > most) then
         most = normal_part*friction%sliding_coefficient(norm2(row%slip())/dt, &
            & normal_part/norm2(tangent))
         row%slides = most > 0.0_wp
         tangent(:) = tangent*(most/norm2(tangent))
      else
         row%slides = .false.
      end if
      row%multiplier(:) = normal_part*row%normal + tangent
   end subroutine limit_friction

   !> Multiplier along the surface that stops the slip of the trial motion
   pure function sticking(row) result(tangent)
      type(contact_row_type), intent(in) :: row
      real(wp) :: tangent(3)

      real(wp) :: slip(3)

      slip(:) = row%motion - dot_product(row%motion, row%normal)*row%normal
      tangent(:) = 0.0_wp
      where (row%inverse_mass > 0.0_wp) tangent(:) = -slip/row%inverse_mass
      tangent(:) = tangent - dot_product(tangent, row%normal)*row%normal
   end function sticking

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
