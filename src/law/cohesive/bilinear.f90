!> Interface that softens as it opens and slides: the bilinear law of Camanho, Davila and de Moura
!> (2003) for unequal stiffness of the modes, with penalty against closing and, on the failed share
!> of the face, friction after Alfano and Sacco (2006).
!>
!> Everything follows from the elastic energies of the intact interface (twice, per area) of
!> opening, K_n <d_n>**2, and of sliding, K_s d_s**2: their ratio is the mix of modes B, and the
!> load f = sqrt((K_n <d_n>/N)**2 + (K_s d_s/S)**2) is 1 at the onset for every mix. The final
!> opening of a straight path is r = 2 G_c(B) f**2/(K_n <d_n>**2 + K_s d_s**2) times that of the
!> onset, the same at every point of the path, so the damage is d = r (f - 1)/(f (r - 1)), and it
!> never falls. A straight path dissipates G_c(B) whatever the stiffnesses.
!>
!> Friction acts on the share d of the face. That share has one slip; what has just failed joins it
!> free of friction, so that both energies only grow and their sum is the work that is lost.
module plydyn_law_cohesive_bilinear
   use plydyn_base_precision, only : lanes, wp
   use plydyn_law_cohesive_toughness, only : benzeggagh_kenane, find_toughness, least_ratio
   implicit none
   private

   public :: new_cohesive, new_springs

   !> Places of the two modes in pairs of constants
   integer, parameter, public :: normal = 1, shear = 2

   !> History of a point, zero for an intact one: damage from 0 to 1; energies per area lost in
   !> fracture, released by a falling penalty, and lost in friction; slip of
   !> the failed faces along x and y; elastic part of the sliding that friction resists. A law has
   !> the first `histories` of them
   integer, parameter, public :: damage_at = 1, fracture_at = 2, closing_at = 3, friction_at = 4, &
      & slip_at = 5, stretch_at = 7

   !> Histories without and with a falling penalty, and with friction
   integer, parameter :: fracture_only = 2, with_closing = 3, with_friction = 7

   !> Share of the stiffness that a falling penalty keeps
   real(wp), parameter, public :: penalty_floor = 0.1_wp

   !> Most points in a call: work space of fixed size can be aligned
   integer, parameter :: most_points = 9

   !> Constants of an interface as an engineer gives them; pairs are normal, shear
   type, public :: cohesive_constants_type
      !> Traction per opening and per sliding
      real(wp) :: stiffness(2) = 0.0_wp
      !> Tractions N and S at the onset of damage
      real(wp) :: strength(2) = 0.0_wp
      !> Energies G_Ic and G_IIc per crack area
      real(wp) :: toughness(2) = 0.0_wp
      !> Toughness of mixed modes, a law of `cohesive_toughness.f90`, and its exponent
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
   end type cohesive_constants_type

   !> The law, ready for use
   type, public :: cohesive_type
      !> History variables of a point; none in springs, which never fail
      integer :: histories = 0
      !> Traction per opening and per sliding
      real(wp) :: stiffness(2) = 0.0_wp
      !> Square of the load per twice the elastic energy of each mode, K/N**2 and K/S**2
      real(wp) :: onset(2) = 0.0_wp
      !> As in the constants
      real(wp) :: toughness(2) = 0.0_wp, exponent = 1.0_wp
      integer :: criterion = benzeggagh_kenane
      !> Part of the damage d by which the load at which it grows is at least 1/(1 - part*d)
      real(wp) :: part = 0.0_wp
      !> Least share of the stiffness that closed faces keep
      real(wp) :: floor = 1.0_wp
      !> Coefficient of friction, and the stiffness of failed faces before they slide
      real(wp) :: friction = 0.0_wp, friction_stiffness = 0.0_wp
   contains
      procedure :: update
      procedure :: update_points
      procedure :: toughness_of
   end type cohesive_type

contains

   !> The law of an interface that fails; the constants must be sound, see `check_cohesive`
   pure function new_cohesive(constants) result(self)
      !> Constants
      type(cohesive_constants_type), intent(in) :: constants
      type(cohesive_type) :: self

      self%stiffness(:) = constants%stiffness
      if (constants%consistent) self%stiffness(shear) = consistent_stiffness(constants)
      self%onset(:) = self%stiffness/constants%strength**2
      self%toughness(:) = constants%toughness
      self%criterion = constants%criterion
      self%exponent = constants%exponent
      self%part = max(1.0_wp - 1.0_wp/least_ratio(self%criterion, self%exponent, &
         & self%toughness, self%onset), 0.0_wp)
      self%friction = constants%friction
      self%histories = fracture_only
      if (constants%falling_penalty) then
         self%floor = penalty_floor
         self%histories = with_closing
      end if
      self%friction_stiffness = self%floor*self%stiffness(shear)
      if (constants%friction > 0.0_wp) self%histories = with_friction
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

   !> Traction on the upper face that resists an opening, and the history with it
   pure subroutine update(self, opening, history, traction)
      class(cohesive_type), intent(in) :: self
      !> Displacement of the upper face over the lower: sliding along x and y, opening along z
      real(wp), intent(in) :: opening(lanes, 3)
      !> History of the point, old in and new out
      real(wp), intent(inout) :: history(lanes, self%histories)
      !> Traction in the same axes, positive with the opening
      real(wp), intent(out) :: traction(lanes, 3)

      call self%update_points(1, 1, opening, history, traction)
   end subroutine update

   !> The same for all points of an element at once: one test for all shows that all are intact and
   !> below the onset
   pure subroutine update_points(self, points, pitch, opening, history, traction)
      class(cohesive_type), intent(in) :: self
      !> Number of points; rows of the history from one of their variables to the next
      integer, intent(in) :: points, pitch
      !> Openings
      real(wp), intent(in) :: opening(lanes, 3, points)
      !> History from the first of the points on, old in and new out: one variable of all points of
      !> all elements after the other
      real(wp), intent(inout) :: history(lanes, pitch, *)
      !> Tractions
      real(wp), intent(out) :: traction(lanes, 3, points)

      real(wp) :: across, along, beyond(lanes), highest, load(lanes, most_points)
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
      call update_damaged(self, points, pitch, opening, load, history, traction)
   end subroutine update_points

   !> Damage, dissipated energies and degraded tractions
   pure subroutine update_damaged(self, points, pitch, opening, load, history, traction)
      class(cohesive_type), intent(in) :: self
      !> As in `update_points`
      integer, intent(in) :: points, pitch
      real(wp), intent(in) :: opening(lanes, 3, points)
      !> Square of the load of the intact interface, 1 at the onset
      real(wp), intent(in) :: load(lanes, most_points)
      real(wp), intent(inout) :: history(lanes, pitch, *)
      !> Tractions, of the intact interface in
      real(wp), intent(inout) :: traction(lanes, 3, points)

      real(wp) :: before(lanes, most_points), h(lanes, with_friction)
      integer :: q
      logical :: grows(points)

      call detect_growth(self%part, points, load, history(1, 1, damage_at), before, grows)
      do q = 1, points
         if (.not. grows(q)) cycle
         call grow_damage(self, opening(:, :, q), traction(:, :, q), history(:, q, damage_at), &
            & history(:, q, fracture_at))
         if (self%histories >= with_closing .and. self%floor < 1.0_wp) then
            call release_penalty(self, before(:, q), history(:, q, damage_at), opening(:, :, q), &
               & history(:, q, closing_at))
         end if
      end do
      do q = 1, points
         call degrade_traction(history(:, q, damage_at), self%floor, traction(:, :, q))
      end do
      if (.not. self%friction > 0.0_wp) return
      do q = 1, points
         h(:, :) = history(:, q, :with_friction)
         call add_friction(self, before(:, q), opening(:, :, q), h, traction(:, :, q))
         history(:, q, :with_friction) = h
      end do
   end subroutine update_damaged

   !> Where damage can grow: it is below 1, and the load is past the least at which it would grow
   !> with any mix of modes. That needs no power of the mix
   pure subroutine detect_growth(part, points, load, damage, before, grows)
      !> As in `cohesive_type`
      real(wp), intent(in) :: part
      integer, intent(in) :: points
      !> As in `update_damaged`
      real(wp), intent(in) :: load(lanes, most_points)
      !> Damage, and the same again
      real(wp), intent(in) :: damage(lanes, points)
      real(wp), intent(out) :: before(lanes, most_points)
      !> Whether it can grow in some lane
      logical, intent(out) :: grows(points)

      real(wp) :: ahead(lanes), highest
      integer :: l, q

      do q = 1, points
         !$omp simd
         do l = 1, lanes
            before(l, q) = damage(l, q)
            ahead(l) = min(load(l, q)*(1.0_wp - part*damage(l, q))**2 - 1.0_wp, &
               & 1.0_wp - damage(l, q))
         end do
         highest = 0.0_wp
         !$omp simd reduction(max: highest)
         do l = 1, lanes
            highest = max(highest, ahead(l))
         end do
         grows(q) = highest > 0.0_wp
      end do
   end subroutine detect_growth

   !> New damage and the energy that it took
   pure subroutine grow_damage(self, opening, traction, damage, fracture)
      class(cohesive_type), intent(in) :: self
      !> Opening, and traction of the intact interface
      real(wp), intent(in) :: opening(lanes, 3), traction(lanes, 3)
      !> Damage, and energy lost in fracture
      real(wp), intent(inout) :: damage(lanes), fracture(lanes)

      real(wp) :: across, after, along, before, f(lanes), left, mix(lanes), r, toughness(lanes)
      integer :: l

      !$omp simd private(across, along)
      do l = 1, lanes
         ! twice the elastic energies of both modes of the intact interface
         across = traction(l, 3)*max(opening(l, 3), 0.0_wp)
         along = traction(l, 1)*opening(l, 1) + traction(l, 2)*opening(l, 2)
         mix(l) = along/(across + along + tiny(1.0_wp))
         ! the load, 1 at the onset
         f(l) = max(sqrt(self%onset(normal)*across + self%onset(shear)*along), 1.0_wp)
      end do
      call find_toughness(self%criterion, self%exponent, self%toughness, mix, toughness)
      !$omp simd private(after, before, left, r)
      do l = 1, lanes
         ! final over onset opening of a straight path with this mix
         r = 2.0_wp*toughness(l)*(self%onset(normal)*(1.0_wp - mix(l)) &
            & + self%onset(shear)*mix(l))
         before = damage(l)
         ! r over the load at which the damage so far would grow
         left = r - before*(r - 1.0_wp)
         after = min(max(before, r*(f(l) - 1.0_wp)/(f(l)*(r - 1.0_wp))), 1.0_wp)
         damage(l) = after
         fracture(l) = fracture(l) &
            & + toughness(l)*(after - before)*min(f(l), r)/left
      end do
   end subroutine grow_damage

   !> Energy per crack area at a mix of modes
   pure real(wp) function toughness_of(self, mix)
      class(cohesive_type), intent(in) :: self
      !> Share of the energy that is of shear, from 0 to 1
      real(wp), intent(in) :: mix

      real(wp) :: toughness(lanes)

      call find_toughness(self%criterion, self%exponent, self%toughness, &
         & spread(mix, 1, lanes), toughness)
      toughness_of = toughness(1)
   end function toughness_of

   !> Tractions of the damaged interface from those of the intact one
   pure subroutine degrade_traction(damage, floor, traction)
      !> Damage
      real(wp), intent(in) :: damage(lanes)
      !> Least share of the stiffness that closed faces keep
      real(wp), intent(in) :: floor
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
   pure subroutine release_penalty(self, before, damage, opening, closing)
      class(cohesive_type), intent(in) :: self
      !> Damage before and after this step
      real(wp), intent(in) :: before(lanes), damage(lanes)
      !> Opening
      real(wp), intent(in) :: opening(lanes, 3)
      !> Energy lost so
      real(wp), intent(inout) :: closing(lanes)

      real(wp) :: lost
      integer :: l

      !$omp simd private(lost)
      do l = 1, lanes
         lost = max(1.0_wp - before(l), self%floor) &
            & - max(1.0_wp - damage(l), self%floor)
         closing(l) = closing(l) &
            & + 0.5_wp*self%stiffness(normal)*lost*min(opening(l, 3), 0.0_wp)**2
      end do
   end subroutine release_penalty

   !> Add the friction of the failed share of the face. Sliding first stretches it; it slips where
   !> that would take more than Coulomb's traction. The energy is the mean traction times the slip
   pure subroutine add_friction(self, before, opening, history, traction)
      class(cohesive_type), intent(in) :: self
      !> Damage before this step
      real(wp), intent(in) :: before(lanes)
      !> Opening
      real(wp), intent(in) :: opening(lanes, 3)
      !> Damage, slip, stretch and energy
      real(wp), intent(inout) :: history(lanes, with_friction)
      !> Traction, without friction in
      real(wp), intent(inout) :: traction(lanes, 3)

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
         carried = min(share*full, self%friction*max(-traction(l, 3), 0.0_wp) &
            & /self%friction_stiffness)
         part = carried/max(full, tiny(1.0_wp))
         traction(l, 1) = traction(l, 1) + damage*self%friction_stiffness*part*x
         traction(l, 2) = traction(l, 2) + damage*self%friction_stiffness*part*y
         history(l, slip_at) = opening(l, 1) - part*x
         history(l, slip_at + 1) = opening(l, 2) - part*y
         history(l, friction_at) = history(l, friction_at) + 0.5_wp*damage*self%friction_stiffness &
            & *((share*full - carried)*(carried + history(l, stretch_at)) &
            & + (1.0_wp - share)*full*carried)
         history(l, stretch_at) = carried
      end do
   end subroutine add_friction

end module plydyn_law_cohesive_bilinear
