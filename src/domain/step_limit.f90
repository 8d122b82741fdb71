!> The stable step of the whole domain, and who sets it.
module plydyn_domain_step_limit
   use plydyn_base_precision, only : lanes, wp
   use plydyn_domain_domain, only : domain_type, step_limit_type
   use plydyn_domain_masses, only : surface_density
   use plydyn_domain_pair_inertia, only : implicit_share
   use plydyn_domain_critical_elements, only : find_slowest
   use plydyn_element_plate_layers, only : plate_type
   use plydyn_element_quad, only : quad_metric, quad_node_area, tensor_order
   use plydyn_element_stable_step, only : certified_bound, largest_eigenvalues, power_iteration
   use plydyn_model_control, only : all_explicit, implicit_thickness
   use plydyn_model_layers, only : layers_type, new_layers
   use plydyn_model_mesh, only : mesh_type
   use plydyn_model_model, only : model_type
   implicit none
   private

   public :: find_step_limit

contains

   !> Largest eigenvalue of the layers, plus that of the interfaces between them: their sum bounds
   !> the largest of the whole. All ranks must come here
   function find_step_limit(model, domain) result(limit)
      !> The model
      type(model_type), intent(in) :: model
      !> The domain; layers, interfaces and the quads of this rank are known
      type(domain_type), intent(in) :: domain
      type(step_limit_type) :: limit

      real(wp), allocatable :: rate(:), rates(:)
      integer, allocatable :: plies(:), ply(:), quads(:)
      integer :: p

      allocate (plies(0), quads(0), rates(0))
      do p = 1, size(domain%plates)
         call find_layer_rates(model, domain, p, rate, ply)
         quads = [quads, domain%plates(p)%quad]
         rates = [rates, rate]
         plies = [plies, ply]
      end do
      limit%slowest = find_slowest(domain%comm, quads, rates, plies)
      call add_interface_rates(model, domain, limit%interface_rate, limit%interface_rest)
      associate (worst => limit%slowest(1))
         limit%ply_rate = worst%rate
         limit%step = 2.0_wp/sqrt(limit%ply_rate + limit%interface_rest)
         limit%quad = model%mesh%quad_id(worst%element)
         limit%ply = worst%layer
         limit%plane_rate = plane_rate(model, domain, worst%element)
      end associate
   end function find_step_limit

   !> Largest eigenvalue that one quad would have if the thickness of its plies were implicit
   real(wp) function plane_rate(model, domain, quad) result(rate)
      type(model_type), intent(in) :: model
      type(domain_type), intent(in) :: domain
      !> Index in the mesh
      integer, intent(in) :: quad

      integer :: f, p
      real(wp), allocatable :: lambda(:, :, :)

      rate = 0.0_wp
      p = model%mesh%quad_part(quad)
      associate (plate => domain%plates(p))
         do f = 1, size(plate%batches)
            associate (layer_of => domain%columns%families(f)%layer)
               allocate (lambda(size(layer_of, 1), size(layer_of, 2), 1))
               call largest_eigenvalues(plate%batches(f), surface_density(model, p, &
                  & new_layers(model%parts(p)), layer_of), plate%side, &
                  & corners(model%mesh, plate%side, [quad]), &
                  & 4.0_wp*implicit_share, lambda)
               rate = max(rate, maxval(lambda))
            end associate
            deallocate (lambda)
         end do
      end associate
   end function plane_rate

   !> Positions of the nodes of some quads in tensor order, (2, nodes, quads)
   pure function corners(mesh, side, quads) result(corner)
      type(mesh_type), intent(in) :: mesh
      integer, intent(in) :: side, quads(:)
      real(wp) :: corner(2, side**2, size(quads))
      integer :: e

      do e = 1, size(quads)
         corner(:, :, e) = mesh%position(1:2, mesh%quad_node(tensor_order(side), quads(e)))
      end do
   end function corners

   !> Largest eigenvalue of each quad of a plate and the ply that has it, the user's number
   subroutine find_layer_rates(model, domain, p, rate, ply)
      type(model_type), intent(in) :: model
      type(domain_type), intent(in) :: domain
      integer, intent(in) :: p
      real(wp), allocatable, intent(out) :: rate(:)
      integer, allocatable, intent(out) :: ply(:)

      type(layers_type) :: layers
      real(wp), allocatable :: corner(:, :, :), lambda(:, :, :)
      integer :: e, f, layer, place(2)

      layers = new_layers(model%parts(p))
      associate (plate => domain%plates(p))
         rate = spread(0.0_wp, 1, size(plate%quad))
         ply = spread(0, 1, size(plate%quad))
         corner = corners(model%mesh, plate%side, plate%quad)
         do f = 1, size(plate%batches)
            associate (layer_of => domain%columns%families(f)%layer)
               allocate (lambda(size(layer_of, 1), size(layer_of, 2), size(rate)))
               call largest_eigenvalues(plate%batches(f), &
                  & surface_density(model, p, layers, layer_of), plate%side, corner, &
                  & merge(4.0_wp*implicit_share, 0.0_wp, &
                  & domain%control%scheme == implicit_thickness), lambda)
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
      end associate
   end subroutine find_layer_rates

   !> Bound on the eigenvalues of the interfaces: stiffness over the mass per area of both faces,
   !> times the largest eigenvalue that the points of one quad have against the areas of its nodes.
   !> Where interfaces are implicit the inertia that they add at the nodes outweighs all or most of
   !> that: with K the springs at the points and K' those at the nodes, dt**2 K/4 is no more than
   !> beta dt**2 K' as long as the eigenvalue of K against K' is no more than 4 beta
   subroutine add_interface_rates(model, domain, rate, rest)
      type(model_type), intent(in) :: model
      type(domain_type), intent(in) :: domain
      !> Of all springs, and of those that are not implicit
      real(wp), intent(out) :: rate, rest

      type(layers_type) :: layers
      real(wp) :: inverse, largest(1)
      integer :: e, k, l, p

      rate = 0.0_wp
      rest = 0.0_wp
      if (size(domain%interfaces) == 0) return
      ! points at the nodes have their areas
      largest(:) = merge(1.0_wp, 0.0_wp, any(domain%interfaces%nodal))
      do p = 1, size(domain%plates)
         associate (plate => domain%plates(p))
            do e = 1, size(plate%quad)
               largest(:) = max(largest, quad_factor(plate, &
                  & corners(model%mesh, plate%side, plate%quad(e:e))))
            end do
         end associate
      end do
      call domain%comm%max(largest)
      do p = 1, size(model%parts)
         layers = new_layers(model%parts(p))
         do k = 1, size(domain%interfaces)
            associate (batch => domain%interfaces(k))
               do l = 1, lanes
                  if (batch%lower(l) == 0) cycle
                  inverse = 1.0_wp/face_density(model, domain, p, layers, batch%lower(l)) &
                     & + 1.0_wp/face_density(model, domain, p, layers, batch%upper(l))
                  rate = max(rate, maxval(batch%law%stiffness)*largest(1)*inverse)
               end do
            end associate
         end do
      end do
      rest = rate
      if (domain%control%scheme /= all_explicit) then
         rest = rate*max(0.0_wp, 1.0_wp - 4.0_wp*implicit_share/largest(1))
      end if
   end subroutine add_interface_rates

   !> Mass per area that a layer has on one of its faces
   pure real(wp) function face_density(model, domain, p, layers, layer) result(density)
      type(model_type), intent(in) :: model
      type(domain_type), intent(in) :: domain
      integer, intent(in) :: p, layer
      type(layers_type), intent(in) :: layers

      associate (material => model%materials(model%parts(p)%plies(layers%ply(layer))%material), &
         & batch => domain%plates(p)%batches(domain%columns%home(1, layer)))
         density = material%density*(layers%top(layer) - layers%bottom(layer)) &
            & *batch%expansion%mass_share(1)
      end associate
   end function face_density

   !> Bound on the eigenvalues of the areas of the Gauss points against those of the nodes
   real(wp) function quad_factor(plate, corner) result(factor)
      type(plate_type), intent(in) :: plate
      !> Positions of its nodes, (2, nodes, 1)
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

end module plydyn_domain_step_limit
