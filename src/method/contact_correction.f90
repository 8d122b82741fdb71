!> Motion of the impactors over a step, corrections of plate and impactors by contact (the paper's
!> eqs 15 to 17), and the work of contact, counted once after all corrections of a step.
!>
!> An impulse does its work at the mean of the velocities before the step and after it, when all
!> bodies have moved the point: also those that push another point with which it shares its
!> inertia. So the order of the bodies changes no work.
module plydyn_method_contact_correction
   use plydyn_base_precision, only : wp
   use plydyn_contact_solve_constraint, only : correction_type
   use plydyn_contact_solve_sliding, only : step_motion_type
   use plydyn_domain_domain, only : domain_type, face_type, led_type
   use plydyn_fem_columns, only : alignment_offset, columns_type
   use plydyn_method_constraints, only : led_velocity
   use plydyn_method_energy, only : global_reduction_type
   use plydyn_method_implicit_inertia, only : add_column_correction
   use plydyn_method_step_control, only : coefficients_of_step, leapfrog_coefficients_type
   use plydyn_model_body, only : impactor_type
   use plydyn_state_state, only : energies_type, impactor_state_type, state_type
   implicit none
   private

   public :: correct_impactor, correct_plate, count_impactor, move_impactor, push_point, &
      & new_contact_work

   !> Number of impulses and columns of the first allocation
   integer, parameter :: first_capacity = 64

   !> Impulses of a body on a point of the plate over a step
   type, public :: impulse_type
      !> Places of the point in the arrays of motion
      integer :: place(3) = 0
      !> Number of the body, impactors first
      integer :: body = 0
      !> What meets the body, the share of it that slides, and what is a load
      real(wp) :: contact(3) = 0.0_wp, sliding(3) = 0.0_wp, load(3) = 0.0_wp
      !> Velocity with which the body is led; zero for an impactor, which counts its own work
      real(wp) :: velocity(3) = 0.0_wp
   end type impulse_type

   !> The impulses of a step, and the velocities before them
   type, public :: contact_work_type
      private
      !> The first `count` are of this step
      type(impulse_type), allocatable :: impulses(:)
      integer :: count = 0
      !> Where the velocities of each column are kept, 0 for nowhere; the columns kept
      integer, allocatable :: slot(:), column(:)
      integer :: kept = 0
      !> Velocities of these columns without contact, (height, columns kept)
      real(wp), allocatable :: velocity(:, :)
   contains
      procedure :: clear
      procedure :: add
      procedure :: count_work
   end type contact_work_type

contains

   !> Trial motion of an impactor: under its weight, and as prescribed
   pure subroutine move_impactor(domain, i, state)
      type(domain_type), intent(in) :: domain
      !> Which impactor
      integer, intent(in) :: i
      !> Impactors
      type(state_type), intent(inout) :: state

      integer :: c

      associate (own => state%impactors(i), impactor => domain%contact%impactors(i))
         do c = 1, 3
            if (impactor%motion(c) > 0) then
               own%velocity(c) = led_velocity(domain, led_type(impactor%quantity, &
                  & impactor%motion(c)), state, own%displacement(c), own%velocity(c))
            else
               own%velocity(c) = own%velocity(c) &
                  & + 0.5_wp*(state%step_before + state%step)*impactor%gravity(c)
            end if
         end do
         own%centre(:) = own%centre + state%step*own%velocity
         own%displacement(:) = own%displacement + state%step*own%velocity
         own%force(:) = 0.0_wp
         own%contacts = 0
         own%penetration = 0.0_wp
      end associate
   end subroutine move_impactor

   !> Add the correction to the plate. Points that share their inertia with the corrected points
   !> follow
   pure subroutine correct_plate(domain, surface, inverse_mass, correction, state, work, &
      & body, motion)
      type(domain_type), intent(in) :: domain
      type(face_type), intent(in) :: surface
      !> Inverse mass of its points, zero in directions that do not give way now, (3, points)
      real(wp), intent(in) :: inverse_mass(:, :)
      !> Displacements that contact adds
      type(correction_type), intent(in) :: correction
      !> Velocity and displacement of the plate
      type(state_type), intent(inout) :: state
      !> Gets the impulses
      type(contact_work_type), intent(inout) :: work
      !> Index of the impactor
      integer, intent(in) :: body
      !> Has the multipliers of rows that slide; not without friction
      type(step_motion_type), optional, intent(in) :: motion

      type(impulse_type) :: impulse
      integer :: i, k

      impulse%body = body
      do i = 1, correction%count
         k = correction%point(i)
         if (surface%freedom(1, k) == 0) cycle
         associate (move => correction%displacement(:, k))
            impulse%contact(:) = 0.0_wp
            where (inverse_mass(:, k) > 0.0_wp) &
               & impulse%contact = move/inverse_mass(:, k)/state%step
            if (present(motion)) impulse%sliding(:) = motion%point_force(:, k)/state%step
            call push_point(domain, surface, k, impulse, move, state, work)
         end associate
      end do
   end subroutine correct_plate

   !> Let a body push a point of the plate, and move the points that share their inertia with it
   pure subroutine push_point(domain, surface, k, impulse, move, state, work)
      type(domain_type), intent(in) :: domain
      !> The face, and the point of it, which this rank has
      type(face_type), intent(in) :: surface
      integer, intent(in) :: k
      !> Impulse of the body, and the displacement that it adds, zero in directions that do not give
      !> way
      type(impulse_type), intent(in) :: impulse
      real(wp), intent(in) :: move(3)
      !> Velocity and displacement of the plate
      type(state_type), intent(inout) :: state
      !> Gets the impulse, where this rank counts the point
      type(contact_work_type), intent(inout) :: work

      integer :: c

      if (surface%own(k)) call work%add(domain%columns, surface%freedom(:, k), impulse, &
         & state%velocity)
      do c = 1, 3
         associate (place => surface%freedom(c, k))
            state%velocity(place) = state%velocity(place) + move(c)/state%step
            state%displacement(place) = state%displacement(place) + move(c)
         end associate
         if (.not. domain%inertia%thickness%active .or. abs(move(c)) <= 0.0_wp) cycle
         call add_column_correction(domain, surface, k, c, move(c), state)
      end do
   end subroutine push_point

   !> Add the correction to the impactor
   pure subroutine correct_impactor(correction, force, step, own, motion)
      !> Displacement that contact adds, and the force on it
      real(wp), intent(in) :: correction(3), force(3)
      !> Time step
      real(wp), intent(in) :: step
      !> Its state
      type(impactor_state_type), intent(inout) :: own
      !> Rotation that friction adds; not without friction
      type(step_motion_type), optional, intent(in) :: motion

      own%force(:) = force
      own%impulse(:) = own%impulse + step*force
      own%velocity(:) = own%velocity + correction/step
      own%centre(:) = own%centre + correction
      own%displacement(:) = own%displacement + correction
      if (present(motion)) own%spin(:) = own%spin + motion%rotation_correction/step
   end subroutine correct_impactor

   !> Count the work on an impactor, at the mean of its velocities before the step and after all
   !> corrections. Where its motion is prescribed, the work of what leads it is external, as that of
   !> its weight is
   pure subroutine count_impactor(impactor, before, step_before, step, own, energies, motion)
      type(impactor_type), intent(in) :: impactor
      !> Its state after the step before
      type(impactor_state_type), intent(in) :: before
      !> The step before, and this one
      real(wp), intent(in) :: step_before, step
      !> Its state
      type(impactor_state_type), intent(inout) :: own
      type(energies_type), intent(inout) :: energies
      !> Has the multipliers of rows that slide; not without friction
      type(step_motion_type), optional, intent(in) :: motion

      real(wp) :: friction, lead(3), lost, mean(3), mean_spin(3), work

      mean(:) = 0.5_wp*(before%velocity + own%velocity)
      mean_spin(:) = 0.5_wp*(before%spin + own%spin)
      lead(:) = 0.0_wp
      where (impactor%motion > 0) &
         & lead = impactor%mass*(own%velocity - before%velocity) - step*own%force
      work = dot_product(lead, mean)
      own%work = own%work + work
      energies%external = energies%external + work + 0.5_wp*(step_before + step)*impactor%mass &
         & *sum(impactor%gravity*mean, mask=impactor%motion == 0)
      if (own%contacts == 0) return
      lost = -step*dot_product(own%force, mean) &
         & - impactor%inertia*dot_product(own%spin - before%spin, mean_spin)
      own%contact = own%contact + lost
      energies%contact = energies%contact + lost
      if (.not. present(motion)) return
      friction = -(dot_product(motion%force, mean) + dot_product(motion%moment, mean_spin))/step
      own%friction = own%friction + friction
      energies%friction = energies%friction + friction
      own%contact = own%contact - friction
      energies%contact = energies%contact - friction
   end subroutine count_impactor

   !> No impulses
   pure type(contact_work_type) function new_contact_work(columns) result(self)
      !> Where the points lie
      type(columns_type), intent(in) :: columns

      allocate (self%impulses(first_capacity), self%column(first_capacity))
      allocate (self%slot(columns%count), source=0)
      allocate (self%velocity(columns%height, first_capacity))
   end function new_contact_work

   !> Begin a step
   pure subroutine clear(self)
      class(contact_work_type), intent(inout) :: self

      integer :: k

      do k = 1, self%kept
         self%slot(self%column(k)) = 0
      end do
      self%kept = 0
      self%count = 0
   end subroutine clear

   !> Add an impulse, before it moves its point
   pure subroutine add(self, columns, place, impulse, velocity)
      class(contact_work_type), intent(inout) :: self
      !> Where the points lie
      type(columns_type), intent(in) :: columns
      !> Places in the arrays of motion of a point that this rank counts, and the impulse on it
      integer, intent(in) :: place(3)
      type(impulse_type), intent(in) :: impulse
      !> Velocity of the plate
      real(wp), contiguous, intent(in) :: velocity(:)

      call keep(self, columns%column_of(place(1)), columns%height, velocity)
      if (self%count == size(self%impulses)) self%impulses = [self%impulses, self%impulses]
      self%count = self%count + 1
      self%impulses(self%count) = impulse
      self%impulses(self%count)%place(:) = place
   end subroutine add

   !> Keep the velocities of a column, unless a body has pushed it already
   pure subroutine keep(self, column, height, velocity)
      type(contact_work_type), intent(inout) :: self
      integer, intent(in) :: column, height
      real(wp), contiguous, intent(in) :: velocity(:)

      if (self%slot(column) > 0) return
      if (self%kept == size(self%column)) then
         self%column = [self%column, self%column]
         self%velocity = reshape([self%velocity, self%velocity], [height, 2*self%kept])
      end if
      self%kept = self%kept + 1
      self%slot(column) = self%kept
      self%column(self%kept) = column
      associate (first => alignment_offset + height*(column - 1))
         self%velocity(:, self%kept) = velocity(first + 1:first + height)
      end associate
   end subroutine keep

   !> Count the work of all impulses. What is led does external work; what friction takes is not
   !> lost where bodies meet
   pure subroutine count_work(self, domain, state, reduction)
      class(contact_work_type), intent(in) :: self
      type(domain_type), intent(in) :: domain
      !> Velocity of the plate after all corrections
      type(state_type), intent(in) :: state
      !> Gets work and power
      type(global_reduction_type), intent(inout) :: reduction

      type(leapfrog_coefficients_type) :: coefficients
      real(wp) :: acceleration(3), before(3), damped(3), friction, mean(3), whole(3), &
         & work
      integer :: i

      coefficients = coefficients_of_step(domain%control%damping, state)
      do i = 1, self%count
         associate (own => self%impulses(i))
            acceleration(:) = state%acceleration(own%place)
            whole(:) = own%contact + own%load
            before(:) = velocity_before(self, domain%columns, own%place)
            damped(:) = coefficients%mean_velocity(before, acceleration)
            mean(:) = damped + 0.5_wp*(state%velocity(own%place) - before)
            friction = -dot_product(own%sliding, mean - own%velocity)
            work = friction + dot_product(own%contact, mean - own%velocity)
            call reduction%bodies(own%body)%friction%add(friction)
            call reduction%bodies(own%body)%contact%add(work)
            call reduction%contact_work%add(work)
            call reduction%prescribed_work%add(dot_product(own%contact, own%velocity) &
               & + dot_product(own%load, mean))
            call reduction%contact_power%add(dot_product(whole, acceleration))
            call reduction%contact_damping%add(coefficients%damping*dot_product(whole, damped))
         end associate
      end do
   end subroutine count_work

   !> Velocity of a point without contact
   pure function velocity_before(self, columns, place) result(velocity)
      type(contact_work_type), intent(in) :: self
      type(columns_type), intent(in) :: columns
      integer, intent(in) :: place(3)
      real(wp) :: velocity(3)

      associate (column => columns%column_of(place(1)))
         velocity(:) = self%velocity(place - alignment_offset - columns%height*(column - 1), &
            & self%slot(column))
      end associate
   end function velocity_before

end module plydyn_method_contact_correction
