!> Supports, loads, velocities and faces on the points that a rank has.
module plydyn_domain_build_points
   use plydyn_base_precision, only : wp
   use plydyn_domain_build_inertia, only : couple_surface
   use plydyn_domain_domain, only : domain_type, surface_type
   use plydyn_domain_loads, only : line_force, new_body_load, new_face_load, &
      & new_point_load, new_segment_load, order_load, pressure_force
   use plydyn_domain_local_to_global, only : local_to_global_type
   use plydyn_domain_supports, only : face_point, find_held, new_prescribed
   use plydyn_domain_surfaces, only : collect_points, new_surface, place_points
   use plydyn_model_model, only : model_type
   implicit none
   private

   public :: build_loads, build_supports, build_surface, build_surfaces

contains

   !> Held places, prescribed motions, and velocities at time zero
   subroutine build_supports(model, numbering, domain)
      type(model_type), intent(in) :: model
      !> The rank's numbers of columns
      type(local_to_global_type), intent(in) :: numbering
      !> Gets them
      type(domain_type), intent(inout) :: domain
      integer :: i

      call find_held(model%supports, numbering, domain%layers, domain%columns, &
         & domain%supports%held, domain%supports%support)
      allocate (domain%supports%motions(size(model%motions)))
      do i = 1, size(model%motions)
         domain%supports%motions(i) = new_prescribed(model%motions(i), numbering, domain)
      end do
      domain%supports%initial_velocities = model%initial_velocities
      do i = 1, size(model%initial_velocities)
         domain%supports%initial_velocities(i)%nodes = &
            & numbering%only(model%initial_velocities(i)%nodes)
      end do
   end subroutine build_supports

   !> Forces on points
   subroutine build_loads(model, numbering, domain)
      type(model_type), intent(in) :: model
      !> The rank's numbers of columns
      type(local_to_global_type), intent(in) :: numbering
      !> Has its masses; gets loads
      type(domain_type), intent(inout) :: domain
      integer :: i, k

      allocate (domain%loads(size(model%point_loads) + size(model%line_loads) &
         & + size(model%pressures) + size(model%segment_loads) + size(model%body_loads)))
      k = 0
      associate (loads => domain%loads)
         do i = 1, size(model%point_loads)
            k = k + 1
            loads(k) = new_point_load(model%point_loads(i), numbering, domain)
         end do
         do i = 1, size(model%line_loads)
            k = k + 1
            associate (load => model%line_loads(i))
               loads(k) = new_face_load(load%face, load%direction, load%curve, &
                  & line_force(load, model%mesh), numbering, domain)
            end associate
         end do
         do i = 1, size(model%pressures)
            k = k + 1
            associate (load => model%pressures(i))
               loads(k) = new_face_load(load%face, 3, load%curve, &
                  & pressure_force(load, model%mesh), numbering, domain)
            end associate
         end do
         do i = 1, size(model%segment_loads)
            k = k + 1
            loads(k) = new_segment_load(model%segment_loads(i), model%mesh, numbering, &
               & domain%columns)
         end do
         do i = 1, size(model%body_loads)
            k = k + 1
            loads(k) = new_body_load(model%body_loads(i), domain)
         end do
         do k = 1, size(loads)
            call order_load(loads(k), numbering, domain%columns)
         end do
      end associate
   end subroutine build_loads

   !> Faces that impactors may touch. All ranks must come here
   subroutine build_surfaces(model, numbering, owner, domain)
      type(model_type), intent(in) :: model
      !> The rank's numbers of columns
      type(local_to_global_type), intent(in) :: numbering
      !> Rank that counts each column
      integer, intent(in) :: owner(:)
      !> Has its masses, supports and inertia; gets faces
      type(domain_type), intent(inout) :: domain

      integer :: i

      allocate (domain%contact%surfaces(size(model%contacts)))
      do i = 1, size(model%contacts)
         associate (contact => model%contacts(i))
            call build_surface(model, contact%parts, contact%face, numbering, owner, domain, &
               & domain%contact%surfaces(i))
         end associate
      end do
   end subroutine build_surfaces

   !> A face of the plate on the points that a rank has. All ranks must come here
   subroutine build_surface(model, parts, face, numbering, owner, domain, surface)
      type(model_type), intent(in) :: model
      !> Indices of the parts, or `all_parts`
      integer, intent(in) :: parts(:)
      !> `bottom_face` or `top_face`
      integer, intent(in) :: face
      !> The rank's numbers of columns
      type(local_to_global_type), intent(in) :: numbering
      !> Rank that counts each column
      integer, intent(in) :: owner(:)
      !> Has its masses, supports and inertia
      type(domain_type), intent(in) :: domain
      !> The face
      type(surface_type), intent(out) :: surface

      integer :: point(2)

      point(:) = face_point(domain%layers, face)
      surface = new_surface(parts, face, model%mesh, domain%layers)
      call place_points(point, numbering, owner, domain%comm%ranks, domain%columns, surface)
      call set_resistance(domain, point, surface)
   end subroutine build_surface

   !> Inverse masses of all points of a face, and what moves them
   subroutine set_resistance(domain, point, surface)
      type(domain_type), intent(in) :: domain
      !> Layer and thickness node of the face
      integer, intent(in) :: point(2)
      type(surface_type), intent(inout) :: surface

      real(wp) :: values(6, size(surface%node))
      logical :: held(domain%columns%freedoms)
      integer :: c, i, motion(domain%columns%freedoms)

      held(:) = .false.
      held(domain%supports%held) = .true.
      motion(:) = 0
      do i = 1, size(domain%supports%motions)
         motion(domain%supports%motions(i)%freedom) = i
      end do
      values(:, :) = 0.0_wp
      associate (here => surface%here)
         do c = 1, 3
            values(c, here) = merge(0.0_wp, domain%inertia%inverse_mass( &
               & domain%columns%mass_of(point(1), &
               & point(2), surface%node(here))), held(surface%freedom(c, here)))
            values(3 + c, here) = real(motion(surface%freedom(c, here)), wp)
         end do
      end associate
      call couple_surface(domain, point, surface, values(:3, :))
      call collect_points(domain%comm, surface, values)
      surface%inverse_mass = values(:3, :)
      surface%motion = nint(values(4:, :))
   end subroutine set_resistance

end module plydyn_domain_build_points
