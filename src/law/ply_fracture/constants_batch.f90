!> The law of a batch of plies that crack on planes of fracture, made from their constants.
submodule(plydyn_law_ply_fracture_constants) plydyn_law_ply_fracture_constants_batch
   use plydyn_law_ply_fracture_fracture, only : ply_fracture_type
   implicit none

contains

   !> A law without lanes
   module subroutine new_batch(self, law)
      class(fracture_constants_type), intent(in) :: self
      class(law_type), allocatable, intent(out) :: law

      allocate (ply_fracture_type :: law)
   end subroutine new_batch

   !> Give a lane its ply
   pure module subroutine set_lane(self, lane, law)
      class(fracture_constants_type), intent(in) :: self
      integer, intent(in) :: lane
      class(law_type), intent(inout) :: law

      select type (law)
      type is (ply_fracture_type)
         call law%set_lane(lane, self)
      end select
   end subroutine set_lane

end submodule plydyn_law_ply_fracture_constants_batch
