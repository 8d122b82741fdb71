!> Damage grows as the stress has to fall, and never heals.
program test_law_ply_damage_growth
   use plydyn_base_precision, only : lanes, wp
   use plydyn_law_ply_damage_growth, only : can_grow, find_growth_strains, grow
   use plydyn_law_ply_constants, only : ply_constants_type
   use plydyn_law_ply_fibre_lines, only : fibre_lines_type
   use plydyn_law_ply_history, only : fibre_damage
   use ply_point, only : new_point, paper_ply, point_type
   use testing, only : begin, check, finish
   implicit none

   !> Crack bands narrow enough for every mode
   real(wp), parameter :: narrow(2) = [1.0_wp, 0.25_wp]
   !> Softening on one line
   type(fibre_lines_type), parameter :: one_line = fibre_lines_type()
   !> Steps of a fine path
   integer, parameter :: steps = 16000

   call test_grow()
   call test_can_grow()
   call test_limits()
   call test_plateau()
   call finish()

contains

   !> What is said to stay, stays; what is said to grow, grows: tension and compression, with a
   !> plateau
   subroutine test_can_grow()
      real(wp), parameter :: onset = 0.01_wp, last = 0.05_wp
      integer, parameter :: tries = 2000
      real(wp) :: before, limit(lanes, 2), mode(lanes, 3, 2), path(2), plateau(lanes, 2)
      real(wp) :: share(lanes, 2), strain(lanes, 2)
      integer :: growing, i, wrong
      logical :: grows

      call begin("can_grow")
      growing = 0
      wrong = 0
      do i = 1, tries
         mode(:, :, :) = 0.0_wp
         mode(:, 2, 1) = merge(onset, -onset, mod(i, 2) == 0)
         mode(:, 3, 1) = last
         plateau(:, :) = merge(0.3_wp, 0.0_wp, mod(i, 3) == 0)
         call random_number(path)
         strain(:, :) = onset + (last - onset)*path(1)
         call grow(plateau, one_line, strain, mode, share)
         before = mode(1, 1, 1)
         strain(:, :) = onset + 1.2_wp*(last - onset)*path(2)
         call find_growth_strains(plateau, one_line, mode, limit)
         grows = can_grow(strain, limit)
         call grow(plateau, one_line, strain, mode, share)
         if (grows) growing = growing + 1
         if (grows .neqv. mode(1, 1, 1) > before + 1.0e-12_wp) wrong = wrong + 1
      end do
      call check(wrong == 0, "tells whether damage grows")
      call check(growing > tries/5 .and. growing < tries - tries/5, "both ways")
      mode(:, :, :) = 0.0_wp
      call find_growth_strains(plateau, one_line, mode, limit)
      call check(.not. can_grow(strain, limit), "nothing does before onset")
   end subroutine test_can_grow

   !> The strain of which damage is left; on a plateau; none before onset and at the end
   subroutine test_limits()
      real(wp), parameter :: onset = 0.01_wp, last = 0.05_wp, reached(3) = [0.02_wp, 0.045_wp, &
         & 0.06_wp]
      real(wp) :: limit(lanes, 2), mode(lanes, 3, 2), plateau(lanes, 2)
      real(wp) :: share(lanes, 2), strain(lanes, 2)
      integer :: i

      call begin("find_limits")
      plateau(:, 1) = 0.3_wp
      plateau(:, 2) = 0.0_wp
      mode(:, 1, :) = 0.0_wp
      mode(:, 2, :) = -onset
      mode(:, 3, :) = last
      call find_growth_strains(plateau, one_line, mode, limit)
      call check(limit(1, :), [onset, onset], 1.0e-15_wp, "onset at first")
      do i = 1, 3
         strain(:, :) = reached(i)
         call grow(plateau, one_line, strain, mode, share)
         call find_growth_strains(plateau, one_line, mode, limit)
         call check(limit(1, 1), reached(i), 1.0e-14_wp, "the strain that it has come to")
      end do
      call check(limit(1, 2) > 1.0e6_wp, "nothing grows that is complete")
      mode(:, :, :) = 0.0_wp
      call find_growth_strains(plateau, one_line, mode, limit)
      call check(all(limit > 1.0e6_wp), "nothing grows before onset")
   end subroutine test_limits

   !> One mode from onset to the end and back, and one that has not begun
   subroutine test_grow()
      real(wp), parameter :: onset = 0.01_wp, last = 0.05_wp
      real(wp) :: damage, mode(lanes, 3, 2), plateau(lanes, 2)
      real(wp) :: share(lanes, 2), strain(lanes, 2)

      call begin("grow")
      mode(:, :, :) = 0.0_wp
      mode(:, 2, 1) = onset
      mode(:, 3, 1) = last
      plateau(:, :) = 0.3_wp
      strain(:, :) = 0.03_wp
      call grow(plateau, one_line, strain, mode, share)
      ! half of the strength at three times the strain
      call check(mode(:, 1, 1), spread(5.0_wp/6.0_wp, 1, lanes), 1.0e-15_wp, &
         & "leaves the secant to the falling line; a plateau is for compression")
      call check(share(:, 1), spread(onset/0.03_wp, 1, lanes), 1.0e-15_wp, "came from onset")
      call check(maxval(abs(mode(:, 1, 2))), 0.0_wp, 0.0_wp, "does nothing before onset")
      damage = mode(1, 1, 1)
      strain(:, 1) = 0.02_wp
      call grow(plateau, one_line, strain, mode, share)
      call check(mode(1, 1, 1), damage, 0.0_wp, "does not heal")
      strain(:, 1) = 0.04_wp
      call grow(plateau, one_line, strain, mode, share)
      call check(share(1, 1), 0.75_wp, 1.0e-14_wp, "goes on from where it was")
      strain(:, 1) = 0.07_wp
      call grow(plateau, one_line, strain, mode, share)
      call check(mode(1, 1, 1), 1.0_wp, 0.0_wp, "ends with all")
      call check(share(1, 1), 4.0_wp/7.0_wp, 1.0e-14_wp, "from the last strain that it knew")
      strain(:, 1) = 0.09_wp
      call grow(plateau, one_line, strain, mode, share)
      call check(mode(1, 1, 1), 1.0_wp, 0.0_wp, "and not with more")

      mode(:, 2, 1) = -onset
      mode(:, 1, 1) = 0.0_wp
      strain(:, 1) = 0.06_wp
      call grow(plateau, one_line, strain, mode, share)
      call check(mode(1, 1, 1), 1.0_wp - 0.3_wp*onset/0.06_wp, 1.0e-15_wp, &
         & "keeps the plateau in compression")
      strain(:, 1) = 0.08_wp
      call grow(plateau, one_line, strain, mode, share)
      call check(share(1, 1), 0.75_wp, 1.0e-14_wp, "goes on along the plateau")
   end subroutine test_grow

   !> Crushed fibres keep a share of their strength
   subroutine test_plateau()
      real(wp), parameter :: kept = 0.2_wp
      type(point_type) :: point
      type(ply_constants_type) :: ply
      real(wp) :: bend, onset
      integer :: i

      call begin("plateau")
      ply = paper_ply()
      ply%plateau = kept
      onset = 1580.0_wp/153.0e3_wp
      bend = kept*onset + 2.0_wp*79.9_wp/(narrow(1)*1580.0_wp*(1.0_wp - kept))
      point = new_point(ply, narrow)
      call point%pull(1, -0.5_wp*(onset + bend), 0.0_wp)
      call check(point%stress(1), -0.5_wp*(1.0_wp + kept)*1580.0_wp, 1.0e-6_wp, "is met by a line")
      do i = 0, 2
         call point%pull(1, -bend*(1.0_wp + 0.5_wp*real(i, wp)), 0.0_wp)
         call check(point%stress(1), -kept*1580.0_wp, 1.0e-6_wp, "holds the stress")
      end do

      point = new_point(ply, narrow)
      do i = 1, steps
         call point%pull(1, -2.0_wp*bend*real(i, wp)/real(steps, wp), 0.0_wp)
      end do
      ! triangle above the plateau, and half of the plateau's work up to the secant
      call check(point%dissipated(), 79.9_wp/narrow(1) + kept*1580.0_wp*(2.0_wp*bend &
         & - 0.5_wp*kept*onset) - 0.5_wp*kept*1580.0_wp*2.0_wp*bend, &
         & 1.0e-5_wp*point%dissipated(), "dissipates the toughness above it, and its own work")
      point = new_point(ply, narrow)
      call point%pull(1, 1.05_wp*2.0_wp*91.6_wp/2537.0_wp, 0.0_wp)
      call check(damage(point), 1.0_wp, 0.0_wp, "is not there in tension")
   end subroutine test_plateau

   !> Damage of the fibres of a point
   pure real(wp) function damage(point)
      type(point_type), intent(in) :: point

      damage = point%history(fibre_damage)
   end function damage

end program test_law_ply_damage_growth
