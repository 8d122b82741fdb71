!> Damage of plies that is driven by averages: the strain of the point says the stress, that of the
!> average the damage. Both laws of plies.
program test_law_ply_average
   use plydyn_base_precision, only : lanes, wp
   use plydyn_law_law, only : law_type
   use plydyn_law_ply_constants, only : ply_constants_type
   use plydyn_law_ply_damage, only : ply_damage_type
   use plydyn_law_ply_history, only : driving_strains, fibre_damage, histories_most, &
      & matrix_damage, matrix_energy, matrix_onset
   use plydyn_law_ply_strain_damage, only : across_energy, by_matrix, strain_constants_type, &
      & strain_damage_type
   use ply_point, only : paper_ply
   use testing, only : begin, check, finish
   implicit none

   !> A lane that another law owns
   integer, parameter :: foreign = 3
   !> Widths of the crack band, narrow enough for every mode
   real(wp), parameter :: band(2) = [1.0_wp, 0.25_wp]
   real(wp) :: history(lanes, histories_most), stress(lanes, 6)

   call test_same_strain()
   call test_average_drives()
   call test_point_is_kept()
   call test_energy()
   call test_shear()
   call test_given_strains()
   call finish()

contains

   !> Where point and average have one strain, the law is the local one
   subroutine test_same_strain()
      type(ply_damage_type) :: averaged, local
      real(wp) :: strain(6), expected(6), damage(2), energy
      integer :: i

      call begin("same strain")
      local = damaged(.false.)
      averaged = damaged(.true.)
      do i = 1, 3
         strain(:) = [0.009_wp, 0.006_wp, -0.004_wp, 0.012_wp, 0.001_wp, 0.002_wp]*0.7_wp*i
         if (i == 1) call start(local)
         call move(local, strain)
         expected(:) = stress(1, :)
         damage(:) = history(1, [fibre_damage, matrix_damage])
         energy = history(1, matrix_energy)
      end do
      do i = 1, 3
         strain(:) = [0.009_wp, 0.006_wp, -0.004_wp, 0.012_wp, 0.001_wp, 0.002_wp]*0.7_wp*i
         if (i == 1) call start(averaged)
         call set_mean(averaged, strain(1:4))
         call move(averaged, strain)
      end do
      call check(minval(damage) > 0.1_wp, "both modes are damaged")
      call check(stress(1, :), expected, 0.0_wp, "stress")
      call check(history(1, [fibre_damage, matrix_damage]), damage, 0.0_wp, "damage")
      call check(energy > 0.0_wp .and. history(1, matrix_energy) > 0.0_wp, "energy is spent")
   end subroutine test_same_strain

   !> Strain alone does no damage, and what the average does is felt at the strain of the point
   subroutine test_average_drives()
      type(ply_damage_type) :: law
      type(ply_constants_type) :: ply
      real(wp) :: beyond, damage, finish, onset, strain(6)

      call begin("average drives")
      ply = paper_ply()
      law = damaged(.true.)
      onset = ply%matrix_strength(1)/ply%young(2)
      finish = 2.0_wp*ply%matrix_toughness(1)/(band(2)*ply%matrix_strength(1))
      call start(law)
      strain(:) = across(ply, 2.0_wp*onset)
      call move(law, strain)
      call check(history(1, matrix_damage), 0.0_wp, 0.0_wp, "none without the average")
      call check(stress(1, 2), 2.0_wp*ply%matrix_strength(1), 1.0e-9_wp*stress(1, 2), &
         & "elastic beyond the strength")

      beyond = 0.5_wp*(onset + finish)
      call set_mean(law, across(ply, onset))
      call move(law, across(ply, 0.1_wp*onset))
      call set_mean(law, across(ply, beyond))
      call move(law, across(ply, 0.1_wp*onset))
      damage = finish*(beyond - onset)/(beyond*(finish - onset))
      call check(history(1, matrix_damage), damage, 1.0e-9_wp, "grows with the average")
      ! of a stress elsewhere in the ply nothing is seen
      strain(:) = [0.0_wp, 0.1_wp*onset, 0.0_wp, 0.0_wp, 0.0_wp, 0.0_wp]
      call move(law, strain)
      call check(stress(1, 2) < 1.5_wp*(1.0_wp - damage)*ply%young(2)*strain(2), &
         & "weakens the stress of the point")
      call check(history(1, matrix_energy) < 0.5_wp*damage*ply%young(2)*(0.2_wp*onset)**2, &
         & "costs what the point had")
      call check(history(1, matrix_energy) > 0.0_wp, "and that is not nothing")
      call check(stress(foreign, :), spread(7.0_wp, 1, 6), 0.0_wp, "not in lanes of other laws")
   end subroutine test_average_drives

   !> What neighbours will average is the strain of the point, shear without what stays
   subroutine test_point_is_kept()
      type(ply_damage_type) :: law
      real(wp), parameter :: strain(6) = [1.0e-3_wp, 2.0e-3_wp, -3.0e-3_wp, -0.02_wp, 0.0_wp, &
         & 0.0_wp]

      call begin("point is kept")
      law = damaged(.true., curved=.true.)
      call start(law)
      call move(law, strain)
      associate (own => history(1, law%behind_own + 1:law%behind_own + law%driving))
         call check(own(1:3), strain(1:3), 0.0_wp, "normal strains")
         call check(own(4), stress(1, 4)/6.0e3_wp, 1.0e-12_wp, "elastic shear with its sign")
      end associate
      call check(history(foreign, law%behind_own + 1), 7.0_wp, 0.0_wp, "only in own lanes")
   end subroutine test_point_is_kept

   !> Energy is the work less what is stored, to round-off, where no stress but one acts
   subroutine test_energy()
      type(ply_damage_type) :: law
      type(ply_constants_type) :: ply
      real(wp) :: before, rise, strain(6), stored, work
      integer :: i

      call begin("energy")
      ply = paper_ply()
      law = damaged(.true.)
      call start(law)
      strain(:) = 0.0_wp
      before = 0.0_wp
      work = 0.0_wp
      do i = 1, 25
         ! the strain of the point grows, and falls when it is torn; that of neighbours grows
         rise = 1.0e-3_wp*merge(1, -2, i <= 20)
         strain(4) = strain(4) + rise
         call set_mean(law, [0.0_wp, 0.0_wp, 0.0_wp, 1.5e-3_wp*i])
         call move(law, strain)
         work = work + 0.5_wp*(before + stress(1, 4))*rise
         before = stress(1, 4)
      end do
      stored = 0.5_wp*stress(1, 4)*strain(4)
      call check(history(1, matrix_damage) > 0.5_wp, "the matrix is torn")
      call check(history(1, matrix_energy), work - stored, 1.0e-12_wp*work, "dissipated")
   end subroutine test_energy

   !> Shear of the average counts without its sign
   subroutine test_shear()
      type(ply_damage_type) :: law
      real(wp) :: onset

      call begin("shear")
      law = damaged(.true.)
      onset = 90.0_wp/6.0e3_wp
      call start(law)
      call set_mean(law, [0.0_wp, 0.0_wp, 0.0_wp, -1.001_wp*onset])
      call move(law, spread(0.0_wp, 1, 6))
      call check(history(1, matrix_onset), onset, 1.0e-9_wp, "begins at the strength")
   end subroutine test_shear

   !> The law between given strains
   subroutine test_given_strains()
      type(strain_damage_type) :: law
      type(strain_constants_type) :: ply
      real(wp), parameter :: onset = 0.008_wp, finish = 0.032_wp, mean = 0.02_wp, own = 0.004_wp
      real(wp) :: damage
      integer :: l

      call begin("given strains")
      ply%young = [130.0e3_wp, 9.0e3_wp, 9.0e3_wp]
      ply%shear = [5.0e3_wp, 5.0e3_wp, 4.5e3_wp]
      ply%onset(:, :) = onset
      ply%finish(:, :) = finish
      ply%onset(3, :) = 1.0_wp
      ply%finish(3, :) = 2.0_wp
      ply%radius = 2.0_wp
      do l = 1, lanes
         if (l == foreign) cycle
         call ply%set_lane(l, law)
      end do
      call start(law)
      call move(law, [0.0_wp, own, 0.0_wp, 0.002_wp, 0.0_wp, 0.0_wp])
      call check(history(1, law%behind_own + 1:law%behind_own + 3), [0.0_wp, own, 0.002_wp], &
         & 0.0_wp, "keeps the strains in the plane")
      call set_mean(law, [0.0_wp, mean, 0.0_wp])
      call move(law, [0.0_wp, own, 0.0_wp, 0.0_wp, 0.0_wp, 0.0_wp])
      damage = finish*(mean - onset)/(mean*(finish - onset))
      call check(history(1, by_matrix), damage, 1.0e-12_wp, "damage of the average")
      call check(stress(1, 2), (1.0_wp - damage)*9.0e3_wp*own, 1.0e-9_wp, "stress of the point")
      call check(history(1, across_energy), 0.5_wp*damage*9.0e3_wp*own**2, 1.0e-12_wp, &
         & "energy of the point")
      call check(history(foreign, by_matrix), 7.0_wp, 0.0_wp, "only in own lanes")
   end subroutine test_given_strains

   !> The law of the paper's ply in all lanes but one
   function damaged(averages, curved) result(law)
      logical, intent(in) :: averages
      logical, intent(in), optional :: curved
      type(ply_damage_type) :: law
      integer :: l

      do l = 1, lanes
         if (l == foreign) cycle
         call law%set_lane(l, paper_ply(curved))
         if (averages) call law%set_average(l, [2.0_wp, 1.0_wp], driving_strains)
      end do
   end function damaged

   !> Strain of uniaxial stress across the fibres
   pure function across(ply, strain) result(e)
      type(ply_constants_type), intent(in) :: ply
      real(wp), intent(in) :: strain
      real(wp) :: e(6)

      e(:) = 0.0_wp
      e(1:3) = strain*[-ply%poisson(1)*ply%young(2)/ply%young(1), 1.0_wp, -ply%poisson(3)]
   end function across

   !> A point at rest, in foreign lanes with sevens
   subroutine start(law)
      class(law_type), intent(in) :: law

      history(:, :) = 0.0_wp
      call law%start_history(spread(band, 1, lanes), spread(maxval(band), 1, lanes), history)
      history(foreign, :) = 7.0_wp
      stress(:, :) = 7.0_wp
   end subroutine start

   !> Averages of the step
   subroutine set_mean(law, mean)
      class(law_type), intent(in) :: law
      real(wp), intent(in) :: mean(:)
      integer :: l

      do l = 1, lanes
         if (l == foreign) cycle
         history(l, law%behind_mean + 1:law%behind_mean + law%driving) = mean(:law%driving)
      end do
   end subroutine set_mean

   !> Strain the point
   subroutine move(law, strain)
      class(law_type), intent(in) :: law
      real(wp), intent(in) :: strain(6)

      call law%update(0.0_wp, spread(strain, 1, lanes), history(:, :law%histories), stress)
   end subroutine move

end program test_law_ply_average
