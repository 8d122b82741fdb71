!> Stops a run whose motion is no longer finite, before anything of it is written.
module plydyn_run_finite_monitor
   use, intrinsic :: ieee_arithmetic, only : ieee_is_finite
   use plydyn_base_error, only : error_type, exit_run, fail
   use plydyn_base_precision, only : wp
   use plydyn_base_text, only : text
   use plydyn_domain_domain, only : domain_type
   use plydyn_method_observer, only : observer_type, requests_type
   use plydyn_method_simulation, only : simulation_type
   use plydyn_model_model, only : model_type
   use plydyn_run_worst_point, only : moment, name_of, worst_point, worst_point_type
   use plydyn_state_state, only : state_type
   implicit none
   private

   public :: check_finite, new_finite_monitor

   !> Looks at the energies of every step
   type, public, extends(observer_type) :: finite_monitor_type
   contains
      procedure :: notify
   end type finite_monitor_type

contains

   !> A monitor; the motion is of interest only when the run fails
   pure type(finite_monitor_type) function new_finite_monitor() result(self)
      self%reads_motion = .false.
   end function new_finite_monitor

   !> Look at a step
   subroutine notify(self, simulation, requests, error)
      class(finite_monitor_type), intent(inout) :: self
      !> As in `observer_type`
      class(simulation_type), intent(inout) :: simulation
      type(requests_type), intent(inout) :: requests
      type(error_type), allocatable, intent(out) :: error

      call check_finite(simulation%domain, simulation%model, simulation%state, error)
   end subroutine notify

   !> Energies that are not finite, and the point that is the cause. All ranks must come here
   subroutine check_finite(domain, model, state, error)
      !> The domain
      type(domain_type), intent(in) :: domain
      !> The model
      type(model_type), intent(in) :: model
      !> The state
      type(state_type), intent(in) :: state
      !> Place and time; the same on all ranks
      type(error_type), allocatable, intent(out) :: error

      associate (e => state%energies)
         if (ieee_is_finite(e%total()) .and. ieee_is_finite(e%error())) return
      end associate
      call fail(error, exit_run, "the motion is no longer finite"//moment(state) &
         & //cause(domain, model, state)//"; the files of results end before this step")
   end subroutine check_finite

   !> The first impactor or point that is not finite, or the largest acceleration: its square may
   !> be too large for a number
   function cause(domain, model, state) result(words)
      type(domain_type), intent(in) :: domain
      type(model_type), intent(in) :: model
      type(state_type), intent(in) :: state
      character(:), allocatable :: words

      type(worst_point_type) :: worst
      integer :: i

      do i = 1, size(state%impactors)
         if (all(ieee_is_finite(state%impactors(i)%velocity))) cycle
         words = ": velocity of impactor "//text(domain%contact%impactors(i)%id)
         return
      end do
      words = ""
      ! the motion may be that of the coming step already, which follows from the accelerations
      call look_at("acceleration", state%acceleration(:domain%columns%freedoms))
      call look_at("velocity", state%velocity)
      call look_at("displacement", state%displacement)
      if (len(words) > 0) return
      worst = worst_point(domain, abs(state%acceleration(:domain%columns%freedoms)))
      words = ": the largest acceleration is along "//name_of(worst, domain, model)//", " &
         & //text(worst%badness)

   contains

      !> Name the first point of a motion that is not finite, if none was named before
      subroutine look_at(what, motion)
         character(*), intent(in) :: what
         real(wp), intent(in) :: motion(:)

         if (len(words) > 0) return
         worst = worst_point(domain, merge(0.0_wp, 1.0_wp, ieee_is_finite(motion)))
         if (worst%badness > 0.0_wp) words = ": "//what//" along "//name_of(worst, domain, model)
      end subroutine look_at

   end function cause

end module plydyn_run_finite_monitor
