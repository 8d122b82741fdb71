!> The law of a batch of plies that crack on planes of fracture, made from their constants.
submodule(plydyn_law_ply_fracture_constants) plydyn_law_ply_fracture_constants_batch
   use plydyn_law_ply_fracture_fracture, only : ply_fracture_type
   implicit none

contains

   !> A law without lanes
   module procedure new_batch
      allocate (ply_fracture_type :: law)
   end procedure new_batch

   !> Give a lane its ply
   module procedure set_lane
      select type (law)
      type is (ply_fracture_type)
         call law%set_lane(lane, self)
      end select
   end procedure set_lane

end submodule plydyn_law_ply_fracture_constants_batch
