!> How an interface softens: the bilinear law of Camanho, Davila and de Moura (2003) for unequal
!> stiffness of the modes.
!>
!> Everything follows from the elastic energies of the intact interface (twice, per area) of
!> opening, K_n <d_n>**2, and of sliding, K_s d_s**2: their ratio is the mix of modes B, and the
!> load f = sqrt((K_n <d_n>/N)**2 + (K_s d_s/S)**2) is 1 at the onset for every mix. The final
!> opening of a straight path is r = 2 G_c(B) f**2/(K_n <d_n>**2 + K_s d_s**2) times that of the
!> onset, the same at every point of the path, so the damage is d = r (f - 1)/(f (r - 1)), and it
!> never falls. A straight path dissipates G_c(B) whatever the stiffnesses.
!>
!> The strengths of a point may differ from those of the law by one factor, with the same toughness:
!> the square of the load and r are then as its inverse square, the `weakness`. Under a pressure p
!> the shear strength is S + eta p, and the toughness of sliding grows with its square, the `gain`:
!> then the square of the load is less by it, and r is the same.
!>
!> Damage may also grow by the work of both modes, for paths on which the mode changes. On a
!> straight path the share s of the toughness that is spent is (f - 1)/(r - 1), so that
!> (1 - d) f = 1 - s: the tractions fall in proportion to the share that is left. This is kept for
!> all paths, with s = D/G_c(D_s/D), where D and D_s are the energies lost so far, in all and in
!> sliding. Damage d has lost all of the work at failure, of each mode its own; so the work is the
!> toughness of the ratio of both works, whatever the path and the stiffnesses. On a straight path,
!> and in a pure mode, both are one law.
module plydyn_law_cohesive_softening
   use plydyn_base_precision, only : lanes, wp
   implicit none
   private

   public :: detect_growth_by_work

   !> Places of the two modes in pairs of constants
   integer, parameter, public :: normal = 1, shear = 2

   !> Toughness between the pure modes: Benzeggagh and Kenane, or a sum of powers of G/G_c
   integer, parameter, public :: benzeggagh_kenane = 1, power_law = 2

   !> History of a point, zero for an intact one: damage from 0 to 1; energy per area lost in
   !> fracture, and its share of the toughness, 1 where the damage is 1; energies released by a
   !> falling penalty, and lost in friction; slip of the failed faces along x and y; elastic part of
   !> the sliding under friction. A law has the first of them, as many as it needs; where damage
   !> grows by work it has all, and behind them the energies per area lost in opening and in sliding
   integer, parameter, public :: damage_at = 1, fracture_at = 2, share_at = 3, closing_at = 4, &
      & friction_at = 5, slip_at = 6, stretch_at = 8

   !> Histories without and with a falling penalty, and with friction
   integer, parameter, public :: fracture_only = 3, with_closing = 4, with_friction = 8

   !> Share of the toughness from which on a point counts as delaminated
   real(wp), parameter, public :: delaminated_share = 0.5_wp

   !> Most points in a call: work space of fixed size can be aligned
   integer, parameter, public :: most_points = 9

   !> Smallest share of a mode whose power is taken
   real(wp), parameter :: smallest = 1.0e-60_wp

   !> Intervals of the mix in which the final over onset opening is bounded from below, and the part
   !> of the bound that is sure: the curve of a power law below 1 bends a little below both ends
   integer, parameter :: intervals = 64
   real(wp), parameter :: sure = 0.99_wp

   !> Times that the ratio of works is found from what the step adds to them
   integer, parameter :: passes = 2

   !> Share of the toughness that counts as none: damage comes to 1, whatever the rounding
   real(wp), parameter :: round_off = 1.0e-12_wp

   !> Onset and toughness
   type, public :: softening_type
      !> Square of the load per twice the elastic energy of each mode, K/N**2 and K/S**2
      real(wp) :: onset(2) = 0.0_wp
      !> Energies G_Ic and G_IIc per crack area
      real(wp) :: toughness(2) = 0.0_wp
      !> Toughness of mixed modes, one of the above, and its exponent, above 0
      integer :: criterion = benzeggagh_kenane
      real(wp) :: exponent = 1.0_wp
      !> Part of the damage d by which the load at which it grows is at least 1/(1 - part*d)
      real(wp) :: part = 0.0_wp
   contains
      procedure :: detect_growth
      procedure :: find_modes
      procedure :: find_toughness
      procedure :: grow_damage
      procedure :: grow_by_work
      procedure :: least_ratio
      procedure :: spent_share
      procedure :: toughness_of
   end type softening_type

contains

   !> Where damage can grow: it is below 1, and the load is past the least at which it would grow
   !> with any mix of modes. That needs no power of the mix
   pure subroutine detect_growth(self, points, load, weakness, damage, before, grows)
      class(softening_type), intent(in) :: self
      !> Number of points
      integer, intent(in) :: points
      !> Square of the load of the intact interface, 1 at the onset
      real(wp), intent(in) :: load(lanes, most_points)
      !> Square of the strength of the law over that of the point
      real(wp), intent(in) :: weakness(lanes, most_points)
      !> Damage, and the same again
      real(wp), intent(in) :: damage(lanes, points)
      real(wp), intent(out) :: before(lanes, most_points)
      !> Whether it can grow in some lane
      logical, intent(out) :: grows(points)

      real(wp) :: ahead(lanes), highest, part
      integer :: l, q

      do q = 1, points
         !$omp simd private(part)
         do l = 1, lanes
            before(l, q) = damage(l, q)
            part = max(1.0_wp - (1.0_wp - self%part)/weakness(l, q), 0.0_wp)
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

   !> New damage, the energy that it took, and the share of the toughness that is spent
   pure subroutine grow_damage(self, opening, traction, weakness, gain, history)
      class(softening_type), intent(in) :: self
      !> Opening, and traction of the intact interface
      real(wp), intent(in) :: opening(lanes, 3), traction(lanes, 3)
      !> Weakness of the point, and gain of its toughness under pressure
      real(wp), intent(in) :: weakness(lanes), gain(lanes)
      !> History of the point
      real(wp), intent(inout) :: history(lanes, fracture_only)

      real(wp) :: after, before, f, left, load(lanes), mix(lanes), r, spent, toughness(lanes)
      integer :: l

      call self%find_modes(opening, traction, mix, load)
      call self%find_toughness(mix, toughness)
      !$omp simd private(after, before, f, left, r, spent)
      do l = 1, lanes
         f = max(sqrt(load(l)*weakness(l)/gain(l)), 1.0_wp)
         ! final over onset opening of a straight path with this mix
         r = 2.0_wp*toughness(l)*(self%onset(normal)*(1.0_wp - mix(l)) &
            & + self%onset(shear)*mix(l))*weakness(l)
         before = history(l, damage_at)
         ! r over the load at which the damage so far would grow
         left = r - before*(r - 1.0_wp)
         after = min(max(before, r*(f - 1.0_wp)/(f*(r - 1.0_wp))), 1.0_wp)
         history(l, damage_at) = after
         history(l, fracture_at) = history(l, fracture_at) &
            & + gain(l)*toughness(l)*(after - before)*min(f, r)/left
         spent = min(history(l, share_at) + (after - before)*min(f, r)/left, 1.0_wp)
         history(l, share_at) = merge(1.0_wp, spent, after >= 1.0_wp)
      end do
   end subroutine grow_damage

   !> Where damage grows: the traction is above what the spent share leaves of the strength
   pure subroutine detect_growth_by_work(points, pitch, load, history, before, grows)
      !> Number of points; rows of the history from one of its variables to the next
      integer, intent(in) :: points, pitch
      !> Square of the load of the intact interface, 1 at the onset
      real(wp), intent(in) :: load(lanes, most_points)
      !> History from the first of the points on
      real(wp), intent(in) :: history(lanes, pitch, fracture_only)
      !> Damage
      real(wp), intent(out) :: before(lanes, most_points)
      !> Whether it grows in some lane
      logical, intent(out) :: grows(points)

      integer :: q

      do q = 1, points
         before(:, q) = history(:, q, damage_at)
         grows(q) = any(load(:, q)*(1.0_wp - before(:, q))**2 &
            & > (1.0_wp - history(:, q, share_at))**2 .and. before(:, q) < 1.0_wp)
      end do
   end subroutine detect_growth_by_work

   !> New damage, the energies that it took, and the share of the toughness that is spent
   pure subroutine grow_by_work(self, opening, traction, weakness, gain, history, works)
      class(softening_type), intent(in) :: self
      !> As in `grow_damage`
      real(wp), intent(in) :: opening(lanes, 3), traction(lanes, 3), weakness(lanes), gain(lanes)
      real(wp), intent(inout) :: history(lanes, fracture_only)
      !> Energies lost in opening and in sliding, without the gain under pressure
      real(wp), intent(inout) :: works(lanes, 2)

      real(wp), dimension(lanes) :: after, load, lost, mix, ratio, toughness
      integer :: l, pass

      call self%find_modes(opening, traction, mix, load)
      load(:) = load*weakness/gain
      lost(:) = 0.0_wp
      do pass = 1, passes
         do l = 1, lanes
            ratio(l) = mix(l)
            if (works(l, normal) + works(l, shear) + lost(l) > 0.0_wp) ratio(l) &
               & = (works(l, shear) + mix(l)*lost(l))/(works(l, normal) + works(l, shear) + lost(l))
         end do
         call self%find_toughness(ratio, toughness)
         do l = 1, lanes
            call grow_point(toughness(l), 2.0_wp*toughness(l)*weakness(l)*(self%onset(normal) &
               & *(1.0_wp - mix(l)) + self%onset(shear)*mix(l)), sqrt(load(l)), &
               & sum(works(l, :)), history(l, damage_at), after(l), lost(l))
         end do
      end do
      history(:, damage_at) = after
      history(:, fracture_at) = history(:, fracture_at) + gain*lost
      works(:, normal) = works(:, normal) + (1.0_wp - mix)*lost
      works(:, shear) = works(:, shear) + mix*lost
      where (lost > 0.0_wp)
         history(:, share_at) = min((works(:, normal) + works(:, shear))/toughness, 1.0_wp)
      end where
      where (after >= 1.0_wp) history(:, share_at) = 1.0_wp
   end subroutine grow_by_work

   !> Damage at which a point carries what its share leaves, (1 - d) f = 1 - s - (d - before) f g/r,
   !> with the load g = (1 - s)/(1 - before) at which it begins to grow
   elemental subroutine grow_point(toughness, r, f, spent, before, after, lost)
      !> Energy per crack area; final over onset opening of a straight path; the load
      real(wp), intent(in) :: toughness, r, f
      !> Energy lost so far, and damage
      real(wp), intent(in) :: spent, before
      !> Damage, and the energy that it took
      real(wp), intent(out) :: after, lost

      real(wp) :: g, left

      after = before
      lost = 0.0_wp
      if (.not. before < 1.0_wp) return
      left = 1.0_wp - spent/toughness
      if (left < round_off) left = 0.0_wp
      g = left/(1.0_wp - before)
      if (f <= g) return
      if (g < r) then
         ! a toughness that falls below what is spent leaves nothing
         after = merge(1.0_wp, (f - left - before*f*g/r)/(f*(1.0_wp - g/r)), left <= 0.0_wp)
         after = min(max(after, before), 1.0_wp)
      else
         after = 1.0_wp
      end if
      if (left <= 0.0_wp) g = f
      lost = toughness*(after - before)*min(f, max(r, g))*g/r
   end subroutine grow_point

   !> Share of sliding in the elastic energy of the intact interface, and the square of the load
   pure subroutine find_modes(self, opening, traction, mix, load)
      class(softening_type), intent(in) :: self
      !> Opening, and traction of the intact interface
      real(wp), intent(in) :: opening(lanes, 3), traction(lanes, 3)
      !> The share, from 0 to 1; square of the load with the strengths of the law, 1 at the onset
      real(wp), intent(out) :: mix(lanes), load(lanes)

      real(wp) :: across, along
      integer :: l

      !$omp simd private(across, along)
      do l = 1, lanes
         ! twice the elastic energies of both modes
         across = traction(l, 3)*max(opening(l, 3), 0.0_wp)
         along = traction(l, 1)*opening(l, 1) + traction(l, 2)*opening(l, 2)
         mix(l) = along/(across + along + tiny(1.0_wp))
         load(l) = self%onset(normal)*across + self%onset(shear)*along
      end do
   end subroutine find_modes

   !> Share of the toughness that a straight path in one mode has spent at a damage
   elemental real(wp) function spent_share(self, mode, damage) result(share)
      class(softening_type), intent(in) :: self
      !> `normal` or `shear`
      integer, intent(in) :: mode
      !> Damage from 0 to 1
      real(wp), intent(in) :: damage

      real(wp) :: r

      r = 2.0_wp*self%toughness(mode)*self%onset(mode)
      share = damage/(r - damage*(r - 1.0_wp))
   end function spent_share

   !> Energies per crack area at mixes of modes
   pure subroutine find_toughness(self, mix, toughness)
      class(softening_type), intent(in) :: self
      !> Share of the energy that is of shear, from 0 to 1
      real(wp), intent(in) :: mix(lanes)
      !> Energy per crack area
      real(wp), intent(out) :: toughness(lanes)

      real(wp) :: opening, sliding
      integer :: l

      associate (each => self%toughness, exponent => self%exponent)
         if (self%criterion == benzeggagh_kenane) then
            !$omp simd private(sliding)
            do l = 1, lanes
               sliding = exp(exponent*log(max(mix(l), smallest)))
               toughness(l) = each(1)*(1.0_wp - sliding) + each(2)*sliding
            end do
         else
            !$omp simd private(opening, sliding)
            do l = 1, lanes
               opening = exp(exponent*log(max(1.0_wp - mix(l), smallest)/each(1)))
               sliding = exp(exponent*log(max(mix(l), smallest)/each(2)))
               toughness(l) = exp(-log(opening + sliding)/exponent)
            end do
         end if
      end associate
   end subroutine find_toughness

   !> A number that the final over onset opening is not below for any mix of modes: in an interval
   !> the least toughness is at an end, and so is the least of what it is multiplied with
   pure real(wp) function least_ratio(self) result(least)
      class(softening_type), intent(in) :: self

      real(wp) :: ends(2), mix(lanes), toughness(lanes)
      integer :: i

      least = huge(least)
      do i = 1, intervals
         ends(:) = real([i - 1, i], wp)/intervals
         mix(:) = ends(2)
         mix(1) = ends(1)
         call self%find_toughness(mix, toughness)
         least = min(least, sure*2.0_wp*minval(toughness) &
            & *minval(self%onset(normal)*(1.0_wp - ends) + self%onset(shear)*ends))
      end do
   end function least_ratio

   !> Energy per crack area at a mix of modes
   pure real(wp) function toughness_of(self, mix)
      class(softening_type), intent(in) :: self
      !> Share of the energy that is of shear, from 0 to 1
      real(wp), intent(in) :: mix

      real(wp) :: toughness(lanes)

      call self%find_toughness(spread(mix, 1, lanes), toughness)
      toughness_of = toughness(1)
   end function toughness_of

end module plydyn_law_cohesive_softening
