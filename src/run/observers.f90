!> The observers of a run, made in one place.
module plydyn_run_observers
   use plydyn_base_error, only : error_type
   use plydyn_base_precision, only : wp
   use plydyn_io_csv_contact_history, only : contact_history_type
   use plydyn_io_csv_delamination_history, only : delamination_history_type
   use plydyn_io_csv_energy_history, only : energy_history_type
   use plydyn_io_csv_fixture_history, only : new_fixture_history
   use plydyn_io_csv_impactor_history, only : new_impactor_history
   use plydyn_io_csv_node_history, only : node_history_type
   use plydyn_io_csv_profile, only : new_profile_file
   use plydyn_io_csv_support_history, only : support_history_type
   use plydyn_io_job, only : job_type
   use plydyn_io_listing_end_of_run, only : new_end_of_run
   use plydyn_io_listing_progress_monitor, only : new_progress_monitor
   use plydyn_io_output, only : output_type
   use plydyn_io_vtkhdf_field_output, only : field_output_type
   use plydyn_method_observer, only : observer_type, observers_type
   use plydyn_run_checkpoint_writer, only : new_checkpoint_writer
   use plydyn_run_run_control, only : new_run_control
   use plydyn_run_setup, only : run_type
   use plydyn_run_stability_monitor, only : new_stability_monitor
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

      integer :: i

      call observers%start(job%path)
      call add(new_end_of_run())
      call add_other(new_run_control(run%domain%comm, job, most_seconds))
      call add_other(new_volume_monitor(job, run%model%mesh))
      call add(energy_history_type())
      call add(node_history_type())
      call add(support_history_type())
      do i = 1, size(run%model%impactors)
         call add(new_impactor_history(i))
      end do
      do i = 1, size(run%model%fixtures)
         call add(new_fixture_history(i))
      end do
      do i = 1, size(run%model%request%profiles)
         call add(new_profile_file(i))
      end do
      call add(delamination_history_type())
      call add(contact_history_type())
      call add(field_output_type())
      call add(new_progress_monitor())
      call add_other(new_stability_monitor())
      call add_other(new_checkpoint_writer(job, run%state_parts, run%model%request))

   contains

      !> Add an observer that writes results, unless something went wrong before
      subroutine add(prototype)
         !> The observer, not open yet
         class(output_type), intent(in) :: prototype

         class(observer_type), allocatable :: observer
         class(output_type), allocatable :: output

         if (allocated(error)) return
         allocate (output, source=prototype)
         call output%open(job, run%model, run%domain, error)
         call move_alloc(output, observer)
         call observers%add(observer)
      end subroutine add

      !> Add another observer
      subroutine add_other(prototype)
         !> The observer
         class(observer_type), intent(in) :: prototype

         class(observer_type), allocatable :: observer

         allocate (observer, source=prototype)
         call observers%add(observer)
      end subroutine add_other

   end subroutine make_observers

end module plydyn_run_observers
