!> Largest eigenvalues of bricks: that of each geometry of each part bounds that of the mesh.
module plydyn_element_brick_stable_rate
   use plydyn_base_precision, only : lanes, wp
   use plydyn_element_brick_make, only : brick_density
   use plydyn_element_brick_bricks, only : brick_shares, bricks_type, corners
   use plydyn_element_brick_kernel, only : find_node_forces
   use plydyn_element_stable_step, only : certified_bound, power_iteration
   use plydyn_model_model, only : model_type
   implicit none
   private

   public :: part_rates

   !> Freedoms of a brick
   integer, parameter :: freedoms = 3*corners

contains

   !> Eigenvalue of each brick of a part; batches of one geometry have that of the first of them
   function part_rates(model, bricks) result(rate)
      !> The model
      type(model_type), intent(in) :: model
      !> The bricks of a part
      type(bricks_type), intent(in) :: bricks
      real(wp), allocatable :: rate(:)

      logical :: is_known(size(bricks%shapes))
      real(wp) :: known(lanes, size(bricks%shapes))
      integer :: b, count

      allocate (rate(size(bricks%brick)))
      is_known(:) = .false.
      do b = 1, size(bricks%shape)
         count = min(lanes, size(bricks%brick) - lanes*(b - 1))
         associate (shape => bricks%shape(b))
            if (.not. is_known(shape)) call solve_batch(model, bricks, b, count, known(:, shape))
            is_known(shape) = .true.
            rate(lanes*(b - 1) + 1:lanes*(b - 1) + count) = known(:count, shape)
         end associate
      end do
   end function part_rates

   !> Eigenvalues of the bricks of a batch; one that is like the lane before has its eigenvalue
   subroutine solve_batch(model, bricks, batch, count, rate)
      type(model_type), intent(in) :: model
      integer, intent(in) :: batch, count
      type(bricks_type), intent(in) :: bricks
      real(wp), intent(out) :: rate(lanes)

      real(wp) :: k(freedoms, freedoms, lanes), mass(freedoms)
      integer :: i, j, l

      k(:, :, :) = dense_stiffness(bricks, batch)
      rate(:) = 0.0_wp
      do l = 1, count
         associate (node => model%mesh%brick_node(:, bricks%brick(lanes*(batch - 1) + l)))
            mass(:) = reshape(spread(brick_density(model, bricks%part) &
               & *brick_shares(model%mesh%position(:, node)), 2, 3), [freedoms])
         end associate
         do j = 1, freedoms
            do i = 1, freedoms
               k(i, j, l) = k(i, j, l)/sqrt(mass(i)*mass(j))
            end do
         end do
         rate(l) = certified_bound(k(:, :, l), power_iteration(k(:, :, l)))
         if (bricks%viscosity > 0.0_wp) then
            rate(l) = with_viscosity(rate(l), bricks%viscosity*real(corners, wp)**2 &
               & *sum(mass(:corners)/brick_density(model, bricks%part))**(2.0_wp/3.0_wp) &
               & /(real(corners, wp)*minval(mass)))
         end if
      end do
   end subroutine solve_batch

   !> The eigenvalue whose step is that of an oscillator with damping of the velocity half a step
   !> before: dt**2 rate/4 + dt damping/2 = 1
   pure real(wp) function with_viscosity(rate, damping) result(effective)
      !> Eigenvalue; damping over mass
      real(wp), intent(in) :: rate, damping

      effective = 4.0_wp*(0.25_wp*damping + sqrt((0.25_wp*damping)**2 + 0.25_wp*rate))**2
   end function with_viscosity

   !> Stiffness of the bricks of a batch, column by column through the kernel; freedoms run over
   !> nodes, then directions
   function dense_stiffness(bricks, batch) result(k)
      type(bricks_type), intent(in) :: bricks
      integer, intent(in) :: batch
      real(wp) :: k(freedoms, freedoms, lanes)

      real(wp), dimension(lanes, corners, 3) :: force, motion
      real(wp) :: history(1), rest(1)
      type(bricks_type) :: alone
      integer :: j

      ! elastic, without viscosity
      alone%points = bricks%points
      alone%shares_volume = bricks%shares_volume
      alone%stiffness = bricks%stiffness
      allocate (alone%laws(0))
      alone%shapes = [bricks%shapes(bricks%shape(batch))]
      alone%shape = [1]
      rest(:) = 0.0_wp
      history(:) = 0.0_wp
      do j = 1, freedoms
         motion(:, :, :) = 0.0_wp
         motion(:, 1 + mod(j - 1, corners), 1 + (j - 1)/corners) = 1.0_wp
         call find_node_forces(alone, 1, .false., 0.0_wp, motion, rest, history, force)
         k(:, j, :) = transpose(reshape(force, [lanes, freedoms]))
      end do
   end function dense_stiffness

end module plydyn_element_brick_stable_rate
