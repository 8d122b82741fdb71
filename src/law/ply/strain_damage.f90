!> Damage of a ply by strains at which it begins and ends: the law of LS-DYNA's *MAT_CODAM2 for one
!> ply.
!>
!> Each of three mechanisms has a damage that grows with an equivalent strain from 0 at onset to 1
!> at saturation, so that the stress of a straight path falls along a line. Damage of fibres reduces
!> E1, damage of the matrix E2 and G12, and locking all of them. None reduces the stiffness across
!> the thickness.
module plydyn_law_ply_strain_damage
   use plydyn_base_precision, only : lanes, wp
   use plydyn_law_ply_constants, only : in_compression, in_tension
   use plydyn_law_ply_damage_growth, only : min_path_ratio
   use plydyn_law_ply_damage_onset, only : compression_tolerance
   use plydyn_law_law, only : by_fibre_damage, by_matrix_damage, law_constants_type, law_type, &
      & scalars, shows_dissipated, shows_fibre_damage, shows_matrix_damage, shows_shear_damage
   use plydyn_law_ply_crack_band, only : rule_band
   use plydyn_law_ply_secant, only : secant_type
   implicit none
   private

   !> Mechanisms, and the history variables of their damage
   integer, parameter, public :: by_fibres = 1, by_matrix = 2, by_locking = 3
   integer, parameter, public :: strain_mechanisms = 3
   !> History variables of the energies dissipated per volume along and across the fibres; the last
   !> is that of both
   integer, parameter, public :: along_energy = 4, across_energy = 5
   integer, parameter :: histories = 6
   !> Strains that are averaged, 11, 22 and 12, and those that each mechanism feels
   integer, parameter :: driving_strains = 3
   logical, parameter :: driving_members(driving_strains, strain_mechanisms) = reshape([.true., &
      & .false., .false., .false., .true., .true., .true., .true., .true.], &
      & [driving_strains, strain_mechanisms])

   !> Least integrity
   real(wp), parameter, public :: strain_residual = 1.0e-6_wp

   !> Constants of a ply, besides the elastic ones
   type, public, extends(law_constants_type) :: strain_constants_type
      !> Equivalent strains at which each mechanism begins and is complete, in tension and in
      !> compression
      real(wp) :: onset(strain_mechanisms, 2) = 0.0_wp, finish(strain_mechanisms, 2) = 0.0_wp
   contains
      procedure :: new_batch
      procedure :: set_lane
      procedure :: shows
   end type strain_constants_type

   !> A law with the constants of the lanes
   type, public, extends(law_type) :: strain_damage_type
      private
      !> Stiffness
      type(secant_type) :: secant
      !> Strains at which each mechanism begins and is complete, (lanes, mechanisms, senses)
      real(wp) :: onset(lanes, strain_mechanisms, 2) = 1.0_wp
      real(wp) :: finish(lanes, strain_mechanisms, 2) = 2.0_wp
   contains
      procedure :: update
      procedure :: output_variables
   end type strain_damage_type

contains

   !> A law without lanes
   subroutine new_batch(self, law)
      class(strain_constants_type), intent(in) :: self
      class(law_type), allocatable, intent(out) :: law

      allocate (strain_damage_type :: law)
   end subroutine new_batch

   !> Give a lane of a batch its ply; widths of crack bands are for the listing only
   pure subroutine set_lane(self, lane, law)
      class(strain_constants_type), intent(in) :: self
      integer, intent(in) :: lane
      class(law_type), intent(inout) :: law

      select type (law)
      type is (strain_damage_type)
         law%owns(lane) = .true.
         call law%secant%set_lane(lane, self%young, self%poisson, self%shear)
         law%onset(lane, :, :) = self%onset
         law%finish(lane, :, :) = self%finish
         law%histories = histories
         law%energy_variable(by_fibre_damage) = along_energy
         law%energy_variable(by_matrix_damage) = across_energy
         law%band_rule(lane) = rule_band
         if (self%averages()) call law%set_average(lane, self%radius, driving_strains)
      end select
   end subroutine set_lane

   !> Scalars that the law has for the fields
   pure function shows(self)
      class(strain_constants_type), intent(in) :: self
      logical :: shows(scalars)

      shows(:) = .false.
      shows([shows_fibre_damage, shows_matrix_damage, shows_shear_damage, shows_dissipated]) &
         & = .true.
   end function shows

   !> What is lost along the fibres, across them and in shear, and the energy
   pure function output_variables(self, lane, history) result(values)
      class(strain_damage_type), intent(in) :: self
      integer, intent(in) :: lane
      real(wp), intent(in) :: history(lanes, *)
      real(wp) :: values(scalars)

      real(wp) :: integrity(strain_mechanisms)

      integrity(:) = 1.0_wp - history(lane, :strain_mechanisms)
      values(:) = 0.0_wp
      values(shows_fibre_damage) = 1.0_wp - integrity(by_fibres)*integrity(by_locking)
      values(shows_matrix_damage) = 1.0_wp - integrity(by_matrix)*integrity(by_locking)
      values(shows_shear_damage) = values(shows_matrix_damage)
      values(shows_dissipated) = history(lane, histories)
   end function output_variables

   !> Stress and history after a step
   pure subroutine update(self, step, strain, history, stress)
      class(strain_damage_type), intent(in) :: self
      real(wp), intent(in) :: step, strain(lanes, 6)
      real(wp), intent(inout) :: history(lanes, *), stress(lanes, 6)

      real(wp) :: after(lanes, strain_mechanisms), before(lanes, strain_mechanisms)
      real(wp) :: integrity(lanes, 2), share(lanes, strain_mechanisms), normal(lanes, 3, 2)
      real(wp) :: drive(lanes, driving_strains), mean(lanes, driving_strains)
      real(wp) :: mean_share(lanes, strain_mechanisms)

      before(:, :) = max(1.0_wp - history(:, :strain_mechanisms), strain_residual)
      drive(:, 1:2) = strain(:, 1:2)
      drive(:, 3) = strain(:, 4)
      if (self%driving > 0) then
         call self%exchange_strains(driving_members, drive, history, mean, mean_share)
         call grow(self, mean, history, share)
         share(:, :) = mean_share
      else
         call grow(self, drive, history, share)
      end if
      after(:, :) = max(1.0_wp - history(:, :strain_mechanisms), strain_residual)
      integrity(:, 1) = before(:, by_fibres)*before(:, by_locking)
      integrity(:, 2) = before(:, by_matrix)*before(:, by_locking)
      call self%secant%damaged_stress(strain, integrity, normal(:, :, 1))
      integrity(:, 1) = after(:, by_fibres)*after(:, by_locking)
      integrity(:, 2) = after(:, by_matrix)*after(:, by_locking)
      call self%secant%damaged_stress(strain, integrity, normal(:, :, 2))
      call add_energies(self, strain(:, 4), normal, before, after, share, history)
      call give_stress(self, strain, normal(:, :, 2), integrity, stress)
   end subroutine update

   !> Let damage grow with the strain that drives it; it never heals
   pure subroutine grow(self, strain, history, share)
      type(strain_damage_type), intent(in) :: self
      !> Strains 11, 22 and 12
      real(wp), intent(in) :: strain(lanes, driving_strains)
      real(wp), intent(inout) :: history(lanes, *)
      !> Mean of the driving force over its value at the end, when all strains grow in proportion; 1
      !> where the step did not lead from the strain at which the damage was reached
      real(wp), intent(out) :: share(lanes, strain_mechanisms)

      real(wp) :: damage, finish, from, last, now, onset, sense(lanes, strain_mechanisms)
      real(wp) :: size(lanes, strain_mechanisms)
      integer :: k, l

      call find_strains(strain, size, sense)
      associate (t => in_tension, c => in_compression)
         do k = 1, strain_mechanisms
            !$omp simd private(damage, finish, from, last, now, onset)
            do l = 1, lanes
               onset = merge(self%onset(l, k, t), self%onset(l, k, c), sense(l, k) >= 0.0_wp)
               finish = merge(self%finish(l, k, t), self%finish(l, k, c), sense(l, k) >= 0.0_wp)
               damage = history(l, k)
               now = max(size(l, k), onset)
               last = min(now, finish)
               ! strain at which the old damage was reached
               from = finish*onset/(finish - damage*(finish - onset))
               share(l, k) = min(from*last/now**2, 1.0_wp)
               share(l, k) = merge(share(l, k), 1.0_wp, from >= min_path_ratio*now)
               damage = max(damage, finish*(last - onset)/(last*(finish - onset)))
               history(l, k) = merge(damage, history(l, k), self%owns(l))
            end do
         end do
      end associate
   end subroutine grow

   !> Sizes of the equivalent strains, and what their signs are those of: strain along the fibres;
   !> strain and half the shear across them; the larger principal strain in the plane
   pure subroutine find_strains(strain, size, sense)
      real(wp), intent(in) :: strain(lanes, driving_strains)
      real(wp), intent(out) :: size(lanes, strain_mechanisms), sense(lanes, strain_mechanisms)

      real(wp) :: half, mean, radius
      integer :: l

      !$omp simd private(half, mean, radius)
      do l = 1, lanes
         half = 0.5_wp*strain(l, 3)
         mean = 0.5_wp*(strain(l, 1) + strain(l, 2))
         radius = sqrt((0.5_wp*(strain(l, 1) - strain(l, 2)))**2 + half**2)
         size(l, by_fibres) = abs(strain(l, 1))
         size(l, by_matrix) = sqrt(strain(l, 2)**2 + half**2)
         size(l, by_locking) = abs(mean) + radius
         sense(l, by_fibres) = strain(l, 1)
         sense(l, by_matrix) = strain(l, 2) + compression_tolerance*abs(half)
         sense(l, by_locking) = mean + compression_tolerance*radius
      end do
   end subroutine find_strains

   !> Energy that the loss of stiffness sets free: of E1, and of E2 and G12
   pure subroutine add_energies(self, shear, normal, before, after, share, history)
      type(strain_damage_type), intent(in) :: self
      !> Shear strain 12; effective normal stresses before and after the step
      real(wp), intent(in) :: shear(lanes), normal(lanes, 3, 2)
      !> Integrity before and after the step, by mechanism
      real(wp), intent(in) :: before(lanes, strain_mechanisms), after(lanes, strain_mechanisms)
      real(wp), intent(in) :: share(lanes, strain_mechanisms)
      real(wp), intent(inout) :: history(lanes, *)

      real(wp) :: force(2), lost(2), mean(strain_mechanisms), own, loss(strain_mechanisms)
      integer :: l

      !$omp simd private(force, lost, mean, own, loss)
      do l = 1, lanes
         loss(:) = share(l, :)*(before(l, :) - after(l, :))
         mean(:) = 0.5_wp*(before(l, :) + after(l, :))
         lost(:) = loss(:by_matrix)*mean(by_locking) + mean(:by_matrix)*loss(by_locking)
         force(1) = 0.5_wp*self%secant%compliance(l, 1)*normal(l, 1, 1)*normal(l, 1, 2)
         force(2) = 0.5_wp*(self%secant%compliance(l, 2)*normal(l, 2, 1)*normal(l, 2, 2) &
            & + self%secant%shear(l, 1)*shear(l)**2)
         own = merge(1.0_wp, 0.0_wp, self%owns(l))
         history(l, along_energy) = history(l, along_energy) + own*lost(1)*force(1)
         history(l, across_energy) = history(l, across_energy) + own*lost(2)*force(2)
         history(l, histories) = history(l, histories) &
            & + own*(lost(1)*force(1) + lost(2)*force(2))
      end do
   end subroutine add_energies

   !> Stress of the lanes that the law owns
   pure subroutine give_stress(self, strain, normal, integrity, stress)
      type(strain_damage_type), intent(in) :: self
      real(wp), intent(in) :: strain(lanes, 6), normal(lanes, 3)
      !> R1 and R2
      real(wp), intent(in) :: integrity(lanes, 2)
      real(wp), intent(inout) :: stress(lanes, 6)

      real(wp) :: new(6)
      integer :: k, l

      !$omp simd private(k, new)
      do l = 1, lanes
         new(1) = integrity(l, 1)*normal(l, 1)
         new(2) = integrity(l, 2)*normal(l, 2)
         new(3) = normal(l, 3)
         new(4) = integrity(l, 2)*self%secant%shear(l, 1)*strain(l, 4)
         new(5) = self%secant%shear(l, 2)*strain(l, 5)
         new(6) = self%secant%shear(l, 3)*strain(l, 6)
         do k = 1, 6
            stress(l, k) = merge(new(k), stress(l, k), self%owns(l))
         end do
      end do
   end subroutine give_stress

end module plydyn_law_ply_strain_damage
