!> The history of force, contact and friction of a fixture, JOB.fixture_ID.csv.
module plydyn_io_csv_fixture_history
   use plydyn_base_precision, only : wp
   use plydyn_base_text, only : text
   use plydyn_domain_domain, only : domain_type
   use plydyn_io_csv_history_file, only : row_type
   use plydyn_io_csv_history_recorder, only : history_recorder_type
   use plydyn_method_simulation, only : simulation_type
   use plydyn_state_state, only : state_type
   implicit none
   private

   public :: new_fixture_history

   !> The history
   type, public, extends(history_recorder_type) :: fixture_history_type
      private
      !> Index of the fixture
      integer :: fixture = 0
   contains
      procedure :: prepare
      procedure :: put_columns
   end type fixture_history_type

contains

   !> The history of a fixture
   pure type(fixture_history_type) function new_fixture_history(fixture) result(self)
      !> Index of the fixture
      integer, intent(in) :: fixture

      self%fixture = fixture
   end function new_fixture_history

   subroutine prepare(self, simulation)
      class(fixture_history_type), intent(inout) :: self
      class(simulation_type), intent(in) :: simulation

      associate (model => simulation%model)
         self%ending = ".fixture_"//text(model%fixtures(self%fixture)%id)//".csv"
         self%interval = model%request%fixture_interval
      end associate
   end subroutine prepare

   subroutine put_columns(self, simulation, row)
      class(fixture_history_type), intent(in) :: self
      class(simulation_type), intent(in) :: simulation
      type(row_type), intent(inout) :: row

      character(*), parameter :: force(3) = ["force x", "force y", "force z"]
      character(*), parameter :: impulse(3) = ["impulse x", "impulse y", "impulse z"]
      real(wp) :: highest(1)

      highest(:) = 0.0_wp
      if (.not. row%is_heading) then
         highest(:) = uplift(simulation%domain, self%fixture, simulation%state)
         call self%comm%max(highest)
      end if
      associate (unit => simulation%model%control%units, &
         & own => simulation%state%fixtures(self%fixture))
         call row%put("time", unit%time, simulation%state%time)
         call row%put(force, unit%force, own%force)
         call row%put(impulse, unit%impulse(), own%impulse)
         call row%put("area", unit%area(), own%area)
         call row%put("contacts", "-", real(own%contacts, wp))
         call row%put("slip", unit%length, own%slip)
         call row%put("uplift", unit%length, highest(1))
         call row%put("friction", unit%energy, own%friction)
      end associate
   end subroutine put_columns

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

end module plydyn_io_csv_fixture_history
