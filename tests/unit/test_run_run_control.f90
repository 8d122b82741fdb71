!> Words to a running job.
program test_run_run_control
   use plydyn_base_files, only : remove_file
   use plydyn_base_precision, only : wp
   use plydyn_method_observer, only : requests_type
   use plydyn_run_run_control, only : take_requests
   use testing, only : begin, check, finish, write_lines
   implicit none

   character(*), parameter :: path = "test_run_run_control.ctl"
   type(requests_type) :: requests
   character(:), allocatable :: answer
   logical :: exists, found

   call begin("take_requests")
   call take_requests(path, 1.0_wp, requests, answer, found)
   call check(.not. found, "no file, no request")
   call write_lines(path, "Dump|  plot|status|flush|end-time 2.5|")
   call take_requests(path, 1.0_wp, requests, answer, found)
   call check(found .and. requests%checkpoint .and. requests%fields .and. requests%progress &
      & .and. requests%flush .and. .not. allocated(requests%stopped_by), "all words of a file")
   call check(requests%end_time, 2.5_wp, 0.0_wp, "with the number behind one")
   inquire (file=path, exist=exists)
   call check(.not. exists, "the file is set aside")
   call write_lines(path, "sw1")
   call take_requests(path, 1.0_wp, requests, answer, found)
   call check(allocated(requests%stopped_by), "the words of LS-DYNA; a line that does not end")
   call write_lines(path, "please stop||end-time|end-time 0.5|end-time nan|stop now|")
   call take_requests(path, 1.0_wp, requests, answer, found)
   call check(requests%end_time < 0.0_wp, "an end that is over, or no number, is none")
   call check(index(answer, "'please stop' not understood") > 0, "nonsense is reported")
   call check(index(answer, "at time 1 already") > 0, "so is why an end is refused")
   call check(allocated(requests%stopped_by) .and. index(answer, "follows the first word") > 0, &
      & "a word with more behind it is taken, and that is reported")
   call write_lines(path, repeat("status|", 150)//"stop|")
   call take_requests(path, 1.0_wp, requests, answer, found)
   call check(allocated(requests%stopped_by), "no line is left out, however many there are")
   call check(index(answer, "and 51 more lines") > 0, "not all of them are reported")
   call write_lines(path, "end-time 2*3.0|end-time 3,5|")
   call take_requests(path, 1.0_wp, requests, answer, found)
   call check(requests%end_time < 0.0_wp, "what Fortran reads as lists are no times")
   call execute_command_line("mkfifo "//path)
   call take_requests(path, 1.0_wp, requests, answer, found)
   call check(found .and. index(answer, "no regular file") > 0, "a pipe is not waited for")
   call take_requests(path, 1.0_wp, requests, answer, found)
   call check(.not. found, "and set aside")
   call remove_file(path//".read")
   call finish()

end program test_run_run_control
