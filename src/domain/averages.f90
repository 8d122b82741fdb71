!> Neighbours and weights of the averages that drive the damage of plies.
!>
!> The weight of a Gauss point at distances a along and b across the fibres of the ply is its area
!> times (1 - (a/R1)**2 - (b/R2)**2)**2 within the ellipse of the radii R1 and R2; see "Averages
!> over neighbours" in manual/theory.md.
module plydyn_domain_averages
   use plydyn_base_error, only : error_type, exit_input, fail
   use plydyn_base_precision, only : lanes, wp
   use plydyn_base_text, only : text
   use plydyn_domain_cell_grid, only : cell_grid_type, new_cell_grid
   use plydyn_domain_domain, only : domain_type
   use plydyn_domain_histories, only : cell_lengths
   use plydyn_element_average, only : abreast, average_type, row_of
   use plydyn_element_plate, only : plate_type
   use plydyn_law_law, only : law_type
   use plydyn_model_material, only : material_type
   use plydyn_model_model, only : model_type
   implicit none
   private

   public :: build_averages, count_points, refuse_ranks

contains

   !> All averages of the plates
   subroutine build_averages(model, domain, error)
      !> The model
      type(model_type), intent(in) :: model
      !> Has its plates, gets its averages
      type(domain_type), intent(inout) :: domain
      !> Names a ply whose ellipse is too small for the mesh
      type(error_type), allocatable, intent(out) :: error

      integer :: a, b, k, p

      allocate (domain%averages(count_averages(domain%plates)))
      a = 0
      do p = 1, size(domain%plates)
         do b = 1, size(domain%plates(p)%batches)
            associate (plate => domain%plates(p), batch => domain%plates(p)%batches(b))
               do k = 1, size(batch%laws)
                  if (batch%laws(k)%law%driving == 0) cycle
                  a = a + 1
                  domain%averages(a) = new_average(plate, b, k)
                  domain%averages(a)%plate = p
                  call find_neighbours(plate, batch%turn(:, :, batch%laws(k)%block), &
                     & batch%laws(k)%law, point_positions(plate, domain%position), &
                     & domain%averages(a))
                  call check_reach(model, domain, domain%averages(a), batch%laws(k)%law, error)
                  if (allocated(error)) return
               end do
            end associate
         end do
      end do
   end subroutine build_averages

   !> How many laws of how many blocks average
   pure integer function count_averages(plates) result(averages)
      type(plate_type), intent(in) :: plates(:)
      integer :: b, k, p

      averages = 0
      do p = 1, size(plates)
         do b = 1, size(plates(p)%batches)
            associate (laws => plates(p)%batches(b)%laws)
               averages = averages + count([(laws(k)%law%driving > 0, k=1, size(laws))])
            end associate
         end do
      end do
   end function count_averages

   !> Where a law has its histories
   pure function new_average(plate, b, k) result(self)
      type(plate_type), intent(in) :: plate
      !> Batch and law of it
      integer, intent(in) :: b, k
      type(average_type) :: self

      associate (batch => plate%batches(b), law => plate%batches(b)%laws(k)%law)
         self%batch = b
         self%block = plate%batches(b)%laws(k)%block
         self%first_history = batch%first_history
         self%histories = batch%histories
         self%levels = size(batch%expansion%weight)
         self%plane = size(plate%node, 1)
         self%blocks = batch%blocks
         self%strains = law%driving
         self%behind_own = law%behind_own
         self%behind_mean = law%behind_mean
         self%owns(:) = law%owns
      end associate
   end function new_average

   !> Gauss points of the plane, (2, points of a quad times quads)
   pure function point_positions(plate, position) result(points)
      type(plate_type), intent(in) :: plate
      !> Positions of the nodes, (3, nodes)
      real(wp), intent(in) :: position(:, :)
      real(wp) :: points(2, size(plate%node))

      integer :: e, n

      n = size(plate%node, 1)
      do e = 1, size(plate%node, 2)
         points(:, n*(e - 1) + 1:n*e) = matmul(position(1:2, plate%node(:, e)), &
            & transpose(plate%shape))
      end do
   end function point_positions

   !> Neighbours of all points, and their weights
   subroutine find_neighbours(plate, turn, law, position, average)
      type(plate_type), intent(in) :: plate
      !> Cosine and sine of the fibre direction of each lane
      real(wp), intent(in) :: turn(lanes, 2)
      class(law_type), intent(in) :: law
      !> The Gauss points
      real(wp), intent(in) :: position(:, :)
      type(average_type), intent(inout) :: average

      type(cell_grid_type) :: grid
      integer, allocatable :: point(:)
      real(wp), allocatable :: weight(:, :)
      integer :: i, n, pass

      grid = new_cell_grid(position, maxval(law%radius))
      allocate (average%first(size(position, 2) + 1))
      do pass = 1, 2
         n = 0
         do i = 1, size(position, 2)
            call find_weights(plate, turn, law, position, i, grid%near(position(:, i)), point, &
               & weight)
            average%first(i) = n + 1
            if (pass == 2) then
               average%point(n + 1:n + size(point)) = point
               average%weight(:, n + 1:n + size(point)) = weight
            end if
            n = n + size(point)
            ! made up with the point itself, without weight
            do while (modulo(n, abreast) > 0)
               n = n + 1
               if (pass == 2) average%point(n) = i
               if (pass == 2) average%weight(:, n) = 0.0_wp
            end do
         end do
         average%first(i) = n + 1
         if (pass == 1) allocate (average%point(n), average%weight(lanes, n))
      end do
      average%row = [(row_of(average, average%point(i)), i=1, n)]
   end subroutine find_neighbours

   !> Which of some points lie in the ellipse of any lane around a point, and their weights
   pure subroutine find_weights(plate, turn, law, position, i, near, point, weight)
      type(plate_type), intent(in) :: plate
      real(wp), intent(in) :: turn(lanes, 2)
      class(law_type), intent(in) :: law
      real(wp), intent(in) :: position(:, :)
      !> The point
      integer, intent(in) :: i
      !> Points to look at
      integer, intent(in) :: near(:)
      !> Those in an ellipse, and their shares in the average of each lane
      integer, allocatable, intent(out) :: point(:)
      real(wp), allocatable, intent(out) :: weight(:, :)

      real(wp) :: all(lanes, size(near))
      integer :: j, l, quad

      do j = 1, size(near)
         quad = (near(j) - 1)/size(plate%node, 1)
         associate (area => plate%metric(5, near(j) - size(plate%node, 1)*quad, quad + 1), &
            & away => position(:, near(j)) - position(:, i))
            do l = 1, lanes
               all(l, j) = 0.0_wp
               if (law%owns(l)) all(l, j) = area*bell(law%radius(l, :), turned(turn(l, :), away))
            end do
         end associate
      end do
      point = pack(near, any(all > 0.0_wp, 1))
      weight = reshape(pack(all, spread(any(all > 0.0_wp, 1), 1, lanes)), [lanes, size(point)])
      do l = 1, lanes
         if (law%owns(l)) weight(l, :) = weight(l, :)/sum(weight(l, :))
      end do
   end subroutine find_weights

   !> A distance along the fibres and across them
   pure function turned(turn, away)
      real(wp), intent(in) :: turn(2), away(2)
      real(wp) :: turned(2)

      turned(:) = [turn(1)*away(1) + turn(2)*away(2), turn(1)*away(2) - turn(2)*away(1)]
   end function turned

   !> Weight at a distance: 1 in the middle of the ellipse, 0 from its border on
   pure real(wp) function bell(radius, away)
      !> Along the fibres and across them
      real(wp), intent(in) :: radius(2), away(2)

      bell = max(1.0_wp - sum((away/radius)**2), 0.0_wp)**2
   end function bell

   !> Refuse an ellipse smaller than the cells of all Gauss points: nowhere would it reach another
   !> point along the fibres, or nowhere across them
   subroutine check_reach(model, domain, average, law, error)
      type(model_type), intent(in) :: model
      type(domain_type), intent(in) :: domain
      type(average_type), intent(in) :: average
      class(law_type), intent(in) :: law
      type(error_type), allocatable, intent(out) :: error

      real(wp) :: least(2), length(2)
      integer :: e, l, q

      associate (plate => domain%plates(average%plate))
         do l = 1, lanes
            if (.not. average%owns(l)) cycle
            least(:) = cell_lengths(plate, plate%batches(average%batch)%turn(l, :, &
               & average%block), 1, 1)
            do e = 1, size(plate%node, 2)
               do q = 1, size(plate%node, 1)
                  length(:) = cell_lengths(plate, plate%batches(average%batch)%turn(l, :, &
                     & average%block), q, e)
                  if (maxval(length/law%radius(l, :)) < maxval(least/law%radius(l, :))) then
                     least(:) = length
                  end if
               end do
            end do
            if (all(law%radius(l, :) >= least)) cycle
            call refuse(model, domain, average, l, maxloc(least/law%radius(l, :), 1), &
               & maxval(least/law%radius(l, :)), error)
            return
         end do
      end associate
   end subroutine check_reach

   !> Say what radius is too small
   subroutine refuse(model, domain, average, lane, which, factor, error)
      type(model_type), intent(in) :: model
      type(domain_type), intent(in) :: domain
      type(average_type), intent(in) :: average
      integer, intent(in) :: lane
      !> Which of the radii, and how much larger the least cell is
      integer, intent(in) :: which
      real(wp), intent(in) :: factor
      type(error_type), allocatable, intent(out) :: error

      integer :: ply

      ply = domain%layers%ply(domain%plates(average%plate)%batches(average%batch)%layer(lane, &
         & average%block))
      associate (material => model%materials(model%parts(average%plate)%plies(ply)%material))
         call fail(error, exit_input, "error: "//material%radius_place//": *" &
            & //material%keyword//" R"//text(which)//": in ply "//text(ply) &
            & //" from the bottom, an ellipse of R"//text(which)//" = " &
            & //text(material%radius(which))//" is nowhere as large as the cell of a Gauss " &
            & //"point, "//text(factor*material%radius(which))//": make it a quad wide, or the " &
            & //"quads smaller, or leave both radii blank")
      end associate
   end subroutine refuse

   !> Refuse averages over points of other ranks
   subroutine refuse_ranks(materials, ranks, error)
      !> Materials of the model
      type(material_type), intent(in) :: materials(:)
      !> Ranks of the run
      integer, intent(in) :: ranks
      !> Names the first material that averages
      type(error_type), allocatable, intent(out) :: error

      integer :: i

      if (ranks == 1) return
      do i = 1, size(materials)
         if (.not. materials(i)%averages()) cycle
         call fail(error, exit_input, "error: "//materials(i)%radius_place//": *" &
            & //materials(i)%keyword//" R1: an average over neighbours does not go with " &
            & //text(ranks)//" ranks: run it on one rank, with as many threads as you like")
         return
      end do
   end subroutine refuse_ranks

   !> Fewest and most points in the ellipses of each material, (2, materials); 0 for none
   pure function count_points(model, domain) result(points)
      !> The model
      type(model_type), intent(in) :: model
      !> The domain
      type(domain_type), intent(in) :: domain
      integer :: points(2, size(model%materials))

      integer :: a, i, l, material, now

      points(:, :) = 0
      do a = 1, size(domain%averages)
         associate (average => domain%averages(a), batches => domain%plates( &
            & domain%averages(a)%plate)%batches)
            do l = 1, lanes
               if (.not. average%owns(l)) cycle
               material = model%parts(average%plate)%plies(domain%layers%ply( &
                  & batches(average%batch)%layer(l, average%block)))%material
               do i = 1, size(average%first) - 1
                  now = count(average%weight(l, average%first(i):average%first(i + 1) - 1) > 0.0_wp)
                  if (points(1, material) == 0) points(1, material) = now
                  points(:, material) = [min(points(1, material), now), &
                     & max(points(2, material), now)]
               end do
            end do
         end associate
      end do
   end function count_points

end module plydyn_domain_averages
