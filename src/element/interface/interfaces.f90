!> Interfaces between the faces of layers: a law of opening and traction at points of the plane,
!> the Gauss points or the nodes (trapezia or Simpson's rule).
!>
!> The lanes of a batch are interfaces of one material above each other, over all quads of a part.
!> With linear kinematics the normal is z. With large displacement the law works in axes that turn
!> with the deformed mid-face, half-way between both faces: z along its normal, x along the line
!> that lay along x. Tractions are per area of the undeformed plate. Where they act across an
!> opening, both faces feel the turn of the axes: forces and moments balance, and work done is work
!> stored or lost.
module plydyn_element_interface_interfaces
   use plydyn_base_precision, only : lanes, wp
   use plydyn_element_group, only : begun_area, closing_loss, delaminated_area, failed_area, &
      & fracture_loss, friction_loss, losses
   use plydyn_element_quad, only : quad_metric, quad_node_metric, tensor_order
   use plydyn_law_cohesive_bilinear, only : cohesive_type
   use plydyn_law_cohesive_softening, only : closing_at, damage_at, delaminated_share, &
      & fracture_at, friction_at, normal, share_at
   use plydyn_model_mesh, only : mesh_type
   implicit none
   private

   public :: set_damage, set_plane, sum_lanes

   !> Where the points of one face lie in the arrays of motion, for each lane
   type, public :: face_type
      !> Place of the displacement along x at the first node of the plane
      integer :: first(lanes) = 0
      !> From there to that along y, and to that at the next node
      integer :: stride(lanes) = 0, step(lanes) = 0
   end type face_type

   !> Interfaces of one material over all quads of a part
   type, public :: interface_type
      !> Layer below each lane; 0 where there is no interface
      integer :: lower(lanes) = 0
      !> 1 in lanes with an interface, else 0
      real(wp) :: present(lanes) = 0.0_wp
      !> Places of the faces
      type(face_type) :: below, above
      !> Whether the places of a face lie side by side in all lanes, with or without an interface
      logical :: adjacent = .false.
      !> The law
      type(cohesive_type) :: law
      !> Plate whose quads these are, and index of the interface material
      integer :: plate = 0, material = 0
      !> Nodes along a side of a quad
      integer :: side = 0
      !> Points at the nodes instead of the Gauss points
      logical :: nodal = .false.
      !> Index of each quad in the mesh
      integer, allocatable :: quad(:)
      !> Nodes of each quad in tensor order, twice in crack zones, (points, quads)
      integer, allocatable :: node(:, :)
      !> Columns that take the forces of each quad: those of its nodes, or others behind them
      integer, allocatable :: target(:, :)
      !> In crack zones each node has two points, one for each half of its corner: first those
      !> beside the first edge. Twin of each, the node itself where it has none, and the columns
      !> that take its forces, (points, quads); not allocated elsewhere
      integer, allocatable :: twin(:, :), twin_target(:, :)
      !> 1 where the point of the lower and of the upper face is at the twin, else 0,
      !> (lanes, points, faces, quads)
      real(wp), allocatable :: sees(:, :, :, :)
      !> Geometry of each quad at its points, (5, points, quads); see `quad_metric`
      real(wp), allocatable :: metric(:, :, :)
      !> Square of the strength of the law over that of each point, (lanes, points, quads); none
      !> where all points have the strengths of the law
      real(wp), allocatable :: weakness(:, :, :)
      !> First of its histories, (lanes, points, quads, law%histories), in the history of all
      integer :: first_history = 1
   end type interface_type

contains

   !> Give interfaces their quads
   pure subroutine set_plane(self, mesh, quads, local_node)
      !> The interfaces; their sides and points are known
      type(interface_type), intent(inout) :: self
      !> The mesh
      type(mesh_type), intent(in) :: mesh
      !> The quads, indices into the mesh; the rank's number of each node of the mesh
      integer, intent(in) :: quads(:), local_node(:)

      integer :: e, node(self%side**2)

      self%quad = quads
      allocate (self%node(size(node), size(quads)), self%metric(5, size(node), size(quads)))
      do e = 1, size(quads)
         node(:) = mesh%quad_node(tensor_order(self%side), quads(e))
         self%node(:, e) = local_node(node)
         if (self%nodal) then
            self%metric(:, :, e) = quad_node_metric(self%side, mesh%position(1:2, node))
         else
            self%metric(:, :, e) = quad_metric(self%side, mesh%position(1:2, node))
         end if
      end do
      self%target = self%node
   end subroutine set_plane

   !> Begin with damage at some points of a lane; 1 where the faces are apart. It counts as the
   !> share of the toughness that opening would have spent
   pure subroutine set_damage(self, lane, chosen, damage, history)
      !> The interfaces
      type(interface_type), intent(in) :: self
      !> The lane
      integer, intent(in) :: lane
      !> Which points, (side**2, quads)
      logical, intent(in) :: chosen(:, :)
      !> Damage from 0 to 1; a point that has more already keeps it
      real(wp), intent(in) :: damage
      !> History of these interfaces
      real(wp), intent(inout) :: history(lanes, size(self%node, 1), size(self%node, 2), &
         & self%law%histories)
      integer :: e

      do e = 1, size(self%node, 2)
         where (chosen(:, e))
            history(lane, :, e, damage_at) = max(history(lane, :, e, damage_at), damage)
            history(lane, :, e, share_at) = self%law%spent_share(normal, &
               & history(lane, :, e, damage_at))
         end where
         if (.not. self%law%by_work) cycle
         history(lane, :, e, self%law%histories - 1) = self%law%toughness(normal) &
            & *history(lane, :, e, share_at)
      end do
   end subroutine set_damage

   !> What all points over a quad have lost
   pure function sum_lanes(self, quad, history) result(sums)
      !> The interfaces
      type(interface_type), intent(in) :: self
      !> The quad, counted in these
      integer, intent(in) :: quad
      !> History of these interfaces
      real(wp), intent(in) :: history(lanes, size(self%node, 1), size(self%node, 2), &
         & self%law%histories)
      !> Zero in all lanes without an interface
      real(wp) :: sums(lanes, losses)

      integer :: q

      sums(:, :) = 0.0_wp
      if (self%law%histories == 0) return
      do q = 1, size(self%node, 1)
         associate (area => self%metric(5, q, quad)*self%present, h => history(:, q, quad, :))
            sums(:, begun_area) = sums(:, begun_area) &
               & + merge(area, 0.0_wp, h(:, damage_at) > 0.0_wp)
            sums(:, delaminated_area) = sums(:, delaminated_area) &
               & + merge(area, 0.0_wp, h(:, share_at) >= delaminated_share)
            sums(:, failed_area) = sums(:, failed_area) &
               & + merge(area, 0.0_wp, h(:, damage_at) >= 1.0_wp)
            sums(:, fracture_loss) = sums(:, fracture_loss) + area*h(:, fracture_at)
            if (self%law%histories < closing_at) cycle
            sums(:, closing_loss) = sums(:, closing_loss) + area*h(:, closing_at)
            if (self%law%histories < friction_at) cycle
            sums(:, friction_loss) = sums(:, friction_loss) + area*h(:, friction_at)
         end associate
      end do
   end function sum_lanes

end module plydyn_element_interface_interfaces
