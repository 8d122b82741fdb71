!> Where the values of elements come together: the nodes of each part, as the whole model numbers
!> them, and what a rank has of them.
module plydyn_io_vtkhdf_output_nodes
   use plydyn_base_precision, only : wp
   use plydyn_base_sort, only : sorted_order
   use plydyn_io_vtkhdf_vtkhdf, only : hyperslab_type
   use plydyn_parallel_comm, only : comm_type
   use plydyn_parallel_owner_reduction, only : owner_reduction_type, new_owner_reduction
   implicit none
   private

   public :: new_accumulators, number_nodes

   !> Accumulators of what the elements of a rank add to output nodes. It is summed in rising order
   !> of the numbers of the elements: here where this rank has all elements of the node, else by the
   !> rank that writes the node
   type, public :: accumulators_type
      !> Group and number in it of each element of this rank, (2, elements)
      integer, allocatable :: element(:, :)
      !> Accumulator that each node of each element adds to, and weight of the element in the mean
      !> there, (nodes, elements)
      integer, allocatable :: place(:, :)
      real(wp), allocatable :: weight(:, :)
      !> Node of each accumulator
      integer, allocatable :: node(:)
      !> How many accumulators there are
      integer :: count = 0
      !> Levels of points above an output node
      integer :: levels = 1
      !> Output nodes of the whole model
      integer :: nodes = 0
      !> How what is in the accumulators gets to the rank that writes it
      type(owner_reduction_type) :: reduction
   contains
      procedure :: points
      procedure :: own_points
      procedure :: add
      procedure :: mean
      procedure :: take
   end type accumulators_type

contains

   !> Number the nodes of each part in their order, one part after the other
   pure subroutine number_nodes(part, element_node, nodes, output_node, node)
      !> Part of each element, from 1
      integer, intent(in) :: part(:)
      !> Nodes of the elements, (nodes of an element, elements), and how many nodes there are
      integer, intent(in) :: element_node(:, :), nodes
      !> Site of each node of each element
      integer, allocatable, intent(out) :: output_node(:, :)
      !> Node of each output node
      integer, allocatable, intent(out) :: node(:)

      integer :: e, first, i, last, n, number(nodes), order(size(part))
      integer, allocatable :: own(:)

      order(:) = sorted_order(part)
      allocate (output_node(size(element_node, 1), size(part)), node(0))
      first = 1
      do while (first <= size(order))
         last = first - 1 + count(part(order(first:)) == part(order(first)))
         number(:) = 0
         do i = first, last
            number(element_node(:, order(i))) = 1
         end do
         own = pack([(n, n=1, nodes)], number > 0)
         number(own) = size(node) + [(n, n=1, size(own))]
         node = [node, own]
         do i = first, last
            e = order(i)
            output_node(:, e) = number(element_node(:, e))
         end do
         first = last + 1
      end do
   end subroutine number_nodes

   !> Prepare for the elements of a rank
   function new_accumulators(comm, output_node, element, levels) result(self)
      type(comm_type), intent(in) :: comm
      !> Output nodes of all elements of the model, (nodes of an element, elements)
      integer, intent(in) :: output_node(:, :)
      !> Elements of this rank, in rising order
      integer, intent(in) :: element(:)
      !> Levels of points above an output node
      integer, intent(in) :: levels
      type(accumulators_type) :: self

      integer, dimension(maxval(output_node)) :: all_parts, number, own_parts
      integer :: i, n
      integer :: key(size(output_node, 1)*size(element)), row(size(output_node, 1)*size(element))

      self%nodes = maxval(output_node)
      self%levels = levels
      call count_parts(output_node, [(i, i=1, size(output_node, 2))], all_parts)
      call count_parts(output_node, element, own_parts)
      allocate (self%place(size(output_node, 1), size(element)))
      number(:) = 0
      do i = 1, size(element)
         do n = 1, size(output_node, 1)
            associate (s => output_node(n, element(i)))
               if (number(s) == 0 .or. own_parts(s) < all_parts(s)) then
                  self%count = self%count + 1
                  number(s) = self%count
                  row(self%count) = s
                  key(self%count) = element(i)
               end if
               self%place(n, i) = number(s)
            end associate
         end do
      end do
      self%reduction = new_owner_reduction(comm, self%nodes, row(:self%count), key(:self%count))
   end function new_accumulators

   !> How often elements have a node at each output node
   pure subroutine count_parts(output_node, element, parts)
      integer, intent(in) :: output_node(:, :), element(:)
      integer, intent(out) :: parts(:)

      integer :: i, n

      parts(:) = 0
      do i = 1, size(element)
         do n = 1, size(output_node, 1)
            parts(output_node(n, element(i))) = parts(output_node(n, element(i))) + 1
         end do
      end do
   end subroutine count_parts

   !> Points that this rank writes, among those of all: level by level the output nodes
   pure type(hyperslab_type) function points(self)
      class(accumulators_type), intent(in) :: self

      points = hyperslab_type(whole=self%nodes, levels=self%levels, first=self%reduction%first, &
         & count=self%reduction%count)
   end function points

   !> How many they are
   pure integer function own_points(self)
      class(accumulators_type), intent(in) :: self

      own_points = self%levels*self%reduction%count
   end function own_points

   !> Add the values of an element at one level to its accumulators by weight, and the weights
   pure subroutine add(self, i, level, values, sums)
      class(accumulators_type), intent(in) :: self
      !> The element of this rank, and the level
      integer, intent(in) :: i, level
      !> (components, nodes)
      real(wp), intent(in) :: values(:, :)
      !> As in `mean`
      real(wp), intent(inout) :: sums(:, :, :)
      integer :: n

      do n = 1, size(values, 2)
         associate (total => sums(:, level, self%place(n, i)), last => size(values, 1), &
            & w => self%weight(n, i))
            total(:last) = total(:last) + w*values(:, n)
            total(last + 1) = total(last + 1) + w
         end associate
      end do
   end subroutine add

   !> Weighted mean at the points that this rank writes of some consecutive levels; 0 where there is
   !> no weight. All ranks must come here
   subroutine mean(self, values, means)
      class(accumulators_type), intent(in) :: self
      !> Sums of weight times value and, last, of weights, (components + 1, levels, accumulators)
      real(wp), intent(in) :: values(:, :, :)
      !> The means, (components, output nodes of this rank times levels), level by level
      real(wp), intent(out) :: means(:, :)

      real(wp), allocatable :: sums(:, :)
      integer :: i, last, s, t

      allocate (sums(size(values, 1)*size(values, 2), self%reduction%count))
      call self%reduction%sum(reshape(values, [size(sums, 1), size(values, 3)]), sums)
      do t = 1, size(values, 2)
         last = size(values, 1)*t
         do s = 1, self%reduction%count
            i = self%reduction%count*(t - 1) + s
            means(:, i) = 0.0_wp
            if (sums(last, s) > 0.0_wp) means(:, i) = &
               & sums(last - size(means, 1):last - 1, s)/sums(last, s)
         end do
      end do
   end subroutine mean

   !> Values at the points that this rank writes, where all elements have them alike. All ranks must
   !> come here
   subroutine take(self, values, taken)
      class(accumulators_type), intent(in) :: self
      !> Values, (components, levels, accumulators)
      real(wp), intent(in) :: values(:, :, :)
      !> The same, (components, points), level by level
      real(wp), intent(out) :: taken(:, :)

      real(wp), allocatable :: rows(:, :)
      integer :: s, t

      allocate (rows(size(values, 1)*size(values, 2), self%reduction%count))
      call self%reduction%take_one(reshape(values, [size(rows, 1), size(values, 3)]), rows)
      do t = 1, size(values, 2)
         do s = 1, self%reduction%count
            taken(:, self%reduction%count*(t - 1) + s) = &
               & rows(size(values, 1)*(t - 1) + 1:size(values, 1)*t, s)
         end do
      end do
   end subroutine take

end module plydyn_io_vtkhdf_output_nodes
