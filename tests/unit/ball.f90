!> A ball over a flat plate, with the data of its contact search.
module ball
   use plydyn_base_error, only : error_type
   use plydyn_base_precision, only : wp
   use plydyn_contact_bodies_revolved_body, only : revolved_body_type, sphere_body
   use plydyn_contact_solve_constraint, only : constraints_type, new_constraints
   use plydyn_contact_search_candidate_list, only : candidate_list_type, new_candidate_list
   use plydyn_contact_search_contact_nodes, only : new_nodes, node_set_type
   use plydyn_contact_search_surface, only : new_surface, surface_type
   use sample, only : flat_surface
   implicit none
   private

   public :: ball_body, new_plate, set_ball

   !> Squares along an edge of the plate, and its points
   integer, parameter, public :: squares = 12, points = (2*squares + 1)**2
   !> Radius of the ball, and spacing of its contact nodes; squares have sides of one
   real(wp), parameter, public :: radius = 5.0_wp, spacing = 0.4_wp
   !> Centre of the ball that touches the middle of the plate
   real(wp), parameter, public :: touching(3) = [0.0_wp, 0.0_wp, radius]

contains

   !> A sphere above a plate
   pure type(revolved_body_type) function ball_body(radius) result(body)
      !> Length
      real(wp), intent(in) :: radius

      body = sphere_body(radius)
      body%axis(3) = 1.0_wp
   end function ball_body

   !> The plate: its points, and its face
   subroutine new_plate(flat, facet, surface)
      !> Positions of the points
      real(wp), intent(out) :: flat(3, points)
      !> Points of each facet
      integer, intent(out) :: facet(9, squares**2)
      !> The face
      type(surface_type), intent(out) :: surface

      call flat_surface(squares, flat, facet)
      call new_surface(surface, facet, size(flat, 2), 1)
   end subroutine new_plate

   !> Contact nodes of the ball, an empty candidate list and an empty set of rows
   subroutine set_ball(surface, flat, candidates, nodes, rows)
      !> The face of the plate
      type(surface_type), intent(in) :: surface
      !> Positions of its points
      real(wp), intent(in) :: flat(3, points)
      !> Facets near the ball
      type(candidate_list_type), intent(out) :: candidates
      !> Contact nodes
      type(node_set_type), intent(out) :: nodes
      !> Constraints, none yet
      type(constraints_type), intent(out) :: rows

      type(error_type), allocatable :: error

      call new_candidate_list(candidates, surface, ball_body(radius))
      call new_nodes(nodes, surface, flat, touching, ball_body(radius), spacing, error)
      call new_constraints(rows, 9)
   end subroutine set_ball

end module ball
