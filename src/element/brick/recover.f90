!> Strain and stress of bricks: the mean over the points of a brick.
module plydyn_element_brick_recover
   use plydyn_base_precision, only : lanes, wp
   use plydyn_element_brick_bricks, only : bricks_type, corners
   use plydyn_element_brick_kernel, only : gather, mean_volume_strain
   use plydyn_element_brick_point, only : elastic_stress, gradient_of
   use plydyn_element_recovered, only : ply_strain_at, ply_stress_at, recovered, scalars_at, &
      & strain_at, stress_at
   use plydyn_element_plate_layers, only : c33
   use plydyn_fem_kinematics, only : find_cauchy, find_strain, turn_strain, turn_stress, &
      & turn_stress_back, volume_ratios
   use plydyn_law_compression_barrier, only : barrier_stress
   implicit none
   private

   public :: brick_values

contains

   !> Values of the bricks of a batch, (lanes, `recovered`). With large displacement strain is
   !> Green-Lagrange; stress is Cauchy in the axes of the model and second Piola-Kirchhoff in those
   !> of the ply
   pure function brick_values(bricks, batch, large, displacement, history) result(mean)
      !> The bricks of a part
      type(bricks_type), intent(in) :: bricks
      !> The batch
      integer, intent(in) :: batch
      !> Large displacement
      logical, intent(in) :: large
      !> Displacement of all points
      real(wp), intent(in) :: displacement(*)
      !> History of the part
      real(wp), intent(in) :: history(lanes, bricks%histories, bricks%points, *)
      real(wp) :: mean(lanes, recovered)

      real(wp) :: strain(lanes, 6, bricks%points), gradient(lanes, 3, 3, bricks%points)
      real(wp) :: motion(lanes, corners, 3), values(lanes, recovered), whole(lanes)
      integer :: i, m

      mean(:, :) = 0.0_wp
      whole(:) = tiny(1.0_wp)
      call gather(bricks%place(:, :, batch), displacement, motion)
      associate (shape => bricks%shapes(bricks%shape(batch)))
         do m = 1, bricks%points
            call gradient_of(motion, shape%gradient(:, :, :, m), gradient(:, :, :, m))
            call find_strain(gradient(:, :, :, m), large, strain(:, :, m))
         end do
         if (bricks%shares_volume) call mean_volume_strain(shape%volume, strain)
         do m = 1, bricks%points
            call point_values(bricks, large, gradient(:, :, :, m), strain(:, :, m), &
               & history(:, :, m, batch), values)
            do i = 1, recovered
               mean(:, i) = mean(:, i) + shape%volume(:, m)*values(:, i)
            end do
            whole(:) = whole + shape%volume(:, m)
         end do
      end associate
      do i = 1, recovered
         mean(:, i) = mean(:, i)/whole
      end do
   end function brick_values

   !> Values at one point
   pure subroutine point_values(bricks, large, gradient, strain, history, values)
      type(bricks_type), intent(in) :: bricks
      logical, intent(in) :: large
      real(wp), intent(in) :: gradient(lanes, 3, 3), strain(lanes, 6), &
         & history(lanes, bricks%histories)
      real(wp), intent(out) :: values(lanes, recovered)

      real(wp) :: stress(lanes, 6), turned(lanes, 6)
      integer :: k, l

      values(:, :) = 0.0_wp
      turned(:, :) = strain
      call turn_strain(bricks%rotation, turned)
      values(:, strain_at + 1:stress_at) = strain
      values(:, ply_strain_at + 1:ply_stress_at) = turned
      call elastic_stress(bricks%stiffness, strain, stress)
      do k = 1, size(bricks%laws)
         associate (law => bricks%laws(k)%law)
            stress(:, :) = 0.0_wp
            call law%stress_at(turned, history, stress)
            call turn_stress_back(bricks%rotation, stress)
            do l = 1, lanes
               values(l, scalars_at + 1:) = law%output_variables(l, history)
            end do
         end associate
      end do
      turned(:, :) = stress
      call turn_stress(bricks%rotation, turned)
      values(:, ply_stress_at + 1:scalars_at) = turned
      if (large) then
         call find_cauchy(gradient, stress)
         stress(:, :3) = stress(:, :3) + spread(barrier_stress(bricks%stiffness(c33), &
            & volume_ratios(gradient)), 2, 3)
      end if
      values(:, stress_at + 1:ply_strain_at) = stress
   end subroutine point_values

end module plydyn_element_brick_recover
