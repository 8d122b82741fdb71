!> Cracks at one doubled node: ties, and tractions that are the slope of an energy, however the ply
!> has turned.
program test_element_cracked_crack_lines
   use plydyn_base_exact_sum, only : exact_sums_type, new_exact_sums
   use plydyn_base_precision, only : lanes, wp
   use plydyn_element_cracked_crack_lines, only : add_crack_energy, crack_lines_type, hold_crack
   use plydyn_law_matrix_crack, only : apart_at, crack_histories, damage_at, final_at, mode_at, &
      & onset_at, time_at
   use testing, only : begin, check, finish
   implicit none

   !> Thickness and area of the crack, mm and mm2; the lane under test, whose fibres lie at an angle
   real(wp), parameter :: thickness = 0.5_wp, area = 0.75_wp, angle = 0.6_wp
   integer, parameter :: lane = 3
   !> Length of a column: two faces of eight lanes
   integer, parameter :: height = 3*2*lanes
   !> Difference of displacements for slopes, mm
   real(wp), parameter :: small = 1.0e-6_wp

   type(crack_lines_type) :: lines
   real(wp) :: force(2*height), history(lanes, crack_histories, 1), mass(2*height/3), u(2*height)

   call build()
   call check_ties()
   call check_start()
   call check_slopes()
   call finish()

contains

   !> One node and its twin
   subroutine build()
      allocate (lines%zones(1))
      allocate (lines%zones(1)%law(1), lines%zones(1)%fibre(lanes, 2, 1))
      associate (zone => lines%zones(1))
         zone%fibre(:, 1, :) = cos(angle)
         zone%fibre(:, 2, :) = sin(angle)
         zone%law(1)%strength(:, :) = spread([60.0_wp, 110.0_wp, 75.0_wp], 1, lanes)
         zone%law(1)%stiffness(:) = 5.0e4_wp
         zone%law(1)%thickness(:) = thickness
         zone%law(1)%toughness = 0.3_wp
      end associate
      lines%column = reshape([1, 2], [2, 1])
      lines%zone = [1]
      lines%own = [.true.]
      lines%whole = 1
      lines%blocks = 1
      lines%first = 1
      lines%first_mass = 1
      lines%height = height
      allocate (lines%area(lanes, 1, 1), source=0.0_wp)
      lines%area(lane, 1, 1) = area
   end subroutine build

   !> Place of a displacement of the lane under test
   pure integer function at(column, face, direction)
      integer, intent(in) :: column, face, direction

      at = height*(column - 1) + lane + lanes*(face - 1 + 2*(direction - 1))
   end function at

   !> Both copies accelerate alike, their forces together stay, and a weak pull starts no crack
   subroutine check_ties()
      real(wp) :: before(2*height)
      integer :: d, f

      call begin("ties")
      mass(:) = [1.0_wp, (1.0_wp + 0.25_wp*mod(f, 5), f=2, size(mass))]
      u(:) = 0.0_wp
      history(:, :, :) = 0.0_wp
      before(:) = [(sin(real(3*f, wp)), f=1, size(before))]
      force(:) = before
      call hold_crack(lines, 1, 1.0_wp, mass, u, history, force)
      do d = 1, 3
         do f = 1, 2
            associate (own => at(1, f, d), twin => at(2, f, d), m => lane + lanes*(f - 1))
               call check(force(own)/mass(m), force(twin)/mass(height/3 + m), 1.0e-14_wp, &
                  & "both copies have one acceleration")
               call check(force(own) + force(twin), before(own) + before(twin), 1.0e-14_wp, &
                  & "and the forces of both")
               force([own, twin]) = before([own, twin])
            end associate
         end do
      end do
      call check(maxval(abs(force - before)), 0.0_wp, 0.0_wp, "lanes without a crack keep theirs")
      call check(maxval(abs(history)), 0.0_wp, 0.0_wp, "no crack starts")
   end subroutine check_ties

   !> A crack starts where the mean traction of both faces reaches the strength across, and not
   !> below it; its tractions are then those of the tie
   subroutine check_start()
      real(wp) :: pull, share

      call begin("start")
      mass(:) = 1.0_wp
      share = 0.999_wp
      do while (share < 1.01_wp)
         ! half of the traction on each face, and as much the other way on the twin
         pull = share*60.0_wp*area/2.0_wp
         force(:) = 0.0_wp
         force([at(1, 1, 1), at(1, 2, 1)]) = sin(angle)*pull
         force([at(1, 1, 2), at(1, 2, 2)]) = -cos(angle)*pull
         force([at(2, 1, 1), at(2, 2, 1)]) = -sin(angle)*pull
         force([at(2, 1, 2), at(2, 2, 2)]) = cos(angle)*pull
         call hold_crack(lines, 1, 2.5_wp, mass, u, history, force)
         if (share < 1.0_wp) call check(maxval(abs(history)), 0.0_wp, 0.0_wp, "not below it")
         share = share + 0.002_wp
      end do
      call check(history(lane, time_at, 1), 2.5_wp, 0.0_wp, "the time is noted")
      call check(history(lane, mode_at, 1), 0.0_wp, 1.0e-12_wp, "it opens")
      call check(5.0e4_wp*(history(lane, final_at, 1) - history(lane, onset_at, 1)) &
         & *history(lane, onset_at, 1), 0.6_wp, 1.0e-12_wp, "the toughness is what softening takes")
      force(:) = 0.0_wp
      call hold_crack(lines, 1, 2.6_wp, mass, u, history, force)
      call check(force(at(1, 1, 1)), -1.001_wp*60.0_wp*sin(angle)*area/2.0_wp, 1.0e-9_wp, &
         & "along x it begins with the traction of the tie")
      call check(force(at(2, 2, 2)), -1.001_wp*60.0_wp*cos(angle)*area/2.0_wp, 1.0e-9_wp, &
         & "and along y on the twin")
   end subroutine check_start

   !> Without friction forces are the slope of the energy, for open and for closed faces, intact and
   !> broken ones, in plies that have turned far: no energy is made
   subroutine check_slopes()
      real(wp) :: kept(lanes, crack_histories, 1), slope, total(3), x(3)
      integer :: case, column, d, f

      do case = 1, 4
         call begin("slopes "//achar(iachar("0") + case))
         ! closed: the twin goes back across the crack
         u(:) = 0.0_wp
         do column = 1, 2
            do f = 1, 2
               x(:) = [0.3_wp*f, -0.25_wp*f, -0.1_wp*f]
               if (column == 2) x(:) = x + [0.002_wp, 0.001_wp, 0.04_wp + 0.01_wp*f] + merge( &
                  & -0.004_wp, 0.006_wp, mod(case, 2) == 0)*[-sin(angle), cos(angle), 0.0_wp]
               do d = 1, 3
                  u(at(column, f, d)) = x(d)
               end do
            end do
         end do
         history(lane, damage_at, 1) = merge(1.0_wp, 0.4_wp, case > 2)
         ! no damage may grow
         history(lane, final_at, 1) = merge(1.0e3_wp, history(lane, final_at, 1), case <= 2)
         history(lane, onset_at, 1) = merge(10.0_wp, history(lane, onset_at, 1), case <= 2)
         call let_slide()
         kept(:, :, :) = history
         force(:) = 0.0_wp
         call hold_crack(lines, 1, 3.0_wp, mass, u, history, force)
         total(:) = 0.0_wp
         do column = 1, 2
            do f = 1, 2
               do d = 1, 3
                  slope = -(energy_at(at(column, f, d), small, kept) &
                     & - energy_at(at(column, f, d), -small, kept))/(2.0_wp*small)
                  call check(force(at(column, f, d)), slope, 1.0e-5_wp*maxval(abs(force)), &
                     & "force and slope of the energy")
               end do
               total(:) = total + [(force(at(column, f, d)), d=1, 3)]
            end do
         end do
         call check(maxval(abs(total)), 0.0_wp, 1.0e-12_wp*maxval(abs(force)), "forces balance")
         call check(history(lane, apart_at, 1) <= 0.0_wp, "the faces still meet")
      end do
   end subroutine check_slopes

   !> Let what has slid be where it is: without friction it carries nothing
   subroutine let_slide()
      force(:) = 0.0_wp
      call hold_crack(lines, 1, 3.0_wp, mass, u, history, force)
   end subroutine let_slide

   !> Energy with one displacement changed
   real(wp) function energy_at(place, change, kept) result(energy)
      integer, intent(in) :: place
      real(wp), intent(in) :: change, kept(lanes, crack_histories, 1)

      type(exact_sums_type) :: sums
      real(wp) :: moved(2*height), own(lanes, crack_histories, 1), unused(2*height)

      moved(:) = u
      moved(place) = moved(place) + change
      own(:, :, :) = kept
      unused(:) = 0.0_wp
      call hold_crack(lines, 1, 3.0_wp, mass, moved, own, unused)
      sums = new_exact_sums(1)
      call add_crack_energy(lines, moved, own, sums)
      energy = sums%value(1)
   end function energy_at

end program test_element_cracked_crack_lines
