!> Metals that harden along a line, one a lane, and their way under strain; and how exactly any
!> law of metals finds its way back to the yield surface.
module metals
   use plydyn_base_precision, only : lanes, wp
   use plydyn_law_metal_plastic, only : dissipated, plastic_type
   use plydyn_law_metal_kinematic, only : kinematic_constants_type, plastic_kinematic_type
   implicit none
   private

   public :: farthest_from_yield, linear_metal, load, set_lanes, step_to, stored_energy

   !> Steel and aluminium: Young's modulus, yield stress (MPa); the same Poisson's ratio
   real(wp), parameter, public :: young(2) = [210.0e3_wp, 70.0e3_wp], &
      & yield(2) = [210.0_wp, 110.0_wp]
   real(wp), parameter, public :: poisson = 0.3_wp, shear = young(1)/2.6_wp
   !> Hardening modulus of the hardening steels
   real(wp), parameter, public :: modulus = 1.0e3_wp, &
      & tangent = young(1)*modulus/(young(1) + modulus)
   !> Lanes: steel and aluminium perfect; steel isotropic, kinematic, perfect, and up to mixed
   integer, parameter, public :: steel = 1, aluminium = 2, isotropic = 3, mixed = 6
   real(wp), parameter, public :: beta(lanes) = &
      & [1.0_wp, 1.0_wp, 1.0_wp, 0.0_wp, 0.0_wp, 0.3_wp, 0.0_wp, 0.0_wp]
   real(wp), parameter, public :: hard(lanes) = [0.0_wp, 0.0_wp, 1.0_wp, 1.0_wp, 0.0_wp, 1.0_wp, &
      & 1.0_wp, 1.0_wp]

   !> Strain of one component each
   real(wp), parameter, public :: stretch(6) = [1.0_wp, 0.0_wp, 0.0_wp, 0.0_wp, 0.0_wp, 0.0_wp]
   real(wp), parameter, public :: slide(6) = [0.0_wp, 0.0_wp, 0.0_wp, 1.0_wp, 0.0_wp, 0.0_wp]

contains

   !> The materials of the batch; lanes 7 and 8 belong to other laws
   subroutine set_lanes(law)
      !> The law
      type(plastic_kinematic_type), intent(out) :: law

      integer :: l, metal
      type(kinematic_constants_type) :: constants

      do l = 1, lanes - 2
         metal = merge(2, 1, l == aluminium)
         constants = linear_metal(young(metal), poisson, yield(metal), hard(l)*tangent, beta(l))
         call constants%set_lane(l, law)
      end do
   end subroutine set_lanes

   !> A metal with linear hardening
   pure function linear_metal(young, poisson, yield, tangent, isotropic) result(metal)
      !> As in `kinematic_constants_type`
      real(wp), intent(in) :: young, poisson, yield, tangent, isotropic
      type(kinematic_constants_type) :: metal

      metal%young(:) = young
      metal%poisson(:) = poisson
      metal%yield = yield
      metal%tangent = tangent
      metal%isotropic = isotropic
   end function linear_metal

   !> Energy per volume that unloading gives back: elastic, and stored by the back stress
   pure function stored_energy(law, strain, history) result(energy)
      !> The law
      class(plastic_type), intent(in) :: law
      !> Total strain, and history that belongs to it
      real(wp), intent(in) :: strain(lanes, 6), history(lanes, dissipated)
      real(wp) :: energy(lanes)

      real(wp) :: elastic(6), mean, plastic(6)
      integer :: l

      do l = 1, lanes
         plastic(:) = history(l, :6)
         elastic(:) = strain(l, :) - plastic
         mean = sum(elastic(:3))/3.0_wp
         elastic(:3) = elastic(:3) - mean
         energy(l) = 4.5_wp*law%bulk(l)*mean**2 + law%shear(l)*square(elastic) &
            & + law%kinematic(l)*square(plastic)/3.0_wp
      end do
   end function stored_energy

   !> A strain, as a tensor, times itself
   pure real(wp) function square(strain)
      real(wp), intent(in) :: strain(6)

      square = sum(strain(:3)**2) + 0.5_wp*sum(strain(4:)**2)
   end function square

   !> Stress after one more step to the same strain in all lanes
   subroutine step_to(law, strain, history, stress)
      !> The law
      type(plastic_kinematic_type), intent(in) :: law
      !> Total strain
      real(wp), intent(in) :: strain(6)
      !> History and stress, from step to step
      real(wp), intent(inout) :: history(lanes, dissipated)
      real(wp), intent(inout) :: stress(lanes, 6)

      real(wp) :: batch(lanes, 6)

      batch(:, :) = spread(strain, 1, lanes)
      call law%update(0.0_wp, batch, history, stress)
   end subroutine step_to

   !> Stress and history after a straight path from rest, in equal steps
   subroutine load(law, strain, steps, history, stress)
      !> The law
      type(plastic_kinematic_type), intent(in) :: law
      !> Strain at the end
      real(wp), intent(in) :: strain(6)
      !> Steps
      integer, intent(in) :: steps
      !> History and stress at the end
      real(wp), intent(out) :: history(lanes, dissipated), stress(lanes, 6)

      integer :: i

      history(:, :) = 0.0_wp
      stress(:, :) = 0.0_wp
      do i = 1, steps
         call step_to(law, strain*i/steps, history, stress)
      end do
   end subroutine load

   !> Farthest that stress stays from the yield surface of the end of a step, as a share of the
   !> stress before flow, in steps and under loads over many decades; huge where nothing flows
   function farthest_from_yield(law, fall) result(worst)
      !> The law
      class(plastic_type), intent(in) :: law
      !> What a unit of plastic strain takes from the stress: 3 G and the kinematic hardening
      real(wp), intent(in) :: fall
      real(wp) :: worst

      real(wp) :: before(lanes), effective(lanes), hardening(lanes), increment(lanes)
      real(wp) :: left(lanes), mean(lanes), step, viscosity(lanes), yields(lanes)
      integer :: j, k

      worst = 0.0_wp
      do j = -9, 0, 3
         step = 10.0_wp**j
         do k = -9, 2
            before(:) = 0.1_wp*modulo(k, 3)
            call law%yield_stress(before, 0.0_wp*before, yields, hardening, viscosity)
            effective(:) = yields*(1.0_wp + 10.0_wp**k)
            call law%search(step, effective, before, increment, mean)
            call law%yield_stress(before + increment, increment/step, yields, hardening, viscosity)
            left(:) = effective - fall*increment - yields
            worst = max(worst, maxval(abs(left)/effective))
            if (any(increment <= 0.0_wp)) worst = huge(worst)
         end do
      end do
   end function farthest_from_yield

end module metals
