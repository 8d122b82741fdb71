!> Sums and the maximum of a step over all points of all ranks, made by one exchange.
!>
!> Sums are exact, so that they have the same bits for any number of ranks and threads. A maximum
!> travels with them in a word for each rank, which the others leave zero.
module plydyn_method_global_reduction
   use, intrinsic :: iso_fortran_env, only : int64
   use plydyn_base_exact_sum, only : exact_sum_type, exact_sums_type
   use plydyn_base_precision, only : wp
   use plydyn_parallel_comm, only : comm_type
   use plydyn_state_state, only : motion_sums_type
   implicit none
   private

   !> Sums over all points; nothing but exact sums, see `sum_over_ranks`
   type :: step_sums_type
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
   end type step_sums_type

   !> Sums, maximum and requests of a step
   type, public, extends(step_sums_type) :: global_reduction_type
      !> Bound on every component of the velocity of all points over the step to come
      real(wp) :: speed_bound = huge(1.0_wp)
      !> Largest correction by a fixture over the last step, length
      real(wp) :: largest_push = 0.0_wp
      !> Sums of all impactors, of friction alone, and of all fixtures, see
      !> `plydyn_method_fixture_step`; not allocated where nothing needs them
      type(exact_sums_type) :: bodies
      !> Ranks that ask for attention after the step
      integer :: requests = 0
   contains
      procedure :: clear
      procedure :: add_motion
      procedure :: sum => sum_over_ranks
      procedure :: motion_sums
   end type global_reduction_type

contains

   !> Make all sums zero; the bound on the velocity remains until there is another one
   pure subroutine clear(self)
      class(global_reduction_type), intent(inout) :: self

      self%step_sums_type = step_sums_type()
      self%requests = 0
      self%largest_push = 0.0_wp
      if (allocated(self%bodies%limb)) call self%bodies%clear()
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
      !> The ranks
      type(comm_type), intent(in) :: comm

      integer(int64), allocatable :: words(:, :)
      integer :: last, n

      if (comm%ranks == 1) return
      n = storage_size(self%step_sums_type)/storage_size(0_int64)
      last = n + 1 + 2*comm%ranks
      if (allocated(self%bodies%limb)) last = last + size(self%bodies%limb)
      allocate (words(last, 1), source=0_int64)
      words(:n, 1) = transfer(self%step_sums_type, words(:n, 1))
      words(n + 1, 1) = int(self%requests, int64)
      words(n + 2 + comm%rank, 1) = transfer(self%speed_bound, 0_int64)
      words(n + 2 + comm%ranks + comm%rank, 1) = transfer(self%largest_push, 0_int64)
      if (allocated(self%bodies%limb)) then
         words(n + 2 + 2*comm%ranks:, 1) = reshape(self%bodies%limb, [size(self%bodies%limb)])
      end if
      call comm%sum(words)
      self%step_sums_type = transfer(words(:n, 1), self%step_sums_type)
      self%requests = int(words(n + 1, 1))
      self%speed_bound = maxval(transfer(words(n + 2:n + 1 + comm%ranks, 1), [0.0_wp]))
      self%largest_push = maxval(transfer(words(n + 2 + comm%ranks:n + 1 + 2*comm%ranks, 1), &
         & [0.0_wp]))
      if (.not. allocated(self%bodies%limb)) return
      self%bodies%limb(:, :) = reshape(words(n + 2 + 2*comm%ranks:, 1), shape(self%bodies%limb))
   end subroutine sum_over_ranks

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

end module plydyn_method_global_reduction
