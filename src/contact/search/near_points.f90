!> Points of the plate that a fixture may meet soon (a Verlet list): most points of a plate never
!> come near its base, and are looked at again only when the plate has moved far enough.
module plydyn_contact_search_near_points
   use plydyn_base_precision, only : wp
   use plydyn_contact_bodies_flat_body, only : flat_body_type
   implicit none
   private

   public :: new_near_points

   !> A motion in a step that is not known, and taken to be larger than any
   real(wp), parameter, public :: unknown_move = sqrt(huge(1.0_wp))

   !> Moves as large as that of the step in which points are listed, after which they are listed
   !> anew
   real(wp), parameter :: most_moves = 500.0_wp

   !> The points that are near a fixture
   type, public :: near_points_type
      !> They are the first `count`, in ascending order of their places in the face
      integer, allocatable :: point(:)
      integer :: count = 0
      !> Distance within which points are to be listed, length
      real(wp) :: reach = 0.0_wp
      !> How far every other point was from the fixture when they were listed, less what plate and
      !> fixture have moved since, length; none may touch while it is not negative
      real(wp), private :: slack = -1.0_wp
   contains
      procedure :: approach
      procedure :: push
      procedure :: is_due
      procedure :: list_all
      procedure :: list_none
      procedure :: list_if_near
   end type near_points_type

contains

   !> Start with an empty list, which is due
   pure type(near_points_type) function new_near_points(points) result(self)
      !> How many points of the face this rank has
      integer, intent(in) :: points

      allocate (self%point(points), source=0)
   end function new_near_points

   !> Take the motion of a step from the slack
   pure subroutine approach(self, move)
      class(near_points_type), intent(inout) :: self
      !> Bound on the motion of the points relative to the fixture in the step, length
      real(wp), intent(in) :: move

      self%slack = self%slack - move
      self%reach = most_moves*move
   end subroutine approach

   !> Take from it what contact has moved points in the step
   pure subroutine push(self, move)
      class(near_points_type), intent(inout) :: self
      !> Bound on it, length
      real(wp), intent(in) :: move

      self%slack = self%slack - move
   end subroutine push

   !> Whether the points must be listed anew before contact
   pure logical function is_due(self)
      class(near_points_type), intent(in) :: self

      is_due = .not. self%slack >= 0.0_wp
   end function is_due

   !> List some points as they are, until the next step
   pure subroutine list_all(self, points)
      class(near_points_type), intent(inout) :: self
      !> All that may touch
      integer, intent(in) :: points(:)

      self%count = size(points)
      self%point(:self%count) = points
      self%slack = -1.0_wp
   end subroutine list_all

   !> Begin a list of the points within reach
   pure subroutine list_none(self)
      class(near_points_type), intent(inout) :: self

      self%count = 0
      self%slack = self%reach
   end subroutine list_none

   !> Add a point to the list unless it is out of reach
   pure subroutine list_if_near(self, body, point, place)
      class(near_points_type), intent(inout) :: self
      type(flat_body_type), intent(in) :: body
      !> Where the point is relative to it, as for its `find_gap`, length
      real(wp), intent(in) :: place(3)
      !> Number of the point in the face
      integer, intent(in) :: point

      real(wp) :: gap, normal(3)

      if (body%upward*place(3) >= self%reach) return
      call body%find_gap(place, gap, normal)
      if (gap >= self%reach) return
      self%count = self%count + 1
      self%point(self%count) = point
   end subroutine list_if_near

end module plydyn_contact_search_near_points
