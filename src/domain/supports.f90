!> Supports and prescribed motions as places in the arrays of motion.
module plydyn_domain_supports
   use plydyn_base_precision, only : wp
   use plydyn_fem_columns, only : columns_type
   use plydyn_domain_domain, only : domain_type, prescribed_type
   use plydyn_domain_local_to_global, only : local_to_global_type
   use plydyn_model_layers, only : layers_type
   use plydyn_model_support, only : bottom_face, support_type, motion_type, one_plane, top_face
   implicit none
   private

   public :: face_point, find_held, new_prescribed, points_of

contains

   !> Layer and level of the points on a face of the laminate
   pure function face_point(layers, face) result(point)
      !> Layers of the laminate
      type(layers_type), intent(in) :: layers
      !> `bottom_face` or `top_face`
      integer, intent(in) :: face
      integer :: point(2)

      point(:) = [1, 1]
      if (face == top_face) point(:) = [size(layers%order), layers%order(size(layers%order)) + 1]
   end function face_point

   !> Layers and levels of the points on a face, a plane or everywhere, (2, points)
   pure function points_of(layers, face, height) result(points)
      !> Layers of the laminate
      type(layers_type), intent(in) :: layers
      !> `bottom_face`, `top_face`, `one_plane` or `all_planes`
      integer, intent(in) :: face
      !> Height of the plane above the nodes, length; for `one_plane`
      real(wp), intent(in) :: height
      integer, allocatable :: points(:, :)

      integer :: k, t

      if (face == bottom_face .or. face == top_face) then
         points = reshape(face_point(layers, face), [2, 1])
         return
      end if
      allocate (points(2, 0))
      do k = 1, size(layers%order)
         do t = 1, layers%order(k) + 1
            ! the node of a brick has no height within a layer
            if (face == one_plane) then
               if (.not. layers%coincide(layers%height(k, t), height)) cycle
            end if
            points = reshape([points, k, t], [2, size(points, 2) + 1])
         end do
      end do
   end function points_of

   !> Places in the arrays of motion that do not move, each once, in rising order
   pure subroutine find_held(supports, numbering, layers, columns, held, support)
      !> Supports
      type(support_type), intent(in) :: supports(:)
      !> Numbers of the nodes that the rank has
      type(local_to_global_type), intent(in) :: numbering
      !> Layers of the laminate
      type(layers_type), intent(in) :: layers
      !> Where the points lie
      type(columns_type), intent(in) :: columns
      !> The places, and the first support of each of them
      integer, allocatable, intent(out) :: held(:), support(:)

      integer, allocatable :: nodes(:), points(:, :)
      integer :: c, first(columns%freedoms), h, i, k

      first(:) = 0
      ! the first support writes last
      do h = size(supports), 1, -1
         points = points_of(layers, supports(h)%face, supports(h)%height)
         nodes = numbering%only(supports(h)%nodes)
         do c = 1, 3
            if (.not. supports(h)%direction(c)) cycle
            do k = 1, size(points, 2)
               first(columns%freedom(points(1, k), points(2, k), c, nodes)) = h
            end do
         end do
      end do
      held = pack([(i, i=1, size(first))], first > 0)
      support = first(held)
   end subroutine find_held

   !> A prescribed motion on its points
   pure function new_prescribed(motion, numbering, domain) result(self)
      !> As the deck says
      type(motion_type), intent(in) :: motion
      !> Numbers of the nodes that the rank has
      type(local_to_global_type), intent(in) :: numbering
      !> Has layers and columns
      type(domain_type), intent(in) :: domain
      type(prescribed_type) :: self

      integer :: i, k
      integer, allocatable :: here(:), nodes(:), points(:, :)

      self%quantity = motion%quantity
      self%curve = motion%curve
      self%scale = motion%scale
      self%birth = motion%birth
      self%death = motion%death
      points = points_of(domain%layers, motion%face, 0.0_wp)
      nodes = numbering%node(motion%nodes)
      here = pack([(i, i=1, size(nodes))], nodes > 0)
      allocate (self%freedom(0), self%mass(0), self%number(0))
      associate (columns => domain%columns)
         do k = 1, size(points, 2)
            self%freedom = [self%freedom, &
               & columns%freedom(points(1, k), points(2, k), motion%direction, nodes(here))]
            self%mass = [self%mass, columns%mass_of(points(1, k), points(2, k), nodes(here))]
            self%number = [self%number, (k - 1)*size(nodes) + here]
         end do
         self%all = size(points, 2)*size(nodes)
      end associate
   end function new_prescribed

end module plydyn_domain_supports
