!> Numerical layers lie one on the other, and planes meet their thickness nodes.
program test_model_layers
   use plydyn_base_precision, only : wp
   use plydyn_model_layers, only : is_same_structure, layers_type, new_layers
   use plydyn_model_layup, only : faces_apart, part_type, ply_type
   use testing, only : begin, check, finish
   implicit none

   !> Half of the side of Lobatto's inner points for order 3, 1/sqrt(5), over the thickness
   real(wp), parameter :: inner = 0.5_wp*(1.0_wp - 1.0_wp/sqrt(5.0_wp))
   type(part_type) :: part, other
   type(layers_type) :: layers

   part%plies = [ply_type(thickness=0.5_wp, order=2, layers=2), ply_type(thickness=0.3_wp, order=3)]
   part%joint = [faces_apart]
   part%bottom_offset = 0.0_wp
   layers = new_layers(part)

   call begin("new_layers")
   call check(layers%bottom, [0.0_wp, 0.25_wp, 0.5_wp], 1.0e-15_wp, "begin where others end")
   call check(layers%top, [0.25_wp, 0.5_wp, 0.8_wp], 1.0e-15_wp, "and end at the top")
   call check(all(layers%ply == [1, 1, 2]) .and. all(layers%order == [2, 2, 3]), "plies and orders")
   call check(all(layers%joint == [0, faces_apart]), "layers of a ply are tied")

   call begin("height")
   call check(layers%height(2, [1, 2, 3]), [0.25_wp, 0.375_wp, 0.5_wp], 1.0e-15_wp, "of order 2")
   call check(layers%height(3, [1, 2, 3, 4]), [0.5_wp, 0.6_wp, 0.7_wp, 0.8_wp], 1.0e-15_wp, &
      & "of order 3, equally spaced")
   part%lobatto = .true.
   layers = new_layers(part)
   call check(layers%height(3, [2, 3]), [0.5_wp + 0.3_wp*inner, 0.8_wp - 0.3_wp*inner], &
      & 1.0e-15_wp, "of order 3, at Lobatto's points")

   call begin("nearest_node, coincide")
   call check(layers%nearest_node(0.4_wp), 0.375_wp, 1.0e-15_wp, "within a layer")
   call check(layers%nearest_node(-7.0_wp), 0.0_wp, 0.0_wp, "below all")
   call check(layers%nearest_node(7.0_wp), 0.8_wp, 1.0e-15_wp, "above all")
   call check(layers%coincide(0.375_wp, 0.375_wp + 0.7e-6_wp), "heights but for rounding are one")
   call check(.not. layers%coincide(0.375_wp, 0.375_wp + 0.9e-6_wp), "others are not")

   call begin("is_same_structure")
   other = part
   other%plies%angle = 45.0_wp
   call check(is_same_structure(layers, new_layers(other)), "whatever the angles")
   other%plies(2)%order = 2
   call check(.not. is_same_structure(layers, new_layers(other)), "another order is another")
   other = part
   other%joint(1) = 0
   call check(.not. is_same_structure(layers, new_layers(other)), "so is another joint")
   other = part
   other%bottom_offset = -0.5_wp
   call check(.not. is_same_structure(layers, new_layers(other)), "so is another height")
   other = part
   other%lobatto = .false.
   call check(.not. is_same_structure(layers, new_layers(other)), "so are other points")
   call finish()
end program test_model_layers
