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
   contains
      procedure :: stay
   end type quiet_type

   !> What a quiet step makes of the shear in the plane
   type :: shear_type
      !> Sizes of the stress and of the elastic strain
      real(wp) :: size(lanes, 2)
      !> Largest strain, strain that stays, work spent on what stays
      real(wp) :: peak(lanes), set(lanes), work(lanes)
      !> Whether any of these changes
      logical :: grows
   end type shear_type

contains

   !> Stress of a step in which no lane is damaged or begins to be
   pure subroutine stay(self, secant, curve, onset, strain, history, stress, quiet)
      class(quiet_type), intent(in) :: self
      !> Stiffness, curve of shear, onset of damage
      type(secant_type), intent(in) :: secant
      type(shear_lanes_type), intent(in) :: curve
      type(onset_type), intent(in) :: onset
      !> Total strain
      real(wp), intent(in) :: strain(lanes, 6)
      !> History; changes only where the step is quiet
      real(wp), intent(inout) :: history(lanes, *)
      !> Stress of the lanes that the law owns; untouched unless quiet
      real(wp), intent(inout) :: stress(lanes, 6)
      !> Whether the step is quiet
      logical, intent(out) :: quiet

      type(shear_type) :: shear
      real(wp) :: excess(lanes, 2), most, normal(lanes, 3)
      integer :: l

      quiet = is_whole(self, history)
      if (.not. quiet) return
      call bend(secant, curve, self%own, strain(:, 4), history, shear)
      call secant%intact_stress(strain(:, 1:3), normal)
      call onset%find_onset(normal(:, 1:2), strain(:, 1:2), shear%size, &
         & history(:, fibre_length:matrix_length), excess)
      most = -1.0_wp
      !$omp simd reduction(max:most)
      do l = 1, lanes
         most = max(most, excess(l, 1), excess(l, 2))
      end do
      quiet = most < 0.0_wp
      if (.not. quiet) return
      if (shear%grows) call keep_shear(self, shear, history)
      call give_stress(secant, self%own, strain, normal, shear%size(:, 1), stress)
   end subroutine stay

   !> Whether no damage has begun
   pure logical function is_whole(self, history)
      type(quiet_type), intent(in) :: self
      real(wp), intent(in) :: history(lanes, *)

      real(wp) :: least
      integer :: l

      least = 0.0_wp
      !$omp simd reduction(min:least)
      do l = 1, lanes
         least = min(least, self%own(l)*history(l, fibre_length), &
            & self%own(l)*history(l, matrix_length))
      end do
      is_whole = least >= 0.0_wp
   end function is_whole

   !> Shear along its curve
   pure subroutine bend(secant, curve, own, strain, history, shear)
      type(secant_type), intent(in) :: secant
      type(shear_lanes_type), intent(in) :: curve
      real(wp), intent(in) :: own(lanes), strain(lanes), history(lanes, *)
      type(shear_type), intent(out) :: shear

      real(wp) :: size(lanes)
      integer :: l

      shear%grows = .false.
      if (.not. curve%bends) then
         !$omp simd
         do l = 1, lanes
            shear%size(l, 2) = abs(strain(l))
            shear%size(l, 1) = secant%shear(l, 1)*shear%size(l, 2)
         end do
         return
      end if
      !$omp simd
      do l = 1, lanes
         size(l) = own(l)*abs(strain(l))
         shear%peak(l) = own(l)*history(l, shear_peak)
         shear%set(l) = own(l)*history(l, shear_set)
      end do
      call curve%advance(size, spread(0.0_wp, 1, lanes), shear%peak, shear%set, shear%work, &
         & shear%grows)
      !$omp simd
      do l = 1, lanes
         shear%size(l, 2) = max(size(l) - shear%set(l), 0.0_wp)
         shear%size(l, 1) = secant%shear(l, 1)*shear%size(l, 2)
      end do
   end subroutine bend

   !> Keep what the shear has become, and what it has cost
   pure subroutine keep_shear(self, shear, history)
      type(quiet_type), intent(in) :: self
      type(shear_type), intent(in) :: shear
      real(wp), intent(inout) :: history(lanes, *)

      real(wp) :: kept
      integer :: l, last

      last = merge(histories_closing, histories_open, self%closes)
      !$omp simd private(kept)
      do l = 1, lanes
         kept = history(l, shear_peak)
         history(l, shear_peak) = merge(shear%peak(l), kept, self%own(l) > 0.0_wp)
         kept = history(l, shear_set)
         history(l, shear_set) = merge(shear%set(l), kept, self%own(l) > 0.0_wp)
         history(l, shear_energy) = history(l, shear_energy) + self%own(l)*shear%work(l)
         kept = history(l, last)
         history(l, last) = merge(history(l, shear_energy), kept, self%own(l) > 0.0_wp)
      end do
   end subroutine keep_shear

   !> Stress of the lanes that the law owns
   pure subroutine give_stress(secant, own, strain, normal, shear, stress)
      type(secant_type), intent(in) :: secant
      real(wp), intent(in) :: own(lanes), strain(lanes, 6), normal(lanes, 3), shear(lanes)
      real(wp), intent(inout) :: stress(lanes, 6)

      real(wp) :: new(6)
      integer :: k, l

      !$omp simd private(k, new)
      do l = 1, lanes
         new(1) = normal(l, 1)
         new(2) = normal(l, 2)
         new(3) = normal(l, 3)
         new(4) = sign(shear(l), strain(l, 4))
         new(5) = secant%shear(l, 2)*strain(l, 5)
         new(6) = secant%shear(l, 3)*strain(l, 6)
         do k = 1, 6
            stress(l, k) = merge(new(k), stress(l, k), own(l) > 0.0_wp)
         end do
      end do
   end subroutine give_stress

end module plydyn_law_ply_quiet
