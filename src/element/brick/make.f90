!> Bricks from the model.
module plydyn_element_brick_make
   use plydyn_base_precision, only : lanes, wp
   use plydyn_fem_columns, only : columns_type
   use plydyn_element_brick_bricks, only : brick_shape_type, brick_shares, bricks_type, corners, &
      & new_brick_shape, same_shape
   use plydyn_element_material_batch, only : c33, new_material_batch
   use plydyn_law_ply_elastic, only : turned_stiffness
   use plydyn_model_layup, only : hourglass_stiffness, hourglass_viscous
   use plydyn_model_mesh, only : mesh_type
   use plydyn_model_model, only : model_type
   implicit none
   private

   public :: add_brick_masses, brick_density, find_shapes, new_bricks, set_batches

   !> Batches of bricks in a chunk, but for the last one of a part
   integer, parameter, public :: most_batches = 256
   !> Geometries that are looked through for one that is the same
   integer, parameter :: remembered = 8
   !> Directions that are the same, degrees
   real(wp), parameter :: same_angle = 1.0e-9_wp

contains

   !> All bricks, still without geometry and places; those of a part with fibres in one direction
   !> together, in the order of the deck
   function new_bricks(model) result(all)
      !> The model
      type(model_type), intent(in) :: model
      type(bricks_type), allocatable :: all(:)

      integer, allocatable :: first(:)
      integer :: group(size(model%mesh%brick_id)), i, k

      call find_groups(model, group, first)
      allocate (all(size(first)))
      do k = 1, size(first)
         all(k) = new_group(model, first(k), pack([(i, i=1, size(group))], group == k))
      end do
   end function new_bricks

   !> Number the groups of bricks of one part and one direction, as they come in the deck
   pure subroutine find_groups(model, group, first)
      type(model_type), intent(in) :: model
      !> Group of each brick
      integer, intent(out) :: group(:)
      !> First brick of each group
      integer, allocatable, intent(out) :: first(:)

      integer :: e, k

      allocate (first(0))
      associate (part => model%mesh%brick_part, angle => model%mesh%brick_angle)
         do e = 1, size(group)
            do k = size(first), 1, -1
               if (part(e) == part(first(k)) &
                  & .and. abs(angle(e) - angle(first(k))) <= same_angle) exit
            end do
            if (k == 0) then
               first = [first, e]
               k = size(first)
            end if
            group(e) = k
         end do
      end associate
   end subroutine find_groups

   !> Bricks of one part with fibres in one direction
   function new_group(model, first, members) result(self)
      type(model_type), intent(in) :: model
      !> One of them, and all
      integer, intent(in) :: first, members(:)
      type(bricks_type) :: self

      self%part = model%mesh%brick_part(first)
      self%angle = model%mesh%brick_angle(first)
      self%brick = members
      associate (section => model%parts(self%part)%brick, &
         & material => model%parts(self%part)%plies(1)%material)
         self%material_batch_type = new_material_batch(model%materials, &
            & reshape(spread(material, 1, lanes), [lanes, 1]), &
            & reshape(spread(1.0_wp, 1, lanes), [lanes, 1]), &
            & reshape(spread(self%angle, 1, lanes), [lanes, 1]))
         self%points = section%points
         self%shares_volume = section%points > 1 &
            & .and. .not. model%materials(material)%is_damaged()
         if (self%points == 1 .and. section%control == hourglass_viscous) then
            ! pressure waves: the velocity of the fastest along an axis
            self%viscosity = section%coefficient*sqrt(brick_density(model, self%part) &
               & *maxval(self%stiffness(1, [1, 5, c33], 1)))/4.0_wp
            self%histories = self%histories + 1
         end if
      end associate
   end function new_group

   !> Leave a rank some batches of bricks, and give them their places
   pure subroutine set_batches(mesh, batches, local_node, columns, self)
      !> The mesh
      type(mesh_type), intent(in) :: mesh
      !> The batches, whole chunks of them
      integer, intent(in) :: batches(:)
      !> The rank's number of each node of the mesh, 0 where it does not have it
      integer, intent(in) :: local_node(:)
      !> Where the points lie
      type(columns_type), intent(in) :: columns
      !> All bricks of a part in, those of the batches out; targets are the places
      type(bricks_type), intent(inout) :: self

      integer :: b, e, l
      integer, allocatable :: some(:)

      some = [((lanes*(batches(b) - 1) + l, l=1, lanes), b=1, size(batches))]
      allocate (self%place(lanes, corners, size(batches)))
      do b = 1, size(batches)
         do l = 1, lanes
            e = self%brick(min(some(lanes*(b - 1) + l), size(self%brick)))
            self%place(l, :, b) = columns%freedom(1, 1, 1, &
               & local_node(mesh%brick_node(:, e)))
         end do
      end do
      self%target = self%place
      self%brick = self%brick(pack(some, some <= size(self%brick)))
   end subroutine set_batches

   !> Mass per volume of a part
   pure real(wp) function brick_density(model, p) result(density)
      !> The model
      type(model_type), intent(in) :: model
      !> Index of the part
      integer, intent(in) :: p

      density = model%materials(model%parts(p)%plies(1)%material)%density
   end function brick_density

   !> Geometry of each batch; the same one only once in a chunk, and none of another chunk: which
   !> of two that differ by round-off a batch gets does not depend on the rank that has it
   pure subroutine find_shapes(model, batches, self)
      !> The model
      type(model_type), intent(in) :: model
      !> Their numbers in the part
      integer, intent(in) :: batches(:)
      !> Has these bricks, gets their geometry
      type(bricks_type), intent(inout) :: self

      type(brick_shape_type), allocatable :: longer(:)
      type(brick_shape_type) :: shape
      real(wp) :: stiffness(6, 6)
      integer :: b, first, known, s

      ! the share of hourglass control
      stiffness(:, :) = 0.0_wp
      associate (part => model%parts(self%part))
         if (part%brick%control == hourglass_stiffness) stiffness(:, :) = part%brick%coefficient &
            & *turned_stiffness(model%materials(part%plies(1)%material)%law, self%angle)
      end associate
      allocate (self%shapes(1), self%shape(size(batches)))
      known = 0
      first = 1
      do b = 1, size(batches)
         if (mod(batches(b) - 1, most_batches) == 0) first = known + 1
         shape = new_brick_shape(batch_positions(model, self%brick, b), &
            & min(lanes, size(self%brick) - lanes*(b - 1)), self%points, stiffness)
         do s = known, max(first, known - remembered + 1), -1
            if (same_shape(shape, self%shapes(s))) exit
         end do
         if (s < max(first, known - remembered + 1)) then
            known = known + 1
            s = known
            if (known > size(self%shapes)) then
               allocate (longer(2*size(self%shapes)))
               longer(:size(self%shapes)) = self%shapes
               call move_alloc(longer, self%shapes)
            end if
            self%shapes(s) = shape
         end if
         self%shape(b) = s
      end do
      self%shapes = self%shapes(:known)
   end subroutine find_shapes

   !> Nodes of the bricks of a batch, (3, 8, lanes); lanes without a brick have those of the last
   pure function batch_positions(model, brick, batch) result(position)
      type(model_type), intent(in) :: model
      !> All bricks, and the number of the batch among them
      integer, intent(in) :: brick(:), batch
      real(wp) :: position(3, corners, lanes)
      integer :: l

      do l = 1, lanes
         position(:, :, l) = model%mesh%position(:, model%mesh%brick_node(:, &
            & brick(min(lanes*(batch - 1) + l, size(brick)))))
      end do
   end function batch_positions

   !> Add the masses of some bricks, or shares of them, to those of the points that a rank has
   pure subroutine add_brick_masses(model, bricks, local_node, columns, mass, share)
      !> The model
      type(model_type), intent(in) :: model
      !> The bricks, indices into the mesh; this and the rest as in `add_masses` of
      !> `element_group_type`
      integer, intent(in) :: bricks(:), local_node(:)
      type(columns_type), intent(in) :: columns
      real(wp), intent(inout) :: mass(:)
      real(wp), intent(in), optional :: share(:)

      integer :: c, here(corners), i, place
      real(wp) :: added(corners), density

      do i = 1, size(bricks)
         associate (node => model%mesh%brick_node(:, bricks(i)))
            here(:) = local_node(node)
            if (all(here == 0)) cycle
            density = brick_density(model, model%mesh%brick_part(bricks(i)))
            if (present(share)) density = share(bricks(i))*density
            added(:) = density*brick_shares(model%mesh%position(:, node))
         end associate
         do c = 1, corners
            if (here(c) == 0) cycle
            place = columns%mass_of(1, 1, here(c))
            mass(place) = mass(place) + added(c)
         end do
      end do
   end subroutine add_brick_masses

end module plydyn_element_brick_make
