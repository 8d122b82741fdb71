!> The progress line: its text, and the interval of lines.
program test_io_listing_progress_monitor
   use plydyn_base_precision, only : wp
   use plydyn_io_listing_progress_monitor, only : progress_headers, progress_line, &
      & progress_timer_type, progress_type
   use plydyn_state_state, only : state_type
   use testing, only : begin, check, finish
   implicit none

   call values_of_the_line()
   call distances()
   call finish()

contains

   !> The line and its headers
   subroutine values_of_the_line()
      type(progress_type) :: progress
      type(state_type) :: state
      character(:), allocatable :: line, headers

      call begin("progress_line")
      state%end%time = 4.0e-3_wp
      line = progress_line(progress, state, 0.0_wp)
      call check(line(len(line):) == "-", "no time is left known at the start")
      state%cycle = 1200
      state%time = 1.0e-3_wp
      state%step_before = 2.5e-8_wp
      state%energies%reference = 1.0_wp
      state%energies%external = 0.0012_wp
      progress%cause = "element 12 ply 3"
      progress%force = -3456.0_wp
      line = progress_line(progress, state, 60.0_wp)
      headers = progress_headers("s", "N", .false.)
      call check(line == "     1200  1.0000E-03   25.0%  2.5000E-08  element 12 ply 3        " &
         & //"    -0.12%  -3.456E+03     0:01:00     0:03:00", "all values: "//line)
      call check(len(line), len(headers), "headers are as wide as the line")
      call check(index(headers, "force [N]") + len("force [N]"), &
         & index(line, "-3.456E+03") + len("-3.456E+03"), "a header ends where its numbers end")
      progress%has_kinetic_share = .true.
      state%energies%kinetic = 0.0123_wp
      state%energies%internal = 1.0_wp
      line = progress_line(progress, state, 60.0_wp)
      headers = progress_headers("s", "N", .true.)
      call check(line(len(line) - 7:) == "   1.23%", "share of the kinetic energy: "//line)
      call check(len(line), len(headers), "its header is as wide")
      progress%has_kinetic_share = .false.
      state%energies%start = state%energies%total()
      state%energies%external = 1.0e-17_wp
      line = progress_line(progress, state, 60.0_wp)
      call check(index(line, "  0.00%") > 0, "no sign at zero")
      progress%start_time = 1.0e-3_wp
      state%time = 2.0e-3_wp
      line = progress_line(progress, state, 60.0_wp)
      call check(line(len(line) - 6:) == "0:02:00", "a run that starts late has less to go")
   end subroutine values_of_the_line

   !> Distances of lines
   subroutine distances()
      type(progress_timer_type) :: timer

      call begin("timer")
      call check(timer%elapsed(), 0.0_wp, 0.0_wp, "no time before the start")
      call timer%start()
      call check(timer%elapsed() >= 0.0_wp, "time passes")
      call check(timer%due(0.0_wp), "the first line is due at once")
      call timer%advance(0.0_wp)
      call check(.not. timer%due(0.9_wp) .and. timer%due(1.0_wp), "then each second")
      call timer%advance(1000.0_wp)
      call check(.not. timer%due(1019.0_wp) .and. timer%due(1020.0_wp), "later less often")
   end subroutine distances

end program test_io_listing_progress_monitor
