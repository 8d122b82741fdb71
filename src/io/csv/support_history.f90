!> The histories of what holds the plate. JOB.supports.csv has the forces of the supports on the
!> plate: exact sums over all supports, then over each of them. JOB.constraints.csv has the sum of
!> displacements of each linear constraint and the force along it.
module plydyn_io_csv_support_history
   use, intrinsic :: iso_fortran_env, only : int64
   use plydyn_base_error, only : error_type
   use plydyn_base_exact_sum, only : exact_sums_type, new_exact_sums
   use plydyn_base_precision, only : wp
   use plydyn_base_text, only : text
   use plydyn_domain_domain, only : domain_type
   use plydyn_model_model, only : model_type
   use plydyn_model_support, only : name_length
   use plydyn_io_csv_history_file, only : row_type
   use plydyn_io_job, only : job_type
   use plydyn_method_simulation, only : simulation_type
   use plydyn_io_csv_history_recorder, only : history_recorder_type
   use plydyn_io_csv_text_file, only : end_text, has_header
   use plydyn_state_file_positions, only : file_position_type, file_positions_type, &
      & new_file_positions
   implicit none
   private

   public :: choose_table

   !> The history of the supports
   type, public, extends(history_recorder_type) :: support_history_type
      private
      !> Which sum each held and prescribed freedom is a part of, in the order of
      !> `state%supports%force`; 0 where another rank counts the point
      integer, allocatable :: sum(:)
      !> Sums of the whole and of each support, three components each
      type(exact_sums_type) :: sums
      !> Names of the supports
      character(name_length), allocatable :: name(:)
      !> Positions in the tables that ended before this one
      type(file_positions_type) :: ended
   contains
      procedure :: prepare => prepare_supports
      procedure :: put_columns => put_supports
      procedure :: open => open_supports
      procedure :: record => record_supports
      procedure :: mark => mark_supports
   end type support_history_type

   !> The history of the constraints
   type, public, extends(history_recorder_type) :: constraint_history_type
   contains
      procedure :: put_columns => put_constraints
   end type constraint_history_type

contains

   !> Find the names of the supports, if the deck asks for their forces
   subroutine prepare_supports(self, simulation)
      class(support_history_type), intent(inout) :: self
      class(simulation_type), intent(in) :: simulation

      integer, allocatable :: number(:)

      associate (model => simulation%model)
         if (model%request%support_interval < 0.0_wp) return
         self%ending = table_ending(1)
         self%interval = model%request%support_interval
         self%reads_motion = .false.
         call find_names(model, self%name, number)
         self%sum = sums_of_supports(simulation%domain, number, size(model%supports))
         self%sums = new_exact_sums(3 + 3*size(self%name))
      end associate
   end subroutine prepare_supports

   subroutine put_supports(self, simulation, row)
      class(support_history_type), intent(in) :: self
      class(simulation_type), intent(in) :: simulation
      type(row_type), intent(inout) :: row

      character(3), parameter :: axis(3) = [" fx", " fy", " fz"]
      integer :: c, i

      associate (unit => simulation%model%control%units)
         call row%put("time", unit%time, simulation%state%time)
         call row%put(axis(:)(2:), unit%force, [(self%sums%value(c), c=1, 3)])
         do i = 1, size(self%name)
            call row%put(trim(self%name(i))//axis, unit%force, [(self%sums%value(3*i + c), c=1, 3)])
         end do
      end associate
   end subroutine put_supports

   !> Names of all supports, each once, and the number of the name of each support and motion
   pure subroutine find_names(model, names, number)
      type(model_type), intent(in) :: model
      character(name_length), allocatable, intent(out) :: names(:)
      !> Supports, then motions
      integer, allocatable, intent(out) :: number(:)

      character(name_length) :: all(size(model%supports) + size(model%motions))
      integer :: i, k

      all(:size(model%supports)) = model%supports%name
      all(size(model%supports) + 1:) = model%motions%name
      allocate (names(0), number(size(all)))
      do i = 1, size(all)
         do k = 1, size(names)
            if (names(k) == all(i)) exit
         end do
         number(i) = k
         if (k > size(names)) names = [names, all(i)]
      end do
   end subroutine find_names

   !> Begin the table, or continue the one of the restart, if the deck asks for it
   subroutine open_supports(self, job, simulation, error)
      class(support_history_type), intent(inout) :: self
      type(job_type), intent(in) :: job
      class(simulation_type), intent(in) :: simulation
      type(error_type), allocatable, intent(out) :: error

      type(row_type) :: heading

      call self%prepare(simulation)
      if (.not. allocated(self%ending)) return
      associate (comm => simulation%domain%comm, model => simulation%model)
         ! the root alone looks at the files
         call self%fill(simulation, heading)
         if (comm%is_root()) call choose_table(job, heading%header, model%changes%conditions, &
            & self%ending, self%ended, error)
         call comm%broadcast(error)
         if (allocated(error)) return
         call comm%broadcast(self%ending)
         call self%open_recorder(job, simulation, error)
      end associate
   end subroutine open_supports

   !> Find the table to begin or to go on with, and let those before it end where the restart file
   !> was written. A restart may bring other supports: their forces have other columns and a table
   !> of their own, beside the table that ends there
   subroutine choose_table(job, header, is_changed, ending, ended, error)
      type(job_type), intent(in) :: job
      !> Headers of the columns
      character(*), intent(in) :: header
      !> Whether a deck of a restart may have brought other supports
      logical, intent(in) :: is_changed
      !> What the path of the table has behind that of the results
      character(:), allocatable, intent(out) :: ending
      !> Places of the tables before it
      type(file_positions_type), intent(out) :: ended
      !> A table before it is not as the run left it
      type(error_type), allocatable, intent(out) :: error

      character(:), allocatable :: path
      type(file_position_type) :: place
      integer :: i, number, tables

      tables = 0
      do
         place = job%places%at(job%path//table_ending(tables + 1))
         if (place%amount < 0) exit
         tables = tables + 1
      end do
      ! the last one goes on unless its columns are others
      number = max(1, tables)
      if (tables > 0 .and. is_changed) then
         if (.not. has_header(job%path//table_ending(tables), header)) number = tables + 1
      end if
      ending = table_ending(number)
      ended = new_file_positions(job%path)
      do i = 1, number - 1
         path = job%path//table_ending(i)
         place = job%places%at(path)
         call end_text(path, place%amount, error)
         if (allocated(error)) return
         call ended%add(path, place)
      end do
      if (number > max(1, tables)) call job%note("other supports act from here on: their forces " &
         & //"are in "//job%path//ending)
   end subroutine choose_table

   !> What the path of a table has behind that of the results
   pure function table_ending(number) result(ending)
      !> Number of the table
      integer, intent(in) :: number
      character(:), allocatable :: ending

      ending = ".supports"
      if (number > 1) ending = ending//"_"//text(number)
      ending = ending//".csv"
   end function table_ending

   !> Which sum each held and prescribed freedom is a part of, 0 where this rank does not count it
   pure function sums_of_supports(domain, number, supports) result(sum)
      type(domain_type), intent(in) :: domain
      !> Number of the name of each support and motion
      integer, intent(in) :: number(:)
      !> How many of them are supports
      integer, intent(in) :: supports
      integer, allocatable :: sum(:)

      integer :: direction(domain%columns%freedoms)
      integer :: m

      direction(:) = directions_counted(domain)
      sum = direction(domain%supports%held)
      where (sum > 0) sum = sum + 3*number(domain%supports%support)
      do m = 1, size(domain%supports%motions)
         associate (places => domain%supports%motions(m)%freedom)
            sum = [sum, merge(direction(places) + 3*number(supports + m), 0, direction(places) > 0)]
         end associate
      end do
   end function sums_of_supports

   !> Direction of each place in the arrays of motion, 0 where this rank does not count it
   pure function directions_counted(domain) result(direction)
      type(domain_type), intent(in) :: domain
      integer :: direction(domain%columns%freedoms)

      integer :: c, k, m, t

      direction(:) = 0
      do k = 1, size(domain%layers%order)
         do t = 1, domain%columns%levels(k)
            do c = 1, 3
               direction(domain%columns%freedom(k, t, c, [(m, m=1, domain%columns%nodes)])) = c
            end do
         end do
      end do
      do k = 1, size(direction)
         if (direction(k) == 0) cycle
         if (.not. domain%counts(k)) direction(k) = 0
      end do
   end function directions_counted

   !> Sum the forces, and add a line
   subroutine record_supports(self, simulation, error)
      class(support_history_type), intent(inout) :: self
      class(simulation_type), intent(in) :: simulation
      type(error_type), allocatable, intent(out) :: error

      integer :: i

      call self%sums%clear()
      do i = 1, size(self%sum)
         if (self%sum(i) > 0) call self%sums%add(self%sum(i), -simulation%state%supports%force(i))
      end do
      call self%comm%sum(self%sums%limb)
      call add_whole(self%sums%limb)
      call self%record_row(simulation, error)
   end subroutine record_supports

   !> Each freedom is a part of one support: their sums together are the sum of all
   pure subroutine add_whole(limb)
      !> Sums of the whole, zero yet, and of each support, as in `exact_sums_type`
      integer(int64), intent(inout) :: limb(:, :)

      integer :: c, k

      do k = 4, size(limb, 2)
         c = 1 + mod(k - 1, 3)
         limb(:, c) = limb(:, c) + limb(:, k)
      end do
   end subroutine add_whole

   !> Put all lines on the disk, and add how far the tables have been written
   subroutine mark_supports(self, positions, error)
      class(support_history_type), intent(inout) :: self
      type(file_positions_type), intent(inout) :: positions
      type(error_type), allocatable, intent(out) :: error

      if (allocated(self%ended%list)) positions%list = [positions%list, self%ended%list]
      call self%mark_file(positions, error)
   end subroutine mark_supports

   !> All ranks have these numbers
   subroutine put_constraints(self, simulation, row)
      class(constraint_history_type), intent(in) :: self
      class(simulation_type), intent(in) :: simulation
      type(row_type), intent(inout) :: row

      integer :: i

      associate (unit => simulation%model%control%units, list => simulation%model%constraints, &
         & constraints => simulation%state%supports%constraints)
         call row%put("time", unit%time, simulation%state%time)
         do i = 1, size(list)
            call row%put("displacement "//text(list(i)%id), unit%length, &
               & constraints%displacement(i))
            call row%put("force "//text(list(i)%id), unit%force, constraints%force(i))
         end do
      end associate
   end subroutine put_constraints

end module plydyn_io_csv_support_history
