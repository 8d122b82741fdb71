!> Rigid impactors, and their contacts with parts.
module plydyn_model_impactor
   use plydyn_base_precision, only : wp
   implicit none
   private

   !> How contact is discretised, numbered as on the card: contact nodes carried by the impactor
   !> against the facets of the plate, or the points of the plate's face against the exact sphere
   integer, parameter, public :: nodes_on_impactor = 1, points_on_plate = 2

   !> A rigid sphere or hemisphere; it translates and does not turn
   type, public :: impactor_type
      !> The user's number
      integer :: id = 0
      !> Title, empty without one
      character(:), allocatable :: title
      !> Length
      real(wp) :: radius = 0.0_wp
      !> Mass
      real(wp) :: mass = 0.0_wp
      !> Centre at time zero
      real(wp) :: centre(3) = 0.0_wp
      !> Velocity at time zero
      real(wp) :: velocity(3) = 0.0_wp
      !> Moves along z only
      logical :: guided = .false.
      !> Only the half that faces the plate carries contact nodes
      logical :: hemisphere = .false.
      !> Acceleration along z at all times, negative downwards
      real(wp) :: gravity = 0.0_wp
   end type impactor_type

   !> An impactor against a face of a part
   type, public :: contact_type
      !> The user's number
      integer :: id = 0
      !> Index into `model%impactors`
      integer :: impactor = 0
      !> Index into `model%parts`
      integer :: part = 0
      !> `bottom_face` or `top_face` of `plydyn_model_support`
      integer :: face = 0
      !> `nodes_on_impactor` or `points_on_plate`
      integer :: method = nodes_on_impactor
      !> Distance between contact nodes on the impactor, length; 0 for one made from the mesh
      real(wp) :: spacing = 0.0_wp
      !> Where the deck says so: line of all lines, 0 for none, and file and line
      integer :: line = 0
      character(:), allocatable :: place
   end type contact_type

end module plydyn_model_impactor
