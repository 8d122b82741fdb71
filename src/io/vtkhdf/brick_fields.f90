!> Field states of bricks. Every part has points of its own, so that values jump between parts and
!> are continuous within them.
module plydyn_io_vtkhdf_brick_fields
   use plydyn_base_error, only : error_type
   use plydyn_base_precision, only : lanes, wp
   use plydyn_base_sort, only : sorted_order
   use plydyn_domain_domain, only : domain_type
   use plydyn_element_brick_recover, only : brick_values
   use plydyn_element_recover, only : recovered
   use plydyn_model_control, only : total_lagrangian
   use plydyn_model_model, only : model_type
   use plydyn_io_vtkhdf_components, only : field_components
   use plydyn_io_vtkhdf_plate_grid, only : band_of_rows
   use plydyn_io_vtkhdf_requested_fields, only : point_fields_type
   use plydyn_io_vtkhdf_output_nodes, only : new_accumulators, number_sites, accumulators_type
   use plydyn_io_vtkhdf_vtkhdf, only : piece_type, hyperslab_type
   use plydyn_state_state, only : state_type
   implicit none
   private

   !> VTK's cell of eight nodes
   integer, parameter :: hexahedron = 12

   !> The file of fields
   type, public, extends(point_fields_type) :: brick_fields_type
      private
      !> Bricks that this rank writes
      type(hyperslab_type) :: cells
      !> Sites of the bricks that it has, in the order of the mesh
      type(accumulators_type) :: slots
      !> Set of bricks and place in it of each of these, (2, bricks)
      integer, allocatable :: home(:, :)
      !> Places of x of each slot in the arrays of motion
      integer, allocatable :: place(:)
   contains
      procedure :: create_grid
      procedure :: add_cell_fields
      procedure :: motion_values
      procedure :: recovered_values
   end type brick_fields_type

   !> Values of a set of bricks
   type :: set_values_type
      real(wp), allocatable :: values(:, :)
   end type set_values_type

contains

   !> Create the file, if there are bricks
   subroutine create_grid(self, path, model, domain, error)
      class(brick_fields_type), intent(inout) :: self
      character(*), intent(in) :: path
      type(model_type), intent(in) :: model
      type(domain_type), intent(in) :: domain
      type(error_type), allocatable, intent(out) :: error

      integer, allocatable :: node(:), site(:, :)
      type(piece_type) :: piece
      integer :: i

      if (size(domain%bricks) == 0) return
      self%names = model%request%fields
      self%components = field_components(self%names)
      associate (mesh => model%mesh)
         call number_sites(mesh%brick_part, mesh%brick_node, size(mesh%node_id), site, node)
         call find_bricks(self, domain)
         self%slots = new_accumulators(domain%comm, site, [(domain%bricks(self%home(1, i))%brick( &
            & self%home(2, i)), i=1, size(self%home, 2))], 1)
         call place_slots(self, domain)
         piece%points = self%slots%points()
         associate (points => piece%points)
            piece%position = mesh%position(:, node(points%first + 1:points%first + points%count))
         end associate
      end associate
      self%cells = band_of_rows(domain, size(site, 2))
      call make_cells(site, self%cells, piece)
      call self%file%create(path, domain%comm, piece, error)
   end subroutine create_grid

   !> Find the bricks of this rank, in the order of the mesh
   pure subroutine find_bricks(self, domain)
      type(brick_fields_type), intent(inout) :: self
      type(domain_type), intent(in) :: domain

      integer :: i, p

      associate (bricks => domain%bricks)
         self%home = reshape([(([p, i], i=1, size(bricks(p)%brick)), p=1, size(bricks))], &
            & [2, sum([(size(bricks(p)%brick), p=1, size(bricks))])])
         self%home(:, :) = self%home(:, sorted_order([(bricks(p)%brick, p=1, size(bricks))]))
      end associate
   end subroutine find_bricks

   !> Where the motion of the slots is
   pure subroutine place_slots(self, domain)
      type(brick_fields_type), intent(inout) :: self
      type(domain_type), intent(in) :: domain

      integer :: i

      allocate (self%place(self%slots%count))
      do i = 1, size(self%home, 2)
         associate (number => self%home(2, i) - 1)
            self%place(self%slots%slot(:, i)) = domain%bricks(self%home(1, i))%place( &
               & mod(number, lanes) + 1, :, number/lanes + 1)
         end associate
      end do
   end subroutine place_slots

   !> The cells that this rank writes
   pure subroutine make_cells(site, cells, piece)
      !> Sites of all bricks
      integer, intent(in) :: site(:, :)
      type(hyperslab_type), intent(in) :: cells
      type(piece_type), intent(inout) :: piece

      integer :: i

      piece%cells = cells
      piece%before = size(site, 1)*cells%first
      piece%all_ends = size(site)
      piece%connectivity = reshape(site(:, cells%first + 1:cells%first + cells%count) - 1, &
         & [size(site, 1)*cells%count])
      piece%offset = [(size(site, 1)*i, i=cells%first, cells%first + cells%count &
         & - merge(0, 1, cells%first + cells%count == cells%whole))]
      piece%kind = spread(hexahedron, 1, cells%count)
   end subroutine make_cells

   !> What does not change: part, element, angle, fibre
   subroutine add_cell_fields(self, model, domain, error)
      class(brick_fields_type), intent(inout) :: self
      type(model_type), intent(in) :: model
      type(domain_type), intent(in) :: domain
      type(error_type), allocatable, intent(out) :: error

      real(wp), parameter :: degree = acos(-1.0_wp)/180.0_wp
      real(wp) :: angle(self%cells%count), fibre(3, self%cells%count)
      integer :: element(self%cells%count), part(self%cells%count)

      associate (mesh => model%mesh, before => self%cells%first, &
         & last => self%cells%first + self%cells%count)
         element(:) = mesh%brick_id(before + 1:last)
         part(:) = model%parts(mesh%brick_part(before + 1:last))%id
         angle(:) = mesh%brick_angle(before + 1:last)
      end associate
      fibre(1, :) = cos(angle*degree)
      fibre(2, :) = sin(angle*degree)
      fibre(3, :) = 0.0_wp
      call self%file%add_cell_data("part", part, error)
      if (allocated(error)) return
      call self%file%add_cell_data("element", element, error)
      if (allocated(error)) return
      call self%file%add_cell_data("angle", angle, error)
      if (allocated(error)) return
      call self%file%add_cell_data("fibre", fibre, error)
   end subroutine add_cell_fields

   !> Displacement or velocity at the points of this rank, (3, points)
   function motion_values(self, domain, motion) result(values)
      class(brick_fields_type), intent(in) :: self
      type(domain_type), intent(in) :: domain
      real(wp), intent(in) :: motion(:)
      real(wp), allocatable :: values(:, :)

      real(wp) :: at_slot(3, 1, self%slots%count)
      integer :: c

      do c = 1, 3
         at_slot(c, 1, :) = motion(self%place + lanes*(c - 1))
      end do
      allocate (values(3, self%slots%own_points()))
      call self%slots%hand_over(at_slot, values)
   end function motion_values

   !> Strain, stress and scalars at the points of this rank: the mean of the bricks of a part that
   !> meet there, by volume, (`recovered`, points)
   function recovered_values(self, domain, state) result(values)
      class(brick_fields_type), intent(in) :: self
      type(domain_type), intent(in) :: domain
      type(state_type), intent(in) :: state
      real(wp), allocatable :: values(:, :)

      type(set_values_type) :: sets(size(domain%bricks))
      real(wp) :: sums(recovered + 1, 1, self%slots%count)
      integer :: i, n, p

      do p = 1, size(sets)
         call find_set(domain, p, state, sets(p)%values)
      end do
      sums(:, :, :) = 0.0_wp
      do i = 1, size(self%home, 2)
         associate (here => sets(self%home(1, i))%values(:, self%home(2, i)))
            do n = 1, size(self%slots%slot, 1)
               associate (total => sums(:, 1, self%slots%slot(n, i)))
                  total(:) = total + here
               end associate
            end do
         end associate
      end do
      allocate (values(recovered, self%slots%own_points()))
      call self%slots%mean(sums, values)
   end function recovered_values

   !> Values of a set of bricks times their volumes, and the volumes, (`recovered` + 1, bricks)
   subroutine find_set(domain, p, state, values)
      type(domain_type), intent(in) :: domain
      integer, intent(in) :: p
      type(state_type), intent(in) :: state
      real(wp), allocatable, intent(out) :: values(:, :)

      real(wp) :: batch(lanes, recovered), volume(lanes)
      integer :: b, l, last

      associate (bricks => domain%bricks(p))
         allocate (values(recovered + 1, lanes*size(bricks%shape)))
         last = bricks%first_history - 1 &
            & + lanes*bricks%histories*bricks%points*size(bricks%shape)
         do b = 1, size(bricks%shape)
            batch(:, :) = brick_values(bricks, b, domain%control%kinematics == total_lagrangian, &
               & state%displacement, state%history(bricks%first_history:last))
            volume(:) = sum(bricks%shapes(bricks%shape(b))%volume, 2)
            do l = 1, lanes
               values(:recovered, lanes*(b - 1) + l) = volume(l)*batch(l, :)
               values(recovered + 1, lanes*(b - 1) + l) = volume(l)
            end do
         end do
      end associate
   end subroutine find_set

end module plydyn_io_vtkhdf_brick_fields
