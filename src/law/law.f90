!> What every material law of a point is: constants, and an update over a batch.
!>
!> The lanes of a batch are layers with materials of their own, so constants are arrays over the
!> lanes, and a law works on the lanes it owns. Strain and stress are those of the ply axes, in the
!> order 11, 22, 33, 12, 13, 23 with engineering shear.
module plydyn_law_law
   use plydyn_base_precision, only : lanes, wp
   implicit none
   private

   !> A law with the constants of one batch
   type, abstract, public :: law_type
      !> Lanes that have this law
      logical :: owns(lanes) = .false.
      !> History variables of a point; the last is always the energy dissipated so far per volume
      integer :: histories = 0
      !> History variable that is the effective plastic strain; 0 for none
      integer :: plastic_strain_at = 0
   contains
      procedure(update_batch), deferred :: update
      procedure :: recall
   end type law_type

   !> The law of some lanes of one block of layers
   type, public :: block_law_type
      !> Block of the batch
      integer :: block = 0
      !> The law
      class(law_type), allocatable :: law
   end type block_law_type

   abstract interface
      !> Stress at the end of a step, and the history with it
      pure subroutine update_batch(self, step, strain, history, stress)
         import :: lanes, law_type, wp
         implicit none
         class(law_type), intent(in) :: self
         !> Time step, for laws with rates; 0 where there is none
         real(wp), intent(in) :: step
         !> Total strain, (lanes, 6)
         real(wp), intent(in) :: strain(lanes, 6)
         !> History of the point, old in and new out, (lanes, histories); zero at time zero
         real(wp), intent(inout) :: history(lanes, *)
         !> Stress; lanes of other laws keep theirs
         real(wp), intent(inout) :: stress(lanes, 6)
      end subroutine update_batch
   end interface

contains

   !> Stress that belongs to a strain and its history: nothing goes on
   pure subroutine recall(self, strain, history, stress)
      class(law_type), intent(in) :: self
      !> Total strain
      real(wp), intent(in) :: strain(lanes, 6)
      !> History of the point
      real(wp), intent(in) :: history(lanes, *)
      !> Stress; lanes of other laws keep theirs
      real(wp), intent(inout) :: stress(lanes, 6)

      real(wp) :: copy(lanes, self%histories)

      copy(:, :) = history(:, :self%histories)
      call self%update(0.0_wp, strain, copy, stress)
   end subroutine recall

end module plydyn_law_law
