!> Monitors the ratio of volumes, det F. Warns of the first element that is pressed nearly flat, and
!> stops a run in which one is inverted.
module plydyn_run_volume_monitor
   use plydyn_base_error, only : error_type, exit_run, fail
   use plydyn_base_precision, only : wp
   use plydyn_base_text, only : text
   use plydyn_element_least_volume, only : least_volume_type
   use plydyn_io_job, only : job_type
   use plydyn_method_clock, only : every_interval, every_steps
   use plydyn_method_observer, only : observer_type, requests_type
   use plydyn_method_simulation, only : simulation_type
   use plydyn_method_step_control, only : find_least_volume
   use plydyn_model_control, only : request_type
   use plydyn_run_worst_point, only : moment
   implicit none
   private

   public :: new_volume_monitor

   !> Most steps between two looks
   integer, parameter :: steps_per_look = 200
   !> Ratio below which there is a warning
   real(wp), parameter :: warning_ratio = 0.3_wp

   !> Looks at all elements every so many steps, and with each output of energies or fields
   type, public, extends(observer_type) :: volume_monitor_type
      private
      !> Where a warning goes
      type(job_type) :: job
      !> Whether there was a warning, and one of a corner that is inside out
      logical :: has_warned = .false., has_warned_of_corner = .false.
   contains
      procedure :: notify
   end type volume_monitor_type

contains

   !> A monitor
   function new_volume_monitor(job, request) result(self)
      type(job_type), intent(in) :: job
      !> Intervals of outputs
      type(request_type), intent(in) :: request
      type(volume_monitor_type) :: self

      real(wp) :: interval(2)

      self%job = job
      interval(:) = [request%energy_interval, request%field_interval]
      self%clocks = [every_steps(steps_per_look), &
         & every_interval(pack(interval, interval > 0.0_wp))]
   end function new_volume_monitor

   !> Look at a step
   subroutine notify(self, simulation, requests, error)
      class(volume_monitor_type), intent(inout) :: self
      class(simulation_type), intent(in) :: simulation
      type(requests_type), intent(inout) :: requests
      type(error_type), allocatable, intent(out) :: error

      type(least_volume_type) :: least

      if (.not. self%is_due(simulation%state)) return
      associate (domain => simulation%domain, state => simulation%state)
         least = find_least_volume(domain, state%displacement)
         requests%least_volume = least%ratio
         if (least%ratio < domain%control%volume_limit) then
            call fail(error, exit_run, place_of(simulation, least)//", below the limit of " &
               & //text(domain%control%volume_limit)//" (VOLLIM of *CONTROL_LAYERWISE)")
         else if (least%ratio < warning_ratio .and. .not. self%has_warned) then
            self%has_warned = .true.
            call self%job%note("warning: " &
               & //place_of(simulation, least)//"; no law of plies is known to hold there")
         end if
         if (.not. (allocated(error) .or. self%has_warned_of_corner)) then
            call look_at_corners(self, simulation)
         end if
      end associate
   end subroutine notify

   !> Warn of the first element that is inside out at a corner
   subroutine look_at_corners(self, simulation)
      class(volume_monitor_type), intent(inout) :: self
      class(simulation_type), intent(in) :: simulation

      type(least_volume_type) :: least

      least = find_least_volume(simulation%domain, simulation%state%displacement, &
         & simulation%model%mesh)
      if (least%ratio > 0.0_wp) return
      self%has_warned_of_corner = .true.
      call self%job%note("warning: a corner of "//element_of(simulation, least) &
         & //" is turned inside out"//moment(simulation%state)//"; its stresses mean nothing there")
   end subroutine look_at_corners

   !> Which element is pressed to which ratio, and when
   function place_of(simulation, least) result(words)
      class(simulation_type), intent(in) :: simulation
      type(least_volume_type), intent(in) :: least
      character(:), allocatable :: words

      words = element_of(simulation, least)//" is pressed to "//text(least%ratio, 5) &
         & //" of its volume"//moment(simulation%state)
   end function place_of

   !> Kind and the user's number of the element, and of the ply
   function element_of(simulation, least) result(words)
      class(simulation_type), intent(in) :: simulation
      type(least_volume_type), intent(in) :: least
      character(:), allocatable :: words

      associate (group => simulation%domain%groups(least%group)%item)
         words = group%element_kind//" "//text(simulation%model%mesh%element_id( &
            & group%element_kind, least%element))
         if (least%layer > 0) words = words//", "//group%layer_kind//" "//text(least%layer)
      end associate
   end function element_of

end module plydyn_run_volume_monitor
