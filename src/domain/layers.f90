!> The numerical layers of a laminate, and how they meet.
module plydyn_domain_layers
   use plydyn_base_error, only : error_type, exit_input, fail
   use plydyn_base_precision, only : wp
   use plydyn_base_text, only : text
   use plydyn_fem_expansion, only : thickness_nodes
   use plydyn_model_layup, only : faces_tied, part_type
   implicit none
   private

   public :: check_same_structure, new_layers

   !> Numerical layers from the bottom up
   type, public :: layers_type
      !> Ply of each layer, counted from the bottom
      integer, allocatable :: ply(:)
      !> Order of each layer
      integer, allocatable :: order(:)
      !> Heights of the bottom and the top of each layer above the nodes, length
      real(wp), allocatable :: bottom(:), top(:)
      !> What joins layer k to layer k + 1, as in `part_type%joint`
      integer, allocatable :: joint(:)
      !> Thickness nodes at Gauss-Lobatto points
      logical :: lobatto = .false.
   contains
      procedure :: height
   end type layers_type

   !> Relative difference below which two heights are the same
   real(wp), parameter :: same_height = 1.0e-9_wp

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

   !> All parts of a model share one arrangement of points through the thickness
   subroutine check_same_structure(parts, error)
      !> The laminates
      type(part_type), intent(in) :: parts(:)
      !> Names the first part that differs
      type(error_type), allocatable, intent(out) :: error

      type(layers_type) :: first, other
      integer :: p

      first = new_layers(parts(1))
      do p = 2, size(parts)
         other = new_layers(parts(p))
         if (is_same_structure(first, other)) cycle
         call fail(error, exit_input, "part "//text(parts(p)%id)//" has other layers than part " &
            & //text(parts(1)%id)//": the parts of a model must agree in the thickness, order and" &
            & //" number of their layers and in their joints; angles and materials may differ")
         return
      end do
   end subroutine check_same_structure

   !> Whether two stacks have their points at the same heights, joined alike
   pure logical function is_same_structure(a, b) result(same)
      type(layers_type), intent(in) :: a, b

      same = size(a%order) == size(b%order) .and. (a%lobatto .eqv. b%lobatto)
      if (.not. same) return
      same = all(a%order == b%order) .and. all(a%joint == b%joint) &
         & .and. all(abs(a%bottom - b%bottom) <= same_height*(a%top - a%bottom)) &
         & .and. all(abs(a%top - b%top) <= same_height*(a%top - a%bottom))
   end function is_same_structure

end module plydyn_domain_layers
