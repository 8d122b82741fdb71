!> Barrier against material that is turned inside out by large displacement.
!>
!> The law of Saint Venant and Kirchhoff loses its stiffness at a stretch of 0.58 and carries none
!> at 0: layers below an impactor fold. Below a ratio of volumes J0 = 0.8 the energy per volume
!> M b(J) is added, with -b'(J) = (J0 - J)**2/J. It is smooth, nothing above J0, and unbounded as J
!> goes to 0 (as the volumetric terms of compressible neo-Hookean solids: Bonet and Wood, 2008,
!> section 6.4). M is the stiffness C33 of the intact material: crushed material still fills space.
!> In uniaxial strain the slope of stress over stretch is 0.46 C33 at J0, and larger below it.
module plydyn_law_compression_barrier
   use plydyn_base_matrix, only : cross
   use plydyn_base_precision, only : lanes, wp
   use plydyn_fem_kinematics, only : volume_ratios
   implicit none
   private

   public :: add_barrier_stress, barrier_energy, barrier_stiffness, barrier_stress

   !> Ratio of volumes below which the barrier acts
   real(wp), parameter, public :: barrier_ratio = 0.8_wp
   !> Ratio below which the denominator falls no more, for points that a step has turned inside out
   real(wp), parameter :: least_ratio = 0.01_wp

contains

   !> Cauchy stress of the barrier on each direction: M b'(J), not above 0
   elemental real(wp) function barrier_stress(modulus, ratio) result(stress)
      !> C33 of the intact material; ratio of volumes
      real(wp), intent(in) :: modulus, ratio

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
      !> C33 of the intact material, times a weight
      real(wp), intent(in) :: modulus(lanes)
      !> Displacement gradient, (lanes, component, direction)
      real(wp), intent(in) :: h(lanes, 3, 3)
      !> First Piola-Kirchhoff stress times the weight, (lanes, component, direction)
      real(wp), intent(inout) :: stress(lanes, 3, 3)

      real(wp) :: f(3, 3), pressure, ratio(lanes)
      integer :: i, l

      ratio(:) = volume_ratios(h)
      if (minval(ratio) >= barrier_ratio) return
      do l = 1, lanes
         if (ratio(l) >= barrier_ratio) cycle
         pressure = barrier_stress(modulus(l), ratio(l))
         f(:, :) = h(l, :, :)
         do i = 1, 3
            f(i, i) = 1.0_wp + f(i, i)
         end do
         do i = 1, 3
            stress(l, :, i) = stress(l, :, i) &
               & + pressure*cross(f(:, 1 + mod(i, 3)), f(:, 1 + mod(i + 1, 3)))
         end do
      end do
   end subroutine add_barrier_stress

end module plydyn_law_compression_barrier
