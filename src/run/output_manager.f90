!> What is written about a run: fields and restart files by all ranks together, histories by the
!> root, to which the others tell the few numbers that are due.
module plydyn_run_output_manager
   use plydyn_base_error, only : error_type
   use plydyn_base_precision, only : wp
   use plydyn_domain_domain, only : domain_type
   use plydyn_model_model, only : model_type
   use plydyn_io_checkpoint_dump, only : write_dump
   use plydyn_io_vtkhdf_field_output, only : field_output_type
   use plydyn_io_job, only : job_type
   use plydyn_io_listing_progress_monitor, only : progress_monitor_type
   use plydyn_io_listing_listing, only : write_end
   use plydyn_io_checkpoint_file_positions, only : new_file_positions, file_positions_type
   use plydyn_io_csv_global_history, only : new_global_history, global_history_type
   use plydyn_io_checkpoint_state_layout, only : state_layout_type
   use plydyn_io_checkpoint_broadcast_job, only : broadcast_file_positions
   use plydyn_io_csv_history_output, only : history_output_type
   use plydyn_parallel_comm, only : comm_type
   use plydyn_state_state, only : halt_sum, impactors_sum, output_sum, rows_sum, state_type
   implicit none
   private

   !> The results of a job, whatever the number of ranks
   type, public :: output_manager_type
      private
      !> The ranks
      type(comm_type) :: comm
      !> Path of the results without endings
      character(:), allocatable :: path
      !> What writes histories
      type(history_output_type) :: writer
      !> What writes fields
      type(field_output_type) :: fields
      !> Where the run is; on the root's screen
      type(progress_monitor_type) :: progress_monitor
      !> Which places of the arrays of the whole model this rank has
      type(state_layout_type) :: parts
   contains
      procedure :: open => open_journal
      procedure :: announce
      procedure :: begin
      procedure :: record
      procedure :: plot
      procedure :: conclude
      procedure :: tell
      procedure :: keep
      procedure :: dump
      procedure :: write_end => write_end_of_run
      procedure :: close => close_journal
   end type output_manager_type

contains

   !> Create all files, or go on with those of an earlier run
   subroutine open_journal(self, job, model, domain, parts, error)
      class(output_manager_type), intent(inout) :: self
      !> The job, the same on all ranks
      type(job_type), intent(in) :: job
      !> The model
      type(model_type), intent(in) :: model
      !> The domain of this rank
      type(domain_type), intent(in) :: domain
      !> Which places of the arrays of the whole model this rank has
      type(state_layout_type), intent(in) :: parts
      !> Why a file could not be created; the same on all ranks
      type(error_type), allocatable, intent(out) :: error

      self%comm = domain%comm
      self%parts = parts
      self%path = job%path
      call self%writer%open(job, model, domain, error)
      if (.not. allocated(error)) call self%fields%open(job, model, domain, error)
      if (.not. allocated(error)) call self%progress_monitor%begin(job, model%control%units, domain)
   end subroutine open_journal

   !> Let all ranks know with the sums of this step whether something is due, and whether anything
   !> of the points will be after the next
   subroutine announce(self, state)
      class(output_manager_type), intent(in) :: self
      !> The state; the sums are counted
      type(state_type), intent(inout) :: state

      logical :: is_last
      real(wp) :: time

      if (.not. self%comm%is_root()) return
      time = state%time
      is_last = state%is_finished()
      if (self%writer%due(time, is_last)) call state%tally%add(output_sum, 1.0_wp)
      if (self%writer%rows_due(time, is_last)) call state%tally%add(rows_sum, 1.0_wp)
      if (self%writer%impactors_due(state)) call state%tally%add(impactors_sum, 1.0_wp)
      time = state%time + state%step_after
      is_last = state%ends_after(state%step_after)
      if (self%writer%due(time, is_last) .or. self%writer%rows_due(time, is_last) &
         & .or. self%fields%due(time, is_last)) call state%tally%add(halt_sum, 1.0_wp)
   end subroutine announce

   !> Write whatever is due at this time
   subroutine record(self, domain, state, error)
      class(output_manager_type), intent(inout) :: self
      !> The domain
      type(domain_type), intent(in) :: domain
      !> The state; says what is due
      type(state_type), intent(in) :: state
      !> Why something could not be written; the same on all ranks
      type(error_type), allocatable, intent(out) :: error

      if (state%impactors_due) call record_impactors(self, domain, state, error)
      if (allocated(error)) return
      if (state%rows_due) call record_rows(self, domain, state, error)
      if (allocated(error)) return
      if (state%output_due) call self%writer%record(domain, state, error)
      if (.not. allocated(error)) call self%fields%record(domain, state, error)
      call self%progress_monitor%show(state)
   end subroutine record

   !> Write all there is before the first step
   subroutine begin(self, domain, state, error)
      class(output_manager_type), intent(inout) :: self
      !> The domain
      type(domain_type), intent(in) :: domain
      !> The state
      type(state_type), intent(in) :: state
      !> Why something could not be written; the same on all ranks
      type(error_type), allocatable, intent(out) :: error

      call record_impactors(self, domain, state, error)
      if (.not. allocated(error)) call record_rows(self, domain, state, error)
      if (.not. allocated(error)) call self%writer%record(domain, state, error)
      if (.not. allocated(error)) call self%fields%record(domain, state, error)
   end subroutine begin

   !> Lines of the impactors, which all ranks know
   subroutine record_impactors(self, domain, state, error)
      class(output_manager_type), intent(inout) :: self
      type(domain_type), intent(in) :: domain
      type(state_type), intent(in) :: state
      type(error_type), allocatable, intent(out) :: error

      if (self%comm%is_root()) call self%writer%record_impactors(domain, state, error)
      call self%comm%broadcast(error)
   end subroutine record_impactors

   !> Lines of sums over the whole model, in which all ranks have a part
   subroutine record_rows(self, domain, state, error)
      class(output_manager_type), intent(inout) :: self
      type(domain_type), intent(in) :: domain
      type(state_type), intent(in) :: state
      type(error_type), allocatable, intent(out) :: error

      type(global_history_type) :: rows

      rows = new_global_history(domain, state)
      if (self%comm%is_root()) call self%writer%record_rows(rows, state, error)
      call self%comm%broadcast(error)
   end subroutine record_rows

   !> Write the fields at this time, if they are not in the file already
   subroutine plot(self, domain, state, error)
      class(output_manager_type), intent(inout) :: self
      !> The domain
      type(domain_type), intent(in) :: domain
      !> The state
      type(state_type), intent(in) :: state
      !> Why they could not be written; the same on all ranks
      type(error_type), allocatable, intent(out) :: error

      call self%fields%plot(domain, state, error)
   end subroutine plot

   !> Write the fields of a run that went wrong, if that can be done: what stopped it is worse than
   !> a state that cannot be written
   subroutine conclude(self, domain, state)
      class(output_manager_type), intent(inout) :: self
      !> The domain
      type(domain_type), intent(in) :: domain
      !> The state
      type(state_type), intent(in) :: state

      type(error_type), allocatable :: plot_error

      call self%plot(domain, state, plot_error)
   end subroutine conclude

   !> Write the line of life, due or not
   subroutine tell(self, state)
      class(output_manager_type), intent(inout) :: self
      !> The state
      type(state_type), intent(in) :: state

      call self%progress_monitor%tell(state)
   end subroutine tell

   !> Bring all files to the disk, and note how far each of them goes
   subroutine keep(self, places, error)
      class(output_manager_type), intent(inout) :: self
      !> Gets the places, the same on all ranks
      type(file_positions_type), intent(out) :: places
      !> Why something is not on the disk; the same on all ranks
      type(error_type), allocatable, intent(out) :: error

      places = new_file_positions(self%path)
      if (self%comm%is_root()) call self%writer%keep(places, error)
      call self%comm%broadcast(error)
      if (allocated(error)) return
      call broadcast_file_positions(self%comm, self%path, places)
      call self%fields%mark(places, error)
   end subroutine keep

   !> Write a restart file; all ranks must come here
   subroutine dump(self, path, job, state, error)
      class(output_manager_type), intent(inout) :: self
      !> Path of the file
      character(*), intent(in) :: path
      !> The job, the same on all ranks
      type(job_type), intent(in) :: job
      !> The state, with the memory of contacts
      type(state_type), intent(inout) :: state
      !> Why the file is not there; the same on all ranks
      type(error_type), allocatable, intent(out) :: error

      type(file_positions_type) :: places

      call self%keep(places, error)
      if (.not. allocated(error)) call write_dump(path, job, places, self%parts, state, error)
   end subroutine dump

   !> Say in the listing how the run ended
   subroutine write_end_of_run(self, unit, model, domain, state, words)
      class(output_manager_type), intent(inout) :: self
      !> Unit of the listing, on the root
      integer, intent(in) :: unit
      !> The model
      type(model_type), intent(in) :: model
      !> The domain
      type(domain_type), intent(in) :: domain
      !> The last state
      type(state_type), intent(in) :: state
      !> Normal end, or what stopped it
      character(*), intent(in) :: words

      type(global_history_type) :: rows

      rows = new_global_history(domain, state)
      if (self%comm%is_root()) call write_end(unit, model, domain, state, rows, &
         & self%progress_monitor%elapsed(), words)
   end subroutine write_end_of_run

   !> Close all files, also after an error
   subroutine close_journal(self, error)
      class(output_manager_type), intent(inout) :: self
      !> The first file that could not be closed; the same on all ranks
      type(error_type), allocatable, intent(out) :: error

      type(error_type), allocatable :: each

      if (self%comm%is_root()) call self%writer%close(error)
      call self%comm%broadcast(error)
      call self%fields%close(each)
      if (.not. allocated(error)) call move_alloc(each, error)
   end subroutine close_journal

end module plydyn_run_output_manager
