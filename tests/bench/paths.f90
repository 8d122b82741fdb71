!> A line of points of eight plies, updated by each path of the ply-damage law.
module plydyn_bench_paths
   use plydyn_base_precision, only : lanes, wp
   use plydyn_law_ply_batch_constants, only : ply_batch_constants_type
   use plydyn_law_ply_damage, only : ply_damage_type
   use plydyn_law_ply_history, only : histories_open, load_lanes, store_lanes
   use plydyn_law_ply_no_growth_path, only : update_without_growth
   use plydyn_law_ply_shear_path, only : shear_type, update_shear
   use ply_point, only : paper_ply
   implicit none
   private

   public :: prepare_paths, update_by_path

   !> The paths
   integer, parameter, public :: elastic_path = 1, no_growth_path = 2, whole_law = 3
   !> Points of a line of a quad of nine nodes, order 2
   integer, parameter, public :: line_points = 9
   !> Strain across the fibres beyond onset, and far from it
   real(wp), parameter :: beyond_onset = 1.0e-2_wp, far_from_onset = 1.0e-3_wp
   !> Width of the crack band
   real(wp), parameter :: width = 1.0_wp

   type(ply_damage_type) :: law
   type(ply_batch_constants_type) :: ply
   real(wp) :: strain(lanes, 6, line_points), stress(lanes, 6, line_points)
   real(wp) :: history(lanes, line_points, histories_open)

contains

   !> Intact points far from onset, or points with matrix cracks below the strain reached
   subroutine prepare_paths(damaged)
      logical, intent(in) :: damaged

      real(wp) :: h(lanes, histories_open), length(lanes, 2)
      integer :: l, m

      do l = 1, lanes
         call law%set_lane(l, paper_ply())
         call ply%set_lane(l, paper_ply())
      end do
      length(:, :) = width
      call law%start_history(length, length(:, 1), h)
      do m = 1, line_points
         history(:, m, :) = h
      end do
      stress(:, :, :) = 0.0_wp
      strain(:, :, :) = 0.0_wp
      if (damaged) then
         strain(:, 2, :) = beyond_onset
         call law%update_points(line_points, line_points, 0.0_wp, strain, history, stress)
         strain(:, 2, :) = 0.9_wp*beyond_onset
      else
         strain(:, 2, :) = far_from_onset
      end if
   end subroutine prepare_paths

   !> Update the line by a path: the law itself takes the elastic path where points are intact
   subroutine update_by_path(path)
      integer, intent(in) :: path

      real(wp) :: e(lanes, 6), h(lanes, histories_open), s(lanes, 6)
      type(shear_type) :: shear
      logical :: updated(line_points)
      integer :: m

      select case (path)
      case (elastic_path)
         call law%update_points(line_points, line_points, 0.0_wp, strain, history, stress)
      case (no_growth_path)
         call update_shear(ply, line_points, line_points, strain, history, shear)
         shear%begun = .true.
         call update_without_growth(ply, line_points, line_points, strain, history, shear, stress, &
            & updated)
         if (.not. all(updated)) error stop "damage grows in a bench without growth"
      case default
         do m = 1, line_points
            call load_lanes(ply%own, line_points, histories_open, strain(:, :, m), &
               & history(1, m, 1), e, h)
            call law%update_point(e, h, s)
            call store_lanes(ply%own, line_points, histories_open, h, s, history(1, m, 1), &
               & stress(:, :, m))
         end do
      end select
   end subroutine update_by_path

end module plydyn_bench_paths
