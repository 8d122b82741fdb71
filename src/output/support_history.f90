!> Force of all supports on the plate, as a history.
module plydyn_output_support_history
   use plydyn_base_error, only : error_type
   use plydyn_base_precision, only : wp
   use plydyn_domain_domain, only : domain_type
   use plydyn_model_model, only : model_type
   use plydyn_output_job, only : job_type
   use plydyn_output_places, only : places_type
   use plydyn_output_recorder, only : recorder_type
   use plydyn_state_state, only : state_type
   implicit none
   private

   !> The history of the supports
   type, public, extends(recorder_type) :: support_history_type
      private
      !> Held and prescribed directions, in the order of `state%support_force`
      integer, allocatable :: direction(:)
   contains
      procedure :: open => open_supports
      procedure :: record => record_supports
   end type support_history_type

contains

   !> Create the file, if the deck asks for it
   subroutine open_supports(self, job, model, domain, error)
      class(support_history_type), intent(inout) :: self
      !> The job
      type(job_type), intent(in) :: job
      !> The model
      type(model_type), intent(in) :: model
      !> The domain
      type(domain_type), intent(in) :: domain
      !> Why it could not be created
      type(error_type), allocatable, intent(out) :: error

      character(4), parameter :: names(*) = [character(4) :: "time", "fx", "fy", "fz"]
      integer :: c, k, m, t

      allocate (self%direction(0))
      if (model%request%support_interval < 0.0_wp) return
      block
         integer :: direction(domain%columns%freedoms)

         direction(:) = 0
         do k = 1, size(domain%layers%order)
            do t = 1, domain%columns%levels(k)
               do c = 1, 3
                  direction(domain%columns%freedom(k, t, c, [(m, m=1, domain%columns%nodes)])) = c
               end do
            end do
         end do
         self%direction = direction(domain%held)
         do m = 1, size(domain%motions)
            self%direction = [self%direction, &
               & direction(domain%motions(m)%freedom)]
         end do
      end block
      associate (u => model%control%units)
         call self%history%open(job%path//".supports.csv", names, &
            & [u%time, u%force, u%force, u%force], model%request%support_interval, job%places, &
            & error)
      end associate
   end subroutine open_supports

   !> Add a line if one is due
   subroutine record_supports(self, state, is_last, error)
      class(support_history_type), intent(inout) :: self
      !> The state
      type(state_type), intent(in) :: state
      !> Whether the run ends here
      logical, intent(in) :: is_last
      !> Why it could not be written
      type(error_type), allocatable, intent(out) :: error

      integer :: c

      if (.not. self%history%is_open()) return
      if (.not. (self%history%due(state%time) .or. is_last)) return
      call self%history%record(state%time, [state%time, (-sum(state%support_force, &
         & self%direction == c), c=1, 3)], error)
   end subroutine record_supports

end module plydyn_output_support_history
