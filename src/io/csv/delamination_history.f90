!> The history of delamination, JOB.delamination.csv: area and energy of every interface that can
!> fail.
module plydyn_io_csv_delamination_history
   use plydyn_base_error, only : error_type
   use plydyn_base_precision, only : wp
   use plydyn_base_text, only : text
   use plydyn_domain_delamination, only : delamination, delamination_type, failing_interfaces, &
      & projected_area
   use plydyn_domain_domain, only : domain_type
   use plydyn_io_csv_history_recorder, only : history_recorder_type
   use plydyn_io_job, only : job_type
   use plydyn_method_contact_step, only : contacts_type
   use plydyn_model_model, only : model_type
   use plydyn_state_state, only : state_type
   implicit none
   private

   !> The history
   type, public, extends(history_recorder_type) :: delamination_history_type
      private
      !> Interfaces that can fail, counted from the bottom
      integer, allocatable :: interfaces(:)
   contains
      procedure :: open => open_delamination
      procedure :: record => record_delamination
   end type delamination_history_type

contains

   !> Create the file, if something can fail
   subroutine open_delamination(self, job, model, domain, error)
      class(delamination_history_type), intent(inout) :: self
      !> As in `output_type`
      type(job_type), intent(in) :: job
      type(model_type), intent(in) :: model
      type(domain_type), intent(in) :: domain
      type(error_type), allocatable, intent(out) :: error

      character(40), allocatable :: columns(:, :)
      integer :: i, n

      self%interfaces = failing_interfaces(domain)
      n = size(self%interfaces)
      if (n == 0) return
      self%reads_motion = .false.
      associate (units => model%control%units)
         allocate (columns(2*n + 3, 2))
         columns(1, :) = [character(40) :: "time", units%time]
         do i = 1, n
            columns(1 + i, 1) = "interface "//text(self%interfaces(i))//" area"
            columns(3 + n + i, 1) = "interface "//text(self%interfaces(i))//" energy"
         end do
         columns(n + 2:n + 3, 1) = [character(40) :: "sum", "projected area"]
         columns(2:n + 3, 2) = trim(units%length)//"2"
         columns(n + 4:, 2) = units%energy
      end associate
      call self%open_file(job, domain%comm, job%path//".delamination.csv", columns, &
         & model%request%delamination_interval, error)
   end subroutine open_delamination

   !> Add a line
   subroutine record_delamination(self, domain, contacts, state, error)
      class(delamination_history_type), intent(inout) :: self
      !> As in `history_recorder_type`
      type(domain_type), intent(in) :: domain
      type(contacts_type), intent(in) :: contacts
      type(state_type), intent(in) :: state
      type(error_type), allocatable, intent(out) :: error

      type(delamination_type), allocatable :: all_lost(:)

      all_lost = delamination(domain, state%history)
      associate (lost => all_lost(self%interfaces))
         call self%write_line([state%time, lost%failed, sum(lost%failed), &
            & projected_area(domain, state%history), lost%fracture + lost%closing &
            & + lost%friction], error)
      end associate
   end subroutine record_delamination

end module plydyn_io_csv_delamination_history
