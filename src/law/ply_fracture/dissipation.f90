!> Energies that a step dissipates in a ply with planes of fracture.
!>
!> They are what the work of the step, by the mean of the stresses before and after, leaves beyond
!> the change of the stored energy, to round-off and for steps of any size; `manual/theory.md` has
!> the derivation.
module plydyn_law_ply_fracture_dissipation
   use plydyn_base_precision, only : lanes, wp
   use plydyn_law_ply_fracture_constants, only : fracture_batch_type
   use plydyn_law_ply_fracture_crack, only : crack_type
   use plydyn_law_ply_fracture_fibres, only : fibres_type
   use plydyn_law_ply_fracture_history, only : fibre_energy, friction_energy, histories, &
      & last_contact, last_stress, matrix_damage, matrix_energy, plastic_energy, slip
   use plydyn_law_ply_fracture_plane, only : plane_traction
   implicit none
   private

   public :: add_crack_energies, add_energies

contains

   !> Add what fibres and permanent strains dissipate
   pure subroutine add_energies(ply, fibres, growth, stress, h)
      !> Constants
      type(fracture_batch_type), intent(in) :: ply
      !> What is left of the fibres
      type(fibres_type), intent(in) :: fibres
      !> Growth of the permanent strains 12, 13, 23 and 33
      real(wp), intent(in) :: growth(lanes, 4)
      !> Stress after the step
      real(wp), intent(in) :: stress(lanes, 6)
      !> History of the point, with the stress before the step
      real(wp), intent(inout) :: h(lanes, histories)

      real(wp) :: before(6), lost, now(6), sheared
      integer :: k, l

      associate (g => ply%shear)
         !$omp simd private(before, k, lost, now, sheared)
         do l = 1, lanes
            do k = 1, 6
               before(k) = h(l, last_stress - 1 + k)
               now(k) = stress(l, k)
            end do
            lost = 0.5_wp*(fibres%before(l) - fibres%after(l))/(fibres%before(l)*fibres%after(l))
            sheared = 0.5_wp*(fibres%sheared_before(l) - fibres%sheared(l)) &
               & /(fibres%sheared_before(l)*fibres%sheared(l))
            h(l, fibre_energy) = h(l, fibre_energy) + lost*ply%compliance(l)*before(1)*now(1) &
               & + sheared*(before(4)*now(4)/g(l, 1) + before(5)*now(5)/g(l, 2))
            h(l, plastic_energy) = h(l, plastic_energy) + 0.5_wp*( &
               & (before(4) + now(4))*growth(l, 1) + (before(5) + now(5))*growth(l, 2) &
               & + (before(6) + now(6))*growth(l, 3) + (before(3) + now(3))*growth(l, 4))
         end do
      end associate
   end subroutine add_energies

   !> Add what the crack dissipates: by friction what slip does of work, of the share that had
   !> cracked before and of what cracks now; by damage the rest
   pure subroutine add_crack_energies(crack, h)
      !> The crack after the step
      type(crack_type), intent(in) :: crack
      !> History of the point, that of the crack as it was before the step
      real(wp), intent(inout) :: h(lanes, histories)

      real(wp) :: after(3), before(3), last(lanes, 3), rubbed, total, was
      integer :: k, l

      call plane_traction(crack%cosine, crack%sine, h(:, last_stress:last_stress + 5), last)
      associate (t => crack%whole, plane => crack%stiffness, contact => crack%contact)
         !$omp simd private(after, before, k, rubbed, total, was)
         do l = 1, lanes
            was = h(l, matrix_damage)
            total = 0.0_wp
            rubbed = (crack%damage(l) - was)*(crack%slip(l, 2)*contact(l, 2) &
               & + crack%slip(l, 3)*contact(l, 3))
            do k = 1, 3
               before(k) = was*h(l, slip - 1 + k)
               after(k) = crack%damage(l)*crack%slip(l, k)
               total = total + (last(l, k) + contact(l, k))*after(k) &
                  & - (t(l, k) + h(l, last_contact - 1 + k))*before(k)
               rubbed = rubbed + 0.5_wp*was*(crack%slip(l, k) - h(l, slip - 1 + k)) &
                  & *(contact(l, k) + h(l, last_contact - 1 + k))
            end do
            ! traction of the plane after the step: that of a whole one less what slip relieves
            total = total + before(1)*(plane%normal(l)*after(1) + plane%both(l)*after(2)) &
               & + before(2)*(plane%both(l)*after(1) + plane%across(l)*after(2)) &
               & + before(3)*plane%along(l)*after(3)
            h(l, friction_energy) = h(l, friction_energy) + rubbed
            h(l, matrix_energy) = h(l, matrix_energy) + 0.5_wp*total - rubbed
         end do
      end associate
   end subroutine add_crack_energies

end module plydyn_law_ply_fracture_dissipation
