!> Softening of fibres on two lines (Davila, Rose and Camanho, 2009).
!>
!> Two laws of linear softening side by side, each with a share of the strength and of the fracture
!> energy, begin at one strain and end at two. Together they fall steeply first, from the strength
!> to a kink, and then slowly to zero: stress is the larger of two lines. One line is the same with
!> all of the strength and of the energy in the first law.
module plydyn_law_ply_fibre_lines
   use plydyn_base_precision, only : lanes, wp
   implicit none
   private

   public :: first_reach, last_reach, tail_share, kink_of
   public :: first_line_end, strain_on_tail, stress_on_tail

   !> Lines of the lanes of a batch, in tension and in compression
   type, public :: fibre_lines_type
      !> Whether any lane has a second line
      logical :: any = .false.
      !> Share of the strength in the law that ends last; 0 on one line
      real(wp) :: tail(lanes, 2) = 0.0_wp
      !> End of the law that ends last over that of the other, both counted from zero strain
      real(wp) :: reach(lanes, 2) = 1.0_wp
   contains
      procedure :: set_lane
   end type fibre_lines_type

   !> Least ratio of the strains at the end of a law and at onset
   real(wp), parameter, public :: at_once = 1.0_wp + 1.0e-6_wp
   !> Keeps divisors off zero where nothing has begun
   real(wp), parameter :: small = 1.0e-30_wp

contains

   !> End of the law that ends first over the end of one line with the same strength and energy: the
   !> widest crack band is as much narrower
   elemental real(wp) function first_reach(strength, energy) result(reach)
      !> Shares of the strength and of the fracture energy in one of the laws, 1 and 1 on one line
      real(wp), intent(in) :: strength, energy

      reach = 1.0_wp
      if (strength < 1.0_wp) reach = min(energy/strength, (1.0_wp - energy)/(1.0_wp - strength))
   end function first_reach

   !> The same for the law that ends last
   elemental real(wp) function last_reach(strength, energy) result(reach)
      !> As in `first_reach`
      real(wp), intent(in) :: strength, energy

      reach = 1.0_wp
      if (strength < 1.0_wp) reach = max(energy/strength, (1.0_wp - energy)/(1.0_wp - strength))
   end function last_reach

   !> Share of the strength in the law that ends last; 0 on one line
   elemental real(wp) function tail_share(strength, energy) result(share)
      !> As in `first_reach`
      real(wp), intent(in) :: strength, energy

      share = merge(1.0_wp - strength, strength, energy <= strength)
      if (last_reach(strength, energy) <= first_reach(strength, energy)) share = 0.0_wp
   end function tail_share

   !> Strain at the kink, where the law that ends first ends, and the share of the strength there
   pure function kink_of(onset, last, tail, reach) result(kink)
      !> Strains at onset and at the end of the law that ends last; its share of the strength, and
      !> the ratio of the two ends
      real(wp), intent(in) :: onset, last, tail, reach
      real(wp) :: kink(2)

      kink(1) = max(last/reach, onset*at_once)
      kink(2) = stress_on_tail(onset, last, tail, kink(1))
   end function kink_of

   !> Give a lane the shares of its material
   pure subroutine set_lane(self, lane, strength, energy)
      class(fibre_lines_type), intent(inout) :: self
      integer, intent(in) :: lane
      !> Shares of the strength and of the energy in the first law, in tension and in compression
      real(wp), intent(in) :: strength(2), energy(2)

      self%tail(lane, :) = tail_share(strength, energy)
      self%reach(lane, :) = last_reach(strength, energy)/first_reach(strength, energy)
      self%any = any(self%tail > 0.0_wp)
   end subroutine set_lane

   !> Strain at which the first of the two lines would meet zero: the end of a single line, and 0
   !> before onset
   elemental real(wp) function first_line_end(onset, last, tail, reach) result(finish)
      !> As in `kink_of`
      real(wp), intent(in) :: onset, last, tail, reach

      real(wp) :: first

      first = max(last/reach, onset*at_once)
      finish = onset + 1.0_wp/((1.0_wp - tail)/max(first - onset, small) &
         & + tail/max(last - onset, small))
      finish = merge(finish, last, min(tail, last - onset) > 0.0_wp)
   end function first_line_end

   !> Share of the strength on the second line; 0 on one line
   elemental real(wp) function stress_on_tail(onset, last, tail, strain) result(share)
      !> As in `kink_of`; strain along the fibres
      real(wp), intent(in) :: onset, last, tail, strain

      share = tail*max(last - strain, 0.0_wp)/max(last - onset, small)
   end function stress_on_tail

   !> Strain on the second line that belongs to a damage; 0 on one line
   elemental real(wp) function strain_on_tail(onset, last, tail, damage) result(strain)
      !> As in `kink_of`; damage
      real(wp), intent(in) :: onset, last, tail, damage

      strain = tail*onset*last/max((1.0_wp - damage)*(last - onset) + tail*onset, small)
   end function strain_on_tail

end module plydyn_law_ply_fibre_lines
