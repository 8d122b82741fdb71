!> plydyn: read, build, run, stop. The only place that prints errors and ends the program.
program plydyn
   use, intrinsic :: iso_fortran_env, only : error_unit, output_unit
   use plydyn_base_error, only : error_type, exit_normal
   use plydyn_base_precision, only : wp
   use plydyn_base_signals, only : catch_signals
   use plydyn_command, only : command_type, read_command, usage
   use plydyn_domain_build, only : build_domain
   use plydyn_domain_domain, only : domain_type
   use plydyn_input_read_model, only : keyword_manual, read_decks_of_run
   use plydyn_model_model, only : model_type
   use plydyn_output_dump_input, only : dump_input_type
   use plydyn_output_job, only : job_type
   use plydyn_output_listing, only : write_end, write_listing, write_restart
   use plydyn_output_places, only : new_places
   use plydyn_output_profile, only : check_profiles
   use plydyn_output_text_file, only : append_to, close_text, create_text
   use plydyn_output_writer, only : writer_type
   use plydyn_solver_contacts, only : contacts_type, new_contacts
   use plydyn_solver_explicit, only : run, seconds_per_step
   use plydyn_solver_restart, only : resume
   use plydyn_solver_start, only : new_state
   use plydyn_solver_threads, only : choose_threads, set_threads
   use plydyn_solver_watch, only : watch_type
   use plydyn_state_state, only : state_type
   use plydyn_version, only : build_text, version
   implicit none

   type(command_type) :: command
   type(error_type), allocatable :: error
   character(:), allocatable :: pages

   call read_command(command, error)
   call stop_on(error)
   select case (command%action)
   case ("--version")
      write (output_unit, "(a)") build_text()
   case ("--keywords")
      call keyword_manual(command%keyword, pages, error)
      call stop_on(error)
      write (output_unit, "(a)") pages
   case ("--help")
      write (output_unit, "(a)") usage
   case ("restart")
      call restart_run(command, error)
      call stop_on(error)
   case default
      call run_deck(command, error)
      call stop_on(error)
   end select

contains

   !> Check a deck, and run it
   subroutine run_deck(command, error)
      !> What the user asks for
      type(command_type), intent(in) :: command
      !> What went wrong
      type(error_type), allocatable, intent(out) :: error

      character(:), allocatable :: messages
      type(contacts_type) :: contacts
      type(domain_type) :: domain
      type(job_type) :: job
      type(model_type) :: model
      type(state_type) :: state

      call begin_job(command, job)
      call read_decks_of_run(job%archive, command%deck, model, messages, error)
      if (allocated(error)) return
      call build_run(command%threads, messages, model, domain, contacts, state, error)
      if (allocated(error)) return
      if (command%action == "check" .or. model%control%check_only) then
         call write_listing(output_unit, build_text(), command%deck, messages, model, domain, &
            & seconds_per_step(domain, state))
         return
      end if
      call create_text(job%path//".out", job%listing, error)
      if (allocated(error)) return
      call write_listing(job%listing, build_text(), command%deck, messages, model, domain, &
         & seconds_per_step(domain, state))
      call run_job(job, command%most_seconds, model, domain, contacts, state, error)
   end subroutine run_deck

   !> Go on from a restart file
   subroutine restart_run(command, error)
      !> What the user asks for
      type(command_type), intent(in) :: command
      !> What went wrong
      type(error_type), allocatable, intent(out) :: error

      character(:), allocatable :: messages, written_by
      type(contacts_type) :: contacts
      type(domain_type) :: domain
      type(dump_input_type) :: dump
      type(job_type) :: job
      type(model_type) :: model
      type(state_type) :: state

      call begin_job(command, job)
      call dump%open(command%restart, error)
      if (allocated(error)) return
      call dump%read_job(job, error)
      if (allocated(error)) return
      call move_alloc(job%version, written_by)
      job%version = version
      if (len(command%job) > 0) call rename_job(command%job, job)
      call read_decks_of_run(job%archive, command%deck, model, messages, error)
      if (allocated(error)) return
      call build_run(command%threads, messages, model, domain, contacts, state, error)
      if (allocated(error)) return
      call resume(dump, domain, model%changes, contacts, state, error)
      if (allocated(error)) return
      job%start_time = state%time
      call append_to(job%path//".out", job%listing, error)
      if (allocated(error)) return
      call write_restart(job, build_text(), command%restart, written_by, command%deck, messages, &
         & state)
      call run_job(job, command%most_seconds, model, domain, contacts, state, error)
   end subroutine restart_run

   !> The job as the command line has it
   subroutine begin_job(command, job)
      type(command_type), intent(in) :: command
      type(job_type), intent(out) :: job

      job%path = command%job
      job%deck = command%deck
      job%version = version
      job%screen = output_unit
      job%places = new_places(job%path)
      job%archive%parameters = command%parameters
      if (command%action /= "restart") allocate (job%archive%bundles(0))
      ! from now on, though nothing can be kept before the first step
      if (command%action /= "check") call catch_signals()
   end subroutine begin_job

   !> Let the results of a restart go to files of their own, which begin there
   subroutine rename_job(path, job)
      character(*), intent(in) :: path
      type(job_type), intent(inout) :: job

      job%path = path
      job%places = new_places(path)
      job%dumps = 0
   end subroutine rename_job

   !> From the model to a state at time zero
   subroutine build_run(threads, messages, model, domain, contacts, state, error)
      !> Threads that the command line asks for, 0 when it does not
      integer, intent(in) :: threads
      character(*), intent(in) :: messages
      !> Gets the number of threads
      type(model_type), intent(inout) :: model
      type(domain_type), intent(out) :: domain
      type(contacts_type), intent(out) :: contacts
      type(state_type), intent(out) :: state
      type(error_type), allocatable, intent(out) :: error

      if (len(messages) > 0) write (output_unit, "(a)") messages
      model%control%threads = choose_threads(threads, model%control%threads)
      call set_threads(model%control%threads)
      call build_domain(model, domain, error)
      if (allocated(error)) return
      call check_profiles(model%request%profiles, domain, error)
      if (allocated(error)) return
      call new_contacts(domain, contacts, error)
      if (allocated(error)) return
      state = new_state(model, domain)
   end subroutine build_run

   !> Run, and close all files whatever happens
   subroutine run_job(job, most_seconds, model, domain, contacts, state, error)
      type(job_type), intent(inout) :: job
      real(wp), intent(in) :: most_seconds
      type(model_type), intent(in) :: model
      type(domain_type), intent(in) :: domain
      type(contacts_type), intent(inout) :: contacts
      type(state_type), intent(inout) :: state
      type(error_type), allocatable, intent(out) :: error

      type(error_type), allocatable :: close_error
      type(watch_type) :: watch
      type(writer_type) :: writer

      call watch%start(job, model%request, most_seconds)
      call writer%open(job, model, domain, error)
      if (.not. allocated(error) .and. state%cycle > 0 .and. size(job%places%list) == 0) then
         call writer%record(domain, state, error)
      end if
      if (.not. allocated(error)) call run(domain, contacts, state, writer, watch, error)
      call writer%close(close_error)
      if (.not. allocated(error)) call move_alloc(close_error, error)
      if (allocated(error)) then
         call write_end(job%listing, model, domain, state, writer%elapsed(), error%message)
      else
         call write_end(job%listing, model, domain, state, writer%elapsed(), "normal end")
         write (output_unit, "(a)") "normal end, results in "//job%path//".*"
      end if
      call close_text(job%path//".out", job%listing, close_error)
      if (.not. allocated(error)) call move_alloc(close_error, error)
   end subroutine run_job

   !> Print an error and end with its code
   subroutine stop_on(error)
      !> What went wrong
      type(error_type), allocatable, intent(in) :: error

      interface
         !> C's exit: an exit code without Fortran's own words
         subroutine leave(code) bind(c, name="exit")
            use, intrinsic :: iso_c_binding, only : c_int
            implicit none
            integer(c_int), value :: code
         end subroutine leave
      end interface

      if (.not. allocated(error)) return
      flush (output_unit)
      write (error_unit, "(a)") error%message
      flush (error_unit)
      if (error%code /= exit_normal) call leave(error%code)
   end subroutine stop_on

end program plydyn
