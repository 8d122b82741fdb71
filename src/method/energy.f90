!> Sums of a step over all points of all ranks, and the energy balance that they close.
!>
!> One exchange makes the sums and the maximum of a step. Sums are exact, so that they have the same
!> bits for any number of ranks and threads. A maximum travels with them in a word for each rank,
!> which the others leave zero.
!>
!> Internal forces and loads do the work 1/2 (f_n + f_n+1) . (u_n+1 - u_n) over a step, which the
!> scheme conserves. The kinetic energy is that of the velocity at the full step,
!> v_n = v_n-1/2 + 1/2 dt a_n, which is never negative. It exceeds the conserved form by the
!> half-step energy 1/8 dt^2 a M a: the balance subtracts it, and the stability monitor checks
!> it. Where the step changes, as it does at the start, the correction does too.
module plydyn_method_energy
   use, intrinsic :: iso_fortran_env, only : int64
   use plydyn_base_exact_sum, only : exact_sum_type
   use plydyn_base_precision, only : wp
   use plydyn_domain_domain, only : contact_bodies_type, domain_type
   use plydyn_method_step_control, only : coefficients_of_step, leapfrog_coefficients_type
   use plydyn_parallel_comm, only : comm_type
   use plydyn_state_state, only : body_state_type, energies_type, fixture_state_type, &
      & motion_sums_type, state_type
   implicit none
   private

   public :: measure_energies, update_bodies, update_energies

   !> What a message does with a number: nothing but count its words, set it to zero, take it from
   !> this rank, give back that of all ranks
   integer, parameter :: counting = 0, clearing = 1, packing = 2, taking = 3

   !> What the ranks exchange, kept from step to step
   type :: message_type
      !> What it does, and how many words it has passed
      integer :: action = counting, place = 0
      !> This rank, from 0, and how many there are
      integer :: rank = 0, ranks = 1
      integer(int64), allocatable :: words(:, :)
   contains
      procedure :: pass_sum
      procedure :: pass_sums
      procedure :: pass_count
      procedure :: pass_maximum
   end type message_type

   !> Sums of a body over the points of the plate that it meets
   type, public :: body_sums_type
      !> Work of friction on the plate, and all work of contact on it
      type(exact_sum_type) :: friction, contact
      !> Whether every point is a row of its own, as with fixtures: the sums below are over these
      logical :: has_rows = .false.
      !> Impulse on the body
      type(exact_sum_type) :: impulse(3)
      !> Area of the points in contact, and how many they are
      type(exact_sum_type) :: area, points
      !> Normal force, and that times the path
      type(exact_sum_type) :: normal, slip
   end type body_sums_type

   !> Sums over all points, maxima and requests of a step
   type, public :: global_reduction_type
      !> As in `motion_sums_type`
      type(exact_sum_type) :: momentum(3), twice_kinetic, acceleration_square, twice_added, power
      !> Power of loads and supports at the beginning of the step and at its end, with the velocity
      !> over it
      type(exact_sum_type) :: external_power_before, external_power_after
      !> Work of prescribed motions
      type(exact_sum_type) :: prescribed_work
      !> Work of contact on the plate, and its change of the power at the beginning of the step
      type(exact_sum_type) :: contact_work, contact_power
      !> Work of the damping force along the velocity that contact adds
      type(exact_sum_type) :: contact_damping
      !> Sums of each impactor, and then of each fixture
      type(body_sums_type), allocatable :: bodies(:)
      !> Bound on every component of the velocity of all points over the step to come
      real(wp) :: speed_bound = huge(1.0_wp)
      !> Largest correction by a fixture over the last step, length
      real(wp) :: largest_push = 0.0_wp
      !> Ranks that ask for attention after the step
      integer :: requests = 0
      type(message_type), private :: message
   contains
      procedure :: expect_bodies
      procedure :: clear
      procedure :: add_motion
      procedure :: sum => sum_over_ranks
      procedure :: motion_sums
   end type global_reduction_type

contains

   !> Make room for the sums of impactors and fixtures, where there are any
   pure subroutine expect_bodies(self, bodies)
      class(global_reduction_type), intent(inout) :: self
      !> Impactors and fixtures
      type(contact_bodies_type), intent(in) :: bodies

      if (allocated(self%bodies)) return
      allocate (self%bodies(size(bodies%impactors) + size(bodies%fixtures)))
      self%bodies(size(bodies%impactors) + 1:)%has_rows = .true.
   end subroutine expect_bodies

   !> Make all sums zero; the bound on the velocity remains until there is another one
   pure subroutine clear(self)
      class(global_reduction_type), intent(inout) :: self

      call pass_all(self, clearing)
      self%requests = 0
      self%largest_push = 0.0_wp
   end subroutine clear

   !> Add sums over some points
   pure subroutine add_motion(self, sums)
      class(global_reduction_type), intent(inout) :: self
      !> Sums over the points of a chunk
      class(motion_sums_type), intent(in) :: sums

      integer :: c

      do c = 1, 3
         call self%momentum(c)%add(sums%momentum(c))
      end do
      call self%twice_kinetic%add(sums%twice_kinetic)
      call self%twice_added%add(sums%twice_added)
      call self%acceleration_square%add(sums%acceleration_square)
      call self%power%add(sums%power)
   end subroutine add_motion

   !> Reduce over all ranks
   subroutine sum_over_ranks(self, comm)
      class(global_reduction_type), intent(inout) :: self
      type(comm_type), intent(in) :: comm

      if (comm%ranks == 1) return
      self%message%rank = comm%rank
      self%message%ranks = comm%ranks
      call pass_all(self, counting)
      if (allocated(self%message%words)) then
         ! the place of one step serves the next one
         if (size(self%message%words) /= self%message%place) deallocate (self%message%words)
      end if
      if (.not. allocated(self%message%words)) allocate (self%message%words(self%message%place, 1))
      self%message%words(:, :) = 0_int64
      call pass_all(self, packing)
      call comm%sum(self%message%words)
      call pass_all(self, taking)
   end subroutine sum_over_ranks

   !> Pass all that the ranks exchange to the message, in one order
   pure subroutine pass_all(self, action)
      class(global_reduction_type), intent(inout) :: self
      !> What the message does with it
      integer, intent(in) :: action

      integer :: i

      self%message%action = action
      self%message%place = 0
      associate (message => self%message)
         call message%pass_sums(self%momentum)
         call message%pass_sum(self%twice_kinetic)
         call message%pass_sum(self%acceleration_square)
         call message%pass_sum(self%twice_added)
         call message%pass_sum(self%power)
         call message%pass_sum(self%external_power_before)
         call message%pass_sum(self%external_power_after)
         call message%pass_sum(self%prescribed_work)
         call message%pass_sum(self%contact_work)
         call message%pass_sum(self%contact_power)
         call message%pass_sum(self%contact_damping)
         call message%pass_count(self%requests)
         call message%pass_maximum(self%speed_bound)
         call message%pass_maximum(self%largest_push)
         if (.not. allocated(self%bodies)) return
         do i = 1, size(self%bodies)
            associate (body => self%bodies(i))
               call message%pass_sum(body%friction)
               call message%pass_sum(body%contact)
               if (.not. body%has_rows) cycle
               call message%pass_sums(body%impulse)
               call message%pass_sum(body%area)
               call message%pass_sum(body%points)
               call message%pass_sum(body%normal)
               call message%pass_sum(body%slip)
            end associate
         end do
      end associate
   end subroutine pass_all

   !> Pass a sum
   pure subroutine pass_sum(self, sum)
      class(message_type), intent(inout) :: self
      type(exact_sum_type), intent(inout) :: sum

      associate (first => self%place + 1, last => self%place + size(sum%limb))
         if (self%action == clearing) sum%limb(:) = 0_int64
         if (self%action == packing) self%words(first:last, 1) = sum%limb
         if (self%action == taking) sum%limb(:) = self%words(first:last, 1)
      end associate
      self%place = self%place + size(sum%limb)
   end subroutine pass_sum

   !> Pass some sums
   pure subroutine pass_sums(self, sums)
      class(message_type), intent(inout) :: self
      type(exact_sum_type), intent(inout) :: sums(:)

      integer :: i

      do i = 1, size(sums)
         call self%pass_sum(sums(i))
      end do
   end subroutine pass_sums

   !> Pass a count; it is not cleared
   pure subroutine pass_count(self, count)
      class(message_type), intent(inout) :: self
      integer, intent(inout) :: count

      self%place = self%place + 1
      if (self%action == packing) self%words(self%place, 1) = int(count, int64)
      if (self%action == taking) count = int(self%words(self%place, 1))
   end subroutine pass_count

   !> Pass a maximum: the sum of words of which each rank sets its own; it is not cleared
   pure subroutine pass_maximum(self, maximum)
      class(message_type), intent(inout) :: self
      real(wp), intent(inout) :: maximum

      associate (first => self%place + 1, last => self%place + self%ranks)
         if (self%action == packing) then
            self%words(first + self%rank, 1) = transfer(maximum, 0_int64)
         else if (self%action == taking) then
            maximum = maxval(transfer(self%words(first:last, 1), [0.0_wp]))
         end if
      end associate
      self%place = self%place + self%ranks
   end subroutine pass_maximum

   !> The sums over all points as numbers
   pure type(motion_sums_type) function motion_sums(self) result(sums)
      class(global_reduction_type), intent(in) :: self

      sums%momentum(:) = [self%momentum(1)%value(), self%momentum(2)%value(), &
         & self%momentum(3)%value()]
      sums%twice_kinetic = self%twice_kinetic%value()
      sums%twice_added = self%twice_added%value()
      sums%acceleration_square = self%acceleration_square%value()
      sums%power = self%power%value()
   end function motion_sums

   !> Energies at the end of the step under way
   pure subroutine update_energies(domain, reduction, state)
      type(domain_type), intent(in) :: domain
      !> Sums of the step over all ranks
      type(global_reduction_type), intent(in) :: reduction
      !> Energies; the clock is still that of the beginning of the step
      type(state_type), intent(inout) :: state

      type(leapfrog_coefficients_type) :: coefficients
      real(wp) :: inside, internal_power, outside, outside_before

      coefficients = coefficients_of_step(domain%control%damping, state)
      call change_step(coefficients, state%step_before, state%sums, &
         & reduction%contact_power%value(), state%energies, internal_power)
      call measure_energies(domain, reduction, state%step, state)
      outside_before = reduction%external_power_before%value()
      outside = reduction%external_power_after%value()
      inside = internal_power + outside_before - reduction%contact_power%value()
      state%relaxation%stiffening = outside - state%sums%power - inside
      associate (e => state%energies, step => state%step)
         e%internal = e%internal + 0.5_wp*step*(inside + outside - state%sums%power)
         e%external = e%external + 0.5_wp*step*(outside_before + outside) &
            & + reduction%prescribed_work%value()
         e%contact = e%contact - reduction%contact_work%value()
         e%damping = e%damping + reduction%contact_damping%value()
      end associate
      call state%energies%raise_reference()
   end subroutine update_energies

   !> Work of contact with each body in the step under way, and what the rows of fixtures sum to. An
   !> impactor has its force from its equations, which every rank solves
   pure subroutine update_bodies(reduction, state)
      !> Sums of the step over all ranks
      type(global_reduction_type), intent(in) :: reduction
      !> Impactors, fixtures and energies; the clock is still that of the beginning of the step
      type(state_type), intent(inout) :: state

      integer :: i

      do i = 1, size(state%impactors)
         call add_work(reduction%bodies(i), state%impactors(i)%body_state_type, state%energies)
      end do
      do i = 1, size(state%fixtures)
         associate (sums => reduction%bodies(size(state%impactors) + i))
            call add_work(sums, state%fixtures(i)%body_state_type, state%energies)
            call add_rows(sums, 0.5_wp*(state%step_before + state%step), state%fixtures(i))
         end associate
      end do
   end subroutine update_bodies

   !> Add friction and losses on the plate
   pure subroutine add_work(sums, own, energies)
      type(body_sums_type), intent(in) :: sums
      type(body_state_type), intent(inout) :: own
      type(energies_type), intent(inout) :: energies

      real(wp) :: friction

      friction = sums%friction%value()
      own%friction = own%friction + friction
      own%contact = own%contact - sums%contact%value()
      energies%friction = energies%friction + friction
   end subroutine add_work

   !> Force, area and path of a fixture
   pure subroutine add_rows(sums, duration, own)
      type(body_sums_type), intent(in) :: sums
      !> Time over which an impulse acts
      real(wp), intent(in) :: duration
      type(fixture_state_type), intent(inout) :: own

      real(wp) :: impulse(3), normal
      integer :: c

      impulse(:) = [(sums%impulse(c)%value(), c=1, 3)]
      own%force(:) = impulse/duration
      own%impulse(:) = own%impulse + impulse
      own%area = sums%area%value()
      own%contacts = nint(sums%points%value())
      normal = sums%normal%value()
      if (normal > 0.0_wp) own%slip = own%slip + sums%slip%value()/normal
   end subroutine add_rows

   !> A new step changes the form of energy that the scheme conserves. The power of all forces with
   !> the velocity over it, and the work of damping, follow from the sums at the full step before,
   !> whatever inertia is behind the accelerations
   pure subroutine change_step(coefficients, before, sums, contact_power, energies, &
      & internal_power)
      !> Of the step
      type(leapfrog_coefficients_type), intent(in) :: coefficients
      !> The step before
      real(wp), intent(in) :: before
      !> Sums over all points at the beginning of the step
      type(motion_sums_type), intent(in) :: sums
      !> Power of the forces there with the velocity that contact adds in the step
      real(wp), intent(in) :: contact_power
      type(energies_type), intent(inout) :: energies
      !> Power of the forces at the beginning of the step with the velocity over it, negative
      real(wp), intent(out) :: internal_power

      associate (e => energies, decay => coefficients%decay, mean_step => coefficients%mean_step)
         e%step_change = e%step_change + 0.125_wp*sums%acceleration_square &
            & *(coefficients%step**2 - before**2) + 0.25_wp*coefficients%shortening &
            & *(coefficients%damping*((1.0_wp + decay)*sums%power + mean_step &
            & *sums%acceleration_square) - contact_power)
         internal_power = -decay*sums%power - mean_step*sums%acceleration_square
         ! the velocity before is the velocity at the full step less 1/2 dt a
         e%damping = e%damping + 0.5_wp*coefficients%damping*((1.0_wp + decay)**2 &
            & *(sums%twice_kinetic + sums%twice_added - before*(sums%power &
            & + 0.25_wp*before*sums%acceleration_square)) + mean_step*(2.0_wp*(1.0_wp + decay) &
            & *sums%power + mean_step*sums%acceleration_square))
      end associate
   end subroutine change_step

   !> Kinetic energies and momentum of the present motion
   pure subroutine measure_energies(domain, reduction, step, state)
      type(domain_type), intent(in) :: domain
      !> Sums over all points of all ranks
      type(global_reduction_type), intent(in) :: reduction
      !> The step that ends with this motion
      real(wp), intent(in) :: step
      !> Sums and energies
      type(state_type), intent(inout) :: state

      integer :: i

      state%sums = reduction%motion_sums()
      associate (e => state%energies, sums => state%sums)
         e%kinetic = 0.5_wp*sums%twice_kinetic
         e%added = 0.5_wp*sums%twice_added
         e%half_step_correction = 0.125_wp*step**2*sums%acceleration_square
         e%momentum(:) = sums%momentum
         e%impactor = 0.0_wp
         do i = 1, size(state%impactors)
            associate (impactor => domain%contact%impactors(i), v => state%impactors(i)%velocity, &
               & spin => state%impactors(i)%spin)
               e%impactor = e%impactor + 0.5_wp*impactor%mass*dot_product(v, v) &
                  & + 0.5_wp*impactor%inertia*dot_product(spin, spin)
               e%momentum(:) = e%momentum + impactor%mass*v
            end associate
         end do
      end associate
   end subroutine measure_energies

end module plydyn_method_energy
