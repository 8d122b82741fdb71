!> Fibres that soften on two lines: the sum of two laws, in closed form.
program test_law_ply_fibre_lines
   use plydyn_base_precision, only : wp
   use plydyn_law_ply_constants, only : ply_constants_type, snap_drop
   use plydyn_law_ply_fibre_lines, only : first_line_end, first_reach, kink_of, last_reach, &
      & stress_on_tail, tail_share
   use plydyn_law_ply_history, only : fibre_damage
   use ply_point, only : new_point, paper_ply, point_type
   use testing, only : begin, check, finish
   implicit none

   !> Shares of the strength and of the energy in one of the laws; widths of the crack band
   real(wp), parameter :: strength_share = 0.75_wp, energy_share = 0.375_wp
   real(wp), parameter :: narrow(2) = [1.0_wp, 0.25_wp]
   real(wp), parameter :: modulus = 153.0e3_wp
   !> Strengths and energies of fibres in tension and in compression
   real(wp), parameter :: strengths(2) = [2537.0_wp, 1580.0_wp], energies(2) = [91.6_wp, 79.9_wp]
   !> Steps of a fine path
   integer, parameter :: steps = 8000

   call test_shares()
   call test_stress(1, .false.)
   call test_stress(2, .false.)
   call test_stress(1, .true.)
   call test_energy()
   call test_unloading()
   call test_wide_band()
   call test_drop()
   call finish()

contains

   !> The paper's ply without Poisson's effect, fibres on two lines
   pure function two_lines(closes) result(ply)
      logical, intent(in), optional :: closes
      type(ply_constants_type) :: ply

      ply = paper_ply()
      ply%poisson(:) = 0.0_wp
      ply%residual = 1.0e-9_wp
      ply%line_strength(:) = strength_share
      ply%line_toughness(:) = energy_share
      if (present(closes)) ply%closes = closes
   end function two_lines

   !> Strain at the end of each law, were it alone with its stiffness
   pure function ends(sense, length) result(last)
      integer, intent(in) :: sense
      real(wp), intent(in) :: length
      real(wp) :: last(2)

      last(:) = 2.0_wp*energies(sense)/(strengths(sense)*length)*[energy_share/strength_share, &
         & (1.0_wp - energy_share)/(1.0_wp - strength_share)]
   end function ends

   !> Sum of the two laws at a strain beyond onset
   pure real(wp) function sum_of_laws(sense, length, strain) result(stress)
      integer, intent(in) :: sense
      real(wp), intent(in) :: length, strain

      real(wp) :: last(2), onset

      onset = strengths(sense)/modulus
      last(:) = ends(sense, length)
      stress = strengths(sense)*sum([strength_share, 1.0_wp - strength_share] &
         & *max(last - strain, 0.0_wp)/(last - onset))
   end function sum_of_laws

   !> Shares of either law give the same; equal shares, and all of both, are one line
   subroutine test_shares()
      real(wp), parameter :: onset = 0.01_wp, last = 0.05_wp

      call begin("shares of two laws")
      call check(first_reach(0.75_wp, 0.375_wp), 0.5_wp, 1.0e-15_wp, "the first ends half-way")
      call check(last_reach(0.75_wp, 0.375_wp), 2.5_wp, 1.0e-15_wp, "the last far beyond")
      call check(first_reach(0.25_wp, 0.625_wp), 0.5_wp, 1.0e-15_wp, "in any order")
      call check(last_reach(0.25_wp, 0.625_wp), 2.5_wp, 1.0e-15_wp, "of the two")
      call check(tail_share([0.75_wp, 0.25_wp, 0.5_wp, 1.0_wp], [0.375_wp, 0.625_wp, 0.5_wp, &
         & 1.0_wp]), [0.25_wp, 0.25_wp, 0.0_wp, 0.0_wp], 0.0_wp, "strength of the last")
      call check(first_line_end(onset, last, 0.0_wp, 1.0_wp), last, 0.0_wp, "one line ends there")
      associate (kink => kink_of(onset, last, 0.25_wp, 5.0_wp/3.0_wp))
         call check(kink, [0.03_wp, 0.125_wp], 1.0e-15_wp, "the kink is where the first ends")
         call check((first_line_end(onset, last, 0.25_wp, 5.0_wp/3.0_wp) - kink(1))/(kink(1) &
            & - onset), kink(2)/(1.0_wp - kink(2)), 1.0e-13_wp, "on the first line")
      end associate
      call check(stress_on_tail(onset, last, 0.25_wp, 0.06_wp), 0.0_wp, 0.0_wp, "none behind it")
   end subroutine test_shares

   !> Stress before the kink, at it, behind it and at the end
   subroutine test_stress(sense, closes)
      integer, intent(in) :: sense
      logical, intent(in) :: closes

      type(point_type) :: point
      real(wp) :: last(2), onset, strain(6), sign_of
      integer :: i

      call begin("stress on two lines, "//merge("tension    ", "compression", sense == 1))
      last(:) = ends(sense, narrow(1))
      onset = strengths(sense)/modulus
      sign_of = merge(1.0_wp, -1.0_wp, sense == 1)
      strain(:) = [onset*1.000001_wp, 0.5_wp*(onset + last(1)), last(1), 0.5_wp*sum(last), &
         & 0.99_wp*last(2), 1.01_wp*last(2)]
      point = new_point(two_lines(closes), narrow)
      do i = 1, size(strain)
         call point%pull(1, sign_of*strain(i), 0.0_wp)
         call check(sign_of*point%stress(1), sum_of_laws(sense, narrow(1), strain(i)), &
            & 1.0e-7_wp*strengths(sense), "is that of both laws")
      end do
      call check(last(1) > 1.05_wp*onset, "both laws soften")
   end subroutine test_stress

   !> All of the energy of the crack is dissipated, work less what is stored to round-off
   subroutine test_energy()
      type(point_type) :: point
      real(wp) :: last(2), off
      integer :: i, sense

      do sense = 1, 2
         call begin("energy of two lines, "//merge("tension    ", "compression", sense == 1))
         last(:) = ends(sense, narrow(1))
         point = new_point(two_lines(), narrow)
         off = 0.0_wp
         do i = 1, steps
            call point%pull(1, merge(1.0_wp, -1.0_wp, sense == 1)*1.01_wp*last(2)*real(i, wp) &
               & /real(steps, wp), 0.0_wp)
            off = max(off, abs(point%work - point%stored() - point%dissipated()))
         end do
         call check(off, 0.0_wp, 1.0e-12_wp*energies(sense), "work is stored or dissipated")
         ! the step that meets the kink cuts its corner
         call check(point%dissipated()*narrow(1)/energies(sense), 1.0_wp, 10.0_wp/real(steps, wp), &
            & "the energy of the crack")
      end do
   end subroutine test_energy

   !> Unloading goes to the origin, from the first line and from the second; reloading comes back
   subroutine test_unloading()
      type(point_type) :: point
      real(wp) :: damage, last(2), onset, strain(2), stress
      integer :: i

      call begin("unloading from two lines")
      last(:) = ends(1, narrow(1))
      onset = strengths(1)/modulus
      strain(:) = [0.5_wp*(onset + last(1)), 0.5_wp*sum(last)]
      point = new_point(two_lines(), narrow)
      do i = 1, 2
         call point%pull(1, strain(i), 0.0_wp)
         damage = point%history(fibre_damage)
         stress = point%stress(1)
         call point%pull(1, 0.3_wp*strain(i), 0.0_wp)
         call check(point%stress(1), 0.3_wp*stress, 1.0e-9_wp*stress, "to the origin")
         call point%pull(1, strain(i), 0.0_wp)
         call check(point%stress(1), stress, 1.0e-9_wp*stress, "and back")
         call check(point%history(fibre_damage), damage, 1.0e-15_wp, "without growth")
      end do
   end subroutine test_unloading

   !> Where the band is too wide for the steeper law damage starts early, at the right energy
   subroutine test_wide_band()
      type(point_type) :: point
      type(ply_constants_type) :: ply
      real(wp) :: longest(5), strength, wide
      integer :: i

      call begin("wide band on two lines")
      ply = two_lines()
      longest(:) = ply%longest_lengths()
      call check(longest(1), 0.5_wp*2.0_wp*modulus*energies(1)/strengths(1)**2, 1.0e-12_wp, &
         & "the widest is that of the steeper law")
      wide = 1.5_wp*longest(1)
      call check(all(ply%snaps_back([wide, 0.01_wp]) .eqv. [.true., wide > longest(2)/1.05_wp, &
         & .false., .false., .false.]), "is reported")
      strength = sqrt(modulus*energies(1)/(1.05_wp*wide))
      point = new_point(ply, [wide, narrow(2)])
      call point%pull(1, strength/modulus*(1.0_wp - 1.0e-9_wp), 0.0_wp)
      call check(point%history(fibre_damage), 0.0_wp, 0.0_wp, "none below the reduced strength")
      do i = 0, steps
         call point%pull(1, strength/modulus + real(i, wp)/real(steps, wp)*5.3_wp &
            & *strength/modulus, 0.0_wp)
      end do
      call check(point%stress(1), 0.0_wp, 1.0e-3_wp, "has ended")
      call check(point%dissipated()*wide/energies(1), 1.0_wp, 10.0_wp/real(steps, wp), "its energy")
   end subroutine test_wide_band

   !> Where stress drops at once only the steeper law does: the other goes on
   subroutine test_drop()
      type(point_type) :: point
      type(ply_constants_type) :: ply
      real(wp) :: onset, wide

      call begin("drop of the steeper law")
      ply = two_lines()
      ply%snap_back = snap_drop
      wide = 1.2_wp*modulus*energies(1)/strengths(1)**2
      onset = strengths(1)/modulus
      point = new_point(ply, [wide, narrow(2)])
      call point%pull(1, onset*(1.0_wp - 1.0e-9_wp), 0.0_wp)
      call check(point%stress(1), strengths(1), 1.0e-5_wp, "at the strength")
      call point%pull(1, onset*1.01_wp, 0.0_wp)
      associate (last => ends(1, wide))
         call check(point%stress(1), (1.0_wp - strength_share)*strengths(1) &
            & *(last(2) - 1.01_wp*onset)/(last(2) - onset), 1.0e-6_wp, "to the line of the other")
      end associate
   end subroutine test_drop

end program test_law_ply_fibre_lines
