!> Columns of the whole model as one rank numbers them.
module plydyn_domain_numbering
   use plydyn_domain_columns, only : columns_type, front
   use plydyn_domain_domain, only : domain_type
   implicit none
   private

   public :: new_numbering

   !> From the whole model to one rank
   type, public :: numbering_type
      !> This rank's number of each column, those behind too; 0 where it has none of it
      integer, allocatable :: column(:)
      !> The columns that it has, not those behind, and whether it counts each
      integer, allocatable :: here(:)
      logical, allocatable :: own(:)
      !> Length of a column in the arrays of motion, and nodes in it
      integer, private :: height = 0, abreast = 1
   contains
      procedure :: has
      procedure :: counts
      procedure :: node
      procedure :: place
      procedure :: mass_place
   end type numbering_type

contains

   !> Number the columns that the chunks of a rank touch, and behind them all that meet there
   pure function new_numbering(whole, owner, rank) result(self)
      !> The whole model
      type(domain_type), intent(in) :: whole
      !> Rank that adds to each column, those behind too; see `column_owners`
      integer, intent(in) :: owner(:)
      !> The rank
      integer, intent(in) :: rank
      type(numbering_type) :: self

      integer :: b, c, last, i

      self%height = whole%columns%height
      self%abreast = whole%columns%abreast
      allocate (self%column(size(owner)))
      self%column(:) = 0
      where (owner == rank) self%column(:) = 1
      do b = 1, size(whole%borders, 2)
         associate (node => whole%borders(1, b), behind => whole%borders(2:3, b))
            if (any(self%column(behind(1):behind(2)) > 0)) self%column(node) = 1
         end associate
      end do
      associate (nodes => whole%columns%count)
         self%here = pack([(c, c=1, nodes)], self%column(:nodes) > 0)
      end associate
      self%column(:) = 0
      self%column(self%here) = [(i, i=1, size(self%here))]
      self%own = owner(self%here) == rank
      last = size(self%here)
      do b = 1, size(whole%borders, 2)
         if (self%column(whole%borders(1, b)) == 0) cycle
         do c = whole%borders(2, b), whole%borders(3, b)
            last = last + 1
            self%column(c) = last
         end do
      end do
   end function new_numbering

   !> Whether the rank has a place in the arrays of motion
   elemental logical function has(self, place)
      class(numbering_type), intent(in) :: self
      !> The place in those of the whole model
      integer, intent(in) :: place

      has = self%column((place - front - 1)/self%height + 1) > 0
   end function has

   !> Whether the rank has a place in the arrays of motion and counts it
   elemental logical function counts(self, place)
      class(numbering_type), intent(in) :: self
      !> The place in those of the whole model
      integer, intent(in) :: place

      counts = .false.
      associate (column => self%column((place - front - 1)/self%height + 1))
         if (column > 0) counts = self%own(column)
      end associate
   end function counts

   !> The rank's number of a node, 0 where it does not have it
   elemental integer function node(self, whole_node)
      class(numbering_type), intent(in) :: self
      !> The node in the whole model
      integer, intent(in) :: whole_node

      associate (column => self%column(1 + (whole_node - 1)/self%abreast))
         node = 0
         if (column > 0) node = self%abreast*(column - 1) + 1 + mod(whole_node - 1, self%abreast)
      end associate
   end function node

   !> A place in the rank's arrays of motion
   elemental integer function place(self, whole_place)
      class(numbering_type), intent(in) :: self
      !> The place in those of the whole model
      integer, intent(in) :: whole_place

      place = moved(self, whole_place, self%height)
   end function place

   !> A place in the rank's arrays of masses
   elemental integer function mass_place(self, whole_place)
      class(numbering_type), intent(in) :: self
      !> The place in those of the whole model
      integer, intent(in) :: whole_place

      mass_place = moved(self, whole_place, self%height/3)
   end function mass_place

   !> A place in another column
   elemental integer function moved(self, place, height)
      type(numbering_type), intent(in) :: self
      integer, intent(in) :: place, height

      associate (column => (place - front - 1)/height + 1)
         moved = place + height*(self%column(column) - column)
      end associate
   end function moved

end module plydyn_domain_numbering
