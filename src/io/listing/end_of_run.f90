!> The last section of the listing: how a run ended.
module plydyn_io_listing_end_of_run
   use, intrinsic :: iso_fortran_env, only : int64
   use plydyn_base_error, only : error_type
   use plydyn_base_precision, only : wp
   use plydyn_domain_crack_lengths, only : cracks_of_plies, ply_cracks_type
   use plydyn_domain_delamination, only : can_fail, delamination, delamination_type
   use plydyn_domain_element_energies, only : dissipated_energies
   use plydyn_io_job, only : job_type, no_unit
   use plydyn_io_listing_cracks, only : write_crack_lengths
   use plydyn_io_listing_listing, only : write_end
   use plydyn_io_output, only : output_type
   use plydyn_method_simulation, only : simulation_type
   implicit none
   private

   public :: new_end_of_run

   !> Writes the section when the run is over
   type, public, extends(output_type) :: end_of_run_type
      private
      !> Unit of the listing, on the root
      integer :: listing = no_unit
      !> Clock at the start
      integer(int64) :: started = 0_int64
   contains
      procedure :: open => start_clock
      procedure :: close => write_section
   end type end_of_run_type

contains

   !> The last section of the listing
   pure type(end_of_run_type) function new_end_of_run() result(self)

      self%reads_motion = .false.
   end function new_end_of_run

   !> Start the clock
   subroutine start_clock(self, job, simulation, error)
      class(end_of_run_type), intent(inout) :: self
      type(job_type), intent(in) :: job
      class(simulation_type), intent(in) :: simulation
      type(error_type), allocatable, intent(out) :: error

      self%listing = job%listing
      call system_clock(self%started)
   end subroutine start_clock

   !> Write the section
   subroutine write_section(self, simulation, outcome, error)
      class(end_of_run_type), intent(inout) :: self
      class(simulation_type), intent(in) :: simulation
      type(error_type), allocatable, intent(in) :: outcome
      type(error_type), allocatable, intent(out) :: error

      character(:), allocatable :: words
      integer(int64) :: now, rate
      real(wp) :: dissipated
      type(delamination_type), allocatable :: lost(:)
      type(ply_cracks_type), allocatable :: cracks(:)

      allocate (lost(0))
      associate (domain => simulation%domain, state => simulation%state)
         if (can_fail(domain)) lost = delamination(domain, state%history)
         dissipated = sum(dissipated_energies(domain, state%history, lost))
         if (domain%cracks%whole > 0) cracks = cracks_of_plies(domain, state%history)
         if (self%listing == no_unit) return
         words = "normal end"
         if (allocated(outcome)) words = outcome%message
         call system_clock(now, rate)
         call write_end(self%listing, simulation%model, domain, state, dissipated, lost, &
            & real(now - self%started, wp)/real(rate, wp), words)
         if (allocated(cracks)) call write_crack_lengths(self%listing, simulation%model, cracks)
      end associate
   end subroutine write_section

end module plydyn_io_listing_end_of_run
