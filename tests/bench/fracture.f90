!> A line of points of eight plies with planes of fracture, in states that cost different work.
module plydyn_bench_fracture
   use fracture_point, only : fracture_ply
   use plydyn_bench_paths, only : line_points
   use plydyn_base_precision, only : lanes, wp
   use plydyn_law_ply_fracture_fracture, only : ply_fracture_type
   use plydyn_law_ply_fracture_history, only : histories
   implicit none
   private

   public :: prepare_fracture, update_fracture

   !> States: far from onset; torn open, below the strain reached; torn and sheared under pressure
   integer, parameter, public :: intact = 1, opened = 2, closed = 3
   !> Strain across the fibres far from onset, and at which cracks have been torn
   real(wp), parameter :: far_from_onset = 1.0e-3_wp, torn = 1.0e-2_wp
   !> Pressure and shear strain on closed cracks
   real(wp), parameter :: pressed = -1.0e-3_wp, sheared = 4.0e-3_wp
   !> Width of the crack band
   real(wp), parameter :: width = 1.0_wp

   type(ply_fracture_type) :: law
   real(wp) :: strain(lanes, 6, line_points), stress(lanes, 6, line_points)
   real(wp) :: history(lanes, line_points, histories)

contains

   !> Lead the line to a state
   subroutine prepare_fracture(state)
      !> Which
      integer, intent(in) :: state

      real(wp) :: h(lanes, histories), length(lanes, 2)
      integer :: l, m

      do l = 1, lanes
         call law%set_lane(l, fracture_ply())
      end do
      length(:, :) = width
      h(:, :) = 0.0_wp
      call law%start_history(length, length(:, 1), h)
      do m = 1, line_points
         history(:, m, :) = h
      end do
      stress(:, :, :) = 0.0_wp
      strain(:, :, :) = 0.0_wp
      strain(:, 2, :) = merge(far_from_onset, torn, state == intact)
      if (state == intact) return
      call update_fracture()
      strain(:, 2, :) = merge(0.9_wp*torn, pressed, state == opened)
      if (state == closed) strain(:, 4, :) = sheared
   end subroutine prepare_fracture

   !> Update the line
   subroutine update_fracture()
      call law%update_points(line_points, line_points, 0.0_wp, strain, history, stress)
   end subroutine update_fracture

end module plydyn_bench_fracture
