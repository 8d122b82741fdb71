!> Correlation lengths of strengths that scatter, beside the size of the mesh.
module plydyn_input_check_scatter_length
   use plydyn_base_precision, only : wp
   use plydyn_base_text, only : text
   use plydyn_deck_cards, only : cards_type
   use plydyn_input_catalogue, only : catalogue_type
   use plydyn_law_scatter, only : period
   use plydyn_model_mesh, only : mesh_type
   implicit none
   private

   public :: check_scatter_length

contains

   !> Refuse a length so short that the field of strengths repeats itself on the plate, where it
   !> would be the same at all points in the end
   subroutine check_scatter_length(cards, nth, catalogue, mesh)
      !> A keyword with the field LENGTH, and the row
      type(cards_type), intent(in) :: cards
      integer, intent(in) :: nth
      !> Gets the finding
      type(catalogue_type), intent(inout) :: catalogue
      !> Nodes, which have been read
      type(mesh_type), intent(in) :: mesh

      real(wp) :: farthest

      if (.not. cards%is_fine("LENGTH", nth)) return
      farthest = maxval(abs(mesh%position(:2, :)))
      if (farthest < 0.5_wp*period*cards%real("LENGTH", nth)) return
      call catalogue%refuse(cards, "LENGTH", "the strengths cannot scatter over " &
         & //text(cards%real("LENGTH", nth))//" on nodes at up to "//text(farthest), &
         & "a length that is not far below the sides of the quads", nth)
   end subroutine check_scatter_length

end module plydyn_input_check_scatter_length
