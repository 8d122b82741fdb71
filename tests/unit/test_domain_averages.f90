!> Averages over neighbours: which points, with what weights, and what becomes of a field.
program test_domain_averages
   use plydyn_base_error, only : error_type
   use plydyn_base_precision, only : lanes, wp
   use plydyn_domain_build, only : build_domain
   use plydyn_domain_neighbourhood, only : cell_grid_type, new_cell_grid
   use plydyn_domain_domain, only : domain_type
   use plydyn_element_average, only : average_points, row_of
   use plydyn_law_ply_constants, only : ply_constants_type
   use plydyn_model_material, only : add_material, material_type
   use plydyn_model_model, only : model_type
   use ply_point, only : paper_ply
   use sample, only : rectangle_mesh, rectangle_model
   use testing, only : begin, check, check_error, finish
   use groups, only : plate_of
   use plydyn_element_plate_layers, only : plate_type
   implicit none

   !> Quads along x and y, and their size
   integer, parameter :: n = 5, m = 4
   real(wp), parameter :: length = 5.0_wp, width = 3.2_wp
   !> Fibre directions of the plies, and radii
   real(wp), parameter :: angles(3) = [30.0_wp, 0.0_wp, -75.0_wp], radii(2) = [1.3_wp, 0.8_wp]
   !> Error of a sum of some dozens of shares of the largest value
   real(wp), parameter :: rounded = 50.0_wp*epsilon(1.0_wp)

   call test_grid()
   call test_constant()
   call test_weights()
   call test_parts()
   call test_other_lane()
   call test_counts()
   call test_ghosts()
   call test_refused()
   call finish()

contains

   !> All points within reach are found, in rising order
   subroutine test_grid()
      type(cell_grid_type) :: grid
      integer, allocatable :: found(:)
      integer :: i, j
      logical :: all_there, rises
      real(wp) :: position(2, 60)

      call begin("cell grid")
      do i = 1, size(position, 2)
         position(:, i) = [modulo(7.3_wp*i, 4.1_wp), modulo(3.7_wp*i, 2.3_wp)]
      end do
      grid = new_cell_grid(position, 0.6_wp)
      all_there = .true.
      rises = .true.
      do i = 1, size(position, 2)
         found = grid%points_near(position(:, i))
         rises = rises .and. all(found(2:) > found(:size(found) - 1))
         do j = 1, size(position, 2)
            if (norm2(position(:, i) - position(:, j)) > 0.6_wp) cycle
            all_there = all_there .and. any(found == j)
         end do
      end do
      call check(all_there, "has all within reach")
      call check(rises, "in their order")
   end subroutine test_grid

   !> The average of a uniform field is the field, at every point of a distorted mesh
   subroutine test_constant()
      type(domain_type) :: domain
      real(wp), allocatable :: history(:)
      real(wp) :: worst
      integer :: a

      call begin("constant")
      call build(averaged(0.05_wp), domain, history)
      call check(size(domain%averaging%averages) == 2, "one for each order of the layers")
      history(:) = 0.3125_wp
      worst = 0.0_wp
      do a = 1, size(domain%averaging%averages)
         call apply(domain, a, history)
         worst = max(worst, maxval(abs(history - 0.3125_wp)))
      end do
      call check(worst, 0.0_wp, rounded, "stays")
   end subroutine test_constant

   !> Against all pairs of points of a distorted mesh, with each ply's own axes
   subroutine test_weights()
      type(plate_type) :: plate
      type(domain_type) :: domain
      real(wp), allocatable :: field(:, :), history(:), points(:, :), shares(:)
      real(wp) :: worst
      integer :: a, i, l, level

      call begin("weights")
      call build(averaged(0.05_wp), domain, history)
      points = gauss_points_of(domain, 1)
      plate = plate_of(domain, 1)
      worst = 0.0_wp
      do a = 1, size(domain%averaging%averages)
         associate (average => domain%averaging%averages(a))
            field = reshape(sin([(real(i, wp), i=1, lanes*size(points, 2))]), &
               & [lanes, size(points, 2)])
            do level = 1, average%levels
               do i = 1, size(points, 2)
                  call put(domain, a, i, level, field(:, i)*level, history)
               end do
            end do
            call apply(domain, a, history)
            do l = 1, lanes
               if (plate%batches(average%batch)%layer(l, 1) == 0) cycle
               do i = 1, size(points, 2)
                  shares = shares_of(plate%angle(plate%batches(average%batch)%layer(l, 1)), &
                     & points, reshape(plate%metric(5, :, :), [size(points, 2)]), i)
                  do level = 1, average%levels
                     worst = max(worst, abs(mean_at(domain, a, i, level, l, history) &
                        & - level*dot_product(shares, field(l, :))))
                  end do
               end do
            end do
         end associate
      end do
      call check(worst, 0.0_wp, rounded, "of bell and area")
   end subroutine test_weights

   !> Shares of all points in the average at a point, from the definition
   pure function shares_of(angle, points, area, i) result(shares)
      real(wp), intent(in) :: angle, points(:, :), area(:)
      integer, intent(in) :: i
      real(wp) :: shares(size(area))

      real(wp), parameter :: degree = acos(-1.0_wp)/180.0_wp
      real(wp) :: far, slope
      integer :: j

      do j = 1, size(area)
         far = norm2(points(:, j) - points(:, i))
         slope = atan2(points(2, j) - points(2, i), points(1, j) - points(1, i)) - angle*degree
         far = (far*cos(slope)/radii(1))**2 + (far*sin(slope)/radii(2))**2
         shares(j) = merge(area(j)*(1.0_wp - 2.0_wp*far + far**2), 0.0_wp, far < 1.0_wp)
      end do
      shares(:) = shares/sum(shares)
   end function shares_of

   !> What another part has is left out, however near it is
   subroutine test_parts()
      type(domain_type) :: domain
      type(model_type) :: model
      real(wp), allocatable :: history(:)
      real(wp) :: worst
      integer :: a, i

      call begin("parts")
      model = averaged(0.0_wp)
      model%parts = [model%parts(1), model%parts(1)]
      model%mesh%quad_part(:) = [(merge(1, 2, modulo(i, n) < 3), i=1, n*m)]
      call build(model, domain, history)
      call check(size(domain%averaging%averages) == 4, "each has its own")
      do a = 1, size(domain%averaging%averages)
         associate (average => domain%averaging%averages(a))
            do i = 1, size(average%first) - 1
               call put(domain, a, i, 1, spread(real(average%plate, wp), 1, lanes), history)
            end do
         end associate
      end do
      worst = 0.0_wp
      do a = 1, size(domain%averaging%averages)
         call apply(domain, a, history)
         do i = 1, size(domain%averaging%averages(a)%first) - 1
            worst = max(worst, abs(mean_at(domain, a, i, 1, first_lane(domain, a), history) &
               & - domain%averaging%averages(a)%plate))
         end do
      end do
      call check(worst, 0.0_wp, rounded, "each keeps its own field")
   end subroutine test_parts

   !> Histories of lanes that another law has are left alone
   subroutine test_other_lane()
      type(domain_type) :: domain
      type(material_type) :: material
      type(model_type) :: model
      real(wp), allocatable :: history(:)
      integer :: other

      call begin("other laws")
      model = averaged(0.0_wp)
      material%density = model%materials(1)%density
      material%title = "without an average"
      call add_material(model%materials, material, paper_ply())
      model%parts(1)%plies%material = [1, 1, 2]
      call build(model, domain, history)
      call check(size(domain%averaging%averages) == 2, "only what has radii is averaged")
      associate (average => domain%averaging%averages(1))
         other = other_lane(domain, 1)
         call check(count(average%owns) == 1 .and. other > 0, "one lane of two")
         history(:) = 0.0_wp
         call put(domain, 1, 1, 1, spread(2.0_wp, 1, lanes), history)
         call apply(domain, 1, history)
         call check(mean_at(domain, 1, 1, 1, other, history), 0.0_wp, 0.0_wp, "leaves the other")
         call check(mean_at(domain, 1, 1, 1, first_lane(domain, 1), history) > 0.0_wp, &
            & "averages its own")
      end associate
   end subroutine test_other_lane

   !> Points in the circle around the corner of a mesh and in its middle
   subroutine test_counts()
      type(domain_type) :: domain
      type(model_type) :: model
      real(wp), allocatable :: history(:)

      call begin("counts")
      model = rectangle_model(rectangle_mesh(2, 4, 4, 4.0_wp, 4.0_wp, 0.0_wp), [0.0_wp], &
         & 0.25_wp, [1])
      call average_model(model)
      ! between the diagonal of a point's four neighbours and the next, 1 away
      model%materials(1)%law%radius(:) = 0.9_wp
      call build(model, domain, history)
      call check(all(domain%averaging%neighbours == reshape([4, 9], [2, 1])), &
         & "4 in a corner, 9 within")
   end subroutine test_counts

   !> Strains that lie where those of other ranks are kept give the same average to the last bit
   subroutine test_ghosts()
      type(domain_type) :: domain
      real(wp), allocatable :: history(:), moved(:)
      real(wp) :: worst
      integer :: a, i, k, level, points

      call begin("ghosts")
      call build(averaged(0.05_wp), domain, history)
      worst = 0.0_wp
      do a = 1, size(domain%averaging%averages)
         associate (average => domain%averaging%averages(a))
            points = size(average%first) - 1
            do i = 1, size(history)
               history(i) = sin(real(i, wp))
            end do
            ! every other point is a ghost, and its own values count for nothing then
            moved = [history, spread(0.0_wp, 1, lanes*average%strains*average%levels*points)]
            average%first_ghost = (size(history) - average%first_history + 1)/lanes
            call apply(domain, a, history)
            do i = 2, points, 2
               where (average%row == row_of(average, i, average%behind_own + 1)) &
                  & average%row = average%first_ghost + average%strains*average%levels*(i - 1)
               do level = 1, average%levels
                  do k = 1, average%strains
                     call move_strain(domain, a, [i, level, k], moved)
                  end do
               end do
            end do
            call apply(domain, a, moved)
            do i = 1, points
               do level = 1, average%levels
                  worst = max(worst, abs( &
                     & mean_at(domain, a, i, level, first_lane(domain, a), moved) &
                     & - mean_at(domain, a, i, level, first_lane(domain, a), history)))
               end do
            end do
         end associate
      end do
      call check(worst, 0.0_wp, 0.0_wp, "are added as neighbours are")
   end subroutine test_ghosts

   !> Move a strain to where those of other ranks are kept
   subroutine move_strain(domain, a, which, history)
      type(domain_type), intent(in) :: domain
      integer, intent(in) :: a
      !> Point, height and strain
      integer, intent(in) :: which(3)
      real(wp), intent(inout), contiguous :: history(:)

      integer :: from, to

      associate (average => domain%averaging%averages(a))
         from = place_of(domain, a, which(1), which(2), average%behind_own + which(3))
         to = average%first_history + lanes*(average%first_ghost + which(2) - 1 &
            & + average%levels*(which(3) - 1 + average%strains*(which(1) - 1)))
         history(to:to + lanes - 1) = history(from:from + lanes - 1)
         history(from:from + lanes - 1) = 1.0e3_wp
      end associate
   end subroutine move_strain

   !> Ellipses too small for the mesh
   subroutine test_refused()
      type(domain_type) :: domain
      type(error_type), allocatable :: error
      type(model_type) :: model

      call begin("refused")
      model = averaged(0.0_wp)
      model%materials(1)%law%radius(:) = [2.0_wp, 0.05_wp]
      call build_domain(model, domain, error)
      call check_error(error, "a.k:9: *MAT_PLY_CODAM2 R2: in ply 1 from the bottom", &
         & "place and radius")
      model%materials(1)%law%radius(:) = [0.05_wp, 0.07_wp]
      call build_domain(model, domain, error)
      call check_error(error, "R1 = 0.05 is nowhere as large as the cell", &
         & "what is wrong")
   end subroutine test_refused

   !> Three plies of two orders over quads of nine nodes
   function averaged(distortion) result(model)
      real(wp), intent(in) :: distortion
      type(model_type) :: model

      model = rectangle_model(rectangle_mesh(3, n, m, length, width, distortion), angles, &
         & 0.25_wp, [1, 2, 1])
      call average_model(model)
   end function averaged

   !> Let all plies be damaged by averages
   subroutine average_model(model)
      type(model_type), intent(inout) :: model

      type(ply_constants_type) :: ply

      ply = paper_ply()
      ply%radius(:) = radii
      associate (material => model%materials(1))
         material%keyword = "MAT_PLY_CODAM2"
         material%radius_place = "a.k:9"
         deallocate (material%law)
         allocate (material%law, source=ply)
      end associate
   end subroutine average_model

   !> The domain and its history, all zero
   subroutine build(model, domain, history)
      type(model_type), intent(in) :: model
      type(domain_type), intent(out) :: domain
      real(wp), allocatable, intent(out) :: history(:)

      type(error_type), allocatable :: error

      call build_domain(model, domain, error)
      call check(.not. allocated(error), "the domain is built")
      allocate (history(domain%histories), source=0.0_wp)
   end subroutine build

   !> Average over all quads
   subroutine apply(domain, a, history)
      type(domain_type), intent(in) :: domain
      integer, intent(in) :: a
      real(wp), intent(inout), contiguous :: history(:)

      associate (average => domain%averaging%averages(a))
         call average_points(average, [1, (size(average%first) - 1)/average%plane], &
            & history(average%first_history:))
      end associate
   end subroutine apply

   !> Place in the history of a variable of a point
   pure integer function place_of(domain, a, point, level, variable) result(place)
      type(domain_type), intent(in) :: domain
      integer, intent(in) :: a, point, level, variable

      associate (average => domain%averaging%averages(a))
         place = average%first_history + lanes*(row_of(average, point, variable) &
            & + level - 1)
      end associate
   end function place_of

   !> Give a point a value of the first strain
   subroutine put(domain, a, point, level, values, history)
      type(domain_type), intent(in) :: domain
      integer, intent(in) :: a, point, level
      real(wp), intent(in) :: values(lanes)
      real(wp), intent(inout), contiguous :: history(:)

      integer :: first

      first = place_of(domain, a, point, level, domain%averaging%averages(a)%behind_own + 1)
      history(first:first + lanes - 1) = values
   end subroutine put

   !> Average of the first strain in a lane
   pure real(wp) function mean_at(domain, a, point, level, lane, history) result(mean)
      type(domain_type), intent(in) :: domain
      integer, intent(in) :: a, point, level, lane
      real(wp), intent(in), contiguous :: history(:)

      mean = history(place_of(domain, a, point, level, domain%averaging%averages(a)%behind_mean &
         & + 1) &
         & + lane - 1)
   end function mean_at

   !> First lane of an average
   pure integer function first_lane(domain, a)
      type(domain_type), intent(in) :: domain
      integer, intent(in) :: a

      first_lane = maxloc(merge(1, 0, domain%averaging%averages(a)%owns), 1)
   end function first_lane

   !> A lane with a layer of another law
   pure integer function other_lane(domain, a) result(lane)
      type(domain_type), intent(in) :: domain
      integer, intent(in) :: a

      associate (average => domain%averaging%averages(a))
         lane = maxloc(merge(1, 0, .not. average%owns .and. average%layer > 0), 1)
      end associate
   end function other_lane

   !> Gauss points of a plate from the shape functions, (2, points)
   pure function gauss_points_of(domain, p) result(points)
      type(domain_type), intent(in) :: domain
      integer, intent(in) :: p
      real(wp), allocatable :: points(:, :)

      type(plate_type) :: plate
      integer :: e, i, q

      plate = plate_of(domain, p)
      associate (nodes => plate%node)
         allocate (points(2, size(plate%node)))
         i = 0
         do e = 1, size(plate%node, 2)
            do q = 1, size(plate%node, 1)
               i = i + 1
               points(1, i) = sum(plate%shape(q, :)*domain%position(1, plate%node(:, e)))
               points(2, i) = sum(plate%shape(q, :)*domain%position(2, plate%node(:, e)))
            end do
         end do
      end associate
   end function gauss_points_of

end program test_domain_averages
