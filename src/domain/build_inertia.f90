!> Inertia that locally implicit operators add, for the largest step of the run.
module plydyn_domain_build_inertia
   use plydyn_base_error, only : error_type, exit_input, fail
   use plydyn_base_precision, only : wp
   use plydyn_domain_build_columns, only : held_links, links_within, new_column_inertia
   use plydyn_domain_domain, only : domain_type, surface_type
   use plydyn_domain_links, only : links_type
   use plydyn_domain_node_classes, only : node_areas
   use plydyn_domain_pair_inertia, only : joint_stiffness, new_pair_inertia
   use plydyn_model_control, only : implicit_interfaces, implicit_thickness, total_lagrangian
   use plydyn_model_model, only : model_type
   use plydyn_model_support, only : all_planes
   implicit none
   private

   public :: build_inertia, couple_surface, largest_step

contains

   !> The share of the stable step that the deck allows, within its bounds
   pure real(wp) function largest_step(domain) result(step)
      !> The domain
      type(domain_type), intent(in) :: domain

      associate (control => domain%control)
         step = control%step_factor*domain%limit%step
         if (control%largest_step > 0.0_wp) step = min(step, control%largest_step)
         if (control%step_curve > 0) step = min(step, maxval(domain%curves(control%step_curve)%y))
      end associate
   end function largest_step

   !> All that the scheme of the deck adds
   subroutine build_inertia(model, domain, error)
      !> The model
      type(model_type), intent(in) :: model
      !> The domain; its supports, joints and step are known
      type(domain_type), intent(inout) :: domain
      !> Why the scheme does not go with the model
      type(error_type), allocatable, intent(out) :: error

      real(wp) :: joint(3, size(domain%layers%joint))

      allocate (domain%moved_links%place(2, 0), domain%moved_links%inertia(0))
      allocate (domain%held_links%place(2, 0), domain%held_links%inertia(0))
      associate (scheme => domain%control%scheme)
         if (scheme /= implicit_interfaces .and. scheme /= implicit_thickness) return
         call check_scheme(model, domain, error)
         if (allocated(error)) return
         joint(:, :) = joint_stiffness(domain%interfaces, size(joint, 2), &
            & domain%control%kinematics == total_lagrangian)
         domain%pairs = new_pair_inertia(domain%columns, domain%mass, &
            & sum(node_areas(domain%plates, domain%position), 2), joint, domain%step)
         if (scheme == implicit_interfaces) then
            domain%moved_links = domain%pairs%links_between(domain%columns, is_moved(domain))
         else
            ! columns take the pairs with them
            domain%pairs%active = .false.
            domain%thickness = new_column_inertia(domain, joint)
            domain%moved_links = links_within(domain, joint, is_moved(domain))
            domain%held_links = held_links(domain, joint)
         end if
      end associate
   end subroutine build_inertia

   !> What a scheme needs, and what it does not go with
   subroutine check_scheme(model, domain, error)
      type(model_type), intent(in) :: model
      type(domain_type), intent(in) :: domain
      type(error_type), allocatable, intent(out) :: error

      if (size(domain%bricks) > 0) then
         call fail(error, exit_input, "IMPL of *CONTROL_LAYERWISE does not go with bricks: leave " &
            & //"it at 0")
      else if (domain%control%scheme == implicit_interfaces .and. size(domain%interfaces) == 0) then
         call fail(error, exit_input, "IMPL 1 of *CONTROL_LAYERWISE makes interfaces implicit, " &
            & //"but no plies are joined by one: leave IMPL at 0")
      else if (domain%control%scheme == implicit_thickness &
         & .and. any(model%motions%face /= all_planes)) then
         call fail(error, exit_input, "IMPL 2 of *CONTROL_LAYERWISE couples all points above a " &
            & //"node, which does not go with *BOUNDARY_FACE_MOTION on one face: take IMPL 1, " &
            & //"or *BOUNDARY_PRESCRIBED_MOTION_SET, which moves all planes")
      end if
   end subroutine check_scheme

   !> Whether each place in the arrays of motion has a prescribed motion
   pure function is_moved(domain) result(moved)
      type(domain_type), intent(in) :: domain
      logical :: moved(domain%columns%freedoms)
      integer :: m

      moved(:) = .false.
      do m = 1, size(domain%motions)
         moved(domain%motions(m)%freedom) = .true.
      end do
   end function is_moved

   !> Inverse masses of the points of a face that take their columns with them
   pure subroutine couple_surface(domain, face, surface)
      !> The domain
      type(domain_type), intent(in) :: domain
      !> Layer and thickness node of the face
      integer, intent(in) :: face(2)
      !> The surface
      type(surface_type), intent(inout) :: surface

      integer :: c, freedom, i

      if (.not. domain%thickness%active) return
      associate (columns => domain%thickness)
         freedom = columns%freedom(columns%row_of(domain%columns, face(1), face(2)))
         surface%follow = columns%followers(freedom)
         do i = 1, size(surface%node)
            do c = 1, 3
               surface%inverse_mass(c, i) = surface%inverse_mass(c, i) &
                  & *columns%own_response(freedom, columns%kind(c, surface%node(i)))
            end do
         end do
      end associate
   end subroutine couple_surface

end module plydyn_domain_build_inertia
