!> Observers of a run: histories, fields, listing, progress line, checkpoints, run control.
!>
!> The method uses this abstract type alone. The observers of a run are made in one place,
!> `plydyn_run_observers`. Each of them has its clocks; the list notifies it at the end of the steps
!> at which one of them is due, and of each step in which there is a request, in the order of the
!> list. Observers only look: what steers a run is in `plydyn_method_step_control`.
module plydyn_method_observer
   use plydyn_base_error, only : error_type
   use plydyn_base_precision, only : wp
   use plydyn_method_clock, only : clock_type
   use plydyn_method_element_balance, only : element_balance_type
   use plydyn_method_simulation, only : simulation_type
   use plydyn_state_file_positions, only : file_positions_type, new_file_positions
   use plydyn_state_state, only : state_type
   implicit none
   private

   !> Requests of the user, and of one observer to the others, in a step
   type, public :: requests_type
      !> Time at which the run is to end; negative for no change
      real(wp) :: end_time = -1.0_wp
      !> Fields, progress line, restart file, due or not; all files flushed to the disk
      logical :: fields = .false., progress = .false., checkpoint = .false., flush = .false.
      !> Energies of the elements that a history has taken in this step; not allocated without one
      type(element_balance_type), allocatable :: balance
      !> Least ratio of volumes of all elements, where an observer has looked at it in this step
      real(wp) :: least_volume = 1.0_wp
      !> Source of a request to stop with a restart file; not allocated without one
      character(:), allocatable :: stopped_by
   contains
      procedure :: are_made
   end type requests_type

   !> Something that observes a run, and does nothing of its own accord: an extension overrides
   !> what it needs. All ranks call all procedures together, and get the same error
   type, abstract, public :: observer_type
      !> When it is due, and at the end of the last step; never where there are none. The list
      !> advances them; the same on all ranks
      type(clock_type), allocatable :: clocks(:)
      !> Whether it reads displacements or velocities of points: then the method completes the
      !> motion at the end of each step at which the observer is due
      logical :: reads_motion = .true.
   contains
      procedure, non_overridable :: is_due, is_due_at
      procedure :: begin
      procedure :: look_for_requests
      procedure :: pass_requests
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
      !> Whether requests are to be passed at the end of the next step, when the motion is complete
      logical :: has_request = .false.
   contains
      procedure :: start
      procedure :: add
      procedure :: begin => begin_all
      procedure :: read_motion
      procedure :: look_for_requests => look_for_all_requests
      procedure :: pass_requests => pass_all_requests
      procedure :: notify => notify_all
      procedure :: close => close_all
   end type observers_type

contains

   !> Whether an observer has requested anything in this step
   pure logical function are_made(self)
      class(requests_type), intent(in) :: self

      are_made = self%fields .or. self%progress .or. self%checkpoint .or. self%flush &
         & .or. allocated(self%balance)
   end function are_made

   !> Whether it is due at the end of the step that was made; the same on all ranks
   pure logical function is_due(self, state)
      class(observer_type), intent(in) :: self
      !> The state at the end of the step
      type(state_type), intent(in) :: state

      is_due = self%is_due_at(state%time, state%cycle, state%is_finished())
   end function is_due

   !> Whether it is due at the end of a step
   pure logical function is_due_at(self, time, cycle, is_last)
      class(observer_type), intent(in) :: self
      !> Time at the end of the step, its number, and whether the run ends with it
      real(wp), intent(in) :: time
      integer, intent(in) :: cycle
      logical, intent(in) :: is_last

      is_due_at = allocated(self%clocks)
      if (is_due_at) is_due_at = any(self%clocks%has_come(time, cycle)) &
         & .or. (is_last .and. size(self%clocks) > 0)
   end function is_due_at

   !> Observe the state that a run begins with
   subroutine begin(self, simulation, error)
      class(observer_type), intent(inout) :: self
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

   !> Pass requests from outside of the run: they are the same on all ranks afterwards
   subroutine pass_requests(self, simulation, requests)
      class(observer_type), intent(inout) :: self
      !> The simulation at the end of a step
      class(simulation_type), intent(in) :: simulation
      !> Gets the requests
      type(requests_type), intent(inout) :: requests
   end subroutine pass_requests

   !> A step is made at which it is due, or in which there is a request
   subroutine notify(self, simulation, requests, error)
      class(observer_type), intent(inout) :: self
      !> The simulation at the end of the step
      class(simulation_type), intent(in) :: simulation
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
   subroutine save(self, state, positions, requests, error)
      class(observer_type), intent(inout) :: self
      !> The state with the memory of the contacts, for a restart file. Writing and reading are one
      !> procedure: `inout`, though none changes it
      type(state_type), intent(inout) :: state
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
         call advance_clocks(self%items(i)%observer, simulation%state)
      end do
   end subroutine begin_all

   !> Advance the clocks of an observer that was due
   pure subroutine advance_clocks(observer, state)
      class(observer_type), intent(inout) :: observer
      type(state_type), intent(in) :: state

      if (observer%is_due(state)) call observer%clocks%advance(state%time)
   end subroutine advance_clocks

   !> Whether some observer will read the motion at the end of the step under way
   pure logical function read_motion(self, state)
      class(observers_type), intent(in) :: self
      !> Has the step
      type(state_type), intent(in) :: state

      integer :: i
      logical :: is_last

      is_last = state%ends_after()
      read_motion = .true.
      if (self%has_request) return
      do i = 1, size(self%items)
         associate (observer => self%items(i)%observer)
            if (.not. observer%reads_motion) cycle
            if (observer%is_due_at(state%time + state%step, state%cycle + 1, is_last)) return
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

   !> Let requests that were found be passed when the motion is complete: at the end of the next
   !> step, or of the run
   subroutine pass_all_requests(self, simulation, is_asked, requests)
      class(observers_type), intent(inout) :: self
      !> As in `observer_type`
      class(simulation_type), intent(in) :: simulation
      !> Whether any rank has found one in this step
      logical, intent(in) :: is_asked
      !> Requests to all observers
      type(requests_type), intent(out) :: requests

      integer :: i

      if (.not. (is_asked .or. self%has_request)) return
      self%has_request = .not. (self%has_request .or. simulation%state%is_finished())
      if (self%has_request) return
      do i = 1, size(self%items)
         call self%items(i)%observer%pass_requests(simulation, requests)
      end do
   end subroutine pass_all_requests

   !> Notify those that are due of a step, all of them of a request, then flush all files to the
   !> disk where this is requested
   subroutine notify_all(self, simulation, requests, error)
      class(observers_type), intent(inout) :: self
      !> Its state gets the memory of the contacts for a restart file
      class(simulation_type), intent(inout) :: simulation
      !> Requests from outside
      type(requests_type), intent(inout) :: requests
      !> The first reason why the run must end
      type(error_type), allocatable, intent(out) :: error

      integer :: i

      do i = 1, size(self%items)
         associate (observer => self%items(i)%observer)
            if (.not. (requests%are_made() .or. observer%is_due(simulation%state))) cycle
            call observer%notify(simulation, requests, error)
            if (allocated(error)) return
            call advance_clocks(observer, simulation%state)
         end associate
      end do
      if (requests%checkpoint) call simulation%contacts%save(simulation%state)
      if (requests%flush .or. requests%checkpoint) then
         call save_all(self, simulation%state, requests, error)
      end if
   end subroutine notify_all

   !> Flush all files to the disk, then set how far they have been written
   subroutine save_all(self, state, requests, error)
      class(observers_type), intent(inout) :: self
      type(state_type), intent(inout) :: state
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
         call self%items(i)%observer%save(state, positions, requests, error)
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
