!> Columns of the whole model as one rank numbers them.
module plydyn_domain_local_to_global
   use plydyn_domain_decomposition, only : decomposition_type
   implicit none
   private

   public :: new_local_to_global

   !> From the whole model to one rank
   type, public :: local_to_global_type
      !> Rank that adds to each column, those behind too; see `column_owners`
      integer, allocatable :: owner(:)
      !> This rank's number of each column, those behind too; 0 where it has none of it
      integer, allocatable :: column(:)
      !> The columns that it has, not those behind, and whether it counts each
      integer, allocatable :: here(:)
      logical, allocatable :: own(:)
      !> The columns of forces, those behind too
      integer :: columns = 0
      !> Column of each node of the whole model, as that numbers both; this rank's number of each
      !> node, 0 where it does not have it. The last column may have room for more nodes
      integer, allocatable :: column_of(:), node(:)
      !> Nodes in a column; node of each column of the whole model, or of each so many
      integer, private :: nodes_per_column = 1
      integer, allocatable, private :: whole_node(:)
   contains
      procedure :: nodes
      procedure :: only
   end type local_to_global_type

contains

   !> Number the columns that the chunks of a rank touch, and behind them all that meet there
   pure function new_local_to_global(division, nodes_per_column, owner, rank) result(self)
      type(decomposition_type), intent(in) :: division
      !> Nodes in a column
      integer, intent(in) :: nodes_per_column
      !> Rank that adds to each column, and the rank of the numbers
      integer, intent(in) :: owner(:), rank
      type(local_to_global_type) :: self

      integer :: b, c, i

      self%owner = owner
      self%nodes_per_column = nodes_per_column
      self%whole_node = division%node
      self%column = merge(1, 0, owner == rank)
      do b = 1, size(division%shared_nodes, 2)
         associate (node => division%shared_nodes(1, b), behind => division%shared_nodes(2:3, b))
            if (any(self%column(behind(1):behind(2)) > 0)) self%column(node) = 1
         end associate
      end do
      associate (nodes => division%nodes)
         self%here = pack([(c, c=1, nodes)], self%column(:nodes) > 0)
      end associate
      self%column(:) = 0
      self%column(self%here) = [(i, i=1, size(self%here))]
      self%own = owner(self%here) == rank
      self%columns = size(self%here)
      do b = 1, size(division%shared_nodes, 2)
         if (self%column(division%shared_nodes(1, b)) == 0) cycle
         do c = division%shared_nodes(2, b), division%shared_nodes(3, b)
            self%columns = self%columns + 1
            self%column(c) = self%columns
         end do
      end do
      associate (n => nodes_per_column)
         self%column_of = [((division%column(c), i=1, n), c=1, size(division%column))]
         self%node = [((max(n*(self%column(division%column(c)) - 1) + i, 0), i=1, n), &
            & c=1, size(division%column))]
      end associate
   end function new_local_to_global

   !> Those of some nodes that the rank has, as it numbers them
   pure function only(self, whole_nodes) result(nodes)
      class(local_to_global_type), intent(in) :: self
      !> Nodes of the whole model
      integer, intent(in) :: whole_nodes(:)
      integer, allocatable :: nodes(:)

      nodes = self%node(whole_nodes)
      nodes = pack(nodes, nodes > 0)
   end function only

   !> The nodes of the rank as the whole model numbers them; past the last one of that again it
   pure function nodes(self, whole_nodes) result(list)
      class(local_to_global_type), intent(in) :: self
      !> How many the whole model has
      integer, intent(in) :: whole_nodes
      integer :: list(self%nodes_per_column*size(self%here))
      integer :: c, i

      associate (n => self%nodes_per_column)
         list(:) = [((min(n*(self%whole_node(self%here(c)) - 1) + i, whole_nodes), i=1, n), &
            & c=1, size(self%here))]
      end associate
   end function nodes

end module plydyn_domain_local_to_global
