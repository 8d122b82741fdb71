!> Which places of the arrays in a restart file a rank has: the arrays are those of the whole model,
!> and no rank ever has one of them.
!>
!> One rank alone has its arrays in the order of the whole model: nothing is divided.
module plydyn_io_checkpoint_state_layout
   use plydyn_base_precision, only : wp
   use plydyn_fem_columns, only : alignment_offset
   use plydyn_domain_domain, only : domain_type
   use plydyn_domain_subdomain, only : subdomain_type
   use plydyn_parallel_comm, only : comm_type
   use plydyn_parallel_distributed_array, only : new_distributed_array, distributed_array_type
   implicit none
   private

   public :: new_state_layout

   !> Kinds of arrays that ranks have parts of
   integer, parameter :: motion = 1, history = 2, supports = 3, moved = 4, undivided = 0

   !> An array of the whole model
   type, public :: part_type
      !> Places that this rank counts, and all that it has
      type(distributed_array_type) :: counted, had
   end type part_type

   !> Arrays of the whole model, by their names in `exchange_state`
   type, public :: state_layout_type
      !> The ranks
      type(comm_type) :: comm
      !> The kinds of arrays; of no use with one rank
      type(part_type), private :: parts(4)
   contains
      procedure :: is_divided
      procedure :: part
   end type state_layout_type

contains

   !> Prepare for a domain. All ranks must come here
   function new_state_layout(domain, subdomain) result(self)
      !> The domain of this rank
      type(domain_type), intent(in) :: domain
      !> What this rank has of the whole model
      type(subdomain_type), intent(in) :: subdomain
      type(state_layout_type) :: self

      integer :: held, i, m, moving
      integer, allocatable :: number(:), support(:, :)
      logical, allocatable :: counted(:)

      self%comm = domain%comm
      if (self%comm%ranks == 1) return
      self%parts(motion) = new_part(self%comm, alignment_offset &
         & + domain%columns%height*subdomain%columns, &
         & column_segments(domain%columns%height, subdomain%column), &
         & domain%chunks%counted)
      self%parts(history) = new_part(self%comm, subdomain%histories, subdomain%history, &
         & subdomain%counts_history)
      call number_supports(domain, subdomain, number, held)
      counted = domain%counts(domain%supports%held)
      do m = 1, size(domain%supports%motions)
         counted = [counted, domain%counts(domain%supports%motions(m)%freedom)]
      end do
      moving = sum(domain%supports%motions%all)
      allocate (support(3, size(number)))
      support(1, :) = [(i, i=1, size(number))]
      support(2, :) = number
      support(3, :) = 1
      self%parts(supports) = new_part(self%comm, held + moving, support, counted)
      associate (here => size(domain%supports%held))
         support(1, :) = support(1, :) - here
         support(2, :) = support(2, :) - held
         self%parts(moved) = new_part(self%comm, moving, support(:, here + 1:), &
            & counted(here + 1:))
      end associate
   end function new_state_layout

   !> The segments of one array
   function new_part(comm, whole, segment, counted) result(self)
      type(comm_type), intent(in) :: comm
      !> Length of the array
      integer, intent(in) :: whole
      !> As for `new_distributed_array`, and whether this rank counts each of them
      integer, intent(in) :: segment(:, :)
      logical, intent(in) :: counted(:)
      type(part_type) :: self

      integer :: i

      self%had = new_distributed_array(comm, whole, segment)
      self%counted = new_distributed_array(comm, whole, &
         & segment(:, pack([(i, i=1, size(counted))], counted)))
   end function new_part

   !> What kind of array has a name
   elemental integer function kind_of(name)
      character(*), intent(in) :: name

      select case (name)
      case ("displacement", "velocity", "acceleration")
         kind_of = motion
      case ("history")
         kind_of = history
      case ("support_force")
         kind_of = supports
      case ("support_velocity")
         kind_of = moved
      case default
         kind_of = undivided
      end select
   end function kind_of

   !> Whether ranks have parts of an array; else all of them have it alike
   pure logical function is_divided(self, name)
      class(state_layout_type), intent(in) :: self
      !> Name of the array
      character(*), intent(in) :: name

      is_divided = self%comm%ranks > 1 .and. kind_of(name) /= undivided
   end function is_divided

   !> The parts of an array that is divided
   function part(self, name)
      class(state_layout_type), intent(in) :: self
      !> Name of the array
      character(*), intent(in) :: name
      type(part_type) :: part

      part = self%parts(kind_of(name))
   end function part

   !> Places of supports in the list of the whole model: held points column by column, then those of
   !> each motion
   subroutine number_supports(domain, subdomain, number, held)
      type(domain_type), intent(in) :: domain
      type(subdomain_type), intent(in) :: subdomain
      !> Place of each
      integer, allocatable, intent(out) :: number(:)
      !> Held points of the whole model
      integer, intent(out) :: held

      integer :: before(subdomain%columns + 1), c, column(size(domain%supports%held)), i, m
      real(wp) :: points(subdomain%columns)

      column(:) = domain%columns%column_of(domain%supports%held)
      points(:) = 0.0_wp
      do i = 1, size(column)
         associate (there => subdomain%column(column(i)))
            points(there) = points(there) + 1.0_wp
         end associate
      end do
      call domain%comm%max(points)
      before(1) = 0
      do c = 1, size(points)
         before(c + 1) = before(c) + nint(points(c))
      end do
      held = before(size(before))
      allocate (number(size(column)))
      do i = 1, size(column)
         associate (next => before(subdomain%column(column(i))))
            next = next + 1
            number(i) = next
         end associate
      end do
      i = held
      do m = 1, size(domain%supports%motions)
         number = [number, i + domain%supports%motions(m)%number]
         i = i + domain%supports%motions(m)%all
      end do
   end subroutine number_supports

   !> Segments of the arrays of motion, a column each
   pure function column_segments(height, column) result(segment)
      integer, intent(in) :: height, column(:)
      integer :: segment(3, size(column))
      integer :: i

      do i = 1, size(column)
         segment(:, i) = [alignment_offset + height*(i - 1) + 1, alignment_offset &
            & + height*(column(i) - 1) + 1, height]
      end do
   end function column_segments

end module plydyn_io_checkpoint_state_layout
