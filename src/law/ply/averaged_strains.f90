!> Exchange of the strains of a point for the averages over its neighbours, which drive its damage.
!>
!> A law with averages keeps the strains of a point, for its neighbours in the next step, and the
!> averages behind its other history variables (`set_average` of `law_type`).
module plydyn_law_ply_averaged_strains
   use plydyn_base_precision, only : lanes, wp
   implicit none
   private

   public :: exchange_strains

contains

   !> Keep the strains of the point for its neighbours, and give the averages that drive damage.
   !> Damage grows with the strain of neighbours: the mean of a driving force over its value at the
   !> end is strain before over strain now, which is what the work of the step less what is stored
   !> comes to
   pure subroutine exchange_strains(owns, members, strain, kept, mean, share)
      !> Lanes of the law
      logical, intent(in) :: owns(lanes)
      !> Strains that each mode of damage feels, (strains, modes)
      logical, intent(in) :: members(:, :)
      !> Strains of the point now
      real(wp), intent(in) :: strain(lanes, size(members, 1))
      !> Strains of the point, those of the step before in and those of now out, and the averages
      real(wp), intent(inout) :: kept(lanes, size(members, 1), 2)
      !> Averages; 0 in other lanes
      real(wp), intent(out) :: mean(lanes, size(members, 1))
      !> Mean of the driving forces of each mode over their values at the end
      real(wp), intent(out) :: share(lanes, size(members, 2))

      real(wp) :: product(lanes), square(lanes)
      integer :: j, k

      do j = 1, size(members, 2)
         product(:) = 0.0_wp
         square(:) = 0.0_wp
         do k = 1, size(members, 1)
            if (.not. members(k, j)) cycle
            product(:) = product + kept(:, k, 1)*strain(:, k)
            square(:) = square + strain(:, k)**2
         end do
         share(:, j) = max(product, 0.0_wp)/max(square, tiny(square))
      end do
      do k = 1, size(members, 1)
         where (owns) kept(:, k, 1) = strain(:, k)
         mean(:, k) = merge(kept(:, k, 2), 0.0_wp, owns)
      end do
   end subroutine exchange_strains

end module plydyn_law_ply_averaged_strains
