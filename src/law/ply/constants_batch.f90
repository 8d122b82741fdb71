!> The law of a batch of plies that are damaged, made from their constants.
submodule(plydyn_law_ply_constants) plydyn_law_ply_constants_batch
   use plydyn_law_ply_damage, only : ply_damage_type
   use plydyn_law_ply_history, only : driving_strains
   implicit none

contains

   !> A law without lanes
   module procedure new_batch
      allocate (ply_damage_type :: law)
   end procedure new_batch

   !> Give a lane its ply
   module procedure set_lane
      select type (law)
      type is (ply_damage_type)
         call law%set_lane(lane, self)
         if (self%averages()) call law%set_average(lane, self%radius, driving_strains)
      end select
   end procedure set_lane

end submodule plydyn_law_ply_constants_batch
