!> Field states of bricks. Every part has points of its own, so that values jump between parts and
!> are continuous within them.
module plydyn_output_brick_fields
   use plydyn_base_error, only : error_type
   use plydyn_base_precision, only : lanes, wp
   use plydyn_domain_domain, only : domain_type
   use plydyn_element_brick_recover, only : brick_recovered, brick_values, ply_strain_at, &
      & ply_stress_at, scalars_at, strain_at, stress_at
   use plydyn_law_law, only : scalar_names
   use plydyn_model_control, only : total_lagrangian
   use plydyn_model_mesh, only : mesh_type
   use plydyn_model_model, only : model_type
   use plydyn_output_components, only : field_components, tensor, tensor_share
   use plydyn_output_description, only : describe_file
   use plydyn_output_places, only : places_type
   use plydyn_output_vtkhdf, only : vtkhdf_type
   use plydyn_state_state, only : state_type
   implicit none
   private

   !> VTK's cell of eight nodes
   integer, parameter :: hexahedron = 12

   !> The file of fields
   type, public :: brick_fields_type
      private
      type(vtkhdf_type) :: file
      !> Names of the fields to write
      character(16), allocatable :: names(:)
      !> Node of each point
      integer, allocatable :: node(:)
      !> Points of each brick, (8, bricks)
      integer, allocatable :: point(:, :)
   contains
      procedure :: open => open_fields
      procedure :: write => write_state
      procedure :: mark => mark_fields
      procedure :: close => close_fields
   end type brick_fields_type

contains

   !> Create the file, if there are bricks
   subroutine open_fields(self, path, deck, version, model, domain, places, error)
      class(brick_fields_type), intent(inout) :: self
      !> Path of the file
      character(*), intent(in) :: path
      !> Path of the deck, version of the program
      character(*), intent(in) :: deck, version
      !> The model
      type(model_type), intent(in) :: model
      !> The domain
      type(domain_type), intent(in) :: domain
      !> Where to go on with files of an earlier run
      type(places_type), intent(in) :: places
      !> Why it could not be written
      type(error_type), allocatable, intent(out) :: error

      integer :: i

      if (size(domain%bricks) == 0) return
      self%names = model%request%fields
      call number_points(model%mesh, size(model%parts), self%node, self%point)
      call self%file%create(path, model%mesh%position(:, self%node), reshape(self%point - 1, &
         & [size(self%point)]), [(8*i, i=0, size(self%point, 2))], &
         & spread(hexahedron, 1, size(self%point, 2)), error)
      if (allocated(error)) return
      call describe_file(self%file, deck, version, model, error)
      if (allocated(error)) return
      call add_cell_fields(self, model, error)
      do i = 1, size(self%names)
         if (allocated(error)) return
         call self%file%declare_point_data(trim(self%names(i)), field_components(self%names(i)), &
            & error)
      end do
      if (allocated(error)) return
      call self%file%settle(places, error)
   end subroutine open_fields

   !> Points of the parts, one part after the other
   pure subroutine number_points(mesh, parts, node, point)
      type(mesh_type), intent(in) :: mesh
      !> How many parts there are
      integer, intent(in) :: parts
      !> Node of each point; points of each brick
      integer, allocatable, intent(out) :: node(:), point(:, :)

      integer :: all_nodes(size(mesh%brick_node)), e, i, known, number(size(mesh%node_id)), p

      allocate (point(size(mesh%brick_node, 1), size(mesh%brick_id)))
      known = 0
      do p = 1, parts
         number(:) = 0
         do e = 1, size(mesh%brick_id)
            if (mesh%brick_part(e) /= p) cycle
            do i = 1, size(point, 1)
               associate (n => mesh%brick_node(i, e))
                  if (number(n) == 0) then
                     known = known + 1
                     number(n) = known
                     all_nodes(known) = n
                  end if
                  point(i, e) = number(n)
               end associate
            end do
         end do
      end do
      node = all_nodes(:known)
   end subroutine number_points

   !> What does not change: part, element, angle, fibre
   subroutine add_cell_fields(self, model, error)
      type(brick_fields_type), intent(inout) :: self
      type(model_type), intent(in) :: model
      type(error_type), allocatable, intent(out) :: error

      real(wp), parameter :: degree = acos(-1.0_wp)/180.0_wp
      real(wp) :: angle(size(model%mesh%brick_id)), fibre(3, size(model%mesh%brick_id))
      integer :: i, part(size(model%mesh%brick_id))

      do i = 1, size(angle)
         associate (p => model%parts(model%mesh%brick_part(i)))
            part(i) = p%id
            angle(i) = p%plies(1)%angle
         end associate
      end do
      fibre(1, :) = cos(angle*degree)
      fibre(2, :) = sin(angle*degree)
      fibre(3, :) = 0.0_wp
      call self%file%add_cell_data("part", part, error)
      if (allocated(error)) return
      call self%file%add_cell_data("element", model%mesh%brick_id, error)
      if (allocated(error)) return
      call self%file%add_cell_data("angle", angle, error)
      if (allocated(error)) return
      call self%file%add_cell_data("fibre", fibre, error)
   end subroutine add_cell_fields

   !> Write the present state; it is whole in the file when this returns
   subroutine write_state(self, domain, state, error)
      class(brick_fields_type), intent(inout) :: self
      !> The domain
      type(domain_type), intent(in) :: domain
      !> The state
      type(state_type), intent(in) :: state
      !> Why it could not be written
      type(error_type), allocatable, intent(out) :: error

      character(:), allocatable :: name
      real(wp), allocatable :: values(:, :)
      integer :: i

      if (.not. self%file%is_open()) return
      call self%file%begin_step(state%time)
      if (any(self%names /= "displacement" .and. self%names /= "velocity")) then
         values = point_values(self, domain, state)
      end if
      do i = 1, size(self%names)
         name = trim(self%names(i))
         associate (file => self%file)
            select case (name)
            case ("displacement")
               call file%write_point_data(name, at_points(self, domain, state%displacement), error)
            case ("velocity")
               call file%write_point_data(name, at_points(self, domain, state%velocity &
                  & + 0.5_wp*state%step_before*state%acceleration(:size(state%velocity))), error)
            case ("strain")
               call file%write_point_data(name, tensor(values, strain_at, tensor_share), error)
            case ("stress")
               call file%write_point_data(name, tensor(values, stress_at), error)
            case ("strain_ply")
               call file%write_point_data(name, tensor(values, ply_strain_at, tensor_share), error)
            case ("stress_ply")
               call file%write_point_data(name, tensor(values, ply_stress_at), error)
            case default
               call file%write_point_data(name, &
                  & values(scalars_at + findloc(scalar_names == name, .true., 1), :), error)
            end select
         end associate
         if (allocated(error)) return
      end do
      call self%file%end_step(error)
   end subroutine write_state

   !> Displacement or velocity at the points, (3, points)
   pure function at_points(self, domain, motion) result(values)
      type(brick_fields_type), intent(in) :: self
      type(domain_type), intent(in) :: domain
      real(wp), intent(in) :: motion(:)
      real(wp), allocatable :: values(:, :)
      integer :: i

      allocate (values(3, size(self%node)))
      do i = 1, size(self%node)
         values(:, i) = motion(domain%columns%freedom(1, 1, [1, 2, 3], self%node(i)))
      end do
   end function at_points

   !> Strain, stress and scalars at the points: the mean of the bricks that meet there, by volume,
   !> (`brick_recovered`, points)
   pure function point_values(self, domain, state) result(values)
      type(brick_fields_type), intent(in) :: self
      type(domain_type), intent(in) :: domain
      type(state_type), intent(in) :: state
      real(wp), allocatable :: values(:, :)

      real(wp) :: batch(lanes, brick_recovered), volume(lanes), whole(size(self%node))
      integer :: b, i, l, last, p

      allocate (values(brick_recovered, size(self%node)))
      values(:, :) = 0.0_wp
      whole(:) = 0.0_wp
      do p = 1, size(domain%bricks)
         associate (bricks => domain%bricks(p))
            last = bricks%first_history - 1 &
               & + lanes*bricks%histories*bricks%points*size(bricks%shape)
            do b = 1, size(bricks%shape)
               batch(:, :) = brick_values(bricks, b, &
                  & domain%control%kinematics == total_lagrangian, state%displacement, &
                  & state%history(bricks%first_history:last))
               volume(:) = sum(bricks%shapes(bricks%shape(b))%volume, 2)
               do l = 1, min(lanes, size(bricks%brick) - lanes*(b - 1))
                  associate (point => self%point(:, bricks%brick(lanes*(b - 1) + l)))
                     do i = 1, size(point)
                        values(:, point(i)) = values(:, point(i)) + volume(l)*batch(l, :)
                        whole(point(i)) = whole(point(i)) + volume(l)
                     end do
                  end associate
               end do
            end do
         end associate
      end do
      do i = 1, size(whole)
         values(:, i) = values(:, i)/whole(i)
      end do
   end function point_values

   !> Note how many states there are, once all are on the disk
   subroutine mark_fields(self, places, error)
      class(brick_fields_type), intent(inout) :: self
      !> Gets the place
      type(places_type), intent(inout) :: places
      !> Why something is not on the disk
      type(error_type), allocatable, intent(out) :: error

      if (self%file%is_open()) call self%file%mark(places, error)
   end subroutine mark_fields

   !> Close the file
   subroutine close_fields(self, error)
      class(brick_fields_type), intent(inout) :: self
      !> Why it could not be closed
      type(error_type), allocatable, intent(out) :: error

      call self%file%close(error)
   end subroutine close_fields

end module plydyn_output_brick_fields
