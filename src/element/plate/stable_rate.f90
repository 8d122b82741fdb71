!> Largest eigenvalues of the layers of a plate, quad by quad.
module plydyn_element_plate_stable_rate
   use plydyn_base_precision, only : wp
   use plydyn_element_plate_layers, only : plate_type
   use plydyn_element_plate_masses, only : surface_density
   use plydyn_element_quad, only : quad_metric, quad_node_area, tensor_order
   use plydyn_element_stable_step, only : certified_bound, largest_eigenvalues, power_iteration
   use plydyn_model_layers, only : layers_type, new_layers
   use plydyn_model_mesh, only : mesh_type
   use plydyn_model_model, only : model_type
   implicit none
   private

   public :: largest_quad_factor, layer_rates, plane_rate, rates_and_masses

contains

   !> Largest eigenvalue of each quad of a plate and the ply that has it, the user's number
   subroutine layer_rates(model, p, plate, implicit, rate, ply)
      !> The model
      type(model_type), intent(in) :: model
      !> The part
      integer, intent(in) :: p
      !> Its plate
      type(plate_type), intent(in) :: plate
      !> Share of the stiffness through the thickness that is implicit
      real(wp), intent(in) :: implicit
      !> Eigenvalues
      real(wp), allocatable, intent(out) :: rate(:)
      !> The plies
      integer, allocatable, intent(out) :: ply(:)

      type(layers_type) :: layers
      real(wp), allocatable :: corner(:, :, :), lambda(:, :, :)
      integer :: e, f, layer, place(2)

      layers = new_layers(model%parts(p))
      rate = spread(0.0_wp, 1, size(plate%quad))
      ply = spread(0, 1, size(plate%quad))
      corner = quad_corners(model%mesh, plate%side, plate%quad)
      do f = 1, size(plate%batches)
         associate (layer_of => plate%batches(f)%layer)
            allocate (lambda(size(layer_of, 1), size(layer_of, 2), size(rate)))
            call largest_eigenvalues(plate%batches(f), &
               & surface_density(model, p, layers, layer_of), plate%side, corner, implicit, lambda)
            do e = 1, size(rate)
               place(:) = maxloc(lambda(:, :, e))
               layer = layer_of(place(1), place(2))
               if (lambda(place(1), place(2), e) <= rate(e)) cycle
               rate(e) = lambda(place(1), place(2), e)
               ply(e) = model%parts(p)%plies(layers%ply(layer))%id
            end do
         end associate
         deallocate (lambda)
      end do
   end subroutine layer_rates

   !> Largest eigenvalue and mass of each layer of each quad of a plate, (layers, quads)
   subroutine rates_and_masses(model, p, plate, implicit, rate, mass)
      !> As in `layer_rates`
      type(model_type), intent(in) :: model
      integer, intent(in) :: p
      type(plate_type), intent(in) :: plate
      real(wp), intent(in) :: implicit
      !> Eigenvalues and masses
      real(wp), allocatable, intent(out) :: rate(:, :), mass(:, :)

      type(layers_type) :: layers
      real(wp), allocatable :: corner(:, :, :), density(:, :), lambda(:, :, :)
      integer :: b, e, f, l

      layers = new_layers(model%parts(p))
      corner = quad_corners(model%mesh, plate%side, plate%quad)
      allocate (rate(size(layers%ply), size(plate%quad)), mass(size(layers%ply), size(plate%quad)))
      do f = 1, size(plate%batches)
         associate (layer_of => plate%batches(f)%layer)
            density = surface_density(model, p, layers, layer_of)
            allocate (lambda(size(layer_of, 1), size(layer_of, 2), size(plate%quad)))
            call largest_eigenvalues(plate%batches(f), density, plate%side, corner, implicit, &
               & lambda)
            do b = 1, size(layer_of, 2)
               do l = 1, size(layer_of, 1)
                  if (layer_of(l, b) == 0) cycle
                  rate(layer_of(l, b), :) = lambda(l, b, :)
                  mass(layer_of(l, b), :) = density(l, b) &
                     & *[(sum(quad_node_area(plate%side, corner(:, :, e))), e=1, size(plate%quad))]
               end do
            end do
         end associate
         deallocate (lambda)
      end do
   end subroutine rates_and_masses

   !> Largest eigenvalue that one quad would have if the thickness of its plies were implicit
   real(wp) function plane_rate(model, p, plate, quad, implicit) result(rate)
      !> As in `layer_rates`
      type(model_type), intent(in) :: model
      integer, intent(in) :: p
      type(plate_type), intent(in) :: plate
      !> Index in the mesh
      integer, intent(in) :: quad
      real(wp), intent(in) :: implicit

      integer :: f
      real(wp), allocatable :: lambda(:, :, :)

      rate = 0.0_wp
      do f = 1, size(plate%batches)
         associate (layer_of => plate%batches(f)%layer)
            allocate (lambda(size(layer_of, 1), size(layer_of, 2), 1))
            call largest_eigenvalues(plate%batches(f), &
               & surface_density(model, p, new_layers(model%parts(p)), layer_of), plate%side, &
               & quad_corners(model%mesh, plate%side, [quad]), implicit, lambda)
            rate = max(rate, maxval(lambda))
         end associate
         deallocate (lambda)
      end do
   end function plane_rate

   !> Positions of the nodes of some quads in tensor order, (2, nodes, quads)
   pure function quad_corners(mesh, side, quads) result(corner)
      !> The mesh
      type(mesh_type), intent(in) :: mesh
      !> Nodes along a side, and the quads
      integer, intent(in) :: side, quads(:)
      real(wp) :: corner(2, side**2, size(quads))
      integer :: e

      do e = 1, size(quads)
         corner(:, :, e) = mesh%position(1:2, mesh%quad_node(tensor_order(side), quads(e)))
      end do
   end function quad_corners

   !> Bound on the eigenvalues of the areas of the Gauss points of any quad against those of its
   !> nodes
   real(wp) function largest_quad_factor(plate, mesh) result(factor)
      !> The plate
      type(plate_type), intent(in) :: plate
      !> The mesh
      type(mesh_type), intent(in) :: mesh
      integer :: e

      factor = 0.0_wp
      do e = 1, size(plate%quad)
         factor = max(factor, quad_factor(plate, &
            & quad_corners(mesh, plate%side, plate%quad(e:e))))
      end do
   end function largest_quad_factor

   !> Bound on the eigenvalues of the areas of the Gauss points against those of the nodes
   real(wp) function quad_factor(plate, corner) result(factor)
      !> The plate
      type(plate_type), intent(in) :: plate
      !> Positions of the quad's nodes, (2, nodes, 1)
      real(wp), intent(in) :: corner(:, :, :)

      real(wp) :: area(plate%side**2), matrix(plate%side**2, plate%side**2)
      real(wp) :: metric(5, plate%side**2)
      integer :: i, q

      area(:) = quad_node_area(plate%side, corner(:, :, 1))
      metric(:, :) = quad_metric(plate%side, corner(:, :, 1))
      matrix(:, :) = 0.0_wp
      do q = 1, size(area)
         do i = 1, size(area)
            matrix(:, i) = matrix(:, i) &
               & + metric(5, q)*plate%shape(q, :)*plate%shape(q, i)/sqrt(area*area(i))
         end do
      end do
      factor = certified_bound(matrix, power_iteration(matrix))
   end function quad_factor

end module plydyn_element_plate_stable_rate
