!> Numerical layers of a laminate, and their joints.
module plydyn_model_layers
   use plydyn_base_precision, only : wp
   use plydyn_fem_expansion, only : thickness_nodes
   use plydyn_model_layup, only : faces_tied, part_type
   implicit none
   private

   public :: is_same_structure, new_layers

   !> Numerical layers from the bottom up
   type, public :: layers_type
      !> Ply of each layer, counted from the bottom, and its order
      integer, allocatable :: ply(:), order(:)
      !> Heights of the bottom and the top of each layer above the nodes, length
      real(wp), allocatable :: bottom(:), top(:)
      !> What joins layer k to layer k + 1, as in `part_type%joint`
      integer, allocatable :: joint(:)
      !> Thickness nodes at Gauss-Lobatto points
      logical :: lobatto = .false.
   contains
      procedure :: height
      procedure :: nearest_node
      procedure :: coincide
   end type layers_type

   !> Share of a layer's thickness below which two parts have a face at the same height
   real(wp), parameter :: same_height = 1.0e-9_wp
   !> Share of the laminate's thickness within which a plane meets a thickness node
   real(wp), parameter :: on_plane = 1.0e-6_wp

contains

   !> Divide the plies of a part into layers
   pure function new_layers(part) result(self)
      !> The laminate
      type(part_type), intent(in) :: part
      type(layers_type) :: self

      real(wp) :: thickness, z
      integer :: i, k, layer, layers

      layers = sum(part%plies%layers)
      allocate (self%ply(layers), self%order(layers), self%bottom(layers), self%top(layers))
      allocate (self%joint(layers - 1))
      self%lobatto = part%lobatto
      z = part%bottom_offset*sum(part%plies%thickness)
      layer = 0
      do k = 1, size(part%plies)
         thickness = part%plies(k)%thickness/real(part%plies(k)%layers, wp)
         do i = 1, part%plies(k)%layers
            layer = layer + 1
            self%ply(layer) = k
            self%order(layer) = part%plies(k)%order
            self%bottom(layer) = z
            z = z + thickness
            self%top(layer) = z
            if (layer == layers) cycle
            self%joint(layer) = faces_tied
            if (i == part%plies(k)%layers) self%joint(layer) = part%joint(k)
         end do
      end do
   end function new_layers

   !> Height of a thickness node above the plane of the nodes
   elemental real(wp) function height(self, layer, level)
      class(layers_type), intent(in) :: self
      !> Layer and thickness node in it, both from the bottom up
      integer, intent(in) :: layer, level

      real(wp) :: place(self%order(layer) + 1)

      place(:) = thickness_nodes(self%order(layer), self%lobatto)
      height = 0.5_wp*((1.0_wp - place(level))*self%bottom(layer) &
         & + (1.0_wp + place(level))*self%top(layer))
   end function height

   !> Height of the thickness node that is nearest to a plane
   pure real(wp) function nearest_node(self, plane) result(nearest)
      class(layers_type), intent(in) :: self
      !> Height above the plane of the nodes
      real(wp), intent(in) :: plane

      integer :: k, t

      nearest = self%bottom(1)
      do k = 1, size(self%order)
         do t = 1, self%order(k) + 1
            associate (here => self%height(k, t))
               if (abs(here - plane) < abs(nearest - plane)) nearest = here
            end associate
         end do
      end do
   end function nearest_node

   !> Whether two heights are one
   elemental logical function coincide(self, one, other)
      class(layers_type), intent(in) :: self
      !> Heights above the plane of the nodes
      real(wp), intent(in) :: one, other

      coincide = abs(one - other) <= on_plane*(self%top(size(self%top)) - self%bottom(1))
   end function coincide

   !> Whether two stacks have their points at the same heights, joined alike
   pure logical function is_same_structure(a, b) result(same)
      !> The stacks
      type(layers_type), intent(in) :: a, b

      same = size(a%order) == size(b%order) .and. (a%lobatto .eqv. b%lobatto)
      if (.not. same) return
      same = all(a%order == b%order) .and. all(a%joint == b%joint) &
         & .and. all(abs(a%bottom - b%bottom) <= same_height*(a%top - a%bottom)) &
         & .and. all(abs(a%top - b%top) <= same_height*(a%top - a%bottom))
   end function is_same_structure

end module plydyn_model_layers
