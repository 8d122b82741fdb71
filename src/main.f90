!> plydyn: read, build, run, stop. The only place that prints errors and ends the program.
program plydyn
   use, intrinsic :: iso_fortran_env, only : error_unit, output_unit
   use plydyn_base_error, only : error_type, exit_normal
   use plydyn_command, only : command_type, read_command, usage
   use plydyn_domain_build, only : build_domain
   use plydyn_domain_domain, only : domain_type
   use plydyn_input_read_model, only : keyword_manual, read_model
   use plydyn_model_model, only : model_type
   use plydyn_output_listing, only : write_end, write_listing
   use plydyn_output_profile, only : check_profiles
   use plydyn_output_text_file, only : close_text, create_text
   use plydyn_output_writer, only : writer_type
   use plydyn_solver_contacts, only : contacts_type, new_contacts
   use plydyn_solver_explicit, only : run, seconds_per_step
   use plydyn_solver_start, only : new_state
   use plydyn_solver_threads, only : choose_threads, set_threads
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
      type(model_type) :: model
      type(state_type) :: state
      integer :: listing

      call read_model(command%deck, model, messages, error)
      if (allocated(error)) return
      if (len(messages) > 0) write (output_unit, "(a)") messages
      model%control%threads = choose_threads(command%threads, model%control%threads)
      call set_threads(model%control%threads)
      call build_domain(model, domain, error)
      if (allocated(error)) return
      call check_profiles(model%request%profiles, domain, error)
      if (allocated(error)) return
      call new_contacts(domain, contacts, error)
      if (allocated(error)) return
      state = new_state(model, domain)
      if (command%action == "check" .or. model%control%check_only) then
         call write_listing(output_unit, build_text(), command%deck, messages, model, domain, &
            & seconds_per_step(domain, state))
         return
      end if
      call create_text(command%job//".out", listing, error)
      if (allocated(error)) return
      call write_listing(listing, build_text(), command%deck, messages, model, domain, &
         & seconds_per_step(domain, state))
      call run_job(command, listing, model, domain, contacts, state, error)
   end subroutine run_deck

   !> Run, and close all files whatever happens
   subroutine run_job(command, listing, model, domain, contacts, state, error)
      type(command_type), intent(in) :: command
      integer, intent(inout) :: listing
      type(model_type), intent(in) :: model
      type(domain_type), intent(in) :: domain
      type(contacts_type), intent(inout) :: contacts
      type(state_type), intent(inout) :: state
      type(error_type), allocatable, intent(out) :: error

      type(error_type), allocatable :: close_error
      type(writer_type) :: writer

      call writer%open(command%job, command%deck, version, output_unit, model, domain, error)
      if (.not. allocated(error)) call run(domain, contacts, state, writer, error)
      call writer%close(close_error)
      if (.not. allocated(error)) call move_alloc(close_error, error)
      if (allocated(error)) then
         call write_end(listing, model, domain, state, writer%elapsed(), error%message)
      else
         call write_end(listing, model, domain, state, writer%elapsed(), "normal end")
         write (output_unit, "(a)") "normal end, results in "//command%job//".*"
      end if
      call close_text(command%job//".out", listing, close_error)
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
