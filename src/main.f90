!> plydyn: read, build, run, stop. The only place that prints errors and ends the program.
program plydyn
   use, intrinsic :: iso_fortran_env, only : error_unit, output_unit
   use plydyn_base_error, only : c_exit, error_type, exit_input, exit_normal, exit_output, fail
   use plydyn_base_file_identity, only : make_folder
   use plydyn_base_files, only : is_same_path
   use plydyn_base_limits, only : check_stacks
   use plydyn_base_memory, only : keep_arrays_on_pages
   use plydyn_base_precision, only : wp
   use plydyn_base_signals, only : catch_signals
   use plydyn_base_text, only : text
   use plydyn_command, only : command_type, read_command, usage
   use plydyn_input_read_model, only : keyword_manual, read_decks_of_run
   use plydyn_model_model, only : model_type
   use plydyn_model_control, only : changes_type
   use plydyn_io_checkpoint_dump_input, only : dump_input_type
   use plydyn_io_input_guard, only : check_inputs, spare_restart
   use plydyn_io_job, only : broadcast_archive, broadcast_job, job_type
   use plydyn_io_listing_duration, only : contact_duration_warning, loading_rate_warning, &
      & write_loading_rate
   use plydyn_io_listing_listing, only : write_listing
   use plydyn_io_listing_restart, only : write_changes, write_new_step, write_restart
   use plydyn_io_listing_time_step, only : added_mass_warning, first_step_warning
   use plydyn_state_file_positions, only : new_file_positions
   use plydyn_io_listing_effort, only : cost_type, write_ranks
   use plydyn_io_csv_text_file, only : append_to, close_text, create_text
   use plydyn_parallel_comm, only : comm_type, leave_ranks, start_ranks, stop_ranks
   use plydyn_method_observer, only : observers_type
   use plydyn_run_loop, only : run
   use plydyn_run_observers, only : make_observers
   use plydyn_run_restart, only : jump_warning, resume
   use plydyn_run_setup, only : choose_threads, most_threads, run_type, set_threads, set_up
   use plydyn_run_step_cost, only : measure_cost
   use plydyn_version, only : build_text, version
   implicit none

   type(comm_type) :: comm
   type(command_type) :: command
   type(error_type), allocatable :: error
   type(job_type) :: job
   character(:), allocatable :: pages

   call keep_arrays_on_pages()
   call start_ranks(comm)
   call check_stacks(error)
   call stop_on(comm, error)
   call read_command(command, error)
   call stop_on(comm, error)
   select case (command%action)
   case ("--version")
      write (output_unit, "(a)") build_text()
   case ("--keywords")
      call keyword_manual(command%keyword, pages, error)
      call stop_on(comm, error)
      write (output_unit, "(a)") pages
   case ("--help")
      write (output_unit, "(a)") usage
   case ("restart")
      call restart_run(comm, command, job, error)
   case default
      call run_deck(comm, command, job, error)
   end select
   call job%lock%release()
   call stop_on(comm, error)
   call stop_ranks(comm)

contains

   !> Check a deck, and run it
   subroutine run_deck(comm, command, job, error)
      type(comm_type), intent(in) :: comm
      type(command_type), intent(in) :: command
      !> The job, whose lock is to be released afterwards
      type(job_type), intent(out) :: job
      type(error_type), allocatable, intent(out) :: error

      character(:), allocatable :: messages
      type(run_type) :: parts
      type(cost_type) :: cost

      call begin_job(comm, command, job)
      call read_model(comm, command%deck, job, parts%model, messages, error)
      if (allocated(error)) return
      call build_run(comm, command%threads, messages, parts, error)
      if (allocated(error)) return
      if (comm%is_root()) call add_message(contact_duration_warning(parts%model), messages)
      cost = measure_cost(parts)
      if (command%action == "check" .or. parts%model%control%check_only) then
         if (comm%is_root()) call list(output_unit, command%deck, "", cost, parts)
         return
      end if
      if (comm%is_root()) call begin_results(command, job, error)
      call comm%broadcast(error)
      if (allocated(error)) return
      if (comm%is_root()) call list(job%listing, command%deck, messages, cost, parts)
      call run_job(comm, job, command%most_seconds, parts, error)
   end subroutine run_deck

   !> Go on from a restart file
   subroutine restart_run(comm, command, job, error)
      type(comm_type), intent(in) :: comm
      type(command_type), intent(in) :: command
      !> The job, whose lock is to be released afterwards
      type(job_type), intent(out) :: job
      type(error_type), allocatable, intent(out) :: error

      character(:), allocatable :: messages, warning, written_by
      type(dump_input_type) :: dump
      type(run_type) :: parts
      real(wp) :: kinetic(2)
      type(cost_type) :: cost

      call begin_job(comm, command, job)
      call dump%open(command%restart, error)
      call comm%broadcast_error(error)
      if (allocated(error)) return
      if (comm%is_root()) call dump%read_job(job, error)
      call comm%broadcast(error)
      if (allocated(error)) return
      if (comm%is_root()) call move_alloc(job%version, written_by)
      job%version = version
      if (len(command%job) > 0) call rename_job(comm, command%job, job)
      ! before a look at results that an active run changes
      if (comm%is_root() .and. .not. job%is_renamed) call job%lock%take(job%path, error)
      if (comm%is_root() .and. .not. allocated(error)) call dump%compare_results(job, error)
      call comm%broadcast(error)
      if (allocated(error)) return
      call read_model(comm, command%deck, job, parts%model, messages, error)
      if (allocated(error)) return
      call build_run(comm, command%threads, messages, parts, error)
      if (allocated(error)) return
      call resume(dump, parts, kinetic, error)
      if (allocated(error)) return
      if (parts%model%changes%conditions) then
         warning = jump_warning(parts)
         if (comm%is_root()) call add_message(warning, messages)
      end if
      if (parts%model%control%check_only) then
         cost = measure_cost(parts)
         if (comm%is_root()) call list(output_unit, command%deck, "", cost, parts)
         if (comm%is_root()) call write_changes(output_unit, command%deck, parts)
         return
      end if
      job%start_time = parts%state%time
      if (comm%is_root()) call begin_results(command, job, error)
      call comm%broadcast(error)
      if (allocated(error)) return
      if (comm%is_root()) then
         call write_restart(job, build_text(), command%restart, written_by, messages, parts%state)
         call write_changes(job%listing, command%deck, parts)
         associate (changes => parts%model%changes)
            if (changes%conditions) call write_loading_rate(job%listing, parts%model, parts%domain)
            if (changes%step) call write_new_step(job, parts%model, parts%domain, kinetic)
         end associate
      end if
      if (parts%state%is_finished()) call job%note("nothing is left to do: the end that the run " &
         & //"has is reached; *CONTROL_TERMINATION in a deck of the restart moves it")
      call run_job(comm, job, command%most_seconds, parts, error)
   end subroutine restart_run

   !> The job as the command line has it
   subroutine begin_job(comm, command, job)
      type(comm_type), intent(in) :: comm
      type(command_type), intent(in) :: command
      type(job_type), intent(inout) :: job

      job%path = command%job
      job%deck = command%deck
      job%version = version
      if (comm%is_root()) job%screen = output_unit
      job%places = new_file_positions(job%path)
      job%archive%parameters = command%parameters
      if (command%action /= "restart") allocate (job%archive%bundles(0))
      ! from now on, though nothing can be kept before the first step
      if (command%action /= "check") call catch_signals()
   end subroutine begin_job

   !> Open the listing, the first of the results, once it is sure that none replaces an input, and
   !> that no other run writes them
   subroutine begin_results(command, job, error)
      type(command_type), intent(in) :: command
      !> The job with its decks; gets the unit of the listing
      type(job_type), intent(inout) :: job
      !> An input would be lost, or the listing cannot be opened
      type(error_type), allocatable, intent(out) :: error

      logical :: good

      call check_inputs(job, command%restart, error)
      if (allocated(error)) return
      if (len(command%folder) > 0) then
         call make_folder(command%folder, good)
         if (.not. good) call fail(error, exit_output, "cannot make the folder "//command%folder &
            & //": the one that it is in must be writable, and no file may have its name")
         if (.not. good) return
      end if
      if (.not. job%lock%is_held()) call job%lock%take(job%path, error)
      if (allocated(error)) return
      if (command%action == "restart") then
         call spare_restart(command%restart, job)
         call append_to(job%path//".out", job%listing, error)
      else
         call create_text(job%path//".out", job%listing, error)
      end if
      if (.not. allocated(error) .and. len(job%lock%warning) > 0) call job%note(job%lock%warning)
   end subroutine begin_results

   !> Give the results of a restart another name: they are new files, unless the name is the old one
   subroutine rename_job(comm, path, job)
      type(comm_type), intent(in) :: comm
      character(*), intent(in) :: path
      type(job_type), intent(inout) :: job

      logical :: is_same

      is_same = .true.
      if (comm%is_root()) is_same = is_same_path(path, job%path)
      call comm%all_true(is_same)
      if (is_same) return
      job%path = path
      job%places = new_file_positions(path)
      job%is_renamed = .true.
      job%dumps = 0
   end subroutine rename_job

   !> The model of all decks; the root reads the files and broadcasts them
   subroutine read_model(comm, deck, job, model, messages, error)
      type(comm_type), intent(in) :: comm
      !> Path of a new deck, empty for none
      character(*), intent(in) :: deck
      !> Gets the decks, word for word
      type(job_type), intent(inout) :: job
      type(model_type), intent(out) :: model
      character(:), allocatable, intent(out) :: messages
      type(error_type), allocatable, intent(out) :: error

      integer :: changes(5)

      if (comm%is_root()) call read_decks_of_run(job%archive, deck, &
         & job%start_time, model, messages, error)
      call comm%broadcast(error)
      if (allocated(error) .or. comm%ranks == 1) return
      call broadcast_archive(comm, job%archive)
      if (.not. comm%is_root()) then
         call read_decks_of_run(job%archive, "", job%start_time, model, messages, error)
         messages = ""
      end if
      associate (own => model%changes)
         changes(:) = merge(1, 0, [own%conditions, own%end, own%relaxation, own%bodies, &
            & own%step])
      end associate
      call comm%broadcast(changes)
      model%changes = changes_type(changes(1) == 1, changes(2) == 1, changes(3) == 1, &
         & changes(4) == 1, changes(5) == 1)
   end subroutine read_model

   !> All that a run needs, with a state at time zero
   subroutine build_run(comm, threads, messages, parts, error)
      type(comm_type), intent(in) :: comm
      !> Threads that the command line asks for, 0 when it does not
      integer, intent(in) :: threads
      !> Warnings and notes; gets those on the domain
      character(:), allocatable, intent(inout) :: messages
      !> Has the model, which gets the number of threads
      type(run_type), intent(inout) :: parts
      type(error_type), allocatable, intent(out) :: error

      if (len(messages) > 0) write (output_unit, "(a)") messages
      parts%model%control%threads = choose_threads(threads, parts%model%control%threads)
      if (parts%model%control%threads > most_threads()) then
         call fail(error, exit_input, text(parts%model%control%threads)//" threads are too many " &
            & //"for this machine: right would be at most "//text(most_threads()) &
            & //", by NCPU of *CONTROL_PARALLEL, ncpu= or OMP_NUM_THREADS")
         return
      end if
      call set_threads(parts%model%control%threads)
      call set_up(comm, parts, error)
      if (allocated(error) .or. .not. comm%is_root()) return
      call add_message(added_mass_warning(parts%domain), messages)
      call add_message(loading_rate_warning(parts%model, parts%domain), messages)
      call add_message(first_step_warning(parts%domain), messages)
   end subroutine build_run

   !> Print a warning, and add it to the messages for the listing
   subroutine add_message(warning, messages)
      !> The warning, empty for none
      character(*), intent(in) :: warning
      !> All messages
      character(:), allocatable, intent(inout) :: messages

      if (len(warning) == 0) return
      write (output_unit, "(a)") warning
      if (len(messages) > 0) messages = messages//new_line("a")
      messages = messages//warning
   end subroutine add_message

   !> Write the listing up to the first step
   subroutine list(unit, deck, messages, cost, parts)
      integer, intent(in) :: unit
      character(*), intent(in) :: deck, messages
      type(cost_type), intent(in) :: cost
      type(run_type), intent(in) :: parts

      call write_listing(unit, build_text(), deck, messages, parts, cost)
      if (size(parts%ranks, 2) > 0) call write_ranks(unit, parts%ranks)
   end subroutine list

   !> Run, and close all files, also after an error
   subroutine run_job(comm, job, most_seconds, parts, error)
      type(comm_type), intent(in) :: comm
      type(job_type), intent(inout) :: job
      real(wp), intent(in) :: most_seconds
      type(run_type), intent(inout) :: parts
      type(error_type), allocatable, intent(out) :: error

      type(error_type), allocatable :: close_error
      type(observers_type) :: observers

      call broadcast_job(comm, job)
      call make_observers(job, parts, most_seconds, observers, error)
      if (.not. allocated(error) .and. parts%state%cycle > 0 .and. job%is_renamed) then
         call observers%begin(parts, error)
      end if
      if (.not. allocated(error)) call run(parts, observers, error)
      call observers%close(parts, error)
      if (.not. comm%is_root()) return
      if (.not. allocated(error)) then
         write (output_unit, "(a)") "normal end, results in "//job%path//".*"
      end if
      call close_text(job%path//".out", job%listing, close_error)
      if (.not. allocated(error)) call move_alloc(close_error, error)
   end subroutine run_job

   !> Print an error, which all ranks have, and end with its code
   subroutine stop_on(comm, error)
      type(comm_type), intent(in) :: comm
      type(error_type), allocatable, intent(in) :: error

      if (.not. allocated(error)) return
      flush (output_unit)
      if (comm%is_root()) write (error_unit, "(a)") error%message
      flush (error_unit)
      if (error%code == exit_output) then
         call leave_ranks(comm)
      else
         call stop_ranks(comm)
      end if
      if (error%code /= exit_normal) call c_exit(error%code)
   end subroutine stop_on

end program plydyn
