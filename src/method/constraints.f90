!> Linear constraints between displacements, with one multiplier each.
!>
!> No two constraints share a point, so that each multiplier follows in closed form from the forces
!> on the points of its own constraint. It is the force along the sum of displacements: where that
!> sum is led, its work is external; where the sum is zero, there is none.
module plydyn_method_constraints
   use plydyn_base_exact_sum, only : exact_sum_type
   use plydyn_base_precision, only : wp
   use plydyn_domain_domain, only : domain_type, led_type
   use plydyn_method_energy, only : global_reduction_type
   use plydyn_method_step_control, only : coefficients_of_step, leapfrog_coefficients_type
   use plydyn_model_support, only : prescribes_acceleration, prescribes_displacement
   use plydyn_state_state, only : constraint_state_type, state_type
   implicit none
   private

   public :: add_constraint_power, begin_constraints, constrain_forces, lead_constraints, &
      & led_velocity, new_constraint_work

   !> Work space of all constraints: numbers of each term
   type, public :: constraint_work_type
      !> Sums over the points of this rank, those that it sends, and those of all ranks
      real(wp), allocatable :: sum(:), sent(:), received(:)
      !> Impulse of each right-hand side over a step
      real(wp), allocatable :: impulse(:)
   end type constraint_work_type

contains

   !> Work space for the constraints of a domain
   pure type(constraint_work_type) function new_constraint_work(domain) result(work)
      type(domain_type), intent(in) :: domain

      associate (n => size(domain%constraints%constraint))
         allocate (work%sum(n), work%received(n))
         allocate (work%impulse(size(domain%constraints%list)))
         allocate (work%sent(domain%constraints%counts(domain%comm%rank)))
      end associate
   end function new_constraint_work

   !> Constraints at time zero: the rates of their sums follow from the velocities. All ranks must
   !> come here
   subroutine begin_constraints(domain, velocity, state)
      type(domain_type), intent(in) :: domain
      !> Velocity of all points
      real(wp), intent(in), contiguous :: velocity(:)
      !> Gets its arrays
      type(constraint_state_type), intent(out) :: state

      type(constraint_work_type) :: work
      real(wp), allocatable :: share_of_velocity(:)
      integer :: k

      associate (self => domain%constraints)
         associate (n => size(self%list))
            allocate (state%force(n), state%rate(n), state%displacement(n), source=0.0_wp)
            if (n == 0) return
         end associate
         work = new_constraint_work(domain)
         allocate (share_of_velocity(size(velocity)), source=0.0_wp)
         share_of_velocity(self%freedom) = self%share*velocity(self%freedom)
         call sum_terms(domain, share_of_velocity, work)
         do k = 1, size(self%constraint)
            associate (rate => state%rate(self%constraint(k)))
               rate = rate + self%coefficient(k)*work%sum(k)
            end associate
         end do
      end associate
   end subroutine begin_constraints

   !> Add the forces that keep the accelerations of each constraint's sum zero. All threads come
   !> here together
   subroutine constrain_forces(domain, force, state, work)
      type(domain_type), intent(in) :: domain
      !> Force on all points, zero where they are held or moved
      real(wp), intent(inout), contiguous :: force(:)
      !> Gets the multipliers
      type(constraint_state_type), intent(inout) :: state
      type(constraint_work_type), intent(inout) :: work

      if (size(domain%constraints%list) == 0) return
      !$omp barrier
      !$omp master
      call find_multipliers(domain, force, state, work)
      call add_multipliers(domain, state%force, force)
      !$omp end master
      !$omp barrier
   end subroutine constrain_forces

   !> Multipliers that keep the accelerations of all sums zero, the same on all ranks
   subroutine find_multipliers(domain, force, state, work)
      type(domain_type), intent(in) :: domain
      real(wp), intent(in), contiguous :: force(:)
      type(constraint_state_type), intent(inout) :: state
      type(constraint_work_type), intent(inout) :: work

      integer :: k

      associate (self => domain%constraints)
         call sum_terms(domain, force, work)
         state%force(:) = 0.0_wp
         do k = 1, size(self%constraint)
            associate (multiplier => state%force(self%constraint(k)))
               multiplier = multiplier - self%coefficient(k)*self%inverse_mass(k)*work%sum(k)
            end associate
         end do
         do k = 1, size(self%list)
            state%force(k) = state%force(k)/self%list(k)%inverse_mass
         end do
      end associate
   end subroutine find_multipliers

   !> Add the forces of the multipliers to those on the points
   pure subroutine add_multipliers(domain, multiplier, force)
      type(domain_type), intent(in) :: domain
      real(wp), intent(in) :: multiplier(:)
      real(wp), intent(inout) :: force(:)

      integer :: i

      associate (self => domain%constraints)
         do i = 1, size(self%freedom)
            associate (term => self%term(i), f => force(self%freedom(i)))
               f = f + multiplier(self%constraint(term))*self%coefficient(term)*self%share(i)
            end associate
         end do
      end associate
   end subroutine add_multipliers

   !> Sum numbers over the points of each term, rank by rank and then in the order of the terms: the
   !> same bits on all ranks, and for any number of them
   subroutine sum_terms(domain, values, work)
      type(domain_type), intent(in) :: domain
      !> A number for each place in the arrays of motion
      real(wp), intent(in), contiguous :: values(:)
      !> Gets the sums
      type(constraint_work_type), intent(inout) :: work

      integer :: first, i

      associate (self => domain%constraints, comm => domain%comm)
         work%sum(:) = 0.0_wp
         do i = 1, size(self%freedom)
            associate (sum => work%sum(self%term(i)))
               sum = sum + values(self%freedom(i))
            end associate
         end do
         if (comm%ranks == 1) return
         first = sum(self%counts(:comm%rank - 1))
         do i = 1, size(work%sent)
            work%sent(i) = work%sum(self%of_ranks(first + i))
         end do
         call comm%allgather(work%sent, self%counts, work%received)
         do i = 1, size(self%of_ranks)
            work%sum(self%of_ranks(i)) = work%received(i)
         end do
      end associate
   end subroutine sum_terms

   !> Give the sum of each constraint its rate over the coming step: the right-hand side
   pure subroutine lead_constraints(domain, state, work, reduction)
      type(domain_type), intent(in) :: domain
      !> Velocity and displacement, already predicted: with accelerations whose sums are zero
      type(state_type), intent(inout) :: state
      type(constraint_work_type), intent(inout) :: work
      !> Gets the work of the right-hand sides
      type(global_reduction_type), intent(inout) :: reduction

      type(leapfrog_coefficients_type) :: coefficients
      real(wp) :: before, change
      integer :: i, k

      coefficients = coefficients_of_step(domain%control%damping, state)
      associate (self => domain%constraints, own => state%supports%constraints)
         do k = 1, size(self%list)
            before = coefficients%decay*own%rate(k)
            own%rate(k) = led_velocity(domain, self%list(k), state, own%displacement(k), before)
            own%displacement(k) = own%displacement(k) + state%step*own%rate(k)
            work%impulse(k) = (own%rate(k) - before)/self%list(k)%inverse_mass
            if (domain%comm%is_root()) call reduction%prescribed_work%add( &
               & 0.5_wp*work%impulse(k)*(own%rate(k) + before))
         end do
         do i = 1, size(self%freedom)
            associate (term => self%term(i), v => state%velocity(self%freedom(i)), &
               & u => state%displacement(self%freedom(i)))
               change = work%impulse(self%constraint(term))*self%coefficient(term) &
                  & *self%inverse_mass(term)
               v = v + change
               u = u + state%step*change
            end associate
         end do
      end associate
   end subroutine lead_constraints

   !> Velocity in the middle of the coming step of what a curve leads; zero without one
   pure real(wp) function led_velocity(domain, led, state, displacement, before) result(velocity)
      type(domain_type), intent(in) :: domain
      class(led_type), intent(in) :: led
      !> Time and step
      type(state_type), intent(in) :: state
      !> Displacement and velocity before the step
      real(wp), intent(in) :: displacement, before

      velocity = 0.0_wp
      if (led%curve == 0) return
      associate (curve => domain%curves(led%curve), step => state%step)
         select case (led%quantity)
         case (prescribes_displacement)
            velocity = (led%scale*curve%at(state%time + step) - displacement)/step
         case (prescribes_acceleration)
            velocity = before + 0.5_wp*(state%step_before + step)*led%scale*curve%at(state%time)
         case default
            velocity = led%scale*curve%at(state%time + 0.5_wp*step)
         end select
      end associate
   end function led_velocity

   !> Add the power of the right-hand sides to a sum
   pure subroutine add_constraint_power(domain, state, sum)
      type(domain_type), intent(in) :: domain
      !> Multipliers and rates
      type(constraint_state_type), intent(in) :: state
      type(exact_sum_type), intent(inout) :: sum

      integer :: k

      ! every rank knows all of them: one counts them
      if (.not. domain%comm%is_root()) return
      do k = 1, size(domain%constraints%list)
         call sum%add(state%force(k)*state%rate(k))
      end do
   end subroutine add_constraint_power

end module plydyn_method_constraints
