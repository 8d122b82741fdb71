!> Damage of an interface by the work of both modes, for paths on which the mode changes.
!>
!> On a straight path the share s of the toughness that is spent is (f - 1)/(r - 1), so that
!> (1 - d) f = 1 - s: the tractions fall in proportion to the share that is left. This is kept for
!> all paths, with s = D/G_c(D_s/D), where D and D_s are the energies lost so far, in all and in
!> sliding. Damage d has lost all of the work at failure, of each mode its own; so the work is the
!> toughness of the ratio of both works, whatever the path and the stiffnesses. On a straight path,
!> and in a pure mode, this is the law of `softening.f90`.
module plydyn_law_cohesive_work_growth
   use plydyn_base_precision, only : lanes, wp
   use plydyn_law_cohesive_softening, only : damage_at, fracture_at, fracture_only, most_points, &
      & normal, share_at, shear, softening_type
   use plydyn_law_cohesive_toughness, only : find_toughness
   implicit none
   private

   public :: detect_growth_by_work, grow_by_work

   !> Times that the ratio of works is found from what the step adds to them
   integer, parameter :: passes = 2

   !> Share of the toughness that counts as none: damage comes to 1, whatever the rounding
   real(wp), parameter :: round_off = 1.0e-12_wp

contains

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
         call find_toughness(self%criterion, self%exponent, self%toughness, ratio, toughness)
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

end module plydyn_law_cohesive_work_growth
