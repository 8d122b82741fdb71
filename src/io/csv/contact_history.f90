!> The history of the patches in contact, JOB.contact.csv: area, rows, pressure, centre of pressure.
module plydyn_io_csv_contact_history
   use plydyn_base_error, only : error_type
   use plydyn_base_precision, only : wp
   use plydyn_base_text, only : text
   use plydyn_contact_patch, only : contact_patch_type
   use plydyn_io_csv_history_recorder, only : history_recorder_type
   use plydyn_io_job, only : job_type
   use plydyn_method_simulation, only : simulation_type
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
   subroutine open_contact(self, job, simulation, error)
      class(contact_history_type), intent(inout) :: self
      type(job_type), intent(in) :: job
      class(simulation_type), intent(in) :: simulation
      type(error_type), allocatable, intent(out) :: error

      character(header_length), allocatable :: headers(:), units(:)
      integer :: c, i

      associate (impactors => simulation%model%impactors, u => simulation%model%control%units)
         if (size(impactors) == 0) return
         self%reads_motion = .false.
         headers = [character(header_length) :: "time"]
         units = [character(header_length) :: u%time]
         do i = 1, size(impactors)
            do c = 1, size(names)
               headers = [character(header_length) :: headers, &
                  & "impactor "//text(impactors(i)%id)//" "//names(c)]
            end do
            units = [character(header_length) :: units, trim(u%length)//"2", "-", u%stress, &
               & u%length, u%length, u%length]
         end do
         call self%open_file(job, simulation, ".contact.csv", headers, units, &
            & simulation%model%request%impactor_interval, error)
      end associate
   end subroutine open_contact

   !> Before the first step nothing is in contact. Patches are not part of the state: results of a
   !> restart under another name begin with its first step
   subroutine begin_contact(self, simulation, error)
      class(contact_history_type), intent(inout) :: self
      class(simulation_type), intent(in) :: simulation
      type(error_type), allocatable, intent(out) :: error

      if (simulation%state%cycle == 0) call self%record_due(simulation, error)
   end subroutine begin_contact

   !> Add a line, from numbers that all ranks have alike
   subroutine record_contact(self, simulation, error)
      class(contact_history_type), intent(inout) :: self
      class(simulation_type), intent(in) :: simulation
      type(error_type), allocatable, intent(out) :: error

      real(wp) :: row(size(names), size(simulation%state%impactors))
      integer :: i
      type(contact_patch_type) :: patch

      do i = 1, size(row, 2)
         patch = simulation%contacts%patch(simulation%domain, i, simulation%state%step_before)
         row(:, i) = [patch%area, real(patch%rows, wp), patch%largest_pressure, patch%centre]
      end do
      call self%write_line([simulation%state%time, reshape(row, [size(row)])], error)
   end subroutine record_contact

end module plydyn_io_csv_contact_history
