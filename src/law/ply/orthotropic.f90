!> Elastic law of orthotropic plies over a batch, for stacks in which other layers yield or crack.
module plydyn_law_ply_orthotropic
   use plydyn_base_precision, only : lanes, wp
   use plydyn_law_constants, only : law_constants_type
   use plydyn_law_law, only : law_type
   use plydyn_law_ply_elastic, only : ply_stiffness
   implicit none
   private

   !> Constants of an elastic ply or metal
   type, public, extends(law_constants_type) :: elastic_constants_type
   contains
      procedure :: new_batch
      procedure :: set_lane
      procedure :: is_elastic
   end type elastic_constants_type

   !> Stiffness of each lane
   type, public, extends(law_type) :: orthotropic_type
      !> C11 C12 C13 C22 C23 C33 C44 C55 C66 in ply axes, (lanes, 9)
      real(wp) :: stiffness(lanes, 9) = 0.0_wp
   contains
      procedure :: update
   end type orthotropic_type

contains

   !> A law without lanes
   subroutine new_batch(self, law)
      class(elastic_constants_type), intent(in) :: self
      class(law_type), allocatable, intent(out) :: law

      allocate (orthotropic_type :: law)
   end subroutine new_batch

   !> Give a lane of a batch its material
   pure subroutine set_lane(self, lane, law)
      class(elastic_constants_type), intent(in) :: self
      integer, intent(in) :: lane
      class(law_type), intent(inout) :: law

      real(wp) :: c(6, 6)

      c(:, :) = ply_stiffness(self%young, self%poisson, self%shear)
      select type (law)
      type is (orthotropic_type)
         law%owns(lane) = .true.
         law%stiffness(lane, :) = [c(1, 1:3), c(2, 2:3), c(3, 3), c(4, 4), c(5, 5), c(6, 6)]
      end select
   end subroutine set_lane

   !> The stress is the stiffness times the strain
   pure logical function is_elastic(self)
      class(elastic_constants_type), intent(in) :: self

      is_elastic = .true.
   end function is_elastic

   !> Stress of the strain
   pure subroutine update(self, step, strain, history, stress)
      class(orthotropic_type), intent(in) :: self
      real(wp), intent(in) :: step
      real(wp), intent(in) :: strain(lanes, 6)
      real(wp), intent(inout) :: history(lanes, *)
      real(wp), intent(inout) :: stress(lanes, 6)

      real(wp) :: own(lanes, 6)
      integer :: i

      associate (c => self%stiffness, e => strain)
         own(:, 1) = c(:, 1)*e(:, 1) + c(:, 2)*e(:, 2) + c(:, 3)*e(:, 3)
         own(:, 2) = c(:, 2)*e(:, 1) + c(:, 4)*e(:, 2) + c(:, 5)*e(:, 3)
         own(:, 3) = c(:, 3)*e(:, 1) + c(:, 5)*e(:, 2) + c(:, 6)*e(:, 3)
         own(:, 4:6) = c(:, 7:9)*e(:, 4:6)
      end associate
      do i = 1, 6
         stress(:, i) = merge(own(:, i), stress(:, i), self%owns)
      end do
   end subroutine update

end module plydyn_law_ply_orthotropic
