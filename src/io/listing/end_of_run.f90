!> The last section of the listing: how a run ended.
module plydyn_io_listing_end_of_run
   use, intrinsic :: iso_fortran_env, only : int64
   use plydyn_base_error, only : error_type
   use plydyn_base_precision, only : wp
   use plydyn_domain_delamination, only : can_fail, delamination, delamination_type
   use plydyn_domain_dissipation, only : dissipated_energies
   use plydyn_domain_domain, only : domain_type
   use plydyn_io_job, only : job_type, no_unit
   use plydyn_io_listing_listing, only : write_end
   use plydyn_io_output, only : output_type
   use plydyn_method_contact_step, only : contacts_type
   use plydyn_method_observer, only : requests_type
   use plydyn_model_model, only : model_type
   use plydyn_state_state, only : state_type
   implicit none
   private

   public :: new_end_of_run

   !> Writes the section when the run is over
   type, public, extends(output_type) :: end_of_run_type
      private
      !> Unit of the listing, on the root
      integer :: listing = no_unit
      !> Names of the units, and of the parts
      type(model_type) :: model
      !> Clock at the start
      integer(int64) :: started = 0_int64
   contains
      procedure :: open => start_clock
      procedure :: due
      procedure :: notify
      procedure :: close => write_section
   end type end_of_run_type

contains

   !> The last section of the listing
   pure type(end_of_run_type) function new_end_of_run() result(self)

      self%reads_motion = .false.
   end function new_end_of_run

   !> Start the clock
   subroutine start_clock(self, job, model, domain, error)
      class(end_of_run_type), intent(inout) :: self
      !> As in `output_type`
      type(job_type), intent(in) :: job
      type(model_type), intent(in) :: model
      type(domain_type), intent(in) :: domain
      type(error_type), allocatable, intent(out) :: error

      self%listing = job%listing
      self%model = model
      call system_clock(self%started)
   end subroutine start_clock

   !> Nothing is due before the end
   pure logical function due(self, time, cycle, is_last)
      class(end_of_run_type), intent(in) :: self
      !> As in `observer_type`
      real(wp), intent(in) :: time
      integer, intent(in) :: cycle
      logical, intent(in) :: is_last

      due = .false.
   end function due

   !> Nothing is written in a step
   subroutine notify(self, domain, contacts, state, requests, error)
      class(end_of_run_type), intent(inout) :: self
      !> As in `observer_type`
      type(domain_type), intent(in) :: domain
      type(contacts_type), intent(in) :: contacts
      type(state_type), intent(inout) :: state
      type(requests_type), intent(inout) :: requests
      type(error_type), allocatable, intent(out) :: error
   end subroutine notify

   !> Write the section
   subroutine write_section(self, domain, state, outcome, error)
      class(end_of_run_type), intent(inout) :: self
      !> As in `observer_type`
      type(domain_type), intent(in) :: domain
      type(state_type), intent(in) :: state
      type(error_type), allocatable, intent(in) :: outcome
      type(error_type), allocatable, intent(out) :: error

      character(:), allocatable :: words
      integer(int64) :: now, rate
      real(wp) :: dissipated
      type(delamination_type), allocatable :: lost(:)

      allocate (lost(0))
      if (can_fail(domain)) lost = delamination(domain, state%history)
      dissipated = sum(dissipated_energies(domain, state%history, lost))
      if (self%listing == no_unit) return
      words = "normal end"
      if (allocated(outcome)) words = outcome%message
      call system_clock(now, rate)
      call write_end(self%listing, self%model, domain, state, dissipated, lost, &
         & real(now - self%started, wp)/real(rate, wp), words)
   end subroutine write_section

end module plydyn_io_listing_end_of_run
