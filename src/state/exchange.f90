!> All arrays of a state by name: writing and reading of restart files go through this list.
module plydyn_state_exchange
   use plydyn_base_precision, only : wp
   use plydyn_base_text, only : text
   use plydyn_state_state, only : body_state_type, contact_memory_type, energies_type, &
      & fixture_state_type, impactor_state_type, motion_sums_type, relaxation_state_type, &
      & run_end_type, state_type
   implicit none
   private

   public :: exchange_state

   !> Writer or reader of named arrays
   type, abstract, public :: exchange_type
   contains
      procedure(take_reals), deferred :: reals
      procedure(take_integers), deferred :: integers
   end type exchange_type

   abstract interface
      !> Take or give an array
      subroutine take_reals(self, name, values)
         import :: exchange_type, wp
         implicit none
         class(exchange_type), intent(inout) :: self
         !> Name of the array
         character(*), intent(in) :: name
         !> Its values; a reader keeps their extent, and allocates an array that is not allocated
         real(wp), allocatable, intent(inout) :: values(:)
      end subroutine take_reals

      !> Take or give an array
      subroutine take_integers(self, name, values)
         import :: exchange_type
         implicit none
         class(exchange_type), intent(inout) :: self
         !> Name of the array
         character(*), intent(in) :: name
         !> Its values; a reader keeps their extent, and allocates an array that is not allocated
         integer, allocatable, intent(inout) :: values(:)
      end subroutine take_integers
   end interface

contains

   !> Write or read all of a state; arrays are in the order of the whole model
   subroutine exchange_state(exchange, state)
      !> Writer or reader
      class(exchange_type), intent(inout) :: exchange
      !> The state, with arrays of their extents
      type(state_type), intent(inout) :: state

      real(wp), allocatable :: acceleration(:)

      call exchange_clock(exchange, state)
      call exchange%reals("displacement", state%displacement)
      call exchange%reals("velocity", state%velocity)
      ! without the columns of forces behind them
      acceleration = state%acceleration(:size(state%displacement))
      call exchange%reals("acceleration", acceleration)
      state%acceleration(:size(acceleration)) = acceleration
      call exchange%reals("history", state%history)
      call exchange%reals("load_factor", state%supports%load_factor)
      call exchange%reals("support_force", state%supports%force)
      call exchange%reals("support_velocity", state%supports%velocity)
      ! a model without constraints has no arrays of them
      associate (constraints => state%supports%constraints)
         if (size(constraints%force) > 0) then
            call exchange%reals("constraint_force", constraints%force)
            call exchange%reals("constraint_rate", constraints%rate)
            call exchange%reals("constraint_displacement", constraints%displacement)
         end if
      end associate
      call exchange_relaxation(exchange, state%relaxation)
      call exchange_sums(exchange, state%sums, state%energies)
      call exchange_bodies(exchange, state%impactors, state%fixtures)
      call exchange_contacts(exchange, state%contacts)
   end subroutine exchange_state

   !> Time and steps
   subroutine exchange_clock(exchange, state)
      class(exchange_type), intent(inout) :: exchange
      type(state_type), intent(inout) :: state

      real(wp), allocatable :: clock(:)
      integer, allocatable :: counts(:)

      clock = [state%time]
      call exchange%reals("time", clock)
      state%time = clock(1)
      clock = [state%step, state%step_before, state%first_step, state%end%time]
      call exchange%reals("clock", clock)
      state%step = clock(1)
      state%step_before = clock(2)
      state%first_step = clock(3)
      state%end%time = clock(4)
      associate (end => state%end)
         clock = [end%begin, end%largest_power, end%look_time, end%look_work]
         call exchange%reals("loading", clock)
         end = run_end_type(end%time, end%cycle, clock(1), clock(2), clock(3), clock(4))
      end associate
      counts = [state%cycle, state%end%cycle, state%supports%planes]
      call exchange%integers("cycle", counts)
      state%cycle = counts(1)
      state%end%cycle = counts(2)
      state%supports%planes(:) = counts(3:)
      clock = [state%least_volume]
      call exchange%reals("least_volume", clock)
      state%least_volume = clock(1)
   end subroutine exchange_clock

   !> Dynamic relaxation
   subroutine exchange_relaxation(exchange, relaxation)
      class(exchange_type), intent(inout) :: exchange
      type(relaxation_state_type), intent(inout) :: relaxation

      real(wp), allocatable :: numbers(:)

      numbers = [relaxation%damping, relaxation%next_damping, real(relaxation%change_cycle, wp), &
         & relaxation%largest_kinetic, relaxation%damped_time, relaxation%twice_kinetic, &
         & relaxation%stiffness_square]
      call exchange%reals("relaxation", numbers)
      relaxation = relaxation_state_type(numbers(1), numbers(2), nint(numbers(3)), numbers(4), &
         & numbers(5), numbers(6), numbers(7))
   end subroutine exchange_relaxation

   !> Sums and energies: all components are reals
   subroutine exchange_sums(exchange, sums, energies)
      class(exchange_type), intent(inout) :: exchange
      type(motion_sums_type), intent(inout) :: sums
      type(energies_type), intent(inout) :: energies

      real(wp), allocatable :: numbers(:)

      numbers = transfer(sums, [0.0_wp])
      call exchange%reals("sums", numbers)
      sums = transfer(numbers, sums)
      numbers = transfer(energies, [0.0_wp])
      call exchange%reals("energies", numbers)
      energies = transfer(numbers, energies)
   end subroutine exchange_sums

   !> Impactors and fixtures
   subroutine exchange_bodies(exchange, impactors, fixtures)
      class(exchange_type), intent(inout) :: exchange
      type(impactor_state_type), intent(inout) :: impactors(:)
      type(fixture_state_type), intent(inout) :: fixtures(:)

      real(wp), allocatable :: numbers(:)
      integer :: i

      do i = 1, size(impactors)
         associate (own => impactors(i), name => "impactor_"//text(impactors(i)%id))
            call exchange_body(exchange, name, own%body_state_type)
            numbers = [own%centre, own%displacement, own%velocity, own%spin, own%work, &
               & own%penetration, own%last_contact]
            call exchange%reals(name//"_motion", numbers)
            own = impactor_state_type(body_state_type=own%body_state_type, centre=numbers(1:3), &
               & displacement=numbers(4:6), velocity=numbers(7:9), spin=numbers(10:12), &
               & work=numbers(13), penetration=numbers(14), last_contact=numbers(15))
         end associate
      end do
      do i = 1, size(fixtures)
         associate (own => fixtures(i), name => "fixture_"//text(fixtures(i)%id))
            call exchange_body(exchange, name, own%body_state_type)
            numbers = [own%height, own%area, own%slip]
            call exchange%reals(name//"_rows", numbers)
            own = fixture_state_type(body_state_type=own%body_state_type, height=numbers(1), &
               & area=numbers(2), slip=numbers(3))
         end associate
      end do
   end subroutine exchange_bodies

   !> What impactors and fixtures have in common
   subroutine exchange_body(exchange, name, own)
      class(exchange_type), intent(inout) :: exchange
      !> Of the body
      character(*), intent(in) :: name
      type(body_state_type), intent(inout) :: own

      real(wp), allocatable :: numbers(:)

      numbers = [own%force, own%impulse, own%friction, own%contact, real(own%contacts, wp)]
      call exchange%reals(name, numbers)
      own = body_state_type(own%id, numbers(1:3), numbers(4:6), numbers(7), numbers(8), &
         & nint(numbers(9)))
   end subroutine exchange_body

   !> Memory of the contacts
   subroutine exchange_contacts(exchange, contacts)
      class(exchange_type), intent(inout) :: exchange
      type(contact_memory_type), intent(inout) :: contacts(:)
      integer :: i

      do i = 1, size(contacts)
         call exchange%integers("contact_"//text(i)//"_places", contacts(i)%places)
         call exchange%reals("contact_"//text(i)//"_numbers", contacts(i)%numbers)
      end do
   end subroutine exchange_contacts

end module plydyn_state_exchange
