!> The observers of a run, made in one place.
module plydyn_run_observers
   use plydyn_base_error, only : error_type
   use plydyn_base_precision, only : wp
   use plydyn_io_csv_histories, only : all_histories, history_item_type
   use plydyn_io_job, only : job_type, output_type
   use plydyn_io_listing_end_of_run, only : end_of_run_type
   use plydyn_io_listing_progress_monitor, only : progress_monitor_type
   use plydyn_io_vtkhdf_field_output, only : field_output_type
   use plydyn_method_observer, only : observer_type, observers_type
   use plydyn_run_checkpoint_writer, only : new_checkpoint_writer
   use plydyn_run_dissipation_monitor, only : new_dissipation_monitor
   use plydyn_run_quasi_static_monitor, only : new_quasi_static_monitor
   use plydyn_run_run_control, only : new_run_control
   use plydyn_run_setup, only : run_type
   use plydyn_run_stability_monitor, only : new_balance_monitor, new_stability_monitor
   use plydyn_run_volume_monitor, only : new_volume_monitor
   implicit none
   private

   public :: make_observers

contains

   !> Make all observers, in the order in which they are notified: run control first, as it passes
   !> requests to the others, and checkpoints last, as they end a run that is to stop
   subroutine make_observers(job, run, most_seconds, observers, error)
      !> The job, the same on all ranks
      type(job_type), intent(in) :: job
      !> Model, domain and layout
      type(run_type), intent(in) :: run
      !> Wall-clock limit, seconds
      real(wp), intent(in) :: most_seconds
      !> The observers; those that were made are to be closed also after an error
      type(observers_type), intent(out) :: observers
      !> Why a file could not be created; the same on all ranks
      type(error_type), allocatable, intent(out) :: error

      type(history_item_type), allocatable :: histories(:)
      integer :: i

      call observers%start(job%path)
      call add_output(end_of_run_type(), job, run, observers, error)
      call add_other(new_run_control(run%domain%comm, job, most_seconds), observers)
      call add_other(new_stability_monitor(is_first=.true.), observers)
      associate (control => run%domain%control)
         if (max(control%rest_share, control%load_share, control%kinetic_limit, &
            & control%contact_pause) > 0.0_wp) then
            call add_other(new_quasi_static_monitor(job), observers)
         end if
      end associate
      call add_other(new_volume_monitor(job, run%model%request), observers)
      histories = all_histories(run)
      do i = 1, size(histories)
         call add_output(histories(i)%item, job, run, observers, error)
      end do
      call add_output(field_output_type(), job, run, observers, error)
      call add_output(progress_monitor_type(), job, run, observers, error)
      call add_other(new_dissipation_monitor(job, run%state), observers)
      call add_other(new_stability_monitor(is_first=.false.), observers)
      call add_other(new_balance_monitor(), observers)
      call add_other(new_checkpoint_writer(job, run%state_parts, run%model%request), observers)
   end subroutine make_observers

   !> Open an observer that writes results and add it, unless something went wrong before
   subroutine add_output(prototype, job, run, observers, error)
      !> The observer, not open yet
      class(output_type), intent(in) :: prototype
      type(job_type), intent(in) :: job
      type(run_type), intent(in) :: run
      type(observers_type), intent(inout) :: observers
      type(error_type), allocatable, intent(inout) :: error

      class(observer_type), allocatable :: observer
      class(output_type), allocatable :: output

      if (allocated(error)) return
      allocate (output, source=prototype)
      call output%open(job, run, error)
      call move_alloc(output, observer)
      call observers%add(observer)
   end subroutine add_output

   !> Add another observer
   subroutine add_other(prototype, observers)
      class(observer_type), intent(in) :: prototype
      type(observers_type), intent(inout) :: observers

      class(observer_type), allocatable :: observer

      allocate (observer, source=prototype)
      call observers%add(observer)
   end subroutine add_other

end module plydyn_run_observers
