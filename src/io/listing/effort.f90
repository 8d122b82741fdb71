!> What a run will take: steps, memory, sizes of all files, and time; and what each rank has.
module plydyn_io_listing_effort
   use plydyn_base_precision, only : wp
   use plydyn_base_text, only : duration_text, fixed_text, text
   use plydyn_domain_delamination, only : present_interfaces
   use plydyn_domain_domain, only : domain_type
   use plydyn_domain_memory, only : any_history, history_bytes, intact_bytes, mesh_bytes, &
      & motion_bytes
   use plydyn_element_group, only : cell_type
   use plydyn_io_listing_table, only : write_section
   use plydyn_io_vtkhdf_element_fields, only : field_components
   use plydyn_io_vtkhdf_element_grid, only : cells_of_sheet, field_group
   use plydyn_io_vtkhdf_interface_fields, only : interface_numbers
   use plydyn_io_vtkhdf_output_nodes, only : number_nodes
   use plydyn_io_csv_histories, only : all_histories, history_item_type
   use plydyn_io_csv_history_file, only : row_type
   use plydyn_method_simulation, only : simulation_type
   use plydyn_model_control, only : request_type
   use plydyn_model_model, only : model_type
   implicit none
   private

   public :: write_effort, write_ranks

   !> What each rank has, in the order of the table of ranks
   integer, parameter, public :: rank_numbers = 7
   !> Bytes in a kilobyte and in a megabyte
   real(wp), parameter :: kilobyte = 1.0e3_wp, megabyte = 1.0e6_wp
   !> Seconds that a byte takes: of a table, of fields, which are averaged at nodes, and of a
   !> restart file, at the speed of a plain disk
   real(wp), parameter :: table_time = 6.0e-8_wp, field_time = 5.0e-8_wp, restart_time = 1.0e-8_wp
   !> Bytes in the file: of a field's value or a cell's number, of a point's position, of a corner
   !> or the offset of a cell, and of its kind
   real(wp), parameter :: value_bytes = 4.0_wp, position_bytes = 24.0_wp, index_bytes = 8.0_wp, &
      & kind_bytes = 1.0_wp
   !> Numbers of a cell that do not change: of a layer, of another element and of an
   !> interface
   real(wp), parameter :: layer_numbers = 8.0_wp, cell_numbers = 6.0_wp, bond_numbers = 6.0_wp

   !> Processor time of a thread, in seconds
   type, public :: cost_type
      !> In a step without output, and in a line of energies
      real(wp) :: step = 0.0_wp, energies = 0.0_wp
   end type cost_type

   !> What the lines have in common
   type :: effort_type
      !> Unit of the listing
      integer :: unit = 0
      !> Steps of the run, and seconds that it takes with all files
      real(wp) :: steps = 0.0_wp, seconds = 0.0_wp
   end type effort_type

contains

   !> Memory, sizes of files and time to come
   subroutine write_effort(unit, simulation, cost)
      !> Unit of the listing
      integer, intent(in) :: unit
      !> The model, and the domain of any rank
      class(simulation_type), intent(in) :: simulation
      !> What a step and a line of energies take
      type(cost_type), intent(in) :: cost

      type(effort_type) :: self

      associate (model => simulation%model, domain => simulation%domain)
         self%unit = unit
         self%steps = domain%control%end_time/domain%step
         if (domain%control%end_cycle > 0) then
            self%steps = min(self%steps, real(domain%control%end_cycle, wp))
         end if
         self%seconds = self%steps*cost%step
         call write_section(unit, "Effort")
         write (unit, "(2a)") "steps                         ", fixed_text(self%steps, 0)
         write (unit, "(a,i0)") "threads                       ", domain%control%threads
         ! what several ranks have is in their table
         if (domain%comm%ranks == 1) then
            call write_size(self, "memory of mesh and motion     ", mesh_bytes(domain), 1)
            if (any_history(domain)) then
               call write_size(self, "memory of histories           ", history_bytes(domain), 1)
               call write_size(self, "  while all is intact         ", intact_bytes(domain), 1)
            end if
            call write_restart_files(self, model%request, motion_bytes(domain) &
               & + history_bytes(domain))
         end if
         call write_file(self, "file of fields                ", fields_bytes(model, domain), &
            & field_time)
         if (size(present_interfaces(domain)) > 0) then
            call write_file(self, "file of interfaces            ", &
               & interfaces_bytes(model, domain), field_time)
         end if
         call write_file(self, "tables, about                 ", &
            & tables_bytes(simulation, self%steps), table_time)
         write (unit, "(3a)") "a step, measured over a few   ", &
            & fixed_text(1.0e3_wp*cost%step, 3), " ms"
         call write_energies(self, model%request%energy_interval, domain%control%end_time, cost)
         write (unit, "(5a)") "time to come, predicted       ", duration_text(self%seconds), " (", &
            & fixed_text(self%seconds, 1), " s)"
      end associate
   end subroutine write_effort

   !> A line with what lines of energies take, and what to do where that is more than the steps
   subroutine write_energies(self, interval, end_time, cost)
      type(effort_type), intent(inout) :: self
      !> Time between two lines, 0 for each step, and that of the run
      real(wp), intent(in) :: interval, end_time
      type(cost_type), intent(in) :: cost

      real(wp) :: instants

      instants = instants_of(interval, end_time, self%steps)
      write (self%unit, "(5a)") "a line of energies            ", &
         & fixed_text(1.0e3_wp*cost%energies, 3), " ms, ", fixed_text(instants, 0), " of them"
      if (instants*cost%energies > self%steps*cost%step) write (self%unit, "(2a)") &
         & "  they take longer than the steps: a longer DT of *DATABASE_GLSTAT makes the run faster"
      self%seconds = self%seconds + instants*cost%energies
   end subroutine write_energies

   !> A line with a size
   subroutine write_size(self, label, bytes, digits)
      type(effort_type), intent(in) :: self
      character(*), intent(in) :: label
      real(wp), intent(in) :: bytes
      !> Digits behind the point
      integer, intent(in) :: digits

      write (self%unit, "(3a)") label, fixed_text(bytes/megabyte, digits), " MB"
   end subroutine write_size

   !> A line with the size of what is written, and the time that it takes
   subroutine write_file(self, label, bytes, byte_time)
      type(effort_type), intent(inout) :: self
      character(*), intent(in) :: label
      real(wp), intent(in) :: bytes
      !> Seconds that a byte takes
      real(wp), intent(in) :: byte_time

      call write_size(self, label, bytes, 3)
      self%seconds = self%seconds + byte_time*bytes
   end subroutine write_file

   !> Restart files that are kept, and those that replace each other, the one at the end included
   subroutine write_restart_files(self, request, bytes)
      type(effort_type), intent(inout) :: self
      type(request_type), intent(in) :: request
      !> Bytes of one
      real(wp), intent(in) :: bytes

      real(wp) :: files

      if (request%kept_cycles > 0) then
         files = aint(self%steps/request%kept_cycles) + 1.0_wp
         call write_file(self, "restart files kept, "//text(nint(min(1.0_wp*huge(1), files))) &
            & //"     ", bytes*files, restart_time)
      end if
      if (request%running_cycles == 0) return
      files = aint(self%steps/request%running_cycles) + 1.0_wp
      call write_size(self, "restart files replaced, "//text(request%running_files)//"     ", &
         & bytes*request%running_files, 3)
      self%seconds = self%seconds + restart_time*bytes*files
   end subroutine write_restart_files

   !> Bytes of the file of fields
   real(wp) function fields_bytes(model, domain) result(bytes)
      type(model_type), intent(in) :: model
      !> The domain; its layers and step are known
      type(domain_type), intent(in) :: domain

      type(cell_type) :: cell
      integer, allocatable :: node(:, :), part(:)

      bytes = 0.0_wp
      if (field_group(domain) == 0) return
      associate (group => domain%groups(field_group(domain))%item)
         cell = group%cell
         call model%mesh%list_elements(group%element_kind, part, node)
      end associate
      bytes = file_bytes(sum(cell%levels)*output_nodes_of(part, node, size(model%mesh%node_id)), &
         & sum(field_components(model%request%fields))*states(model, domain), &
         & real(size(part), wp)*sum(cells_of_sheet(cell%levels, cell%span)), size(cell%corner, 2), &
         & merge(layer_numbers, cell_numbers, all(cell%levels > 1)))
   end function fields_bytes

   !> Bytes of the file of interfaces, of which there are some
   real(wp) function interfaces_bytes(model, domain) result(bytes)
      type(model_type), intent(in) :: model
      !> The domain; its layers, interfaces and step are known
      type(domain_type), intent(in) :: domain

      real(wp) :: interfaces

      interfaces = real(size(present_interfaces(domain)), wp)
      associate (mesh => model%mesh)
         bytes = file_bytes(interfaces*output_nodes_of(mesh%quad_part, mesh%quad_node, &
            & size(mesh%node_id)), interface_numbers*states(model, domain), &
            & interfaces*size(mesh%quad_id), size(mesh%quad_node, 1), bond_numbers)
      end associate
   end function interfaces_bytes

   !> States of a run: at time zero, at the first step after each interval, and the last
   pure real(wp) function states(model, domain)
      type(model_type), intent(in) :: model
      type(domain_type), intent(in) :: domain

      !> Round-off of a number of steps or intervals
      real(wp), parameter :: slack = 1.0e-6_wp
      real(wp) :: before

      ! steps before the last
      before = aint(domain%control%end_time/domain%step - slack)
      if (domain%control%end_cycle > 0) before = min(before, domain%control%end_cycle - 1.0_wp)
      states = 2.0_wp + min(before, aint(before*domain%step/model%request%field_interval + slack))
   end function states

   !> Points of the plane, or of bricks: each part has its own
   real(wp) function output_nodes_of(part, element_node, nodes) result(count)
      !> As in `number_nodes`
      integer, intent(in) :: part(:), element_node(:, :), nodes

      integer, allocatable :: node(:), output_node(:, :)

      call number_nodes(part, element_node, nodes, output_node, node)
      count = real(size(node), wp)
   end function output_nodes_of

   !> Bytes of a file
   pure real(wp) function file_bytes(points, values, cells, corners, numbers) result(bytes)
      !> Points, and values of all states at each
      real(wp), intent(in) :: points, values
      !> Cells, the corners and the numbers of each
      real(wp), intent(in) :: cells, numbers
      integer, intent(in) :: corners

      bytes = points*(position_bytes + value_bytes*values) &
         & + cells*(index_bytes*(corners + 1) + kind_bytes + value_bytes*numbers)
   end function file_bytes

   !> Bytes of all histories and profiles
   real(wp) function tables_bytes(simulation, steps) result(bytes)
      !> Model and domain
      class(simulation_type), intent(in) :: simulation
      !> Steps of the run
      real(wp), intent(in) :: steps

      !> Bytes of a number
      real(wp), parameter :: number_bytes = 17.0_wp
      type(history_item_type), allocatable :: list(:)
      type(row_type) :: heading
      real(wp) :: instants
      integer :: i

      list = all_histories(simulation)
      bytes = 0.0_wp
      do i = 1, size(list)
         associate (history => list(i)%item, interval => list(i)%item%interval)
            call history%prepare(simulation)
            if (.not. allocated(history%ending)) cycle
            heading = row_type()
            call history%fill(simulation, heading)
            instants = instants_of(interval, simulation%domain%control%end_time, steps)
            bytes = bytes + number_bytes*heading%columns*history%lines*(1.0_wp + instants)
         end associate
      end do
   end function tables_bytes

   !> Instants at which a history has lines
   pure real(wp) function instants_of(interval, end_time, steps)
      !> Time between two, 0 for each step; that of the run, and its steps
      real(wp), intent(in) :: interval, end_time, steps

      instants_of = steps
      if (interval > 0.0_wp) instants_of = min(steps, end_time/interval)
   end function instants_of

   !> What each rank has and sends
   subroutine write_ranks(unit, ranks)
      !> Unit of the listing
      integer, intent(in) :: unit
      !> Chunks, nodes, nodes that another rank counts, ranks that it meets, bytes that it sends
      !> them in a step, and bytes of mesh and motion and of histories, (`rank_numbers`, ranks)
      real(wp), intent(in) :: ranks(:, :)
      integer :: r

      call write_section(unit, "Ranks")
      write (unit, "(a)") "rank   chunks    nodes  shared  meets  sends in a step [kB]" &
         & //"  mesh, motion [MB]  histories [MB]"
      do r = 1, size(ranks, 2)
         write (unit, "(i4,i9,i9,i8,i7,f22.3,f19.3,f16.3)") r - 1, nint(ranks(:4, r)), &
            & ranks(5, r)/kilobyte, ranks(6:7, r)/megabyte
      end do
      if (any(ranks(1, :) < 1.0_wp)) then
         write (unit, "(a,i0,a)") "more ranks than chunks: ", count(ranks(1, :) < 1.0_wp), &
            & " of them have nothing to do"
      end if
      write (unit, "(2a)") "all ranks send in a step [kB] ", &
         & fixed_text(sum(ranks(5, :))/kilobyte, 3)
   end subroutine write_ranks

end module plydyn_io_listing_effort
