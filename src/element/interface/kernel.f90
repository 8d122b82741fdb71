!> Forces of interfaces: openings at the nodes of a quad, from there to its points, the law, and
!> back again with the transposed steps. With large displacement so do the slopes of the mid-face.
!> And the energy that openings have stored.
module plydyn_element_interface_kernel
   use plydyn_base_exact_sum, only : exact_sums_type
   use plydyn_base_precision, only : lanes, wp
   use plydyn_element_interface_axes, only : find_axes, rotate_back, rotate_in
   use plydyn_element_interface_faces, only : gather, scatter
   use plydyn_element_interface_interfaces, only : interface_type
   use plydyn_element_interface_points, only : to_nodes, to_points
   use plydyn_element_interface_rotation, only : find_moment_forces
   implicit none
   private

   public :: add_face_forces, add_interface_energy

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

      real(wp) :: axes(lanes, 3, 3, most), jump(lanes, 3, most), stretch(lanes, 3, most)
      integer :: e, row

      do e = quads(1), quads(2)
         row = 1 + size(self%node, 1)*(e - 1)
         call find_openings(self, e, large, displacement, jump, axes, stretch)
         if (large) then
            call add_corotational_forces(self, e, history(1, row, 1), axes, stretch, jump, force)
            cycle
         end if
         call find_point_forces(self, e, history(1, row, 1), jump)
         if (.not. self%nodal) call to_nodes(self%side, jump)
         call scatter(self, e, jump, jump, force)
      end do
   end subroutine add_face_forces

   !> Openings at the points of a quad, in the axes of the face if displacements are large
   pure subroutine find_openings(self, quad, large, displacement, jump, axes, stretch)
      !> As in `add_face_forces`
      type(interface_type), intent(in) :: self
      integer, intent(in) :: quad
      logical, intent(in) :: large
      real(wp), intent(in), contiguous :: displacement(:)
      !> Openings; axes of the face and its stretch with large displacement, see `find_axes`
      real(wp), intent(out) :: jump(lanes, 3, most), axes(lanes, 3, 3, most), &
         & stretch(lanes, 3, most)

      real(wp) :: middle(lanes, 3, most)
      integer :: first, last

      call gather(self, quad, displacement, jump, middle)
      if (.not. self%nodal) call to_points(self%side, jump)
      if (.not. large) return
      if (.not. self%nodal) call to_points(self%side, middle)
      ! in crack zones one half of all corners after the other
      do first = 1, size(self%node, 1), self%side**2
         last = first + self%side**2 - 1
         call find_axes(self%side, self%metric(:, first:last, quad), middle(:, :, first:last), &
            & axes(:, :, :, first:last), stretch(:, :, first:last))
      end do
      call rotate_in(size(self%node, 1), axes, jump)
   end subroutine find_openings

   !> The same over a quad with large displacement: the law works in axes that turn with the face
   pure subroutine add_corotational_forces(self, quad, history, axes, stretch, jump, force)
      !> As in `find_point_forces`
      type(interface_type), intent(in) :: self
      integer, intent(in) :: quad
      real(wp), intent(inout) :: history(lanes, size(self%node), *)
      !> From `find_openings`
      real(wp), intent(in) :: axes(lanes, 3, 3, most), stretch(lanes, 3, most)
      !> Openings from there in, work space out
      real(wp), intent(inout) :: jump(lanes, 3, most)
      !> Force on all points
      real(wp), intent(inout), contiguous :: force(:)

      real(wp), dimension(lanes, 3, most) :: from_upper, point_force, moment_force
      integer :: c, first, l, last, points, q

      points = size(self%node, 1)
      associate (side => self%side)
         point_force(:, :, :points) = jump(:, :, :points)
         call find_point_forces(self, quad, history, point_force)
         do first = 1, points, side**2
            last = first + side**2 - 1
            call find_moment_forces(side, self%metric(:, first:last, quad), &
               & axes(:, :, :, first:last), stretch(:, :, first:last), jump(:, :, first:last), &
               & point_force(:, :, first:last), moment_force(:, :, first:last))
         end do
         call rotate_back(points, axes, point_force)
         if (.not. self%nodal) call to_nodes(side, point_force)
         if (.not. self%nodal) call to_nodes(side, moment_force)
         do q = 1, points
            do c = 1, 3
               !$omp simd
               do l = 1, lanes
                  from_upper(l, c, q) = point_force(l, c, q) + moment_force(l, c, q)
                  jump(l, c, q) = point_force(l, c, q) - moment_force(l, c, q)
               end do
            end do
         end do
      end associate
      call scatter(self, quad, from_upper, jump, force)
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

   !> Add the stored energy of interfaces over some quads, quad by quad
   pure subroutine add_interface_energy(self, elements, large, displacement, history, sums)
      !> The interfaces
      type(interface_type), intent(in) :: self
      !> First and last quad
      integer, intent(in) :: elements(2)
      !> Large displacement
      logical, intent(in) :: large
      !> Displacement of all points
      real(wp), intent(in), contiguous :: displacement(:)
      !> History of these interfaces
      real(wp), intent(in) :: history(lanes, size(self%node, 1), size(self%node, 2), &
         & self%law%histories)
      !> Sums, the first of which gets the energies
      type(exact_sums_type), intent(inout) :: sums

      real(wp), dimension(lanes, 3, most) :: opening, stretch
      real(wp) :: axes(lanes, 3, 3, most), energy
      integer :: e, q

      do e = elements(1), elements(2)
         call find_openings(self, e, large, displacement, opening, axes, stretch)
         energy = 0.0_wp
         do q = 1, size(self%node, 1)
            energy = energy + self%metric(5, q, e)*sum(self%present &
               & *self%law%stored_energy(opening(:, :, q), history(:, q, e, :)))
         end do
         call sums%add(1, energy)
      end do
   end subroutine add_interface_energy

end module plydyn_element_interface_kernel
