!> Factors of the strengths of plies at the Gauss points of a plate.
module plydyn_element_plate_strength_factors
   use plydyn_base_precision, only : lanes, wp
   use plydyn_element_plate_layers, only : layer_batch_type, plate_type
   use plydyn_fem_quad_points, only : quad_points
   use plydyn_model_layers, only : layers_type, new_layers
   use plydyn_model_model, only : model_type
   implicit none
   private

   public :: find_factors

contains

   !> Find the factors of all layers of a plate that has its quads
   pure subroutine find_factors(model, part, plate)
      !> The model
      type(model_type), intent(in) :: model
      !> Index of the part
      integer, intent(in) :: part
      !> The plate
      type(plate_type), intent(inout) :: plate

      type(layers_type) :: layers
      integer :: b

      if (.not. any_scatters(model, part)) return
      layers = new_layers(model%parts(part))
      do b = 1, size(plate%batches)
         call find_batch_factors(model, part, layers%ply, plate%quad, plate%batches(b))
      end do
   end subroutine find_factors

   !> Whether the strengths of any ply of a part scatter
   pure logical function any_scatters(model, part)
      type(model_type), intent(in) :: model
      integer, intent(in) :: part
      integer :: k, material

      any_scatters = .false.
      do k = 1, size(model%parts(part)%plies)
         material = model%parts(part)%plies(k)%material
         any_scatters = any_scatters .or. model%materials(material)%law%scatter%scatters()
      end do
   end function any_scatters

   !> Find the factors of the layers of one order
   pure subroutine find_batch_factors(model, part, ply_of_layer, quad, batch)
      type(model_type), intent(in) :: model
      integer, intent(in) :: part
      !> Ply of each layer of the part
      integer, intent(in) :: ply_of_layer(:)
      !> Quads of the mesh
      integer, intent(in) :: quad(:)
      type(layer_batch_type), intent(inout) :: batch

      real(wp) :: place(2, size(model%mesh%quad_node, 1))
      integer :: b, e, l, material, ply, q

      allocate (batch%factor(lanes, 2, size(place, 2), batch%blocks, size(quad)), source=1.0_wp)
      do e = 1, size(quad)
         place(:, :) = quad_points(model%mesh%position(:2, model%mesh%quad_node(:, quad(e))), &
            & .false.)
         do b = 1, batch%blocks
            do q = 1, size(place, 2)
               do l = 1, lanes
                  if (batch%layer(l, b) == 0) cycle
                  ply = ply_of_layer(batch%layer(l, b))
                  material = model%parts(part)%plies(ply)%material
                  batch%factor(l, :, q, b, e) = model%materials(material)%law%scatter%factors( &
                     & place(:, q), ply)
               end do
            end do
         end do
      end do
   end subroutine find_batch_factors

end module plydyn_element_plate_strength_factors
