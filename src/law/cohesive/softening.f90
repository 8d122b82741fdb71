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
module plydyn_law_cohesive_softening
   use plydyn_base_precision, only : lanes, wp
   use plydyn_law_cohesive_toughness, only : benzeggagh_kenane, find_toughness
   implicit none
   private

   !> Places of the two modes in pairs of constants
   integer, parameter, public :: normal = 1, shear = 2

   !> History of a point, zero for an intact one: damage from 0 to 1; energy per area lost in
   !> fracture, and its share of the toughness, 1 where the damage is 1; energies released by a
   !> falling penalty, and lost in friction; slip of
   !> the failed faces along x and y; elastic part of the sliding under friction. A law has
   !> the first of them, as many as it needs; where damage grows by work it has all, and behind them
   !> the energies per area lost in opening and in sliding
   integer, parameter, public :: damage_at = 1, fracture_at = 2, share_at = 3, closing_at = 4, &
      & friction_at = 5, slip_at = 6, stretch_at = 8

   !> Histories without and with a falling penalty, and with friction
   integer, parameter, public :: fracture_only = 3, with_closing = 4, with_friction = 8

   !> Share of the toughness from which on a point counts as delaminated
   real(wp), parameter, public :: delaminated_share = 0.5_wp

   !> Most points in a call: work space of fixed size can be aligned
   integer, parameter, public :: most_points = 9

   !> Onset and toughness
   type, public :: softening_type
      !> Square of the load per twice the elastic energy of each mode, K/N**2 and K/S**2
      real(wp) :: onset(2) = 0.0_wp
      !> Energies G_Ic and G_IIc per crack area
      real(wp) :: toughness(2) = 0.0_wp
      !> Toughness of mixed modes, a law of `toughness.f90`, and its exponent
      integer :: criterion = benzeggagh_kenane
      real(wp) :: exponent = 1.0_wp
      !> Part of the damage d by which the load at which it grows is at least 1/(1 - part*d)
      real(wp) :: part = 0.0_wp
   contains
      procedure :: detect_growth
      procedure :: find_modes
      procedure :: grow_damage
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
      call find_toughness(self%criterion, self%exponent, self%toughness, mix, toughness)
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

   !> Energy per crack area at a mix of modes
   pure real(wp) function toughness_of(self, mix)
      class(softening_type), intent(in) :: self
      !> Share of the energy that is of shear, from 0 to 1
      real(wp), intent(in) :: mix

      real(wp) :: toughness(lanes)

      call find_toughness(self%criterion, self%exponent, self%toughness, &
         & spread(mix, 1, lanes), toughness)
      toughness_of = toughness(1)
   end function toughness_of

end module plydyn_law_cohesive_softening
