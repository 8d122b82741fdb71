!> Each mode of a ply alone: onset at its strength, a straight way down, its toughness dissipated.
!> All expectations follow from the constants of the paper's Table 5.
program test_law_ply_damage
   use plydyn_base_precision, only : wp
   use plydyn_law_ply_constants, only : ply_constants_type
   use plydyn_law_ply_crack_band, only : mode_names
   use plydyn_law_ply_history, only : fibre_damage, fibre_energy, fibre_finish, fibre_onset, &
      & matrix_damage, matrix_energy, matrix_finish, matrix_onset
   use plydyn_law_ply_shear_curve, only : shape_exponential
   use ply_point, only : new_point, paper_ply, point_type
   use testing, only : begin, check, finish
   implicit none

   !> Crack bands narrow enough for every mode
   real(wp), parameter :: narrow(2) = [1.0_wp, 0.25_wp]
   !> Steps of a fine path to the end of softening
   integer, parameter :: steps = 4000

   call test_normal_modes()
   call test_shear()
   call test_curved_shear()
   call finish()

contains

   !> Modulus, strength, toughness, crack band and sign of one of the four modes in normal stress
   subroutine describe(ply, mode, direction, stiff, strength, toughness, length, sense)
      type(ply_constants_type), intent(in) :: ply
      integer, intent(in) :: mode
      integer, intent(out) :: direction
      real(wp), intent(out) :: stiff, strength, toughness, length, sense

      integer :: side

      direction = (mode + 1)/2
      side = mode - 2*(direction - 1)
      stiff = ply%young(direction)
      strength = merge(ply%fibre_strength(side), ply%matrix_strength(side), direction == 1)
      toughness = merge(ply%fibre_toughness(side), ply%matrix_toughness(side), direction == 1)
      length = narrow(direction)
      sense = merge(1.0_wp, -1.0_wp, side == 1)
   end subroutine describe

   !> Onset, softening and energy of fibres and matrix in tension and compression
   subroutine test_normal_modes()
      type(point_type) :: point
      type(ply_constants_type) :: ply
      real(wp) :: stiff, strength, toughness, length, sense, onset, finish, strain
      integer :: direction, i, mode

      ply = paper_ply()
      ply%residual = 1.0e-9_wp
      do mode = 1, 4
         call begin(trim(mode_names(mode)))
         call describe(ply, mode, direction, stiff, strength, toughness, length, sense)
         onset = strength/stiff
         finish = 2.0_wp*toughness/(length*strength)

         point = new_point(ply, narrow)
         call point%pull(direction, sense*onset*(1.0_wp - 1.0e-9_wp), 0.0_wp)
         call check(point%stress(direction), sense*strength, 1.0e-8_wp*strength, &
            & "reaches the strength")
         call check(damage(point), 0.0_wp, 0.0_wp, "without damage")
         call point%pull(direction, sense*onset*(1.0_wp + 1.0e-9_wp), 0.0_wp)
         call check(damage(point) > 0.0_wp, "and is damaged beyond it")
         call check(begins(point, direction), [sense*onset, finish], 1.0e-8_wp*finish, &
            & "keeps the strains between which damage grows")

         do i = 1, 3
            strain = onset + 0.25_wp*real(i, wp)*(finish - onset)
            call point%pull(direction, sense*strain, 0.0_wp)
            call check(point%stress(direction), &
               & sense*strength*(finish - strain)/(finish - onset), 1.0e-7_wp*strength, &
               & "falls along a straight line")
         end do
         call point%pull(direction, sense*0.5_wp*strain, 0.0_wp)
         call check(point%stress(direction), 0.125_wp*sense*strength, 1.0e-7_wp*strength, &
            & "unloads to the origin")
         call check(point%dissipated(), point%work - point%stored(), 2.0e-2_wp*point%work, &
            & "loses what unloading does not give back, roughly in such steps")
         call check_energy(ply, mode)
      end do
   end subroutine test_normal_modes

   !> Fine steps to the end and back: the toughness over the crack band, by the history and by work
   subroutine check_energy(ply, mode)
      type(ply_constants_type), intent(in) :: ply
      integer, intent(in) :: mode

      type(point_type) :: point
      real(wp) :: stiff, strength, toughness, length, sense, finish
      integer :: direction, i

      call describe(ply, mode, direction, stiff, strength, toughness, length, sense)
      finish = 2.0_wp*toughness/(length*strength)
      point = new_point(ply, narrow)
      do i = 1, steps
         call point%pull(direction, sense*1.02_wp*finish*real(i, wp)/real(steps, wp), 0.0_wp)
      end do
      call check(damage(point), 1.0_wp, 0.0_wp, "ends broken")
      call check(point%dissipated()*length/toughness, 1.0_wp, 1.0e-6_wp, &
         & "dissipates its toughness over the crack band")
      call check(point%history(merge(fibre_energy, matrix_energy, direction == 1)), &
         & point%dissipated(), 0.0_wp, "and none in other modes")
      call point%pull(direction, 0.0_wp, 0.0_wp)
      call check(point%work*length/toughness, 1.0_wp, 1.0e-6_wp, "which is the work done on it")
   end subroutine check_energy

   !> Shear on a line: as the normal modes
   subroutine test_shear()
      type(point_type) :: point
      type(ply_constants_type) :: ply
      real(wp) :: finish, gamma, onset
      integer :: i

      call begin("shear on a line")
      ply = paper_ply()
      ply%residual = 1.0e-9_wp
      onset = ply%shear_strength/ply%shear(1)
      finish = 2.0_wp*ply%matrix_toughness(1)/(narrow(2)*ply%shear_strength)
      point = new_point(ply, narrow)
      do i = 1, steps
         gamma = 1.02_wp*finish*real(i, wp)/real(steps, wp)
         call point%pull(2, 0.0_wp, -gamma)
         if (gamma <= onset .or. gamma >= finish) cycle
         if (mod(i, steps/10) /= 0) cycle
         call check(point%stress(4), -ply%shear_strength*(finish - gamma)/(finish - onset), &
            & 1.0e-5_wp*ply%shear_strength, "falls along a straight line, to either side")
      end do
      call check(point%dissipated()*narrow(2)/ply%matrix_toughness(1), 1.0_wp, 1.0e-6_wp, &
         & "dissipates the toughness of matrix in tension")
   end subroutine test_shear

   !> Shear on an exponential curve
   subroutine test_curved_shear()
      real(wp), parameter :: asymptote = 93.6_wp
      type(point_type) :: point
      type(ply_constants_type) :: ply
      real(wp) :: before, gamma, jump, plastic, stays, turn
      integer :: i

      call begin("shear on a curve")
      ply = paper_ply()
      ply%residual = 1.0e-9_wp
      ply%curve%shape = shape_exponential
      ply%curve%asymptote = asymptote
      associate (g => ply%shear(1), s => ply%shear_strength)
         ! strain at which the curve reaches the strength, what stays of it, and its plastic work
         turn = -asymptote/g*log(1.0_wp - s/asymptote)
         stays = turn - s/g
         plastic = asymptote*(turn - s/g) - s**2/(2.0_wp*g)
         point = new_point(ply, narrow)
         jump = 0.0_wp
         do i = 1, 20*steps
            before = point%stress(4)
            gamma = 0.08_wp*real(i, wp)/real(20*steps, wp)
            call point%pull(2, 0.0_wp, gamma)
            if (gamma > 0.04_wp) jump = max(jump, abs(point%stress(4) - before))
         end do
         call check(point%history(matrix_onset), s/g, 1.0e-6_wp, "starts with the elastic strain")
         call check(point%stays(), stays, 1.0e-6_wp, "keeps the strain that stays")
         call check(jump <= 1.001_wp*0.08_wp/real(20*steps, wp)*s &
            & /(point%history(matrix_finish) - s/g), "goes over to damage without a jump")
         call check(point%history(matrix_energy)*narrow(2), ply%matrix_toughness(1), 1.0e-6_wp, &
            & "dissipates the toughness by damage")
         call check(point%plastic()*narrow(2), plastic*narrow(2), 2.0e-5_wp, &
            & "and the area of the curve by what stays")
         call check([point%plastic(), point%dissipated()]*narrow(2), &
            & [0.6697_wp, 0.8897_wp], 2.0e-4_wp, "as an independent program has it")
         call check(point%work, point%dissipated(), 1.0e-5_wp*point%work, "all of the work")

         ! unloading from the middle of softening
         point = new_point(ply, narrow)
         call point%pull(2, 0.0_wp, turn)
         gamma = stays + 1.5_wp*s/g
         call point%pull(2, 0.0_wp, gamma)
         before = point%stress(4)
         call point%pull(2, 0.0_wp, stays + 0.75_wp*s/g)
         call check(point%stress(4), 0.5_wp*before, 1.0e-10_wp*before, &
            & "unloads to the strain that stays")
         call point%pull(2, 0.0_wp, stays)
         call check(point%stress(4), 0.0_wp, 1.0e-10_wp, "has no stress there")
         call point%pull(2, 0.0_wp, -stays)
         call check(point%stress(4), 0.0_wp, 1.0e-10_wp, "nor at its mirror image")
         call point%pull(2, 0.0_wp, -gamma)
         call check(point%stress(4), -before, 1.0e-10_wp*before, "and loads again there")
      end associate
   end subroutine test_curved_shear

   !> The larger of the two damages of a point
   pure real(wp) function damage(point)
      type(point_type), intent(in) :: point

      damage = max(point%history(fibre_damage), point%history(matrix_damage))
   end function damage

   !> Strains between which the damage of a direction grows
   pure function begins(point, direction) result(strains)
      type(point_type), intent(in) :: point
      integer, intent(in) :: direction
      real(wp) :: strains(2)

      if (direction == 1) then
         strains(:) = point%history([fibre_onset, fibre_finish])
      else
         strains(:) = point%history([matrix_onset, matrix_finish])
      end if
   end function begins

end program test_law_ply_damage
