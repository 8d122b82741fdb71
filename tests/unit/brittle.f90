!> Example of a law: an isotropic material that breaks at a strain, all at once.
!>
!> The constants extend `law_constants_type` and the law of a batch extends `law_type`: this is all
!> that a new law needs besides its keyword.
module brittle
   use plydyn_base_precision, only : lanes, wp
   use plydyn_law_law, only : by_matrix_damage, law_constants_type, law_type
   use plydyn_law_ply_elastic, only : ply_stiffness
   implicit none
   private

   !> Constants of the material, besides the elastic ones
   type, public, extends(law_constants_type) :: brittle_constants_type
      !> Size of any strain at which it breaks
      real(wp) :: limit = huge(1.0_wp)
   contains
      procedure :: new_batch
      procedure :: set_lane
   end type brittle_constants_type

   !> History variables: 1 once it is broken, and the energy dissipated per volume, which is last
   integer, parameter, public :: is_broken = 1, dissipated = 2

   !> Constants of the lanes
   type, public, extends(law_type) :: brittle_type
      !> Stiffness of each lane, (6, 6, lanes)
      real(wp) :: stiffness(6, 6, lanes) = 0.0_wp
      !> Strain at which it breaks
      real(wp) :: limit(lanes) = huge(1.0_wp)
   contains
      procedure :: update
   end type brittle_type

contains

   !> A law without lanes
   subroutine new_batch(self, law)
      class(brittle_constants_type), intent(in) :: self
      class(law_type), allocatable, intent(out) :: law

      allocate (brittle_type :: law)
   end subroutine new_batch

   !> Give a lane its material
   pure subroutine set_lane(self, lane, law)
      class(brittle_constants_type), intent(in) :: self
      integer, intent(in) :: lane
      class(law_type), intent(inout) :: law

      select type (law)
      type is (brittle_type)
         law%owns(lane) = .true.
         law%histories = dissipated
         law%energy_variable(by_matrix_damage) = dissipated
         law%stiffness(:, :, lane) = ply_stiffness(self%young, self%poisson, self%shear)
         law%limit(lane) = self%limit
      end select
   end subroutine set_lane

   !> Stress and history after a step
   pure subroutine update(self, step, strain, history, stress)
      class(brittle_type), intent(in) :: self
      real(wp), intent(in) :: step
      real(wp), intent(in) :: strain(lanes, 6)
      real(wp), intent(inout) :: history(lanes, *)
      real(wp), intent(inout) :: stress(lanes, 6)

      real(wp) :: elastic(6)
      integer :: l

      do l = 1, lanes
         if (.not. self%owns(l)) cycle
         elastic(:) = matmul(self%stiffness(:, :, l), strain(l, :))
         if (history(l, is_broken) <= 0.0_wp .and. maxval(abs(strain(l, :))) > self%limit(l)) then
            history(l, is_broken) = 1.0_wp
            history(l, dissipated) = 0.5_wp*dot_product(elastic, strain(l, :))
         end if
         stress(l, :) = (1.0_wp - history(l, is_broken))*elastic
      end do
   end subroutine update

end module brittle
