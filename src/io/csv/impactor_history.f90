!> The histories of impactors. JOB.impactor_ID.csv has the force and the motion of one of them,
!> JOB.contact.csv the patches in contact of all: area, rows, pressure, centre of pressure.
module plydyn_io_csv_impactor_history
   use plydyn_base_error, only : error_type
   use plydyn_base_precision, only : wp
   use plydyn_base_text, only : text
   use plydyn_io_csv_history_recorder, only : history_recorder_type
   use plydyn_io_job, only : job_type
   use plydyn_method_simulation, only : simulation_type
   use plydyn_contact_patch, only : contact_patch_type
   implicit none
   private

   public :: new_impactor_history

   !> Columns
   character(20), parameter :: names(*) = [character(20) :: "time", "force", "displacement", &
      & "velocity", "kinetic", "absorbed", "force x", "force y", "contacts", "penetration", &
      & "displacement x", "displacement y", "velocity x", "velocity y", "angular velocity x", &
      & "angular velocity y", "angular velocity z", "impulse x", "impulse y", "impulse z", &
      & "friction"]

   !> The history of one impactor
   type, public, extends(history_recorder_type) :: impactor_history_type
      private
      !> Index of the impactor
      integer :: impactor = 0
   contains
      procedure :: open => open_impactor
      procedure :: record => record_impactor
   end type impactor_history_type

   !> Columns of an impactor behind its number
   character(8), parameter :: patch_names(*) = [character(8) :: "area", "rows", "pressure", "x", &
      & "y", "z"]
   !> Most characters of a header, and of a unit
   integer, parameter :: header_length = 40

   !> The history of the patches of all impactors
   type, public, extends(history_recorder_type) :: contact_history_type
   contains
      procedure :: open => open_contact
      procedure :: begin => begin_contact
      procedure :: record => record_contact
   end type contact_history_type

contains

   !> The history of an impactor
   pure type(impactor_history_type) function new_impactor_history(impactor) result(self)
      !> Index of the impactor
      integer, intent(in) :: impactor

      self%impactor = impactor
      self%reads_motion = .false.
   end function new_impactor_history

   !> Create the file, or append to the one of the restart
   subroutine open_impactor(self, job, simulation, error)
      class(impactor_history_type), intent(inout) :: self
      type(job_type), intent(in) :: job
      class(simulation_type), intent(in) :: simulation
      type(error_type), allocatable, intent(out) :: error

      character(20) :: units(size(names)), velocity
      integer :: c

      associate (u => simulation%model%control%units)
         velocity = trim(u%length)//"/"//u%time
         units(:) = [character(20) :: u%time, u%force, u%length, velocity, u%energy, &
            & u%energy, u%force, u%force, "-", u%length, u%length, u%length, velocity, velocity, &
            & ("1/"//u%time, c=1, 3), (trim(u%force)//" "//u%time, c=1, 3), u%energy]
      end associate
      call self%open_file(job, simulation, ".impactor_" &
         & //text(simulation%model%impactors(self%impactor)%id)//".csv", names, units, &
         & simulation%model%request%impactor_interval, error)
   end subroutine open_impactor

   !> Add a line, from numbers that all ranks have alike
   subroutine record_impactor(self, simulation, error)
      class(impactor_history_type), intent(inout) :: self
      class(simulation_type), intent(in) :: simulation
      type(error_type), allocatable, intent(out) :: error

      real(wp) :: kinetic, start

      associate (own => simulation%state%impactors(self%impactor), &
         & impactor => simulation%domain%contact%impactors(self%impactor))
         kinetic = 0.5_wp*impactor%mass*sum(own%velocity**2)
         if (impactor%rotates) kinetic = kinetic + 0.5_wp*impactor%inertia*sum(own%spin**2)
         start = 0.5_wp*impactor%mass*sum(impactor%velocity**2)
         call self%write_line([simulation%state%time, own%force(3), own%displacement(3), &
            & own%velocity(3), kinetic, start + own%work - kinetic, own%force(1:2), &
            & real(own%contacts, wp), own%penetration, own%displacement(:2), own%velocity(:2), &
            & own%spin, own%impulse, own%friction], error)
      end associate
   end subroutine record_impactor

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
            do c = 1, size(patch_names)
               headers = [character(header_length) :: headers, &
                  & "impactor "//text(impactors(i)%id)//" "//patch_names(c)]
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

      real(wp) :: row(size(patch_names), size(simulation%state%impactors))
      integer :: i
      type(contact_patch_type) :: patch

      do i = 1, size(row, 2)
         patch = simulation%contacts%patch(simulation%domain, i, simulation%state%step_before)
         row(:, i) = [patch%area, real(patch%rows, wp), patch%largest_pressure, patch%centre]
      end do
      call self%write_line([simulation%state%time, reshape(row, [size(row)])], error)
   end subroutine record_contact

end module plydyn_io_csv_impactor_history
