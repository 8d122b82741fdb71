!> The worked example of the manual: a history with its instants, its end, and its restart.
program test_io_csv_history_recorder
   use momentum_history, only : momentum_history_type
   use ball, only : ball_body
   use plydyn_base_error, only : error_type
   use plydyn_base_precision, only : wp
   use plydyn_io_job, only : job_type
   use plydyn_method_observer, only : observer_type, observers_type, requests_type
   use plydyn_model_body, only : contact_type, impactor_type, points_on_plate
   use plydyn_model_support, only : top_face
   use plydyn_parallel_comm, only : comm_type
   use plydyn_run_setup, only : run_type, set_up
   use plydyn_state_file_positions, only : file_positions_type, new_file_positions
   use sample, only : rectangle_mesh, rectangle_model
   use testing, only : begin, check, finish
   implicit none

   character(*), parameter :: name = "test_io_csv_history_recorder"
   character(80), allocatable :: lines(:)
   type(error_type), allocatable :: error, outcome
   type(file_positions_type) :: positions
   type(run_type) :: run

   call prepare()
   call first_run()
   call second_run()
   call without_impactor()
   call finish()

contains

   !> A plate under a sphere of mass 2 and velocity -3; a line each 10 seconds until 25
   subroutine prepare()
      type(comm_type) :: alone

      run%model = rectangle_model(rectangle_mesh(2, 2, 2, 4.0_wp, 4.0_wp, 0.0_wp), [0.0_wp], &
         & 1.0_wp, [1])
      run%model%impactors = [impactor_type(id=1, kind="sphere", &
         & body=ball_body(8.0_wp), mass=2.0_wp, centre=[2.0_wp, 2.0_wp, 9.0_wp], &
         & velocity=[0.0_wp, 0.0_wp, -3.0_wp])]
      run%model%contacts = [contact_type(id=1, impactor=1, parts=[1], face=top_face, &
         & method=points_on_plate)]
      run%model%request%impactor_interval = 10.0_wp
      run%model%control%end_time = 25.0_wp
      call set_up(alone, run, error)
      call check(.not. allocated(error), "the model is set up")
      run%state%step = 5.0_wp
   end subroutine prepare

   !> Steps of 5 seconds up to 15, with the position in the file after the line of 10
   subroutine first_run()
      type(momentum_history_type) :: history
      type(observers_type) :: observers
      class(observer_type), allocatable :: observer

      call begin("notify")
      call history%open(job_of(new_file_positions(name)), run, error)
      call check(.not. allocated(error), "opens")
      call history%begin(run, error)
      call history%clocks%advance(run%state%time)
      call step(history)
      call step(history)
      positions = new_file_positions(name)
      call history%mark(positions, error)
      call step(history)
      call history%close(run, outcome, error)
      call check(.not. allocated(error), "goes well")
      lines = lines_of_file()
      call check(size(lines), 3, "a header, the beginning and one instant")
      call check(lines(1) == "time [s],momentum [N s]" .and. lines(2) == "0,-6" &
         & .and. lines(3) == "10,-6", "columns and values")
      allocate (observer, source=history)
      call observers%start(name)
      call observers%add(observer)
      call check(.not. observers%read_motion(run%state), "the motion of points is not read")
   end subroutine first_run

   !> On from there to the end, with half of the velocity
   subroutine second_run()
      type(momentum_history_type) :: history

      call begin("restart")
      run%state%time = 10.0_wp
      run%state%impactors(1)%velocity(3) = -1.5_wp
      call history%open(job_of(positions), run, error)
      call check(.not. allocated(error), "goes on")
      call step(history)
      call step(history)
      call step(history)
      call history%close(run, outcome, error)
      lines = lines_of_file()
      call check(size(lines), 5, "one more instant, and the end")
      call check(lines(4) == "20,-3" .and. lines(5) == "25,-3", "their values")
   end subroutine second_run

   !> Nothing to observe
   subroutine without_impactor()
      type(momentum_history_type) :: history

      call begin("open")
      deallocate (run%model%impactors)
      allocate (run%model%impactors(0))
      call history%open(job_of(positions), run, error)
      call check(run%state%is_finished() .and. .not. history%is_due(run%state), &
         & "nothing is ever due")
   end subroutine without_impactor

   !> A job that goes on with files
   function job_of(places) result(job)
      type(file_positions_type), intent(in) :: places
      type(job_type) :: job

      job%path = name
      job%places = places
   end function job_of

   !> A step, with the clock of the history as the list of observers advances it
   subroutine step(history)
      type(momentum_history_type), intent(inout) :: history

      type(requests_type) :: requests

      call run%state%advance_clock()
      call history%notify(run, requests, error)
      if (history%is_due(run%state)) call history%clocks%advance(run%state%time)
   end subroutine step

   !> All lines of the file
   function lines_of_file() result(lines)
      character(80), allocatable :: lines(:)

      character(80) :: line
      integer :: status, unit

      allocate (lines(0))
      open (newunit=unit, file=name//".momentum.csv", status="old", action="read")
      do
         read (unit, "(a)", iostat=status) line
         if (status /= 0) exit
         lines = [lines, line]
      end do
      close (unit)
   end function lines_of_file

end program test_io_csv_history_recorder
