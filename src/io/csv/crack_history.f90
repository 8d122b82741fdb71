!> The history of cracks, JOB.cracks.csv: length and energy of the cracks of every ply.
module plydyn_io_csv_crack_history
   use plydyn_base_text, only : text
   use plydyn_domain_crack_lengths, only : cracks_of_plies, ply_cracks_type
   use plydyn_io_csv_history_file, only : row_type
   use plydyn_io_csv_history_recorder, only : history_recorder_type
   use plydyn_method_simulation, only : simulation_type
   implicit none
   private

   !> The history
   type, public, extends(history_recorder_type) :: crack_history_type
   contains
      procedure :: prepare
      procedure :: put_columns
   end type crack_history_type

contains

   !> If there are crack lines
   subroutine prepare(self, simulation)
      class(crack_history_type), intent(inout) :: self
      class(simulation_type), intent(in) :: simulation

      if (simulation%domain%cracks%whole == 0) return
      self%ending = ".cracks.csv"
      self%interval = simulation%model%request%delamination_interval
      self%reads_motion = .false.
   end subroutine prepare

   subroutine put_columns(self, simulation, row)
      class(crack_history_type), intent(in) :: self
      class(simulation_type), intent(in) :: simulation
      type(row_type), intent(inout) :: row

      type(ply_cracks_type) :: cracks(size(simulation%domain%layers%ply))
      integer :: k

      if (.not. row%is_heading) cracks(:) = cracks_of_plies(simulation%domain, &
         & simulation%state%history)
      associate (unit => simulation%model%control%units)
         call row%put("time", unit%time, simulation%state%time)
         do k = 1, size(cracks)
            call row%put("ply "//text(k)//" length", unit%length, cracks(k)%length)
         end do
         call row%put("length", unit%length, sum(cracks%length))
         do k = 1, size(cracks)
            call row%put("ply "//text(k)//" energy", unit%energy, cracks(k)%fracture &
               & + cracks(k)%friction)
         end do
         call row%put("energy", unit%energy, sum(cracks%fracture + cracks%friction))
      end associate
   end subroutine put_columns

end module plydyn_io_csv_crack_history
