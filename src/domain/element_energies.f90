!> Energies of the elements from displacements and histories: what they have stored and dissipated,
!> and what hourglass control has taken; and what the cracks of each ply have come to.
module plydyn_domain_element_energies
   use plydyn_base_exact_sum, only : exact_sums_type, new_exact_sums
   use plydyn_base_precision, only : wp
   use plydyn_domain_delamination, only : delamination_type, interface_losses
   use plydyn_domain_domain, only : domain_type
   use plydyn_element_cracked_crack_lines, only : add_crack_energy, add_crack_losses, crack_losses
   use plydyn_law_law, only : by_delamination, by_friction, by_matrix_damage, mechanisms
   implicit none
   private

   public :: cracks_of_plies, dissipated_energies, stored_energies

   !> The cracks of one ply, in all zones together
   type, public :: ply_cracks_type
      !> Length of crack that has started, and that has failed
      real(wp) :: length = 0.0_wp, failed = 0.0_wp
      !> Energies lost in fracture and in friction
      real(wp) :: fracture = 0.0_wp, friction = 0.0_wp
      !> Ends of lines at which a crack has started
      integer :: ends = 0
   end type ply_cracks_type

contains

   !> Sums over all points of what each mechanism has dissipated. All ranks must come here, and get
   !> those of the whole model
   function dissipated_energies(domain, history, lost) result(energy)
      type(domain_type), intent(in) :: domain
      !> History of all Gauss points
      real(wp), intent(in), contiguous :: history(:)
      !> What the interfaces of the whole model have lost; none where none can fail
      type(delamination_type), intent(in) :: lost(:)
      !> In the order of `mechanism_names`
      real(wp) :: energy(mechanisms)

      type(exact_sums_type) :: sums
      type(ply_cracks_type), allocatable :: cracks(:)
      integer :: g, i

      sums = new_exact_sums(mechanisms)
      do g = 1, size(domain%groups)
         call domain%groups(g)%item%add_dissipation(history, sums)
      end do
      call domain%comm%sum(sums%limb)
      energy(:) = [(sums%value(i), i=1, mechanisms)]
      energy(by_delamination:by_friction) = energy(by_delamination:by_friction) &
         & + interface_losses(lost)
      if (domain%cracks%whole == 0) return
      cracks = cracks_of_plies(domain, history)
      energy(by_matrix_damage) = energy(by_matrix_damage) + sum(cracks%fracture)
      energy(by_friction) = energy(by_friction) + sum(cracks%friction)
   end function dissipated_energies

   !> Energy that unloading of all elements gives back, that which hourglass control has stored or
   !> taken, and that which it has taken by viscous forces. All ranks must come here
   function stored_energies(domain, displacement, history) result(energy)
      type(domain_type), intent(in) :: domain
      !> Displacement of all points, history of all Gauss points
      real(wp), intent(in), contiguous :: displacement(:), history(:)
      real(wp) :: energy(3)

      type(exact_sums_type) :: own, sums
      integer :: c, g, i

      sums = new_exact_sums(3)
      !$omp parallel default(shared) private(g, own)
      own = new_exact_sums(3)
      !$omp do schedule(dynamic)
      do c = 1, size(domain%chunks%list)
         associate (chunk => domain%chunks%list(c))
            do g = 1, size(chunk%groups)
               call domain%groups(chunk%groups(g))%item%add_stored_energy(chunk%elements, &
                  & displacement, history, own)
            end do
         end associate
      end do
      !$omp end do
      !$omp critical
      sums%limb(:, :) = sums%limb + own%limb
      !$omp end critical
      !$omp end parallel
      if (domain%cracks%whole > 0) call add_crack_energy(domain%cracks, displacement, &
         & history(domain%cracks%first_history:), sums)
      call domain%comm%sum(sums%limb)
      energy(:) = [(sums%value(i), i=1, size(energy))]
   end function stored_energies

   !> Cracks of each ply from the bottom up. All ranks must come here, and get those of the whole
   !> model
   function cracks_of_plies(domain, history) result(cracks)
      type(domain_type), intent(in) :: domain
      !> History of all Gauss points and cracks
      real(wp), intent(in), contiguous :: history(:)
      type(ply_cracks_type) :: cracks(size(domain%layers%ply))

      type(exact_sums_type) :: sums
      integer :: k

      sums = new_exact_sums(crack_losses*size(cracks))
      if (size(domain%cracks%zone) > 0) call add_crack_losses(domain%cracks, &
         & history(domain%cracks%first_history:), sums)
      call domain%comm%sum(sums%limb)
      do k = 1, size(cracks)
         associate (before => crack_losses*(k - 1))
            cracks(k) = ply_cracks_type(sums%value(before + 1), sums%value(before + 2), &
               & sums%value(before + 3), sums%value(before + 4), nint(sums%value(before + 5)))
         end associate
      end do
   end function cracks_of_plies

end module plydyn_domain_element_energies
