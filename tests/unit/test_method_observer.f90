!> The list of observers: which of them it notifies of a step, and where the motion is read.
program test_method_observer
   use marking_observer, only : marking_observer_type
   use plydyn_base_error, only : error_type
   use plydyn_base_precision, only : wp
   use plydyn_method_observer, only : never, next_look_type, next_multiple, observer_type, &
      & observers_type
   use plydyn_method_simulation, only : simulation_type
   use testing, only : begin, check, finish
   implicit none

   call multiples()
   call steps()
   call motion()
   call finish()

contains

   !> Steps whose numbers are multiples
   subroutine multiples()

      call begin("next_multiple")
      call check(next_multiple(0, 16), 16, "step 0 is past")
      call check(next_multiple(15, 16), 16, "the step before a multiple")
      call check(next_multiple(16, 16), 32, "a multiple is past")
      call check(next_multiple(5, 0), never, "no multiples of 0")
   end subroutine multiples

   !> Observers due at a time, at a number, and never, in five steps
   subroutine steps()

      call begin("notify")
      call check(is_same(notified(next_look_type(time=2.5_wp)), [3, 4, 5]), "from a time on")
      call check(is_same(notified(next_look_type(cycle=4)), [4, 5]), "from a step on")
      call check(is_same(notified(next_look_type(time=9.0_wp)), [5]), "the last step at the latest")
      call check(is_same(notified(next_look_type(time=4.5_wp, cycle=2)), [2, 3, 4, 5]), &
         & "the earlier one of time and step")
      call check(size(notified(next_look_type())) == 0, "never, not even at the end")
      call check(is_same(notified(next_look_type(), 3), [3]), "or where attention is asked for")
      call check(is_same(notified(next_look_type(), 2, by_first=.true.), [2]), &
         & "or where an observer before it has a request")
   end subroutine steps

   !> Whether two lists are the same
   pure logical function is_same(a, b)
      integer, intent(in) :: a(:), b(:)

      is_same = size(a) == size(b)
      if (is_same) is_same = all(a == b)
   end function is_same

   !> Numbers of the steps of which an observer is notified that leaves `next` as it is
   function notified(next, step, by_first) result(cycles)
      type(next_look_type), intent(in) :: next
      !> Step with a request, which an observer makes or not
      integer, intent(in), optional :: step
      logical, intent(in), optional :: by_first
      integer, allocatable :: cycles(:)

      type(error_type), allocatable :: error
      integer :: k, request
      logical :: makes
      type(observers_type) :: observers
      type(simulation_type) :: simulation

      request = 0
      if (present(step)) request = step
      makes = .false.
      if (present(by_first)) makes = by_first
      allocate (cycles(0))
      simulation = five_steps()
      do k = 1, 5
         call observers%start("none")
         if (makes .and. k == request) call add(next_look_type(cycle=0), .true., observers)
         call add(next, .false., observers)
         call simulation%state%advance_clock()
         call observers%notify(simulation, k == request .and. .not. makes, error)
         if (nint(simulation%least_volume) == k) cycles = [cycles, k]
      end do
   end function notified

   !> The motion is read where an observer that reads it is due
   subroutine motion()
      type(observers_type) :: observers
      type(simulation_type) :: simulation

      call begin("read_motion")
      simulation = five_steps()
      call observers%start("none")
      call add(next_look_type(time=0.5_wp), .false., observers)
      call check(observers%read_motion(simulation%state), "the first step ends behind the time")
      call observers%start("none")
      call add(next_look_type(time=1.5_wp), .false., observers)
      call check(.not. observers%read_motion(simulation%state), "or before it")
   end subroutine motion

   !> Steps of 1 second up to 5
   function five_steps() result(simulation)
      type(simulation_type) :: simulation

      simulation%state%step = 1.0_wp
      simulation%state%end%time = 5.0_wp
      simulation%least_volume = 0.0_wp
   end function five_steps

   !> Add an observer
   subroutine add(next, has_request, observers)
      type(next_look_type), intent(in) :: next
      !> Whether it requests a line of progress
      logical, intent(in) :: has_request
      type(observers_type), intent(inout) :: observers

      class(observer_type), allocatable :: observer
      type(marking_observer_type) :: marking

      marking%next = next
      marking%has_request = has_request
      allocate (observer, source=marking)
      call observers%add(observer)
   end subroutine add

end program test_method_observer
