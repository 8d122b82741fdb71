!> Points of plies that are not damaged and where no damage begins: most points, most of the time.
!>
!> They need a few columns of their history only, and change none while the shear stays within what
!> it has been. Everything else is left to the whole law, which finds the history as it was.
module plydyn_law_ply_quiet
   use plydyn_base_precision, only : lanes, wp
   use plydyn_law_damage_onset, only : onset_type
   use plydyn_law_ply_history, only : fibre_length, histories_closing, histories_open, &
      & matrix_length, shear_energy, shear_peak, shear_set
   use plydyn_law_secant, only : secant_type
   use plydyn_law_shear_curve, only : shear_lanes_type
   implicit none
   private

   !> Lanes whose points may be quiet
   type, public :: quiet_type
      !> 1 in lanes that the law owns, else 0
      real(wp) :: own(lanes) = 0.0_wp
      !> Whether compression has damage of its own in any lane
      logical :: closes = .false.
      !> Stiffness, curve of shear, onset of damage
      type(secant_type) :: secant
      type(shear_lanes_type) :: curve
      type(onset_type) :: onset
   contains
      procedure :: stay
   end type quiet_type

   !> Most points of a layer above each other: work space of fixed size can be aligned
   integer, parameter :: most_points = 5

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

   !> Stress of a step in which no lane of any point is damaged or begins to be
   pure subroutine stay(self, points, histories, strain, history, stress, quiet)
      class(quiet_type), intent(in) :: self
      !> Number of points, `most_points` at most; history variables of each
      integer, intent(in) :: points, histories
      !> Total strain
      real(wp), intent(in) :: strain(lanes, 6, points)
      !> History; changes only where the step is quiet
      real(wp), intent(inout) :: history(lanes, histories, points)
      !> Stress of the lanes that the law owns; means nothing unless quiet
      real(wp), intent(inout) :: stress(lanes, 6, points)
      !> Whether the step is quiet
      logical, intent(out) :: quiet

      type(shear_type) :: shear
      real(wp) :: normal(lanes, 2, most_points)

      quiet = is_whole(self, points, histories, history)
      if (.not. quiet) return
      call bend(self, points, histories, strain, history, shear)
      call give_stress(self, points, strain, shear, normal, stress)
      quiet = .not. begins(self, points, histories, strain, history, shear, normal)
      if (quiet .and. shear%grows) call keep_shear(self, points, histories, shear, history)
   end subroutine stay

   !> Whether no damage has begun
   pure logical function is_whole(self, points, histories, history)
      type(quiet_type), intent(in) :: self
      integer, intent(in) :: points, histories
      real(wp), intent(in) :: history(lanes, histories, points)

      real(wp) :: each(lanes), least
      integer :: l, m

      each(:) = 0.0_wp
      do m = 1, points
         !$omp simd
         do l = 1, lanes
            each(l) = min(each(l), self%own(l)*history(l, fibre_length, m), &
               & self%own(l)*history(l, matrix_length, m))
         end do
      end do
      least = 0.0_wp
      !$omp simd reduction(min:least)
      do l = 1, lanes
         least = min(least, each(l))
      end do
      is_whole = least >= 0.0_wp
   end function is_whole

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

   !> Whether damage begins
   pure logical function begins(self, points, histories, strain, history, shear, normal)
      type(quiet_type), intent(in) :: self
      integer, intent(in) :: points, histories
      real(wp), intent(in) :: strain(lanes, 6, points), history(lanes, histories, points)
      type(shear_type), intent(in) :: shear
      real(wp), intent(in) :: normal(lanes, 2, most_points)

      real(wp) :: each(lanes), excess(lanes, 2), most
      integer :: l, m

      each(:) = -1.0_wp
      do m = 1, points
         call self%onset%find_onset(normal(:, :, m), strain(:, 1:2, m), shear%size(:, :, m), &
            & history(:, fibre_length:matrix_length, m), excess)
         !$omp simd
         do l = 1, lanes
            each(l) = max(each(l), excess(l, 1), excess(l, 2))
         end do
      end do
      most = -1.0_wp
      !$omp simd reduction(max:most)
      do l = 1, lanes
         most = max(most, each(l))
      end do
      begins = most >= 0.0_wp
   end function begins

   !> Keep what the shear has become, and what it has cost
   pure subroutine keep_shear(self, points, histories, shear, history)
      type(quiet_type), intent(in) :: self
      integer, intent(in) :: points, histories
      type(shear_type), intent(in) :: shear
      real(wp), intent(inout) :: history(lanes, histories, points)

      real(wp) :: kept
      integer :: l, last, m

      last = merge(histories_closing, histories_open, self%closes)
      do m = 1, points
         associate (own => self%own, h => history(:, :, m))
            !$omp simd private(kept)
            do l = 1, lanes
               kept = h(l, shear_peak)
               h(l, shear_peak) = merge(shear%peak(l, m), kept, own(l) > 0.0_wp)
               kept = h(l, shear_set)
               h(l, shear_set) = merge(shear%set(l, m), kept, own(l) > 0.0_wp)
               h(l, shear_energy) = h(l, shear_energy) + own(l)*shear%work(l, m)
               kept = h(l, last)
               h(l, last) = merge(h(l, shear_energy), kept, own(l) > 0.0_wp)
            end do
         end associate
      end do
   end subroutine keep_shear

end module plydyn_law_ply_quiet
