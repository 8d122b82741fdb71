!> Interfaces over quads: tractions times areas, linear and turned with large displacement.
program test_element_interface_interfaces
   use bond, only : table_6
   use faces, only : area, lay_interfaces
   use plydyn_base_precision, only : lanes, wp
   use plydyn_element_group, only : begun_area, closing_loss, delaminated_area, failed_area, &
      & fracture_loss, friction_loss, losses
   use plydyn_element_interface_interfaces, only : interface_type, set_damage, set_plane, sum_lanes
   use plydyn_element_interface_kernel, only : add_face_forces
   use plydyn_fem_quadrature, only : quad_points
   use plydyn_law_cohesive_bilinear, only : cohesive_constants_type, new_cohesive, new_springs
   use plydyn_model_mesh, only : mesh_type
   use sample, only : rectangle_mesh
   use testing, only : begin, check, finish
   implicit none

   !> Thickness nodes of the layers, interfaces
   integer, parameter :: levels = 3, joints = 7
   real(wp), parameter :: unit(3, 3) = reshape([1.0_wp, 0.0_wp, 0.0_wp, 0.0_wp, 1.0_wp, 0.0_wp, &
      & 0.0_wp, 0.0_wp, 1.0_wp], [3, 3])
   integer :: side
   logical :: adjacent, nodal

   do side = 2, 3
      nodal = .false.
      do
         adjacent = .true.
         do
            call test_uniform_opening()
            call test_softening()
            call test_turned()
            if (.not. adjacent) exit
            adjacent = .false.
         end do
         call test_one_quad()
         call test_points()
         if (nodal) exit
         nodal = .true.
      end do
   end do
   call test_patch_of_moments()
   call finish()

contains

   !> Seven interfaces between eight layers of three levels over a distorted plate
   subroutine make(constants, self, mesh)
      type(cohesive_constants_type), intent(in) :: constants
      type(interface_type), intent(out) :: self
      type(mesh_type), intent(out) :: mesh

      call lay_interfaces(side, levels, joints, nodal, adjacent, self, mesh)
      self%law = new_cohesive(constants)
   end subroutine make

   !> Displacements: layer k moves by h . (x, y, 0) and k times a jump, all turned by a rotation
   pure function moved(mesh, h, jump, rotation) result(displacement)
      type(mesh_type), intent(in) :: mesh
      real(wp), intent(in) :: h(3, 3), jump(3), rotation(3, 3)
      real(wp), allocatable :: displacement(:)

      real(wp) :: x(3)
      integer :: c, k, n, t

      allocate (displacement(3*lanes*levels*size(mesh%node_id)))
      do n = 1, size(mesh%node_id)
         do k = 1, lanes
            x(:) = matmul(rotation, mesh%position(:, n) + matmul(h, mesh%position(:, n)) &
               & + real(k, wp)*jump) - mesh%position(:, n)
            do t = 1, levels
               do c = 1, 3
                  displacement(k + lanes*(t - 1 + levels*(c - 1 + 3*(n - 1)))) = x(c)
               end do
            end do
         end do
      end do
   end function moved

   !> Resultant on a face of a layer
   pure function resultant(force, layer, level) result(total)
      real(wp), intent(in) :: force(:)
      integer, intent(in) :: layer, level
      real(wp) :: total(3)

      integer :: c

      do c = 1, 3
         total(c) = sum(force(layer + lanes*(level - 1 + levels*(c - 1))::3*lanes*levels))
      end do
   end function resultant

   !> What pulls the faces of each interface together, without what turns both alike
   pure function pulls(force) result(pull)
      real(wp), intent(in) :: force(:)
      real(wp) :: pull(joints, size(force)/(lanes*levels))

      integer :: k, r

      do r = 1, size(pull, 2)
         do k = 1, joints
            pull(k, r) = 0.5_wp*(force(k + lanes*(levels*r - 1)) &
               & - force(k + 1 + lanes*levels*(r - 1)))
         end do
      end do
   end function pulls

   !> Forces of interfaces without history
   subroutine find_forces(self, large, displacement, history, force)
      type(interface_type), intent(in) :: self
      logical, intent(in) :: large
      real(wp), intent(in), contiguous :: displacement(:)
      real(wp), intent(inout), contiguous :: history(:)
      real(wp), allocatable, intent(out) :: force(:)

      allocate (force(size(displacement)))
      force(:) = 0.0_wp
      call add_face_forces(self, [1, size(self%node, 2)], large, displacement, history, force)
   end subroutine find_forces

   !> A uniform opening of distorted quads makes traction times area
   subroutine test_uniform_opening()
      type(interface_type) :: self
      type(mesh_type) :: mesh
      real(wp), allocatable :: force(:), history(:)
      real(wp), parameter :: jump(3) = [0.01_wp, -0.02_wp, 0.03_wp]
      real(wp), parameter :: pull(3) = area*[400.0_wp, 400.0_wp, 1000.0_wp]*jump
      integer :: k

      call begin("uniform opening of springs")
      call make(table_6(), self, mesh)
      self%law = new_springs([1000.0_wp, 400.0_wp])
      call check(self%law%histories, 0, "springs have no history")
      allocate (history(0))
      call find_forces(self, .false., moved(mesh, 0.0_wp*unit, jump, unit), history, force)
      do k = 1, joints
         call check(resultant(force, k, levels), pull, 1.0e-10_wp, "pulls the lower face up")
         call check(resultant(force, k + 1, 1), -pull, 1.0e-10_wp, "pulls the upper face down")
      end do
      call check(sum(abs(force)), 2.0_wp*real(joints, wp)*sum(abs(pull)), 1.0e-9_wp, &
         & "and acts on nothing else")
   end subroutine test_uniform_opening

   !> The same past the onset, with the energies and areas of all points
   subroutine test_softening()
      real(wp) :: sums(lanes, losses)
      type(interface_type) :: self
      type(mesh_type) :: mesh
      real(wp), allocatable :: force(:), history(:)
      real(wp), parameter :: opening = 4.0e-3_wp, first = 62.3_wp/1373.3e3_wp
      real(wp), parameter :: last = 2.0_wp*0.28_wp/62.3_wp
      real(wp), parameter :: pull = area*62.3_wp*(last - opening)/(last - first)

      call begin("uniform opening that softens")
      call make(table_6(), self, mesh)
      allocate (history(history_size(self)))
      history(:) = 0.0_wp
      call find_forces(self, .false., moved(mesh, 0.0_wp*unit, [0.0_wp, 0.0_wp, opening], unit), &
         & history, force)
      call check(resultant(force, 1, levels), [0.0_wp, 0.0_wp, pull], 1.0e-8_wp, &
         & "makes traction times area")
      sums(:, :) = sums_of(self, history)
      call check(sums(:, begun_area), area*self%present, 1.0e-12_wp, "damage has begun everywhere")
      call check(sums(:, delaminated_area), 0.0_wp*self%present, 0.0_wp, "less than half is spent")
      call check(sums(:, failed_area), 0.0_wp*self%present, 0.0_wp, "and is complete nowhere")
      call check(sums(:, fracture_loss), area*0.28_wp*(opening - first)/(last - first) &
         & *self%present, 1.0e-9_wp, "the energy lost is that of the triangle")
      call find_forces(self, .false., moved(mesh, 0.0_wp*unit, [0.0_wp, 0.0_wp, 0.6_wp*last], &
         & unit), history, force)
      sums(:, :) = sums_of(self, history)
      call check(sums(:, delaminated_area), area*self%present, 1.0e-12_wp, &
         & "past half of the way it is")
      call check(sums(:, failed_area), 0.0_wp*self%present, 0.0_wp, &
         & "while damage is complete nowhere")
      call find_forces(self, .false., moved(mesh, 0.0_wp*unit, [0.0_wp, 0.0_wp, 0.1_wp], unit), &
         & history, force)
      call check(maxval(abs(force)), 0.0_wp, 0.0_wp, "far opened, it carries nothing")
      sums(:, :) = sums_of(self, history)
      call check(sums(:, failed_area), area*self%present, 1.0e-12_wp, &
         & "then all of the area has failed")
      call check(sums(:, fracture_loss), area*0.28_wp*self%present, 1.0e-9_wp, &
         & "and took its toughness")
      call check(maxval(abs(sums(:, closing_loss)) + abs(sums(:, friction_loss))), 0.0_wp, 0.0_wp, &
         & "without other losses")
   end subroutine test_softening

   !> With large displacement the tractions turn with the face
   subroutine test_turned()
      type(interface_type) :: self
      type(mesh_type) :: mesh
      real(wp), parameter :: c = cos(2.0_wp), s = sin(2.0_wp)
      real(wp), parameter :: rotation(3, 3) = reshape([c, s, 0.0_wp, -s*c, c*c, s, &
         & s*s, -s*c, c], [3, 3])
      ! symmetric: the face shears, and does not turn
      real(wp), parameter :: stretch(3, 3) = reshape([0.02_wp, 0.015_wp, 0.0_wp, 0.015_wp, &
         & -0.01_wp, 0.0_wp, 0.0_wp, 0.0_wp, 0.0_wp], [3, 3])
      real(wp), parameter :: jump(3) = [2.0e-3_wp, -1.0e-3_wp, 3.0e-3_wp]
      real(wp), allocatable :: force(:), history(:), straight(:), turned_history(:)
      real(wp) :: pull(3)

      call begin("turned interface")
      call make(table_6(), self, mesh)
      allocate (history(history_size(self)), turned_history(history_size(self)))
      history(:) = 0.0_wp
      turned_history(:) = 0.0_wp
      call find_forces(self, .false., moved(mesh, stretch, jump, unit), history, straight)
      call find_forces(self, .true., moved(mesh, stretch, jump, unit), turned_history, force)
      call check(maxval(abs(pulls(force) - pulls(straight))) < 1.0e-10_wp*maxval(abs(straight)), &
         & "pulls like the linear one where nothing turns")
      turned_history(:) = 0.0_wp
      call find_forces(self, .true., moved(mesh, stretch, jump, rotation), turned_history, force)
      pull(:) = matmul(rotation, resultant(straight, 2, levels))
      call check(resultant(force, 2, levels), pull, 1.0e-10_wp*norm2(pull), &
         & "turns its forces with the plate")
      call check(maxval(abs(turned_history - history)) < 1.0e-10_wp, "and keeps its history")
      turned_history(:) = 0.0_wp
      call find_forces(self, .true., moved(mesh, 0.0_wp*unit, 0.0_wp*jump, rotation), &
         & turned_history, force)
      call check(maxval(abs(force)) < 1.0e-8_wp, "feels nothing of a rigid rotation")
   end subroutine test_turned

   !> Each lane is its own: one interface opens, one is delaminated in one quad
   subroutine test_one_quad()
      real(wp) :: sums(lanes, losses)
      type(interface_type) :: self
      type(mesh_type) :: mesh
      real(wp), allocatable :: force(:), history(:)
      logical, allocatable :: chosen(:, :)

      call begin("initial delamination")
      adjacent = .true.
      call make(table_6(), self, mesh)
      allocate (history(history_size(self)), chosen(side**2, size(mesh%quad_id)))
      history(:) = 0.0_wp
      chosen(:, :) = .false.
      chosen(:, 3) = .true.
      call set_damage(self, 4, chosen, 1.0_wp, history)
      sums(:, :) = sums_of(self, history)
      call check(sums(:, failed_area), merge(sum(self%metric(5, :, 3)), 0.0_wp, self%lower == 4), &
         & 1.0e-12_wp, "is one quad of one interface")
      call find_forces(self, .false., moved(mesh, 0.0_wp*unit, [0.0_wp, 0.0_wp, 1.0e-5_wp], unit), &
         & history, force)
      call check(resultant(force, 4, levels), [0.0_wp, 0.0_wp, 13.733_wp*(area &
         & - sums(4, failed_area))], 1.0e-9_wp, "carries nothing there")
      call check(resultant(force, 5, levels), [0.0_wp, 0.0_wp, 13.733_wp*area], 1.0e-9_wp, &
         & "and everything elsewhere")
   end subroutine test_one_quad

   !> Points integrate what varies over the plate about its middle
   subroutine test_points()
      type(interface_type) :: self
      type(mesh_type) :: mesh
      real(wp), allocatable :: place(:, :, :)
      real(wp) :: moment(2)
      integer :: c, e

      call begin("quad_points")
      call make(table_6(), self, mesh)
      allocate (place(2, side**2, size(mesh%quad_id)))
      do e = 1, size(mesh%quad_id)
         place(:, :, e) = quad_points(mesh%position(:2, mesh%quad_node(:, e)), nodal)
      end do
      call check(sum(self%metric(5, :, :)), area, 1.0e-12_wp, "the areas add to that of the plate")
      do c = 1, 2
         moment(c) = sum(self%metric(5, :, :)*place(c, :, :))
      end do
      ! the map is odd about the middle, so the centroid stays there with any symmetric rule
      call check(moment/area, [3.0_wp, 2.0_wp], 1.0e-12_wp, "their centroid is in the middle")
      call check(minval(place) >= -1.0e-12_wp .and. maxval(place(1, :, :)) <= 6.0_wp + 1.0e-12_wp, &
         & "and all lie on the plate")
   end subroutine test_points

   !> Forces of an opening that varies linearly are those of its exact integrals
   subroutine test_patch_of_moments()
      type(interface_type) :: self
      type(mesh_type) :: mesh
      real(wp), allocatable :: displacement(:), force(:), history(:)
      integer :: i, n

      call begin("linear opening")
      side = 3
      nodal = .false.
      adjacent = .true.
      call make(table_6(), self, mesh)
      mesh = rectangle_mesh(side, 3, 2, 6.0_wp, 4.0_wp, 0.0_wp)
      deallocate (self%metric, self%node)
      self%side = side
      self%nodal = nodal
      call set_plane(self, mesh, [(i, i=1, size(mesh%quad_id))], [(i, i=1, size(mesh%node_id))])
      self%law = new_springs([1000.0_wp, 400.0_wp])
      displacement = moved(mesh, 0.0_wp*unit, [0.0_wp, 0.0_wp, 0.0_wp], unit)
      do n = 1, size(mesh%node_id)
         displacement(2 + lanes*(levels*(2 + 3*(n - 1)))) = mesh%position(1, n)
      end do
      allocate (history(0))
      call find_forces(self, .false., displacement, history, force)
      ! the integral of x over the plate, and of its square
      call check(resultant(force, 1, levels), [0.0_wp, 0.0_wp, 1000.0_wp*72.0_wp], 1.0e-7_wp, &
         & "resultant")
      call check(sum([(mesh%position(1, n)*force(1 + lanes*(levels - 1 + levels*(2 + 3*(n - 1)))), &
         & n=1, size(mesh%node_id))]), 1000.0_wp*288.0_wp, 1.0e-7_wp, "moment")
   end subroutine test_patch_of_moments

   !> Places of the history of all points
   pure integer function history_size(self)
      type(interface_type), intent(in) :: self

      history_size = lanes*self%law%histories*size(self%node)
   end function history_size

   !> Areas and energies of all points over all quads
   function sums_of(self, history) result(sums)
      type(interface_type), intent(in) :: self
      real(wp), intent(in) :: history(lanes, size(self%node, 1), size(self%node, 2), &
         & self%law%histories)
      real(wp) :: sums(lanes, losses)

      integer :: e

      sums(:, :) = 0.0_wp
      do e = 1, size(self%node, 2)
         sums(:, :) = sums + sum_lanes(self, e, history)
      end do
   end function sums_of

end program test_element_interface_interfaces
