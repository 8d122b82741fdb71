!> Observers of a run: histories, fields, listing, progress line, checkpoints, run control.
!>
!> The method uses this abstract type alone. The observers of a run are made in one place,
!> `plydyn_run_observers`. Each of them sets when it is due next; the list notifies it at the end of
!> that step, and of each step in which an observer makes a request, in the order of the list.
module plydyn_method_observer
   use plydyn_base_error, only : error_type
   use plydyn_base_precision, only : wp
   use plydyn_method_element_balance, only : element_balance_type
   use plydyn_method_simulation, only : simulation_type
   use plydyn_state_file_positions, only : file_positions_type, new_file_positions
   use plydyn_state_state, only : state_type
   implicit none
   private

   public :: next_multiple

   !> Number of the step at which an observer is due that is never due
   integer, parameter, public :: never = huge(1)

   !> When an observer is due next: at the end of the first step that reaches the time or the
   !> number, and of the last step at the latest
   type, public :: next_look_type
      !> Time, and number of the step; neither of them is set where it is never due
      real(wp) :: time = huge(1.0_wp)
      integer :: cycle = never
   contains
      procedure, private :: has_come
   end type next_look_type

   !> Requests of one observer to the others, in the step of a notification
   type, public :: requests_type
      !> Whether any rank asked for attention; the same on all ranks
      logical :: attention = .false.
      !> Fields, progress line, restart file, due or not; all files flushed to the disk
      logical :: fields = .false., progress = .false., checkpoint = .false., flush = .false.
      !> Energies of the elements that a history has taken in this step; not allocated without one
      type(element_balance_type), allocatable :: balance
      !> Source of a request to stop with a restart file; not allocated without one
      character(:), allocatable :: stopped_by
   contains
      procedure :: are_made
   end type requests_type

   !> Something that observes a run, and does nothing of its own accord: an extension overrides
   !> what it needs. All ranks call all procedures together, and get the same error
   type, abstract, public :: observer_type
      !> When it is due next; the same on all ranks
      type(next_look_type) :: next
      !> Whether it reads displacements or velocities of points: then the method completes the
      !> motion at the end of each step at which the observer is due
      logical :: reads_motion = .true.
   contains
      procedure, non_overridable :: is_due
      procedure :: begin
      procedure :: look_for_requests
      procedure :: notify
      procedure :: mark
      procedure :: save
      procedure :: close => close_observer
   end type observer_type

   !> An element of the list
   type :: item_type
      class(observer_type), allocatable :: observer
   end type item_type

   !> All observers of a run
   type, public :: observers_type
      private
      type(item_type), allocatable :: items(:)
      !> Path of the results without endings
      character(:), allocatable :: path
   contains
      procedure :: start
      procedure :: add
      procedure :: begin => begin_all
      procedure :: read_motion
      procedure :: look_for_requests => look_for_all_requests
      procedure :: notify => notify_all
      procedure :: close => close_all
   end type observers_type

contains

   !> Whether the end of a step is one at which an observer is due
   pure logical function has_come(self, time, cycle, is_last)
      !> When it is due next
      class(next_look_type), intent(in) :: self
      !> Time at the end of the step, its number, and whether the run ends with it
      real(wp), intent(in) :: time
      integer, intent(in) :: cycle
      logical, intent(in) :: is_last

      has_come = time >= self%time .or. cycle >= self%cycle
      if (is_last) has_come = self%time < huge(1.0_wp) .or. self%cycle < never
   end function has_come

   !> The first step after another one whose number is a multiple; never, if that of 0
   elemental integer function next_multiple(cycle, steps)
      !> Number of a step
      integer, intent(in) :: cycle
      !> Steps between two multiples
      integer, intent(in) :: steps

      next_multiple = never
      if (steps > 0) next_multiple = steps*(cycle/steps + 1)
   end function next_multiple

   !> Whether an observer has requested anything in this step
   pure logical function are_made(self)
      !> The requests
      class(requests_type), intent(in) :: self

      are_made = self%attention .or. self%fields .or. self%progress .or. self%checkpoint &
         & .or. self%flush .or. allocated(self%balance)
   end function are_made

   !> Whether it is due at the end of the step that was made; the same on all ranks
   pure logical function is_due(self, state)
      class(observer_type), intent(in) :: self
      !> The state at the end of the step
      type(state_type), intent(in) :: state

      is_due = self%next%has_come(state%time, state%cycle, state%is_finished())
   end function is_due

   !> Observe the state that a run begins with
   subroutine begin(self, simulation, error)
      class(observer_type), intent(inout) :: self
      !> The simulation
      class(simulation_type), intent(in) :: simulation
      !> Reason why the run cannot begin
      type(error_type), allocatable, intent(out) :: error
   end subroutine begin

   !> Look for requests from outside of the run, on any rank, before the ranks meet in a step
   subroutine look_for_requests(self, time, found)
      class(observer_type), intent(inout) :: self
      !> Time at the end of the step
      real(wp), intent(in) :: time
      !> Set where there is one
      logical, intent(inout) :: found
   end subroutine look_for_requests

   !> A step is made at which it is due, or in which an observer has made a request. One that is due
   !> sets when it is due next
   subroutine notify(self, simulation, requests, error)
      class(observer_type), intent(inout) :: self
      !> The simulation at the end of the step. Of it the state may change: run control moves the
      !> end, the monitors of volume and relaxation keep what they measured; and the least volume
      class(simulation_type), intent(inout) :: simulation
      !> Requests to and from other observers
      type(requests_type), intent(inout) :: requests
      !> Reason why the run must end
      type(error_type), allocatable, intent(out) :: error
   end subroutine notify

   !> Flush the files to the disk, and add how far they have been written
   subroutine mark(self, positions, error)
      class(observer_type), intent(inout) :: self
      !> Positions in all files; complete on the root alone
      type(file_positions_type), intent(inout) :: positions
      !> Why something is not on the disk
      type(error_type), allocatable, intent(out) :: error
   end subroutine mark

   !> All files are on the disk after a request for it, or for a restart file
   subroutine save(self, simulation, positions, requests, error)
      class(observer_type), intent(inout) :: self
      !> The simulation, whose state has the memory of the contacts for a restart file. Writing
      !> and reading are one procedure: `inout`, though none changes it
      class(simulation_type), intent(inout) :: simulation
      !> Positions in all files; complete on the root alone
      type(file_positions_type), intent(inout) :: positions
      !> As in `notify`
      type(requests_type), intent(in) :: requests
      !> Reason why the run must end
      type(error_type), allocatable, intent(out) :: error
   end subroutine save

   !> The run is over: write the last results and close the files
   subroutine close_observer(self, simulation, outcome, error)
      class(observer_type), intent(inout) :: self
      !> The simulation at its end
      class(simulation_type), intent(in) :: simulation
      !> Reason for the end; not allocated for a normal end
      type(error_type), allocatable, intent(in) :: outcome
      !> Why something could not be written
      type(error_type), allocatable, intent(out) :: error
   end subroutine close_observer

   !> An empty list
   subroutine start(self, path)
      class(observers_type), intent(out) :: self
      !> Path of the results without endings
      character(*), intent(in) :: path

      allocate (self%items(0))
      self%path = path
   end subroutine start

   !> Add an observer behind the others
   subroutine add(self, observer)
      class(observers_type), intent(inout) :: self
      !> The observer, which the list takes over
      class(observer_type), allocatable, intent(inout) :: observer

      type(item_type), allocatable :: items(:)
      integer :: i

      allocate (items(size(self%items) + 1))
      do i = 1, size(self%items)
         call move_alloc(self%items(i)%observer, items(i)%observer)
      end do
      call move_alloc(observer, items(size(items))%observer)
      call move_alloc(items, self%items)
   end subroutine add

   !> Let all observe the state that a run begins with
   subroutine begin_all(self, simulation, error)
      class(observers_type), intent(inout) :: self
      !> As in `observer_type`
      class(simulation_type), intent(in) :: simulation
      type(error_type), allocatable, intent(out) :: error

      integer :: i

      do i = 1, size(self%items)
         call self%items(i)%observer%begin(simulation, error)
         if (allocated(error)) return
      end do
   end subroutine begin_all

   !> Whether some observer will read the motion at the end of the step under way
   pure logical function read_motion(self, state)
      class(observers_type), intent(in) :: self
      !> Has the step
      type(state_type), intent(in) :: state

      integer :: i
      logical :: is_last

      is_last = state%ends_after()
      read_motion = .true.
      do i = 1, size(self%items)
         associate (observer => self%items(i)%observer)
            if (.not. observer%reads_motion) cycle
            if (observer%next%has_come(state%time + state%step, state%cycle + 1, is_last)) return
         end associate
      end do
      read_motion = .false.
   end function read_motion

   !> Let all look for requests from outside of the run
   subroutine look_for_all_requests(self, state, requests)
      class(observers_type), intent(inout) :: self
      !> Has the step under way
      type(state_type), intent(in) :: state
      !> Grows by one where this rank has found any
      integer, intent(inout) :: requests

      logical :: found
      integer :: i

      found = .false.
      do i = 1, size(self%items)
         call self%items(i)%observer%look_for_requests(state%time + state%step, found)
      end do
      if (found) requests = requests + 1
   end subroutine look_for_all_requests

   !> Notify those that are due of a step, all of them of a request, then flush all files to the
   !> disk where this is requested
   subroutine notify_all(self, simulation, attention, error)
      class(observers_type), intent(inout) :: self
      !> As in `observer_type`
      class(simulation_type), intent(inout) :: simulation
      !> Whether any rank has found a request
      logical, intent(in) :: attention
      !> The first reason why the run must end
      type(error_type), allocatable, intent(out) :: error

      integer :: i
      type(requests_type) :: requests

      requests%attention = attention
      do i = 1, size(self%items)
         associate (observer => self%items(i)%observer)
            if (.not. (requests%are_made() .or. observer%is_due(simulation%state))) cycle
            call observer%notify(simulation, requests, error)
         end associate
         if (allocated(error)) return
      end do
      if (requests%checkpoint) call simulation%contacts%save(simulation%state)
      if (requests%flush .or. requests%checkpoint) then
         call save_all(self, simulation, requests, error)
      end if
   end subroutine notify_all

   !> Flush all files to the disk, then set how far they have been written
   subroutine save_all(self, simulation, requests, error)
      class(observers_type), intent(inout) :: self
      class(simulation_type), intent(inout) :: simulation
      type(requests_type), intent(in) :: requests
      type(error_type), allocatable, intent(out) :: error

      type(file_positions_type) :: positions
      integer :: i

      positions = new_file_positions(self%path)
      do i = 1, size(self%items)
         call self%items(i)%observer%mark(positions, error)
         if (allocated(error)) return
      end do
      do i = 1, size(self%items)
         call self%items(i)%observer%save(simulation, positions, requests, error)
         if (allocated(error)) return
      end do
   end subroutine save_all

   !> Close all, the last one first, also after an error
   subroutine close_all(self, simulation, error)
      class(observers_type), intent(inout) :: self
      !> The simulation at its end
      class(simulation_type), intent(in) :: simulation
      !> Reason for the end of the run; becomes the first failure to close, if there was none
      type(error_type), allocatable, intent(inout) :: error

      type(error_type), allocatable :: failure
      integer :: i

      do i = size(self%items), 1, -1
         call self%items(i)%observer%close(simulation, error, failure)
         if (.not. allocated(error)) call move_alloc(failure, error)
      end do
   end subroutine close_all

end module plydyn_method_observer
