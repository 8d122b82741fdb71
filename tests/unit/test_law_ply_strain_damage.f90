!> Damage between given strains: straight ways down, the energy under them, what each mechanism
!> takes and leaves. All expectations follow from the constants.
program test_law_ply_strain_damage
   use plydyn_base_precision, only : lanes, wp
   use plydyn_law_law, only : scalars, shows_dissipated, shows_fibre_damage, shows_shear_damage
   use plydyn_law_ply_strain_damage, only : along_energy, across_energy, by_fibres, by_locking, &
      & by_matrix, strain_constants_type, strain_damage_type, strain_residual
   use testing, only : begin, check, finish
   implicit none

   integer, parameter :: variables = 6
   !> Steps of a path to the end, none of which meets a strain of the law
   integer, parameter :: steps = 3571
   !> Round-off of sums over the steps that are made apart, relative
   real(wp), parameter :: rounded = real(steps, wp)*epsilon(1.0_wp)
   !> Beyond the end by this factor
   real(wp), parameter :: beyond = 1.01_wp
   !> Energy of what remains at the end, over modulus and square of the strain there
   real(wp), parameter :: lost_in_rest = 0.51_wp*strain_residual*beyond**2

   !> A point and all that has happened to it
   type :: point_type
      type(strain_damage_type) :: law
      real(wp) :: history(variables) = 0.0_wp, strain(6) = 0.0_wp, stress(6) = 0.0_wp
      !> Work done per volume
      real(wp) :: work = 0.0_wp
   end type point_type

   call test_modes()
   call test_shear()
   call test_locking()
   call test_poisson()
   call test_both_senses()
   call test_jump()
   call test_owned_lanes()
   call finish()

contains

   !> A ply without Poisson's effect, on which strain is uniaxial stress
   pure function straight_ply() result(ply)
      type(strain_constants_type) :: ply

      ply%young = [130.0e3_wp, 9.0e3_wp, 9.0e3_wp]
      ply%shear = [5.0e3_wp, 5.0e3_wp, 4.5e3_wp]
      ply%onset(by_fibres, :) = [0.015_wp, 0.011_wp]
      ply%finish(by_fibres, :) = [0.06_wp, 0.09_wp]
      ply%onset(by_matrix, :) = [0.007_wp, 0.02_wp]
      ply%finish(by_matrix, :) = [0.03_wp, 0.07_wp]
      ply%onset(by_locking, :) = [0.3_wp, 0.35_wp]
      ply%finish(by_locking, :) = [0.5_wp, 0.6_wp]
   end function straight_ply

   !> A point at rest
   pure function new_point(ply) result(point)
      type(strain_constants_type), intent(in) :: ply
      type(point_type) :: point
      integer :: l

      do l = 1, lanes
         call ply%set_lane(l, point%law)
      end do
   end function new_point

   !> Strain a point
   subroutine move(point, strain)
      type(point_type), intent(inout) :: point
      real(wp), intent(in) :: strain(6)

      real(wp) :: history(lanes, variables), stress(lanes, 6)

      history(:, :) = spread(point%history, 1, lanes)
      stress(:, :) = 0.0_wp
      call point%law%update(0.0_wp, spread(strain, 1, lanes), history, stress)
      point%work = point%work + 0.5_wp*dot_product(point%stress + stress(1, :), &
         & strain - point%strain)
      point%history = history(1, :)
      point%stress = stress(1, :)
      point%strain = strain
   end subroutine move

   !> Strain one component alone
   subroutine pull(point, component, strain)
      type(point_type), intent(inout) :: point
      integer, intent(in) :: component
      real(wp), intent(in) :: strain

      real(wp) :: whole(6)

      whole(:) = 0.0_wp
      whole(component) = strain
      call move(point, whole)
   end subroutine pull

   !> Fibres and matrix, in tension and compression
   subroutine test_modes()
      character(*), parameter :: names(2, 2) = reshape([character(18) :: "fibre tension", &
         & "matrix tension", "fibre compression", "matrix compression"], [2, 2])
      real(wp), parameter :: sign_of(2) = [1.0_wp, -1.0_wp]
      type(strain_constants_type) :: ply
      integer :: direction, sense

      ply = straight_ply()
      do sense = 1, 2
         do direction = 1, 2
            call begin(trim(names(direction, sense)))
            call check_mode(ply, direction, ply%young(direction), sign_of(sense), &
               & [ply%onset(direction, sense), ply%finish(direction, sense)])
         end do
      end do
   end subroutine test_modes

   !> Onset, the line, unloading, energy of a mode in uniaxial stress
   subroutine check_mode(ply, component, modulus, sense, limits)
      type(strain_constants_type), intent(in) :: ply
      integer, intent(in) :: component
      real(wp), intent(in) :: modulus, sense
      !> Strains at onset and saturation
      real(wp), intent(in) :: limits(2)

      type(point_type) :: point
      real(wp) :: strain, stress
      integer :: i

      point = new_point(ply)
      call pull(point, component, sense*limits(1))
      call check(point%stress(component), sense*modulus*limits(1), 1.0e-9_wp*modulus, &
         & "is elastic up to onset")
      call check(point%history, spread(0.0_wp, 1, variables), 0.0_wp, "and without damage")
      strain = 0.5_wp*(limits(1) + limits(2))
      stress = 0.5_wp*modulus*limits(1)
      call pull(point, component, sense*strain)
      call check(point%stress(component), sense*stress, 1.0e-9_wp*modulus, &
         & "has lost half of its stress half way down")
      call pull(point, component, 0.5_wp*sense*strain)
      call check(point%stress(component), 0.5_wp*sense*stress, 1.0e-9_wp*modulus, &
         & "unloads to the origin")
      call pull(point, component, sense*strain)
      call check(point%stress(component), sense*stress, 1.0e-9_wp*modulus, "and comes back")

      point = new_point(ply)
      do i = 1, steps
         call pull(point, component, beyond*sense*limits(2)*real(i, wp)/real(steps, wp))
      end do
      call check(point%history(variables), 0.5_wp*modulus*product(limits), &
         & lost_in_rest*modulus*limits(2)**2, "dissipates the triangle")
      call check(point%history(merge(along_energy, across_energy, component == 1)), &
         & point%history(variables), rounded*point%history(variables), "and none elsewhere")
      call pull(point, component, 0.0_wp)
      call check(point%work, point%history(variables), 1.0e-4_wp*point%work, &
         & "which is the work done on it")
   end subroutine check_mode

   !> Shear counts by half, reduces with the matrix, and not with the fibres
   subroutine test_shear()
      type(point_type) :: point
      type(strain_constants_type) :: ply
      real(wp) :: strain(6)

      call begin("shear in the plane")
      ply = straight_ply()
      call check_mode(ply, 4, ply%shear(1), 1.0_wp, &
         & 2.0_wp*[ply%onset(by_matrix, 1), ply%finish(by_matrix, 1)])
      call check_mode(ply, 4, ply%shear(1), -1.0_wp, &
         & 2.0_wp*[ply%onset(by_matrix, 1), ply%finish(by_matrix, 1)])

      call begin("shear after broken fibres")
      point = new_point(ply)
      strain(:) = [ply%finish(by_fibres, 1), 0.0_wp, 0.0_wp, 0.01_wp, 0.02_wp, 0.03_wp]
      call move(point, strain)
      call check(point%stress(4:6), ply%shear*strain(4:6), 1.0e-9_wp, "is whole")

      call begin("shear with compression across")
      point = new_point(ply)
      strain(:) = [0.0_wp, -0.6_wp*0.045_wp, 0.0_wp, 2.0_wp*0.8_wp*0.045_wp, 0.0_wp, 0.0_wp]
      call move(point, strain)
      call check(point%history(by_matrix), 0.07_wp*0.025_wp/(0.045_wp*0.05_wp), 1.0e-12_wp, &
         & "grows with the root of both squares, by the strains of compression")
   end subroutine test_shear

   !> The larger principal strain takes all that is left in the plane
   subroutine test_locking()
      type(point_type) :: point
      type(strain_constants_type) :: ply
      real(wp) :: part, strain(6), values(scalars)
      integer :: i

      call begin("locking")
      ply = straight_ply()
      ply%onset(by_fibres:by_matrix, :) = 5.0_wp
      ply%finish(by_fibres:by_matrix, :) = 9.0_wp
      ply%onset(by_locking, :) = [0.02_wp, 0.03_wp]
      ply%finish(by_locking, :) = [0.06_wp, 0.09_wp]
      point = new_point(ply)
      ! 0.01 and a circle of 0.015 and 0.02 around it: principal strains of 0.035 and -0.015
      strain(:) = [0.025_wp, -0.005_wp, 0.001_wp, 0.04_wp, 0.002_wp, 0.003_wp]
      call move(point, strain)
      part = 1.0_wp - 0.06_wp*0.015_wp/(0.035_wp*0.04_wp)
      call check(point%history(:by_locking), [0.0_wp, 0.0_wp, 1.0_wp - part], 1.0e-12_wp, &
         & "grows with the principal strain")
      call check(point%stress, [part*ply%young(1)*strain(1), part*ply%young(2)*strain(2), &
         & ply%young(3)*strain(3), part*ply%shear(1)*strain(4), ply%shear(2:)*strain(5:)], &
         & 1.0e-8_wp, "weakens the plane and nothing across it")
      values(:) = point%law%output_variables(1, spread(point%history, 1, lanes))
      call check(values(shows_fibre_damage:shows_shear_damage), spread(1.0_wp - part, 1, 3), &
         & 1.0e-12_wp, "shows as damage of all")
      call check(values(shows_dissipated), point%history(variables), 0.0_wp, "and its energy")

      point = new_point(ply)
      call move(point, -strain)
      part = 1.0_wp - 0.09_wp*0.005_wp/(0.035_wp*0.06_wp)
      call check(point%history(by_locking), 1.0_wp - part, 1.0e-12_wp, &
         & "has strains of compression of its own")

      call begin("energy of locking")
      point = new_point(ply)
      do i = 1, steps
         call pull(point, 1, beyond*0.06_wp*real(i, wp)/real(steps, wp))
      end do
      call check(point%history(variables), 0.5_wp*ply%young(1)*0.02_wp*0.06_wp, &
         & lost_in_rest*ply%young(1)*0.06_wp**2, "is the triangle")
      call check(point%history([along_energy, across_energy]), &
         & [point%history(variables), 0.0_wp], rounded*point%history(variables), &
         & "along the fibres that were strained")
   end subroutine test_locking

   !> Without stress across the thickness: the plane secant stiffness of the law
   subroutine test_poisson()
      real(wp), parameter :: r(2) = [0.5_wp, 0.25_wp]
      type(point_type) :: point
      type(strain_constants_type) :: ply
      real(wp) :: across(2), minor, part, strain(6)
      integer :: k

      call begin("Poisson's effect")
      ply = straight_ply()
      ply%poisson = [0.3_wp, 0.3_wp, 0.4_wp]
      strain(:) = 0.0_wp
      do k = 1, 2
         associate (i => ply%onset(k, 1), s => ply%finish(k, 1))
            ! strain at which 1 - R of the stiffness is lost
            strain(k) = i*s/(s - (1.0_wp - r(k))*(s - i))
         end associate
      end do
      ! stress across the thickness is linear in the strain there
      do k = 1, 2
         strain(3) = real(k - 1, wp)
         point = new_point(ply)
         call move(point, strain)
         across(k) = point%stress(3)
      end do
      strain(3) = -across(1)/(across(2) - across(1))
      point = new_point(ply)
      call move(point, strain)
      minor = 0.3_wp*ply%young(2)/ply%young(1)
      part = 1.0_wp/(1.0_wp - product(r)*0.3_wp*minor)
      call check(point%stress(1), r(1)*ply%young(1)*part*(strain(1) + r(2)*minor*strain(2)), &
         & 1.0e-7_wp, "is reduced along the fibres")
      call check(point%stress(2), r(2)*ply%young(2)*part*(strain(2) + r(1)*0.3_wp*strain(1)), &
         & 1.0e-7_wp, "and across them")
   end subroutine test_poisson

   !> One damage for both senses, each with its strains
   subroutine test_both_senses()
      type(point_type) :: point
      type(strain_constants_type) :: ply
      real(wp) :: damage, from, dissipated_energy

      call begin("tension, then compression")
      ply = straight_ply()
      point = new_point(ply)
      call pull(point, 1, 0.03_wp)
      damage = 0.06_wp*0.015_wp/(0.03_wp*0.045_wp)
      call check(point%history(by_fibres), damage, 1.0e-12_wp, "is damaged by tension")
      dissipated_energy = point%history(variables)
      ! strain of compression with the same damage
      from = 0.011_wp*0.09_wp/(0.09_wp - damage*0.079_wp)
      call pull(point, 1, -0.999_wp*from)
      call check(point%history(by_fibres), damage, 0.0_wp, "does not heal")
      call check(point%stress(1), -(1.0_wp - damage)*ply%young(1)*0.999_wp*from, 1.0e-8_wp, &
         & "and does not close")
      call check(point%history(variables), dissipated_energy, 0.0_wp, "spends nothing on the way")
      call pull(point, 1, -1.5_wp*from)
      call check(point%history(by_fibres), 0.09_wp*(1.5_wp*from - 0.011_wp) &
         & /(1.5_wp*from*0.079_wp), 1.0e-12_wp, "goes on by the strains of compression")
   end subroutine test_both_senses

   !> Compression that turns into tension under shear that is held: damage jumps, and all that was
   !> stored is free
   subroutine test_jump()
      type(point_type) :: point
      type(strain_constants_type) :: ply
      real(wp) :: strain(6)
      integer :: i

      call begin("compression that ends under shear")
      ply = straight_ply()
      ply%onset(by_matrix, :) = [0.005_wp, 0.03_wp]
      ply%finish(by_matrix, :) = [0.02_wp, 0.06_wp]
      point = new_point(ply)
      strain(:) = 0.0_wp
      strain(4) = 0.04_wp
      do i = -steps, steps
         strain(2) = 2.0e-4_wp*real(i, wp)/real(steps, wp)
         call move(point, strain)
         if (i == -steps) call check(point%history(by_matrix), 0.0_wp, 0.0_wp, "is intact before")
      end do
      call check(point%history(by_matrix), 1.0_wp, 0.0_wp, "breaks by the strains of tension")
      call check(point%history(variables)/(0.5_wp*ply%shear(1)*strain(4)**2), 1.0_wp, 1.0e-5_wp, &
         & "sets all free that was stored")
   end subroutine test_jump

   !> Lanes of other laws keep stress and history
   subroutine test_owned_lanes()
      type(strain_constants_type) :: ply
      type(strain_damage_type) :: law
      real(wp) :: history(lanes, variables), strain(lanes, 6), stress(lanes, 6)

      call begin("lanes of other laws")
      ply = straight_ply()
      call ply%set_lane(1, law)
      history(:, :) = 0.125_wp
      strain(:, :) = 0.02_wp
      stress(:, :) = 7.0_wp
      call law%update(0.0_wp, strain, history, stress)
      call check(stress(lanes, :), spread(7.0_wp, 1, 6), 0.0_wp, "keep their stress")
      call check(history(lanes, :), spread(0.125_wp, 1, variables), 0.0_wp, "and their history")
      call check(stress(1, 5), 0.02_wp*5.0e3_wp, 1.0e-10_wp, "while its own is changed")
   end subroutine test_owned_lanes

end program test_law_ply_strain_damage
