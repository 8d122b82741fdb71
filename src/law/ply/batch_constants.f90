!> Constants of the ply-damage law over the lanes of a batch.
module plydyn_law_ply_batch_constants
   use plydyn_base_precision, only : lanes, wp
   use plydyn_law_ply_damage_onset, only : onset_type
   use plydyn_law_ply_constants, only : ply_constants_type
   use plydyn_law_ply_fibre_lines, only : fibre_lines_type
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
      !> Lines on which fibres soften
      type(fibre_lines_type) :: lines
      !> Least integrity
      real(wp) :: residual(lanes) = 1.0_wp
      !> 1 in lanes where tension and compression have damage of their own; whether in any
      real(wp) :: closes(lanes) = 0.0_wp
      logical :: any_closes = .false.
   contains
      procedure :: set_lane
   end type ply_batch_constants_type

contains

   !> Give a lane its ply; it is the law's own from then on
   pure subroutine set_lane(self, lane, constants)
      class(ply_batch_constants_type), intent(inout) :: self
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
      call self%lines%set_lane(lane, constants%line_strength, constants%line_toughness)
      self%residual(lane) = constants%residual
      self%closes(lane) = merge(1.0_wp, 0.0_wp, constants%closes)
      self%any_closes = any(self%closes > 0.0_wp)
   end subroutine set_lane

end module plydyn_law_ply_batch_constants
