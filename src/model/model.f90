!> The model: what the deck says, in an engineer's words and with the user's numbers.
module plydyn_model_model
   use plydyn_model_support, only : body_load_type, constraint_type, initial_velocity_type, &
      & line_load_type, motion_type, point_load_type, pressure_type, segment_load_type, support_type
   use plydyn_model_control, only : change_type, changes_type, control_type, request_type
   use plydyn_model_crack_zone, only : crack_zone_type
   use plydyn_model_curve, only : curve_type
   use plydyn_model_body, only : contact_type, fixture_type, impactor_type
   use plydyn_model_layup, only : initial_damage_type, part_type
   use plydyn_model_material, only : interface_material_type, material_type
   use plydyn_model_mesh, only : mesh_type
   implicit none
   private

   !> Everything of one deck; immutable once read and checked
   type, public :: model_type
      !> Title of the run
      character(:), allocatable :: title
      !> Nodes and elements, their parts, and materials of plies and of interfaces
      type(mesh_type) :: mesh
      type(part_type), allocatable :: parts(:)
      type(material_type), allocatable :: materials(:)
      type(interface_material_type), allocatable :: interface_materials(:)
      !> Curves over time
      type(curve_type), allocatable :: curves(:)
      !> Supports and prescribed motions; linear constraints, of which no two share a point
      type(support_type), allocatable :: supports(:)
      type(motion_type), allocatable :: motions(:)
      type(constraint_type), allocatable :: constraints(:)
      !> Velocities at time zero, where a later one overrides an earlier one, and damage of
      !> interfaces, where of two on one point the larger counts
      type(initial_velocity_type), allocatable :: initial_velocities(:)
      type(initial_damage_type), allocatable :: initial_damages(:)
      !> Zones in which plies crack along lines
      type(crack_zone_type), allocatable :: crack_zones(:)
      !> Forces at nodes and along lines, pressures, those on faces of bricks, and accelerations of
      !> the frame
      type(point_load_type), allocatable :: point_loads(:)
      type(line_load_type), allocatable :: line_loads(:)
      type(pressure_type), allocatable :: pressures(:)
      type(segment_load_type), allocatable :: segment_loads(:)
      type(body_load_type), allocatable :: body_loads(:)
      !> Rigid impactors, their contacts with parts, and fixtures
      type(impactor_type), allocatable :: impactors(:)
      type(contact_type), allocatable :: contacts(:)
      type(fixture_type), allocatable :: fixtures(:)
      !> Sides across x and y that are planes of symmetry, see `plydyn_model_symmetry`; 0 for none
      integer :: planes(2) = 0
      !> Time, step and kinematics, and what to write
      type(control_type) :: control
      type(request_type) :: request
      !> What the newest deck of a restart changes, nothing in a run that begins; the same in words,
      !> only on the rank that read that deck
      type(changes_type) :: changes
      type(change_type), allocatable :: change_list(:)
   contains
      procedure :: crack_zone_of
   end type model_type

contains

   !> Index of the crack zone that a part is, 0 for none
   pure integer function crack_zone_of(self, part) result(zone)
      class(model_type), intent(in) :: self
      !> Index of the part
      integer, intent(in) :: part

      zone = 0
      if (allocated(self%crack_zones)) zone = findloc(self%crack_zones%part, part, 1)
   end function crack_zone_of

end module plydyn_model_model
