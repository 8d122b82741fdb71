!> Field states of the elements of one family: displacement, velocity, strain and stress at the
!> points of their cells.
module plydyn_io_vtkhdf_element_fields
   use plydyn_base_error, only : error_type
   use plydyn_base_precision, only : wp
   use plydyn_domain_domain, only : domain_type
   use plydyn_element_group, only : ply_strain_at, ply_stress_at, recovered, scalars_at, &
      & strain_at, stress_at
   use plydyn_fem_columns, only : columns_type
   use plydyn_fem_expansion, only : lagrange
   use plydyn_model_model, only : model_type
   use plydyn_io_vtkhdf_element_grid, only : grid_type, new_grid
   use plydyn_io_vtkhdf_vtkhdf, only : piece_type
   use plydyn_state_state, only : state_type
   use plydyn_law_law, only : scalar_names
   use plydyn_io_vtkhdf_field_file, only : field_file_type
   implicit none
   private

   public :: field_components

   !> Numbers of a symmetric tensor
   integer, parameter :: tensor_components = 6

   !> Order of VTK's symmetric tensors, xx yy zz xy yz xz, in that of the recovered values
   integer, parameter :: vtk_order(6) = [1, 2, 3, 4, 6, 5]
   !> From engineering shear to tensor shear
   real(wp), parameter :: tensor_share(6) = [1.0_wp, 1.0_wp, 1.0_wp, 0.5_wp, 0.5_wp, 0.5_wp]

   !> The file of fields
   type, public, extends(field_file_type) :: element_fields_type
      private
      type(grid_type) :: grid
      !> Whether strain or stress is asked for; they take longer than the scalars of laws
      logical :: has_tensors = .false.
   contains
      procedure :: create_grid
      procedure :: add_cell_fields
      procedure :: write_fields
   end type element_fields_type

contains

   !> Create the file, if there are elements with cells
   subroutine create_grid(self, path, model, domain, error)
      class(element_fields_type), intent(inout) :: self
      character(*), intent(in) :: path
      type(model_type), intent(in) :: model
      type(domain_type), intent(in) :: domain
      type(error_type), allocatable, intent(out) :: error

      type(piece_type) :: piece

      call new_grid(model%mesh, domain, self%grid, piece)
      if (self%grid%group == 0) return
      self%names = model%request%fields
      self%components = field_components(self%names)
      self%has_tensors = any(self%components == tensor_components)
      call self%file%create_grid(path, domain%comm, piece, error)
   end subroutine create_grid

   !> What does not change: ply, part, element, angle, fibre
   subroutine add_cell_fields(self, model, domain)
      class(element_fields_type), intent(inout) :: self
      type(model_type), intent(in) :: model
      type(domain_type), intent(in) :: domain

      real(wp), parameter :: degree = acos(-1.0_wp)/180.0_wp
      real(wp) :: angle(size(self%grid%sheet)), fibre(3, size(self%grid%sheet))
      integer, dimension(size(self%grid%sheet)) :: element, part, ply, ply_id
      integer :: i

      do i = 1, size(angle)
         associate (e => self%grid%element(i), p => self%grid%part(self%grid%element(i)))
            ply(i) = domain%layers%ply(self%grid%sheet(i))
            part(i) = model%parts(p)%id
            ply_id(i) = model%parts(p)%plies(ply(i))%id
            if (self%grid%has_layers()) then
               angle(i) = model%parts(p)%plies(ply(i))%angle
            else
               angle(i) = model%mesh%brick_angle(e)
            end if
            element(i) = model%mesh%element_id(domain%groups(self%grid%group)%item%element_kind, e)
         end associate
      end do
      fibre(1, :) = cos(angle*degree)
      fibre(2, :) = sin(angle*degree)
      fibre(3, :) = 0.0_wp
      if (self%grid%has_layers()) then
         call self%file%add_cell_data("ply", ply)
         call self%file%add_cell_data("ply_id", ply_id)
      end if
      call self%file%add_cell_data("part", part)
      call self%file%add_cell_data("element", element)
      call self%file%add_cell_data("angle", angle)
      call self%file%add_cell_data("fibre", fibre)
   end subroutine add_cell_fields

   !> Displacement or velocity at the points of this rank, (3, points)
   function motion_values(self, domain, motion) result(values)
      class(element_fields_type), intent(in) :: self
      type(domain_type), intent(in) :: domain
      !> Displacement or velocity of all freedoms
      real(wp), intent(in), contiguous :: motion(:)
      real(wp), allocatable :: values(:, :)

      real(wp) :: at_node(3, self%grid%accumulators%levels, self%grid%accumulators%count)
      integer :: k

      do k = 1, size(self%grid%levels)
         associate (first => self%grid%below(k) + 1, &
            & last => self%grid%below(k) + self%grid%levels(k))
            at_node(:, first:last, :) = sheet_motion(domain%columns, k, self%grid%levels(k), &
               & self%grid%accumulators%node, motion)
         end associate
      end do
      allocate (values(3, self%grid%accumulators%own_points()))
      call self%grid%accumulators%take(at_node, values)
   end function motion_values

   !> Displacement or velocity at some nodes at all levels of a sheet, (3, levels, nodes)
   pure function sheet_motion(columns, sheet, levels, node, motion) result(values)
      type(columns_type), intent(in) :: columns
      !> The sheet, its levels, and the rank's numbers of the nodes
      integer, intent(in) :: sheet, levels, node(:)
      !> Displacement or velocity of all points
      real(wp), intent(in), contiguous :: motion(:)
      real(wp) :: values(3, levels, size(node))

      real(wp) :: share(columns%levels(sheet)), slope(size(share))
      integer :: c, t, tau

      values(:, :, :) = 0.0_wp
      share(:) = 1.0_wp
      do t = 1, levels
         ! where a sheet has one level, nodes are points
         if (levels > 1) call lagrange(columns%order_groups(columns%layer_slot(1, sheet)) &
            & %expansion%node, -1.0_wp + 2.0_wp*real(t - 1, wp)/real(levels - 1, wp), share, slope)
         do c = 1, 3
            do tau = 1, size(share)
               values(c, t, :) = values(c, t, :) &
                  & + share(tau)*motion(columns%freedom(sheet, tau, c, node))
            end do
         end do
      end do
   end function sheet_motion

   !> Scalars, and strain and stress if asked for, at the points of this rank: the weighted mean of
   !> the elements of a part that meet there, (recovered, points)
   function recovered_values(self, domain, state) result(values)
      class(element_fields_type), intent(in) :: self
      type(domain_type), intent(in) :: domain
      type(state_type), intent(in) :: state
      real(wp), allocatable :: values(:, :)

      real(wp), allocatable :: own(:, :, :), sums(:, :, :)
      integer :: i, k, t

      associate (grid => self%grid, accumulators => self%grid%accumulators)
         allocate (values(recovered, accumulators%own_points()))
         do k = 1, size(grid%levels)
            allocate (sums(recovered + 1, grid%levels(k), accumulators%count), source=0.0_wp)
            do i = 1, size(accumulators%element, 2)
               associate (g => accumulators%element(1, i), e => accumulators%element(2, i))
                  own = domain%groups(g)%item%output_values([e, k], self%has_tensors, &
                     & state%displacement, state%history)
               end associate
               do t = 1, grid%levels(k)
                  call accumulators%add(i, t, own(:, t, :), sums)
               end do
            end do
            associate (first => accumulators%reduction%count*grid%below(k), &
               & length => accumulators%reduction%count*grid%levels(k))
               call accumulators%mean(sums, values(:, first + 1:first + length))
            end associate
            deallocate (sums)
         end do
      end associate
   end function recovered_values

   subroutine write_fields(self, domain, state)
      class(element_fields_type), intent(inout) :: self
      type(domain_type), intent(in) :: domain
      type(state_type), intent(in) :: state

      real(wp), allocatable :: values(:, :)
      integer :: i

      if (any(self%names /= "displacement" .and. self%names /= "velocity")) then
         values = recovered_values(self, domain, state)
      else
         allocate (values(0, 0))
      end if
      do i = 1, size(self%names)
         call write_field(self, domain, state, trim(self%names(i)), values)
      end do
   end subroutine write_fields

   !> Write one field of the present state; the velocity is that of its time
   subroutine write_field(self, domain, state, name, values)
      class(element_fields_type), intent(inout) :: self
      type(domain_type), intent(in) :: domain
      type(state_type), intent(in) :: state
      !> Name of the field
      character(*), intent(in) :: name
      !> Strain, stress and scalars where a field asks for them, (recovered, points)
      real(wp), intent(in) :: values(:, :)

      associate (file => self%file)
         select case (name)
         case ("displacement")
            call file%write_point_data(name, motion_values(self, domain, state%displacement))
         case ("velocity")
            call file%write_point_data(name, motion_values(self, domain, state%velocity &
               & + 0.5_wp*state%step_before*state%acceleration(:size(state%velocity))))
         case ("strain")
            call file%write_point_data(name, tensor(values, strain_at, tensor_share))
         case ("stress")
            call file%write_point_data(name, tensor(values, stress_at))
         case ("strain_ply")
            call file%write_point_data(name, tensor(values, ply_strain_at, tensor_share))
         case ("stress_ply")
            call file%write_point_data(name, tensor(values, ply_stress_at))
         case default
            call file%write_point_data(name, &
               & values(scalars_at + findloc(scalar_names == name, .true.), :))
         end select
      end associate
   end subroutine write_field

   !> Numbers that a field has at a point
   elemental integer function field_components(name) result(components)
      !> Name of the field
      character(*), intent(in) :: name

      select case (name)
      case ("displacement", "velocity"); components = 3
      case default; components = merge(1, tensor_components, any(scalar_names == name))
      end select
   end function field_components

   !> Six of the recovered values in VTK's order
   pure function tensor(values, before, share) result(six)
      !> Values at the points, (recovered, points)
      real(wp), intent(in) :: values(:, :)
      !> Where the six begin, less one
      integer, intent(in) :: before
      !> Factors of the six, in our order
      real(wp), intent(in), optional :: share(6)
      real(wp) :: six(6, size(values, 2))
      integer :: i

      do i = 1, 6
         six(i, :) = values(before + vtk_order(i), :)
         if (present(share)) six(i, :) = share(vtk_order(i))*six(i, :)
      end do
   end function tensor

end module plydyn_io_vtkhdf_element_fields
