!> Energy that interfaces have stored, from their openings.
module plydyn_element_interface_stored_energy
   use plydyn_base_exact_sum, only : exact_sums_type
   use plydyn_base_precision, only : lanes, wp
   use plydyn_element_interface_axes, only : find_axes, rotate_in
   use plydyn_element_interface_faces, only : gather
   use plydyn_element_interface_interfaces, only : interface_type
   use plydyn_element_interface_points, only : to_points
   implicit none
   private

   public :: add_interface_energy

contains

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

      real(wp) :: energy, opening(lanes, 3, size(self%node, 1))
      integer :: e, q

      do e = elements(1), elements(2)
         opening(:, :, :) = openings(self, e, large, displacement)
         energy = 0.0_wp
         do q = 1, size(self%node, 1)
            energy = energy + self%metric(5, q, e)*sum(self%present &
               & *self%law%stored_energy(opening(:, :, q), history(:, q, e, :)))
         end do
         call sums%add(1, energy)
      end do
   end subroutine add_interface_energy

   !> Openings at the points of a quad in the axes of the law
   pure function openings(self, quad, large, displacement) result(jump)
      type(interface_type), intent(in) :: self
      integer, intent(in) :: quad
      logical, intent(in) :: large
      real(wp), intent(in), contiguous :: displacement(:)
      real(wp) :: jump(lanes, 3, size(self%node, 1))

      real(wp), dimension(lanes, 3, size(self%node, 1)) :: middle, stretch
      real(wp) :: axes(lanes, 3, 3, size(self%node, 1))
      integer :: first, last

      call gather(self, quad, displacement, jump, middle)
      if (.not. self%nodal) call to_points(self%side, jump)
      if (.not. large) return
      if (.not. self%nodal) call to_points(self%side, middle)
      do first = 1, size(self%node, 1), self%side**2
         last = first + self%side**2 - 1
         call find_axes(self%side, self%metric(:, first:last, quad), middle(:, :, first:last), &
            & axes(:, :, :, first:last), stretch(:, :, first:last))
      end do
      call rotate_in(size(self%node, 1), axes, jump)
   end function openings

end module plydyn_element_interface_stored_energy
