!> The histories of impactors. JOB.impactor_ID.csv has the force and the motion of one of them,
!> JOB.contact.csv the patches in contact of all: area, rows, pressure, centre of pressure.
module plydyn_io_csv_impactor_history
   use plydyn_base_error, only : error_type
   use plydyn_base_precision, only : wp
   use plydyn_base_text, only : text
   use plydyn_io_csv_history_file, only : row_type
   use plydyn_io_csv_history_recorder, only : history_recorder_type
   use plydyn_method_simulation, only : simulation_type
   use plydyn_contact_patch, only : contact_patch_type
   implicit none
   private

   public :: new_impactor_history

   !> The history of one impactor
   type, public, extends(history_recorder_type) :: impactor_history_type
      private
      !> Index of the impactor
      integer :: impactor = 0
   contains
      procedure :: prepare => prepare_impactor
      procedure :: put_columns => put_impactor
   end type impactor_history_type

   !> The history of the patches of all impactors
   type, public, extends(history_recorder_type) :: contact_history_type
   contains
      procedure :: prepare => prepare_contact
      procedure :: put_columns => put_patches
      procedure :: begin => begin_contact
   end type contact_history_type

contains

   !> The history of an impactor
   pure type(impactor_history_type) function new_impactor_history(impactor) result(self)
      !> Index of the impactor
      integer, intent(in) :: impactor

      self%impactor = impactor
      self%reads_motion = .false.
   end function new_impactor_history

   subroutine prepare_impactor(self, simulation)
      class(impactor_history_type), intent(inout) :: self
      class(simulation_type), intent(in) :: simulation

      associate (model => simulation%model)
         self%ending = ".impactor_"//text(model%impactors(self%impactor)%id)//".csv"
         self%interval = model%request%impactor_interval
      end associate
   end subroutine prepare_impactor

   !> Numbers that all ranks have alike
   subroutine put_impactor(self, simulation, row)
      class(impactor_history_type), intent(in) :: self
      class(simulation_type), intent(in) :: simulation
      type(row_type), intent(inout) :: row

      character(1), parameter :: axis(3) = ["x", "y", "z"]
      real(wp) :: kinetic, start

      associate (own => simulation%state%impactors(self%impactor), &
         & impactor => simulation%domain%contact%impactors(self%impactor), &
         & unit => simulation%model%control%units)
         kinetic = 0.5_wp*impactor%mass*sum(own%velocity**2)
         if (impactor%rotates) kinetic = kinetic + 0.5_wp*impactor%inertia*sum(own%spin**2)
         start = 0.5_wp*impactor%mass*sum(impactor%velocity**2)
         call row%put("time", unit%time, simulation%state%time)
         call row%put("force", unit%force, own%force(3))
         call row%put("displacement", unit%length, own%displacement(3))
         call row%put("velocity", unit%velocity(), own%velocity(3))
         call row%put("kinetic", unit%energy, kinetic)
         call row%put("absorbed", unit%energy, start + own%work - kinetic)
         call row%put("force "//axis(:2), unit%force, own%force(:2))
         call row%put("contacts", "-", real(own%contacts, wp))
         call row%put("penetration", unit%length, own%penetration)
         call row%put("displacement "//axis(:2), unit%length, own%displacement(:2))
         call row%put("velocity "//axis(:2), unit%velocity(), own%velocity(:2))
         call row%put("angular velocity "//axis, "1/"//unit%time, own%spin)
         call row%put("impulse "//axis, unit%impulse(), own%impulse)
         call row%put("friction", unit%energy, own%friction)
      end associate
   end subroutine put_impactor

   subroutine prepare_contact(self, simulation)
      class(contact_history_type), intent(inout) :: self
      class(simulation_type), intent(in) :: simulation

      if (size(simulation%model%impactors) == 0) return
      self%ending = ".contact.csv"
      self%interval = simulation%model%request%impactor_interval
      self%reads_motion = .false.
   end subroutine prepare_contact

   !> Before the first step nothing is in contact. Patches are not part of the state: results of a
   !> restart under another name begin with its first step
   subroutine begin_contact(self, simulation, error)
      class(contact_history_type), intent(inout) :: self
      class(simulation_type), intent(in) :: simulation
      type(error_type), allocatable, intent(out) :: error

      if (simulation%state%cycle == 0) call self%record_due(simulation, error)
   end subroutine begin_contact

   !> Numbers that all ranks have alike
   subroutine put_patches(self, simulation, row)
      class(contact_history_type), intent(in) :: self
      class(simulation_type), intent(in) :: simulation
      type(row_type), intent(inout) :: row

      character(1), parameter :: axis(3) = ["x", "y", "z"]
      type(contact_patch_type) :: patch
      character(:), allocatable :: name
      integer :: c, i

      associate (unit => simulation%model%control%units, state => simulation%state)
         call row%put("time", unit%time, state%time)
         do i = 1, size(state%impactors)
            if (.not. row%is_heading) then
               patch = simulation%contacts%patch(simulation%domain, i, state%step_before)
            end if
            name = "impactor "//text(simulation%model%impactors(i)%id)//" "
            call row%put(name//"area", unit%area(), patch%area)
            call row%put(name//"rows", "-", real(patch%rows, wp))
            call row%put(name//"pressure", unit%stress, patch%largest_pressure)
            do c = 1, 3
               call row%put(name//axis(c), unit%length, patch%centre(c))
            end do
         end do
      end associate
   end subroutine put_patches

end module plydyn_io_csv_impactor_history
