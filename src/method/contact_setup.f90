!> Sets up the contacts of impactors, and refuses what they would not see.
module plydyn_method_contact_setup
   use plydyn_base_error, only : error_type, exit_input, fail
   use plydyn_base_precision, only : wp
   use plydyn_base_text, only : text
   use plydyn_contact_bodies_body_nodes, only : distances_below
   use plydyn_contact_contact, only : contact_setup_type, new_contact
   use plydyn_contact_search_near_points, only : new_near_points
   use plydyn_domain_chunks, only : list_chunks
   use plydyn_domain_domain, only : domain_type, face_type
   use plydyn_method_contact_correction, only : new_contact_work
   use plydyn_method_contact_step, only : contacts_type, find_positions, pair_type
   use plydyn_model_curve, only : curve_type
   use plydyn_model_body, only : contact_type, impactor_type, points_on_plate
   use plydyn_model_support, only : prescribes_acceleration, prescribes_displacement
   use plydyn_state_state, only : state_type
   implicit none
   private

   public :: new_contacts

   !> Penetration at time zero that is round-off, as a share of the radius
   real(wp), parameter :: touching = 1.0e-9_wp
   !> Largest depth to which an impactor sinks in between points over that of its centre
   real(wp), parameter :: deepest_sinking = 0.75_wp
   !> Eigenvalue times the square of the step at which central differences become unstable
   real(wp), parameter :: most_rate = 4.0_wp
   !> Largest move in a step over the depth within which contact is seen
   real(wp), parameter :: largest_move = 0.5_wp

contains

   !> Build the contacts where plate and impactors are now; refuse what contact would not see.
   !> All ranks must come here
   subroutine new_contacts(domain, state, self, error)
      type(domain_type), intent(in) :: domain
      !> Displacement of the plate, and the impactors
      type(state_type), intent(in) :: state
      type(contacts_type), intent(out) :: self
      !> An impactor that begins inside the plate, is too fast, or slips in between its points
      type(error_type), allocatable, intent(out) :: error

      real(wp) :: gap
      integer :: i

      allocate (self%pairs(size(domain%contact%contacts)))
      allocate (self%reached(size(domain%chunks%list)), source=.false.)
      allocate (self%is_moved(0:size(domain%supports%motions)), source=.false.)
      self%work = new_contact_work(domain%columns)
      call prepare_fixtures(domain, self)
      call refuse_stiffness(domain, error)
      if (allocated(error)) return
      do i = 1, size(domain%contact%contacts)
         associate (contact => domain%contact%contacts(i), surface => domain%contact%surfaces(i), &
            & impactor => domain%contact%impactors(domain%contact%contacts(i)%impactor), &
            & pair => self%pairs(i), centre => state%impactors(domain%contact%contacts(i)%impactor &
            & )%centre)
            call make_room(contact, surface, pair)
            call find_positions(domain, surface, surface%of_ranks, surface%counts, state, pair)
            call refuse_passage(contact, surface, impactor, centre, error)
            if (.not. allocated(error)) call refuse_speed(domain, contact, impactor, error)
            if (allocated(error)) return
            call new_contact(pair%pair, contact_setup_type(body=impactor%body, &
               & inverse_mass=impactor%inverse_mass(), &
               & inverse_inertia=impactor%inverse_inertia(), &
               & friction=contact%friction, side=contact%face, &
               & exact_body=contact%method == points_on_plate, spacing=contact%spacing), &
               & surface%facet, pair%position, centre, error)
            if (allocated(error)) then
               error%message = place_of(contact, "SPACING")//error%message
               return
            end if
            call list_chunks(domain, surface, pair%chunks%last, pair%chunks%list)
            pair%inverse_mass = surface%inverse_mass
            gap = pair%pair%initial_gap(pair%position, centre)
            ! one that moved before this restart presses already; one that a restart adds meets the
            ! plate of its restart file
            if (any(abs(state%impactors(contact%impactor)%displacement) > 0.0_wp)) cycle
            if (contact%is_later .and. state%cycle == 0) cycle
            if (gap >= -touching*impactor%body%radius) cycle
            call fail(error, exit_input, place_of(contact, "FACE")//"impactor " &
               & //text(impactor%id)//" begins "//text(-gap)//" inside the plate: move its " &
               & //"centre by that much, or choose the other face")
            return
         end associate
      end do
   end subroutine new_contacts

   !> Points near fixtures, for clamps those that they press, and the chunks at each point of a face
   pure subroutine prepare_fixtures(domain, self)
      type(domain_type), intent(in) :: domain
      type(contacts_type), intent(inout) :: self

      type(face_type) :: points
      integer :: i, k

      associate (fixtures => domain%contact%fixtures, faces => domain%contact%fixture_faces)
         allocate (self%near(size(fixtures)))
         if (size(fixtures) == 0) return
         allocate (self%face_chunks(size(faces)))
         do i = 1, size(fixtures)
            self%near(i) = new_near_points(size(faces(fixtures(i)%surface)%here))
            if (fixtures(i)%is_clamp) call self%near(i)%list_all(fixtures(i)%below)
         end do
         do i = 1, size(faces)
            if (.not. any(fixtures%surface == i)) cycle
            ! each point is taken for a facet
            points%freedom = faces(i)%freedom
            if (allocated(points%facet)) deallocate (points%facet)
            allocate (points%facet(1, size(points%freedom, 2)))
            points%facet(1, :) = [(k, k=1, size(points%freedom, 2))]
            call list_chunks(domain, points, self%face_chunks(i)%last, self%face_chunks(i)%list)
         end do
      end associate
   end subroutine prepare_fixtures

   !> Refuse a clamp whose spring alone makes a point under it unstable; the same on all ranks
   subroutine refuse_stiffness(domain, error)
      type(domain_type), intent(in) :: domain
      !> Says which clamp
      type(error_type), allocatable, intent(out) :: error

      integer :: i
      real(wp) :: rate(1)

      do i = 1, size(domain%contact%fixtures)
         associate (clamp => domain%contact%fixtures(i), &
            & surface => domain%contact%fixture_faces(domain%contact%fixtures(i)%surface))
            if (.not. clamp%is_clamp .or. clamp%stiffness <= 0.0_wp) cycle
            rate(1) = 0.0_wp
            if (size(clamp%below) > 0) rate(1) = clamp%stiffness/clamp%area &
               & *maxval(surface%area(clamp%below)*surface%inverse_mass(3, clamp%below))
            call domain%comm%max(rate)
            if (rate(1)*domain%step**2 < most_rate) cycle
            call fail(error, exit_input, "error: "//clamp%place//": *FIXTURE_CLAMP STIFF: clamp " &
               & //text(clamp%id)//" is too stiff for the step of "//text(domain%step) &
               & //new_line("a")//"  right would be: a stiffness well below " &
               & //text(clamp%stiffness*most_rate/(rate(1)*domain%step**2)))
            return
         end associate
      end do
   end subroutine refuse_stiffness

   !> Room for the points of a contact, and for what ranks send each other about them
   pure subroutine make_room(contact, surface, pair)
      type(contact_type), intent(in) :: contact
      type(face_type), intent(in) :: surface
      type(pair_type), intent(inout) :: pair

      pair%position = surface%position
      if (contact%friction%static > 0.0_wp) then
         pair%sent_each = 6
         allocate (pair%motion)
         allocate (pair%motion%point, pair%motion%point_force, mold=surface%position)
      end if
      allocate (pair%sent(pair%sent_each*count(surface%own)))
      allocate (pair%received(pair%sent_each*size(surface%position, 2)))
   end subroutine make_room

   !> Location of a contact in the deck: file, line and field
   pure function place_of(contact, field) result(words)
      type(contact_type), intent(in) :: contact
      character(*), intent(in) :: field
      character(:), allocatable :: words

      words = "error: "//contact%place//": *CONTACT_IMPACTOR "//trim(field)//": "
   end function place_of

   !> Refuse an impactor that sinks in between points of the plate before it meets one
   subroutine refuse_passage(contact, surface, impactor, centre, error)
      type(contact_type), intent(in) :: contact
      type(face_type), intent(in) :: surface
      type(impactor_type), intent(in) :: impactor
      !> Its centre, length
      real(wp), intent(in) :: centre(3)
      type(error_type), allocatable, intent(out) :: error

      real(wp) :: apart(2), depth, lowest

      if (contact%method /= points_on_plate) return
      apart(:) = distances_below(surface%facet, surface%position, centre, impactor%body%radius)
      associate (body => impactor%body, side => contact%face)
         lowest = body%lowest_height(side)
         ! how deep it lies where points touch it, along x and y
         depth = max(body%vertical_gap([0.5_wp*apart(2), 0.0_wp, 0.0_wp], side), &
            & body%vertical_gap([0.0_wp, 0.5_wp*apart(2), 0.0_wp], side)) - lowest
         if (depth <= -deepest_sinking*lowest) return
         call fail(error, exit_input, place_of(contact, "METHOD")//"an impactor of radius " &
            & //text(body%radius)//" passes or sinks in between points of the plate that are " &
            & //text(apart(2))//" apart: make the mesh finer there, or use METHOD 1")
      end associate
   end subroutine refuse_passage

   !> Refuse an impactor that could come through the face in a step before contact sees it
   subroutine refuse_speed(domain, contact, impactor, error)
      type(domain_type), intent(in) :: domain
      type(contact_type), intent(in) :: contact
      type(impactor_type), intent(in) :: impactor
      type(error_type), allocatable, intent(out) :: error

      real(wp) :: longest, move, thickness

      longest = domain%control%end_time
      associate (cycles => domain%control%end_cycle)
         if (cycles > 0) longest = min(longest, cycles*domain%step)
      end associate
      move = largest_speed(impactor, domain%curves, longest)*domain%step
      thickness = -impactor%body%lowest_height(contact%face)
      ! bricks have no layers
      if (domain%layers%order(1) > 0) thickness = min(thickness, maxval(domain%layers%top) &
         & - minval(domain%layers%bottom))
      if (move <= largest_move*thickness) return
      call fail(error, exit_input, place_of(contact, "IID")//"impactor "//text(impactor%id) &
         & //" moves up to "//text(move)//" in a step, more than half of the depth " &
         & //text(thickness)//" within which contact sees it: make it slower, or the step " &
         & //"smaller by DTMAX of *CONTROL_LAYERWISE or TSSFAC of *CONTROL_TIMESTEP")
   end subroutine refuse_speed

   !> Bound on the speed of an impactor that nothing but its weight and its curves drive
   pure real(wp) function largest_speed(impactor, curves, end_time) result(speed)
      type(impactor_type), intent(in) :: impactor
      !> All curves
      type(curve_type), intent(in) :: curves(:)
      !> Time that it has at most
      real(wp), intent(in) :: end_time

      real(wp) :: along(3)
      integer :: c, k

      along(:) = abs(impactor%velocity) + end_time*abs(impactor%gravity)
      do c = 1, 3
         if (impactor%motion(c) == 0) cycle
         associate (x => curves(impactor%motion(c))%x, y => curves(impactor%motion(c))%y)
            if (impactor%quantity == prescribes_displacement) then
               along(c) = maxval([0.0_wp, (abs((y(k + 1) - y(k))/(x(k + 1) - x(k))), &
                  & k=1, size(x) - 1)])
            else if (impactor%quantity == prescribes_acceleration) then
               along(c) = along(c) + end_time*maxval(abs(y))
            else
               along(c) = maxval(abs(y))
            end if
         end associate
      end do
      speed = norm2(along)
   end function largest_speed

end module plydyn_method_contact_setup
