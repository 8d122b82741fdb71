!> Largest eigenvalues of the layers of a plate, quad by quad.
module plydyn_element_plate_stable_rate
   use plydyn_base_precision, only : wp
   use plydyn_element_plate_layers, only : plate_type
   use plydyn_element_plate_masses, only : surface_density
   use plydyn_element_quad, only : plane_tables, quad_metric, quad_node_area, tensor_order
   use plydyn_element_stable_step, only : certified_bound, largest_eigenvalues, power_iteration
   use plydyn_fem_quadrature, only : gauss_points
   use plydyn_model_layers, only : layers_type, new_layers
   use plydyn_model_mesh, only : mesh_type
   use plydyn_model_model, only : model_type
   implicit none
   private

   public :: largest_quad_factor, layer_rates

contains

   !> Largest eigenvalue and mass of each layer of some quads, (layers, quads)
   subroutine layer_rates(model, p, plate, quads, implicit, rate, mass)
      !> The model
      type(model_type), intent(in) :: model
      !> The part
      integer, intent(in) :: p
      !> Its plate
      type(plate_type), intent(in) :: plate
      !> The quads, indices into the mesh
      integer, intent(in) :: quads(:)
      !> Share of the stiffness through the thickness that is implicit
      real(wp), intent(in) :: implicit
      !> Eigenvalues and masses
      real(wp), allocatable, intent(out) :: rate(:, :), mass(:, :)

      type(layers_type) :: layers
      real(wp), allocatable :: area(:), corner(:, :, :), density(:, :), lambda(:, :, :)
      integer :: b, e, f, l

      layers = new_layers(model%parts(p))
      corner = quad_corners(model%mesh, plate%side, quads)
      area = [(sum(quad_node_area(plate%side, corner(:, :, e))), e=1, size(quads))]
      allocate (rate(size(layers%ply), size(quads)), mass(size(layers%ply), size(quads)))
      do f = 1, size(plate%batches)
         associate (layer_of => plate%batches(f)%layer)
            density = surface_density(model, p, layers, layer_of)
            allocate (lambda(size(layer_of, 1), size(layer_of, 2), size(quads)))
            call largest_eigenvalues(plate%batches(f), density, plate%side, corner, implicit, &
               & lambda)
            do b = 1, size(layer_of, 2)
               do l = 1, size(layer_of, 1)
                  if (layer_of(l, b) == 0) cycle
                  rate(layer_of(l, b), :) = lambda(l, b, :)
                  mass(layer_of(l, b), :) = density(l, b)*area
               end do
            end do
         end associate
         deallocate (lambda)
      end do
   end subroutine layer_rates

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

   !> Bound on the eigenvalues of the areas of the Gauss points of some quads against those of their
   !> nodes
   real(wp) function largest_quad_factor(mesh, quads) result(factor)
      !> The mesh
      type(mesh_type), intent(in) :: mesh
      !> The quads, indices into the mesh
      integer, intent(in) :: quads(:)

      real(wp), allocatable :: shape(:, :), slope(:, :, :)
      integer :: e, side

      side = nint(sqrt(real(size(mesh%quad_node, 1), wp)))
      call plane_tables(gauss_points(side), shape, slope)
      factor = 0.0_wp
      do e = 1, size(quads)
         factor = max(factor, quad_factor(side, shape, quad_corners(mesh, side, quads(e:e))))
      end do
   end function largest_quad_factor

   !> Bound on the eigenvalues of the areas of the Gauss points against those of the nodes
   real(wp) function quad_factor(side, shape, corner) result(factor)
      !> Nodes along a side
      integer, intent(in) :: side
      !> Shape functions at the Gauss points, (points, nodes)
      real(wp), intent(in) :: shape(:, :)
      !> Positions of the quad's nodes, (2, nodes, 1)
      real(wp), intent(in) :: corner(:, :, :)

      real(wp) :: area(side**2), matrix(side**2, side**2), metric(5, side**2)
      integer :: i, q

      area(:) = quad_node_area(side, corner(:, :, 1))
      metric(:, :) = quad_metric(side, corner(:, :, 1))
      matrix(:, :) = 0.0_wp
      do q = 1, size(area)
         do i = 1, size(area)
            matrix(:, i) = matrix(:, i) &
               & + metric(5, q)*shape(q, :)*shape(q, i)/sqrt(area*area(i))
         end do
      end do
      factor = certified_bound(matrix, power_iteration(matrix))
   end function quad_factor

end module plydyn_element_plate_stable_rate
