!> Strain and stress of bricks: the mean over the points of a brick.
module plydyn_element_brick_recover
   use plydyn_base_precision, only : lanes, wp
   use plydyn_element_brick_bricks, only : bricks_type, corners
   use plydyn_element_brick_kernel, only : gather, mean_volume_strain
   use plydyn_element_brick_point, only : elastic_stress, gradient_of, strain_of, to_flux, &
      & rotate_strain, rotate_stress
   use plydyn_element_recovered, only : ply_strain_at, ply_stress_at, recovered, scalars_at, &
      & strain_at, stress_at
   use plydyn_element_plate_layers, only : c33
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
            call strain_of(gradient(:, :, :, m), merge(1.0_wp, 0.0_wp, large), strain(:, :, m))
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
      call rotate_strain(bricks%cosine_sine, turned)
      values(:, strain_at + 1:stress_at) = strain
      values(:, ply_strain_at + 1:ply_stress_at) = turned
      call elastic_stress(bricks%stiffness, strain, stress)
      do k = 1, size(bricks%laws)
         associate (law => bricks%laws(k)%law)
            stress(:, :) = 0.0_wp
            call law%stress_at(turned, history, stress)
            call rotate_stress(bricks%cosine_sine, stress)
            do l = 1, lanes
               values(l, scalars_at + 1:) = law%output_variables(l, history)
            end do
         end associate
      end do
      turned(:, :) = stress
      ! the rotation of strain with half the shear is that of stress
      turned(:, 4:) = 2.0_wp*turned(:, 4:)
      call rotate_strain(bricks%cosine_sine, turned)
      turned(:, 4:) = 0.5_wp*turned(:, 4:)
      values(:, ply_stress_at + 1:scalars_at) = turned
      if (large) call to_cauchy(bricks%stiffness(c33), gradient, stress)
      values(:, stress_at + 1:ply_strain_at) = stress
   end subroutine point_values

   !> Second Piola-Kirchhoff to Cauchy stress, in place: F S F^T / det F, with that
   !> of the barrier against compression
   pure subroutine to_cauchy(modulus, gradient, stress)
      real(wp), intent(in) :: modulus, gradient(lanes, 3, 3)
      real(wp), intent(inout) :: stress(lanes, 6)

      integer, parameter :: first(6) = [1, 2, 3, 1, 1, 2], second(6) = [1, 2, 3, 2, 3, 3]
      real(wp) :: deformation(3, 3), flux(lanes, 3, 3), unit(lanes), ratio
      integer :: i, l

      unit(:) = 1.0_wp
      call to_flux(gradient, 1.0_wp, unit, stress, flux)
      do l = 1, lanes
         deformation(:, :) = gradient(l, :, :)
         do i = 1, 3
            deformation(i, i) = deformation(i, i) + 1.0_wp
         end do
         ratio = deformation(1, 1)*(deformation(2, 2)*deformation(3, 3) &
            & - deformation(3, 2)*deformation(2, 3)) - deformation(2, &
            & 1)*(deformation(1, 2)*deformation(3, 3) - deformation(3, 2)*deformation(1, 3)) &
            & + deformation(3, 1)*(deformation(1, 2)*deformation(2, 3) &
            & - deformation(2, 2)*deformation(1, 3))
         do i = 1, 6
            stress(l, i) = dot_product(flux(l, first(i), :), deformation(second(i), :))/ratio
         end do
         stress(l, :3) = stress(l, :3) + barrier_stress(modulus, ratio)
      end do
   end subroutine to_cauchy

end module plydyn_element_brick_recover
