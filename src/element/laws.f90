!> Laws of the layers, batch by batch.
module plydyn_element_laws
   use plydyn_base_precision, only : lanes
   use plydyn_law_law, only : block_law_type
   use plydyn_model_material, only : material_type
   implicit none
   private

   public :: new_laws

contains

   !> Laws of a batch of layers; none if all its materials are elastic
   function new_laws(materials, lane_material) result(laws)
      !> Materials of the model
      type(material_type), intent(in) :: materials(:)
      !> Material of each lane, 0 where there is no layer, (lanes, blocks)
      integer, intent(in) :: lane_material(:, :)
      type(block_law_type), allocatable :: laws(:)

      integer :: b, k, l, law_of(lanes, size(lane_material, 2))

      law_of(:, :) = number_laws(materials, lane_material)
      allocate (laws(maxval(law_of)))
      do b = 1, size(lane_material, 2)
         do l = 1, lanes
            k = law_of(l, b)
            if (k == 0) cycle
            associate (constants => materials(lane_material(l, b))%law)
               if (.not. allocated(laws(k)%law)) then
                  laws(k)%block = b
                  call constants%new_batch(laws(k)%law)
               end if
               call constants%set_lane(l, laws(k)%law)
            end associate
         end do
      end do
   end function new_laws

   !> Number of the law of each lane: lanes of a block share one where their materials can; 0 in
   !> lanes without a layer, and everywhere if all materials are elastic
   pure function number_laws(materials, lane_material) result(law_of)
      type(material_type), intent(in) :: materials(:)
      integer, intent(in) :: lane_material(:, :)
      integer :: law_of(lanes, size(lane_material, 2))

      integer :: b, k, l, laws
      logical :: elastic

      elastic = .true.
      laws = 0
      law_of(:, :) = 0
      do b = 1, size(lane_material, 2)
         do l = 1, lanes
            if (lane_material(l, b) == 0) cycle
            associate (law => materials(lane_material(l, b))%law)
               elastic = elastic .and. law%is_elastic()
               do k = 1, l - 1
                  if (lane_material(k, b) == 0) cycle
                  if (.not. law%shares_batch(materials(lane_material(k, b))%law)) cycle
                  law_of(l, b) = law_of(k, b)
                  exit
               end do
            end associate
            if (law_of(l, b) > 0) cycle
            laws = laws + 1
            law_of(l, b) = laws
         end do
      end do
      if (elastic) law_of(:, :) = 0
   end function number_laws

end module plydyn_element_laws
