!> The histories of bodies. JOB.impactor_ID.csv has the force and the motion of an impactor,
!> JOB.fixture_ID.csv force, contact and friction of a fixture, and JOB.contact.csv the patches in
!> contact of all impactors: area, rows, pressure, centre of pressure.
module plydyn_io_csv_body_history
   use plydyn_base_error, only : error_type
   use plydyn_base_precision, only : wp
   use plydyn_base_text, only : text
   use plydyn_contact_patch, only : contact_patch_type
   use plydyn_domain_domain, only : domain_type
   use plydyn_io_csv_history_file, only : row_type
   use plydyn_io_csv_history_recorder, only : history_recorder_type
   use plydyn_method_simulation, only : simulation_type
   use plydyn_state_state, only : state_type
   implicit none
   private

   !> Directions
   character(1), parameter :: axis(3) = ["x", "y", "z"]

   !> The history of one impactor
   type, public, extends(history_recorder_type) :: impactor_history_type
      !> Index of the impactor
      integer :: impactor = 0
   contains
      procedure :: put_columns => put_impactor
   end type impactor_history_type

   !> The history of one fixture
   type, public, extends(history_recorder_type) :: fixture_history_type
      !> Index of the fixture
      integer :: fixture = 0
   contains
      procedure :: put_columns => put_fixture
   end type fixture_history_type

   !> The history of the patches of all impactors
   type, public, extends(history_recorder_type) :: contact_history_type
   contains
      procedure :: put_columns => put_patches
      procedure :: begin => begin_contact
   end type contact_history_type

contains

   !> Numbers that all ranks have alike
   subroutine put_impactor(self, simulation, row)
      class(impactor_history_type), intent(in) :: self
      class(simulation_type), intent(in) :: simulation
      type(row_type), intent(inout) :: row

      real(wp) :: kinetic, start

      associate (own => simulation%state%impactors(self%impactor), &
         & impactor => simulation%domain%contact%impactors(self%impactor), &
         & unit => simulation%model%control%units)
         kinetic = 0.5_wp*impactor%mass*sum(own%velocity**2) &
            & + 0.5_wp*impactor%inertia*sum(own%spin**2)
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

   subroutine put_fixture(self, simulation, row)
      class(fixture_history_type), intent(in) :: self
      class(simulation_type), intent(in) :: simulation
      type(row_type), intent(inout) :: row

      real(wp) :: highest(1)

      highest(:) = 0.0_wp
      if (.not. row%is_heading) then
         highest(:) = uplift(simulation%domain, self%fixture, simulation%state)
         call self%comm%max(highest)
      end if
      associate (unit => simulation%model%control%units, &
         & own => simulation%state%fixtures(self%fixture))
         call row%put("time", unit%time, simulation%state%time)
         call row%put("force "//axis, unit%force, own%force)
         call row%put("impulse "//axis, unit%impulse(), own%impulse)
         call row%put("area", unit%area(), own%area)
         call row%put("contacts", "-", real(own%contacts, wp))
         call row%put("slip", unit%length, own%slip)
         call row%put("uplift", unit%length, highest(1))
         call row%put("friction", unit%energy, own%friction)
      end associate
   end subroutine put_fixture

   !> Largest distance from the face of a fixture of the points that began under it
   pure real(wp) function uplift(domain, i, state)
      type(domain_type), intent(in) :: domain
      !> Index of the fixture
      integer, intent(in) :: i
      type(state_type), intent(in) :: state

      real(wp) :: displacement(3), height
      integer :: k

      uplift = 0.0_wp
      associate (fixture => domain%contact%fixtures(i), &
         & surface => domain%contact%fixture_faces(domain%contact%fixtures(i)%surface))
         displacement(:) = fixture%displacement(domain%curves, state%time)
         height = state%fixtures(i)%height + displacement(3)
         do k = 1, size(fixture%below)
            associate (p => fixture%below(k))
               uplift = max(uplift, fixture%body%upward*(surface%position(3, p) &
                  & + state%displacement(surface%freedom(3, p)) - height))
            end associate
         end do
      end associate
   end function uplift

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

      type(contact_patch_type) :: patch
      character(:), allocatable :: name
      integer :: i

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
            call row%put(name//axis, unit%length, patch%centre)
         end do
      end associate
   end subroutine put_patches

end module plydyn_io_csv_body_history
