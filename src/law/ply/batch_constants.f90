!> Constants of the ply-damage law over the lanes of a batch.
module plydyn_law_ply_batch_constants
   use plydyn_base_precision, only : lanes, wp
   use plydyn_law_ply_damage_onset, only : onset_type
   use plydyn_law_ply_constants, only : ply_constants_type
   use plydyn_law_ply_secant, only : secant_type
   use plydyn_law_ply_batch_shear, only : batch_shear_type
   implicit none
   private

   !> Constants of the lanes
   type, public :: ply_batch_constants_type
      !> 1 in lanes that the law owns, else 0; whether it owns all
      real(wp) :: own(lanes) = 0.0_wp
      logical :: whole = .false.
      !> Stiffness, curve of shear, onset of damage
      type(secant_type) :: secant
      type(batch_shear_type) :: curve
      type(onset_type) :: onset
      !> Share of the strength that crushed fibres keep, and crushed matrix: none
      real(wp) :: plateau(lanes, 2) = 0.0_wp
      !> Share of the strength from which their stress drops to zero
      real(wp) :: brittle(lanes, 2) = 0.0_wp
      !> Least integrity
      real(wp) :: residual(lanes) = 1.0_wp
      !> 1 in lanes where tension and compression have damage of their own; whether in any
      real(wp) :: closes(lanes) = 0.0_wp
      logical :: any_closes = .false.
      !> 1 in lanes where onset is by the stress of an intact ply; whether in any
      real(wp) :: intact(lanes) = 0.0_wp
      logical :: any_intact = .false.
      !> Whether the strengths of any lane scatter
      logical :: any_scatters = .false.
      !> History variables before the factors of the strengths of fibres and of matrix; 0 where no
      !> strength scatters
      integer :: factors = 0
   contains
      procedure :: set_lane
   end type ply_batch_constants_type

contains

   !> Give a lane its ply; it is the law's own from then on
   pure subroutine set_lane(self, lane, constants)
      class(ply_batch_constants_type), intent(inout) :: self
      !> Lane
      integer, intent(in) :: lane
      !> Its ply, checked
      class(ply_constants_type), intent(in) :: constants

      self%own(lane) = 1.0_wp
      self%whole = all(self%own > 0.0_wp)
      call self%secant%set_lane(lane, constants%young, constants%poisson, constants%shear)
      if (.not. constants%weakens_across) call self%secant%keep_across(lane)
      call self%curve%set_lane(lane, constants%shear(1), constants%curve)
      call self%onset%set_lane(lane, constants)
      self%plateau(lane, 1) = constants%plateau
      self%brittle(lane, 1) = constants%brittle
      self%residual(lane) = constants%residual
      self%closes(lane) = merge(1.0_wp, 0.0_wp, constants%closes)
      self%any_closes = any(self%closes > 0.0_wp)
      self%intact(lane) = merge(1.0_wp, 0.0_wp, constants%intact_onset)
      self%any_intact = any(self%intact > 0.0_wp)
      self%any_scatters = self%any_scatters .or. constants%scatter%scatters()
   end subroutine set_lane

end module plydyn_law_ply_batch_constants
