!> Hourglass control of bricks with one point: forces against the modes that strain nothing at the
!> point. The stiffness is the derivative of an energy of the displacement alone, in the brick's own
!> axes as the motion has rotated and stretched them: no rigid motion meets a force, however large.
module plydyn_element_brick_hourglass
   use plydyn_base_precision, only : lanes, wp
   use plydyn_element_brick_bricks, only : corners, hourglass_modes, mode_stiffnesses
   implicit none
   private

   public :: add_stiffness_forces, add_viscous_forces, mode_amplitudes, modes_to_nodes

contains

   !> Amounts of the hourglass modes in a motion
   pure subroutine mode_amplitudes(u, h, bent, q)
      !> Displacement or velocity of the nodes
      real(wp), intent(in) :: u(lanes, corners, 3)
      !> Its derivatives
      real(wp), intent(in) :: h(lanes, 3, 3)
      !> Share of the hourglass modes in the positions
      real(wp), intent(in) :: bent(lanes, 3, hourglass_modes)
      !> Amounts, (lanes, directions, shapes)
      real(wp), intent(out) :: q(lanes, 3, hourglass_modes)

      real(wp) :: a, b, c, d, e, f, g, k
      integer :: i, j, l

      do i = 1, 3
         !$omp simd private(a, b, c, d, e, f, g, k)
         do l = 1, lanes
            a = u(l, 1, i) + u(l, 7, i)
            b = u(l, 1, i) - u(l, 7, i)
            c = u(l, 2, i) + u(l, 8, i)
            d = u(l, 2, i) - u(l, 8, i)
            e = u(l, 3, i) + u(l, 5, i)
            f = u(l, 3, i) - u(l, 5, i)
            g = u(l, 4, i) + u(l, 6, i)
            k = u(l, 4, i) - u(l, 6, i)
            q(l, i, 1) = 0.125_wp*((a + c) - (e + g))
            q(l, i, 2) = 0.125_wp*((a - c) - (e - g))
            q(l, i, 3) = 0.125_wp*((a - c) + (e - g))
            q(l, i, 4) = 0.125_wp*((d - b) + (k - f))
         end do
      end do
      do j = 1, hourglass_modes
         do i = 1, 3
            !$omp simd
            do l = 1, lanes
               q(l, i, j) = q(l, i, j) - (bent(l, 1, j)*h(l, i, 1) + bent(l, 2, j)*h(l, i, 2) &
                  & + bent(l, 3, j)*h(l, i, 3))
            end do
         end do
      end do
   end subroutine mode_amplitudes

   !> Forces that do work on the amounts, and their share in the flux of the point
   pure subroutine add_stiffness_forces(mode_stiffness, axis, h, large, q, force, p)
      !> Stiffness and axes
      real(wp), intent(in) :: mode_stiffness(lanes, mode_stiffnesses), axis(lanes, 3, 3)
      !> Displacement gradient; large displacement
      real(wp), intent(in) :: h(lanes, 3, 3)
      logical, intent(in) :: large
      !> Amounts of the hourglass modes
      real(wp), intent(in) :: q(lanes, 3, hourglass_modes)
      !> Force on each amount, (lanes, directions, shapes)
      real(wp), intent(out) :: force(lanes, 3, hourglass_modes)
      !> First Piola-Kirchhoff stress times volume
      real(wp), intent(inout) :: p(lanes, 3, 3)

      real(wp) :: moved(lanes, 3, 3)
      real(wp), dimension(lanes, 3, hourglass_modes) :: mode_force, turned
      integer :: i, j, l

      moved(:, :, :) = axis
      if (large) call move_axes(axis, h, moved)
      do j = 1, hourglass_modes
         do i = 1, 3
            turned(:, i, j) = moved(:, 1, i)*q(:, 1, j) + moved(:, 2, i)*q(:, 2, j) &
               & + moved(:, 3, i)*q(:, 3, j)
         end do
      end do
      call find_mode_force(mode_stiffness, turned, mode_force)
      do j = 1, hourglass_modes
         do i = 1, 3
            force(:, i, j) = moved(:, i, 1)*mode_force(:, 1, j) &
               & + moved(:, i, 2)*mode_force(:, 2, j) + moved(:, i, 3)*mode_force(:, 3, j)
         end do
      end do
      if (.not. large) return
      ! the axes move with the displacement
      do j = 1, 3
         do i = 1, 3
            !$omp simd
            do l = 1, lanes
               moved(l, i, j) = q(l, i, 1)*mode_force(l, j, 1) + q(l, i, 2)*mode_force(l, j, 2) &
                  & + q(l, i, 3)*mode_force(l, j, 3) + q(l, i, 4)*mode_force(l, j, 4)
            end do
         end do
      end do
      do j = 1, 3
         do i = 1, 3
            p(:, i, j) = p(:, i, j) + moved(:, i, 1)*axis(:, j, 1) + moved(:, i, 2)*axis(:, j, 2) &
               & + moved(:, i, 3)*axis(:, j, 3)
         end do
      end do
   end subroutine add_stiffness_forces

   !> The brick's axes as the motion has turned and stretched them
   pure subroutine move_axes(axis, h, moved)
      real(wp), intent(in) :: axis(lanes, 3, 3), h(lanes, 3, 3)
      real(wp), intent(out) :: moved(lanes, 3, 3)
      integer :: i, k

      do k = 1, 3
         do i = 1, 3
            moved(:, i, k) = axis(:, i, k) + (h(:, i, 1)*axis(:, 1, k) &
               & + h(:, i, 2)*axis(:, 2, k) + h(:, i, 3)*axis(:, 3, k))
         end do
      end do
   end subroutine move_axes

   !> Forces on the amounts in the brick's own axes
   pure subroutine find_mode_force(k, u, w)
      real(wp), intent(in) :: k(lanes, mode_stiffnesses), u(lanes, 3, hourglass_modes)
      real(wp), intent(out) :: w(lanes, 3, hourglass_modes)

      real(wp) :: eta, xi, zeta
      integer :: l

      !$omp simd private(eta, xi, zeta)
      do l = 1, lanes
         zeta = k(l, 10)*(u(l, 1, 1)*k(l, 14) + u(l, 2, 2)*k(l, 13))
         eta = k(l, 11)*(u(l, 1, 1)*k(l, 15) + u(l, 3, 3)*k(l, 13))
         xi = k(l, 12)*(u(l, 2, 2)*k(l, 15) + u(l, 3, 3)*k(l, 14))
         w(l, 1, 1) = zeta*k(l, 14) + eta*k(l, 15)
         w(l, 2, 2) = zeta*k(l, 13) + xi*k(l, 15)
         w(l, 3, 3) = eta*k(l, 13) + xi*k(l, 14)
         w(l, 1, 3) = k(l, 1)*u(l, 1, 3) + k(l, 2)*u(l, 3, 1)
         w(l, 3, 1) = k(l, 2)*u(l, 1, 3) + k(l, 3)*u(l, 3, 1)
         w(l, 1, 2) = k(l, 4)*u(l, 1, 2) + k(l, 5)*u(l, 2, 1)
         w(l, 2, 1) = k(l, 5)*u(l, 1, 2) + k(l, 6)*u(l, 2, 1)
         w(l, 2, 3) = k(l, 7)*u(l, 2, 3) + k(l, 8)*u(l, 3, 2)
         w(l, 3, 2) = k(l, 8)*u(l, 2, 3) + k(l, 9)*u(l, 3, 2)
         w(l, 1, 4) = k(l, 16)*u(l, 1, 4)
         w(l, 2, 4) = k(l, 17)*u(l, 2, 4)
         w(l, 3, 4) = k(l, 18)*u(l, 3, 4)
      end do
   end subroutine find_mode_force

   !> Viscous forces on the amounts, and the energy that they take
   pure subroutine add_viscous_forces(viscosity, volume, step, q, force, taken)
      !> Force per velocity over volume**(2/3)
      real(wp), intent(in) :: viscosity
      !> Volume of the brick; time step
      real(wp), intent(in) :: volume(lanes), step
      !> Velocities of the amounts
      real(wp), intent(in) :: q(lanes, 3, hourglass_modes)
      !> Force on each amount
      real(wp), intent(out) :: force(lanes, 3, hourglass_modes)
      !> Energy taken so far
      real(wp), intent(inout) :: taken(lanes)

      real(wp) :: rate(lanes)
      integer :: j

      rate(:) = viscosity*real(corners**2, wp)*volume**(2.0_wp/3.0_wp)
      do j = 1, hourglass_modes
         force(:, 1, j) = rate*q(:, 1, j)
         force(:, 2, j) = rate*q(:, 2, j)
         force(:, 3, j) = rate*q(:, 3, j)
      end do
      taken(:) = taken + step*sum(sum(force*q, 3), 2)
   end subroutine add_viscous_forces

   !> Forces on the amounts to forces on the nodes; what they owe to the derivatives goes to the
   !> flux
   pure subroutine modes_to_nodes(force, bent, p, f)
      !> Force on each amount
      real(wp), intent(in) :: force(lanes, 3, hourglass_modes)
      !> Share of the hourglass modes in the positions
      real(wp), intent(in) :: bent(lanes, 3, hourglass_modes)
      !> First Piola-Kirchhoff stress times volume
      real(wp), intent(inout) :: p(lanes, 3, 3)
      !> Forces of the nodes
      real(wp), intent(out) :: f(lanes, corners, 3)

      real(wp) :: a, b, c, d
      integer :: i, j, l

      do j = 1, 3
         do i = 1, 3
            !$omp simd
            do l = 1, lanes
               p(l, i, j) = p(l, i, j) - (force(l, i, 1)*bent(l, j, 1) &
                  & + force(l, i, 2)*bent(l, j, 2) + force(l, i, 3)*bent(l, j, 3) &
                  & + force(l, i, 4)*bent(l, j, 4))
            end do
         end do
      end do
      do i = 1, 3
         !$omp simd private(a, b, c, d)
         do l = 1, lanes
            a = 0.125_wp*force(l, i, 1)
            b = 0.125_wp*force(l, i, 2)
            c = 0.125_wp*force(l, i, 3)
            d = 0.125_wp*force(l, i, 4)
            f(l, 1, i) = ((a + b) + c) - d
            f(l, 2, i) = ((a - b) - c) + d
            f(l, 3, i) = ((c - a) - b) - d
            f(l, 4, i) = ((b - a) - c) + d
            f(l, 5, i) = ((c - a) - b) + d
            f(l, 6, i) = ((b - a) - c) - d
            f(l, 7, i) = ((a + b) + c) + d
            f(l, 8, i) = ((a - b) - c) - d
         end do
      end do
   end subroutine modes_to_nodes

end module plydyn_element_brick_hourglass
