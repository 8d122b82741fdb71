!> Points of plies that are not damaged and where no damage begins: most points, most of the time.
!>
!> They need a few columns of their history only, and change none while the shear stays within what
!> it has been. Everything else is left to the whole law, which finds the history as it was.
module plydyn_law_ply_quiet
   use plydyn_base_precision, only : lanes, wp
   use plydyn_law_damage_onset, only : onset_type
   use plydyn_law_ply_history, only : fibre_length, matrix_length, shear_energy, shear_peak, &
      & shear_set
   use plydyn_law_secant, only : secant_type
   use plydyn_law_shear_curve, only : shear_lanes_type
   implicit none
   private

   !> Lanes whose points may be quiet
   type, public :: quiet_type
      !> 1 in lanes that the law owns, else 0
      real(wp) :: own(lanes) = 0.0_wp
      !> Stiffness, curve of shear, onset of damage
      type(secant_type) :: secant
      type(shear_lanes_type) :: curve
      type(onset_type) :: onset
   contains
      procedure :: stay
   end type quiet_type

   !> Most points in a call, a line of a quad and the thickness: work space of fixed size can be
   !> aligned
   integer, parameter :: most_points = 15
   !> Below this, with room for round-off, the sums of points far from onset are below 1
   real(wp), parameter :: near = 0.99_wp

   !> What a quiet step makes of the shear in the plane
   type :: shear_type
      !> Sizes of the stress and of the elastic strain
      real(wp) :: size(lanes, 2, most_points)
      !> Largest strain, strain that stays, work spent on what stays
      real(wp) :: peak(lanes, most_points), set(lanes, most_points), work(lanes, most_points)
      !> Whether any of these changes
      logical :: grows
   end type shear_type

contains

   !> Stress of points at which no lane is damaged or begins to be in a step
   pure subroutine stay(self, points, histories, strain, history, stress, quiet)
      class(quiet_type), intent(in) :: self
      !> Number of points, `most_points` at most; history variables of each
      integer, intent(in) :: points, histories
      !> Total strain
      real(wp), intent(in) :: strain(lanes, 6, points)
      !> History; changes only at points that are quiet
      real(wp), intent(inout) :: history(lanes, histories, points)
      !> Stress of the lanes that the law owns; means nothing at points that are not quiet
      real(wp), intent(inout) :: stress(lanes, 6, points)
      !> Which points are quiet
      logical, intent(out) :: quiet(points)

      type(shear_type) :: shear
      real(wp) :: normal(lanes, 2, most_points)
      integer :: m

      call bend(self, points, histories, strain, history, shear)
      call give_stress(self, points, strain, shear, normal, stress)
      quiet(:) = are_far(self, points, histories, strain, history, shear, normal)
      if (.not. quiet(1)) then
         do m = 1, points
            quiet(m) = is_quiet(self, strain(:, 1:2, m), &
               & history(:, fibre_length:matrix_length, m), shear%size(:, :, m), normal(:, :, m))
         end do
      end if
      if (.not. shear%grows) return
      do m = 1, points
         if (quiet(m)) call keep_shear(self%own, shear%peak(:, m), shear%set(:, m), &
            & shear%work(:, m), history(:, shear_peak:shear_energy, m))
      end do
   end subroutine stay

   !> Whether no damage has begun, and all points are so far from it that little is needed to see it
   pure logical function are_far(self, points, histories, strain, history, shear, normal)
      type(quiet_type), intent(in) :: self
      integer, intent(in) :: points, histories
      real(wp), intent(in) :: strain(lanes, 6, points), history(lanes, histories, points)
      type(shear_type), intent(in) :: shear
      real(wp), intent(in) :: normal(lanes, 2, most_points)

      real(wp) :: across, along, each(lanes), fibre, matrix, most, square
      integer :: l, m

      each(:) = 0.0_wp
      do m = 1, points
         associate (f => self%onset%far_fibre, g => self%onset%far_matrix, t => shear%size)
            !$omp simd private(across, along, fibre, matrix, square)
            do l = 1, lanes
               fibre = history(l, fibre_length, m)
               square = normal(l, 1, m)*normal(l, 1, m)
               along = f(l, 1)*square &
                  & + fibre*(f(l, 2)*square + f(l, 3)*abs(normal(l, 1, m)*strain(l, 1, m)))
               matrix = history(l, matrix_length, m)
               square = normal(l, 2, m)*normal(l, 2, m)
               across = g(l, 1)*square + g(l, 2)*t(l, 1, m)*t(l, 1, m) + matrix*(g(l, 3)*square &
                  & + g(l, 4)*(abs(normal(l, 2, m)*strain(l, 2, m)) + t(l, 1, m)*t(l, 2, m)))
               each(l) = max(each(l), along, across, near - self%own(l)*fibre, &
                  & near - self%own(l)*matrix)
            end do
         end associate
      end do
      most = 0.0_wp
      !$omp simd reduction(max:most)
      do l = 1, lanes
         most = max(most, each(l))
      end do
      are_far = most <= near
   end function are_far

   !> Whether no damage has begun or begins at a point
   pure logical function is_quiet(self, strain, length, shear, normal)
      type(quiet_type), intent(in) :: self
      !> Strains 11 and 22, and widths of the crack band
      real(wp), intent(in) :: strain(lanes, 2), length(lanes, 2)
      !> Sizes of shear stress and elastic shear strain, stresses 11 and 22
      real(wp), intent(in) :: shear(lanes, 2), normal(lanes, 2)

      real(wp) :: excess(lanes, 2), least, most
      integer :: l

      least = 0.0_wp
      !$omp simd reduction(min:least)
      do l = 1, lanes
         least = min(least, self%own(l)*length(l, 1), self%own(l)*length(l, 2))
      end do
      is_quiet = least >= 0.0_wp
      if (.not. is_quiet) return
      call self%onset%find_onset(normal, strain, shear, length, excess)
      most = -1.0_wp
      !$omp simd reduction(max:most)
      do l = 1, lanes
         most = max(most, excess(l, 1), excess(l, 2))
      end do
      is_quiet = most < 0.0_wp
   end function is_quiet

   !> Shear along its curve
   pure subroutine bend(self, points, histories, strain, history, shear)
      type(quiet_type), intent(in) :: self
      integer, intent(in) :: points, histories
      real(wp), intent(in) :: strain(lanes, 6, points), history(lanes, histories, points)
      type(shear_type), intent(out) :: shear

      real(wp) :: size(lanes, most_points)
      integer :: l, m

      shear%grows = .false.
      if (.not. self%curve%bends) then
         do m = 1, points
            !$omp simd
            do l = 1, lanes
               shear%size(l, 2, m) = abs(strain(l, 4, m))
               shear%size(l, 1, m) = self%secant%shear(l, 1)*shear%size(l, 2, m)
            end do
         end do
         return
      end if
      do m = 1, points
         !$omp simd
         do l = 1, lanes
            size(l, m) = self%own(l)*abs(strain(l, 4, m))
            shear%peak(l, m) = self%own(l)*history(l, shear_peak, m)
            shear%set(l, m) = self%own(l)*history(l, shear_set, m)
         end do
      end do
      call self%curve%advance(points, size, shear%peak, shear%set, shear%work, shear%grows)
      do m = 1, points
         !$omp simd
         do l = 1, lanes
            shear%size(l, 2, m) = max(size(l, m) - shear%set(l, m), 0.0_wp)
            shear%size(l, 1, m) = self%secant%shear(l, 1)*shear%size(l, 2, m)
         end do
      end do
   end subroutine bend

   !> Stress of the lanes that the law owns
   pure subroutine give_stress(self, points, strain, shear, normal, stress)
      type(quiet_type), intent(in) :: self
      integer, intent(in) :: points
      real(wp), intent(in) :: strain(lanes, 6, points)
      type(shear_type), intent(in) :: shear
      !> Stresses 11 and 22 of all lanes
      real(wp), intent(out) :: normal(lanes, 2, most_points)
      real(wp), intent(inout) :: stress(lanes, 6, points)

      real(wp) :: s11, s22, s33, s12, s13, s23
      integer :: l, m

      do m = 1, points
         associate (own => self%own, c => self%secant%intact, g => self%secant%shear, &
            & e => strain(:, :, m), s => stress(:, :, m))
            !$omp simd private(s11, s22, s33, s12, s13, s23)
            do l = 1, lanes
               s11 = c(l, 1)*e(l, 1) + c(l, 2)*e(l, 2) + c(l, 3)*e(l, 3)
               s22 = c(l, 2)*e(l, 1) + c(l, 4)*e(l, 2) + c(l, 5)*e(l, 3)
               s33 = c(l, 3)*e(l, 1) + c(l, 5)*e(l, 2) + c(l, 6)*e(l, 3)
               s12 = sign(shear%size(l, 1, m), e(l, 4))
               s13 = g(l, 2)*e(l, 5)
               s23 = g(l, 3)*e(l, 6)
               normal(l, 1, m) = s11
               normal(l, 2, m) = s22
               s(l, 1) = merge(s11, s(l, 1), own(l) > 0.0_wp)
               s(l, 2) = merge(s22, s(l, 2), own(l) > 0.0_wp)
               s(l, 3) = merge(s33, s(l, 3), own(l) > 0.0_wp)
               s(l, 4) = merge(s12, s(l, 4), own(l) > 0.0_wp)
               s(l, 5) = merge(s13, s(l, 5), own(l) > 0.0_wp)
               s(l, 6) = merge(s23, s(l, 6), own(l) > 0.0_wp)
            end do
         end associate
      end do
   end subroutine give_stress

   !> Keep what the shear of a point has become, and what it has cost
   pure subroutine keep_shear(own, peak, set, work, history)
      real(wp), intent(in) :: own(lanes), peak(lanes), set(lanes), work(lanes)
      real(wp), intent(inout) :: history(lanes, shear_peak:shear_energy)

      real(wp) :: kept
      integer :: l

      !$omp simd private(kept)
      do l = 1, lanes
         kept = history(l, shear_peak)
         history(l, shear_peak) = merge(peak(l), kept, own(l) > 0.0_wp)
         kept = history(l, shear_set)
         history(l, shear_set) = merge(set(l), kept, own(l) > 0.0_wp)
         history(l, shear_energy) = history(l, shear_energy) + own(l)*work(l)
      end do
   end subroutine keep_shear

end module plydyn_law_ply_quiet
