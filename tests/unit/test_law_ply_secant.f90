!> The secant stiffness inverts the reduced compliance and stays positive.
program test_law_ply_secant
   use plydyn_base_precision, only : lanes, wp
   use plydyn_law_ply_elastic, only : ply_stiffness
   use plydyn_law_ply_secant, only : secant_type
   use testing, only : begin, check, finish
   implicit none

   !> The ply of the paper's Table 5, N and mm
   real(wp), parameter :: young(3) = [153.0e3_wp, 10.3e3_wp, 10.3e3_wp]
   real(wp), parameter :: poisson(3) = [0.3_wp, 0.3_wp, 0.4_wp]
   real(wp), parameter :: shear(3) = [6.0e3_wp, 6.0e3_wp, 3.7e3_wp]
   !> Another, less alike in 2 and 3
   real(wp), parameter :: uneven(3) = [50.0e3_wp, 20.0e3_wp, 9.0e3_wp]
   real(wp), parameter :: sideways(3) = [0.25_wp, 0.4_wp, 0.35_wp]

   type(secant_type) :: law
   real(wp) :: c(3, 3), compliance(3, 3), elastic(6, 6), one(3, 3), r(2), random(2)
   integer :: i, l
   logical :: positive

   do l = 1, lanes
      call law%set_lane(l, young, poisson, shear)
   end do
   call law%set_lane(2, uneven, sideways, shear)
   one(:, :) = 0.0_wp
   do i = 1, 3
      one(i, i) = 1.0_wp
   end do

   call begin("damaged_stress")
   c(:, :) = stiffness([0.5_wp, 0.25_wp], 1)
   call check([c(1, 1), c(1, 2), c(1, 3), c(2, 2), c(2, 3), c(3, 3)], [76851.6_wp, 565.9_wp, &
      & 1778.5_wp, 2686.5_wp, 1086.0_wp, 10770.3_wp], 0.05_wp, &
      & "has the numbers of an independent program")
   r(:) = [0.3_wp, 0.8_wp]
   compliance(1, :) = [1.0_wp/r(1), -sideways(1), -sideways(2)]/uneven(1)
   compliance(2, :) = [-sideways(1)/uneven(1), 1.0_wp/(r(2)*uneven(2)), -sideways(3)/uneven(2)]
   compliance(3, :) = [-sideways(2)/uneven(1), -sideways(3)/uneven(2), 1.0_wp/uneven(3)]
   call check(reshape(matmul(stiffness(r, 2), compliance), [9]), reshape(one, [9]), 1.0e-12_wp, &
      & "is the inverse of the compliance with R1 E1 and R2 E2")

   positive = .true.
   do i = 1, 1000
      call random_number(random)
      ! from 1 down to 1e-6, evenly in the logarithm
      c(:, :) = stiffness(10.0_wp**(-6.0_wp*random), 1 + mod(i, 2))
      positive = positive .and. is_positive(c)
   end do
   call check(positive, "costs energy for every strain, however much is lost")

   call begin("intact_stress")
   c(:, :) = stiffness([1.0_wp, 1.0_wp], 2)
   call check(law%intact(2, :), [c(1, 1), c(1, 2), c(1, 3), c(2, 2), c(2, 3), c(3, 3)], &
      & 1.0e-10_wp*uneven(1), "is that without damage")
   elastic(:, :) = ply_stiffness(uneven, sideways, shear)
   call check(matmul(elastic(:3, :3), [1.0e-3_wp, -2.0e-3_wp, 3.0e-3_wp]), &
      & intact([1.0e-3_wp, -2.0e-3_wp, 3.0e-3_wp], 2), 1.0e-10_wp, "is that of the ply")
   call finish()

contains

   !> Stiffness of normal stress, from the stresses of unit strains
   function stiffness(remains, lane) result(c)
      !> R1, R2
      real(wp), intent(in) :: remains(2)
      !> Lane to look at
      integer, intent(in) :: lane
      real(wp) :: c(3, 3)

      real(wp) :: strain(lanes, 3), stress(lanes, 3)
      integer :: j

      do j = 1, 3
         strain(:, :) = spread(one(:, j), 1, lanes)
         call law%damaged_stress(strain, spread(remains, 1, lanes), stress)
         c(:, j) = stress(lane, :)*[remains, 1.0_wp]
      end do
   end function stiffness

   !> Stress without damage
   function intact(strain, lane) result(stress)
      !> Normal strains
      real(wp), intent(in) :: strain(3)
      !> Lane to look at
      integer, intent(in) :: lane
      real(wp) :: stress(3)

      real(wp) :: all(lanes, 3)

      call law%intact_stress(spread(strain, 1, lanes), all)
      stress(:) = all(lane, :)
   end function intact

   !> Whether a matrix is symmetric to round-off with positive leading minors
   pure logical function is_positive(c)
      !> Matrix
      real(wp), intent(in) :: c(3, 3)

      real(wp) :: plane

      plane = c(1, 1)*c(2, 2) - c(1, 2)*c(2, 1)
      is_positive = c(1, 1) > 0.0_wp .and. plane > 0.0_wp &
         & .and. maxval(abs(c - transpose(c))) <= 1.0e-12_wp*maxval(c) &
         & .and. c(3, 3)*plane + c(1, 3)*(c(2, 1)*c(3, 2) - c(2, 2)*c(3, 1)) &
         & - c(2, 3)*(c(1, 1)*c(3, 2) - c(1, 2)*c(3, 1)) > 0.0_wp
   end function is_positive

end program test_law_ply_secant
