!> Inertia that the points of a column share, at work: accelerations of free points to those of
!> columns coupled through the thickness, or of pairs coupled across interfaces.
module plydyn_method_implicit_inertia
   use plydyn_base_precision, only : lanes, wp
   use plydyn_domain_column_inertia, only : column_inertia_type, together
   use plydyn_domain_domain, only : domain_type, face_type
   use plydyn_domain_pair_inertia, only : pair_inertia_type
   use plydyn_fem_columns, only : columns_type
   use plydyn_state_state, only : motion_sums_type, state_type
   implicit none
   private

   public :: add_column_correction, couple_inertia

contains

   !> Couple the points above a node, and bring the sums over all points up to date, in which the
   !> points alone are already
   pure subroutine couple_inertia(domain, node, half_step, velocity, acceleration, sums)
      type(domain_type), intent(in) :: domain
      !> The node; half of the step just made
      integer, intent(in) :: node
      real(wp), intent(in) :: half_step
      !> Velocity of all points, half a step before
      real(wp), intent(in), contiguous :: velocity(:)
      !> Force over mass of all points in, their acceleration out
      real(wp), intent(inout), contiguous :: acceleration(:)
      type(motion_sums_type), intent(inout) :: sums

      associate (inertia => domain%inertia, columns => domain%columns)
         if (inertia%thickness%active) then
            call couple_column(inertia%thickness, columns, inertia%mass, node, half_step, &
               & velocity, acceleration, sums)
            call add_pair_energy(inertia%pairs, columns, node, half_step, velocity, &
               & acceleration, sums)
         else
            call couple_pairs(inertia%pairs, columns, node, half_step, velocity, acceleration, sums)
         end if
      end associate
   end subroutine couple_inertia

   !> Correction of the columns under a point of a face, which share their inertia with it
   pure subroutine add_column_correction(domain, surface, point, direction, correction, state)
      type(domain_type), intent(in) :: domain
      type(face_type), intent(in) :: surface
      !> Point of the face, and 1, 2, 3 for x, y, z
      integer, intent(in) :: point, direction
      !> Displacement that contact adds to the point; it has it already
      real(wp), intent(in) :: correction
      !> Displacement and velocity
      type(state_type), intent(inout) :: state

      integer :: f, first, k, l, node

      node = surface%node(point)
      associate (self => domain%inertia%thickness)
         do f = 1, size(domain%columns%order_groups)
            first = domain%columns%start(f, node) + self%rows(f)*(direction - 1)
            do k = 1, self%rows(f)/lanes
               do l = 1, lanes
                  associate (share => surface%follow(l, k + self%before(f)/lanes, &
                     & self%kind(direction, node)), place => first + l - 1 + lanes*(k - 1))
                     state%displacement(place) = state%displacement(place) + share*correction
                     state%velocity(place) = state%velocity(place) + share*correction/state%step
                  end associate
               end do
            end do
         end do
      end associate
   end subroutine add_column_correction

   !> Couple the column above a node
   pure subroutine couple_column(self, columns, mass, node, half_step, velocity, acceleration, sums)
      type(column_inertia_type), intent(in) :: self
      type(columns_type), intent(in) :: columns
      real(wp), intent(in), contiguous :: mass(:)
      !> These and the others as in `couple_inertia`
      integer, intent(in) :: node
      real(wp), intent(in) :: half_step
      real(wp), intent(in), contiguous :: velocity(:)
      real(wp), intent(inout), contiguous :: acceleration(:)
      type(motion_sums_type), intent(inout) :: sums

      real(wp) :: free(3, size(self%response, 2)), new(lanes, 3, maxval(self%rows)/lanes)
      integer :: d, f, first, place, starts(size(self%rows))

      free(:, :) = 0.0_wp
      starts(:) = columns%start([(f, f=1, size(starts))], node) - self%before - 1
      do d = 1, size(self%row)
         f = self%order_group(d)
         place = starts(f) + self%row(d)
         free(1, d) = acceleration(place)
         free(2, d) = acceleration(place + self%rows(f))
         free(3, d) = acceleration(place + 2*self%rows(f))
      end do
      do f = 1, size(starts)
         first = starts(f) + self%before(f) + 1
         call respond(self, f, self%kind(:, node), free, new)
         call replace_rows(self%rows(f), half_step, mass(columns%mass_start(f, node):), &
            & velocity(first:), new, acceleration(first:), sums)
         call add_stretches(self, f, node, half_step, &
            & self%rows(f)/(columns%order_groups(f)%order + 1), &
            & velocity(first:), acceleration(first:), sums)
      end do
   end subroutine couple_column

   !> Response of the rows of an order group, eight at a time
   pure subroutine respond(self, f, kind, free, new)
      type(column_inertia_type), intent(in) :: self
      integer, intent(in) :: f
      !> Kinds of the column along x, y, z
      integer, intent(in) :: kind(3)
      real(wp), intent(in) :: free(:, :)
      !> Accelerations, (lanes, direction, eight rows)
      real(wp), intent(out) :: new(lanes, 3, self%rows(f)/lanes)

      integer :: k, r

      do r = 1, self%rows(f)/lanes
         k = self%before(f)/lanes + r
         call multiply(size(free, 2), self%response(:, :, k, kind(1)), &
            & self%response(:, :, k, kind(2)), self%response(:, :, k, kind(3)), free, new(:, :, r))
      end do
   end subroutine respond

   !> Put new accelerations in the place of those of free points, with their part in the sums
   pure subroutine replace_rows(rows, half_step, mass, v, new, a, sums)
      integer, intent(in) :: rows
      real(wp), intent(in) :: half_step, mass(rows), v(rows, 3), new(lanes, 3, *)
      real(wp), intent(inout) :: a(rows, 3)
      type(motion_sums_type), intent(inout) :: sums

      real(wp) :: changes(lanes, 3, 3)
      integer :: c, r

      changes(:, :, :) = 0.0_wp
      do r = 1, rows, lanes
         do c = 1, 3
            call replace(half_step, mass(r), v(r, c), new(:, c, 1 + r/lanes), a(r, c), &
               & changes(:, :, c))
         end do
      end do
      do c = 1, 3
         sums%momentum(c) = sums%momentum(c) + half_step*sum(changes(:, 1, c))
      end do
      sums%twice_kinetic = sums%twice_kinetic + half_step*sum(changes(:, 2, :))
      sums%acceleration_square = sums%acceleration_square + sum(changes(:, 3, :))
   end subroutine replace_rows

   !> Products of eight rows of a response with accelerations along x, y, z; sums that do not wait
   !> for each other
   pure subroutine multiply(freedoms, along_x, along_y, along_z, free, new)
      integer, intent(in) :: freedoms
      real(wp), intent(in) :: along_x(lanes, freedoms), along_y(lanes, freedoms)
      real(wp), intent(in) :: along_z(lanes, freedoms), free(3, freedoms)
      real(wp), intent(out) :: new(lanes, 3)

      real(wp), dimension(lanes) :: x, y, z
      integer :: j, l

      x(:) = 0.0_wp
      y(:) = 0.0_wp
      z(:) = 0.0_wp
      do j = 1, freedoms, together
         !$omp simd
         do l = 1, lanes
            x(l) = x(l) + (along_x(l, j)*free(1, j) + along_x(l, j + 1)*free(1, j + 1))
            y(l) = y(l) + (along_y(l, j)*free(2, j) + along_y(l, j + 1)*free(2, j + 1))
            z(l) = z(l) + (along_z(l, j)*free(3, j) + along_z(l, j + 1)*free(3, j + 1))
         end do
      end do
      new(:, 1) = x
      new(:, 2) = y
      new(:, 3) = z
   end subroutine multiply

   !> The same of eight rows along one direction
   pure subroutine replace(half_step, mass, v, new, a, changes)
      real(wp), intent(in) :: half_step, mass(lanes), v(lanes), new(lanes)
      real(wp), intent(inout) :: a(lanes)
      !> Changes of the sums: force, its power twice, its product with the acceleration
      real(wp), intent(inout) :: changes(lanes, 3)

      real(wp) :: force
      integer :: l

      !$omp simd private(force)
      do l = 1, lanes
         force = mass(l)*(new(l) - a(l))
         changes(l, 1) = changes(l, 1) + force
         changes(l, 2) = changes(l, 2) + force*(2.0_wp*v(l) + half_step*(new(l) + a(l)))
         changes(l, 3) = changes(l, 3) + force*a(l)
         a(l) = new(l)
      end do
   end subroutine replace

   !> Kinetic energy of the inertia inside the layers of an order group
   pure subroutine add_stretches(self, f, node, half_step, width, v, a, sums)
      type(column_inertia_type), intent(in) :: self
      integer, intent(in) :: f, node, width
      real(wp), intent(in) :: half_step, v(width, *), a(width, *)
      type(motion_sums_type), intent(inout) :: sums

      real(wp) :: square(lanes)
      integer :: c, k, l, levels, p, s, t

      square(:) = 0.0_wp
      levels = self%rows(f)/width
      associate (stretch => self%stretches(f), class => self%class(node))
         do c = 1, 3
            do p = 1, size(stretch%level, 2)
               s = stretch%level(1, p) + levels*(c - 1)
               t = stretch%level(2, p) + levels*(c - 1)
               do k = 0, width - lanes, lanes
                  !$omp simd
                  do l = 1, lanes
                     square(l) = square(l) + stretch%inertia(k + l, p, c, class)*(v(k + l, t) &
                        & - v(k + l, s) + half_step*(a(k + l, t) - a(k + l, s)))**2
                  end do
               end do
            end do
         end do
      end associate
      sums%twice_added = sums%twice_added + self%area(node)*sum(square)
   end subroutine add_stretches

   !> Couple the pairs above a node
   pure subroutine couple_pairs(pairs, columns, node, half_step, velocity, acceleration, sums)
      type(pair_inertia_type), intent(in) :: pairs
      type(columns_type), intent(in) :: columns
      !> As in `couple_inertia`
      integer, intent(in) :: node
      real(wp), intent(in) :: half_step
      real(wp), intent(in), contiguous :: velocity(:)
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
      type(pair_inertia_type), intent(in) :: pairs
      type(columns_type), intent(in) :: columns
      !> As in `couple_inertia`
      integer, intent(in) :: node
      real(wp), intent(in) :: half_step
      real(wp), intent(in), contiguous :: velocity(:), acceleration(:)
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

end module plydyn_method_implicit_inertia
