!> Inertia across interfaces at work: accelerations of free points to those of coupled pairs.
module plydyn_method_implicit_pair_inertia
   use plydyn_base_precision, only : lanes, wp
   use plydyn_fem_columns, only : columns_type
   use plydyn_domain_pair_inertia, only : pair_inertia_type
   use plydyn_state_state, only : motion_sums_type
   implicit none
   private

   public :: add_pair_energy, couple_pairs

contains

   !> Couple the pairs above a node, and bring the sums over all points up to date, in which the
   !> points alone are already
   pure subroutine couple_pairs(pairs, columns, node, half_step, velocity, acceleration, sums)
      !> The pairs; where the points lie
      type(pair_inertia_type), intent(in) :: pairs
      type(columns_type), intent(in) :: columns
      !> The node; half of the step just made
      integer, intent(in) :: node
      real(wp), intent(in) :: half_step
      !> Velocity of all points, half a step before
      real(wp), intent(in), contiguous :: velocity(:)
      !> Force over mass of all points in, their acceleration out
      real(wp), intent(inout), contiguous :: acceleration(:)
      type(motion_sums_type), intent(inout) :: sums

      integer :: f, first

      do f = 1, size(columns%order_groups)
         first = columns%start(f, node)
         call couple_order_group(pairs, f, node, half_step, columns%order_groups(f)%order + 1, &
            & velocity(first:), acceleration(first:), sums)
      end do
      if (size(pairs%far_inertia) > 0) then
         call couple_far(pairs, node, half_step, velocity, acceleration, sums)
      end if
   end subroutine couple_pairs

   !> Pairs between lanes side by side, eight at a time: the upper points are one place further on
   pure subroutine couple_order_group(pairs, f, node, half_step, levels, v, a, sums)
      type(pair_inertia_type), intent(in) :: pairs
      integer, intent(in) :: f, node, levels
      real(wp), intent(in) :: half_step, v(size(pairs%tables(f)%inertia, 1)*levels, 3)
      real(wp), intent(inout) :: a(size(pairs%tables(f)%inertia, 1)*levels, 3)
      type(motion_sums_type), intent(inout) :: sums

      real(wp), dimension(lanes) :: added, product, square
      real(wp), dimension(lanes) :: high, low
      real(wp) :: gap, left, speed
      integer :: c, k, l, top, width

      width = size(pairs%tables(f)%inertia, 1)
      added(:) = 0.0_wp
      product(:) = 0.0_wp
      square(:) = 0.0_wp
      top = width*(levels - 1)
      associate (table => pairs%tables(f), class => pairs%class(node))
         do c = 1, 3
            do k = 0, width - lanes, lanes
               !$omp simd private(gap, left, speed)
               do l = 1, lanes
                  gap = a(k + l + 1, c) - a(top + k + l, c)
                  speed = v(k + l + 1, c) - v(top + k + l, c)
                  high(l) = a(k + l + 1, c) - table%above(k + l, c, class)*gap
                  low(l) = a(top + k + l, c) + table%below(k + l, c, class)*gap
                  left = gap - (table%below(k + l, c, class) + table%above(k + l, c, class))*gap
                  product(l) = product(l) + table%inertia(k + l, c)*gap*left
                  square(l) = square(l) &
                     & + table%inertia(k + l, c)*left*(2.0_wp*speed + half_step*(gap + left))
                  added(l) = added(l) + table%inertia(k + l, c)*(speed + half_step*left)**2
               end do
               ! the last lane, in no pair, meets the next level here and leaves it: first
               a(k + 2:k + lanes + 1, c) = high
               a(top + k + 1:top + k + lanes, c) = low
            end do
         end do
      end associate
      sums%acceleration_square = sums%acceleration_square - pairs%area(node)*sum(product)
      sums%twice_kinetic = sums%twice_kinetic - pairs%area(node)*half_step*sum(square)
      sums%twice_added = sums%twice_added + pairs%area(node)*sum(added)
   end subroutine couple_order_group

   !> Pairs whose points lie anywhere
   pure subroutine couple_far(pairs, node, half_step, v, a, sums)
      type(pair_inertia_type), intent(in) :: pairs
      integer, intent(in) :: node
      real(wp), intent(in) :: half_step, v(:)
      real(wp), intent(inout) :: a(:)
      type(motion_sums_type), intent(inout) :: sums

      real(wp) :: gap, inertia, left, speed
      integer :: k

      do k = 1, size(pairs%far_inertia)
         associate (low => pairs%far(1, k, node), high => pairs%far(2, k, node), &
            & share => pairs%far_share(:, k, pairs%class(node)))
            inertia = pairs%area(node)*pairs%far_inertia(k)
            gap = a(high) - a(low)
            speed = v(high) - v(low)
            a(low) = a(low) + share(1)*gap
            a(high) = a(high) - share(2)*gap
            left = gap - sum(share)*gap
            sums%acceleration_square = sums%acceleration_square - inertia*gap*left
            sums%twice_kinetic = sums%twice_kinetic &
               & - half_step*inertia*left*(2.0_wp*speed + half_step*(gap + left))
            sums%twice_added = sums%twice_added + inertia*(speed + half_step*left)**2
         end associate
      end do
   end subroutine couple_far

   !> Kinetic energy of the pairs above a node whose accelerations are coupled already
   pure subroutine add_pair_energy(pairs, columns, node, half_step, velocity, acceleration, sums)
      !> As in `couple_pairs`
      type(pair_inertia_type), intent(in) :: pairs
      type(columns_type), intent(in) :: columns
      integer, intent(in) :: node
      real(wp), intent(in) :: half_step
      !> Velocity of all points, half a step before; their acceleration
      real(wp), intent(in), contiguous :: velocity(:), acceleration(:)
      !> Sums over all points
      type(motion_sums_type), intent(inout) :: sums

      real(wp) :: twice
      integer :: f, first, k

      twice = 0.0_wp
      do f = 1, size(columns%order_groups)
         first = columns%start(f, node)
         call add_order_group(pairs%tables(f)%inertia, columns%order_groups(f)%order + 1, &
            & size(pairs%tables(f)%inertia, 1), half_step, velocity(first:), &
            & acceleration(first:), twice)
      end do
      do k = 1, size(pairs%far_inertia)
         associate (low => pairs%far(1, k, node), high => pairs%far(2, k, node))
            twice = twice + pairs%far_inertia(k)*(velocity(high) - velocity(low) &
               & + half_step*(acceleration(high) - acceleration(low)))**2
         end associate
      end do
      sums%twice_added = sums%twice_added + pairs%area(node)*twice
   end subroutine add_pair_energy

   !> The share of pairs side by side
   pure subroutine add_order_group(inertia, levels, width, half_step, v, a, twice)
      integer, intent(in) :: levels, width
      real(wp), intent(in) :: inertia(width, 3), half_step, v(width*levels, 3), a(width*levels, 3)
      real(wp), intent(inout) :: twice

      integer :: c, l, top

      top = width*(levels - 1)
      do c = 1, 3
         !$omp simd reduction(+:twice)
         do l = 1, width - 1
            twice = twice + inertia(l, c)*(v(l + 1, c) - v(top + l, c) &
               & + half_step*(a(l + 1, c) - a(top + l, c)))**2
         end do
      end do
   end subroutine add_order_group

end module plydyn_method_implicit_pair_inertia
