!> Neighbours and weights of the averages that drive the damage of plies.
!>
!> The weight of a Gauss point at distances a along and b across the fibres of the ply is its area
!> times (1 - (a/R1)**2 - (b/R2)**2)**2 within the ellipse of the radii R1 and R2; see "Averages
!> over neighbours" in manual/theory.md.
module plydyn_domain_averages
   use plydyn_base_error, only : error_type, exit_input, fail
   use plydyn_base_precision, only : lanes, wp
   use plydyn_base_text, only : text
   use plydyn_domain_decomposition, only : decomposition_type
   use plydyn_domain_domain, only : domain_type
   use plydyn_element_plate_crack_bands, only : rule_lengths
   use plydyn_domain_strain_halo, only : add_halo, strain_halo_type
   use plydyn_domain_neighbourhood, only : cell_grid_type, neighbourhood_type, new_cell_grid, &
      & new_neighbourhood
   use plydyn_element_average, only : neighbours_at_once, average_type
   use plydyn_element_plate_group, only : plates_of
   use plydyn_element_plate_layers, only : plate_type
   use plydyn_law_law, only : law_type
   use plydyn_law_ply_crack_band, only : rule_gauss_point
   use plydyn_model_model, only : model_type
   use plydyn_parallel_halo, only : new_halo
   implicit none
   private

   public :: build_averages

contains

   !> All averages of the plates. All ranks must come here
   subroutine build_averages(model, division, rank_of_chunk, domain, error)
      type(model_type), intent(in) :: model
      !> All quads
      type(decomposition_type), intent(in) :: division
      !> Rank of each chunk
      integer, intent(in) :: rank_of_chunk(:)
      !> Has its plates and their histories, gets its averages
      type(domain_type), intent(inout) :: domain
      !> Names a ply whose ellipse is too small for the mesh
      type(error_type), allocatable, intent(out) :: error

      type(strain_halo_type) :: strain_halo
      type(neighbourhood_type) :: around
      type(plate_type), allocatable :: plates(:)
      real(wp) :: radius
      integer :: a, p

      plates = plates_of(domain%groups)
      allocate (domain%averaging%averages(sum([(size(averaging_laws(plates(p)), 2), p=1, &
         & size(plates))])))
      allocate (strain_halo%sent(2, 0), strain_halo%received(2, 0))
      a = 0
      do p = 1, size(plates)
         radius = largest_radius(plates(p))
         if (radius <= 0.0_wp) cycle
         around = new_neighbourhood(model%mesh, division, rank_of_chunk, domain%comm%rank, p, &
            & plates(p), radius)
         call build_part(model, around, plates(p), p, domain, a, strain_halo, error)
         if (allocated(error)) return
      end do
      domain%averaging%strain_halo = new_halo(domain%comm%ranks, lanes, strain_halo%sent, &
         & strain_halo%received)
      domain%averaging%neighbours = count_points(model, domain)
   end subroutine build_averages

   !> The averages of a part
   subroutine build_part(model, around, plate, p, domain, a, strain_halo, error)
      type(model_type), intent(in) :: model
      !> Points of the plane
      type(neighbourhood_type), intent(in) :: around
      !> The plate of a part, and the part
      type(plate_type), intent(in) :: plate
      integer, intent(in) :: p
      type(domain_type), intent(inout) :: domain
      !> Averages that are built
      integer, intent(inout) :: a
      !> Strains that ranks send each other for them
      type(strain_halo_type), intent(inout) :: strain_halo
      type(error_type), allocatable, intent(out) :: error

      integer, allocatable :: places(:, :), point(:)
      integer :: i, k, length

      places = averaging_laws(plate)
      do i = 1, size(places, 2)
         a = a + 1
         k = places(2, i)
         associate (batch => plate%batches(places(1, i)), average => domain%averaging%averages(a))
            average = new_average(plate, places(1, i), k)
            average%plate = p
            call find_neighbours(around, batch%rotation(:, :, average%block), batch%laws(k)%law, &
               & average, point)
            length = domain%histories + domain%averaging%halo_strains
            call add_halo(around, point, length, average, strain_halo)
            domain%averaging%halo_strains = length - domain%histories
            call check_radius(model, domain, plate, average, batch%laws(k)%law, error)
         end associate
         if (allocated(error)) return
      end do
   end subroutine build_part

   !> Laws of a plate that average: batch, and law of it, (2, laws)
   pure function averaging_laws(plate) result(places)
      type(plate_type), intent(in) :: plate
      integer, allocatable :: places(:, :)
      integer :: b, k

      allocate (places(2, 0))
      do b = 1, size(plate%batches)
         do k = 1, size(plate%batches(b)%laws)
            if (plate%batches(b)%laws(k)%law%driving == 0) cycle
            places = reshape([places, b, k], [2, size(places, 2) + 1])
         end do
      end do
   end function averaging_laws

   !> Largest radius of the laws of a plate, 0 if none averages
   pure real(wp) function largest_radius(plate) result(radius)
      type(plate_type), intent(in) :: plate
      integer, allocatable :: places(:, :)
      integer :: i

      radius = 0.0_wp
      places = averaging_laws(plate)
      do i = 1, size(places, 2)
         associate (laws => plate%batches(places(1, i))%laws)
            radius = max(radius, maxval(laws(places(2, i))%law%radius))
         end associate
      end do
   end function largest_radius

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
         self%pitch = batch%pitch
         self%levels = size(batch%expansion%weight)
         self%plane = size(plate%node, 1)
         self%blocks = batch%blocks
         self%strains = law%driving
         self%behind_own = law%behind_own
         self%behind_mean = law%behind_mean
         self%owns(:) = law%owns
         self%layer(:) = batch%layer(:, self%block)
      end associate
   end function new_average

   !> Neighbours of all points of this rank, and their weights
   subroutine find_neighbours(around, turn, law, average, point)
      !> Points of the plane
      type(neighbourhood_type), intent(in) :: around
      !> Cosine and sine of the fibre direction of each lane
      real(wp), intent(in) :: turn(lanes, 2)
      class(law_type), intent(in) :: law
      type(average_type), intent(inout) :: average
      !> The neighbours, in the order of the whole model
      integer, allocatable, intent(out) :: point(:)

      type(cell_grid_type) :: grid
      integer, allocatable :: neighbours(:), own(:)
      real(wp), allocatable :: weight(:, :)
      integer :: i, n, pass

      own = pack([(i, i=1, size(around%area))], around%own_point([(i, i=1, size(around%area))]) > 0)
      if (size(own) > 0) grid = new_cell_grid(around%position, maxval(law%radius))
      allocate (average%first(size(own) + 1))
      do pass = 1, 2
         n = 0
         do i = 1, size(own)
            call find_weights(around, turn, law, own(i), &
               & grid%points_near(around%position(:, own(i))), neighbours, weight)
            average%first(i) = n + 1
            if (pass == 2) then
               point(n + 1:n + size(neighbours)) = neighbours
               average%weight(:, n + 1:n + size(neighbours)) = weight
            end if
            n = n + size(neighbours)
            ! made up with the point itself, without weight
            do while (modulo(n, neighbours_at_once) > 0)
               n = n + 1
               if (pass == 2) point(n) = own(i)
               if (pass == 2) average%weight(:, n) = 0.0_wp
            end do
         end do
         average%first(size(own) + 1) = n + 1
         if (pass == 1) allocate (point(n), average%weight(lanes, n))
      end do
   end subroutine find_neighbours

   !> Which of some points lie in the ellipse of any lane around a point, and their weights
   pure subroutine find_weights(around, turn, law, i, candidates, point, weight)
      type(neighbourhood_type), intent(in) :: around
      real(wp), intent(in) :: turn(lanes, 2)
      class(law_type), intent(in) :: law
      !> The point; points to look at
      integer, intent(in) :: i, candidates(:)
      !> Those in an ellipse, and their shares in the average of each lane
      integer, allocatable, intent(out) :: point(:)
      real(wp), allocatable, intent(out) :: weight(:, :)

      real(wp) :: away(2), share(lanes, size(candidates))
      integer :: j, l

      do j = 1, size(candidates)
         away(:) = around%position(:, candidates(j)) - around%position(:, i)
         do l = 1, lanes
            share(l, j) = 0.0_wp
            if (law%owns(l)) share(l, j) = around%area(candidates(j)) &
               & *bell(law%radius(l, :), turned(turn(l, :), away))
         end do
      end do
      point = pack(candidates, any(share > 0.0_wp, 1))
      weight = reshape(pack(share, spread(any(share > 0.0_wp, 1), 1, lanes)), [lanes, size(point)])
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

   !> Refuse an ellipse smaller than the cells of all Gauss points: nowhere would it cover another
   !> point along the fibres, or nowhere across them. All ranks come to the same
   subroutine check_radius(model, domain, plate, average, law, error)
      type(model_type), intent(in) :: model
      type(domain_type), intent(in) :: domain
      type(plate_type), intent(in) :: plate
      type(average_type), intent(in) :: average
      class(law_type), intent(in) :: law
      type(error_type), allocatable, intent(out) :: error

      real(wp) :: least(lanes), ratio(lanes), which(lanes)
      integer :: l

      call find_least_cells(plate, average, law, ratio, which)
      least(:) = -ratio
      call domain%comm%max(least)
      which(:) = merge(which, 0.0_wp, ratio <= -least)
      call domain%comm%max(which)
      do l = 1, lanes
         if (.not. average%owns(l) .or. -least(l) <= 1.0_wp) cycle
         call refuse(model, domain, average, l, nint(which(l)), -least(l), error)
         return
      end do
   end subroutine check_radius

   !> The cell of a rank's points in the plane that goes best into the ellipse of each lane
   pure subroutine find_least_cells(plate, average, law, ratio, which)
      type(plate_type), intent(in) :: plate
      type(average_type), intent(in) :: average
      class(law_type), intent(in) :: law
      !> The larger of its lengths over the radii, and which that is, the second of equal ones
      real(wp), intent(out) :: ratio(lanes), which(lanes)

      real(wp) :: each(2)
      integer :: e, l, q

      ratio(:) = huge(ratio)
      which(:) = 0.0_wp
      do l = 1, lanes
         if (.not. average%owns(l)) cycle
         do e = 1, size(plate%node, 2)
            do q = 1, size(plate%node, 1)
               each(:) = rule_lengths(plate, plate%batches(average%batch)%rotation(l, :, &
                  & average%block), rule_gauss_point, q, e)/law%radius(l, :)
               if (maxval(each) > ratio(l)) cycle
               if (maxval(each) < ratio(l)) which(l) = 0.0_wp
               ratio(l) = maxval(each)
               which(l) = max(which(l), real(maxloc(each, 1), wp))
            end do
         end do
      end do
   end subroutine find_least_cells

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

      ply = domain%layers%ply(average%layer(lane))
      associate (material => model%materials(model%parts(average%plate)%plies(ply)%material))
         call fail(error, exit_input, "error: "//material%radius_place//": *" &
            & //material%keyword//" R"//text(which)//": in ply "//text(ply) &
            & //" from the bottom, an ellipse of R"//text(which)//" = " &
            & //text(material%law%radius(which))//" is nowhere as large as the cell of a Gauss " &
            & //"point, "//text(factor*material%law%radius(which))//": make it a quad wide, or " &
            & //"the quads smaller, or leave both radii blank")
      end associate
   end subroutine refuse

   !> Fewest and most points in the ellipses of each material, (2, materials); 0 for none. All ranks
   !> must come here
   function count_points(model, domain) result(points)
      type(model_type), intent(in) :: model
      type(domain_type), intent(in) :: domain
      integer :: points(2, size(model%materials))

      real(wp) :: extremes(2*size(model%materials))
      integer :: a, i, l, now, place

      extremes(:) = -huge(extremes)
      do a = 1, size(domain%averaging%averages)
         associate (average => domain%averaging%averages(a))
            do l = 1, lanes
               if (.not. average%owns(l)) cycle
               place = 2*material_of(model, domain, average, l) - 1
               do i = 1, size(average%first) - 1
                  now = count(average%weight(l, average%first(i):average%first(i + 1) - 1) > 0.0_wp)
                  extremes(place:place + 1) = max(extremes(place:place + 1), &
                     & real([-now, now], wp))
               end do
            end do
         end associate
      end do
      call domain%comm%max(extremes)
      points(:, :) = 0
      do i = 1, size(points, 2)
         if (extremes(2*i) > 0.0_wp) points(:, i) = nint([-extremes(2*i - 1), extremes(2*i)])
      end do
   end function count_points

   !> Material of a lane of an average
   pure integer function material_of(model, domain, average, lane) result(material)
      type(model_type), intent(in) :: model
      type(domain_type), intent(in) :: domain
      type(average_type), intent(in) :: average
      integer, intent(in) :: lane

      material = model%parts(average%plate)%plies(domain%layers%ply(average%layer(lane)))%material
   end function material_of

end module plydyn_domain_averages
