!> Forces of interfaces: openings at the nodes of a quad, from there to its points, the law, and
!> back again with the transposed steps. With large displacement so do the slopes of the mid-face.
module plydyn_element_interface_kernel
   use plydyn_base_precision, only : lanes, wp
   use plydyn_element_interface_interfaces, only : face_type, interface_type
   use plydyn_element_interface_axes, only : find_axes, rotate_back, rotate_in
   use plydyn_element_interface_points, only : to_nodes, to_points
   use plydyn_element_interface_rotation, only : find_moment_forces
   implicit none
   private

   public :: add_face_forces, gather

   !> Points of the largest quad: work space of fixed size can be aligned
   integer, parameter :: most = 9

contains

   !> Subtract the forces of interfaces over some quads on both faces
   pure subroutine add_face_forces(self, quads, large, displacement, history, force)
      !> The interfaces
      type(interface_type), intent(in) :: self
      !> First and last quad
      integer, intent(in) :: quads(2)
      !> Large displacement (total Lagrangian) instead of linear kinematics
      logical, intent(in) :: large
      !> Displacement of all points
      real(wp), intent(in), contiguous :: displacement(:)
      !> History of these interfaces, old in and new out
      real(wp), intent(inout) :: history(lanes, size(self%node), *)
      !> Force on all points
      real(wp), intent(inout), contiguous :: force(:)

      real(wp) :: jump(lanes, 3, most)
      integer :: e, row

      do e = quads(1), quads(2)
         row = 1 + size(self%node, 1)*(e - 1)
         call gather(self, e, -1.0_wp, displacement, jump)
         if (.not. self%nodal) call to_points(self%side, jump)
         if (large) then
            call add_corotational_forces(self, e, displacement, history(1, row, 1), jump, force)
            cycle
         end if
         call find_point_forces(self, e, history(1, row, 1), jump)
         if (.not. self%nodal) call to_nodes(self%side, jump)
         call scatter(self, e, jump, jump, force)
      end do
   end subroutine add_face_forces

   !> The same over a quad with large displacement: the law works in axes that turn with the face
   pure subroutine add_corotational_forces(self, quad, displacement, history, jump, force)
      !> The interfaces
      type(interface_type), intent(in) :: self
      !> The quad
      integer, intent(in) :: quad
      !> Displacement of all points
      real(wp), intent(in), contiguous :: displacement(:)
      !> History from the first of the points on
      real(wp), intent(inout) :: history(lanes, size(self%node), *)
      !> Opening at the points in; work space out
      real(wp), intent(inout) :: jump(lanes, 3, most)
      !> Force on all points
      real(wp), intent(inout), contiguous :: force(:)

      real(wp) :: axes(lanes, 3, 3, most), stretch(lanes, 3, most)
      real(wp), dimension(lanes, 3, most) :: middle, point_force, moment_force
      integer :: c, first, l, last, points, q

      points = size(self%node, 1)
      associate (side => self%side, metric => self%metric(:, :, quad))
         call gather(self, quad, 1.0_wp, displacement, middle)
         if (.not. self%nodal) call to_points(side, middle)
         ! in crack zones one half of all corners after the other
         do first = 1, points, side**2
            last = first + side**2 - 1
            call find_axes(side, metric(:, first:last), middle(:, :, first:last), &
               & axes(:, :, :, first:last), stretch(:, :, first:last))
         end do
         call rotate_in(points, axes, jump)
         point_force(:, :, :points) = jump(:, :, :points)
         call find_point_forces(self, quad, history, point_force)
         do first = 1, points, side**2
            last = first + side**2 - 1
            call find_moment_forces(side, metric(:, first:last), axes(:, :, :, first:last), &
               & stretch(:, :, first:last), jump(:, :, first:last), point_force(:, :, first:last), &
               & moment_force(:, :, first:last))
         end do
         call rotate_back(points, axes, point_force)
         if (.not. self%nodal) call to_nodes(side, point_force)
         if (.not. self%nodal) call to_nodes(side, moment_force)
         do q = 1, points
            do c = 1, 3
               !$omp simd
               do l = 1, lanes
                  middle(l, c, q) = point_force(l, c, q) + moment_force(l, c, q)
                  jump(l, c, q) = point_force(l, c, q) - moment_force(l, c, q)
               end do
            end do
         end do
      end associate
      call scatter(self, quad, middle, jump, force)
   end subroutine add_corotational_forces

   !> Openings at the points to tractions times area
   pure subroutine find_point_forces(self, quad, history, jump)
      !> The interfaces
      type(interface_type), intent(in) :: self
      !> The quad
      integer, intent(in) :: quad
      !> History from the first of the points on
      real(wp), intent(inout) :: history(lanes, size(self%node), *)
      !> Opening in, force out
      real(wp), intent(inout) :: jump(lanes, 3, most)

      real(wp) :: traction(lanes, 3, most)
      integer :: c, l, q

      if (allocated(self%weakness)) then
         call self%law%update_points(size(self%node, 1), size(self%node), jump, history, traction, &
            & self%weakness(:, :, quad))
      else
         call self%law%update_points(size(self%node, 1), size(self%node), jump, history, traction)
      end if
      do q = 1, size(self%node, 1)
         do c = 1, 3
            !$omp simd
            do l = 1, lanes
               jump(l, c, q) = self%metric(5, q, quad)*traction(l, c, q)
            end do
         end do
      end do
   end subroutine find_point_forces

   !> Displacement of the upper face plus or minus that of the lower, at the nodes of a quad
   pure subroutine gather(self, quad, sign, displacement, both)
      !> The interfaces
      type(interface_type), intent(in) :: self
      !> The quad
      integer, intent(in) :: quad
      !> 1 or -1
      real(wp), intent(in) :: sign
      !> Displacement of all points
      real(wp), intent(in), contiguous :: displacement(:)
      !> Sum or difference; 0 in lanes without an interface
      real(wp), intent(out) :: both(lanes, 3, *)

      if (allocated(self%sees)) then
         call gather_parted(self, quad, sign, displacement, both)
      else
         call gather_nodes(self, self%node(:, quad), sign, displacement, both)
      end if
   end subroutine gather

   !> The same where each node has one column
   pure subroutine gather_nodes(self, node, sign, displacement, both)
      !> As in `gather`
      type(interface_type), intent(in) :: self
      !> Nodes of the quad
      integer, intent(in) :: node(:)
      real(wp), intent(in) :: sign
      real(wp), intent(in), contiguous :: displacement(:)
      real(wp), intent(out) :: both(lanes, 3, size(node))

      integer :: above, below, c, i, l

      if (.not. self%adjacent) then
         call gather_apart(self, node, sign, displacement, both)
         return
      end if
      do i = 1, size(node)
         above = self%above%first(1) + self%above%step(1)*(node(i) - 1) - 1
         below = self%below%first(1) + self%below%step(1)*(node(i) - 1) - 1
         do c = 1, 3
            !$omp simd
            do l = 1, lanes
               both(l, c, i) = self%present(l)*(displacement(above + l) &
                  & + sign*displacement(below + l))
            end do
            above = above + self%above%stride(1)
            below = below + self%below%stride(1)
         end do
      end do
   end subroutine gather_nodes

   !> The same where a node may have a twin
   pure subroutine gather_parted(self, quad, sign, displacement, both)
      !> As in `gather`
      type(interface_type), intent(in) :: self
      integer, intent(in) :: quad
      real(wp), intent(in) :: sign
      real(wp), intent(in), contiguous :: displacement(:)
      real(wp), intent(out) :: both(lanes, 3, *)

      integer :: above(2), below(2), c, i, l

      do i = 1, size(self%node, 1)
         associate (columns => [self%node(i, quad), self%twin(i, quad)])
            above(:) = self%above%first(1) + self%above%step(1)*(columns - 1) - 1
            below(:) = self%below%first(1) + self%below%step(1)*(columns - 1) - 1
         end associate
         do c = 1, 3
            !$omp simd
            do l = 1, lanes
               both(l, c, i) = self%present(l)*(merge(displacement(above(2) + l), &
                  & displacement(above(1) + l), self%sees(l, i, 2, quad) > 0.0_wp) &
                  & + sign*merge(displacement(below(2) + l), displacement(below(1) + l), &
                  & self%sees(l, i, 1, quad) > 0.0_wp))
            end do
            above(:) = above + self%above%stride(1)
            below(:) = below + self%below%stride(1)
         end do
      end do
   end subroutine gather_parted

   !> The same where the places of a face do not lie side by side
   pure subroutine gather_apart(self, node, sign, displacement, both)
      !> As in `gather`
      type(interface_type), intent(in) :: self
      integer, intent(in) :: node(:)
      real(wp), intent(in) :: sign
      real(wp), intent(in), contiguous :: displacement(:)
      real(wp), intent(out) :: both(lanes, 3, size(node))

      integer :: c, i, l

      do i = 1, size(node)
         do c = 1, 3
            do l = 1, lanes
               both(l, c, i) = 0.0_wp
               if (self%lower(l) == 0) cycle
               both(l, c, i) = displacement(place(self%above, l, node(i), c)) &
                  & + sign*displacement(place(self%below, l, node(i), c))
            end do
         end do
      end do
   end subroutine gather_apart

   !> Subtract forces from those on the upper face, and add them to those on the lower
   pure subroutine scatter(self, quad, from_upper, to_lower, force)
      !> The interfaces
      type(interface_type), intent(in) :: self
      !> The quad
      integer, intent(in) :: quad
      !> Force from the upper face and force to the lower; 0 in lanes without an interface
      real(wp), intent(in), dimension(lanes, 3, *) :: from_upper, to_lower
      !> Force on all points
      real(wp), intent(inout), contiguous :: force(:)

      if (allocated(self%sees)) then
         call scatter_parted(self, quad, from_upper, to_lower, force)
      else
         call scatter_nodes(self, self%target(:, quad), from_upper, to_lower, force)
      end if
   end subroutine scatter

   !> The same where each node has one column
   pure subroutine scatter_nodes(self, node, from_upper, to_lower, force)
      !> As in `scatter`
      type(interface_type), intent(in) :: self
      !> Columns that take the forces
      integer, intent(in) :: node(:)
      real(wp), intent(in), dimension(lanes, 3, size(node)) :: from_upper, to_lower
      real(wp), intent(inout), contiguous :: force(:)

      integer :: above, below, c, i, l
      real(wp) :: high(lanes), low(lanes)

      if (.not. self%adjacent) then
         call scatter_apart(self, node, from_upper, to_lower, force)
         return
      end if
      do i = 1, size(node)
         below = self%below%first(1) + self%below%step(1)*(node(i) - 1) - 1
         above = self%above%first(1) + self%above%step(1)*(node(i) - 1) - 1
         do c = 1, 3
            ! all are read before any is written: faces of order 1 share a place, that of a last
            ! lane above without an interface, which leaves it as it was: first
            !$omp simd
            do l = 1, lanes
               high(l) = force(above + l) - from_upper(l, c, i)
               low(l) = force(below + l) + to_lower(l, c, i)
            end do
            !$omp simd
            do l = 1, lanes
               force(above + l) = high(l)
            end do
            !$omp simd
            do l = 1, lanes
               force(below + l) = low(l)
            end do
            above = above + self%above%stride(1)
            below = below + self%below%stride(1)
         end do
      end do
   end subroutine scatter_nodes

   !> The same where a node may have a twin
   pure subroutine scatter_parted(self, quad, from_upper, to_lower, force)
      !> As in `scatter`
      type(interface_type), intent(in) :: self
      integer, intent(in) :: quad
      real(wp), intent(in), dimension(lanes, 3, *) :: from_upper, to_lower
      real(wp), intent(inout), contiguous :: force(:)

      integer :: above(2), below(2), c, i, l
      real(wp) :: share

      do i = 1, size(self%node, 1)
         associate (columns => [self%target(i, quad), self%twin_target(i, quad)])
            above(:) = self%above%first(1) + self%above%step(1)*(columns - 1) - 1
            below(:) = self%below%first(1) + self%below%step(1)*(columns - 1) - 1
         end associate
         do c = 1, 3
            do l = 1, lanes
               share = self%sees(l, i, 1, quad)
               force(below(1) + l) = force(below(1) + l) + (1.0_wp - share)*to_lower(l, c, i)
               force(below(2) + l) = force(below(2) + l) + share*to_lower(l, c, i)
            end do
            do l = 1, lanes
               share = self%sees(l, i, 2, quad)
               force(above(1) + l) = force(above(1) + l) - (1.0_wp - share)*from_upper(l, c, i)
               force(above(2) + l) = force(above(2) + l) - share*from_upper(l, c, i)
            end do
            above(:) = above + self%above%stride(1)
            below(:) = below + self%below%stride(1)
         end do
      end do
   end subroutine scatter_parted

   !> The same where the places of a face do not lie side by side
   pure subroutine scatter_apart(self, node, from_upper, to_lower, force)
      !> The interfaces
      type(interface_type), intent(in) :: self
      !> Nodes of the quad
      integer, intent(in) :: node(:)
      !> Force from the upper face and force to the lower
      real(wp), intent(in), dimension(lanes, 3, size(node)) :: from_upper, to_lower
      !> Force on all points
      real(wp), intent(inout), contiguous :: force(:)

      integer :: above, below, c, i, l

      do i = 1, size(node)
         do c = 1, 3
            do l = 1, lanes
               if (self%lower(l) == 0) cycle
               above = place(self%above, l, node(i), c)
               below = place(self%below, l, node(i), c)
               force(below) = force(below) + to_lower(l, c, i)
               force(above) = force(above) - from_upper(l, c, i)
            end do
         end do
      end do
   end subroutine scatter_apart

   !> Place of a node's displacement in one direction
   pure integer function place(face, lane, node, direction)
      !> The face
      type(face_type), intent(in) :: face
      !> Lane
      integer, intent(in) :: lane
      !> Node of the plane
      integer, intent(in) :: node
      !> 1, 2, 3 for x, y, z
      integer, intent(in) :: direction

      place = face%first(lane) + face%stride(lane)*(direction - 1) + face%step(lane)*(node - 1)
   end function place

end module plydyn_element_interface_kernel
