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

      real(wp) :: e(lanes, 6, bricks%points), h(lanes, 3, 3, bricks%points)
      real(wp) :: u(lanes, corners, 3), values(lanes, recovered), whole(lanes)
      integer :: i, m

      mean(:, :) = 0.0_wp
      whole(:) = tiny(1.0_wp)
      call gather(bricks%place(:, :, batch), displacement, u)
      associate (shape => bricks%shapes(bricks%shape(batch)))
         do m = 1, bricks%points
            call gradient_of(u, shape%gradient(:, :, :, m), h(:, :, :, m))
            call strain_of(h(:, :, :, m), merge(1.0_wp, 0.0_wp, large), e(:, :, m))
         end do
         if (bricks%shares_volume) call mean_volume_strain(shape%volume, e)
         do m = 1, bricks%points
            call point_values(bricks, large, h(:, :, :, m), e(:, :, m), history(:, :, m, batch), &
               & values)
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
   pure subroutine point_values(bricks, large, h, e, history, values)
      type(bricks_type), intent(in) :: bricks
      logical, intent(in) :: large
      real(wp), intent(in) :: h(lanes, 3, 3), e(lanes, 6), history(lanes, bricks%histories)
      real(wp), intent(out) :: values(lanes, recovered)

      real(wp) :: s(lanes, 6), turned(lanes, 6)
      integer :: k, l

      values(:, :) = 0.0_wp
      turned(:, :) = e
      call rotate_strain(bricks%cosine_sine, turned)
      values(:, strain_at + 1:stress_at) = e
      values(:, ply_strain_at + 1:ply_stress_at) = turned
      call elastic_stress(bricks%stiffness, e, s)
      do k = 1, size(bricks%laws)
         associate (law => bricks%laws(k)%law)
            s(:, :) = 0.0_wp
            call law%stress_at(turned, history, s)
            call rotate_stress(bricks%cosine_sine, s)
            do l = 1, lanes
               values(l, scalars_at + 1:) = law%output_variables(l, history)
            end do
         end associate
      end do
      turned(:, :) = s
      ! the rotation of strain with half the shear is that of stress
      turned(:, 4:) = 2.0_wp*turned(:, 4:)
      call rotate_strain(bricks%cosine_sine, turned)
      turned(:, 4:) = 0.5_wp*turned(:, 4:)
      values(:, ply_stress_at + 1:scalars_at) = turned
      if (large) call to_cauchy(bricks%stiffness(c33), h, s)
      values(:, stress_at + 1:ply_strain_at) = s
   end subroutine point_values

   !> Second Piola-Kirchhoff to Cauchy stress, in place: F S F^T / det F, with that
   !> of the barrier against compression
   pure subroutine to_cauchy(modulus, h, s)
      real(wp), intent(in) :: modulus, h(lanes, 3, 3)
      real(wp), intent(inout) :: s(lanes, 6)

      integer, parameter :: first(6) = [1, 2, 3, 1, 1, 2], second(6) = [1, 2, 3, 2, 3, 3]
      real(wp) :: f(3, 3), p(lanes, 3, 3), unit(lanes), ratio
      integer :: i, l

      unit(:) = 1.0_wp
      call to_flux(h, 1.0_wp, unit, s, p)
      do l = 1, lanes
         f(:, :) = h(l, :, :)
         do i = 1, 3
            f(i, i) = f(i, i) + 1.0_wp
         end do
         ratio = f(1, 1)*(f(2, 2)*f(3, 3) - f(3, 2)*f(2, 3)) &
            & - f(2, 1)*(f(1, 2)*f(3, 3) - f(3, 2)*f(1, 3)) &
            & + f(3, 1)*(f(1, 2)*f(2, 3) - f(2, 2)*f(1, 3))
         do i = 1, 6
            s(l, i) = dot_product(p(l, first(i), :), f(second(i), :))/ratio
         end do
         s(l, :3) = s(l, :3) + barrier_stress(modulus, ratio)
      end do
   end subroutine to_cauchy

end module plydyn_element_brick_recover
