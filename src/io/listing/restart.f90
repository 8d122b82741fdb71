!> The parts of the listing on a restart: where the run goes on, and what the deck of the restart
!> changes.
module plydyn_io_listing_restart
   use plydyn_base_precision, only : wp
   use plydyn_base_text, only : text
   use plydyn_domain_domain, only : domain_type
   use plydyn_io_job, only : job_type, no_unit
   use plydyn_io_listing_table, only : write_section
   use plydyn_io_listing_time_step, only : write_step
   use plydyn_method_simulation, only : simulation_type
   use plydyn_model_model, only : model_type
   use plydyn_state_state, only : state_type
   implicit none
   private

   public :: write_changes, write_new_step, write_restart

   !> Width of the kinds of things, in characters
   integer, parameter :: kind_width = 24

contains

   !> One line for each kind of thing that the deck changes; nothing without such a deck
   subroutine write_changes(unit, deck, simulation)
      !> Unit of the listing
      integer, intent(in) :: unit
      !> Path of the deck, empty for none
      character(*), intent(in) :: deck
      !> Has the changes, and the state from which the run continues
      class(simulation_type), intent(in) :: simulation

      integer :: i
      character(kind_width) :: kind
      logical :: ends_before

      if (len(deck) == 0) return
      call write_section(unit, "Changed by "//deck)
      associate (model => simulation%model, state => simulation%state, &
         & control => simulation%model%control)
         do i = 1, size(model%change_list)
            kind = model%change_list(i)%kind
            write (unit, "(2a)") kind, model%change_list(i)%words
         end do
         kind = "the run ends at"
         ends_before = state%end%cycle > 0 .or. control%rest_share > 0.0_wp &
            & .or. control%load_share > 0.0_wp
         write (unit, "(6a,/)") kind, "time ", text(state%end%time), " ", &
            & trim(control%units%time), trim(merge(", or before", "           ", ends_before))
      end associate
      flush (unit)
   end subroutine write_changes

   !> Where a run goes on
   subroutine write_restart(job, build, path, written_by, messages, state)
      type(job_type), intent(in) :: job
      !> Version and compiler
      character(*), intent(in) :: build
      !> Path of the restart file, and version of the program that wrote it
      character(*), intent(in) :: path, written_by
      !> Warnings of the readers
      character(*), intent(in) :: messages
      type(state_type), intent(in) :: state

      character(:), allocatable :: words

      call write_section(job%listing, "Restart")
      words = "continues from "//path//" at cycle "//text(state%cycle)//", time "//text(state%time)
      write (job%listing, "(a)") build, words
      if (written_by /= job%version) write (job%listing, "(3a)") "the restart file is of plydyn ", &
         & written_by, ": the last bits may differ from those of an unbroken run"
      if (len(messages) > 0) write (job%listing, "(a)") messages
      flush (job%listing)
      if (job%screen /= no_unit) write (job%screen, "(a)") words
   end subroutine write_restart

   !> The step from a restart on, and what the change of the mass did
   subroutine write_new_step(job, model, domain, kinetic)
      type(job_type), intent(in) :: job
      type(model_type), intent(in) :: model
      type(domain_type), intent(in) :: domain
      !> Kinetic energy of the plate before and after
      real(wp), intent(in) :: kinetic(2)

      call write_step(job%listing, model, domain)
      write (job%listing, "(a)") ""
      call job%note("*CONTROL_TIMESTEP of the restart: the step is at most " &
         & //text(domain%step, 5)//" "//trim(model%control%units%time)//" from here on; the " &
         & //"kinetic energy of the plate changes from "//text(kinetic(1), 5)//" to " &
         & //text(kinetic(2), 5)//" "//trim(model%control%units%energy)//" with its mass, by " &
         & //"external work")
   end subroutine write_new_step

end module plydyn_io_listing_restart
