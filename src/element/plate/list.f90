!> The plates among element groups.
module plydyn_element_plate_list
   use plydyn_element_group, only : group_item_type
   use plydyn_element_plate_group, only : plate_group_type
   use plydyn_element_plate_layers, only : plate_type
   implicit none
   private

   public :: plates_of

contains

   !> The plates among some groups, by their element sets: for building, since it copies them
   pure function plates_of(groups) result(plates)
      !> The groups
      type(group_item_type), intent(in) :: groups(:)
      type(plate_type), allocatable :: plates(:)
      integer :: g, n

      n = 0
      do g = 1, size(groups)
         select type (group => groups(g)%item)
         type is (plate_group_type)
            n = max(n, group%set)
         end select
      end do
      allocate (plates(n))
      do g = 1, size(groups)
         select type (group => groups(g)%item)
         type is (plate_group_type)
            plates(group%set) = group%plate
         end select
      end do
   end function plates_of

end module plydyn_element_plate_list
