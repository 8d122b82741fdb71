!> A crack of the matrix: what it takes to open it, what closed faces carry, and when they part.
program test_law_matrix_crack
   use plydyn_base_precision, only : lanes, wp
   use plydyn_law_matrix_crack, only : across, along, apart_at, begin_crack, crack_energy, &
      & crack_faces, crack_histories, crack_law_type, damage_at, exceeds, fracture_at, &
      & friction_at, mode_at, update_crack, upward
   use testing, only : begin, check, finish
   implicit none

   !> Steps of a motion
   integer, parameter :: steps = 40000
   real(wp), parameter :: toughness = 0.3_wp, thickness = 0.5_wp
   !> Strengths across, along, and through the thickness, MPa
   real(wp), parameter :: strength(3) = [60.0_wp, 110.0_wp, 75.0_wp]

   type(crack_law_type) :: law
   integer :: i

   law%strength(:, :) = spread(strength, 1, lanes)
   law%stiffness(:) = 5.0e4_wp
   law%thickness(:) = thickness
   law%toughness = toughness

   call begin("exceeds")
   call check(exceeds(law, 1, 0.0_wp, 60.001_wp, 0.0_wp), "tension across starts a crack")
   call check(.not. exceeds(law, 1, 0.0_wp, 59.999_wp, 0.0_wp), "and less does not")
   call check(exceeds(law, 1, -110.001_wp, 0.0_wp, 0.0_wp), "so does shear along the fibres")
   call check(exceeds(law, 1, 0.0_wp, 0.0_wp, -75.001_wp), "and shear through the thickness")
   call check(exceeds(law, 1, 0.8001_wp*110.0_wp, 0.6_wp*60.0_wp, 0.0_wp), "squares of both add")
   call check(.not. exceeds(law, 1, 0.7999_wp*110.0_wp, 0.6_wp*60.0_wp, 0.0_wp), "to 1")
   call check(.not. exceeds(law, 1, 0.0_wp, -1.0e3_wp, 0.0_wp), "pressure alone starts none")
   law%friction = 0.3_wp
   call check(.not. exceeds(law, 1, 139.9_wp, -100.0_wp, 0.0_wp), "its friction holds shear")
   call check(exceeds(law, 1, 140.1_wp, -100.0_wp, 0.0_wp), "of its coefficient times the pressure")
   law%friction = 0.0_wp

   call check_mode()

   call begin("fracture")
   do i = 1, 3
      call open_along([merge(1.0_wp, 0.0_wp, i == along), merge(1.0_wp, 0.0_wp, i == across), &
         & merge(1.0_wp, 0.0_wp, i == upward)], [1.0_wp, 1.0_wp], [1.0_wp, 1.0_wp])
   end do
   call open_along([0.5_wp, 0.6_wp, -0.4_wp], [1.0_wp, 1.0_wp], [1.0_wp, 1.0_wp])

   call begin("fracture of a bent ply")
   call open_along([0.0_wp, 1.0_wp, 0.0_wp], [0.5_wp, 1.5_wp], [0.5_wp, 1.5_wp])
   call open_along([0.0_wp, 1.0_wp, 0.0_wp], [0.0_wp, 2.0_wp], [1.0_wp, 1.0_wp])
   call open_along([0.0_wp, 0.8_wp, 0.6_wp], [1.0_wp, 1.0_wp], [0.2_wp, 1.4_wp])

   call check_closed()
   call check_sheared()
   call check_apart()
   call check_debris()
   call finish()

contains

   !> The share of shear in the square of the mean traction, as a crack starts
   subroutine check_mode()
      real(wp) :: history(crack_histories), traction(3, crack_faces)

      call begin("mode")
      traction(along, :) = 30.0_wp
      traction(upward, :) = 0.0_wp
      traction(across, :) = 40.0_wp
      call begin_crack(law, 1, 1.0_wp, traction, history)
      call check(history(mode_at), 1.0_wp - 0.8_wp**2, 1.0e-14_wp, "of shear beside tension")
      traction(across, :) = [60.0_wp, -60.0_wp]
      call begin_crack(law, 1, 1.0_wp, traction, history)
      call check(history(mode_at), 1.0_wp, 1.0e-14_wp, "of shear beside bending")
      traction(across, :) = -40.0_wp
      call begin_crack(law, 1, 1.0_wp, traction, history)
      call check(history(mode_at), 1.0_wp, 1.0e-14_wp, "of shear beside pressure")
      traction(along, :) = 0.0_wp
      traction(across, :) = 40.0_wp
      call begin_crack(law, 1, 1.0_wp, traction, history)
      call check(history(mode_at), 0.0_wp, 1.0e-14_wp, "of tension alone")
   end subroutine check_mode

   !> The work of opening in one direction, from the traction of the start to none, is the toughness
   subroutine open_along(direction, began, way)
      real(wp), intent(in) :: direction(3)
      !> Shares of both faces of the traction at the start, and of the opening
      real(wp), intent(in) :: began(crack_faces), way(crack_faces)

      logical, parameter :: is_open(lanes) = [.true., spread(.false., 1, lanes - 1)]
      real(wp) :: history(lanes, crack_histories), opening(lanes, 3, crack_faces), step
      real(wp) :: path(3, crack_faces), traction(lanes, 3, crack_faces), unit(3), work
      integer :: i, f

      unit(:) = direction/norm2(direction)
      path(:, :) = spread(unit, 2, crack_faces)*spread(way, 1, 3)
      history(:, :) = 0.0_wp
      call begin_crack(law, 1, 1.0_wp, 50.0_wp*spread(unit, 2, crack_faces)*spread(began, 1, 3), &
         & history(1, :))
      work = 0.0_wp
      ! a sixth of the way beyond the end
      step = 7.0_wp/6.0_wp*2.0_wp*toughness/50.0_wp/real(steps, wp)
      opening(:, :, :) = 0.0_wp
      call update_crack(law, is_open, opening, history, traction)
      do f = 1, crack_faces
         call check(maxval(abs(traction(1, :, f) - 50.0_wp*began(f)*unit)), 0.0_wp, 1.0e-11_wp, &
            & "it begins with the traction of the tie")
      end do
      do i = 1, steps
         work = work + 0.5_wp*step*sum(path*traction(1, :, :))/crack_faces
         opening(1, :, :) = step*i*path
         call update_crack(law, is_open, opening, history, traction)
         work = work + 0.5_wp*step*sum(path*traction(1, :, :))/crack_faces
         if (mod(i, steps/5) == 0) call check(history(1, fracture_at) + crack_energy(law, 1, &
            & opening(1, :, :), history(1, :)), work, 1.0e-6_wp, "work is stored or lost")
      end do
      call check(history(1, damage_at), 1.0_wp, 0.0_wp, "the crack is open")
      call check(history(1, fracture_at), toughness, 1.0e-12_wp, "the toughness is spent")
      call check(work, toughness, 1.0e-6_wp, "and is the work")
      call check(maxval(abs(traction)), 0.0_wp, 1.0e-12_wp, "nothing is left")
   end subroutine open_along

   !> A broken crack carries pressure and its friction, which is what sliding takes
   subroutine check_closed()
      logical, parameter :: is_open(lanes) = [.true., spread(.false., 1, lanes - 1)]
      real(wp), parameter :: pressed = -0.001_wp, slip = 1.0e-5_wp
      real(wp) :: history(lanes, crack_histories), lost, opening(lanes, 3, crack_faces)
      real(wp) :: traction(lanes, 3, crack_faces)
      integer :: i

      call begin("closed faces")
      law%friction = 0.3_wp
      history(:, :) = 0.0_wp
      call begin_crack(law, 1, 1.0_wp, spread([0.0_wp, 60.0_wp, 0.0_wp], 2, crack_faces), &
         & history(1, :))
      history(1, damage_at) = 1.0_wp
      opening(:, :, :) = 0.0_wp
      opening(1, across, :) = pressed - 60.0_wp/5.0e4_wp
      do i = 1, 1000
         opening(1, along, :) = slip*i
         call update_crack(law, is_open, opening, history, traction)
      end do
      call check(traction(1, across, 1), 5.0e4_wp*pressed, 1.0e-9_wp, "carry the pressure")
      call check(traction(1, along, 2), 15.0_wp, 1.0e-9_wp, "and its friction")
      ! they stick over the first 15 MPa
      call check(history(1, friction_at), 15.0_wp*(1000.0_wp*slip - 15.0_wp/5.0e4_wp), 1.0e-3_wp, &
         & "whose work is lost")
      ! one step in which they slide on while the friction falls to 6 MPa, and one that opens them
      lost = history(1, friction_at) + 0.5_wp*(15.0_wp + 6.0_wp)*(slip + 9.0_wp/5.0e4_wp)
      opening(1, along, :) = slip*1001
      opening(1, across, :) = 0.4_wp*pressed - 60.0_wp/5.0e4_wp
      call update_crack(law, is_open, opening, history, traction)
      call check(history(1, friction_at), lost, 1.0e-12_wp, "by its mean where the pressure falls")
      lost = lost + 0.5_wp*6.0_wp*6.0_wp/5.0e4_wp
      opening(1, across, :) = -pressed
      call update_crack(law, is_open, opening, history, traction)
      call check(history(1, friction_at), lost, 1.0e-12_wp, "and with the stretch where they part")
      law%friction = 0.0_wp
   end subroutine check_closed

   !> A crack that breaks by shear while its faces are pressed: what has failed has friction at
   !> once, and no work is lost unseen
   subroutine check_sheared()
      logical, parameter :: is_open(lanes) = [.true., spread(.false., 1, lanes - 1)]
      real(wp), parameter :: pressure = 300.0_wp, shear = 150.0_wp, way = 0.008_wp
      real(wp) :: history(lanes, crack_histories), opening(lanes, 3, crack_faces), work
      real(wp) :: traction(lanes, 3, crack_faces)
      integer :: i

      call begin("fracture under pressure")
      law%friction = 0.3_wp
      history(:, :) = 0.0_wp
      call begin_crack(law, 1, 1.0_wp, spread([shear, -pressure, 0.0_wp], 2, crack_faces), &
         & history(1, :))
      opening(:, :, :) = 0.0_wp
      call update_crack(law, is_open, opening, history, traction)
      work = 0.0_wp
      do i = 1, steps
         work = work + 0.5_wp*way/steps*traction(1, along, 1)
         opening(1, along, :) = way*i/steps
         call update_crack(law, is_open, opening, history, traction)
         work = work + 0.5_wp*way/steps*traction(1, along, 1)
      end do
      call check(history(1, damage_at), 1.0_wp, 0.0_wp, "the crack is open")
      call check(history(1, fracture_at), toughness, 1.0e-9_wp, "the toughness is spent")
      call check(traction(1, along, 2), 0.3_wp*pressure, 1.0e-9_wp, "friction is left")
      call check(history(1, fracture_at) + history(1, friction_at) + crack_energy(law, 1, &
         & opening(1, :, :), history(1, :)), work, 1.0e-3_wp*work, "work is stored or lost")
      law%friction = 0.0_wp
   end subroutine check_sheared

   !> Faces that slide past each other along the thickness meet less and less, and no more from half
   !> of the ply on
   subroutine check_apart()
      logical, parameter :: is_open(lanes) = [.true., spread(.false., 1, lanes - 1)]
      real(wp) :: history(lanes, crack_histories), opening(lanes, 3, crack_faces), pressure(4)
      real(wp) :: traction(lanes, 3, crack_faces)
      real(wp), parameter :: slip(4) = [0.0_wp, 0.1_wp, 0.26_wp, 0.0_wp]
      integer :: i

      call begin("faces past each other")
      history(:, :) = 0.0_wp
      call begin_crack(law, 1, 1.0_wp, spread([0.0_wp, 60.0_wp, 0.0_wp], 2, crack_faces), &
         & history(1, :))
      history(1, damage_at) = 1.0_wp
      opening(:, :, :) = 0.0_wp
      opening(1, across, :) = -0.002_wp - 60.0_wp/5.0e4_wp
      do i = 1, 4
         opening(1, upward, :) = slip(i)
         call update_crack(law, is_open, opening, history, traction)
         pressure(i) = -traction(1, across, 1)
      end do
      call check(pressure(1), 100.0_wp, 1.0e-9_wp, "without slip they meet with all of it")
      call check(pressure(2), 60.0_wp, 1.0e-9_wp, "at a fifth of the ply with 60 %")
      call check(pressure(3), 0.0_wp, 0.0_wp, "past half of it not at all")
      call check(pressure(4), 0.0_wp, 0.0_wp, "nor when they come back")
      call check(history(1, apart_at), 1.0_wp, 0.0_wp, "which is noted")
   end subroutine check_apart

   !> Debris bears closing faces at the opening that it holds, and takes and makes no energy
   subroutine check_debris()
      logical, parameter :: is_open(lanes) = [.true., spread(.false., 1, lanes - 1)]
      real(wp), parameter :: begun = 60.0_wp/5.0e4_wp, way(3) = [0.02_wp, 0.002_wp, 0.02_wp]
      real(wp) :: from, history(lanes, crack_histories), opening(lanes, 3, crack_faces), work
      real(wp) :: traction(lanes, 3, crack_faces)
      integer :: i, k

      call begin("debris")
      law%debris = 0.004_wp
      history(:, :) = 0.0_wp
      call begin_crack(law, 1, 1.0_wp, spread([0.0_wp, 60.0_wp, 0.0_wp], 2, crack_faces), &
         & history(1, :))
      opening(:, :, :) = 0.0_wp
      call update_crack(law, is_open, opening, history, traction)
      work = 0.0_wp
      from = begun
      do k = 1, size(way)
         do i = 1, steps
            work = work + 0.5_wp*(way(k) - from)/steps*traction(1, across, 1)
            opening(1, across, :) = from + (way(k) - from)*i/steps - begun
            call update_crack(law, is_open, opening, history, traction)
            work = work + 0.5_wp*(way(k) - from)/steps*traction(1, across, 1)
         end do
         from = way(k)
         call check(history(1, fracture_at) + crack_energy(law, 1, opening(1, :, :), &
            & history(1, :)), work, 1.0e-6_wp, "work is stored or lost")
         if (k == 2) call check(traction(1, across, 2), -5.0e4_wp*(0.004_wp - 0.002_wp), &
            & 1.0e-9_wp, "faces meet at 0.004 mm")
      end do
      call check(work, toughness, 1.0e-6_wp, "opened again, all of the work is fracture")
      call check(maxval(abs(traction)), 0.0_wp, 1.0e-12_wp, "and nothing is carried")
      law%debris = 0.0_wp
   end subroutine check_debris

end program test_law_matrix_crack
