!> The whole ply with planes of fracture: work is stored or dissipated on random paths, fibres,
!> lanes of other laws, points far from onset.
program test_law_ply_fracture_fracture
   use fracture_point, only : fracture_ply, fracture_point_type, new_fracture_point
   use plydyn_base_precision, only : lanes, wp
   use plydyn_law_law, only : by_fibre_damage, by_friction, by_matrix_damage, by_ply_plasticity, &
      & scalars, shows_dissipated, shows_fibre_damage, shows_matrix_damage
   use plydyn_law_ply_elastic, only : ply_stiffness
   use plydyn_law_ply_fracture_constants, only : fracture_constants_type
   use plydyn_law_ply_fracture_fracture, only : ply_fracture_type
   use plydyn_law_ply_fracture_history, only : fibre_damage, histories, matrix_damage, state, &
      & to_compression
   use plydyn_law_ply_shear_curve, only : new_power_curve, new_table_curve
   use testing, only : begin, check, finish
   implicit none

   call test_elastic()
   call test_identity()
   call test_jump()
   call test_fibres()
   call test_two_lines()
   call test_broken_and_pressed()
   call test_plateau()
   call test_owned_lanes()
   call finish()

contains

   !> Far from onset the stress is that of the stiffness, and nothing is kept
   subroutine test_elastic()
      type(fracture_constants_type) :: ply
      type(fracture_point_type) :: point
      real(wp), parameter :: strain(6) = [1.0e-3_wp, -2.0e-3_wp, 1.0e-3_wp, 2.0e-3_wp, &
         & -1.0e-3_wp, 3.0e-3_wp]
      real(wp) :: c(6, 6)

      ply = fracture_ply()
      c(:, :) = ply_stiffness(ply%young, ply%poisson, ply%shear)
      call begin("far from onset")
      point = new_fracture_point(ply, [1.0_wp, 0.1_wp])
      call point%move(strain)
      call check(maxval(abs(point%stress - matmul(c, strain))), 0.0_wp, 1.0e-11_wp, "elastic")
      call check(point%history(state), 0.0_wp, 0.0_wp, "nothing is kept")
   end subroutine test_elastic

   !> Random paths there and back through all mechanisms: in every step the work is stored or
   !> dissipated to round-off, and each mechanism dissipates but for what a step that closes a
   !> crack shifts
   subroutine test_identity()
      integer, parameter :: paths = 40, knots = 8, steps = 150
      real(wp), parameter :: sizes(6) = [0.02_wp, 0.02_wp, 0.02_wp, 0.04_wp, 0.04_wp, 0.04_wp]
      type(fracture_point_type) :: point
      real(wp) :: error, least, knot(6), largest(4), random(6), wrong
      integer :: i, k, n

      call begin("random paths")
      call random_seed(size=n)
      call random_seed(put=[(7*i, i=1, n)])
      error = 0.0_wp
      wrong = 0.0_wp
      least = 0.0_wp
      largest(:) = 0.0_wp
      do i = 1, paths
         point = new_fracture_point(varied_ply(i), [1.0_wp, 0.05_wp])
         do k = 1, knots
            call random_number(random)
            knot(:) = sizes*(2.0_wp*random - 1.0_wp)
            call random_number(random)
            where (random > 0.6_wp) knot = 0.0_wp
            call follow(point, knot, steps, error, wrong, least)
         end do
         largest(:) = max(largest, [point%energy_of(by_fibre_damage), &
            & point%energy_of(by_matrix_damage), point%energy_of(by_ply_plasticity), &
            & point%energy_of(by_friction)])
      end do
      call check(error, 0.0_wp, 1.0e-12_wp, "work is stored or dissipated")
      call check(wrong, 0.0_wp, 1.0e-12_wp, "the law knows what is stored")
      call check(all(largest > 1.0_wp), "all mechanisms take part")
      call check(least, 0.0_wp, 1.0e-2_wp, "no mechanism gives energy")
   end subroutine test_identity

   !> Plies of different kinds, one of them not alike in all directions across its fibres
   pure function varied_ply(i) result(ply)
      integer, intent(in) :: i
      type(fracture_constants_type) :: ply

      ply = fracture_ply()
      if (modulo(i, 2) == 0) then
         ply%debris_share = 0.3_wp
         ply%debris_limit = 0.02_wp
         ply%crush_stress = 250.0_wp
         ply%plateau = 0.2_wp
      end if
      if (modulo(i, 3) == 1) then
         ply%line_strength(1) = 0.75_wp
         ply%line_toughness(1) = 0.375_wp
      end if
      if (modulo(i, 3) == 0) then
         ply%young(:) = [130.0e3_wp, 7.7e3_wp, 7.0e3_wp]
         ply%poisson(:) = [0.3_wp, 0.28_wp, 0.35_wp]
         ply%shear(:) = [4.8e3_wp, 4.5e3_wp, 3.8e3_wp]
      end if
      if (modulo(i, 5) == 0) then
         ply%curve = new_power_curve(ply%shear(1)*4.06e-9_wp/5290.0_wp, 5.4_wp)
      end if
      if (modulo(i, 4) == 1) then
         ply%curve = new_table_curve([0.0_wp, 0.01_wp, 0.02_wp, 0.05_wp, 0.1_wp], [0.0_wp, &
            & 21.73_wp, 40.38_wp, 80.16_wp, 106.14_wp])
      end if
   end function varied_ply

   !> Yield from zero stress: the first step from rest goes far beyond it, and its work is kept, too
   subroutine test_jump()
      type(fracture_point_type) :: point
      real(wp), parameter :: strain(6) = [1.0e-3_wp, -1.0e-3_wp, 0.0_wp, 0.005_wp, -0.004_wp, &
         & 0.003_wp]

      call begin("a step from rest beyond yield from zero stress")
      point = new_fracture_point(varied_ply(1), [1.0_wp, 0.05_wp])
      call point%move(0.0_wp*strain)
      call check(point%history(state), 0.0_wp, 0.0_wp, "nothing is kept at rest")
      call point%move(strain)
      call check(point%energy_of(by_ply_plasticity) > 0.01_wp, "yields")
      call check(point%work, point%stored() + point%dissipated(), 1.0e-13_wp, "work is balanced")
      call check(point%history(matrix_damage), 0.0_wp, 0.0_wp, "before it cracks")
   end subroutine test_jump

   !> Follow a path to a knot: largest errors of the balance and of the stored energy, least growth
   !> of any energy over all that has been dissipated
   subroutine follow(point, knot, steps, error, wrong, least)
      type(fracture_point_type), intent(inout) :: point
      real(wp), intent(in) :: knot(6)
      integer, intent(in) :: steps
      real(wp), intent(inout) :: error, wrong, least

      real(wp) :: before(4), from(6), moved
      integer :: i, k

      from(:) = point%strain
      moved = 0.0_wp
      do i = 1, steps
         do k = 1, 4
            before(k) = point%energy_of(mechanism(k))
         end do
         call point%move(from + (knot - from)*real(i, wp)/real(steps, wp))
         ! round-off is that of all work that went there and back
         moved = max(moved, abs(point%work), point%stored(), point%dissipated(), 1.0e-3_wp)
         error = max(error, abs(point%work - point%stored() - point%dissipated())/moved)
         wrong = max(wrong, abs(point%stored_by_law() - point%stored())/moved)
         do k = 1, 4
            least = min(least, (point%energy_of(mechanism(k)) - before(k))/moved)
         end do
      end do
   end subroutine follow

   !> Mechanism of a column of this test
   pure integer function mechanism(k)
      integer, intent(in) :: k

      integer, parameter :: all_of_them(4) = [by_fibre_damage, by_matrix_damage, &
         & by_ply_plasticity, by_friction]

      mechanism = all_of_them(k)
   end function mechanism

   !> Fibres in tension and compression: strength, and the toughness over the width
   subroutine test_fibres()
      type(fracture_constants_type) :: ply
      type(fracture_point_type) :: point
      real(wp) :: expected, last, strength
      integer :: sense, steps

      ply = fracture_ply()
      ply%residual = 1.0e-6_wp
      steps = 3000
      call begin("broken fibres")
      do sense = 1, 2
         strength = ply%fibre_strength(sense)
         expected = ply%fibre_toughness(sense)/0.5_wp
         last = sign(1.02_wp*2.0_wp*expected/strength, 1.5_wp - sense)
         point = new_fracture_point(ply, [0.5_wp, 0.1_wp])
         call point%pull(1, sign(0.99_wp*strength/ply%young(1), last), 1)
         call check(abs(point%stress(1)), 0.99_wp*strength, 1.0e-3_wp*strength, "elastic before")
         call point%pull(1, last, steps)
         call check(point%energy_of(by_fibre_damage), expected, 4.0_wp/steps*expected, &
            & "the toughness over the width")
         call check(point%history(matrix_damage), 0.0_wp, 0.0_wp, "leave the matrix whole")
      end do
   end subroutine test_fibres

   !> Fibres on two lines, in tension and in compression: the sum of two laws, and all of the energy
   subroutine test_two_lines()
      real(wp), parameter :: strength_share = 0.75_wp, energy_share = 0.375_wp, width = 0.5_wp
      type(fracture_constants_type) :: ply
      type(fracture_point_type) :: point
      real(wp) :: expected, last(2), onset, strain, strength
      integer :: sense, steps

      ply = fracture_ply()
      ply%residual = 1.0e-9_wp
      ply%line_strength(:) = strength_share
      ply%line_toughness(:) = energy_share
      steps = 3000
      call begin("fibres on two lines")
      do sense = 1, 2
         strength = ply%fibre_strength(sense)
         expected = ply%fibre_toughness(sense)/width
         onset = strength/ply%young(1)
         last(:) = 2.0_wp*expected/strength*[energy_share/strength_share, &
            & (1.0_wp - energy_share)/(1.0_wp - strength_share)]
         point = new_fracture_point(ply, [width, 0.1_wp])
         strain = 0.5_wp*sum(last)
         call point%pull(1, sign(onset*0.999_wp, 1.5_wp - sense), 1)
         call point%pull(1, sign(onset*1.001_wp, 1.5_wp - sense), 10)
         call point%pull(1, sign(last(1), 1.5_wp - sense), steps)
         ! onset is within a step beyond the strength
         call check(abs(point%stress(1)), strength*(1.0_wp - strength_share)*(last(2) - last(1)) &
            & /(last(2) - onset), 1.0e-3_wp*strength, "kink where the first law ends")
         call point%pull(1, sign(strain, 1.5_wp - sense), steps)
         call check(abs(point%stress(1)), strength*(1.0_wp - strength_share)*(last(2) - strain) &
            & /(last(2) - onset), 1.0e-3_wp*strength, "the second line")
         call point%pull(1, sign(1.01_wp*last(2), 1.5_wp - sense), steps)
         call check(point%energy_of(by_fibre_damage), expected, 1.0e-3_wp*expected, &
            & "the toughness over the width")
      end do
   end subroutine test_two_lines

   !> Fibres that have broken in tension carry pressure, up to the strength of compression
   subroutine test_broken_and_pressed()
      type(fracture_constants_type) :: ply
      type(fracture_point_type) :: point
      real(wp) :: broken

      ply = fracture_ply()
      ply%residual = 1.0e-6_wp
      call begin("fibres that are broken and pressed")
      point = new_fracture_point(ply, [0.5_wp, 0.1_wp])
      call point%pull(1, 1.05_wp*4.0_wp*ply%fibre_toughness(1)/ply%fibre_strength(1), 500)
      broken = point%energy_of(by_fibre_damage)
      call check(point%stress(1), 0.0_wp, 1.0_wp, "carry nothing when they are open")
      call point%pull(1, 0.0_wp, 100)
      call point%pull(1, -0.005_wp, 100)
      call check(point%stress(1), -0.005_wp*ply%young(1), 1.0e-2_wp*0.005_wp*ply%young(1), &
         & "carry pressure")
      call check(point%energy_of(by_fibre_damage), broken, 1.0e-4_wp*broken, "without damage")
      call point%pull(1, -1.05_wp*4.0_wp*ply%fibre_toughness(2)/ply%fibre_strength(2), 3000)
      call check(point%energy_of(by_fibre_damage) - broken, ply%fibre_toughness(2)/0.5_wp, &
         & 4.0e-3_wp*ply%fibre_toughness(2)/0.5_wp, "until they are crushed")
   end subroutine test_broken_and_pressed

   !> Crushed fibres keep their plateau
   subroutine test_plateau()
      type(fracture_constants_type) :: ply
      type(fracture_point_type) :: point
      real(wp) :: values(scalars)

      ply = fracture_ply()
      ply%plateau = 0.2_wp
      call begin("crushed fibres")
      point = new_fracture_point(ply, [0.5_wp, 0.1_wp])
      call point%pull(1, -0.99_wp*1200.1_wp/ply%young(1), 1)
      call point%pull(1, -0.4_wp, 400)
      ! onset is within a step of 1e-3 beyond the strength: its strain is on the plateau
      call check(point%stress(1), -0.2_wp*1200.1_wp, 0.2_wp*1.0e-3_wp*ply%young(1), "plateau")
      values(:) = point%law%output_variables(1, spread(point%history, 1, lanes))
      call check(values(shows_fibre_damage), point%history(fibre_damage + to_compression), 0.0_wp, &
         & "damage shown")
      call check(values(shows_matrix_damage), 0.0_wp, 0.0_wp, "of fibres alone")
      call check(values(shows_dissipated), point%dissipated(), 1.0e-12_wp, "energy shown")
   end subroutine test_plateau

   !> A lane of another law keeps its stress and its history
   subroutine test_owned_lanes()
      type(ply_fracture_type) :: law
      real(wp) :: history(lanes, histories), strain(lanes, 6), stress(lanes, 6)
      integer :: i, l

      call begin("lanes of other laws")
      do l = 2, lanes
         call law%set_lane(l, fracture_ply())
      end do
      history(:, :) = 7.0_wp
      history(2:, :) = 0.0_wp
      call law%start_history(spread([0.5_wp, 0.1_wp], 1, lanes), spread(0.5_wp, 1, lanes), history)
      stress(:, :) = -3.0_wp
      do i = 1, 20
         strain(:, :) = spread([0.002_wp, 0.001_wp, 0.0_wp, 0.002_wp, 0.001_wp, 0.0_wp], 1, lanes)*i
         call law%update(0.0_wp, strain, history, stress)
      end do
      call check(maxval(abs(history(1, :) - 7.0_wp)), 0.0_wp, 0.0_wp, "keep their history")
      call check(maxval(abs(stress(1, :) + 3.0_wp)), 0.0_wp, 0.0_wp, "and their stress")
      call check(minval(history(2:, matrix_damage)) > 0.0_wp, "beside those of the law")
      call check(maxval(abs(stress(3:, 2) - stress(2, 2))), 0.0_wp, 0.0_wp, "which are alike")
   end subroutine test_owned_lanes

end program test_law_ply_fracture_fracture
