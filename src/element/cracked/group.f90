!> Element group of the plies of a crack zone: each quad is two wedges in every ply, and corners
!> that a crack may part belong to one of two columns.
module plydyn_element_cracked_group
   use plydyn_base_exact_sum, only : exact_sums_type
   use plydyn_base_precision, only : lanes, wp
   use plydyn_element_cracked_cells, only : cells_type, corners, new_cells, set_cells, wedge_metric
   use plydyn_element_cracked_masses, only : add_wedge_masses
   use plydyn_element_cracked_stable_rate, only : crack_rate, wedge_rate
   use plydyn_element_cracked_stresses, only : add_wedge_energy, find_stresses
   use plydyn_element_cracked_output, only : corner_displacements, profile_of_corners, wedge_values
   use plydyn_element_cracked_wedges, only : add_point_forces, find_gradients, wedge_points
   use plydyn_element_group, only : recovered
   use plydyn_element_least_volume, only : least_volume_type
   use plydyn_element_plate_group, only : new_plate_group, plate_group_type
   use plydyn_element_plate_output, only : layer_place_type
   use plydyn_fem_columns, only : columns_type
   use plydyn_fem_kinematics, only : volume_ratios
   use plydyn_model_mesh, only : mesh_type
   use plydyn_model_model, only : model_type
   implicit none
   private

   public :: new_cracked_group

   !> Nanoseconds of a quad and eight plies
   real(wp), parameter :: elastic_work = 220.0_wp, law_work = 400.0_wp

   !> The plies of a crack zone over its quads
   type, public, extends(plate_group_type) :: cracked_group_type
      !> Index of the zone
      integer :: zone = 0
      !> How its quads are divided
      type(cells_type) :: cells
   contains
      procedure :: take_elements, set_targets, add_masses, find_rates
      procedure :: add_forces, find_volume, add_stored_energy, output_values, profile
   end type cracked_group_type

contains

   !> The plies of a zone, still without quads
   function new_cracked_group(model, zone, number, columns) result(self)
      !> The model
      type(model_type), intent(in) :: model
      !> Index of the zone, and of the group
      integer, intent(in) :: zone, number
      !> Where the points lie
      type(columns_type), intent(in) :: columns
      type(cracked_group_type) :: self

      self%plate_group_type = new_plate_group(model, model%crack_zones(zone)%part, number, columns)
      self%zone = zone
      self%sets_forces = .false.
      ! shape functions are of no use here; edges have the length 1, not 2
      self%plate%gauss_abscissa = 1.0_wp
      self%cells = new_cells(model%crack_zones(zone), self%layers%ply, self%plate)
      associate (batch => self%plate%batches(1))
         self%work = batch%blocks*merge(law_work, elastic_work, size(batch%laws) > 0)
         self%history_shape = reshape([lanes*wedge_points*batch%blocks, batch%histories, &
            & batch%intact_histories], [3, 1])
      end associate
   end function new_cracked_group

   subroutine take_elements(self, model, elements, local_node, columns)
      class(cracked_group_type), intent(inout) :: self
      type(model_type), intent(in) :: model
      integer, intent(in) :: elements(:), local_node(:)
      type(columns_type), intent(in) :: columns

      call self%plate_group_type%take_elements(model, elements, local_node, columns)
      associate (plate => self%plate)
         plate%metric = wedge_metric(model%crack_zones(self%zone), size(elements))
         plate%batches%pitch = wedge_points*plate%batches%blocks*size(elements)
         call set_cells(model%mesh, model%crack_zones(self%zone), self%layers%ply, local_node, &
            & plate, self%cells)
         self%memory(:) = [size(plate%metric) + size(self%cells%sees), 4*size(plate%node) &
            & + 2*size(plate%quad)]
      end associate
   end subroutine take_elements

   pure subroutine set_targets(self, elements, height, column)
      class(cracked_group_type), intent(inout) :: self
      integer, intent(in) :: elements(2), height, column(:)
      integer :: e

      do e = elements(1), elements(2)
         self%plate%target(:, e) = column(self%plate%node(:, e))
         self%cells%twin_target(:, e) = column(self%cells%twin(:, e))
      end do
   end subroutine set_targets

   !> Mass scaling leaves crack zones as they are
   subroutine add_masses(self, model, elements, local_node, columns, mass, layer, share)
      class(cracked_group_type), intent(in) :: self
      type(model_type), intent(in) :: model
      type(columns_type), intent(in) :: columns
      integer, intent(in) :: elements(:), local_node(:)
      real(wp), intent(inout) :: mass(:)
      integer, intent(in), optional :: layer
      real(wp), intent(in), optional :: share(:)

      if (present(layer)) return
      call add_wedge_masses(model, model%crack_zones(self%zone), elements, local_node, columns, &
         & mass)
   end subroutine add_masses

   pure subroutine add_forces(self, elements, step, displacement, velocity, history, force)
      class(cracked_group_type), intent(in) :: self
      integer, intent(in) :: elements(2)
      real(wp), intent(in) :: step
      real(wp), intent(in), contiguous :: displacement(:), velocity(:)
      real(wp), intent(inout), contiguous :: history(:), force(:)

      real(wp), dimension(lanes, 3, 3, wedge_points) :: gradient, stress
      integer :: b, e, first

      associate (batch => self%plate%batches(1))
         do e = elements(1), elements(2)
            do b = 1, batch%blocks
               first = batch%first_history + lanes*wedge_points*(b - 1 + batch%blocks*(e - 1))
               call find_gradients(self%plate, self%cells, b, e, displacement, gradient)
               call find_stresses(self%plate, b, e, self%large, step, gradient, &
                  & history(min(first, size(history)):), stress)
               call add_point_forces(self%plate, self%cells, b, e, stress, force)
            end do
         end do
      end associate
   end subroutine add_forces

   pure subroutine find_volume(self, displacement, least, mesh)
      class(cracked_group_type), intent(in) :: self
      real(wp), intent(in), contiguous :: displacement(:)
      type(least_volume_type), intent(inout) :: least
      type(mesh_type), intent(in), optional :: mesh

      real(wp) :: gradient(lanes, 3, 3, wedge_points), ratio(lanes)
      integer :: b, e, l, p

      associate (layer => self%plate%batches(1)%layer)
         do e = 1, size(self%plate%quad)
            do b = 1, size(layer, 2)
               call find_gradients(self%plate, self%cells, b, e, displacement, gradient)
               do p = 1, wedge_points
                  ratio(:) = volume_ratios(gradient(:, :, :, p))
                  do l = 1, lanes
                     if (layer(l, b) > 0) call least%take(ratio(l), self%plate%quad(e), &
                        & self%layers%ply(layer(l, b)))
                  end do
               end do
            end do
         end do
      end associate
   end subroutine find_volume

   !> Bound of the wedges, the same for all quads, with the springs of open cracks
   subroutine find_rates(self, model, elements, implicit, rate, mass, layer)
      class(cracked_group_type), intent(in) :: self
      type(model_type), intent(in) :: model
      integer, intent(in) :: elements(:)
      real(wp), intent(in) :: implicit
      real(wp), allocatable, intent(out) :: rate(:, :), mass(:, :)
      integer, allocatable, intent(out) :: layer(:)

      real(wp) :: bound, springs

      allocate (layer(1), mass(0, 0))
      associate (zone => model%crack_zones(self%zone))
         call wedge_rate(model, zone, self%plate, self%cells, bound, layer(1))
         springs = crack_rate(model, zone)
         bound = bound + springs
         ! closed faces that rebound within a few steps give back more than they store, of which
         ! interfaces keep the step free; a single ply has none
         if (size(zone%plies) == 1) bound = max(bound, 4.0_wp*springs)
      end associate
      rate = reshape(spread(bound, 1, size(elements)), [1, size(elements)])
   end subroutine find_rates

   pure subroutine add_stored_energy(self, elements, displacement, history, sums)
      class(cracked_group_type), intent(in) :: self
      integer, intent(in) :: elements(2)
      real(wp), intent(in), contiguous :: displacement(:), history(:)
      type(exact_sums_type), intent(inout) :: sums

      call add_wedge_energy(self%plate, self%cells, elements, self%large, displacement, history, &
         & sums)
   end subroutine add_stored_energy

   !> Means of the wedges at each corner
   pure function output_values(self, place, has_tensors, displacement, history) result(values)
      class(cracked_group_type), intent(in) :: self
      integer, intent(in) :: place(2)
      logical, intent(in) :: has_tensors
      real(wp), intent(in), contiguous :: displacement(:), history(:)
      real(wp), allocatable :: values(:, :, :)

      allocate (values(recovered, 2, corners))
      values(:, :, :) = wedge_values(self%plate, self%cells, place(1), self%slot(:, place(2)), &
         & self%large, has_tensors, displacement, history)
   end function output_values

   !> Displacement and the rest from the corners of the quad
   pure function profile(self, columns, place, local, height, displacement, history) result(values)
      class(cracked_group_type), intent(in) :: self
      type(columns_type), intent(in) :: columns
      integer, intent(in) :: place(2)
      real(wp), intent(in) :: local(2), height(:)
      real(wp), intent(in), contiguous :: displacement(:), history(:)
      real(wp) :: values(3 + recovered, size(height))

      values(:, :) = profile_of_corners(local, height, corner_displacements(self%plate%node(:, &
         & place(1)), self%cells, layer_place_type(place(1), place(2), 2, self%slot(:, place(2))), &
         & columns, displacement), self%output_values(place, .true., displacement, history))
   end function profile

end module plydyn_element_cracked_group
