!> Force of all supports on the plate, as a history: a sum over what all ranks count, without
!> round-off, written by the root.
module plydyn_output_support_history
   use plydyn_base_error, only : error_type
   use plydyn_base_exact_sum, only : exact_sums_type, new_exact_sums
   use plydyn_base_precision, only : wp
   use plydyn_domain_domain, only : domain_type
   use plydyn_model_model, only : model_type
   use plydyn_output_counted, only : counted_columns
   use plydyn_output_job, only : job_type
   use plydyn_output_places, only : places_type
   use plydyn_output_recorder, only : recorder_type
   use plydyn_parallel_comm, only : comm_type
   use plydyn_state_state, only : state_type
   implicit none
   private

   !> The history of the supports
   type, public, extends(recorder_type) :: support_history_type
      private
      !> The ranks
      type(comm_type) :: comm
      !> Held and prescribed directions, in the order of `state%support_force`; 0 where another rank
      !> counts the point
      integer, allocatable :: direction(:)
   contains
      procedure :: open => open_supports
      procedure :: record => record_supports
   end type support_history_type

contains

   !> Find the directions, and let the root create the file, if the deck asks for it
   subroutine open_supports(self, job, model, domain, error)
      class(support_history_type), intent(inout) :: self
      !> The job
      type(job_type), intent(in) :: job
      !> The model
      type(model_type), intent(in) :: model
      !> The domain of this rank
      type(domain_type), intent(in) :: domain
      !> Why it could not be created
      type(error_type), allocatable, intent(out) :: error

      character(4), parameter :: names(*) = [character(4) :: "time", "fx", "fy", "fz"]

      self%comm = domain%comm
      allocate (self%direction(0))
      if (model%request%support_interval < 0.0_wp) return
      self%direction = directions_of_supports(domain)
      if (.not. self%comm%is_root()) return
      associate (u => model%control%units)
         call self%history%open(job%path//".supports.csv", names, &
            & [u%time, u%force, u%force, u%force], model%request%support_interval, job%places, &
            & error)
      end associate
   end subroutine open_supports

   !> Direction of each held and prescribed point, 0 where this rank does not count it
   pure function directions_of_supports(domain) result(held)
      type(domain_type), intent(in) :: domain
      integer, allocatable :: held(:)

      integer :: direction(domain%columns%freedoms)
      logical :: is_counted(domain%columns%count)
      integer :: c, k, m, t

      is_counted(:) = counted_columns(domain)
      direction(:) = 0
      do k = 1, size(domain%layers%order)
         do t = 1, domain%columns%levels(k)
            do c = 1, 3
               direction(domain%columns%freedom(k, t, c, [(m, m=1, domain%columns%nodes)])) = c
            end do
         end do
      end do
      do k = 1, size(direction)
         if (direction(k) == 0) cycle
         if (.not. is_counted(domain%columns%column_of(k))) direction(k) = 0
      end do
      held = direction(domain%held)
      do m = 1, size(domain%motions)
         held = [held, direction(domain%motions(m)%freedom)]
      end do
   end function directions_of_supports

   !> Add a line. All ranks must come here
   subroutine record_supports(self, state, error)
      class(support_history_type), intent(inout) :: self
      !> The state of this rank
      type(state_type), intent(in) :: state
      !> Why it could not be written; the same on all ranks
      type(error_type), allocatable, intent(out) :: error

      type(exact_sums_type) :: sums
      integer :: c, i

      sums = new_exact_sums(3)
      do i = 1, size(self%direction)
         if (self%direction(i) > 0) call sums%add(self%direction(i), -state%support_force(i))
      end do
      call self%comm%add_up(sums%limb)
      if (self%comm%is_root()) call self%history%record(state%time, [state%time, &
         & (sums%value(c), c=1, 3)], error)
      call self%comm%tell(error)
   end subroutine record_supports

end module plydyn_output_support_history
