!> Forces of interfaces: openings at the nodes of a quad, from there to its points, the law, and
!> back again with the transposed steps.
module plydyn_element_interface_kernel
   use plydyn_base_precision, only : lanes, wp
   use plydyn_element_interface, only : face_type, interface_type
   use plydyn_element_interface_axes, only : find_axes, turn_back, turn_in
   implicit none
   private

   public :: add_face_forces

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
      real(wp), intent(inout) :: history(lanes, self%law%histories, self%side**2, &
         & size(self%node, 2))
      !> Force on all points
      real(wp), intent(inout), contiguous :: force(:)

      real(wp) :: axes(lanes, 3, 3, most), jump(lanes, 3, most), middle(lanes, 3, most)
      integer :: e

      do e = quads(1), quads(2)
         call gather(self, self%node(:, e), -1.0_wp, displacement, jump)
         if (.not. self%nodal) call to_points(self%side, self%reach, jump)
         if (large) then
            call gather(self, self%node(:, e), 1.0_wp, displacement, middle)
            if (.not. self%nodal) call to_points(self%side, self%reach, middle)
            call find_axes(self%side, self%metric(:, :, e), middle, axes)
            call turn_in(self%side**2, axes, jump)
         end if
         call resist(self, self%metric(:, :, e), history(:, :, :, e), jump)
         if (large) call turn_back(self%side**2, axes, jump)
         if (.not. self%nodal) call to_nodes(self%side, self%reach, jump)
         call scatter(self, self%target(:, e), jump, force)
      end do
   end subroutine add_face_forces

   !> Openings at the points to tractions times area
   pure subroutine resist(self, metric, history, jump)
      !> The interfaces
      type(interface_type), intent(in) :: self
      !> Geometry of the points
      real(wp), intent(in) :: metric(5, self%side**2)
      !> History of the points
      real(wp), intent(inout) :: history(lanes, self%law%histories, self%side**2)
      !> Opening in, force out
      real(wp), intent(inout) :: jump(lanes, 3, most)

      real(wp) :: traction(lanes, 3, most)
      integer :: c, l, q

      call self%law%update_points(self%side**2, jump, history, traction)
      do q = 1, self%side**2
         do c = 1, 3
            !$omp simd
            do l = 1, lanes
               jump(l, c, q) = metric(5, q)*traction(l, c, q)
            end do
         end do
      end do
   end subroutine resist

   !> Displacement of the upper face plus or minus that of the lower, at the nodes of a quad
   pure subroutine gather(self, node, sign, displacement, both)
      !> The interfaces
      type(interface_type), intent(in) :: self
      !> Nodes of the quad
      integer, intent(in) :: node(:)
      !> 1 or -1
      real(wp), intent(in) :: sign
      !> Displacement of all points
      real(wp), intent(in), contiguous :: displacement(:)
      !> Sum or difference; 0 in lanes without an interface
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
   end subroutine gather

   !> The same where the places of a face do not lie side by side
   pure subroutine gather_apart(self, node, sign, displacement, both)
      !> The interfaces
      type(interface_type), intent(in) :: self
      !> Nodes of the quad
      integer, intent(in) :: node(:)
      !> 1 or -1
      real(wp), intent(in) :: sign
      !> Displacement of all points
      real(wp), intent(in), contiguous :: displacement(:)
      !> Sum or difference
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
   pure subroutine scatter(self, node, both, force)
      !> The interfaces
      type(interface_type), intent(in) :: self
      !> Columns that take the forces
      integer, intent(in) :: node(:)
      !> Force that pulls the faces together; 0 in lanes without an interface
      real(wp), intent(in) :: both(lanes, 3, size(node))
      !> Force on all points
      real(wp), intent(inout), contiguous :: force(:)

      real(wp) :: high, low
      integer :: above, below, c, i, l

      if (.not. self%adjacent) then
         call scatter_apart(self, node, both, force)
         return
      end if
      do i = 1, size(node)
         above = self%above%first(1) + self%above%step(1)*(node(i) - 1) - 1
         below = self%below%first(1) + self%below%step(1)*(node(i) - 1) - 1
         do c = 1, 3
            ! both are read before either is written: faces of order 1 share a place, that of a last
            ! lane above without an interface, which leaves it as it was: first
            !$omp simd private(high, low)
            do l = 1, lanes
               high = force(above + l) - both(l, c, i)
               low = force(below + l) + both(l, c, i)
               force(above + l) = high
               force(below + l) = low
            end do
            above = above + self%above%stride(1)
            below = below + self%below%stride(1)
         end do
      end do
   end subroutine scatter

   !> The same where the places of a face do not lie side by side
   pure subroutine scatter_apart(self, node, both, force)
      !> The interfaces
      type(interface_type), intent(in) :: self
      !> Nodes of the quad
      integer, intent(in) :: node(:)
      !> Force that pulls the faces together
      real(wp), intent(in) :: both(lanes, 3, size(node))
      !> Force on all points
      real(wp), intent(inout), contiguous :: force(:)

      integer :: above, below, c, i, l

      do i = 1, size(node)
         do c = 1, 3
            do l = 1, lanes
               if (self%lower(l) == 0) cycle
               above = place(self%above, l, node(i), c)
               below = place(self%below, l, node(i), c)
               force(below) = force(below) + both(l, c, i)
               force(above) = force(above) - both(l, c, i)
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

   !> Values at the nodes to values at the Gauss points, in place
   pure subroutine to_points(side, reach, value)
      !> Nodes along a side
      integer, intent(in) :: side
      !> Distance of the outer points from the middle
      real(wp), intent(in) :: reach
      !> Values
      real(wp), intent(inout) :: value(lanes, 3, side**2)

      real(wp) :: v1, v2, v3, v4, v5, v6, v7, v8, v9
      integer :: c, l

      if (side == 2) then
         call blend_four(reach, value)
         return
      end if
      do c = 1, 3
         !$omp simd private(v1, v2, v3, v4, v5, v6, v7, v8, v9)
         do l = 1, lanes
            v1 = value(l, c, 1)
            v2 = value(l, c, 2)
            v3 = value(l, c, 3)
            v4 = value(l, c, 4)
            v5 = value(l, c, 5)
            v6 = value(l, c, 6)
            v7 = value(l, c, 7)
            v8 = value(l, c, 8)
            v9 = value(l, c, 9)
            call spread_line(reach, v1, v2, v3)
            call spread_line(reach, v4, v5, v6)
            call spread_line(reach, v7, v8, v9)
            call spread_line(reach, v1, v4, v7)
            call spread_line(reach, v2, v5, v8)
            call spread_line(reach, v3, v6, v9)
            value(l, c, 1) = v1
            value(l, c, 2) = v2
            value(l, c, 3) = v3
            value(l, c, 4) = v4
            value(l, c, 6) = v6
            value(l, c, 7) = v7
            value(l, c, 8) = v8
            value(l, c, 9) = v9
         end do
      end do
   end subroutine to_points

   !> Transposed of `to_points`: forces at the Gauss points to forces at the nodes
   pure subroutine to_nodes(side, reach, value)
      !> Nodes along a side
      integer, intent(in) :: side
      !> Distance of the outer points from the middle
      real(wp), intent(in) :: reach
      !> Forces
      real(wp), intent(inout) :: value(lanes, 3, side**2)

      real(wp) :: v1, v2, v3, v4, v5, v6, v7, v8, v9
      integer :: c, l

      if (side == 2) then
         call blend_four(reach, value)
         return
      end if
      do c = 1, 3
         !$omp simd private(v1, v2, v3, v4, v5, v6, v7, v8, v9)
         do l = 1, lanes
            v1 = value(l, c, 1)
            v2 = value(l, c, 2)
            v3 = value(l, c, 3)
            v4 = value(l, c, 4)
            v5 = value(l, c, 5)
            v6 = value(l, c, 6)
            v7 = value(l, c, 7)
            v8 = value(l, c, 8)
            v9 = value(l, c, 9)
            call gather_line(reach, v1, v4, v7)
            call gather_line(reach, v2, v5, v8)
            call gather_line(reach, v3, v6, v9)
            call gather_line(reach, v1, v2, v3)
            call gather_line(reach, v4, v5, v6)
            call gather_line(reach, v7, v8, v9)
            value(l, c, 1) = v1
            value(l, c, 2) = v2
            value(l, c, 3) = v3
            value(l, c, 4) = v4
            value(l, c, 5) = v5
            value(l, c, 6) = v6
            value(l, c, 7) = v7
            value(l, c, 8) = v8
            value(l, c, 9) = v9
         end do
      end do
   end subroutine to_nodes

   !> Either of the two for a quad of four nodes
   pure subroutine blend_four(reach, value)
      !> Distance of the points from the middle
      real(wp), intent(in) :: reach
      !> Values
      real(wp), intent(inout) :: value(lanes, 3, 4)

      real(wp) :: v1, v2, v3, v4
      integer :: c, l

      do c = 1, 3
         !$omp simd private(v1, v2, v3, v4)
         do l = 1, lanes
            v1 = value(l, c, 1)
            v2 = value(l, c, 2)
            v3 = value(l, c, 3)
            v4 = value(l, c, 4)
            call blend(reach, v1, v2)
            call blend(reach, v3, v4)
            call blend(reach, v1, v3)
            call blend(reach, v2, v4)
            value(l, c, 1) = v1
            value(l, c, 2) = v2
            value(l, c, 3) = v3
            value(l, c, 4) = v4
         end do
      end do
   end subroutine blend_four

   !> Values at the ends of a line to those at its two Gauss points; its own transposed
   pure subroutine blend(reach, first, last)
      !> Distance of the points from the middle
      real(wp), intent(in) :: reach
      !> Values
      real(wp), intent(inout) :: first, last
      real(wp) :: even, odd

      even = 0.5_wp*(last + first)
      odd = 0.5_wp*reach*(last - first)
      first = even - odd
      last = even + odd
   end subroutine blend

   !> Values at three nodes of a line to those at its three Gauss points; the middle one stays
   pure subroutine spread_line(reach, first, middle, last)
      !> Distance of the outer points from the middle
      real(wp), intent(in) :: reach
      !> Values
      real(wp), intent(inout) :: first, last
      !> Value in the middle
      real(wp), intent(in) :: middle
      real(wp) :: even, odd

      even = middle + 0.5_wp*reach**2*((last + first) - 2.0_wp*middle)
      odd = 0.5_wp*reach*(last - first)
      first = even - odd
      last = even + odd
   end subroutine spread_line

   !> Transposed of `spread_line`
   pure subroutine gather_line(reach, first, middle, last)
      !> Distance of the outer points from the middle
      real(wp), intent(in) :: reach
      !> Forces
      real(wp), intent(inout) :: first, middle, last
      real(wp) :: even, odd

      even = last + first
      odd = 0.5_wp*reach*(last - first)
      middle = middle + (1.0_wp - reach**2)*even
      first = 0.5_wp*reach**2*even - odd
      last = 0.5_wp*reach**2*even + odd
   end subroutine gather_line

end module plydyn_element_interface_kernel
