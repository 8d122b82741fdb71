!> Forces of the supports on the plate, as a history: sums over what all ranks count, without
!> round-off, written by the root. After the sum of all come those of the single supports.
module plydyn_io_csv_support_history
   use, intrinsic :: iso_fortran_env, only : int64
   use plydyn_base_error, only : error_type
   use plydyn_base_exact_sum, only : exact_sums_type, new_exact_sums
   use plydyn_base_precision, only : wp
   use plydyn_domain_domain, only : domain_type
   use plydyn_model_model, only : model_type
   use plydyn_model_support, only : name_length
   use plydyn_io_owned_columns, only : counted_columns
   use plydyn_io_csv_history_file, only : heads_of
   use plydyn_io_job, only : job_type
   use plydyn_io_checkpoint_file_positions, only : file_positions_type
   use plydyn_io_csv_history_recorder, only : history_recorder_type
   use plydyn_io_csv_support_table, only : choose_table
   use plydyn_parallel_comm, only : comm_type
   use plydyn_state_state, only : state_type
   implicit none
   private

   !> Components of a force
   character(2), parameter :: components(3) = ["fx", "fy", "fz"]
   !> Most characters of a head
   integer, parameter :: head_length = name_length + 3

   !> The history of the supports
   type, public, extends(history_recorder_type) :: support_history_type
      private
      !> The ranks
      type(comm_type) :: comm
      !> Which sum each held and prescribed freedom is a part of, in the order of
      !> `state%support_force`; 0 where another rank counts the point
      integer, allocatable :: sum(:)
      !> Sums of the whole and of each support, three components each
      type(exact_sums_type) :: sums
      !> The line that they fill
      real(wp), allocatable :: row(:)
      !> Places of the tables that ended before this one
      type(file_positions_type) :: ended
   contains
      procedure :: open => open_supports
      procedure :: record => record_supports
      procedure :: mark => mark_supports
   end type support_history_type

contains

   !> Find what is summed, and let the root create the file, if the deck asks for it
   subroutine open_supports(self, job, model, domain, error)
      class(support_history_type), intent(inout) :: self
      !> The job
      type(job_type), intent(in) :: job
      !> The model
      type(model_type), intent(in) :: model
      !> The domain of this rank
      type(domain_type), intent(in) :: domain
      !> Why it could not be created
      type(error_type), allocatable, intent(out) :: error

      character(name_length), allocatable :: names(:)
      integer, allocatable :: number(:)

      self%comm = domain%comm
      allocate (self%sum(0))
      if (model%request%support_interval < 0.0_wp) return
      call find_names(model, names, number)
      self%sum = sums_of_supports(domain, number, size(model%holds))
      self%sums = new_exact_sums(3 + 3*size(names))
      allocate (self%row(4 + 3*size(names)))
      if (self%comm%is_root()) call open_table(self, job, model, names, error)
   end subroutine open_supports

   !> Names of all supports, each once, and the number of the name of each support and motion
   pure subroutine find_names(model, names, number)
      type(model_type), intent(in) :: model
      character(name_length), allocatable, intent(out) :: names(:)
      !> Supports, then motions
      integer, allocatable, intent(out) :: number(:)

      character(name_length) :: all(size(model%holds) + size(model%motions))
      integer :: i, k

      all(:size(model%holds)) = model%holds%name
      all(size(model%holds) + 1:) = model%motions%name
      allocate (names(0), number(size(all)))
      do i = 1, size(all)
         do k = 1, size(names)
            if (names(k) == all(i)) exit
         end do
         number(i) = k
         if (k > size(names)) names = [names, all(i)]
      end do
   end subroutine find_names

   !> Begin the table, or go on with it
   subroutine open_table(self, job, model, names, error)
      class(support_history_type), intent(inout) :: self
      type(job_type), intent(in) :: job
      type(model_type), intent(in) :: model
      !> Names of the supports
      character(name_length), intent(in) :: names(:)
      type(error_type), allocatable, intent(out) :: error

      character(head_length) :: heads(size(self%row)), units(size(self%row))
      character(:), allocatable :: path
      integer :: c, i

      heads(:4) = [character(head_length) :: "time", components]
      do i = 1, size(names)
         do c = 1, 3
            heads(1 + 3*i + c) = trim(names(i))//" "//components(c)
         end do
      end do
      units(:) = model%control%units%force
      units(1) = model%control%units%time
      call choose_table(job, heads_of(heads, units), model%changes%conditions, path, self%ended, &
         & error)
      if (allocated(error)) return
      call self%history%open(path, heads, units, model%request%support_interval, job%places, error)
   end subroutine open_table

   !> Which sum each held and prescribed freedom is a part of, 0 where this rank does not count it
   pure function sums_of_supports(domain, number, holds) result(sum)
      type(domain_type), intent(in) :: domain
      !> Number of the name of each support and motion
      integer, intent(in) :: number(:)
      !> How many of them are supports
      integer, intent(in) :: holds
      integer, allocatable :: sum(:)

      integer :: direction(domain%columns%freedoms)
      integer :: m

      direction(:) = directions_counted(domain)
      sum = direction(domain%supports%held)
      where (sum > 0) sum = sum + 3*number(domain%supports%holder)
      do m = 1, size(domain%supports%motions)
         associate (places => domain%supports%motions(m)%freedom)
            sum = [sum, merge(direction(places) + 3*number(holds + m), 0, direction(places) > 0)]
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

   !> Add a line. All ranks must come here
   subroutine record_supports(self, state, error)
      class(support_history_type), intent(inout) :: self
      !> The state of this rank
      type(state_type), intent(in) :: state
      !> Why it could not be written; the same on all ranks
      type(error_type), allocatable, intent(out) :: error

      integer :: i

      call self%sums%clear()
      do i = 1, size(self%sum)
         if (self%sum(i) > 0) call self%sums%add(self%sum(i), -state%support_force(i))
      end do
      call self%comm%sum(self%sums%limb)
      if (self%comm%is_root()) then
         call add_whole(self%sums%limb)
         self%row(1) = state%time
         do i = 2, size(self%row)
            self%row(i) = self%sums%value(i - 1)
         end do
         call self%history%record(state%time, self%row, error)
      end if
      call self%comm%broadcast(error)
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

   !> Put all lines on the disk, and note how far the tables go
   subroutine mark_supports(self, places, error)
      class(support_history_type), intent(inout) :: self
      type(file_positions_type), intent(inout) :: places
      type(error_type), allocatable, intent(out) :: error

      if (allocated(self%ended%list)) places%list = [places%list, self%ended%list]
      call self%history%mark(places, error)
   end subroutine mark_supports

end module plydyn_io_csv_support_history
