!> The history of force and motion of an impactor, JOB.impactor_ID.csv.
module plydyn_io_csv_impactor_history
   use plydyn_base_error, only : error_type
   use plydyn_base_precision, only : wp
   use plydyn_base_text, only : text
   use plydyn_domain_domain, only : domain_type
   use plydyn_io_csv_history_recorder, only : history_recorder_type
   use plydyn_io_job, only : job_type
   use plydyn_method_contact_step, only : contacts_type
   use plydyn_model_model, only : model_type
   use plydyn_state_state, only : state_type
   implicit none
   private

   public :: new_impactor_history

   !> Columns
   character(20), parameter :: names(*) = [character(20) :: "time", "force", "displacement", &
      & "velocity", "kinetic", "absorbed", "force x", "force y", "contacts", "penetration"]

   !> The history
   type, public, extends(history_recorder_type) :: impactor_history_type
      private
      !> Index of the impactor
      integer :: impactor = 0
   contains
      procedure :: open => open_impactor
      procedure :: record => record_impactor
   end type impactor_history_type

contains

   !> The history of an impactor
   pure type(impactor_history_type) function new_impactor_history(impactor) result(self)
      !> Index of the impactor
      integer, intent(in) :: impactor

      self%impactor = impactor
      self%reads_motion = .false.
   end function new_impactor_history

   !> Create the file, or go on with it
   subroutine open_impactor(self, job, model, domain, error)
      class(impactor_history_type), intent(inout) :: self
      !> As in `output_type`
      type(job_type), intent(in) :: job
      type(model_type), intent(in) :: model
      type(domain_type), intent(in) :: domain
      type(error_type), allocatable, intent(out) :: error

      character(20) :: columns(size(names), 2)

      associate (u => model%control%units)
         columns(:, 1) = names
         columns(:, 2) = [character(20) :: u%time, u%force, u%length, &
            & trim(u%length)//"/"//u%time, u%energy, u%energy, u%force, u%force, "-", u%length]
      end associate
      call self%open_file(job, domain%comm, job%path//".impactor_" &
         & //text(model%impactors(self%impactor)%id)//".csv", columns, &
         & model%request%impactor_interval, error)
   end subroutine open_impactor

   !> Add a line, from numbers that all ranks have alike
   subroutine record_impactor(self, domain, contacts, state, error)
      class(impactor_history_type), intent(inout) :: self
      !> As in `history_recorder_type`
      type(domain_type), intent(in) :: domain
      type(contacts_type), intent(in) :: contacts
      type(state_type), intent(in) :: state
      type(error_type), allocatable, intent(out) :: error

      real(wp) :: kinetic, start

      associate (own => state%impactors(self%impactor), &
         & impactor => domain%contact%impactors(self%impactor))
         kinetic = 0.5_wp*impactor%mass*sum(own%velocity**2)
         start = 0.5_wp*impactor%mass*sum(impactor%velocity**2)
         call self%write_line([state%time, own%force(3), own%displacement(3), own%velocity(3), &
            & kinetic, start - kinetic, own%force(1:2), real(own%contacts, wp), own%penetration], &
            & error)
      end associate
   end subroutine record_impactor

end module plydyn_io_csv_impactor_history
