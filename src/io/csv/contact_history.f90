!> The history of the patches in contact, JOB.contact.csv: area, rows, pressure, centre of pressure.
module plydyn_io_csv_contact_history
   use plydyn_base_error, only : error_type
   use plydyn_base_precision, only : wp
   use plydyn_base_text, only : text
   use plydyn_contact_patch, only : contact_patch_type
   use plydyn_domain_domain, only : domain_type
   use plydyn_io_csv_history_recorder, only : history_recorder_type
   use plydyn_io_job, only : job_type
   use plydyn_method_contact_step, only : contacts_type
   use plydyn_model_model, only : model_type
   use plydyn_state_state, only : state_type
   implicit none
   private

   !> Columns of an impactor behind its number
   character(8), parameter :: names(*) = [character(8) :: "area", "rows", "pressure", "x", "y", "z"]
   !> Most characters of a header, and of a unit
   integer, parameter :: header_length = 40

   !> The history of all impactors
   type, public, extends(history_recorder_type) :: contact_history_type
   contains
      procedure :: open => open_contact
      procedure :: begin => begin_contact
      procedure :: record => record_contact
   end type contact_history_type

contains

   !> Create the file, if there is an impactor
   subroutine open_contact(self, job, model, domain, error)
      class(contact_history_type), intent(inout) :: self
      !> As in `output_type`
      type(job_type), intent(in) :: job
      type(model_type), intent(in) :: model
      type(domain_type), intent(in) :: domain
      type(error_type), allocatable, intent(out) :: error

      character(header_length) :: columns(1 + size(names)*size(model%impactors), 2)
      integer :: c, first, i

      if (size(model%impactors) == 0) return
      self%reads_motion = .false.
      associate (u => model%control%units)
         columns(1, :) = [character(header_length) :: "time", u%time]
         do i = 1, size(model%impactors)
            first = 2 + size(names)*(i - 1)
            do c = 1, size(names)
               columns(first + c - 1, 1) = "impactor "//text(model%impactors(i)%id)//" "//names(c)
            end do
            columns(first:first + size(names) - 1, 2) = [character(header_length) :: &
               & trim(u%length)//"2", "-", u%stress, u%length, u%length, u%length]
         end do
      end associate
      call self%open_file(job, domain%comm, job%path//".contact.csv", columns, &
         & model%request%impactor_interval, error)
   end subroutine open_contact

   !> Before the first step nothing is in contact. Patches are not part of the state: results of a
   !> restart under another name begin with its first step
   subroutine begin_contact(self, domain, contacts, state, error)
      class(contact_history_type), intent(inout) :: self
      !> As in `observer_type`
      type(domain_type), intent(in) :: domain
      type(contacts_type), intent(in) :: contacts
      type(state_type), intent(inout) :: state
      type(error_type), allocatable, intent(out) :: error

      if (state%cycle == 0) call self%record_due(domain, contacts, state, error)
   end subroutine begin_contact

   !> Add a line, from numbers that all ranks have alike
   subroutine record_contact(self, domain, contacts, state, error)
      class(contact_history_type), intent(inout) :: self
      !> As in `history_recorder_type`
      type(domain_type), intent(in) :: domain
      type(contacts_type), intent(in) :: contacts
      type(state_type), intent(in) :: state
      type(error_type), allocatable, intent(out) :: error

      real(wp) :: row(size(names), size(state%impactors))
      integer :: i
      type(contact_patch_type) :: patch

      do i = 1, size(state%impactors)
         patch = contacts%patch(domain, i, state%step_before)
         row(:, i) = [patch%area, real(patch%rows, wp), patch%largest_pressure, patch%centre]
      end do
      call self%write_line([state%time, reshape(row, [size(row)])], error)
   end subroutine record_contact

end module plydyn_io_csv_contact_history
