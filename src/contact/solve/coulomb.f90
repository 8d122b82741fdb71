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

   public :: limit_friction, solve_row

   !> Friction coefficient that falls with the speed from a static to a dynamic one
   type, public :: friction_type
      !> Coefficients at rest and at high speed
      real(wp) :: static = 0.0_wp, dynamic = 0.0_wp
      !> Exponent of the decay, time/length
      real(wp) :: decay = 0.0_wp
   contains
      procedure :: coefficient
   end type friction_type

   !> A point in contact
   type, public :: contact_row_type
      !> Gap of the trial position, negative, length
      real(wp) :: gap = 0.0_wp
      !> Unit normal from the body to the plate
      real(wp) :: normal(3) = 0.0_wp
      !> Motion of the point over the step relative to the body, length
      real(wp) :: motion(3) = 0.0_wp
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

   !> Multiplier that closes the gap, with stick or slip; none where the point is held along the
   !> normal
   pure subroutine solve_row(row, friction, dt)
      !> The point; gets its multiplier
      type(contact_row_type), intent(inout) :: row
      !> Friction coefficients
      type(friction_type), intent(in) :: friction
      !> Time step
      real(wp), intent(in) :: dt

      real(wp) :: compliance, coupled, normal_part, tangent(3)

      row%multiplier(:) = 0.0_wp
      row%slides = .false.
      compliance = sum(row%inverse_mass*row%normal**2)
      if (compliance <= 0.0_wp) return
      tangent(:) = sticking(row)
      coupled = sum(row%normal*row%inverse_mass*tangent)
      normal_part = (-row%gap - coupled)/compliance
      associate (mu => friction%coefficient(norm2(row%slip())/dt), size_of => norm2(tangent))
         if (size_of <= mu*normal_part) then
            row%multiplier(:) = normal_part*row%normal + tangent
         else
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

      tangent(:) = sticking(row)
      most = normal_part*friction%coefficient(norm2(row%slip())/dt)
      row%slides = norm2(tangent) > most .and. most > 0.0_wp
      if (norm2(tangent) > most) tangent(:) = tangent*(most/norm2(tangent))
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
