!> The stable step of the whole domain, and who sets it.
module plydyn_domain_step_limit
   use plydyn_base_precision, only : wp
   use plydyn_domain_domain, only : domain_type, step_limit_type
   use plydyn_domain_layers, only : layers_type, new_layers
   use plydyn_domain_masses, only : surface_density
   use plydyn_element_stable_step, only : largest_eigenvalues
   use plydyn_model_model, only : model_type
   implicit none
   private

   public :: find_step_limit

contains

   !> Largest eigenvalue of the layers, plus that of the springs between them: their sum bounds
   !> the largest of the whole
   function find_step_limit(model, domain) result(limit)
      !> The model
      type(model_type), intent(in) :: model
      !> The domain, built but for its limit
      type(domain_type), intent(in) :: domain
      type(step_limit_type) :: limit

      real(wp), allocatable :: rate(:)
      integer, allocatable :: ply(:)
      integer :: worst

      allocate (rate(size(model%mesh%quad_id)), ply(size(model%mesh%quad_id)))
      rate(:) = 0.0_wp
      ply(:) = 0
      call add_layer_rates(model, domain, rate, ply)
      limit%interface_rate = interface_rate(domain)
      worst = maxloc(rate, 1)
      limit%ply_rate = rate(worst)
      limit%step = 2.0_wp/sqrt(limit%ply_rate + limit%interface_rate)
      limit%quad = model%mesh%quad_id(worst)
      limit%ply = ply(worst)
      limit%quad_step = 2.0_wp/sqrt(rate)
      limit%quad_ply = ply
   end function find_step_limit

   !> Largest eigenvalue of each quad and the ply that has it
   subroutine add_layer_rates(model, domain, rate, ply)
      type(model_type), intent(in) :: model
      type(domain_type), intent(in) :: domain
      real(wp), intent(inout) :: rate(:)
      integer, intent(inout) :: ply(:)

      type(layers_type) :: layers
      real(wp), allocatable :: corner(:, :, :), lambda(:, :, :)
      integer :: e, f, layer, p, place(2), quads

      do p = 1, size(domain%plates)
         layers = new_layers(model%parts(p))
         associate (plate => domain%plates(p))
            quads = size(plate%quad)
            allocate (corner(2, plate%side**2, quads))
            do e = 1, quads
               corner(:, :, e) = domain%position(1:2, plate%node(:, e))
            end do
            do f = 1, size(plate%batches)
               associate (layer_of => domain%columns%families(f)%layer)
                  allocate (lambda(size(layer_of, 1), size(layer_of, 2), quads))
                  call largest_eigenvalues(plate%batches(f), &
                     & surface_density(model, p, layers, layer_of), plate%side, corner, lambda)
                  do e = 1, quads
                     place(:) = maxloc(lambda(:, :, e))
                     layer = layer_of(place(1), place(2))
                     if (lambda(place(1), place(2), e) <= rate(plate%quad(e))) cycle
                     rate(plate%quad(e)) = lambda(place(1), place(2), e)
                     ply(plate%quad(e)) = model%parts(p)%plies(layers%ply(layer))%id
                  end do
               end associate
               deallocate (lambda)
            end do
            deallocate (corner)
         end associate
      end do
   end subroutine add_layer_rates

   !> Bound on the eigenvalues of the springs: stiffness times area over both masses, at the node
   !> where it is largest (nodal areas bound the integrals at Gauss points)
   pure real(wp) function interface_rate(domain) result(rate)
      type(domain_type), intent(in) :: domain

      real(wp), allocatable :: area(:)
      real(wp) :: inverse
      integer :: e, i, k, node

      rate = 0.0_wp
      allocate (area(domain%columns%nodes))
      do k = 1, size(domain%interfaces)
         associate (springs => domain%interfaces(k), plates => domain%plates)
            area(:) = 0.0_wp
            do i = 1, size(plates)
               do e = 1, size(plates(i)%quad)
                  area(plates(i)%node(:, e)) = area(plates(i)%node(:, e)) &
                     & + matmul(plates(i)%metric(5, :, e), springs%shape)
               end do
            end do
            do node = 1, size(area)
               inverse = domain%inverse_mass(domain%columns%mass_of(springs%lower, &
                  & domain%columns%levels(springs%lower), node)) &
                  & + domain%inverse_mass(domain%columns%mass_of(springs%upper, 1, node))
               rate = max(rate, maxval(springs%stiffness)*area(node)*inverse)
            end do
         end associate
      end do
   end function interface_rate

end module plydyn_domain_step_limit
