!> The history of delamination, JOB.delamination.csv: areas and energy of every interface that can
!> fail.
module plydyn_io_csv_delamination_history
   use plydyn_base_error, only : error_type
   use plydyn_base_precision, only : wp
   use plydyn_base_text, only : text
   use plydyn_domain_delamination, only : delamination, delamination_type, failing_interfaces, &
      & projected_areas
   use plydyn_io_csv_history_recorder, only : history_recorder_type
   use plydyn_io_job, only : job_type
   use plydyn_method_simulation, only : simulation_type
   implicit none
   private

   !> The history
   type, public, extends(history_recorder_type) :: delamination_history_type
      private
      !> Interfaces that can fail, counted from the bottom
      integer, allocatable :: interfaces(:)
   contains
      procedure :: open => open_delamination
      procedure :: record => record_delamination
   end type delamination_history_type

contains

   !> Create the file, if something can fail
   subroutine open_delamination(self, job, simulation, error)
      class(delamination_history_type), intent(inout) :: self
      type(job_type), intent(in) :: job
      class(simulation_type), intent(in) :: simulation
      type(error_type), allocatable, intent(out) :: error

      character(40), allocatable :: names(:), units(:)
      integer :: i, n

      self%interfaces = failing_interfaces(simulation%domain)
      n = size(self%interfaces)
      if (n == 0) return
      self%reads_motion = .false.
      allocate (names(3*n + 5), units(3*n + 5))
      associate (u => simulation%model%control%units)
         names([1, n + 2, n + 3]) = [character(40) :: "time", "sum", "projected area"]
         do i = 1, n
            names(1 + i) = "interface "//text(self%interfaces(i))//" area"
            names(3 + n + i) = "interface "//text(self%interfaces(i))//" energy"
            names(3 + 2*n + i) = "interface "//text(self%interfaces(i))//" failed area"
         end do
         names(3*n + 4:) = [character(40) :: "failed sum", "projected failed area"]
         units(1) = u%time
         units(2:) = trim(u%length)//"2"
         units(n + 4:2*n + 3) = u%energy
      end associate
      call self%open_file(job, simulation, ".delamination.csv", names, units, &
         & simulation%model%request%delamination_interval, error)
   end subroutine open_delamination

   !> Add a line
   subroutine record_delamination(self, simulation, error)
      class(delamination_history_type), intent(inout) :: self
      class(simulation_type), intent(in) :: simulation
      type(error_type), allocatable, intent(out) :: error

      type(delamination_type), allocatable :: all_lost(:)
      real(wp) :: projected(2)

      associate (history => simulation%state%history)
         all_lost = delamination(simulation%domain, history)
         projected(:) = projected_areas(simulation%domain, history)
      end associate
      associate (lost => all_lost(self%interfaces))
         call self%write_line([simulation%state%time, lost%delaminated, sum(lost%delaminated), &
            & projected(1), lost%fracture + lost%closing + lost%friction, lost%failed, &
            & sum(lost%failed), projected(2)], error)
      end associate
   end subroutine record_delamination

end module plydyn_io_csv_delamination_history
