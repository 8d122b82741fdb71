!> The way of an impactor to the plate: when and where it first touches, if the plate rests.
!>
!> The impactor flies along a parabola and is advanced by its gap to the plate again and again, so
!> that it can pass nothing. Its gap to a face is that to the plane of the face where its lowest
!> point is above the plate, else that to the points of the plate, on the face and on its edge.
module plydyn_model_approach
   use plydyn_base_precision, only : wp
   use plydyn_model_body, only : contact_type, impactor_type
   use plydyn_model_model, only : model_type
   use plydyn_model_outer_faces, only : faces_of_parts
   use plydyn_model_support, only : top_face
   implicit none
   private

   public :: face_points, find_approach, new_contact_face

   !> Facets of the face and their points
   type, public :: contact_face_type
      !> Nodes of each facet, counter-clockwise from above, (4 or 9, facets)
      integer, allocatable :: facet(:, :)
      !> Height of the face above its nodes, length
      real(wp) :: height = 0.0_wp
   end type contact_face_type

   !> The first touch
   type, public :: approach_type
      !> Whether it is known; that before the end time; that of the edge before the face
      logical :: is_known = .false., arrives = .false., is_at_edge = .false.
      !> Time then, or at the end; way of the centre until then, length
      real(wp) :: time = 0.0_wp, distance = 0.0_wp
      !> Centre there, length
      real(wp) :: centre(3) = 0.0_wp
   end type approach_type

   !> Points that an impactor may meet
   type :: target_type
      !> Corners of each facet in the plane, (2, 4, facets), length
      real(wp), allocatable :: corner(:, :, :)
      !> Points of the face, (3, points), length
      real(wp), allocatable :: point(:, :)
      !> Outermost height of the face, and height of the opposite face, length
      real(wp) :: face = 0.0_wp, back = 0.0_wp
      !> 1 for the top face, -1 for the bottom face
      integer :: side = 1
   end type target_type

   !> Most steps of the way, and the gap over the radius that ends it
   integer, parameter :: max_steps = 2000
   real(wp), parameter :: least_gap = 1.0e-6_wp
   !> Most of the time until the end in one step
   real(wp), parameter :: longest_step = 1.0_wp/64.0_wp
   !> Least share of a normal along z that looks away from a face
   real(wp), parameter :: least_slope = 1.0e-6_wp

contains

   !> Follow an impactor until it touches or the run ends
   pure type(approach_type) function find_approach(model, contact) result(approach)
      type(model_type), intent(in) :: model
      !> The impactor and the face
      type(contact_type), intent(in) :: contact

      type(target_type) :: target
      real(wp) :: gap, next, now, place(3)
      integer :: step

      associate (own => model%impactors(contact%impactor), end_time => model%control%end_time)
         approach%is_known = all(own%motion == 0)
         if (.not. approach%is_known) return
         target = new_target(model, contact)
         now = 0.0_wp
         approach%centre(:) = own%centre
         do step = 1, max_steps
            call find_target_gap(own, approach%centre, target, gap, approach%is_at_edge)
            approach%arrives = gap <= least_gap*own%body%radius
            if (approach%arrives .or. now >= end_time) exit
            next = min(end_time, now + longest_step*end_time)
            do
               ! free flight
               place(:) = own%centre + next*(own%velocity + 0.5_wp*next*own%gravity)
               if (norm2(place - approach%centre) <= max(gap, least_gap*own%body%radius)) exit
               next = 0.5_wp*(now + next)
            end do
            approach%distance = approach%distance + norm2(place - approach%centre)
            approach%centre(:) = place
            now = next
         end do
         approach%time = now
      end associate
   end function find_approach

   !> The plate, as an impactor meets it
   pure type(target_type) function new_target(model, contact) result(target)
      type(model_type), intent(in) :: model
      type(contact_type), intent(in) :: contact

      type(contact_face_type) :: face
      integer :: f

      face = new_contact_face(model, contact)
      target%side = contact%face
      target%point = face_points(model, face)
      allocate (target%corner(2, 4, size(face%facet, 2)))
      do f = 1, size(face%facet, 2)
         target%corner(:, :, f) = model%mesh%position(:2, face%facet(:4, f))
      end do
      target%face = contact%face*maxval(contact%face*target%point(3, :))
      ! bricks have no thickness of their own, but nodes on the other face
      target%back = contact%face*minval(contact%face*model%mesh%position(3, :)) + face%height &
         & - contact%face*sum(model%parts(1)%plies%thickness)
   end function new_target

   !> Gap between an impactor and the plate; whether it is that to the edge
   pure subroutine find_target_gap(own, centre, target, gap, is_at_edge)
      type(impactor_type), intent(in) :: own
      !> Its centre, length
      real(wp), intent(in) :: centre(3)
      type(target_type), intent(in) :: target
      !> Length
      real(wp), intent(out) :: gap
      logical, intent(out) :: is_at_edge

      real(wp) :: height(4), normal(3), other, tip(3)
      integer :: h, i

      is_at_edge = .false.
      tip(:) = centre + own%body%lowest_point(target%side)
      if (target%side*(tip(3) - target%face) >= 0.0_wp .and. is_above(target, tip(:2))) then
         gap = target%side*(tip(3) - target%face)
         return
      end if
      ! along the line between face and edge, and where the edge may come nearest
      height(:) = [target%face, clamped(target, centre(3)), clamped(target, tip(3)), target%back]
      gap = huge(1.0_wp)
      do i = 1, size(target%point, 2)
         do h = 1, size(height)
            call own%body%find_gap(centre - [target%point(:2, i), height(h)], other, normal)
            if (other >= gap) cycle
            gap = other
            is_at_edge = h > 1 .or. target%side*normal(3) <= least_slope
         end do
      end do
   end subroutine find_target_gap

   !> A height between the faces of the plate, length
   pure real(wp) function clamped(target, height)
      type(target_type), intent(in) :: target
      real(wp), intent(in) :: height

      clamped = min(max(height, min(target%face, target%back)), max(target%face, target%back))
   end function clamped

   !> Whether a place lies above a facet
   pure logical function is_above(target, place)
      type(target_type), intent(in) :: target
      real(wp), intent(in) :: place(2)

      real(wp) :: arm(2), edge(2)
      integer :: f, s

      is_above = .false.
      do f = 1, size(target%corner, 3)
         do s = 1, 4
            edge(:) = target%corner(:, modulo(s, 4) + 1, f) - target%corner(:, s, f)
            arm(:) = place - target%corner(:, s, f)
            if (edge(1)*arm(2) - edge(2)*arm(1) < 0.0_wp) exit
         end do
         is_above = s > 4
         if (is_above) return
      end do
   end function is_above

   !> The face that a contact names
   pure type(contact_face_type) function new_contact_face(model, contact) result(self)
      !> A model with its parts and its mesh
      type(model_type), intent(in) :: model
      !> The contact
      type(contact_type), intent(in) :: contact

      self%facet = faces_of_parts(model%mesh, contact%parts, contact%face)
      ! a deck with errors may have none
      if (size(model%parts) == 0) return
      ! all parts have the same thickness, bricks have none of their own
      associate (part => model%parts(1))
         self%height = sum(part%plies%thickness) &
            & *(part%bottom_offset + merge(1.0_wp, 0.0_wp, contact%face == top_face))
      end associate
   end function new_contact_face

   !> Positions of the nodes of some facets, raised to the face, (3, nodes of all facets), length
   pure function face_points(model, face) result(points)
      !> The model
      type(model_type), intent(in) :: model
      !> The face
      type(contact_face_type), intent(in) :: face
      real(wp), allocatable :: points(:, :)

      points = model%mesh%position(:, reshape(face%facet, [size(face%facet)]))
      points(3, :) = points(3, :) + face%height
   end function face_points

end module plydyn_model_approach
