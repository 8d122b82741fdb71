!> The history of force, contact and friction of a fixture, JOB.fixture_ID.csv.
module plydyn_io_csv_fixture_history
   use plydyn_base_error, only : error_type
   use plydyn_base_precision, only : wp
   use plydyn_base_text, only : text
   use plydyn_domain_domain, only : domain_type
   use plydyn_io_csv_history_recorder, only : history_recorder_type
   use plydyn_io_job, only : job_type
   use plydyn_method_simulation, only : simulation_type
   use plydyn_state_state, only : state_type
   implicit none
   private

   public :: new_fixture_history

   !> Columns
   character(20), parameter :: names(*) = [character(20) :: "time", "force x", "force y", &
      & "force z", "impulse x", "impulse y", "impulse z", "area", "contacts", "slip", "uplift", &
      & "friction"]

   !> The history
   type, public, extends(history_recorder_type) :: fixture_history_type
      private
      !> Index of the fixture
      integer :: fixture = 0
   contains
      procedure :: open => open_fixture
      procedure :: record => record_fixture
   end type fixture_history_type

contains

   !> The history of a fixture
   pure type(fixture_history_type) function new_fixture_history(fixture) result(self)
      !> Index of the fixture
      integer, intent(in) :: fixture

      self%fixture = fixture
   end function new_fixture_history

   !> Create the file, or append to the one of the restart
   subroutine open_fixture(self, job, simulation, error)
      class(fixture_history_type), intent(inout) :: self
      type(job_type), intent(in) :: job
      class(simulation_type), intent(in) :: simulation
      type(error_type), allocatable, intent(out) :: error

      character(20) :: units(size(names))

      associate (u => simulation%model%control%units)
         units(1) = u%time
         units(2:4) = u%force
         units(5:7) = trim(u%force)//" "//u%time
         units(8:) = [character(20) :: trim(u%length)//"2", "-", u%length, u%length, u%energy]
      end associate
      call self%open_file(job, simulation, ".fixture_" &
         & //text(simulation%model%fixtures(self%fixture)%id)//".csv", names, units, &
         & simulation%model%request%fixture_interval, error)
   end subroutine open_fixture

   !> Add a line. All ranks come here
   subroutine record_fixture(self, simulation, error)
      class(fixture_history_type), intent(inout) :: self
      class(simulation_type), intent(in) :: simulation
      type(error_type), allocatable, intent(out) :: error

      real(wp) :: highest(1)

      highest(:) = uplift(simulation%domain, self%fixture, simulation%state)
      call self%comm%max(highest)
      associate (own => simulation%state%fixtures(self%fixture))
         call self%write_line([simulation%state%time, own%force, own%impulse, own%area, &
            & real(own%contacts, wp), own%slip, highest, own%friction], error)
      end associate
   end subroutine record_fixture

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
         height = fixture%height + displacement(3)
         do k = 1, size(fixture%below)
            associate (p => fixture%below(k))
               uplift = max(uplift, fixture%body%upward*(surface%position(3, p) &
                  & + state%displacement(surface%freedom(3, p)) - height))
            end associate
         end do
      end associate
   end function uplift

end module plydyn_io_csv_fixture_history
