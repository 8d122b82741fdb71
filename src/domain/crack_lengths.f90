!> What the cracks of a model have come to, ply by ply.
module plydyn_domain_crack_lengths
   use plydyn_base_exact_sum, only : exact_sums_type, new_exact_sums
   use plydyn_base_precision, only : wp
   use plydyn_domain_domain, only : domain_type
   use plydyn_element_cracked_crack_lines, only : add_crack_losses, crack_losses
   implicit none
   private

   public :: cracks_of_plies

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

end module plydyn_domain_crack_lengths
