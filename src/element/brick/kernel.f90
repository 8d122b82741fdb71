!> Internal forces of bricks, eight side by side.
module plydyn_element_brick_kernel
   use plydyn_base_precision, only : lanes, wp
   use plydyn_element_brick_bricks, only : brick_shape_type, bricks_type, corners, hourglass_modes
   use plydyn_element_brick_hourglass, only : add_stiffness_forces, add_viscous_forces, &
      & mode_amplitudes, modes_to_nodes
   use plydyn_element_material_batch, only : c33, elastic_stress
   use plydyn_fem_kinematics, only : find_piola, find_strain, turn_strain, turn_stress_back, &
      & volume_ratios
   use plydyn_law_compression_barrier, only : add_barrier_stress
   implicit none
   private

   public :: add_brick_forces, brick_volume_ratios, find_node_forces, find_strains, gather, &
      & hourglass_energy

contains

   !> Subtract the internal forces of some batches
   pure subroutine add_brick_forces(bricks, batches, large, step, displacement, velocity, &
      & history, force)
      !> The bricks of a part
      type(bricks_type), intent(in) :: bricks
      !> First and last batch
      integer, intent(in) :: batches(2)
      !> Large displacement (total Lagrangian) instead of linear strain
      logical, intent(in) :: large
      !> Time step
      real(wp), intent(in) :: step
      !> Displacement and velocity of all points
      real(wp), intent(in) :: displacement(*), velocity(*)
      !> History of the part, (lanes, histories, points, batches)
      real(wp), intent(inout) :: history(lanes, bricks%histories, bricks%points, *)
      !> Force on all points
      real(wp), intent(inout) :: force(*)

      real(wp) :: node_force(lanes, corners, 3), motion(lanes, corners, 3)
      integer :: batch

      do batch = batches(1), batches(2)
         call gather(bricks%place(:, :, batch), displacement, motion)
         call find_node_forces(bricks, batch, large, step, motion, velocity, &
            & history(:, :, :, batch), node_force)
         call scatter(bricks%target(:, :, batch), node_force, force)
      end do
   end subroutine add_brick_forces

   !> Least ratio of volumes at the points of each brick of a batch
   pure function brick_volume_ratios(bricks, batch, displacement) result(ratio)
      !> The bricks of a part
      type(bricks_type), intent(in) :: bricks
      !> The batch
      integer, intent(in) :: batch
      !> Displacement of all points
      real(wp), intent(in) :: displacement(*)
      real(wp) :: ratio(lanes)

      real(wp) :: gradient(lanes, 3, 3), motion(lanes, corners, 3)
      integer :: m

      ratio(:) = huge(1.0_wp)
      call gather(bricks%place(:, :, batch), displacement, motion)
      do m = 1, bricks%points
         call gradient_of(motion, bricks%shapes(bricks%shape(batch))%gradient(:, :, :, m), gradient)
         ratio(:) = min(ratio, volume_ratios(gradient))
      end do
   end function brick_volume_ratios

   !> Displacement gradients and strain at the points of a batch, with the mean of the volume strain
   !> if they share it
   pure subroutine find_strains(bricks, shape, large, motion, gradient, strain)
      !> The bricks of a part; geometry of the batch
      type(bricks_type), intent(in) :: bricks
      type(brick_shape_type), intent(in) :: shape
      !> Large displacement
      logical, intent(in) :: large
      !> Displacement of the nodes
      real(wp), intent(in) :: motion(lanes, corners, 3)
      !> (lanes, directions, along, points), and (lanes, 6, points)
      real(wp), intent(out) :: gradient(lanes, 3, 3, bricks%points), strain(lanes, 6, bricks%points)
      integer :: m

      do m = 1, bricks%points
         call gradient_of(motion, shape%gradient(:, :, :, m), gradient(:, :, :, m))
         call find_strain(gradient(:, :, :, m), large, strain(:, :, m))
      end do
      if (bricks%shares_volume) call mean_volume_strain(shape%volume, strain)
   end subroutine find_strains

   !> Derivatives of the displacement, (lanes, directions, along)
   pure subroutine gradient_of(u, b, h)
      !> Displacement of the nodes
      real(wp), intent(in) :: u(lanes, corners, 3)
      !> Gradients of the shape functions
      real(wp), intent(in) :: b(lanes, corners, 3)
      !> The derivatives
      real(wp), intent(out) :: h(lanes, 3, 3)
      integer :: i, j, l

      do j = 1, 3
         do i = 1, 3
            !$omp simd
            do l = 1, lanes
               h(l, i, j) = ((u(l, 1, i)*b(l, 1, j) + u(l, 2, i)*b(l, 2, j)) &
                  & + (u(l, 3, i)*b(l, 3, j) + u(l, 4, i)*b(l, 4, j))) &
                  & + ((u(l, 5, i)*b(l, 5, j) + u(l, 6, i)*b(l, 6, j)) &
                  & + (u(l, 7, i)*b(l, 7, j) + u(l, 8, i)*b(l, 8, j)))
            end do
         end do
      end do
   end subroutine gradient_of

   !> Motion of the nodes of a batch
   pure subroutine gather(place, motion, u)
      !> Places of x in the arrays of motion
      integer, intent(in) :: place(lanes, corners)
      !> Displacement or velocity of all points
      real(wp), intent(in) :: motion(*)
      !> That of the nodes
      real(wp), intent(out) :: u(lanes, corners, 3)
      integer :: l, n

      do n = 1, corners
         do l = 1, lanes
            u(l, n, 1) = motion(place(l, n))
            u(l, n, 2) = motion(place(l, n) + lanes)
            u(l, n, 3) = motion(place(l, n) + 2*lanes)
         end do
      end do
   end subroutine gather

   !> Subtract forces at the nodes of a batch
   pure subroutine scatter(target, f, force)
      integer, intent(in) :: target(lanes, corners)
      real(wp), intent(in) :: f(lanes, corners, 3)
      real(wp), intent(inout) :: force(*)
      integer :: l, n

      do n = 1, corners
         do l = 1, lanes
            force(target(l, n)) = force(target(l, n)) - f(l, n, 1)
            force(target(l, n) + lanes) = force(target(l, n) + lanes) - f(l, n, 2)
            force(target(l, n) + 2*lanes) = force(target(l, n) + 2*lanes) - f(l, n, 3)
         end do
      end do
   end subroutine scatter

   !> Forces at the nodes of a batch: eight points, with the mean of the volume strain and of the
   !> pressure if they share it; or one point, with hourglass control
   pure subroutine find_node_forces(bricks, batch, large, step, motion, velocity, history, &
      & node_force)
      !> As in `add_brick_forces`
      type(bricks_type), intent(in) :: bricks
      integer, intent(in) :: batch
      logical, intent(in) :: large
      !> Time step; displacement of the nodes; velocity of all points
      real(wp), intent(in) :: step, motion(lanes, corners, 3), velocity(*)
      !> History of the batch
      real(wp), intent(inout) :: history(lanes, bricks%histories, bricks%points)
      real(wp), intent(out) :: node_force(lanes, corners, 3)

      real(wp), dimension(lanes, 3, hourglass_modes) :: amplitude, mode_force
      real(wp), dimension(lanes, 6, corners) :: strain, stress
      real(wp) :: gradient(lanes, 3, 3, corners), flux(lanes, 3, 3)
      integer :: m

      associate (shape => bricks%shapes(bricks%shape(batch)))
         call find_strains(bricks, shape, large, motion, gradient, strain)
         do m = 1, bricks%points
            call find_stress(bricks, step, strain(:, :, m), history(:, :, m), stress(:, :, m))
         end do
         if (bricks%shares_volume) call mean_volume_strain(shape%volume, stress)
         node_force(:, :, :) = 0.0_wp
         do m = 1, bricks%points
            call find_piola(gradient(:, :, :, m), stress(:, :, m), shape%volume(:, m), large, flux)
            if (large) call add_barrier_stress(bricks%stiffness(:, c33, 1)*shape%volume(:, m), &
               & gradient(:, :, :, m), flux)
            if (bricks%viscosity > 0.0_wp) then
               call find_viscous_forces(bricks, batch, step, velocity, &
                  & history(:, bricks%histories, 1), mode_force)
            else if (bricks%points == 1) then
               call mode_amplitudes(motion, gradient, shape%bent, amplitude)
               call add_stiffness_forces(shape%mode_stiffness, shape%axis, gradient, large, &
                  & amplitude, mode_force, flux)
            end if
            if (bricks%points == 1) call modes_to_nodes(mode_force, shape%bent, flux, node_force)
            call integrate(flux, shape%gradient(:, :, :, m), node_force)
         end do
      end associate
   end subroutine find_node_forces

   !> Viscous forces on the hourglass modes of bricks of one point
   pure subroutine find_viscous_forces(bricks, batch, step, velocity, taken, mode_force)
      type(bricks_type), intent(in) :: bricks
      integer, intent(in) :: batch
      real(wp), intent(in) :: step, velocity(*)
      !> Energy taken so far
      real(wp), intent(inout) :: taken(lanes)
      real(wp), intent(out) :: mode_force(lanes, 3, hourglass_modes)

      real(wp) :: amplitude(lanes, 3, hourglass_modes), node_velocity(lanes, corners, 3), &
         & rate(lanes, 3, 3)

      associate (shape => bricks%shapes(bricks%shape(batch)))
         call gather(bricks%place(:, :, batch), velocity, node_velocity)
         call gradient_of(node_velocity, shape%gradient(:, :, :, 1), rate)
         call mode_amplitudes(node_velocity, rate, shape%bent, amplitude)
         call add_viscous_forces(bricks%viscosity, shape%volume(:, 1), step, amplitude, &
            & mode_force, taken)
      end associate
   end subroutine find_viscous_forces

   !> Give all points of a brick the mean of a trace
   pure subroutine mean_volume_strain(volume, e)
      !> Volume of the points; none in lanes without a brick
      real(wp), intent(in) :: volume(lanes, corners)
      !> Strain or stress at the points
      real(wp), intent(inout) :: e(lanes, 6, corners)

      real(wp) :: mean(lanes), more(lanes), whole(lanes)
      integer :: m

      mean(:) = 0.0_wp
      whole(:) = tiny(1.0_wp)
      do m = 1, corners
         mean(:) = mean + volume(:, m)*(e(:, 1, m) + e(:, 2, m) + e(:, 3, m))
         whole(:) = whole + volume(:, m)
      end do
      mean(:) = mean/whole
      do m = 1, corners
         more(:) = (mean - (e(:, 1, m) + e(:, 2, m) + e(:, 3, m)))/3.0_wp
         e(:, 1, m) = e(:, 1, m) + more
         e(:, 2, m) = e(:, 2, m) + more
         e(:, 3, m) = e(:, 3, m) + more
      end do
   end subroutine mean_volume_strain

   !> Stress in the axes of the model, elastic or by the law
   pure subroutine find_stress(bricks, step, strain, history, stress)
      type(bricks_type), intent(in) :: bricks
      real(wp), intent(in) :: step
      real(wp), intent(inout) :: strain(lanes, 6)
      real(wp), intent(inout) :: history(lanes, bricks%histories)
      real(wp), intent(out) :: stress(lanes, 6)

      if (size(bricks%laws) == 0) then
         call elastic_stress(bricks%stiffness(:, :, 1), strain, stress)
         return
      end if
      stress(:, :) = 0.0_wp
      call turn_strain(bricks%rotation(:, :, 1), strain)
      call bricks%laws(1)%law%update(step, strain, history, stress)
      call turn_stress_back(bricks%rotation(:, :, 1), stress)
   end subroutine find_stress

   !> Add the flux of a point to the forces of the nodes
   pure subroutine integrate(p, b, f)
      real(wp), intent(in) :: p(lanes, 3, 3), b(lanes, corners, 3)
      real(wp), intent(inout) :: f(lanes, corners, 3)
      integer :: i, l, n

      do i = 1, 3
         do n = 1, corners
            !$omp simd
            do l = 1, lanes
               f(l, n, i) = f(l, n, i) + (p(l, i, 1)*b(l, n, 1) + p(l, i, 2)*b(l, n, 2) &
                  & + p(l, i, 3)*b(l, n, 3))
            end do
         end do
      end do
   end subroutine integrate

   !> Energy that hourglass control of one point has stored in a batch of bricks, or taken from it
   pure real(wp) function hourglass_energy(bricks, batch, large, displacement, &
      & history) result(energy)
      !> The bricks of a part, with one point
      type(bricks_type), intent(in) :: bricks
      !> The batch; large displacement
      integer, intent(in) :: batch
      logical, intent(in) :: large
      !> Displacement of all points, history of the part
      real(wp), intent(in) :: displacement(*)
      real(wp), intent(in) :: history(lanes, bricks%histories, bricks%points, *)

      real(wp), dimension(lanes, 3, hourglass_modes) :: amplitude, mode_force
      real(wp) :: flux(lanes, 3, 3), gradient(lanes, 3, 3), motion(lanes, corners, 3)

      if (bricks%viscosity > 0.0_wp) then
         energy = sum(history(:, bricks%histories, 1, batch))
         return
      end if
      associate (shape => bricks%shapes(bricks%shape(batch)))
         call gather(bricks%place(:, :, batch), displacement, motion)
         call gradient_of(motion, shape%gradient(:, :, :, 1), gradient)
         call mode_amplitudes(motion, gradient, shape%bent, amplitude)
         flux(:, :, :) = 0.0_wp
         call add_stiffness_forces(shape%mode_stiffness, shape%axis, gradient, large, amplitude, &
            & mode_force, flux)
         energy = sum(0.5_wp*sum(sum(mode_force*amplitude, 3), 2))
      end associate
   end function hourglass_energy

end module plydyn_element_brick_kernel
