!> Bricks: linear motions, large rotations, hourglass control and its energy.
program test_element_brick_bricks
   use plydyn_base_exact_sum, only : exact_sums_type, new_exact_sums
   use plydyn_base_precision, only : lanes, wp
   use plydyn_element_brick_bricks, only : brick_shares, bricks_type, corners, new_brick_shape, &
      & mode_shape
   use plydyn_element_brick_kernel, only : add_brick_forces, hourglass_energy
   use plydyn_element_brick_recover, only : add_brick_energy, brick_values
   use plydyn_element_group, only : stress_at
   use plydyn_element_material_batch, only : batch_stiffness
   use plydyn_law_ply_elastic, only : ply_stiffness, strain_rotation
   use testing, only : begin, check, finish
   implicit none

   !> Nodes of a cube
   real(wp), parameter :: cube(3, corners) = reshape(0.5_wp*[-1, -1, -1, 1, -1, -1, 1, 1, -1, -1, &
      & 1, -1, -1, -1, 1, 1, -1, 1, 1, 1, 1, -1, 1, 1], [3, corners])
   !> Freedoms of a batch whose bricks have no node in common
   integer, parameter :: freedoms = 3*lanes*corners

   real(wp) :: c(6, 6), position(3, corners, lanes)
   integer :: points

   call set_material()
   call set_positions()
   call test_shares()
   do points = 1, corners, corners - 1
      call test_linear()
      call test_turned()
      call test_energy()
   end do
   call test_unfelt()
   call test_drag()
   call finish()

contains

   !> A ply at 30 degrees
   subroutine set_material()
      real(wp) :: turn(6, 6)

      turn(:, :) = strain_rotation(30.0_wp)
      c(:, :) = matmul(transpose(turn), matmul(ply_stiffness([140.0_wp, 10.0_wp, 9.0_wp], &
         & [0.3_wp, 0.3_wp, 0.4_wp], [5.0_wp, 4.5_wp, 3.0_wp]), turn))
   end subroutine set_material

   !> Flat bricks with corners shifted by up to a tenth, each in another way
   subroutine set_positions()
      integer :: i, l, n

      do l = 1, lanes
         do n = 1, corners
            do i = 1, 3
               position(i, n, l) = cube(i, n)*(1.1_wp - 0.3_wp*real(i - 1, wp)) &
                  & + 0.05_wp*sin(real(7*l + 11*n + 13*i, wp))
            end do
         end do
      end do
   end subroutine set_positions

   !> A batch of bricks
   function batch(coefficient, viscosity) result(bricks)
      real(wp), intent(in) :: coefficient, viscosity
      type(bricks_type) :: bricks
      integer :: l, n

      bricks%points = points
      bricks%shares_volume = points > 1
      bricks%stiffness = reshape(spread(batch_stiffness(c), 1, lanes), [lanes, 13, 1])
      bricks%rotation = reshape(spread([1.0_wp, 0.0_wp], 1, lanes), [lanes, 2, 1])
      bricks%two_over_h = reshape(spread(1.0_wp, 1, lanes), [lanes, 1])
      bricks%viscosity = viscosity
      if (viscosity > 0.0_wp) bricks%histories = 1
      allocate (bricks%laws(0))
      bricks%shapes = [new_brick_shape(position, lanes - 1, points, coefficient*c)]
      bricks%shape = [1]
      bricks%place = reshape([((l + 3*lanes*(n - 1), l=1, lanes), n=1, corners)], &
         & [lanes, corners, 1])
      bricks%target = bricks%place
   end function batch

   !> A motion of all nodes from a gradient
   function linear(gradient) result(u)
      real(wp), intent(in) :: gradient(3, 3)
      real(wp) :: u(freedoms)
      integer :: l, n

      do n = 1, corners
         do l = 1, lanes
            u(l + 3*lanes*(n - 1):l + 3*lanes*n - 1:lanes) = matmul(gradient, position(:, n, l))
         end do
      end do
   end function linear

   !> A motion without order
   function wild(size) result(u)
      real(wp), intent(in) :: size
      real(wp) :: u(freedoms)
      integer :: i

      u(:) = [(size*sin(real(3*i*i + i, wp)), i=1, freedoms)]
   end function wild

   !> Forces of a motion
   function forces(bricks, large, u) result(force)
      type(bricks_type), intent(in) :: bricks
      logical, intent(in) :: large
      real(wp), intent(in) :: u(freedoms)
      real(wp) :: force(freedoms)

      real(wp) :: history(lanes*bricks%histories*corners)

      force(:) = 0.0_wp
      history(:) = 0.0_wp
      call add_brick_forces(bricks, [1, 1], large, 0.0_wp, u, 0.0_wp*u, history, force)
   end function forces

   !> The nodes share the volume
   subroutine test_shares()
      call begin("brick_shares")
      call check(brick_shares(cube), spread(0.125_wp, 1, corners), 1.0e-14_wp, "of a cube")
      call check(minval(brick_shares(position(:, :, 3))) > 0.0_wp, "all of a bent brick")
   end subroutine test_shares

   !> The stress of a linear displacement is Hooke's
   subroutine test_linear()
      real(wp) :: expected(6), gradient(3, 3), history(1), values(lanes, 29)
      type(bricks_type) :: bricks

      call begin("linear displacement")
      gradient(:, :) = 1.0e-3_wp*reshape([3, -1, 2, 4, -2, 1, 1, 5, 2], [3, 3])
      expected(:) = matmul(c, [gradient(1, 1), gradient(2, 2), gradient(3, 3), gradient(1, 2) &
         & + gradient(2, 1), gradient(1, 3) + gradient(3, 1), gradient(2, 3) + gradient(3, 2)])
      bricks = batch(0.1_wp, 0.0_wp)
      history(:) = 0.0_wp
      values(:, :) = brick_values(bricks, 1, .false., linear(gradient), history)
      call check(maxval(abs(values(:lanes - 1, stress_at + 1:stress_at + 6) &
         & - spread(expected, 1, lanes - 1))), 0.0_wp, 1.0e-14_wp, "stress")
      call check(maxval(abs(forces(bricks, .false., spread(1.0_wp, 1, freedoms)))), 0.0_wp, &
         & 1.0e-12_wp, "a translation has no force")
      call check(hourglass_energy(bricks, 1, .false., linear(gradient), history), 0.0_wp, &
         & 1.0e-25_wp, "and no hourglass energy")
   end subroutine test_linear

   !> A large rotation has no force; a motion that is turned has the forces turned
   subroutine test_turned()
      real(wp), parameter :: s = sqrt(0.5_wp)
      real(wp) :: f(freedoms), g(freedoms), r(3, 3), u(freedoms), v(freedoms)
      type(bricks_type) :: bricks
      integer :: k, l

      call begin("large rotation")
      r(:, :) = matmul(reshape([s, s, 0.0_wp, -s, s, 0.0_wp, 0.0_wp, 0.0_wp, 1.0_wp], [3, 3]), &
         & reshape([1.0_wp, 0.0_wp, 0.0_wp, 0.0_wp, 0.6_wp, 0.8_wp, 0.0_wp, -0.8_wp, 0.6_wp], &
         & [3, 3]))
      bricks = batch(0.3_wp, 0.0_wp)
      u(:) = linear(r)
      v(:) = linear(reshape([1.0_wp, 0.0_wp, 0.0_wp, 0.0_wp, 1.0_wp, 0.0_wp, 0.0_wp, 0.0_wp, &
         & 1.0_wp], [3, 3]))
      call check(maxval(abs(forces(bricks, .true., u - v))), 0.0_wp, 1.0e-12_wp, "has no force")
      f(:) = forces(bricks, .true., wild(0.05_wp))
      do k = 1, freedoms, 3*lanes
         do l = k, k + lanes - 1
            u(l:l + 2*lanes:lanes) = matmul(r, v(l:l + 2*lanes:lanes))
            g(l:l + 2*lanes:lanes) = matmul(r, f(l:l + 2*lanes:lanes))
         end do
      end do
      f(:) = wild(0.05_wp)
      do k = 1, freedoms, 3*lanes
         do l = k, k + lanes - 1
            u(l:l + 2*lanes:lanes) = u(l:l + 2*lanes:lanes) - v(l:l + 2*lanes:lanes) &
               & + matmul(r, f(l:l + 2*lanes:lanes))
         end do
      end do
      call check(forces(bricks, .true., u), g, 1.0e-11_wp, "turns the forces of a motion")
   end subroutine test_turned

   !> No work along a closed path: the stiffness at a large motion is symmetric
   subroutine test_energy()
      real(wp), parameter :: tiny_step = 1.0e-5_wp
      real(wp) :: a(freedoms), b(freedoms), df(freedoms), dg(freedoms), u(freedoms)
      type(bricks_type) :: bricks
      integer :: i

      call begin("energy")
      bricks = batch(0.3_wp, 0.0_wp)
      u(:) = wild(0.05_wp)
      a(:) = [(cos(real(5*i, wp)), i=1, freedoms)]
      b(:) = [(cos(real(i*i, wp)), i=1, freedoms)]
      df(:) = forces(bricks, .true., u + tiny_step*a) - forces(bricks, .true., u - tiny_step*a)
      dg(:) = forces(bricks, .true., u + tiny_step*b) - forces(bricks, .true., u - tiny_step*b)
      call check(dot_product(df, b)/dot_product(dg, a), 1.0_wp, 1.0e-7_wp, "has a potential")
      ! forces act on the nodes: they are the fall of the energy
      call check((stored(bricks, u + tiny_step*a) - stored(bricks, u - tiny_step*a)) &
         & /(2.0_wp*tiny_step*dot_product(forces(bricks, .true., u), a)), -1.0_wp, 1.0e-7_wp, &
         & "is stored")
   end subroutine test_energy

   !> Energy stored at a motion, with that of hourglass control
   real(wp) function stored(bricks, u)
      type(bricks_type), intent(in) :: bricks
      real(wp), intent(in) :: u(freedoms)

      type(bricks_type) :: placed
      type(exact_sums_type) :: sums
      real(wp) :: history(lanes*bricks%histories*corners)

      placed = bricks
      placed%first_history = 1
      history(:) = 0.0_wp
      sums = new_exact_sums(3)
      call add_brick_energy(placed, [1, 1], .true., u, history, sums)
      stored = sums%value(1) + sums%value(2)
   end function stored

   !> Shapes that one point does not feel cost energy; with coefficient 1 that of bending
   subroutine test_unfelt()
      real(wp) :: bent, history(1), u(freedoms)
      type(bricks_type) :: bricks
      integer :: a, i, l, n

      call begin("hourglass stiffness")
      points = 1
      do l = 1, lanes
         position(:, :, l) = cube*spread([2.0_wp, 1.0_wp, 0.5_wp], 2, corners)
      end do
      c(:, :) = ply_stiffness(spread(200.0_wp, 1, 3), spread(0.25_wp, 1, 3), spread(80.0_wp, 1, 3))
      bricks = batch(1.0_wp, 0.0_wp)
      history(:) = 0.0_wp
      do a = 1, 4
         do i = 0, 2
            u(:) = 0.0_wp
            do n = 1, corners
               u(1 + 3*lanes*(n - 1) + lanes*i) = mode_shape(n, a)
            end do
            call check(hourglass_energy(bricks, 1, .false., u, history) > 1.0e-3_wp, &
               & "every shape is held")
         end do
      end do
      ! u_x = xi zeta: strain zeta over the half length 1, stress across is free, that along y not
      u(:) = 0.0_wp
      do n = 1, corners
         u(1 + 3*lanes*(n - 1)) = mode_shape(n, 2)
      end do
      bent = 0.5_wp*200.0_wp/(1.0_wp - 0.25_wp**2)/3.0_wp
      call check(hourglass_energy(bricks, 1, .false., u, history), bent, 1.0e-12_wp, &
         & "bending of a plate")
      call check(-0.5_wp*dot_product(u, forces(bricks, .false., u)), bent, 1.0e-12_wp, &
         & "is the work of the forces")
   end subroutine test_unfelt

   !> Viscous control takes what its forces do
   subroutine test_drag()
      real(wp) :: force(freedoms), history(lanes), v(freedoms)
      type(bricks_type) :: bricks

      call begin("viscous hourglass control")
      bricks = batch(0.0_wp, 2.0_wp)
      v(:) = wild(1.0_wp)
      v(lanes::lanes) = 0.0_wp
      force(:) = 0.0_wp
      history(:) = 0.0_wp
      call add_brick_forces(bricks, [1, 1], .false., 0.5_wp, 0.0_wp*v, v, history, force)
      call check(sum(history), -0.5_wp*dot_product(force, v), 1.0e-12_wp, "energy taken")
      call check(minval(history(:lanes - 1)) > 0.0_wp, "in every brick")
      force(:) = 0.0_wp
      call add_brick_forces(bricks, [1, 1], .false., 0.5_wp, 0.0_wp*v, linear(c(:3, :3)), history, &
         & force)
      call check(maxval(abs(force)), 0.0_wp, 1.0e-10_wp, "nothing from a linear velocity")
   end subroutine test_drag

end program test_element_brick_bricks
