!> What supports and prescribed motions leave free, or leave no freedom.
module plydyn_input_check_supports
   use plydyn_base_text, only : text
   use plydyn_deck_report, only : deck_location_type
   use plydyn_input_catalogue, only : an_impactor, catalogue_type
   use plydyn_model_mesh, only : mesh_type
   use plydyn_model_model, only : model_type
   use plydyn_model_support, only : all_planes, holds_all
   implicit none
   private

   public :: check_supports

   !> Corners of a quad, and nodes of one that has nodes between them
   integer, parameter :: corners = 4, with_middles = 9

contains

   !> Warn of a plate that cannot move and of held corners alone, and note one that nothing holds
   subroutine check_supports(model, catalogue)
      !> A sound model
      type(model_type), intent(in) :: model
      !> Gets findings
      type(catalogue_type), intent(inout) :: catalogue

      integer :: i
      logical :: is_led(size(model%mesh%node_id))

      call check_freedom(model, catalogue)
      if (size(model%mesh%quad_id) == 0) return
      call check_struck(model, catalogue)
      is_led(:) = .false.
      do i = 1, size(model%supports)
         is_led(model%supports(i)%nodes) = .true.
      end do
      do i = 1, size(model%motions)
         is_led(model%motions(i)%nodes) = .true.
      end do
      do i = 1, size(model%supports)
         call check_middles(model%mesh, model%supports(i)%nodes, is_led, &
            & model%supports(i)%line, "held", catalogue)
      end do
      do i = 1, size(model%motions)
         call check_middles(model%mesh, model%motions(i)%nodes, is_led, model%motions(i)%line, &
            & "moved", catalogue)
      end do
   end subroutine check_supports

   !> Some points can move, and something keeps an impactor from taking the plate along
   subroutine check_freedom(model, catalogue)
      type(model_type), intent(in) :: model
      type(catalogue_type), intent(inout) :: catalogue

      type(deck_location_type) :: place
      integer :: c, i
      logical :: is_held(3)

      associate (nodes => [(i, i=1, size(model%mesh%node_id))])
         is_held(:) = [(holds_all(model%supports, nodes, c, all_planes), c=1, 3)]
      end associate
      if (all(is_held)) then
         place%line = maxval(model%supports%line)
         call catalogue%report%warn(place, "all nodes are held along x, y and z: the plate " &
            & //"cannot move", "supports of some nodes, unless it is a rigid body")
      end if
      ! what an earlier deck holds is listed with the changes
      if (catalogue%stored_lines > 0 .or. all(model%contacts%impactor == 0)) return
      if (size(model%fixtures) + size(model%constraints) > 0) return
      if (any(model%motions%direction == 3)) return
      if (any([(model%supports(i)%direction(3), i=1, size(model%supports))])) return
      call catalogue%report%note(place, "nothing holds the plate along z", "it moves on with " &
         & //"what hits it")
   end subroutine check_freedom

   !> Warn of an impactor whose centre is over a node that supports hold along z
   subroutine check_struck(model, catalogue)
      type(model_type), intent(in) :: model
      type(catalogue_type), intent(inout) :: catalogue

      integer :: i, n

      if (catalogue%stored_lines > 0) return
      do i = 1, size(model%contacts)
         if (model%contacts(i)%impactor == 0) cycle
         associate (own => model%impactors(model%contacts(i)%impactor))
            n = minloc(norm2(model%mesh%position(:2, :) - spread(own%centre(:2), 2, &
               & size(model%mesh%node_id)), dim=1), 1)
            if (.not. holds_all(model%supports, [n], 3, all_planes)) cycle
            call catalogue%report%warn(catalogue%location(an_impactor, &
               & model%contacts(i)%impactor), "impactor "//text(own%id)//" comes down at node " &
               & //text(model%mesh%node_id(n))//", which is held along z", &
               & "a centre over the part of the plate that can move")
         end associate
      end do
   end subroutine check_struck

   !> Warn of nodes that are all corners of quads of nine nodes, where the nodes between two of them
   !> are left out
   subroutine check_middles(mesh, nodes, is_led, line, what, catalogue)
      type(mesh_type), intent(in) :: mesh
      !> Indices of the nodes
      integer, intent(in) :: nodes(:)
      !> Whether each node of the mesh is held or moved by any
      logical, intent(in) :: is_led(:)
      !> Line of the deck, and what is done with them
      integer, intent(in) :: line
      character(*), intent(in) :: what
      type(catalogue_type), intent(inout) :: catalogue

      type(deck_location_type) :: place
      integer :: k, q
      logical :: inside(size(mesh%node_id))

      if (size(mesh%quad_node, 1) < with_middles .or. line <= catalogue%stored_lines) return
      inside(:) = .false.
      inside(nodes) = .true.
      if (any(inside(pack(mesh%quad_node(corners + 1:, :), .true.)))) return
      do q = 1, size(mesh%quad_id)
         do k = 1, corners
            associate (one => mesh%quad_node(k, q), &
               & other => mesh%quad_node(modulo(k, corners) + 1, q), &
               & middle => mesh%quad_node(corners + k, q))
               if (.not. (inside(one) .and. inside(other)) .or. is_led(middle)) cycle
               place%line = line
               call catalogue%report%warn(place, "nodes "//text(mesh%node_id(one))//" and " &
                  & //text(mesh%node_id(other))//" are "//what//", and node " &
                  & //text(mesh%node_id(middle))//" between them is free", &
                  & "the nodes in the middle of sides, too, or corners that are apart")
               return
            end associate
         end do
      end do
   end subroutine check_middles

end module plydyn_input_check_supports
