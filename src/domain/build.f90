!> From the model to the domain.
module plydyn_domain_build
   use plydyn_base_error, only : error_type, exit_input, fail
   use plydyn_base_precision, only : lanes, wp
   use plydyn_base_text, only : text
   use plydyn_domain_averages, only : build_averages
   use plydyn_domain_bands, only : check_bands
   use plydyn_domain_build_inertia, only : build_inertia, couple_surface, largest_step
   use plydyn_domain_chunks, only : new_chunks
   use plydyn_domain_brick_chunks, only : new_brick_chunks
   use plydyn_domain_brick_step, only : find_brick_limit
   use plydyn_domain_bricks, only : add_brick_masses, new_bricks
   use plydyn_domain_columns, only : new_columns, new_solid_columns
   use plydyn_domain_domain, only : domain_type, load_type
   use plydyn_domain_interfaces, only : new_interfaces
   use plydyn_domain_loads, only : new_body_load, new_line_load, new_point_load, &
      & new_pressure_load, new_segment_load, order_load
   use plydyn_domain_masses, only : add_masses
   use plydyn_domain_plates, only : new_plate
   use plydyn_domain_share, only : own_all
   use plydyn_domain_step_limit, only : find_step_limit
   use plydyn_domain_supports, only : face_point, held_freedoms, new_prescribed
   use plydyn_domain_surfaces, only : new_brick_surface, new_surface
   use plydyn_element_interface, only : history_size, interface_type
   use plydyn_element_plate, only : plate_type, quad_histories
   use plydyn_model_layers, only : new_layers
   use plydyn_model_layup, only : faces_tied
   use plydyn_model_model, only : model_type
   implicit none
   private

   public :: build_domain

contains

   !> Flat arrays of everything that the loop needs
   subroutine build_domain(model, domain, error)
      !> The model
      type(model_type), intent(in) :: model
      !> The domain
      type(domain_type), intent(out) :: domain
      !> What the model asks for and the domain cannot be
      type(error_type), allocatable, intent(out) :: error

      domain%control = model%control
      domain%curves = model%curves
      domain%initial_velocities = model%initial_velocities
      domain%node_id = model%mesh%node_id
      domain%position = model%mesh%position
      call check_step_curve(model, error)
      if (allocated(error)) return
      if (size(model%mesh%brick_id) > 0) then
         call build_bricks(model, domain)
         call check_bands(model, domain, error)
      else
         call build_laminates(model, domain, error)
      end if
      if (allocated(error)) return
      call build_supports(model, domain)
      call build_loads(model, domain)
      if (size(domain%bricks) > 0) then
         domain%limit = find_brick_limit(model, domain)
      else
         domain%limit = find_step_limit(model, domain)
      end if
      domain%step = largest_step(domain)
      call build_inertia(model, domain, error)
      if (allocated(error)) return
      call build_surfaces(model, domain)
      call own_all(domain)
   end subroutine build_domain

   !> Plates, and what joins their layers
   subroutine build_laminates(model, domain, error)
      type(model_type), intent(in) :: model
      type(domain_type), intent(inout) :: domain
      type(error_type), allocatable, intent(out) :: error

      domain%layers = new_layers(model%parts(1))
      domain%columns = new_columns(size(model%mesh%node_id), domain%layers%order)
      allocate (domain%bricks(0))
      call build_plates(model, domain, error)
      if (allocated(error)) return
      call check_bands(model, domain, error)
      if (allocated(error)) return
      call build_averages(model, domain, error)
      if (allocated(error)) return
      call build_joints(model, domain)
   end subroutine build_laminates

   !> Bricks and the masses of their nodes
   subroutine build_bricks(model, domain)
      type(model_type), intent(in) :: model
      type(domain_type), intent(inout) :: domain
      integer :: p

      domain%layers = new_layers(model%parts(1))
      domain%columns = new_solid_columns(size(model%mesh%node_id))
      allocate (domain%plates(0), domain%averages(0), domain%interfaces(0))
      allocate (domain%ties(0), domain%far_ties(2, 0))
      allocate (domain%mass(domain%columns%masses))
      domain%mass(:) = 0.0_wp
      domain%bricks = new_bricks(model, domain%columns)
      do p = 1, size(domain%bricks)
         associate (bricks => domain%bricks(p))
            bricks%first_history = domain%histories + 1
            domain%histories = domain%histories &
               & + lanes*bricks%histories*bricks%points*size(bricks%shape)
            call add_brick_masses(model, bricks, domain%columns, domain%mass)
         end associate
      end do
      call invert_masses(domain)
      call new_brick_chunks(domain)
   end subroutine build_bricks

   !> A bound on the step that is not positive would never let time pass
   subroutine check_step_curve(model, error)
      type(model_type), intent(in) :: model
      type(error_type), allocatable, intent(out) :: error

      if (model%control%step_curve == 0) return
      associate (curve => model%curves(model%control%step_curve))
         if (all(curve%y > 0.0_wp)) return
         call fail(error, exit_input, "curve "//text(curve%id)//" bounds the step (LCTM of " &
            & //"*CONTROL_TIMESTEP) by "//text(minval(curve%y))//": its ordinates must be positive")
      end associate
   end subroutine check_step_curve

   !> Plates and the masses of their points
   subroutine build_plates(model, domain, error)
      type(model_type), intent(in) :: model
      type(domain_type), intent(inout) :: domain
      type(error_type), allocatable, intent(out) :: error
      integer :: p

      allocate (domain%plates(size(model%parts)), domain%mass(domain%columns%masses))
      domain%mass(:) = 0.0_wp
      do p = 1, size(model%parts)
         call new_plate(model, p, domain%columns, domain%plates(p), error)
         if (allocated(error)) return
         call place_histories(domain%plates(p), domain%histories)
         call add_masses(model, p, domain%plates(p), new_layers(model%parts(p)), domain%columns, &
            & domain%mass, error)
         if (allocated(error)) return
      end do
      call invert_masses(domain)
   end subroutine build_plates

   !> Inverse of the masses, zero where there is no point
   pure subroutine invert_masses(domain)
      type(domain_type), intent(inout) :: domain

      allocate (domain%inverse_mass(domain%columns%masses))
      where (domain%mass > 0.0_wp)
         domain%inverse_mass(:) = 1.0_wp/domain%mass
      else where
         domain%inverse_mass(:) = 0.0_wp
      end where
   end subroutine invert_masses

   !> Let the histories of a plate follow those before it
   pure subroutine place_histories(plate, histories)
      type(plate_type), intent(inout) :: plate
      integer, intent(inout) :: histories
      integer :: b

      do b = 1, size(plate%batches)
         associate (batch => plate%batches(b))
            batch%first_history = histories + 1
            histories = histories + quad_histories(batch, plate%side)*size(plate%quad)
         end associate
      end do
   end subroutine place_histories

   !> Ties and interfaces between layers
   subroutine build_joints(model, domain)
      type(model_type), intent(in) :: model
      type(domain_type), intent(inout) :: domain

      type(interface_type), allocatable :: interfaces(:)
      integer :: k, p

      associate (joint => domain%layers%joint)
         domain%ties = pack([(k, k=1, size(joint))], joint == faces_tied)
         allocate (domain%interfaces(0))
         allocate (domain%far_ties(2, 0))
         do k = 1, size(domain%ties)
            call tie_layers(domain, domain%ties(k))
         end do
         do p = 1, size(domain%plates)
            interfaces = new_interfaces(model, domain%plates(p), domain%columns, joint)
            interfaces%plate = p
            domain%interfaces = [domain%interfaces, interfaces]
         end do
      end associate
      do k = 1, size(domain%interfaces)
         domain%interfaces(k)%first_history = domain%histories + 1
         domain%histories = domain%histories + history_size(domain%interfaces(k))
      end do
      call new_chunks(domain)
   end subroutine build_joints

   !> Let the top of a layer and the bottom of the next move as one: both get the inverse of the sum
   !> of their masses
   subroutine tie_layers(domain, layer)
      type(domain_type), intent(inout) :: domain
      integer, intent(in) :: layer

      integer :: above, below, c, n
      logical :: side_by_side

      call domain%columns%tie(layer, side_by_side)
      do n = 1, domain%columns%nodes
         below = domain%columns%mass_of(layer, domain%columns%levels(layer), n)
         above = domain%columns%mass_of(layer + 1, 1, n)
         domain%inverse_mass([below, above]) = 1.0_wp/(domain%mass(below) + domain%mass(above))
      end do
      if (side_by_side) return
      domain%far_ties = reshape([domain%far_ties, &
         & ([([domain%columns%freedom(layer, domain%columns%levels(layer), c, n), &
         & domain%columns%freedom(layer + 1, 1, c, n)], c=1, 3)], n=1, domain%columns%nodes)], &
         & [2, size(domain%far_ties, 2) + 3*domain%columns%nodes])
   end subroutine tie_layers

   !> Held places and prescribed motions
   subroutine build_supports(model, domain)
      type(model_type), intent(in) :: model
      type(domain_type), intent(inout) :: domain
      integer :: i

      domain%held = held_freedoms(model%holds, domain%layers, domain%columns)
      allocate (domain%motions(size(model%motions)))
      do i = 1, size(model%motions)
         domain%motions(i) = new_prescribed(model%motions(i), domain%layers, domain%columns)
      end do
   end subroutine build_supports

   !> Forces on points
   subroutine build_loads(model, domain)
      type(model_type), intent(in) :: model
      type(domain_type), intent(inout) :: domain
      integer :: i, k

      allocate (domain%loads(size(model%point_loads) + size(model%line_loads) &
         & + size(model%pressures) + size(model%segment_loads) &
         & + size(model%body_loads)))
      k = 0
      associate (layers => domain%layers, columns => domain%columns)
         do i = 1, size(model%point_loads)
            k = k + 1
            domain%loads(k) = new_point_load(model%point_loads(i), layers, columns, domain%mass)
         end do
         do i = 1, size(model%line_loads)
            k = k + 1
            domain%loads(k) = new_line_load(model%line_loads(i), model%mesh, layers, columns)
         end do
         do i = 1, size(model%pressures)
            k = k + 1
            domain%loads(k) = new_pressure_load(model%pressures(i), model%mesh, layers, columns)
         end do
         do i = 1, size(model%segment_loads)
            k = k + 1
            domain%loads(k) = new_segment_load(model%segment_loads(i), model%mesh, columns)
         end do
         do i = 1, size(model%body_loads)
            k = k + 1
            domain%loads(k) = new_body_load(model%body_loads(i), layers, columns, domain%mass)
         end do
         do k = 1, size(domain%loads)
            call order_load(domain%loads(k), columns)
         end do
      end associate
   end subroutine build_loads

   !> Faces that impactors may touch
   subroutine build_surfaces(model, domain)
      type(model_type), intent(in) :: model
      type(domain_type), intent(inout) :: domain
      logical :: held(domain%columns%freedoms)
      integer :: c, i, mover(domain%columns%freedoms)

      held(:) = .false.
      held(domain%held) = .true.
      mover(:) = 0
      do i = 1, size(domain%motions)
         mover(domain%motions(i)%freedom) = i
      end do
      domain%impactors = model%impactors
      domain%contacts = model%contacts
      allocate (domain%surfaces(size(model%contacts)))
      do i = 1, size(model%contacts)
         if (size(domain%bricks) > 0) then
            domain%surfaces(i) = new_brick_surface(model%contacts(i), model%mesh, domain%columns, &
               & domain%inverse_mass, held)
         else
            domain%surfaces(i) = new_surface(model%contacts(i), model%mesh, domain%layers, &
               & domain%columns, domain%inverse_mass, held)
            call couple_surface(domain, face_point(domain%layers, model%contacts(i)%face), &
               & domain%surfaces(i))
         end if
         associate (surface => domain%surfaces(i))
            allocate (surface%mover(3, size(surface%node)))
            do c = 1, 3
               surface%mover(c, :) = mover(surface%freedom(c, :))
            end do
         end associate
      end do
   end subroutine build_surfaces

end module plydyn_domain_build
