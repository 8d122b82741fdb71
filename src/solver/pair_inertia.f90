!> Inertia across interfaces at work: accelerations of free points to those of coupled pairs.
module plydyn_solver_pair_inertia
   use plydyn_base_precision, only : lanes, wp
   use plydyn_domain_columns, only : columns_type
   use plydyn_domain_pair_inertia, only : pair_inertia_type, pair_table_type
   use plydyn_state_state, only : sums_type
   implicit none
   private

   public :: couple_pairs

contains

   !> Couple the pairs above some nodes, and bring the sums over all points up to date
   pure subroutine couple_pairs(pairs, columns, nodes, half_step, velocity, acceleration, sums)
      !> The pairs
      type(pair_inertia_type), intent(in) :: pairs
      !> Where the points lie
      type(columns_type), intent(in) :: columns
      !> First and last node
      integer, intent(in) :: nodes(2)
      !> Half of the step just made
      real(wp), intent(in) :: half_step
      !> Velocity of all points, half a step before
      real(wp), intent(in), contiguous :: velocity(:)
      !> Force over mass of all points in, their acceleration out
      real(wp), intent(inout), contiguous :: acceleration(:)
      !> Sums over all points
      type(sums_type), intent(inout) :: sums

      integer :: f

      do f = 1, size(columns%families)
         associate (family => columns%families(f))
            call couple_family(pairs, pairs%tables(f), lanes*family%blocks, family%order + 1, &
               & nodes, half_step, velocity(family%first:), acceleration(family%first:), sums)
         end associate
      end do
      if (size(pairs%far_inertia) > 0) then
         call couple_far(pairs, nodes, half_step, velocity, acceleration, sums)
      end if
   end subroutine couple_pairs

   !> Pairs between lanes side by side
   pure subroutine couple_family(pairs, table, width, levels, nodes, half_step, v, a, sums)
      type(pair_inertia_type), intent(in) :: pairs
      type(pair_table_type), intent(in) :: table
      integer, intent(in) :: width, levels, nodes(2)
      real(wp), intent(in) :: half_step, v(width, levels, 3, *)
      real(wp), intent(inout) :: a(width, levels, 3, *)
      type(sums_type), intent(inout) :: sums

      real(wp), dimension(width) :: above, below, gap, inertia, speed
      integer :: c, n

      gap(width) = 0.0_wp
      speed(width) = 0.0_wp
      do n = nodes(1), nodes(2)
         do c = 1, 3
            below(:) = table%below(:, c, pairs%class(n))
            above(:) = table%above(:, c, pairs%class(n))
            gap(:width - 1) = a(2:, 1, c, n) - a(:width - 1, levels, c, n)
            speed(:width - 1) = v(2:, 1, c, n) - v(:width - 1, levels, c, n)
            a(:, levels, c, n) = a(:, levels, c, n) + below*gap
            a(2:, 1, c, n) = a(2:, 1, c, n) - above(:width - 1)*gap(:width - 1)
            inertia(:) = pairs%area(n)*table%inertia(:, c)
            call add_sums(inertia, gap, (below + above)*gap, speed, half_step, sums)
         end do
      end do
   end subroutine couple_family

   !> Pairs whose points lie anywhere
   pure subroutine couple_far(pairs, nodes, half_step, v, a, sums)
      type(pair_inertia_type), intent(in) :: pairs
      integer, intent(in) :: nodes(2)
      real(wp), intent(in) :: half_step, v(:)
      real(wp), intent(inout) :: a(:)
      type(sums_type), intent(inout) :: sums

      real(wp) :: gap(size(pairs%far_inertia)), speed(size(pairs%far_inertia))
      integer :: n

      do n = nodes(1), nodes(2)
         associate (low => pairs%far(1, :, n), high => pairs%far(2, :, n), &
            & share => pairs%far_share(:, :, pairs%class(n)))
            gap(:) = a(high) - a(low)
            speed(:) = v(high) - v(low)
            a(low) = a(low) + share(1, :)*gap
            a(high) = a(high) - share(2, :)*gap
            call add_sums(pairs%area(n)*pairs%far_inertia, gap, sum(share, 1)*gap, speed, &
               & half_step, sums)
         end associate
      end do
   end subroutine couple_far

   !> What coupling changes in the sums: the points alone were in them already
   pure subroutine add_sums(inertia, gap, taken, speed, half_step, sums)
      !> Inertia of the relative motion
      real(wp), intent(in) :: inertia(:)
      !> Relative acceleration of the free points, and what coupling takes from it
      real(wp), intent(in) :: gap(:), taken(:)
      !> Relative velocity half a step before
      real(wp), intent(in) :: speed(:)
      real(wp), intent(in) :: half_step
      type(sums_type), intent(inout) :: sums

      real(wp) :: left, pull, square, added
      integer :: l

      pull = 0.0_wp
      square = 0.0_wp
      added = 0.0_wp
      !$omp simd private(left) reduction(+:pull, square, added)
      do l = 1, size(inertia)
         left = gap(l) - taken(l)
         pull = pull + inertia(l)*gap(l)*left
         square = square + inertia(l)*left*(2.0_wp*speed(l) + half_step*(gap(l) + left))
         added = added + inertia(l)*(speed(l) + half_step*left)**2
      end do
      sums%pull = sums%pull - pull
      sums%twice_kinetic = sums%twice_kinetic - half_step*square
      sums%twice_added = sums%twice_added + added
   end subroutine add_sums

end module plydyn_solver_pair_inertia
