!> Monitors the ratio of volumes, det F: the step follows the stiffness of compressed layers. Warns
!> of the first element that is pressed nearly flat, and stops a run in which one is inverted.
module plydyn_run_volume_monitor
   use plydyn_base_error, only : error_type, exit_run, fail
   use plydyn_base_precision, only : wp
   use plydyn_base_text, only : text
   use plydyn_domain_domain, only : domain_type
   use plydyn_element_least_volume, only : least_volume_type
   use plydyn_io_job, only : job_type
   use plydyn_io_schedule, only : schedule_type
   use plydyn_method_observer, only : next_look_type, next_multiple, observer_type, &
      & requests_type
   use plydyn_method_simulation, only : simulation_type
   use plydyn_model_mesh, only : mesh_type
   use plydyn_model_model, only : model_type
   use plydyn_run_worst_point, only : moment
   use plydyn_state_state, only : state_type
   implicit none
   private

   public :: new_volume_monitor

   !> Steps between two looks that the step follows
   integer, parameter :: steps_per_look = 200
   !> Ratio below which there is a warning
   real(wp), parameter :: warning_ratio = 0.3_wp

   !> Looks at all elements every so many steps, and with each output of energies or fields
   type, public, extends(observer_type) :: volume_monitor_type
      private
      !> Where a warning goes
      type(job_type) :: job
      !> The user's numbers
      type(mesh_type) :: mesh
      !> Instants of these outputs, as far as they have an interval
      type(schedule_type), allocatable :: outputs(:)
      !> Whether there was a warning, and one of a corner that is inside out
      logical :: has_warned = .false., has_warned_of_corner = .false.
   contains
      procedure :: notify
   end type volume_monitor_type

contains

   !> A monitor
   function new_volume_monitor(job, model, cycle) result(self)
      type(job_type), intent(in) :: job
      !> Has the mesh and the intervals of outputs
      type(model_type), intent(in) :: model
      !> Step that the run begins with
      integer, intent(in) :: cycle
      type(volume_monitor_type) :: self

      real(wp) :: interval(2)
      integer :: i

      self%job = job
      self%mesh = model%mesh
      interval(:) = [model%request%energy_interval, model%request%field_interval]
      self%outputs = [(schedule_type(interval(i)), i=1, size(interval))]
      self%outputs = pack(self%outputs, interval > 0.0_wp)
      self%next = next_look_of(self, cycle)
   end function new_volume_monitor

   !> The next look after a step: after some steps, and with outputs
   pure type(next_look_type) function next_look_of(self, cycle) result(next)
      type(volume_monitor_type), intent(in) :: self
      integer, intent(in) :: cycle

      next = next_look_type(minval(self%outputs%next_time()), next_multiple(cycle, steps_per_look))
   end function next_look_of

   !> Look at a step
   subroutine notify(self, simulation, requests, error)
      class(volume_monitor_type), intent(inout) :: self
      class(simulation_type), intent(inout) :: simulation
      type(requests_type), intent(inout) :: requests
      type(error_type), allocatable, intent(out) :: error

      type(least_volume_type) :: least

      if (.not. self%is_due(simulation%state)) return
      associate (domain => simulation%domain, state => simulation%state)
         least = find_least_volume(domain, state%displacement)
         call self%outputs%advance(state%time)
         self%next = next_look_of(self, state%cycle)
         simulation%least_volume = least%ratio
         ! outputs do not change the step
         if (state%is_finished() .or. mod(state%cycle, steps_per_look) == 0) then
            state%least_volume = least%ratio
         end if
         if (least%ratio < domain%control%volume_limit) then
            call fail(error, exit_run, place_of(self, domain, state, least)//", below the limit " &
               & //"of "//text(domain%control%volume_limit)//" (VOLLIM of *CONTROL_LAYERWISE)")
         else if (least%ratio < warning_ratio .and. .not. self%has_warned) then
            self%has_warned = .true.
            if (domain%comm%is_root()) call self%job%note("warning: " &
               & //place_of(self, domain, state, least)//"; no law of plies is known to hold there")
         end if
         if (.not. (allocated(error) .or. self%has_warned_of_corner)) then
            call look_at_corners(self, domain, state)
         end if
      end associate
   end subroutine notify

   !> Warn of the first element that is inside out at a corner
   subroutine look_at_corners(self, domain, state)
      class(volume_monitor_type), intent(inout) :: self
      type(domain_type), intent(in) :: domain
      type(state_type), intent(in) :: state

      type(least_volume_type) :: least

      least = find_least_volume(domain, state%displacement, self%mesh)
      if (least%ratio > 0.0_wp) return
      self%has_warned_of_corner = .true.
      if (domain%comm%is_root()) call self%job%note("warning: a corner of " &
         & //element_of(self, domain, least)//" is turned inside out"//moment(state) &
         & //"; its stresses mean nothing there")
   end subroutine look_at_corners

   !> The least ratio of volumes, det F, of all ranks; the same on all of them, which come together
   function find_least_volume(domain, displacement, mesh) result(least)
      type(domain_type), intent(in) :: domain
      !> Displacement of all points
      real(wp), intent(in), contiguous :: displacement(:)
      !> The mesh, to look at the corners of elements in place of their Gauss points
      type(mesh_type), intent(in), optional :: mesh
      type(least_volume_type) :: least

      type(least_volume_type) :: own
      real(wp) :: greatest
      integer :: g, place(2)

      do g = 1, size(domain%groups)
         own = least_volume_type()
         call domain%groups(g)%item%find_volume(displacement, own, mesh)
         own%group = g
         if (is_less(own, least)) least = own
      end do
      greatest = -least%ratio
      place(:) = [least%layer, least%group]
      call domain%comm%keep_largest(greatest, least%element, place)
      least%ratio = -greatest
      least%layer = place(1)
      least%group = place(2)
   end function find_least_volume

   !> Whether one comes before another
   pure logical function is_less(a, b)
      type(least_volume_type), intent(in) :: a, b

      is_less = a%ratio < b%ratio .or. (a%ratio <= b%ratio .and. a%element < b%element)
   end function is_less

   !> Which element is pressed to which ratio, and when
   function place_of(self, domain, state, least) result(words)
      class(volume_monitor_type), intent(in) :: self
      type(domain_type), intent(in) :: domain
      type(state_type), intent(in) :: state
      type(least_volume_type), intent(in) :: least
      character(:), allocatable :: words

      words = element_of(self, domain, least)//" is pressed to "//text(least%ratio, 5) &
         & //" of its volume"//moment(state)
   end function place_of

   !> Kind and the user's number of the element, and of the ply
   function element_of(self, domain, least) result(words)
      class(volume_monitor_type), intent(in) :: self
      type(domain_type), intent(in) :: domain
      type(least_volume_type), intent(in) :: least
      character(:), allocatable :: words

      associate (group => domain%groups(least%group)%item)
         words = group%element_kind//" "//text(self%mesh%element_id(group%element_kind, &
            & least%element))
         if (least%layer > 0) words = words//", "//group%layer_kind//" "//text(least%layer)
      end associate
   end function element_of

end module plydyn_run_volume_monitor
