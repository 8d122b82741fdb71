!> The histories of damage that is a surface. JOB.delamination.csv has areas and energy of every
!> interface that can fail, JOB.cracks.csv length and energy of the cracks of every ply.
module plydyn_io_csv_damage_history
   use plydyn_base_precision, only : wp
   use plydyn_base_text, only : text
   use plydyn_domain_element_energies, only : cracks_of_plies, ply_cracks_type
   use plydyn_domain_delamination, only : delamination, delamination_type, failing_interfaces, &
      & projected_areas
   use plydyn_io_csv_history_file, only : row_type
   use plydyn_io_csv_history_recorder, only : history_recorder_type
   use plydyn_method_simulation, only : simulation_type
   implicit none
   private

   !> The history of delamination
   type, public, extends(history_recorder_type) :: delamination_history_type
      private
      !> Interfaces that can fail, counted from the bottom
      integer, allocatable :: interfaces(:)
   contains
      procedure :: prepare => prepare_delamination
      procedure :: put_columns => put_delamination
   end type delamination_history_type

   !> The history of cracks
   type, public, extends(history_recorder_type) :: crack_history_type
   contains
      procedure :: put_columns => put_cracks
   end type crack_history_type

contains

   !> If something can fail
   subroutine prepare_delamination(self, simulation)
      class(delamination_history_type), intent(inout) :: self
      class(simulation_type), intent(in) :: simulation

      self%interfaces = failing_interfaces(simulation%domain)
      if (size(self%interfaces) == 0) return
      self%ending = ".delamination.csv"
      self%interval = simulation%model%request%delamination_interval
      self%reads_motion = .false.
   end subroutine prepare_delamination

   subroutine put_delamination(self, simulation, row)
      class(delamination_history_type), intent(in) :: self
      class(simulation_type), intent(in) :: simulation
      type(row_type), intent(inout) :: row

      type(delamination_type) :: all_lost(maxval(simulation%domain%layers%ply) - 1)
      type(delamination_type) :: lost(size(self%interfaces))
      real(wp) :: projected(2)

      projected(:) = 0.0_wp
      if (.not. row%is_heading) then
         all_lost(:) = delamination(simulation%domain, simulation%state%history)
         lost(:) = all_lost(self%interfaces)
         projected(:) = projected_areas(simulation%domain, simulation%state%history)
      end if
      associate (unit => simulation%model%control%units)
         call row%put("time", unit%time, simulation%state%time)
         call put_each("interface ", self%interfaces, " area", unit%area(), lost%delaminated, row)
         call row%put("sum", unit%area(), sum(lost%delaminated))
         call row%put("projected area", unit%area(), projected(1))
         call put_each("interface ", self%interfaces, " energy", unit%energy, &
            & lost%fracture + lost%closing + lost%friction, row)
         call put_each("interface ", self%interfaces, " failed area", unit%area(), lost%failed, row)
         call row%put("failed sum", unit%area(), sum(lost%failed))
         call row%put("projected failed area", unit%area(), projected(2))
      end associate
   end subroutine put_delamination

   subroutine put_cracks(self, simulation, row)
      class(crack_history_type), intent(in) :: self
      class(simulation_type), intent(in) :: simulation
      type(row_type), intent(inout) :: row

      type(ply_cracks_type) :: cracks(size(simulation%domain%layers%ply))
      integer :: k, plies(size(cracks))

      plies(:) = [(k, k=1, size(cracks))]
      if (.not. row%is_heading) cracks(:) = cracks_of_plies(simulation%domain, &
         & simulation%state%history)
      associate (unit => simulation%model%control%units)
         call row%put("time", unit%time, simulation%state%time)
         call put_each("ply ", plies, " length", unit%length, cracks%length, row)
         call row%put("length", unit%length, sum(cracks%length))
         call put_each("ply ", plies, " energy", unit%energy, cracks%fracture &
            & + cracks%friction, row)
         call row%put("energy", unit%energy, sum(cracks%fracture + cracks%friction))
      end associate
   end subroutine put_cracks

   !> A column of each interface or ply
   subroutine put_each(kind, numbers, quantity, unit, values, row)
      !> What stands before its number; the numbers
      character(*), intent(in) :: kind
      integer, intent(in) :: numbers(:)
      !> What follows the number, and the unit
      character(*), intent(in) :: quantity, unit
      !> Value of each
      real(wp), intent(in) :: values(:)
      type(row_type), intent(inout) :: row
      integer :: i

      do i = 1, size(values)
         call row%put(kind//text(numbers(i))//quantity, unit, values(i))
      end do
   end subroutine put_each

end module plydyn_io_csv_damage_history
