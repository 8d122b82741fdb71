!> The list of observers: which of them it notifies of a step, when it passes requests from outside,
!> and where the motion is read.
program test_method_observer
   use marking_observer, only : marking_observer_type
   use plydyn_base_error, only : error_type
   use plydyn_base_precision, only : wp
   use plydyn_method_clock, only : clock_type, every_interval, every_steps
   use plydyn_method_observer, only : observer_type, observers_type, requests_type
   use plydyn_method_simulation, only : simulation_type
   use testing, only : begin, check, finish
   implicit none

   call steps()
   call requests_from_outside()
   call motion()
   call finish()

contains

   !> Observers due at times, at numbers, and never, in five steps
   subroutine steps()

      call begin("notify")
      call check(is_same(notified([every_interval(2.5_wp)]), [3, 5]), "at intervals")
      call check(is_same(notified([every_steps(2)]), [2, 4, 5]), &
         & "at multiples, and at the last step at the latest")
      call check(is_same(notified([every_interval(9.0_wp)]), [5]), "or at the last step alone")
      call check(is_same(notified([every_interval(2.5_wp), every_steps(2)]), [2, 3, 4, 5]), &
         & "by any of its clocks")
      call check(is_same(notified([every_interval(0.0_wp)]), [1, 2, 3, 4, 5]), "every step")
      call check(size(notified(no_clocks())) == 0, "never, not even at the end")
      call check(is_same(notified(no_clocks(), 3), [3]), "or where there is a request")
      call check(is_same(notified(no_clocks(), 2, by_first=.true.), [2]), &
         & "or where an observer before it has a request")
   end subroutine steps

   !> Not due at any time
   function no_clocks() result(clocks)
      type(clock_type), allocatable :: clocks(:)

      allocate (clocks(0))
   end function no_clocks

   !> Whether two lists are the same
   pure logical function is_same(a, b)
      integer, intent(in) :: a(:), b(:)

      is_same = size(a) == size(b)
      if (is_same) is_same = all(a == b)
   end function is_same

   !> Numbers of the steps of which an observer with some clocks is notified
   function notified(clocks, step, by_first) result(cycles)
      type(clock_type), intent(in) :: clocks(:)
      !> Step with a request, which an observer makes or not
      integer, intent(in), optional :: step
      logical, intent(in), optional :: by_first
      integer, allocatable :: cycles(:)

      type(error_type), allocatable :: error
      integer :: k, request
      logical :: makes
      type(observers_type) :: observers
      type(requests_type) :: requests
      type(simulation_type) :: simulation

      request = 9
      if (present(step)) request = step
      makes = .false.
      if (present(by_first)) makes = by_first
      allocate (cycles(0))
      simulation = five_steps()
      call observers%start("none")
      if (makes) call add([every_steps(request)], .true., observers)
      call add(clocks, .false., observers)
      call observers%begin(simulation, error)
      do k = 1, merge(request, 5, makes)
         call simulation%state%advance_clock()
         requests = requests_type(progress=k == request .and. .not. makes, least_volume=0.0_wp)
         call observers%notify(simulation, requests, error)
         if (nint(requests%least_volume) == k) cycles = [cycles, k]
      end do
   end function notified

   !> Requests from outside are passed when the motion is complete
   subroutine requests_from_outside()
      type(error_type), allocatable :: error
      type(observers_type) :: observers
      type(requests_type) :: requests
      type(simulation_type) :: simulation

      call begin("pass_requests")
      simulation = five_steps()
      call observers%start("none")
      call add(no_clocks(), .false., observers)
      call observers%begin(simulation, error)
      call observers%pass_requests(simulation, .false., requests)
      call check(.not. requests%flush .and. .not. observers%read_motion(simulation%state), &
         & "there are none")
      call observers%pass_requests(simulation, .true., requests)
      call check(.not. requests%flush, "not in the step in which they are found")
      call check(observers%read_motion(simulation%state), "the motion of the next one is complete")
      call observers%pass_requests(simulation, .true., requests)
      call check(requests%flush, "at the end of which they are passed")
      call observers%pass_requests(simulation, .false., requests)
      call check(.not. requests%flush, "once")
      simulation%state%end%time = simulation%state%time
      call observers%pass_requests(simulation, .true., requests)
      call check(requests%flush, "and at once at the end of the run")
   end subroutine requests_from_outside

   !> The motion is read where an observer that reads it is due
   subroutine motion()

      call begin("read_motion")
      call check(is_read(0.5_wp), "the first step ends behind the time")
      call check(.not. is_read(1.5_wp), "or before it")
   end subroutine motion

   !> Whether the motion at the end of the first step is read with some interval
   logical function is_read(interval)
      real(wp), intent(in) :: interval

      type(error_type), allocatable :: error
      type(observers_type) :: observers
      type(simulation_type) :: simulation

      simulation = five_steps()
      call observers%start("none")
      call add([every_interval(interval)], .false., observers)
      call observers%begin(simulation, error)
      is_read = observers%read_motion(simulation%state)
   end function is_read

   !> Steps of 1 second up to 5
   function five_steps() result(simulation)
      type(simulation_type) :: simulation

      simulation%state%step = 1.0_wp
      simulation%state%end%time = 5.0_wp
   end function five_steps

   !> Add an observer
   subroutine add(clocks, has_request, observers)
      type(clock_type), intent(in) :: clocks(:)
      !> Whether it requests a line of progress
      logical, intent(in) :: has_request
      type(observers_type), intent(inout) :: observers

      class(observer_type), allocatable :: observer
      type(marking_observer_type) :: marking

      marking%clocks = clocks
      marking%has_request = has_request
      allocate (observer, source=marking)
      call observers%add(observer)
   end subroutine add

end program test_method_observer
