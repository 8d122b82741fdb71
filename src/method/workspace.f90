!> Work space of the method: threads, sums of chunks, and motion computed in advance.
!>
!> Accelerations of a chunk are in the cache when they are updated: its motion over the next step is
!> then computed at once, if no observer needs the motion at the end of this step. The bandwidth of
!> the memory saves the second pass over all points. Only modules of the method use it.
module plydyn_method_workspace
   use plydyn_base_memory, only : prefer_large_pages
   use plydyn_base_precision, only : wp
   use plydyn_domain_domain, only : domain_type
   use plydyn_method_constraints, only : constraint_work_type, new_constraint_work
   use plydyn_method_step_control, only : leapfrog_coefficients_type
   use plydyn_parallel_thread_team, only : new_thread_team, thread_team_type
   use plydyn_state_state, only : motion_sums_type, state_type
   implicit none
   private

   public :: new_workspace

   !> Sums over the points of a chunk
   type, public, extends(motion_sums_type) :: chunk_sums_type
      !> Bound on every component of the velocity over the step to come
      real(wp) :: speed_bound = 0.0_wp
   end type chunk_sums_type

   !> All that the method needs beside domain, contacts and state
   type, public :: workspace_type
      !> The threads of a step
      type(thread_team_type) :: team
      !> Sums over the points that this rank counts in each chunk
      type(chunk_sums_type), allocatable :: chunk_sums(:)
      !> Numbers of the linear constraints
      type(constraint_work_type) :: constraints
      !> Time of the accelerations to come, and the step that ends there
      real(wp) :: time = 0.0_wp, step = 0.0_wp
      !> Coefficients of the step after it
      type(leapfrog_coefficients_type) :: next
      !> Whether the motion of the step under way was computed with the accelerations before, and
      !> whether that of the next step will be computed with the accelerations to come
      logical :: is_predicted = .false., predicts_next = .false.
   end type workspace_type

contains

   !> Work space for accelerations at the time of a state, whose arrays get large pages
   subroutine new_workspace(domain, state, self)
      type(domain_type), intent(in) :: domain
      type(state_type), intent(in) :: state
      type(workspace_type), intent(out) :: self

      integer, allocatable :: places(:, :)
      integer :: b

      call new_thread_team(domain%chunks%order, domain%chunks%outer, self%team)
      allocate (self%chunk_sums(size(domain%chunks%list)))
      self%constraints = new_constraint_work(domain)
      self%time = state%time
      self%step = state%step_before
      call prefer_large_pages(state%displacement)
      call prefer_large_pages(state%velocity)
      call prefer_large_pages(state%acceleration)
      ! of what only damaged points have, small pages take memory where there are some
      places = domain%intact_histories()
      do b = 1, size(places, 2)
         call prefer_large_pages(state%history(places(1, b):places(2, b)))
      end do
      call prefer_large_pages(domain%inertia%mass)
      call prefer_large_pages(domain%inertia%inverse_mass)
   end subroutine new_workspace

end module plydyn_method_workspace
