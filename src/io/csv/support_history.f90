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
   use plydyn_io_owned_columns, only : counted_columns
   use plydyn_io_csv_history_file, only : header_line
   use plydyn_io_job, only : job_type
   use plydyn_method_simulation, only : simulation_type
   use plydyn_io_csv_history_recorder, only : history_recorder_type
   use plydyn_io_csv_text_file, only : end_text, has_header
   use plydyn_state_file_positions, only : file_position_type, file_positions_type, &
      & new_file_positions
   implicit none
   private

   public :: choose_table

   !> Components of a force
   character(2), parameter :: components(3) = ["fx", "fy", "fz"]
   !> Most characters of a header
   integer, parameter :: header_length = name_length + 3

   !> The history of the supports
   type, public, extends(history_recorder_type) :: support_history_type
      private
      !> Which sum each held and prescribed freedom is a part of, in the order of
      !> `state%supports%force`; 0 where another rank counts the point
      integer, allocatable :: sum(:)
      !> Sums of the whole and of each support, three components each
      type(exact_sums_type) :: sums
      !> The line that they fill
      real(wp), allocatable :: row(:)
      !> Positions in the tables that ended before this one
      type(file_positions_type) :: ended
   contains
      procedure :: open => open_supports
      procedure :: record => record_supports
      procedure :: mark => mark_supports
   end type support_history_type

   !> Most characters of a header
   integer, parameter :: label_length = 30

   !> The history of the constraints
   type, public, extends(history_recorder_type) :: constraint_history_type
      private
      !> The line
      real(wp), allocatable :: row(:)
   contains
      procedure :: open => open_constraints
      procedure :: record => record_constraints
   end type constraint_history_type

contains

   !> Find the terms of the sums, and create the file, if the deck asks for it
   subroutine open_supports(self, job, simulation, error)
      class(support_history_type), intent(inout) :: self
      type(job_type), intent(in) :: job
      class(simulation_type), intent(in) :: simulation
      type(error_type), allocatable, intent(out) :: error

      character(name_length), allocatable :: names(:)
      integer, allocatable :: number(:)

      associate (model => simulation%model)
         if (model%request%support_interval < 0.0_wp) return
         self%reads_motion = .false.
         call find_names(model, names, number)
         self%sum = sums_of_supports(simulation%domain, number, size(model%supports))
         self%sums = new_exact_sums(3 + 3*size(names))
         allocate (self%row(4 + 3*size(names)))
         call open_table(self, job, simulation, names, error)
      end associate
   end subroutine open_supports

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

   !> Begin the table, or continue the one of the restart
   subroutine open_table(self, job, simulation, names, error)
      class(support_history_type), intent(inout) :: self
      type(job_type), intent(in) :: job
      class(simulation_type), intent(in) :: simulation
      !> Names of the supports
      character(name_length), intent(in) :: names(:)
      type(error_type), allocatable, intent(out) :: error

      character(header_length) :: headers(size(self%row)), units(size(self%row))
      character(:), allocatable :: ending
      integer :: c, i

      headers(:4) = [character(header_length) :: "time", components]
      do i = 1, size(names)
         do c = 1, 3
            headers(1 + 3*i + c) = trim(names(i))//" "//components(c)
         end do
      end do
      associate (comm => simulation%domain%comm, model => simulation%model)
         units(:) = model%control%units%force
         units(1) = model%control%units%time
         ! the root alone looks at the files
         ending = ""
         if (comm%is_root()) call choose_table(job, header_line(headers, units), &
            & model%changes%conditions, ending, self%ended, error)
         call comm%broadcast(error)
         if (allocated(error)) return
         call comm%broadcast(ending)
         call self%open_file(job, simulation, ending, headers, units, &
            & model%request%support_interval, error)
      end associate
   end subroutine open_table

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

      type(file_position_type) :: place
      integer :: number

      ended = new_file_positions(job%path)
      number = 1
      do
         ending = table_ending(number)
         place = job%places%at(job%path//ending)
         if (place%amount < 0) exit
         number = number + 1
         ! the last one goes on unless its columns are others
         if (.not. is_known(job, number)) then
            if (.not. is_changed) return
            if (has_header(job%path//ending, header)) return
         end if
         call end_text(job%path//ending, place%amount, error)
         if (allocated(error)) return
         call ended%add(job%path//ending, place)
      end do
      if (number > 1) call job%note("other supports act from here on: their forces are in " &
         & //job%path//ending)
   end subroutine choose_table

   !> Whether the restart file has a position in a table
   pure logical function is_known(job, number)
      type(job_type), intent(in) :: job
      !> Number of the table
      integer, intent(in) :: number

      type(file_position_type) :: place

      place = job%places%at(job%path//table_ending(number))
      is_known = place%amount >= 0
   end function is_known

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

      logical :: is_counted(domain%columns%count)
      integer :: c, k, m, t

      is_counted(:) = counted_columns(domain)
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
         if (.not. is_counted(domain%columns%column_of(k))) direction(k) = 0
      end do
   end function directions_counted

   !> Add a line
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
      if (self%comm%is_root()) then
         call add_whole(self%sums%limb)
         self%row(1) = simulation%state%time
         do i = 2, size(self%row)
            self%row(i) = self%sums%value(i - 1)
         end do
      end if
      call self%write_line(self%row, error)
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

   !> Create the file, or append to that of the restart, if the deck has constraints and asks for
   !> forces of supports
   subroutine open_constraints(self, job, simulation, error)
      class(constraint_history_type), intent(inout) :: self
      type(job_type), intent(in) :: job
      class(simulation_type), intent(in) :: simulation
      type(error_type), allocatable, intent(out) :: error

      character(label_length), dimension(1 &
         & + 2*size(simulation%model%constraints)) :: names, units
      integer :: i

      associate (model => simulation%model, u => simulation%model%control%units)
         if (size(model%constraints) == 0 .or. model%request%support_interval < 0.0_wp) return
         self%reads_motion = .false.
         names(1) = "time"
         units(1) = u%time
         do i = 1, size(model%constraints)
            names(2*i) = "displacement "//text(model%constraints(i)%id)
            names(2*i + 1) = "force "//text(model%constraints(i)%id)
            units(2*i:2*i + 1) = [u%length, u%force]
         end do
         allocate (self%row(size(names)))
         call self%open_file(job, simulation, ".constraints.csv", names, units, &
            & model%request%support_interval, error)
      end associate
   end subroutine open_constraints

   !> Add a line; all ranks have its numbers
   subroutine record_constraints(self, simulation, error)
      class(constraint_history_type), intent(inout) :: self
      class(simulation_type), intent(in) :: simulation
      type(error_type), allocatable, intent(out) :: error

      associate (constraints => simulation%state%supports%constraints)
         self%row(1) = simulation%state%time
         self%row(2::2) = constraints%displacement
         self%row(3::2) = constraints%force
      end associate
      call self%write_line(self%row, error)
   end subroutine record_constraints

end module plydyn_io_csv_support_history
