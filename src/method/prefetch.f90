!> What a chunk reads, asked for at once before it is computed.
!>
!> The columns of a chunk lie in many places. Where a model is larger than the caches, a step would
!> wait for one of them after the other.
module plydyn_method_prefetch
   use plydyn_base_memory, only : prefetch
   use plydyn_base_precision, only : wp
   use plydyn_fem_columns, only : alignment_offset
   use plydyn_domain_domain, only : chunk_type, domain_type
   use plydyn_state_state, only : state_type
   implicit none
   private

   public :: prefetch_displacement, prefetch_update

contains

   !> What the forces of a chunk need
   pure subroutine prefetch_displacement(domain, chunk, displacement)
      !> The domain
      type(domain_type), intent(in) :: domain
      !> The chunk
      type(chunk_type), intent(in) :: chunk
      !> Displacement of all points
      real(wp), intent(in), contiguous :: displacement(:)

      integer :: i

      do i = 1, size(chunk%node)
         call prefetch_column(domain, chunk%node(i), displacement)
      end do
   end subroutine prefetch_displacement

   !> What the accelerations and the motion of a chunk need
   pure subroutine prefetch_update(domain, chunk, state)
      !> The domain
      type(domain_type), intent(in) :: domain
      !> The chunk
      type(chunk_type), intent(in) :: chunk
      !> Has the motion
      type(state_type), intent(in) :: state

      integer :: first, i, last

      associate (column => chunk%owned_columns)
         do i = 1, size(column)
            call prefetch_column(domain, column(i), state%acceleration)
            call prefetch_column(domain, column(i), state%velocity)
            call prefetch_column(domain, column(i), state%displacement)
            last = domain%columns%height/3*column(i)
            first = last - domain%columns%height/3 + 1
            call prefetch(domain%inertia%mass(first:last))
            call prefetch(domain%inertia%inverse_mass(first:last))
         end do
      end associate
   end subroutine prefetch_update

   !> A column of an array of motion
   pure subroutine prefetch_column(domain, column, motion)
      type(domain_type), intent(in) :: domain
      integer, intent(in) :: column
      real(wp), intent(in), contiguous :: motion(:)

      associate (last => alignment_offset + domain%columns%height*column)
         call prefetch(motion(last - domain%columns%height + 1:last))
      end associate
   end subroutine prefetch_column

end module plydyn_method_prefetch
