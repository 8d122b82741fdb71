!> Rigid impactors, and their contacts with faces of the plate.
module plydyn_model_impactor
   use plydyn_base_precision, only : wp
   use plydyn_contact_bodies_revolved_body, only : revolved_body_type
   use plydyn_contact_solve_coulomb, only : friction_type
   implicit none
   private

   !> How contact is discretised, numbered as on the card: contact nodes carried by the impactor
   !> against the facets of the plate, or the points of the plate's face against the exact body
   integer, parameter, public :: nodes_on_impactor = 1, points_on_plate = 2

   !> A rigid body of revolution
   type, public :: impactor_type
      !> The user's number
      integer :: id = 0
      !> Title, empty without one
      character(:), allocatable :: title
      !> What it is, for print
      character(:), allocatable :: kind
      !> Its surface
      type(revolved_body_type) :: body
      !> Mass
      real(wp) :: mass = 0.0_wp
      !> Centre at time zero
      real(wp) :: centre(3) = 0.0_wp
      !> Velocity at time zero
      real(wp) :: velocity(3) = 0.0_wp
      !> Moves along z only
      logical :: guided = .false.
      !> Whether friction rotates it, and its moment of inertia about any axis through the centre
      logical :: rotates = .false.
      real(wp) :: inertia = 0.0_wp
      !> Curves of a prescribed motion along x, y, z, indices into `model%curves`, 0 for none; what
      !> they give, as in `motion_type`
      integer :: motion(3) = 0
      integer :: quantity = 0
      !> Acceleration by its weight at all times along x, y, z
      real(wp) :: gravity(3) = 0.0_wp
   end type impactor_type

   !> An impactor against a face of the plate
   type, public :: contact_type
      !> The user's number
      integer :: id = 0
      !> Index into `model%impactors`
      integer :: impactor = 0
      !> Parts that it meets, indices into `model%parts`; none for all of them
      integer, allocatable :: parts(:)
      !> `bottom_face` or `top_face` of `plydyn_model_support`
      integer :: face = 0
      !> `nodes_on_impactor` or `points_on_plate`
      integer :: method = nodes_on_impactor
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

end module plydyn_model_impactor
