!> Monitors whether a run is quasi-static: the kinetic energy as a share of the internal one. Warns
!> of the first step beyond the limit of the deck, and tells the largest share at the end.
module plydyn_run_quasi_static_monitor
   use plydyn_base_error, only : error_type
   use plydyn_base_precision, only : wp
   use plydyn_base_text, only : text
   use plydyn_io_job, only : job_type
   use plydyn_method_observer, only : observer_type, requests_type
   use plydyn_method_simulation, only : simulation_type
   implicit none
   private

   public :: new_quasi_static_monitor

   !> Share of the time of a run that passes before it looks: nothing is stored when motion begins
   real(wp), parameter :: start_share = 0.1_wp

   !> Looks at the energies of every step
   type, public, extends(observer_type) :: quasi_static_monitor_type
      private
      !> Where a warning goes
      type(job_type) :: job
      !> Unit of time
      character(:), allocatable :: unit
      !> Time from which it looks
      real(wp) :: first_time = 0.0_wp
      !> Largest share so far, and its time
      real(wp) :: largest = 0.0_wp, time = 0.0_wp
      !> Whether there was a warning
      logical :: has_warned = .false.
   contains
      procedure :: begin => begin_monitor
      procedure :: notify
   end type quasi_static_monitor_type

contains

   !> A monitor
   function new_quasi_static_monitor(job, unit) result(self)
      type(job_type), intent(in) :: job
      !> Name of the unit of time
      character(*), intent(in) :: unit
      type(quasi_static_monitor_type) :: self

      self%job = job
      self%unit = unit
      self%reads_motion = .false.
   end function new_quasi_static_monitor

   !> Find the time from which it looks
   subroutine begin_monitor(self, simulation, error)
      class(quasi_static_monitor_type), intent(inout) :: self
      class(simulation_type), intent(in) :: simulation
      type(error_type), allocatable, intent(out) :: error

      associate (state => simulation%state)
         self%first_time = state%time + start_share*(state%end%time - state%time)
      end associate
   end subroutine begin_monitor

   !> Look at a step
   subroutine notify(self, simulation, requests, error)
      class(quasi_static_monitor_type), intent(inout) :: self
      class(simulation_type), intent(inout) :: simulation
      type(requests_type), intent(inout) :: requests
      type(error_type), allocatable, intent(out) :: error

      real(wp) :: share

      associate (limit => simulation%domain%control%kinetic_limit, state => simulation%state, &
         & is_root => simulation%domain%comm%is_root())
         if (limit <= 0.0_wp .or. state%time < self%first_time) return
         share = state%energies%kinetic_share()
         if (share > self%largest) then
            self%largest = share
            self%time = state%time
         end if
         if (share > limit .and. .not. self%has_warned) then
            self%has_warned = .true.
            if (is_root) call self%job%note("warning: the kinetic energy is " &
               & //text(share, 2)//" of the internal one at time "//text(state%time, 3)//" " &
               & //self%unit//", more than SHARE of *CONTROL_QUASI_STATIC: load more slowly")
         end if
         if (state%is_finished() .and. is_root) call self%job%note("quasi-static: the kinetic " &
            & //"energy was at most "//text(self%largest, 2)//" of the internal one, at time " &
            & //text(self%time, 3)//" "//self%unit)
      end associate
   end subroutine notify

end module plydyn_run_quasi_static_monitor
