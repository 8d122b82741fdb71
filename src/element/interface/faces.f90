!> Displacements of both faces of interfaces, and forces on them: what a quad reads and writes.
module plydyn_element_interface_faces
   use plydyn_base_precision, only : lanes, wp
   use plydyn_element_interface_interfaces, only : face_type, interface_type
   implicit none
   private

   public :: gather, scatter

contains

   !> Opening at the nodes of a quad, and the sum of the displacements of both faces
   pure subroutine gather(self, quad, displacement, jump, middle)
      !> The interfaces
      type(interface_type), intent(in) :: self
      !> The quad
      integer, intent(in) :: quad
      !> Displacement of all points
      real(wp), intent(in), contiguous :: displacement(:)
      !> Displacement of the upper face less that of the lower, and their sum; 0 in lanes without an
      !> interface
      real(wp), intent(out), dimension(lanes, 3, *) :: jump, middle

      if (allocated(self%sees)) then
         call gather_parted(self, quad, displacement, jump, middle)
      else if (self%adjacent) then
         call gather_nodes(self, self%node(:, quad), displacement, jump, middle)
      else
         call gather_apart(self, self%node(:, quad), displacement, jump, middle)
      end if
   end subroutine gather

   !> The same where each node has one column
   pure subroutine gather_nodes(self, node, displacement, jump, middle)
      !> As in `gather`
      type(interface_type), intent(in) :: self
      !> Nodes of the quad
      integer, intent(in) :: node(:)
      real(wp), intent(in), contiguous :: displacement(:)
      real(wp), intent(out), dimension(lanes, 3, size(node)) :: jump, middle

      integer :: above, below, c, i, l

      do i = 1, size(node)
         above = self%above%first(1) + self%above%step(1)*(node(i) - 1) - 1
         below = self%below%first(1) + self%below%step(1)*(node(i) - 1) - 1
         do c = 1, 3
            !$omp simd
            do l = 1, lanes
               jump(l, c, i) = self%present(l)*(displacement(above + l) - displacement(below + l))
               middle(l, c, i) = self%present(l)*(displacement(above + l) + displacement(below + l))
            end do
            above = above + self%above%stride(1)
            below = below + self%below%stride(1)
         end do
      end do
   end subroutine gather_nodes

   !> The same where a node may have a twin
   pure subroutine gather_parted(self, quad, displacement, jump, middle)
      !> As in `gather`
      type(interface_type), intent(in) :: self
      integer, intent(in) :: quad
      real(wp), intent(in), contiguous :: displacement(:)
      real(wp), intent(out), dimension(lanes, 3, *) :: jump, middle

      real(wp) :: high, low
      integer :: above(2), below(2), c, i, l

      do i = 1, size(self%node, 1)
         associate (columns => [self%node(i, quad), self%twin(i, quad)])
            above(:) = self%above%first(1) + self%above%step(1)*(columns - 1) - 1
            below(:) = self%below%first(1) + self%below%step(1)*(columns - 1) - 1
         end associate
         do c = 1, 3
            !$omp simd private(high, low)
            do l = 1, lanes
               high = merge(displacement(above(2) + l), displacement(above(1) + l), &
                  & self%sees(l, i, 2, quad) > 0.0_wp)
               low = merge(displacement(below(2) + l), displacement(below(1) + l), &
                  & self%sees(l, i, 1, quad) > 0.0_wp)
               jump(l, c, i) = self%present(l)*(high - low)
               middle(l, c, i) = self%present(l)*(high + low)
            end do
            above(:) = above + self%above%stride(1)
            below(:) = below + self%below%stride(1)
         end do
      end do
   end subroutine gather_parted

   !> The same where the places of a face do not lie side by side
   pure subroutine gather_apart(self, node, displacement, jump, middle)
      !> As in `gather`
      type(interface_type), intent(in) :: self
      integer, intent(in) :: node(:)
      real(wp), intent(in), contiguous :: displacement(:)
      real(wp), intent(out), dimension(lanes, 3, size(node)) :: jump, middle

      integer :: c, i, l

      jump(:, :, :) = 0.0_wp
      middle(:, :, :) = 0.0_wp
      do i = 1, size(node)
         do c = 1, 3
            do l = 1, lanes
               if (self%lower(l) == 0) cycle
               associate (high => displacement(place(self%above, l, node(i), c)), &
                  & low => displacement(place(self%below, l, node(i), c)))
                  jump(l, c, i) = high - low
                  middle(l, c, i) = high + low
               end associate
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
      else if (self%adjacent) then
         call scatter_nodes(self, self%target(:, quad), from_upper, to_lower, force)
      else
         call scatter_apart(self, self%target(:, quad), from_upper, to_lower, force)
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

      integer :: above(2), below(2), c, i

      do i = 1, size(self%node, 1)
         associate (columns => [self%target(i, quad), self%twin_target(i, quad)])
            above(:) = self%above%first(1) + self%above%step(1)*(columns - 1)
            below(:) = self%below%first(1) + self%below%step(1)*(columns - 1)
         end associate
         do c = 1, 3
            call add_parted(1.0_wp, self%sees(:, i, 1, quad), to_lower(:, c, i), below, force)
            call add_parted(-1.0_wp, self%sees(:, i, 2, quad), from_upper(:, c, i), above, force)
            above(:) = above + self%above%stride(1)
            below(:) = below + self%below%stride(1)
         end do
      end do
   end subroutine scatter_parted

   !> Add a force times a sign at a column, or at its twin in the lanes that see that
   pure subroutine add_parted(sign, sees, own, place, force)
      real(wp), intent(in) :: sign, sees(lanes), own(lanes)
      !> First place of the lanes in both columns, which may be the same
      integer, intent(in) :: place(2)
      real(wp), intent(inout), contiguous :: force(:)

      integer :: l

      !$omp simd
      do l = 1, lanes
         force(place(1) + l - 1) = force(place(1) + l - 1) + sign*(1.0_wp - sees(l))*own(l)
      end do
      if (place(1) == place(2)) return
      !$omp simd
      do l = 1, lanes
         force(place(2) + l - 1) = force(place(2) + l - 1) + sign*sees(l)*own(l)
      end do
   end subroutine add_parted

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

end module plydyn_element_interface_faces
