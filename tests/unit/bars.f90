!> A small family of elements: bars of two nodes with a damper beside each, as an example of how a
!> family extends `element_group_type`.
module bars
   use plydyn_base_exact_sum, only : exact_sums_type
   use plydyn_base_precision, only : wp
   use plydyn_element_group, only : element_group_type
   use plydyn_fem_columns, only : columns_type
   use plydyn_law_law, only : by_friction
   use plydyn_model_mesh, only : mesh_type
   use plydyn_model_model, only : model_type
   implicit none
   private

   !> Bars of one section along x
   type, public, extends(element_group_type) :: bar_group_type
      !> Nodes of each bar of the mesh, (2, bars)
      integer, allocatable :: mesh_node(:, :)
      !> Young's modulus, density, area, and force per velocity of the dampers
      real(wp) :: young = 0.0_wp, density = 0.0_wp, area = 0.0_wp, damping = 0.0_wp
      !> Length of each bar of this rank
      real(wp), allocatable :: length(:)
      !> Places of x in the arrays of motion and of forces, (2, bars)
      integer, allocatable :: place(:, :), target(:, :)
      !> First place of the energy that each damper has taken
      integer :: first_history = 0
   contains
      procedure :: take_elements
      procedure :: set_targets
      procedure :: add_masses
      procedure :: set_history
      procedure :: add_forces
      procedure :: find_rates
      procedure :: add_dissipation
      procedure :: add_stored_energy
   end type bar_group_type

contains

   subroutine take_elements(self, model, elements, local_node, columns)
      class(bar_group_type), intent(inout) :: self
      type(model_type), intent(in) :: model
      integer, intent(in) :: elements(:), local_node(:)
      type(columns_type), intent(in) :: columns
      integer :: e

      self%element = elements
      allocate (self%length(size(elements)), self%place(2, size(elements)))
      do e = 1, size(elements)
         associate (node => self%mesh_node(:, elements(e)))
            self%length(e) = bar_length(model%mesh, node)
            self%place(:, e) = columns%freedom(1, 1, 1, local_node(node))
         end associate
      end do
      self%target = self%place
      ! one number for each bar
      self%history_shape = reshape([1, 1, 1], [3, 1])
   end subroutine take_elements

   !> Length of a bar
   pure real(wp) function bar_length(mesh, node) result(length)
      type(mesh_type), intent(in) :: mesh
      integer, intent(in) :: node(2)

      length = mesh%position(1, node(2)) - mesh%position(1, node(1))
   end function bar_length

   !> One chunk has all bars: their forces go to the places of their points
   pure subroutine set_targets(self, elements, height, column)
      class(bar_group_type), intent(inout) :: self
      integer, intent(in) :: elements(2), height, column(:)

      self%target(:, elements(1):elements(2)) = self%place(:, elements(1):elements(2))
   end subroutine set_targets

   subroutine add_masses(self, model, elements, local_node, columns, mass, layer, share)
      class(bar_group_type), intent(in) :: self
      type(model_type), intent(in) :: model
      integer, intent(in) :: elements(:), local_node(:)
      type(columns_type), intent(in) :: columns
      real(wp), intent(inout) :: mass(:)
      integer, intent(in), optional :: layer
      real(wp), intent(in), optional :: share(:)
      integer :: e, i

      do e = 1, size(elements)
         associate (node => self%mesh_node(:, elements(e)))
            do i = 1, 2
               associate (place => columns%mass_of(1, 1, local_node(node(i))))
                  mass(place) = mass(place) &
                     & + 0.5_wp*self%density*self%area*bar_length(model%mesh, node)
               end associate
            end do
         end associate
      end do
   end subroutine add_masses

   pure subroutine set_history(self, first)
      class(bar_group_type), intent(inout) :: self
      integer, intent(in) :: first(:)

      self%first_history = first(1)
   end subroutine set_history

   pure subroutine add_forces(self, elements, step, displacement, velocity, history, force)
      class(bar_group_type), intent(in) :: self
      integer, intent(in) :: elements(2)
      real(wp), intent(in) :: step
      real(wp), intent(in), contiguous :: displacement(:), velocity(:)
      real(wp), intent(inout), contiguous :: history(:), force(:)

      real(wp) :: pull, rate
      integer :: e

      do e = elements(1), elements(2)
         associate (from => self%place(:, e), to => self%target(:, e), &
            & energy => history(self%first_history - 1 + e))
            rate = velocity(from(2)) - velocity(from(1))
            pull = self%young*self%area/self%length(e)*(displacement(from(2)) &
               & - displacement(from(1))) + self%damping*rate
            force(to(1)) = force(to(1)) + pull
            force(to(2)) = force(to(2)) - pull
            energy = energy + step*self%damping*rate**2
         end associate
      end do
   end subroutine add_forces

   !> Two masses of half the bar and the spring between them: 4 E/(rho L**2)
   subroutine find_rates(self, model, elements, implicit, rate, mass, layer)
      class(bar_group_type), intent(in) :: self
      type(model_type), intent(in) :: model
      integer, intent(in) :: elements(:)
      real(wp), intent(in) :: implicit
      real(wp), allocatable, intent(out) :: rate(:, :), mass(:, :)
      integer, allocatable, intent(out) :: layer(:)

      rate = reshape(4.0_wp*self%young/(self%density*self%length**2), [1, size(elements)])
      allocate (mass(0, 0))
      layer = [1]
   end subroutine find_rates

   pure subroutine add_dissipation(self, history, sums)
      class(bar_group_type), intent(in) :: self
      real(wp), intent(in), contiguous :: history(:)
      type(exact_sums_type), intent(inout) :: sums
      integer :: e

      do e = 1, size(self%element)
         call sums%add(by_friction, history(self%first_history - 1 + e))
      end do
   end subroutine add_dissipation

   pure subroutine add_stored_energy(self, elements, displacement, history, sums)
      class(bar_group_type), intent(in) :: self
      integer, intent(in) :: elements(2)
      real(wp), intent(in), contiguous :: displacement(:), history(:)
      type(exact_sums_type), intent(inout) :: sums
      integer :: e

      do e = elements(1), elements(2)
         call sums%add(1, 0.5_wp*self%young*self%area/self%length(e) &
            & *(displacement(self%place(2, e)) - displacement(self%place(1, e)))**2)
      end do
   end subroutine add_stored_energy

end module bars
