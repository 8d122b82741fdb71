!> Rigid bodies that the plate meets. Impactors are of revolution and have a mass, fixtures have a
!> flat face and stand still, move as prescribed, or clamp with a force.
module plydyn_model_body
   use plydyn_base_precision, only : wp
   use plydyn_contact_bodies_flat_body, only : flat_body_type
   use plydyn_contact_bodies_revolved_body, only : revolved_body_type
   use plydyn_contact_solve_coulomb, only : friction_type
   use plydyn_model_curve, only : curve_type
   implicit none
   private

   !> How contact is discretised, numbered as on the card: contact nodes carried by the impactor
   !> against the facets of the plate, or the points of the plate's face against the exact body
   integer, parameter, public :: nodes_on_impactor = 1, points_on_plate = 2

   !> What all bodies have
   type :: body_type
      !> The user's number
      integer :: id = 0
      !> What it is, for print
      character(:), allocatable :: kind
      !> Curves of a prescribed motion along x, y, z, indices into `model%curves`, 0 for none: of
      !> the displacement of a fixture, and of `quantity` of an impactor
      integer :: motion(3) = 0
   end type body_type

   !> A rigid body of revolution
   type, public, extends(body_type) :: impactor_type
      !> Its surface
      type(revolved_body_type) :: body
      !> Mass; centre and velocity at time zero
      real(wp) :: mass = 0.0_wp, centre(3) = 0.0_wp, velocity(3) = 0.0_wp
      !> Moves along z only
      logical :: guided = .false.
      !> Whether friction rotates it, and its moment of inertia about any axis through the centre
      logical :: rotates = .false.
      real(wp) :: inertia = 0.0_wp
      !> What the curves of its motion give, as in `motion_type`
      integer :: quantity = 0
      !> Acceleration by its weight at all times along x, y, z
      real(wp) :: gravity(3) = 0.0_wp
   contains
      procedure :: inverse_mass
      procedure :: inverse_inertia
   end type impactor_type

   !> An impactor against a face of the plate
   type, public :: contact_type
      !> The user's number; index into `model%impactors`
      integer :: id = 0, impactor = 0
      !> Parts that it meets, indices into `model%parts`; none for all of them
      integer, allocatable :: parts(:)
      !> `bottom_face` or `top_face`; `nodes_on_impactor` or `points_on_plate`
      integer :: face = 0, method = nodes_on_impactor
      !> Distance between contact nodes on the impactor, length; 0 for one made from the mesh
      real(wp) :: spacing = 0.0_wp
      !> Friction coefficients
      type(friction_type) :: friction
      !> Where the deck says so: line of all lines, 0 for none, and file and line
      integer :: line = 0
      character(:), allocatable :: place
      !> Whether a restart has added it: the plate has moved by then
      logical :: is_later = .false.
   end type contact_type

   !> A fixture against a face of all parts
   type, public, extends(body_type) :: fixture_type
      !> `bottom_face` or `top_face` of `plydyn_model_support`
      integer :: face = 0
      !> Its face; `upward` is the opposite of `face`
      type(flat_body_type) :: body
      !> Distance from the face of the plate at time zero, length
      real(wp) :: gap = 0.0_wp
      !> Friction coefficients
      type(friction_type) :: friction
      !> Whether it presses with a force, as soft as a spring, instead of standing still
      logical :: is_clamp = .false.
      !> Force of the clamp at a curve value of 1, and its curve; 0 for the constant 1
      real(wp) :: force = 0.0_wp
      integer :: curve = 0
      !> Stiffness of the clamp, force/length, and where the deck has it: line, and file and line
      real(wp) :: stiffness = 0.0_wp
      integer :: line = 0
      character(:), allocatable :: place
   contains
      procedure :: displacement
   end type fixture_type

contains

   !> Inverse mass along x, y, z, 0 where a guide holds it or curves lead it
   pure function inverse_mass(self)
      class(impactor_type), intent(in) :: self
      real(wp) :: inverse_mass(3)

      inverse_mass(:) = merge(0.0_wp, 1.0_wp/self%mass, self%motion > 0 &
         & .or. self%guided .and. [.true., .true., .false.])
   end function inverse_mass

   !> Inverse moment of inertia, 0 where it does not rotate
   pure real(wp) function inverse_inertia(self)
      class(impactor_type), intent(in) :: self

      inverse_inertia = 0.0_wp
      if (self%rotates .and. self%inertia > 0.0_wp) inverse_inertia = 1.0_wp/self%inertia
   end function inverse_inertia

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

end module plydyn_model_body
