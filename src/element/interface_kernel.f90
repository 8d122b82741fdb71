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
   !> Numbers of a point: three components of all lanes
   integer, parameter :: width = 3*lanes

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
      real(wp), intent(inout) :: jump(lanes, 3, self%side**2)

      real(wp) :: traction(lanes, 3)
      integer :: q

      do q = 1, self%side**2
         call self%law%update(jump(:, :, q), history(:, :, q), traction)
         jump(:, :, q) = metric(5, q)*traction
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

      integer :: above, below, c, i, l

      if (.not. self%adjacent) then
         call scatter_apart(self, node, both, force)
         return
      end if
      do i = 1, size(node)
         above = self%above%first(1) + self%above%step(1)*(node(i) - 1) - 1
         below = self%below%first(1) + self%below%step(1)*(node(i) - 1) - 1
         do c = 1, 3
            !$omp simd
            do l = 1, lanes
               force(below + l) = force(below + l) + both(l, c, i)
            end do
            !$omp simd
            do l = 1, lanes
               force(above + l) = force(above + l) - both(l, c, i)
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
      real(wp), intent(inout) :: value(width, side, side)
      integer :: k

      if (side == 2) then
         do k = 1, side
            call blend(reach, value(:, 1, k), value(:, 2, k))
         end do
         do k = 1, side
            call blend(reach, value(:, k, 1), value(:, k, 2))
         end do
      else
         do k = 1, side
            call spread_line(reach, value(:, 1, k), value(:, 2, k), value(:, 3, k))
         end do
         do k = 1, side
            call spread_line(reach, value(:, k, 1), value(:, k, 2), value(:, k, 3))
         end do
      end if
   end subroutine to_points

   !> Transposed of `to_points`: forces at the Gauss points to forces at the nodes
   pure subroutine to_nodes(side, reach, value)
      !> Nodes along a side
      integer, intent(in) :: side
      !> Distance of the outer points from the middle
      real(wp), intent(in) :: reach
      !> Forces
      real(wp), intent(inout) :: value(width, side, side)
      integer :: k

      if (side == 2) then
         do k = 1, side
            call blend(reach, value(:, k, 1), value(:, k, 2))
         end do
         do k = 1, side
            call blend(reach, value(:, 1, k), value(:, 2, k))
         end do
      else
         do k = 1, side
            call gather_line(reach, value(:, k, 1), value(:, k, 2), value(:, k, 3))
         end do
         do k = 1, side
            call gather_line(reach, value(:, 1, k), value(:, 2, k), value(:, 3, k))
         end do
      end if
   end subroutine to_nodes

   !> Values at the ends of a line to those at its two Gauss points; its own transposed
   pure subroutine blend(reach, first, last)
      !> Distance of the points from the middle
      real(wp), intent(in) :: reach
      !> Values
      real(wp), intent(inout) :: first(width), last(width)
      real(wp) :: even, odd
      integer :: l

      !$omp simd private(even, odd)
      do l = 1, width
         even = 0.5_wp*(last(l) + first(l))
         odd = 0.5_wp*reach*(last(l) - first(l))
         first(l) = even - odd
         last(l) = even + odd
      end do
   end subroutine blend

   !> Values at three nodes of a line to those at its three Gauss points; the middle one stays
   pure subroutine spread_line(reach, first, middle, last)
      !> Distance of the outer points from the middle
      real(wp), intent(in) :: reach
      !> Values
      real(wp), intent(inout) :: first(width), last(width)
      !> Value in the middle
      real(wp), intent(in) :: middle(width)
      real(wp) :: even, odd
      integer :: l

      !$omp simd private(even, odd)
      do l = 1, width
         even = middle(l) + 0.5_wp*reach**2*((last(l) + first(l)) - 2.0_wp*middle(l))
         odd = 0.5_wp*reach*(last(l) - first(l))
         first(l) = even - odd
         last(l) = even + odd
      end do
   end subroutine spread_line

   !> Transposed of `spread_line`
   pure subroutine gather_line(reach, first, middle, last)
      !> Distance of the outer points from the middle
      real(wp), intent(in) :: reach
      !> Forces
      real(wp), intent(inout) :: first(width), middle(width), last(width)
      real(wp) :: even, odd
      integer :: l

      !$omp simd private(even, odd)
      do l = 1, width
         even = last(l) + first(l)
         odd = 0.5_wp*reach*(last(l) - first(l))
         middle(l) = middle(l) + (1.0_wp - reach**2)*even
         first(l) = 0.5_wp*reach**2*even - odd
         last(l) = 0.5_wp*reach**2*even + odd
      end do
   end subroutine gather_line

end module plydyn_element_interface_kernel
