!> Barrier against material that is turned inside out by large displacement.
!>
!> The law of Saint Venant and Kirchhoff loses its stiffness at a stretch of 0.58 and carries none
!> at 0: layers below an impactor fold. Below a ratio of volumes J0 = 0.8 the energy per volume
!> M b(J) is added, with -b'(J) = (J0 - J)**2/J. It is smooth, nothing above J0, and unbounded as J
!> goes to 0 (as the volumetric terms of compressible neo-Hookean solids: Bonet and Wood, 2008,
!> section 6.4). M is the stiffness C33 of the intact material: crushed material still fills space.
!> In uniaxial strain the slope of stress over stretch is 0.46 C33 at J0, and larger below it.
module plydyn_law_compression_barrier
   use plydyn_base_precision, only : lanes, wp
   implicit none
   private

   public :: add_barrier_stress, barrier_energy, barrier_stiffness, barrier_stress, volume_ratio, &
      & volume_ratios

   !> Ratio of volumes below which the barrier acts
   real(wp), parameter, public :: barrier_ratio = 0.8_wp
   !> Ratio below which the denominator falls no more, for points that a step has turned inside out
   real(wp), parameter :: least_ratio = 0.01_wp

contains

   !> Ratio of volumes, det(I + H)
   pure real(wp) function volume_ratio(h) result(ratio)
      !> Displacement gradient, (component, direction)
      real(wp), intent(in) :: h(3, 3)

      ratio = (1.0_wp + h(1, 1))*((1.0_wp + h(2, 2))*(1.0_wp + h(3, 3)) - h(2, 3)*h(3, 2)) &
         & - h(1, 2)*(h(2, 1)*(1.0_wp + h(3, 3)) - h(2, 3)*h(3, 1)) &
         & + h(1, 3)*(h(2, 1)*h(3, 2) - (1.0_wp + h(2, 2))*h(3, 1))
   end function volume_ratio

   !> The same of each lane
   pure function volume_ratios(h) result(ratio)
      !> Displacement gradients, (lanes, component, direction)
      real(wp), intent(in) :: h(lanes, 3, 3)
      real(wp) :: ratio(lanes)

      ratio(:) = (1.0_wp + h(:, 1, 1)) &
         & *((1.0_wp + h(:, 2, 2))*(1.0_wp + h(:, 3, 3)) - h(:, 2, 3)*h(:, 3, 2)) &
         & - h(:, 1, 2)*(h(:, 2, 1)*(1.0_wp + h(:, 3, 3)) - h(:, 2, 3)*h(:, 3, 1)) &
         & + h(:, 1, 3)*(h(:, 2, 1)*h(:, 3, 2) - (1.0_wp + h(:, 2, 2))*h(:, 3, 1))
   end function volume_ratios

   !> Cauchy stress of the barrier on each direction: M b'(J), not above 0
   elemental real(wp) function barrier_stress(modulus, ratio) result(stress)
      !> C33 of the intact material
      real(wp), intent(in) :: modulus
      !> Ratio of volumes
      real(wp), intent(in) :: ratio

      stress = -modulus*max(barrier_ratio - ratio, 0.0_wp)**2/max(ratio, least_ratio)
   end function barrier_stress

   !> Energy of the barrier per volume of the undeformed material over its modulus: b(J), the
   !> integral of -b' from J to J0
   elemental real(wp) function barrier_energy(ratio) result(energy)
      !> Ratio of volumes
      real(wp), intent(in) :: ratio

      real(wp) :: beyond, least

      energy = 0.0_wp
      if (ratio >= barrier_ratio) return
      least = max(ratio, least_ratio)
      ! and on, where the denominator falls no more
      beyond = max(least_ratio - ratio, 0.0_wp)
      energy = barrier_ratio**2*log(barrier_ratio/least) - 2.0_wp*barrier_ratio &
         & *(barrier_ratio - least) + 0.5_wp*(barrier_ratio**2 - least**2) &
         & + beyond*((barrier_ratio - least)*(barrier_ratio - least + beyond) &
         & + beyond**2/3.0_wp)/least_ratio
   end function barrier_energy

   !> Stiffness of the barrier as a share of its modulus: b''(J)
   elemental real(wp) function barrier_stiffness(ratio) result(stiffness)
      !> Ratio of volumes
      real(wp), intent(in) :: ratio

      stiffness = max((barrier_ratio/max(ratio, least_ratio))**2 - 1.0_wp, 0.0_wp)
   end function barrier_stiffness

   !> Add the first Piola-Kirchhoff stress of the barrier, M b'(J) cof F
   pure subroutine add_barrier_stress(modulus, h, stress)
      !> C33 of the intact material
      real(wp), intent(in) :: modulus
      !> Displacement gradient, (component, direction)
      real(wp), intent(in) :: h(3, 3)
      !> First Piola-Kirchhoff stress, (component, direction)
      real(wp), intent(inout) :: stress(3, 3)

      real(wp) :: f(3, 3), pressure
      integer :: i

      pressure = barrier_stress(modulus, volume_ratio(h))
      f(:, :) = h
      do i = 1, 3
         f(i, i) = 1.0_wp + f(i, i)
      end do
      do i = 1, 3
         stress(:, i) = stress(:, i) &
            & + pressure*cross_product(f(:, 1 + mod(i, 3)), f(:, 1 + mod(i + 1, 3)))
      end do
   end subroutine add_barrier_stress

   !> Cross product of two vectors
   pure function cross_product(a, b) result(c)
      real(wp), intent(in) :: a(3), b(3)
      real(wp) :: c(3)

      c(:) = [a(2)*b(3) - a(3)*b(2), a(3)*b(1) - a(1)*b(3), a(1)*b(2) - a(2)*b(1)]
   end function cross_product

end module plydyn_law_compression_barrier
