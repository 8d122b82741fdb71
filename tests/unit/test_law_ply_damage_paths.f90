!> Modes of a damaged ply together: mixed, closing, turned, random, and in one batch.
program test_law_ply_damage_paths
   use plydyn_base_precision, only : lanes, wp
   use plydyn_law_ply_elastic, only : ply_stiffness, strain_rotation
   use plydyn_law_law, only : by_ply_plasticity
   use plydyn_law_ply_constants, only : onset_hashin, ply_constants_type
   use plydyn_law_ply_damage, only : ply_damage_type
   use plydyn_law_ply_history, only : fibre_damage, fibre_energy, histories_closing, &
      & histories_open, matrix_damage, matrix_energy, matrix_finish, matrix_onset, &
      & shear_peak, to_compression
   use plydyn_law_ply_shear_curve, only : new_power_curve, new_table_curve
   use ply_point, only : new_point, paper_ply, point_type
   use testing, only : begin, check, finish
   implicit none

   !> Crack bands narrow enough for every mode, with room
   real(wp), parameter :: narrow(2) = [1.0_wp, 0.1_wp]
   !> Waves that make up a random path
   integer, parameter :: waves = 5

   call test_mixed()
   call test_fibre_first()
   call test_onset_of_the_other()
   call test_base_never_closes()
   call test_closing()
   call test_closing_in_shear()
   call test_end_of_compression()
   call test_turned()
   call test_energy(closes=.false.)
   call test_energy(closes=.true.)
   call test_batch()
   call finish()

contains

   !> Tension across and shear in proportion: a line of equivalent stress
   subroutine test_mixed()
      integer, parameter :: steps = 4000
      real(wp), parameter :: ratio = 1.5_wp
      type(point_type) :: point
      type(ply_constants_type) :: ply
      real(wp) :: equivalent, finish_strain, onset, strain, strength
      integer :: i

      call begin("mixed matrix damage")
      ply = paper_ply()
      ply%residual = 1.0e-9_wp
      associate (e => ply%young(2), g => ply%shear(1))
         strain = 1.0_wp/sqrt((e/ply%matrix_strength(1))**2 + (ratio*g/ply%shear_strength)**2)
         onset = strain*sqrt(1.0_wp + ratio**2)
         strength = strain*(e + g*ratio**2)/sqrt(1.0_wp + ratio**2)
      end associate
      finish_strain = 2.0_wp*ply%matrix_toughness(1)/(narrow(2)*strength)
      point = new_point(ply, narrow)
      do i = 1, steps
         equivalent = 1.01_wp*finish_strain*real(i, wp)/real(steps, wp)
         call point%pull(2, equivalent/sqrt(1.0_wp + ratio**2), &
            & ratio*equivalent/sqrt(1.0_wp + ratio**2))
         if (mod(i, steps/8) /= 0 .or. equivalent < onset .or. equivalent > finish_strain) cycle
         call check((point%stress(2) + ratio*point%stress(4))/sqrt(1.0_wp + ratio**2), &
            & strength*(finish_strain - equivalent)/(finish_strain - onset), 1.0e-6_wp*strength, &
            & "falls along a straight line")
      end do
      call check(point%history([matrix_onset, matrix_finish]), [onset, finish_strain], &
         & 1.0e-9_wp, "starts where F2 = 1")
      call check(point%dissipated()*narrow(2)/ply%matrix_toughness(1), 1.0_wp, 1.0e-6_wp, &
         & "dissipates the toughness")
      call check(point%work, point%dissipated(), 1.0e-6_wp*point%work, "which is the work")
   end subroutine test_mixed

   !> Broken fibres before the matrix cracks in shear: no jump where R12 takes over
   subroutine test_fibre_first()
      integer, parameter :: steps = 60000
      real(wp), parameter :: most = 0.06_wp
      type(point_type) :: point
      type(ply_constants_type) :: ply
      real(wp) :: before, jump, left
      integer :: i

      call begin("fibres before matrix")
      ply = paper_ply(curved=.true.)
      point = new_point(ply, narrow)
      call point%pull(1, 0.04_wp, 0.0_wp)
      call point%pull(1, 0.0_wp, 0.0_wp)
      left = 1.0_wp - point%history(fibre_damage)
      call check(left < 0.5_wp .and. left > 0.1_wp, "leaves some of the fibres")
      jump = 0.0_wp
      do i = 1, steps
         before = point%stress(4)
         call point%pull(2, 0.0_wp, most*real(i, wp)/real(steps, wp))
         if (point%history(matrix_damage) > 0.5_wp) exit
         if (point%history(matrix_finish) <= 0.0_wp) cycle
         jump = max(jump, abs(point%stress(4) - before))
      end do
      call check(point%history(matrix_damage) > 0.0_wp, "cracks the matrix")
      call check(jump <= 1.01_wp*left*most/real(steps, wp)*ply%shear_strength &
         & /(point%history(matrix_finish) - point%history(matrix_onset)), &
         & "the stress goes over without a jump")
      call check(point%plastic(), left*plastic_work(ply), &
         & 1.0e-3_wp*left*plastic_work(ply), "plastic work is that on the remaining fibres")
   end subroutine test_fibre_first

   !> Work on the shear that stays up to the strength, on the exponential curve
   pure real(wp) function plastic_work(ply)
      type(ply_constants_type), intent(in) :: ply

      associate (a => ply%curve%asymptote, g => ply%shear(1), s => ply%shear_strength)
         plastic_work = a*(-a/g*log(1.0_wp - s/a) - s/g) - s**2/(2.0_wp*g)
      end associate
   end function plastic_work

   !> Onset across broken fibres: of a ply that has lost them
   subroutine test_onset_of_the_other()
      type(point_type) :: point

      call begin("onset across broken fibres")
      point = new_point(paper_ply(), narrow)
      call point%pull(1, 0.06_wp, 0.0_wp)
      call check(point%history(fibre_damage) > 0.9_wp, "breaks the fibres")
      call check(point%history(matrix_finish), 0.0_wp, 0.0_wp, "leaves the matrix whole")
   end subroutine test_onset_of_the_other

   !> One damage per direction: compression is as soft as tension
   subroutine test_base_never_closes()
      type(point_type) :: point

      call begin("cracks that stay open")
      point = new_point(paper_ply(), narrow)
      call check(point%law%histories, histories_open, "need few histories")
      call point%pull(2, 0.01_wp, 0.0_wp)
      call point%pull(2, -0.005_wp, 0.0_wp)
      call check(point%stress(2), -0.005_wp*10.3e3_wp*(1.0_wp - point%history(matrix_damage)), &
         & 1.0e-9_wp, "leave compression as soft as tension")
      call point%pull(2, -0.02_wp, 0.0_wp)
      call check(point%history(matrix_onset), 82.0_wp/10.3e3_wp, 1.0e-9_wp, &
         & "go on from the first onset")
   end subroutine test_base_never_closes

   !> Four damages: compression has its own, tension the larger, shear the larger
   subroutine test_closing()
      type(point_type) :: point
      type(ply_constants_type) :: ply
      real(wp) :: pulled, pushed

      call begin("cracks that close")
      ply = paper_ply()
      ply%closes = .true.
      point = new_point(ply, narrow)
      call check(point%law%histories, histories_closing, "need more histories")
      call point%pull(2, 0.01_wp, 0.0_wp)
      pulled = point%history(matrix_damage)
      call check(pulled > 0.2_wp, "open in tension")
      call point%pull(2, -0.01_wp, 0.0_wp)
      call check(point%stress(2), -0.01_wp*10.3e3_wp, 1.0e-9_wp, "close with full stiffness")
      call check(point%history(matrix_damage + to_compression), 0.0_wp, 0.0_wp, &
         & "compression has no damage of that")
      call point%pull(2, -0.04_wp, 0.0_wp)
      pushed = point%history(matrix_damage + to_compression)
      call check(pushed > pulled, "compression has its own damage")
      call check(point%history(matrix_damage), pulled, 0.0_wp, "tension keeps its own")
      call check(point%stress(2), -0.04_wp*10.3e3_wp*(1.0_wp - pushed), 1.0e-9_wp, &
         & "rule the stiffness in compression")
      call point%move([0.0_wp, 0.0_wp, 0.0_wp, 0.001_wp, 0.0_wp, 0.001_wp])
      call check(point%stress([4, 6]), (1.0_wp - pushed)*[6.0_wp, 3.7_wp], 1.0e-9_wp, &
         & "shear has the larger damage")
      call point%pull(2, 0.003_wp, 0.0_wp)
      call check(point%stress(2), 0.003_wp*10.3e3_wp*(1.0_wp - pushed), 1.0e-9_wp, &
         & "tension has the larger damage")
      call check(point%dissipated(), sum(point%history([fibre_energy, matrix_energy])) &
         & + point%plastic(), 1.0e-15_wp, "what is dissipated is the sum of all")

      point = new_point(ply, narrow)
      call point%pull(1, -0.03_wp, 0.0_wp)
      call point%pull(1, 0.001_wp, 0.0_wp)
      call check(point%stress(1), 153.0_wp*(1.0_wp &
         & - point%history(fibre_damage + to_compression)), 1.0e-9_wp, "the same along the fibres")
   end subroutine test_closing

   !> Shear alone cracks the matrix as tension does, whatever sign round-off gives the stress across
   subroutine test_closing_in_shear()
      integer, parameter :: steps = 100
      real(wp), parameter :: round_off = 1.0e-15_wp
      type(point_type) :: point
      type(ply_constants_type) :: ply
      real(wp) :: damage, finish_strain, onset
      integer :: i

      call begin("shear of cracks that close")
      ply = paper_ply()
      ply%closes = .true.
      point = new_point(ply, narrow)
      associate (g => ply%shear(1), s => ply%shear_strength)
         onset = s/g
         finish_strain = 2.0_wp*ply%matrix_toughness(1)/(narrow(2)*s)
      end associate
      do i = 1, steps
         call point%move([0.0_wp, round_off*real((-1)**i, wp), 0.0_wp, &
            & 2.0_wp*onset*real(i, wp)/real(steps, wp), 0.0_wp, 0.0_wp])
      end do
      damage = 0.5_wp*finish_strain/(finish_strain - onset)
      call check(point%history(matrix_damage), damage, 1.0e-12_wp, "is that of tension")
      call check(point%history(matrix_damage + to_compression), 0.0_wp, 0.0_wp, &
         & "leaves none to compression")
      call point%pull(2, -0.01_wp, 0.0_wp)
      call check(point%stress(2), -0.01_wp*ply%young(2), 1.0e-9_wp, "which is stiff")
   end subroutine test_closing_in_shear

   !> Shear under compression has the toughness of compression; where compression ends, it has that
   !> of tension, and may be far beyond its onset: what is stored falls, and is dissipated
   subroutine test_end_of_compression()
      integer, parameter :: steps = 2000
      !> A band in which shear snaps back with the toughness of tension, and not of compression
      real(wp), parameter :: wide(2) = [1.0_wp, 0.7_wp], most = 0.0149_wp
      type(point_type) :: point
      type(ply_constants_type) :: ply
      real(wp) :: compression
      integer :: i

      call begin("end of compression")
      ply = paper_ply()
      point = new_point(ply, wide)
      do i = 1, 2*steps
         compression = 1.0e-3_wp*real(min(i, 2*steps - i), wp)/real(steps, wp)
         call point%pull(2, -compression, most*min(real(i, wp)/real(steps, wp), 1.0_wp))
      end do
      call check(point%history(matrix_damage), 1.0_wp, 1.0e-12_wp, "nothing is left")
      call check(point%dissipated(), 0.5_wp*ply%shear(1)*most**2, 2.0e-3_wp*point%work, &
         & "what was stored in shear is dissipated")
      call check(point%work, point%dissipated(), 2.0e-3_wp*point%work, "and is the work")
   end subroutine test_end_of_compression

   !> A ply turned with its strain has its stress turned
   subroutine test_turned()
      real(wp), parameter :: angle = 30.0_wp, turn = 47.0_wp
      type(point_type) :: here, there
      real(wp) :: strain(6), stress(2, 6)
      integer :: i

      call begin("a turned ply")
      here = new_point(paper_ply(curved=.true.), narrow)
      there = new_point(paper_ply(curved=.true.), narrow)
      do i = 1, 50
         strain(:) = 1.0e-4_wp*real(i, wp)*[3.0_wp, 4.0_wp, -1.0_wp, 8.0_wp, 1.0_wp, -2.0_wp]
         call here%move(matmul(strain_rotation(angle), strain))
         strain(:) = matmul(strain_rotation(-turn), strain)
         call there%move(matmul(strain_rotation(angle + turn), strain))
      end do
      call check(here%history(matrix_damage) > 0.5_wp, "is damaged")
      ! back to the axes of the plate, and the first turned with its plate
      stress(1, :) = matmul(transpose(strain_rotation(angle)), here%stress)
      stress(1, :) = matmul(transpose(strain_rotation(turn)), stress(1, :))
      stress(2, :) = matmul(transpose(strain_rotation(angle + turn)), there%stress)
      call check(stress(1, :), stress(2, :), 1.0e-9_wp*maxval(abs(stress)), "has its stress turned")
      call check(here%history, there%history, 1.0e-9_wp, "has the same history")
   end subroutine test_turned

   !> Random smooth paths: damage and energies only grow, work is what is stored and dissipated
   subroutine test_energy(closes)
      !> Tension and compression have damage of their own
      logical, intent(in) :: closes

      integer, parameter :: paths = 12, steps = 20000
      !> What only grows in size
      integer, parameter :: monotone(5) = [fibre_damage, matrix_damage, shear_peak, fibre_energy, &
         & matrix_energy]
      type(point_type) :: point
      type(ply_constants_type) :: ply
      real(wp) :: amplitude(6, waves), before(histories_closing), gap, least, spent, worst, wrong
      integer :: i, path
      logical :: grows

      call begin(merge("random paths, closing", "random paths, open   ", closes))
      ply = paper_ply(curved=.true.)
      ply%closes = closes
      ply%plateau = 0.1_wp
      grows = .true.
      least = huge(least)
      worst = 0.0_wp
      wrong = 0.0_wp
      do path = 1, paths
         ply%onset = merge(onset_hashin, ply%onset, path > paths/2)
         point = new_point(ply, narrow)
         call draw(path, amplitude)
         do i = 1, steps
            before(:) = point%history(:histories_closing)
            spent = point%plastic()
            call point%move(strain_at(amplitude, real(i, wp)/real(steps, wp)))
            associate (now => point%history)
               grows = grows .and. all(abs(now(monotone)) >= abs(before(monotone)))
               ! a difference: to round-off
               grows = grows .and. point%plastic() >= spent*(1.0_wp - 100.0_wp*epsilon(1.0_wp))
            end associate
            least = min(least, point%stored())
         end do
         gap = abs(point%work - point%stored() - point%dissipated())
         worst = max(worst, gap/point%dissipated())
         wrong = max(wrong, abs(point%stored_by_law() - point%stored())/point%dissipated())
      end do
      call check(grows, "damage, energies and the shear that stays never go back")
      call check(least >= 0.0_wp, "the energy stored is never negative")
      ! of second order in the step, a 20000th of five waves; of first order where cracks close
      call check(worst <= merge(2.0e-3_wp, 2.0e-4_wp, closes), &
         & "work is what is stored and what is dissipated")
      call check(wrong, 0.0_wp, 1.0e-12_wp, "the law knows what is stored")
   end subroutine test_energy

   !> Amplitudes of a path: large enough to break the ply in every way
   subroutine draw(path, amplitude)
      !> Number of the path: the same ones in every run
      integer, intent(in) :: path
      !> Of each strain and wave
      real(wp), intent(out) :: amplitude(6, waves)

      real(wp), parameter :: size(6) = [0.02_wp, 0.01_wp, 0.01_wp, 0.03_wp, 0.02_wp, 0.02_wp]
      integer, allocatable :: seed(:)
      integer :: n

      call random_seed(size=n)
      allocate (seed(n), source=1234 + path)
      call random_seed(put=seed)
      call random_number(amplitude)
      amplitude(:, :) = spread(size, 2, waves)*(2.0_wp*amplitude - 1.0_wp)
   end subroutine draw

   !> Strain of a path at a share of it
   pure function strain_at(amplitude, share) result(strain)
      !> Of each strain and wave
      real(wp), intent(in) :: amplitude(6, waves)
      !> From 0 to 1
      real(wp), intent(in) :: share
      real(wp) :: strain(6)

      real(wp), parameter :: pi = acos(-1.0_wp)
      integer :: k

      strain(:) = 0.0_wp
      do k = 1, waves
         strain(:) = strain + amplitude(:, k)*sin(real(k, wp)*pi*share)
      end do
   end function strain_at

   !> Lanes of different plies do not feel each other, and other lanes are left alone
   subroutine test_batch()
      type(ply_constants_type) :: plies(4)
      type(point_type) :: alone
      type(ply_damage_type) :: law
      real(wp) :: amplitude(6, waves), history(lanes, histories_closing), length(lanes, 2)
      real(wp) :: plastic(lanes), stiffness(6, 6), strain(6), stress(lanes, 6)
      integer :: i, p

      call begin("lanes of a batch")
      plies(1) = paper_ply(curved=.true.)
      plies(2) = paper_ply()
      plies(2)%young(2) = 8.0e3_wp
      plies(2)%closes = .true.
      plies(3) = paper_ply()
      plies(3)%curve = new_power_curve(4.06e-9_wp, 5.4_wp)
      plies(4) = paper_ply()
      plies(4)%curve = new_table_curve([0.0_wp, 0.01_wp, 0.05_wp], [0.0_wp, 60.0_wp, 95.0_wp])
      history(:, :) = 7.0_wp
      history(1:lanes:2, :) = 0.0_wp
      stress(:, :) = 5.0_wp
      do p = 1, 4
         call law%set_lane(2*p - 1, plies(p))
      end do
      length(:, :) = spread(narrow, 1, lanes)
      call law%start_history(length, maxval(length, 2), history)
      call draw(3, amplitude)
      do i = 1, 400
         strain(:) = strain_at(amplitude, real(i, wp)/400.0_wp)
         call law%update(0.0_wp, spread(strain, 1, lanes), history, stress)
      end do
      call check(all(abs(history(2:lanes:2, :) - 7.0_wp) <= 0.0_wp) &
         & .and. all(abs(stress(2:lanes:2, :) - 5.0_wp) <= 0.0_wp), "others are left alone")
      do p = 1, 4
         alone = new_point(plies(p), narrow)
         do i = 1, 400
            call alone%move(strain_at(amplitude, real(i, wp)/400.0_wp))
         end do
         call check(alone%stress, stress(2*p - 1, :), 1.0e-12_wp*maxval(abs(alone%stress)), &
            & "are what they would be alone")
         plastic(:) = law%dissipated_energy(by_ply_plasticity, history)
         call check([alone%history([fibre_energy, matrix_energy]), alone%plastic()], &
            & [history(2*p - 1, [fibre_energy, matrix_energy]), plastic(2*p - 1)], &
            & 1.0e-12_wp*alone%dissipated(), "and dissipate the same")
      end do

      stiffness(:, :) = ply_stiffness(plies(2)%young, plies(2)%poisson, plies(2)%shear)
      history(1:lanes:2, :) = 0.0_wp
      call law%start_history(length, maxval(length, 2), history)
      strain(:) = [1.0e-3_wp, -2.0e-3_wp, 3.0e-3_wp, 1.0e-3_wp, 2.0e-3_wp, -1.0e-3_wp]
      call law%update(0.0_wp, spread(strain, 1, lanes), history, stress)
      call check(stress(3, :), matmul(stiffness, strain), 1.0e-9_wp, "start elastic")
   end subroutine test_batch

end program test_law_ply_damage_paths
