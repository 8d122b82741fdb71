!> All results of a job but its fields: histories and profiles.
module plydyn_io_csv_history_output
   use plydyn_base_error, only : error_type
   use plydyn_base_precision, only : wp
   use plydyn_base_text, only : text
   use plydyn_domain_domain, only : domain_type
   use plydyn_law_law, only : mechanisms
   use plydyn_model_model, only : model_type
   use plydyn_io_csv_delamination_history, only : delamination_history_type
   use plydyn_io_csv_history_file, only : history_type
   use plydyn_io_job, only : job_type
   use plydyn_io_csv_node_history, only : node_history_type
   use plydyn_io_checkpoint_file_positions, only : new_file_positions, file_positions_type
   use plydyn_io_csv_profile, only : profile_file_type
   use plydyn_io_csv_global_history, only : energy_names, impactor_names, impactor_row, &
      & global_history_type
   use plydyn_io_csv_support_history, only : support_history_type
   use plydyn_parallel_comm, only : comm_type
   use plydyn_state_state, only : state_type
   implicit none
   private

   !> What writes the results of a job: all ranks have one, and the root's has the files
   type, public :: history_output_type
      private
      !> The ranks
      type(comm_type) :: comm
      type(job_type) :: job
      type(history_type) :: energy
      type(support_history_type) :: supports
      type(node_history_type) :: nodes
      type(delamination_history_type) :: delamination
      type(history_type), allocatable :: impactors(:)
      type(profile_file_type), allocatable :: profiles(:)
   contains
      procedure :: open => open_writer
      procedure :: due
      procedure :: record
      procedure :: rows_due
      procedure :: record_rows
      procedure :: impactors_due
      procedure :: record_impactors
      procedure :: keep
      procedure :: close => close_writer
   end type history_output_type

contains

   !> Let the root create all files, or go on with those of an earlier run
   subroutine open_writer(self, job, model, domain, error)
      class(history_output_type), intent(inout) :: self
      !> The job
      type(job_type), intent(in) :: job
      !> The model
      type(model_type), intent(in) :: model
      !> The domain of this rank
      type(domain_type), intent(in) :: domain
      !> Why a file could not be created; the same on all ranks
      type(error_type), allocatable, intent(out) :: error

      integer :: i

      self%job = job
      self%comm = domain%comm
      ! all at once: they are closed together, whichever of them could be opened
      allocate (self%impactors(size(model%impactors)), self%profiles(size(model%request%profiles)))
      if (self%comm%is_root()) call open_sums(self, job, model, domain, error)
      call self%comm%broadcast(error)
      if (allocated(error)) return
      call self%nodes%open(job%path//".nodes.csv", model, domain, job%places, error)
      call self%comm%broadcast(error)
      if (allocated(error)) return
      call self%supports%open(job, model, domain, error)
      call self%comm%broadcast(error)
      if (allocated(error)) return
      do i = 1, size(self%profiles)
         associate (profile => model%request%profiles(i))
            call self%profiles(i)%open(job%path//".profile_"//text(profile%id)//".csv", profile, &
               & model%control%units, domain, job%places, error)
         end associate
         call self%comm%broadcast(error)
         if (allocated(error)) return
      end do
   end subroutine open_writer

   !> Energies, impactors and delamination, which the root writes by itself
   subroutine open_sums(self, job, model, domain, error)
      class(history_output_type), intent(inout) :: self
      type(job_type), intent(in) :: job
      type(model_type), intent(in) :: model
      type(domain_type), intent(in) :: domain
      type(error_type), allocatable, intent(out) :: error

      call open_energy(self, job, model, error)
      if (.not. allocated(error)) call open_impactors(self, job, model, error)
      if (.not. allocated(error)) call self%delamination%open(job%path//".delamination.csv", &
         & model%control%units, model%request%delamination_interval, domain, job%places, error)
   end subroutine open_sums

   !> Energies and momentum
   subroutine open_energy(self, job, model, error)
      class(history_output_type), intent(inout) :: self
      type(job_type), intent(in) :: job
      type(model_type), intent(in) :: model
      type(error_type), allocatable, intent(out) :: error

      character(20) :: momentum

      associate (u => model%control%units)
         momentum = trim(u%force)//" "//u%time
         call self%energy%open(job%path//".energy.csv", energy_names, [character(20) :: "-", &
            & u%time, u%time, spread(u%energy, 1, 10 + mechanisms), "-", spread(momentum, 1, 3)], &
            & model%request%energy_interval, job%places, error)
      end associate
   end subroutine open_energy

   !> Force and motion of each impactor
   subroutine open_impactors(self, job, model, error)
      class(history_output_type), intent(inout) :: self
      type(job_type), intent(in) :: job
      type(model_type), intent(in) :: model
      type(error_type), allocatable, intent(out) :: error

      character(20) :: units(size(impactor_names))
      integer :: i

      associate (u => model%control%units)
         units(:) = [character(20) :: u%time, u%force, u%length, trim(u%length)//"/"//u%time, &
            & u%energy, u%energy, u%force, u%force, "-", u%length]
         do i = 1, size(self%impactors)
            call self%impactors(i)%open(job%path//".impactor_"//text(model%impactors(i)%id) &
               & //".csv", impactor_names, units, model%request%impactor_interval, job%places, &
               & error)
            if (allocated(error)) return
         end do
      end associate
   end subroutine open_impactors

   !> Write what is due of nodes, supports and profiles, of which ranks have parts; all come here
   subroutine record(self, domain, state, error)
      class(history_output_type), intent(inout) :: self
      !> The domain of this rank
      type(domain_type), intent(in) :: domain
      !> Its state
      type(state_type), intent(in) :: state
      !> Why something could not be written; the same on all ranks
      type(error_type), allocatable, intent(out) :: error

      integer :: due(2 + size(self%profiles)), i

      ! the root has the files, and knows what is due
      due(:) = merge(1, 0, [is_due(self%nodes%history, state), &
         & is_due(self%supports%history, state), &
         & (is_due(self%profiles(i)%history, state), i=1, size(self%profiles))])
      call self%comm%broadcast(due)
      if (due(1) > 0) call self%nodes%record(state, error)
      if (allocated(error)) return
      if (due(2) > 0) call self%supports%record(state, error)
      if (allocated(error)) return
      do i = 1, size(self%profiles)
         if (due(2 + i) > 0) call self%profiles(i)%record(domain, state, error)
         if (allocated(error)) return
      end do
   end subroutine record

   !> Whether a line of a history is due, also as the last one
   pure logical function is_due(history, state)
      type(history_type), intent(in) :: history
      type(state_type), intent(in) :: state

      is_due = history%is_open() .and. (history%due(state%time) .or. state%is_finished())
   end function is_due

   !> Whether `record` will have anything to write at some time
   pure logical function due(self, time, is_last)
      class(history_output_type), intent(in) :: self
      !> The time, and whether it is the end
      real(wp), intent(in) :: time
      logical, intent(in) :: is_last
      integer :: i

      due = is_last .or. self%nodes%history%due(time) .or. self%supports%history%due(time)
      do i = 1, size(self%profiles)
         due = due .or. self%profiles(i)%history%due(time)
      end do
   end function due

   !> Write what is due of sums over the whole model: energies and losses of interfaces
   subroutine record_rows(self, rows, state, error)
      class(history_output_type), intent(inout) :: self
      !> The sums
      type(global_history_type), intent(in) :: rows
      !> The state, of any rank
      type(state_type), intent(in) :: state
      !> Why something could not be written
      type(error_type), allocatable, intent(out) :: error

      logical :: is_last

      is_last = state%is_finished()
      if (self%energy%due(state%time) .or. is_last) then
         call self%energy%record(state%time, rows%energy, error)
         if (allocated(error)) return
      end if
      call self%delamination%record(rows, state%time, is_last, error)
   end subroutine record_rows

   !> Whether `record_rows` will have anything to write at some time
   pure logical function rows_due(self, time, is_last)
      class(history_output_type), intent(in) :: self
      !> The time, and whether it is the end
      real(wp), intent(in) :: time
      logical, intent(in) :: is_last

      rows_due = is_last .or. self%energy%due(time) .or. self%delamination%history%due(time)
   end function rows_due

   !> Write what is due of the impactors
   subroutine record_impactors(self, domain, state, error)
      class(history_output_type), intent(inout) :: self
      !> The domain, of any rank
      type(domain_type), intent(in) :: domain
      !> The state, of any rank
      type(state_type), intent(in) :: state
      !> Why something could not be written
      type(error_type), allocatable, intent(out) :: error

      integer :: i

      do i = 1, size(self%impactors)
         if (.not. (self%impactors(i)%due(state%time) .or. state%is_finished())) cycle
         call self%impactors(i)%record(state%time, impactor_row(domain, state, i), error)
         if (allocated(error)) return
      end do
   end subroutine record_impactors

   !> Whether `record_impactors` has anything to write at this time
   pure logical function impactors_due(self, state)
      class(history_output_type), intent(in) :: self
      !> The state
      type(state_type), intent(in) :: state
      integer :: i

      impactors_due = state%is_finished()
      do i = 1, size(self%impactors)
         impactors_due = impactors_due .or. self%impactors(i)%due(state%time)
      end do
   end function impactors_due

   !> Bring all files to the disk, and note how far each of them goes
   subroutine keep(self, places, error)
      class(history_output_type), intent(inout) :: self
      !> Gets the places
      type(file_positions_type), intent(out) :: places
      !> Why something is not on the disk
      type(error_type), allocatable, intent(out) :: error

      integer :: i

      places = new_file_positions(self%job%path)
      call self%energy%mark(places, error)
      if (.not. allocated(error)) call self%nodes%mark(places, error)
      if (.not. allocated(error)) call self%supports%mark(places, error)
      do i = 1, size(self%impactors)
         if (.not. allocated(error)) call self%impactors(i)%mark(places, error)
      end do
      do i = 1, size(self%profiles)
         if (.not. allocated(error)) call self%profiles(i)%mark(places, error)
      end do
      if (.not. allocated(error)) call self%delamination%mark(places, error)
   end subroutine keep

   !> Close all files, also after an error
   subroutine close_writer(self, error)
      class(history_output_type), intent(inout) :: self
      !> The first file that could not be closed
      type(error_type), allocatable, intent(out) :: error

      type(error_type), allocatable :: each
      integer :: i

      call self%energy%close(error)
      call self%nodes%close(each)
      call keep_first(error, each)
      call self%supports%close(each)
      call keep_first(error, each)
      do i = 1, size(self%impactors)
         call self%impactors(i)%close(each)
         call keep_first(error, each)
      end do
      do i = 1, size(self%profiles)
         call self%profiles(i)%close(each)
         call keep_first(error, each)
      end do
      call self%delamination%close(each)
      call keep_first(error, each)
   end subroutine close_writer

   !> Keep the first of two errors
   subroutine keep_first(first, next)
      type(error_type), allocatable, intent(inout) :: first, next

      if (.not. allocated(first)) call move_alloc(next, first)
   end subroutine keep_first

end module plydyn_io_csv_history_output
