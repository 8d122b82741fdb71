!> Fixtures: rigid bodies that stand still or move as prescribed, and tips that clamp with a force.
module plydyn_model_fixture
   use plydyn_base_precision, only : wp
   use plydyn_contact_bodies_flat_body, only : flat_body_type
   use plydyn_contact_solve_coulomb, only : friction_type
   use plydyn_model_curve, only : curve_type
   implicit none
   private

   !> A fixture against a face of all parts
   type, public :: fixture_type
      !> The user's number
      integer :: id = 0
      !> What it is, for print
      character(:), allocatable :: kind
      !> `bottom_face` or `top_face` of `plydyn_model_support`
      integer :: face = 0
      !> Its face; `upward` is the opposite of `face`
      type(flat_body_type) :: body
      !> Distance from the face of the plate at time zero, length
      real(wp) :: gap = 0.0_wp
      !> Friction coefficients
      type(friction_type) :: friction
      !> Curves of its displacement along x, y, z, indices into `model%curves`; 0 for none
      integer :: motion(3) = 0
      !> Whether it presses with a force, as soft as a spring, instead of standing still
      logical :: is_clamp = .false.
      !> Force of the clamp at a curve value of 1, and its curve; 0 for the constant 1
      real(wp) :: force = 0.0_wp
      integer :: curve = 0
      !> Stiffness of the clamp, force/length
      real(wp) :: stiffness = 0.0_wp
      !> Where the deck has it: line of all lines, 0 for none
      integer :: line = 0
   contains
      procedure :: displacement
   end type fixture_type

contains

   !> Displacement at a time
   pure function displacement(self, curves, time)
      class(fixture_type), intent(in) :: self
      !> All curves
      type(curve_type), intent(in) :: curves(:)
      !> The time
      real(wp), intent(in) :: time
      real(wp) :: displacement(3)

      integer :: c

      displacement(:) = 0.0_wp
      do c = 1, 3
         if (self%motion(c) > 0) displacement(c) = curves(self%motion(c))%at(time)
      end do
   end function displacement

end module plydyn_model_fixture
