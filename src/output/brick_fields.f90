!> Field states of bricks. Every part has points of its own, so that values jump between parts and
!> are continuous within them.
module plydyn_output_brick_fields
   use plydyn_base_error, only : error_type
   use plydyn_base_precision, only : lanes, wp
   use plydyn_domain_domain, only : domain_type
   use plydyn_element_brick_recover, only : brick_values
   use plydyn_element_recover, only : recovered
   use plydyn_model_control, only : total_lagrangian
   use plydyn_model_mesh, only : mesh_type
   use plydyn_model_model, only : model_type
   use plydyn_output_components, only : field_components
   use plydyn_output_point_fields, only : point_fields_type
   use plydyn_state_state, only : state_type
   implicit none
   private

   !> VTK's cell of eight nodes
   integer, parameter :: hexahedron = 12

   !> The file of fields
   type, public, extends(point_fields_type) :: brick_fields_type
      private
      !> Node of each point
      integer, allocatable :: node(:)
      !> Points of each brick, (8, bricks)
      integer, allocatable :: point(:, :)
   contains
      procedure :: create_grid
      procedure :: add_cell_fields
      procedure :: motion_values
      procedure :: recovered_values
   end type brick_fields_type

contains

   !> Create the file, if there are bricks
   subroutine create_grid(self, path, model, domain, error)
      class(brick_fields_type), intent(inout) :: self
      character(*), intent(in) :: path
      type(model_type), intent(in) :: model
      type(domain_type), intent(in) :: domain
      type(error_type), allocatable, intent(out) :: error

      integer :: i

      if (size(domain%bricks) == 0) return
      self%names = model%request%fields
      self%components = field_components(self%names)
      call number_points(model%mesh, size(model%parts), self%node, self%point)
      call self%file%create(path, model%mesh%position(:, self%node), reshape(self%point - 1, &
         & [size(self%point)]), [(8*i, i=0, size(self%point, 2))], &
         & spread(hexahedron, 1, size(self%point, 2)), error)
   end subroutine create_grid

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
   subroutine add_cell_fields(self, model, domain, error)
      class(brick_fields_type), intent(inout) :: self
      type(model_type), intent(in) :: model
      type(domain_type), intent(in) :: domain
      type(error_type), allocatable, intent(out) :: error

      real(wp), parameter :: degree = acos(-1.0_wp)/180.0_wp
      real(wp) :: angle(size(model%mesh%brick_id)), fibre(3, size(model%mesh%brick_id))
      integer :: part(size(model%mesh%brick_id))

      part(:) = model%parts(model%mesh%brick_part)%id
      angle(:) = model%mesh%brick_angle
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

   !> Displacement or velocity at the points, (3, points)
   function motion_values(self, domain, motion) result(values)
      class(brick_fields_type), intent(in) :: self
      type(domain_type), intent(in) :: domain
      real(wp), intent(in) :: motion(:)
      real(wp), allocatable :: values(:, :)
      integer :: i

      allocate (values(3, size(self%node)))
      do i = 1, size(self%node)
         values(:, i) = motion(domain%columns%freedom(1, 1, [1, 2, 3], self%node(i)))
      end do
   end function motion_values

   !> Strain, stress and scalars at the points: the mean of the bricks that meet there, by volume,
   !> (`recovered`, points)
   function recovered_values(self, domain, state) result(values)
      class(brick_fields_type), intent(in) :: self
      type(domain_type), intent(in) :: domain
      type(state_type), intent(in) :: state
      real(wp), allocatable :: values(:, :)

      real(wp) :: batch(lanes, recovered), volume(lanes), whole(size(self%node))
      integer :: b, i, l, last, p

      allocate (values(recovered, size(self%node)))
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
   end function recovered_values

end module plydyn_output_brick_fields
