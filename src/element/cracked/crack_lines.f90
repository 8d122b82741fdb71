!> Cracks of the matrix at doubled nodes: tie, test, and tractions once a crack is open.
!>
!> All of it is local to a node: a crack has the bottom and the top of its ply in the column of the
!> node and in that of its twin. While it is tied both move as one, with the masses of both, and
!> what one has to pull at the other is the traction on the crack: no stress is recovered, no
!> stiffness added. The axes of a crack turn with the line from the bottom to the top of its ply.
!> Open cracks turn that line as well: their tractions are the slope of an energy, which neither
!> motion of the whole ply nor a turn of it changes.
module plydyn_element_cracked_crack_lines
   use plydyn_base_exact_sum, only : exact_sums_type
   use plydyn_base_matrix, only : cross
   use plydyn_base_precision, only : lanes, wp
   use plydyn_law_matrix_crack, only : across, along, begin_crack, crack_energy, crack_faces, &
      & crack_histories, crack_law_type, damage_at, exceeds, fracture_at, friction_at, onset_at, &
      & update_crack, upward
   implicit none
   private

   public :: add_crack_energy, add_crack_losses, hold_crack

   !> Numbers of what the cracks of a ply have come to: length of crack that has started, and that
   !> has failed; energies lost in fracture and in friction; ends of lines that have started
   integer, parameter, public :: crack_losses = 5

   !> Plies of a zone
   type, public :: crack_plies_type
      !> Laws of the lanes, block by block
      type(crack_law_type), allocatable :: law(:)
      !> Directions of the fibres at time zero, (lanes, 2, blocks)
      real(wp), allocatable :: fibre(:, :, :)
   end type crack_plies_type

   !> All doubled nodes of a rank
   type, public :: crack_lines_type
      !> Plies of each zone
      type(crack_plies_type), allocatable :: zones(:)
      !> Columns of each node and of its twin, (2, nodes); zone of each
      integer, allocatable :: column(:, :), zone(:)
      !> Ply of each lane, 0 for none, (lanes, blocks)
      integer, allocatable :: ply(:, :)
      !> Whether this rank counts each node; its number in the whole model
      logical, allocatable :: own(:)
      integer, allocatable :: number(:)
      !> How many nodes the whole model has
      integer :: whole = 0
      !> Area of crack in each ply, 0 where there is none, (lanes, blocks, nodes)
      real(wp), allocatable :: area(:, :, :)
      !> Whether the line of each ply ends there, (lanes, blocks, nodes)
      logical, allocatable :: is_end(:, :, :)
      !> Blocks of layers; first place of a column in the arrays of motion and of masses, and
      !> heights
      integer :: blocks = 0, first = 0, first_mass = 0, height = 0
      !> First of the histories in the history of all
      integer :: first_history = 1
   contains
      procedure :: history_length
   end type crack_lines_type

   !> Axes of the cracks of a block
   type :: crack_axes_type
      !> Along the fibres, across, along the thickness: (lanes, components, axes)
      real(wp) :: axis(lanes, 3, 3) = 0.0_wp
      !> Distance of bottom and top; slope of the fibres against the thickness
      real(wp) :: height(lanes) = 1.0_wp, lean(lanes) = 0.0_wp
   end type crack_axes_type

contains

   !> Length of the history of a node
   pure integer function history_length(self)
      class(crack_lines_type), intent(in) :: self

      history_length = lanes*crack_histories*self%blocks
   end function history_length

   !> Forces on both columns of a node once ties and cracks have had their say
   pure subroutine hold_crack(self, node, time, mass, displacement, history, force)
      !> All nodes, and the number of this one
      type(crack_lines_type), intent(in) :: self
      integer, intent(in) :: node
      !> Time
      real(wp), intent(in) :: time
      !> Mass and displacement of all points
      real(wp), intent(in), contiguous :: mass(:), displacement(:)
      !> History of the node
      real(wp), intent(inout) :: history(lanes, crack_histories, self%blocks)
      !> Force on all points
      real(wp), intent(inout), contiguous :: force(:)

      logical :: is_open(lanes), is_tied(lanes)
      real(wp) :: pull(lanes, 3, crack_faces)
      integer :: b

      do b = 1, self%blocks
         associate (area => self%area(:, b, node))
            if (all(area <= 0.0_wp)) cycle
            is_open(:) = area > 0.0_wp .and. history(:, onset_at, b) > 0.0_wp
            is_tied(:) = area > 0.0_wp .and. .not. is_open
            if (any(is_open)) call add_tractions(self, node, b, is_open, displacement, &
               & history(:, :, b), force)
            if (.not. any(is_tied)) cycle
            call tie_faces(self, node, b, is_tied, mass, force, pull)
            call start_cracks(self, node, b, is_tied, time, displacement, pull, history(:, :, b))
         end associate
      end do
   end subroutine hold_crack

   !> Let both copies of tied faces move as one
   pure subroutine tie_faces(self, node, block, is_tied, mass, force, pull)
      type(crack_lines_type), intent(in) :: self
      integer, intent(in) :: node, block
      logical, intent(in) :: is_tied(lanes)
      real(wp), intent(in), contiguous :: mass(:)
      real(wp), intent(inout), contiguous :: force(:)
      !> Force of the twin on the node
      real(wp), intent(out) :: pull(lanes, 3, crack_faces)

      real(wp) :: both(2), common
      integer :: at(2), d, f, l, weigh(2)

      do f = 1, crack_faces
         weigh(:) = mass_place(self, self%column(:, node), block, f)
         do d = 1, 3
            at(:) = place(self, self%column(:, node), block, f, d)
            do l = 1, lanes
               pull(l, d, f) = 0.0_wp
               if (.not. is_tied(l)) cycle
               both(:) = mass(weigh + l)
               common = (force(at(1) + l) + force(at(2) + l))/(both(1) + both(2))
               pull(l, d, f) = common*both(1) - force(at(1) + l)
               force(at + l) = common*both
            end do
         end do
      end do
   end subroutine tie_faces

   !> Start the tied cracks whose mean tractions reach the strengths
   pure subroutine start_cracks(self, node, block, is_tied, time, displacement, pull, history)
      type(crack_lines_type), intent(in) :: self
      integer, intent(in) :: node, block
      logical, intent(in) :: is_tied(lanes)
      real(wp), intent(in) :: time
      real(wp), intent(in), contiguous :: displacement(:)
      !> Force of the twin on the node
      real(wp), intent(in) :: pull(lanes, 3, crack_faces)
      real(wp), intent(inout) :: history(lanes, crack_histories)

      type(crack_axes_type) :: axes
      real(wp) :: load(lanes), mean(3), traction(3, crack_faces)
      integer :: f, l

      associate (law => self%zones(self%zone(node))%law(block), area => self%area(:, block, node))
         ! far from any strength no axes are needed
         load(:) = 0.0_wp
         where (is_tied) load = ((pull(:, 1, 1) + pull(:, 1, 2))**2 + (pull(:, 2, 1) &
            & + pull(:, 2, 2))**2 + (pull(:, 3, 1) + pull(:, 3, 2))**2) &
            & /(area*minval(law%strength, 2))**2
         if (maxval(load) < 1.0_wp) return
         axes = find_axes(self, node, block, displacement)
         do l = 1, lanes
            if (load(l) < 1.0_wp) cycle
            do f = 1, crack_faces
               traction(:, f) = matmul(pull(l, :, f), axes%axis(l, :, :))*real(crack_faces, wp) &
                  & /area(l)
            end do
            mean(:) = sum(traction, 2)/real(crack_faces, wp)
            if (exceeds(law, l, mean(along), mean(across), mean(upward))) then
               call begin_crack(law, l, time, traction, history(l, :))
            end if
         end do
      end associate
   end subroutine start_cracks

   !> Add the tractions of open cracks, and the moments by which they turn their plies
   pure subroutine add_tractions(self, node, block, is_open, displacement, history, force)
      type(crack_lines_type), intent(in) :: self
      integer, intent(in) :: node, block
      logical, intent(in) :: is_open(lanes)
      real(wp), intent(in), contiguous :: displacement(:)
      real(wp), intent(inout) :: history(lanes, crack_histories)
      real(wp), intent(inout), contiguous :: force(:)

      type(crack_axes_type) :: axes
      real(wp), dimension(lanes, 3, crack_faces) :: jump, opening, traction
      real(wp) :: axis(3, 3), moment(3), own(3), turn(3)
      integer :: f, l

      axes = find_axes(self, node, block, displacement)
      call find_openings(self, node, block, axes, displacement, jump, opening)
      call update_crack(self%zones(self%zone(node))%law(block), is_open, opening, history, traction)
      do l = 1, lanes
         if (.not. is_open(l)) cycle
         moment(:) = 0.0_wp
         axis(:, :) = axes%axis(l, :, :)
         associate (part => self%area(l, block, node)/real(crack_faces, wp))
            do f = 1, crack_faces
               own(:) = part*matmul(axis, traction(l, :, f))
               moment(:) = moment + cross(jump(l, :, f), own)
               call add_pair(self, self%column(:, node), [block, l, f], own, -own, force)
            end do
            turn(:) = (cross(moment, axis(:, upward)) - axes%lean(l)*dot_product(axis(:, upward), &
               & moment)*axis(:, across))/axes%height(l)
            turn(:) = 0.5_wp*turn
            call add_pair(self, self%column(:, node), [block, l, 1], -turn, -turn, force)
            call add_pair(self, self%column(:, node), [block, l, 2], turn, turn, force)
         end associate
      end do
   end subroutine add_tractions

   !> Add a force to the node and one to its twin
   pure subroutine add_pair(self, column, where, on_node, on_twin, force)
      type(crack_lines_type), intent(in) :: self
      !> Columns of both; block, lane and face
      integer, intent(in) :: column(2), where(3)
      real(wp), intent(in) :: on_node(3), on_twin(3)
      real(wp), intent(inout), contiguous :: force(:)

      integer :: at(2), d

      do d = 1, 3
         at(:) = place(self, column, where(1), where(3), d) + where(2)
         force(at(1)) = force(at(1)) + on_node(d)
         force(at(2)) = force(at(2)) + on_twin(d)
      end do
   end subroutine add_pair

   !> Axes of the cracks of a block
   pure function find_axes(self, node, block, displacement) result(axes)
      type(crack_lines_type), intent(in) :: self
      integer, intent(in) :: node, block
      real(wp), intent(in), contiguous :: displacement(:)
      type(crack_axes_type) :: axes

      real(wp) :: fibre(3), line(3)
      integer :: bottom(2), d, l, top(2)

      associate (zone => self%zones(self%zone(node)))
         do l = 1, lanes
            if (self%area(l, block, node) <= 0.0_wp) cycle
            do d = 1, 3
               bottom(:) = place(self, self%column(:, node), block, 1, d) + l
               top(:) = place(self, self%column(:, node), block, 2, d) + l
               line(d) = 0.5_wp*sum(displacement(top) - displacement(bottom))
            end do
            line(3) = line(3) + zone%law(block)%thickness(l)
            fibre(:) = [zone%fibre(l, :, block), 0.0_wp]
            axes%height(l) = norm2(line)
            line(:) = line/axes%height(l)
            axes%axis(l, :, upward) = line
            axes%axis(l, :, along) = fibre - dot_product(fibre, line)*line
            axes%axis(l, :, along) = axes%axis(l, :, along)/norm2(axes%axis(l, :, along))
            axes%axis(l, :, across) = cross(line, axes%axis(l, :, along))
            axes%lean(l) = dot_product(fibre, line)/dot_product(fibre, axes%axis(l, :, along))
         end do
      end associate
   end function find_axes

   !> Displacement of the twin over that of the node, along x, y, z and in the axes of the cracks
   pure subroutine find_openings(self, node, block, axes, displacement, jump, opening)
      type(crack_lines_type), intent(in) :: self
      integer, intent(in) :: node, block
      type(crack_axes_type), intent(in) :: axes
      real(wp), intent(in), contiguous :: displacement(:)
      real(wp), intent(out), dimension(lanes, 3, crack_faces) :: jump, opening

      integer :: at(2), d, f

      do f = 1, crack_faces
         do d = 1, 3
            at(:) = place(self, self%column(:, node), block, f, d)
            jump(:, d, f) = displacement(at(2) + 1:at(2) + lanes) &
               & - displacement(at(1) + 1:at(1) + lanes)
         end do
         do d = 1, 3
            opening(:, d, f) = jump(:, 1, f)*axes%axis(:, 1, d) + jump(:, 2, f)*axes%axis(:, 2, d) &
               & + jump(:, 3, f)*axes%axis(:, 3, d)
         end do
      end do
   end subroutine find_openings

   !> Place before that of the first lane of a block at a face of a column
   elemental integer function place(self, column, block, face, direction)
      class(crack_lines_type), intent(in) :: self
      integer, intent(in) :: column, block, face, direction

      place = self%first - 1 + self%height*(column - 1) + lanes*(block - 1 &
         & + self%blocks*(face - 1 + crack_faces*(direction - 1)))
   end function place

   !> The same in the array of masses
   elemental integer function mass_place(self, column, block, face) result(place)
      class(crack_lines_type), intent(in) :: self
      integer, intent(in) :: column, block, face

      place = self%first_mass - 1 + self%height/3*(column - 1) + lanes*(block - 1 &
         & + self%blocks*(face - 1))
   end function mass_place

   !> Add the energy that open cracks give back, node by node
   pure subroutine add_crack_energy(self, displacement, history, sums)
      !> All nodes
      type(crack_lines_type), intent(in) :: self
      !> Displacement of all points
      real(wp), intent(in), contiguous :: displacement(:)
      !> History of all nodes
      real(wp), intent(in) :: history(lanes, crack_histories, self%blocks, *)
      !> Sums, the first of which gets the energies
      type(exact_sums_type), intent(inout) :: sums

      type(crack_axes_type) :: axes
      real(wp), dimension(lanes, 3, crack_faces) :: jump, opening
      integer :: b, i, l

      do i = 1, size(self%zone)
         if (.not. self%own(i)) cycle
         do b = 1, self%blocks
            if (.not. any(history(:, onset_at, b, i) > 0.0_wp)) cycle
            axes = find_axes(self, i, b, displacement)
            call find_openings(self, i, b, axes, displacement, jump, opening)
            do l = 1, lanes
               if (.not. history(l, onset_at, b, i) > 0.0_wp) cycle
               call sums%add(1, self%area(l, b, i)*crack_energy(self%zones(self%zone(i))%law(b), &
                  & l, opening(l, :, :), history(l, :, b, i)))
            end do
         end do
      end do
   end subroutine add_crack_energy

   !> Add what the cracks of each ply have come to, as `crack_losses` for each
   pure subroutine add_crack_losses(self, history, sums)
      !> All nodes
      type(crack_lines_type), intent(in) :: self
      !> History of all nodes
      real(wp), intent(in) :: history(lanes, crack_histories, self%blocks, *)
      !> Sums, ply by ply
      type(exact_sums_type), intent(inout) :: sums

      integer :: b, i, l

      do i = 1, size(self%zone)
         if (.not. self%own(i)) cycle
         do b = 1, self%blocks
            do l = 1, lanes
               if (.not. history(l, onset_at, b, i) > 0.0_wp) cycle
               associate (first => crack_losses*(self%ply(l, b) - 1), area => self%area(l, b, i), &
                  & zone => self%zones(self%zone(i)))
                  call sums%add(first + 1, area/zone%law(b)%thickness(l))
                  if (history(l, damage_at, b, i) >= 1.0_wp) call sums%add(first + 2, &
                     & area/zone%law(b)%thickness(l))
                  call sums%add(first + 3, area*history(l, fracture_at, b, i))
                  call sums%add(first + 4, area*history(l, friction_at, b, i))
                  if (self%is_end(l, b, i)) call sums%add(first + 5, 1.0_wp)
               end associate
            end do
         end do
      end do
   end subroutine add_crack_losses

end module plydyn_element_cracked_crack_lines
