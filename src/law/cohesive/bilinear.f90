!> Interface that softens as it opens and slides, with penalty against closing, which may fall with
!> the damage, and Coulomb friction of the failed share of the face after Alfano and Sacco (2006).
!>
!> The failed share has one slip; what has just failed joins it free of friction, so that the
!> energies of penalty and friction only grow and their sum is the work that is lost.
module plydyn_law_cohesive_bilinear
   use plydyn_base_precision, only : lanes, wp
   use plydyn_law_cohesive_softening, only : benzeggagh_kenane, closing_at, damage_at, &
      & detect_growth_by_work, fracture_only, friction_at, most_points, normal, shear, slip_at, &
      & softening_type, stretch_at, with_closing, with_friction
   implicit none
   private

   public :: new_cohesive, new_springs

   !> Share of the stiffness that a falling penalty keeps
   real(wp), parameter, public :: penalty_floor = 0.1_wp

   !> Constants of an interface as an engineer gives them; pairs are normal, shear
   type, public :: cohesive_constants_type
      !> Traction per opening and per sliding
      real(wp) :: stiffness(2) = 0.0_wp
      !> Tractions N and S at the onset of damage
      real(wp) :: strength(2) = 0.0_wp
      !> Energies G_Ic and G_IIc per crack area
      real(wp) :: toughness(2) = 0.0_wp
      !> Toughness of mixed modes, a law of `softening.f90`, and its exponent
      integer :: criterion = benzeggagh_kenane
      real(wp) :: exponent = 1.0_wp
      !> Replace the shear stiffness by K_n (G_Ic/G_IIc) (S/N)**2, for which the energy lost depends
      !> on the damage alone and not on the mode (Turon et al. 2010)
      logical :: consistent = .false.
      !> Let the penalty of closed faces fall with the damage to `penalty_floor`, for explicit steps
      !> near the critical one; otherwise it is constant
      logical :: falling_penalty = .false.
      !> Coefficient of friction between failed faces
      real(wp) :: friction = 0.0_wp
      !> Let damage grow by the work of both modes, not by the mode of the present opening
      logical :: by_work = .false.
      !> Growth of the shear strength with the pressure on the faces
      real(wp) :: pressure_gain = 0.0_wp
   end type cohesive_constants_type

   !> The law, ready for use
   type, public, extends(softening_type) :: cohesive_type
      !> History variables of a point; none in springs, which never fail
      integer :: histories = 0
      !> Traction per opening and per sliding
      real(wp) :: stiffness(2) = 0.0_wp
      !> Least share of the stiffness that closed faces keep
      real(wp) :: floor = 1.0_wp
      !> Coefficient of friction, and the stiffness of failed faces before they slide
      real(wp) :: friction = 0.0_wp, friction_stiffness = 0.0_wp
      !> As in the constants
      logical :: by_work = .false.
      !> Growth of the shear strength with the pressure, over the strength
      real(wp) :: pressure_gain = 0.0_wp
   contains
      procedure :: update_points
      procedure :: stored_energy
   end type cohesive_type

contains

   !> The law of an interface that fails; the constants must be sound, see `check_cohesive`
   pure function new_cohesive(constants) result(self)
      type(cohesive_constants_type), intent(in) :: constants
      type(cohesive_type) :: self

      self%stiffness(:) = constants%stiffness
      if (constants%consistent) self%stiffness(shear) = consistent_stiffness(constants)
      self%onset(:) = self%stiffness/constants%strength**2
      self%toughness(:) = constants%toughness
      self%criterion = constants%criterion
      self%exponent = constants%exponent
      self%part = max(1.0_wp - 1.0_wp/self%least_ratio(), 0.0_wp)
      self%friction = constants%friction
      self%histories = fracture_only
      if (constants%falling_penalty) then
         self%floor = penalty_floor
         self%histories = with_closing
      end if
      self%friction_stiffness = self%floor*self%stiffness(shear)
      if (constants%friction > 0.0_wp) self%histories = with_friction
      self%by_work = constants%by_work
      if (self%by_work) self%histories = with_friction + 2
      self%pressure_gain = constants%pressure_gain/constants%strength(shear)
   end function new_cohesive

   !> The law of springs, which have no history
   pure function new_springs(stiffness) result(self)
      !> Traction per opening and per sliding
      real(wp), intent(in) :: stiffness(2)
      type(cohesive_type) :: self

      self%stiffness(:) = stiffness
   end function new_springs

   !> Shear stiffness for which final over onset opening is the same in both modes
   pure real(wp) function consistent_stiffness(constants) result(stiffness)
      type(cohesive_constants_type), intent(in) :: constants

      associate (strength => constants%strength, toughness => constants%toughness)
         stiffness = constants%stiffness(normal)*toughness(normal)/toughness(shear) &
            & *(strength(shear)/strength(normal))**2
      end associate
   end function consistent_stiffness

   !> Tractions on the upper face at openings, for all points of an element at once, and the history
   !> with them: one test for all shows that all are intact and below the onset
   pure subroutine update_points(self, points, pitch, opening, history, traction, weakness)
      class(cohesive_type), intent(in) :: self
      !> Number of points; rows of the history from one of their variables to the next
      integer, intent(in) :: points, pitch
      !> Displacement of the upper face over the lower: sliding along x and y, opening along z
      real(wp), intent(in) :: opening(lanes, 3, points)
      !> History from the first of the points on, old in and new out: one variable of all points of
      !> all elements after the other
      real(wp), intent(inout) :: history(lanes, pitch, *)
      !> Tractions in the same axes, positive with the opening
      real(wp), intent(out) :: traction(lanes, 3, points)
      !> Square of the strength of the law over that of each point, if they differ
      real(wp), intent(in), optional :: weakness(lanes, points)

      real(wp) :: across, along, beyond(lanes), highest, load(lanes, most_points)
      real(wp) :: point_weakness(lanes, most_points)
      integer :: l, q

      beyond(:) = 0.0_wp
      do q = 1, points
         !$omp simd private(across, along)
         do l = 1, lanes
            traction(l, 1, q) = self%stiffness(shear)*opening(l, 1, q)
            traction(l, 2, q) = self%stiffness(shear)*opening(l, 2, q)
            traction(l, 3, q) = self%stiffness(normal)*opening(l, 3, q)
            across = traction(l, 3, q)*max(opening(l, 3, q), 0.0_wp)
            along = traction(l, 1, q)*opening(l, 1, q) + traction(l, 2, q)*opening(l, 2, q)
            load(l, q) = self%onset(normal)*across + self%onset(shear)*along
            beyond(l) = max(beyond(l), load(l, q) - 1.0_wp)
         end do
      end do
      if (self%histories == 0) return
      point_weakness(:, :points) = 1.0_wp
      if (present(weakness)) then
         point_weakness(:, :points) = weakness
         load(:, :points) = load(:, :points)*weakness
         beyond(:) = maxval(load(:, :points), 2) - 1.0_wp
      end if
      do q = 1, points
         !$omp simd
         do l = 1, lanes
            beyond(l) = max(beyond(l), history(l, q, damage_at))
         end do
      end do
      highest = 0.0_wp
      !$omp simd reduction(max: highest)
      do l = 1, lanes
         highest = max(highest, beyond(l))
      end do
      if (highest <= 0.0_wp) return
      call update_damaged(self, points, pitch, opening, load, point_weakness, history, traction)
   end subroutine update_points

   !> Damage, dissipated energies and degraded tractions
   pure subroutine update_damaged(self, points, pitch, opening, load, weakness, history, traction)
      class(cohesive_type), intent(in) :: self
      !> As in `update_points`
      integer, intent(in) :: points, pitch
      real(wp), intent(in) :: opening(lanes, 3, points)
      !> Square of the load of the intact interface, 1 at the onset
      real(wp), intent(inout) :: load(lanes, most_points)
      !> Square of the strength of the law over that of each point
      real(wp), intent(in) :: weakness(lanes, most_points)
      real(wp), intent(inout) :: history(lanes, pitch, *)
      !> Tractions, of the intact interface in
      real(wp), intent(inout) :: traction(lanes, 3, points)

      real(wp) :: before(lanes, most_points), gain(lanes, most_points), h(lanes, with_friction)
      integer :: q
      logical :: grows(points)

      gain(:, :points) = 1.0_wp
      if (self%pressure_gain > 0.0_wp) then
         call find_pressure_gain(self, points, history(1, 1, damage_at), traction, weakness, gain)
         load(:, :points) = load(:, :points)/gain(:, :points)
      end if
      if (self%by_work) then
         call detect_growth_by_work(points, pitch, load, history(1, 1, 1), before, grows)
      else
         call self%detect_growth(points, load, weakness, history(1, 1, damage_at), before, grows)
      end if
      do q = 1, points
         if (.not. grows(q)) cycle
         if (self%by_work) then
            call self%grow_by_work(opening(:, :, q), traction(:, :, q), weakness(:, q), &
               & gain(:, q), history(:, q, :fracture_only), &
               & history(:, q, self%histories - 1:self%histories))
         else
            call self%grow_damage(opening(:, :, q), traction(:, :, q), weakness(:, q), gain(:, q), &
               & history(:, q, :fracture_only))
         end if
         if (self%floor < 1.0_wp) then
            call release_penalty(self%stiffness(normal), self%floor, before(:, q), &
               & history(:, q, damage_at), opening(:, :, q), history(:, q, closing_at))
         end if
      end do
      do q = 1, points
         call degrade_traction(history(:, q, damage_at), self%floor, traction(:, :, q))
      end do
      if (.not. self%friction > 0.0_wp) return
      do q = 1, points
         h(:, :) = history(:, q, :with_friction)
         call add_friction(self%friction, self%friction_stiffness, before(:, q), &
            & opening(:, :, q), h, traction(:, :, q))
         history(:, q, :with_friction) = h
      end do
   end subroutine update_damaged

   !> Energy per area that unloading gives back: of the intact share of the face, of closed faces,
   !> and of the stretch of those that rub
   pure function stored_energy(self, opening, history) result(energy)
      class(cohesive_type), intent(in) :: self
      !> As in `update_points`, of one point
      real(wp), intent(in) :: opening(lanes, 3), history(lanes, self%histories)
      real(wp) :: energy(lanes)

      real(wp) :: whole(lanes)

      whole(:) = 1.0_wp
      if (self%histories > 0) whole(:) = 1.0_wp - history(:, damage_at)
      energy(:) = 0.5_wp*(self%stiffness(shear)*whole*sum(opening(:, :2)**2, 2) &
         & + self%stiffness(normal)*opening(:, 3)**2*merge(whole, max(whole, self%floor), &
         & opening(:, 3) > 0.0_wp))
      if (self%friction > 0.0_wp) energy(:) = energy + 0.5_wp*self%friction_stiffness &
         & *history(:, damage_at)*history(:, stretch_at)**2
   end function stored_energy

   !> Square of the shear strength of pressed points over that without pressure
   pure subroutine find_pressure_gain(self, points, damage, traction, weakness, gain)
      class(cohesive_type), intent(in) :: self
      !> Number of points
      integer, intent(in) :: points
      !> Damage, tractions of the intact interface, and weakness
      real(wp), intent(in) :: damage(lanes, points), traction(lanes, 3, points)
      real(wp), intent(in) :: weakness(lanes, most_points)
      !> The square, 1 where the faces are apart
      real(wp), intent(inout) :: gain(lanes, most_points)

      real(wp) :: pressure
      integer :: l, q

      do q = 1, points
         !$omp simd private(pressure)
         do l = 1, lanes
            pressure = max(1.0_wp - damage(l, q), self%floor)*max(-traction(l, 3, q), 0.0_wp)
            gain(l, q) = (1.0_wp + self%pressure_gain*pressure*sqrt(weakness(l, q)))**2
         end do
      end do
   end subroutine find_pressure_gain

   !> Tractions of the damaged interface from those of the intact one
   pure subroutine degrade_traction(damage, floor, traction)
      !> Damage; least share of the stiffness that closed faces keep
      real(wp), intent(in) :: damage(lanes), floor
      !> Traction, of the intact interface in
      real(wp), intent(inout) :: traction(lanes, 3)

      real(wp) :: whole
      integer :: l

      !$omp simd private(whole)
      do l = 1, lanes
         whole = 1.0_wp - damage(l)
         traction(l, 1) = whole*traction(l, 1)
         traction(l, 2) = whole*traction(l, 2)
         traction(l, 3) = merge(whole, max(whole, floor), traction(l, 3) > 0.0_wp)*traction(l, 3)
      end do
   end subroutine degrade_traction

   !> Energy that closed faces lose when their penalty falls
   pure subroutine release_penalty(stiffness, floor, before, damage, opening, closing)
      !> Traction per opening, and the least share of it that closed faces keep
      real(wp), intent(in) :: stiffness, floor
      !> Damage before and after this step; opening
      real(wp), intent(in) :: before(lanes), damage(lanes), opening(lanes, 3)
      !> Energy lost so
      real(wp), intent(inout) :: closing(lanes)

      real(wp) :: lost
      integer :: l

      !$omp simd private(lost)
      do l = 1, lanes
         lost = max(1.0_wp - before(l), floor) &
            & - max(1.0_wp - damage(l), floor)
         closing(l) = closing(l) &
            & + 0.5_wp*stiffness*lost*min(opening(l, 3), 0.0_wp)**2
      end do
   end subroutine release_penalty

   !> Add the friction of the failed share of the face. Sliding first stretches it; it slips where
   !> that would take more than Coulomb's traction. The energy is the mean traction times the slip
   pure subroutine add_friction(coefficient, stiffness, before, opening, history, traction)
      !> Coefficient of friction, and stiffness of failed faces before they slide
      real(wp), intent(in) :: coefficient, stiffness
      !> Damage before this step; opening
      real(wp), intent(in) :: before(lanes), opening(lanes, 3)
      !> Damage, slip, stretch and energy; traction, without friction in
      real(wp), intent(inout) :: history(lanes, with_friction), traction(lanes, 3)

      real(wp) :: carried, damage, full, part, share, x, y
      integer :: l

      !$omp simd private(carried, damage, full, part, share, x, y)
      do l = 1, lanes
         damage = history(l, damage_at)
         ! the share of the failed face that had failed before
         share = before(l)/max(damage, tiny(1.0_wp))
         x = opening(l, 1) - history(l, slip_at)
         y = opening(l, 2) - history(l, slip_at + 1)
         full = sqrt(x*x + y*y)
         carried = min(share*full, coefficient*max(-traction(l, 3), 0.0_wp) &
            & /stiffness)
         part = carried/max(full, tiny(1.0_wp))
         traction(l, 1) = traction(l, 1) + damage*stiffness*part*x
         traction(l, 2) = traction(l, 2) + damage*stiffness*part*y
         history(l, slip_at) = opening(l, 1) - part*x
         history(l, slip_at + 1) = opening(l, 2) - part*y
         history(l, friction_at) = history(l, friction_at) + 0.5_wp*damage*stiffness &
            & *((share*full - carried)*(carried + history(l, stretch_at)) &
            & + (1.0_wp - share)*full*carried)
         history(l, stretch_at) = carried
      end do
   end subroutine add_friction

end module plydyn_law_cohesive_bilinear
