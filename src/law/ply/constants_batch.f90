!> The law of a batch of plies that are damaged, made from their constants.
submodule(plydyn_law_ply_constants) plydyn_law_ply_constants_batch
   use plydyn_law_ply_damage, only : ply_damage_type
   use plydyn_law_ply_history, only : driving_strains
   implicit none

contains

   !> A law without lanes
   module subroutine new_batch(self, law)
      class(ply_constants_type), intent(in) :: self
      class(law_type), allocatable, intent(out) :: law

      allocate (ply_damage_type :: law)
   end subroutine new_batch

   !> Give a lane its ply
   pure module subroutine set_lane(self, lane, law)
      class(ply_constants_type), intent(in) :: self
      integer, intent(in) :: lane
      class(law_type), intent(inout) :: law

      select type (law)
      type is (ply_damage_type)
         call law%set_lane(lane, self)
         if (self%averages()) call law%set_average(lane, self%radius, driving_strains)
      end select
   end subroutine set_lane

end submodule plydyn_law_ply_constants_batch
