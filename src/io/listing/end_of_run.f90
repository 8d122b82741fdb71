!> The last section of the listing: how a run ended.
module plydyn_io_listing_end_of_run
   use, intrinsic :: iso_fortran_env, only : int64
   use plydyn_base_error, only : error_type
   use plydyn_base_precision, only : wp
   use plydyn_base_text, only : duration_text
   use plydyn_domain_delamination, only : can_fail, delamination, delamination_type
   use plydyn_domain_element_energies, only : cracks_of_plies, dissipated_energies, ply_cracks_type
   use plydyn_io_job, only : job_type, no_unit, output_type
   use plydyn_io_listing_cohesive, only : write_crack_lengths, write_interface_losses
   use plydyn_io_listing_table, only : write_section
   use plydyn_method_simulation, only : simulation_type
   use plydyn_model_symmetry, only : copies, whole_name
   implicit none
   private

   !> Writes the section when the run is over
   type, public, extends(output_type) :: end_of_run_type
      private
      !> Unit of the listing, on the root
      integer :: listing = no_unit
      !> Clock at the start
      integer(int64) :: started = 0_int64
   contains
      procedure :: open => start_clock
      procedure :: close => write_end
   end type end_of_run_type

contains

   !> Start the clock
   subroutine start_clock(self, job, simulation, error)
      class(end_of_run_type), intent(inout) :: self
      type(job_type), intent(in) :: job
      class(simulation_type), intent(in) :: simulation
      type(error_type), allocatable, intent(out) :: error

      self%reads_motion = .false.
      self%listing = job%listing
      call system_clock(self%started)
   end subroutine start_clock

   !> Write the section
   subroutine write_end(self, simulation, outcome, error)
      class(end_of_run_type), intent(inout) :: self
      class(simulation_type), intent(in) :: simulation
      type(error_type), allocatable, intent(in) :: outcome
      type(error_type), allocatable, intent(out) :: error

      real(wp) :: dissipated
      type(delamination_type), allocatable :: lost(:)
      type(ply_cracks_type), allocatable :: cracks(:)

      ! all ranks sum, the root writes
      allocate (lost(0))
      associate (domain => simulation%domain, state => simulation%state)
         if (can_fail(domain)) lost = delamination(domain, state%history)
         dissipated = sum(dissipated_energies(domain, state%history, lost))
         if (domain%cracks%whole > 0) cracks = cracks_of_plies(domain, state%history)
      end associate
      if (self%listing == no_unit) return
      call write_outcome(self, simulation, dissipated, outcome)
      call write_interface_losses(self%listing, simulation%model, simulation%domain, lost)
      flush (self%listing)
      if (allocated(cracks)) call write_crack_lengths(self%listing, simulation%model, cracks)
   end subroutine write_end

   !> How the run ended, and its energies
   subroutine write_outcome(self, simulation, dissipated, outcome)
      type(end_of_run_type), intent(in) :: self
      class(simulation_type), intent(in) :: simulation
      !> Energy that all mechanisms have dissipated
      real(wp), intent(in) :: dissipated
      !> What stopped the run; not allocated for a normal end
      type(error_type), allocatable, intent(in) :: outcome

      character(:), allocatable :: words
      integer(int64) :: now, rate
      real(wp) :: seconds

      words = "normal end"
      if (allocated(outcome)) words = outcome%message
      call system_clock(now, rate)
      seconds = real(now - self%started, wp)/real(rate, wp)
      call write_section(self%listing, "End")
      write (self%listing, "(a)") words
      associate (u => simulation%model%control%units, state => simulation%state, &
         & e => simulation%state%energies, n => copies(simulation%model))
         write (self%listing, "(a,i0,a,es12.5,1x,a)") "cycle ", state%cycle, ", time ", &
            & state%time, trim(u%time)
         write (self%listing, "(2a)") "elapsed ", duration_text(seconds)
         write (self%listing, "(a,f0.3,a)") "seconds ", seconds, " in the loop"
         if (n > 1) write (self%listing, "(a)") whole_name(simulation%model)
         write (self%listing, "(a,11(/,a,es14.6,1x,a))") "energies", &
            & "  kinetic   ", n*e%kinetic, trim(u%energy), "  internal  ", n*e%internal, &
            & trim(u%energy), "  dissipated", n*dissipated, &
            & trim(u%energy), "  impactors ", n*e%impactor, trim(u%energy), "  damping   ", &
            & n*e%damping, trim(u%energy), "  contact   ", n*e%contact, trim(u%energy), &
            & "  contact friction ", n*e%friction, trim(u%energy), &
            & "  added     ", n*e%added, trim(u%energy), "  half-step correction ", &
            & n*(e%half_step_correction - e%step_change), trim(u%energy), &
            & "  external  ", n*e%external, trim(u%energy), "  at start  ", n*e%start, &
            & trim(u%energy)
         write (self%listing, "(a,es10.2)") "energy error ", e%error()
      end associate
   end subroutine write_outcome

end module plydyn_io_listing_end_of_run
