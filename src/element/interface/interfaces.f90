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
   use plydyn_element_quad, only : quad_metric, quad_node_metric
   use plydyn_law_cohesive_bilinear, only : cohesive_type
   use plydyn_law_cohesive_softening, only : closing_at, damage_at, delaminated_share, &
      & fracture_at, friction_at, normal, share_at
   implicit none
   private

   public :: history_size, set_damage, set_plane, sum_lanes

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
      !> beside
      !> the first edge. Twin of each, the node itself where it has none, and the columns that take
      !> its forces, (points, quads); not allocated elsewhere
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

   !> What the interfaces of each lane have lost
   type, public :: interface_sums_type
      !> Areas where damage has begun, where half of the toughness is spent, and where damage is
      !> complete
      real(wp), dimension(lanes) :: begun = 0.0_wp, delaminated = 0.0_wp, failed = 0.0_wp
      !> Energies lost in fracture, by a falling penalty, and in friction
      real(wp) :: fracture(lanes) = 0.0_wp, closing(lanes) = 0.0_wp, friction(lanes) = 0.0_wp
   end type interface_sums_type

contains

   !> Give interfaces their quads
   pure subroutine set_plane(self, quad, node, position)
      !> The interfaces; their sides and points are known
      type(interface_type), intent(inout) :: self
      !> Index of each quad in the mesh
      integer, intent(in) :: quad(:)
      !> Nodes of each quad in tensor order, (side**2, quads)
      integer, intent(in) :: node(:, :)
      !> Positions of all nodes, (3, nodes)
      real(wp), intent(in) :: position(:, :)

      integer :: e

      self%quad = quad
      self%node = node
      self%target = node
      allocate (self%metric(5, size(node, 1), size(node, 2)))
      do e = 1, size(node, 2)
         if (self%nodal) then
            self%metric(:, :, e) = quad_node_metric(self%side, position(1:2, node(:, e)))
         else
            self%metric(:, :, e) = quad_metric(self%side, position(1:2, node(:, e)))
         end if
      end do
   end subroutine set_plane

   !> Places that the histories of interfaces take
   pure integer function history_size(self)
      !> The interfaces
      type(interface_type), intent(in) :: self

      history_size = lanes*self%law%histories*size(self%node)
   end function history_size

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

   !> Areas and energies of all points over a quad
   pure function sum_lanes(self, quad, history) result(sums)
      !> The interfaces
      type(interface_type), intent(in) :: self
      !> The quad, counted in these
      integer, intent(in) :: quad
      !> History of these interfaces
      real(wp), intent(in) :: history(lanes, size(self%node, 1), size(self%node, 2), &
         & self%law%histories)
      !> Sums; zero in all lanes without an interface
      type(interface_sums_type) :: sums

      integer :: q

      if (self%law%histories == 0) return
      do q = 1, size(self%node, 1)
         associate (area => self%metric(5, q, quad)*self%present, h => history(:, q, quad, :))
            sums%begun(:) = sums%begun + merge(area, 0.0_wp, h(:, damage_at) > 0.0_wp)
            sums%delaminated(:) = sums%delaminated &
               & + merge(area, 0.0_wp, h(:, share_at) >= delaminated_share)
            sums%failed(:) = sums%failed + merge(area, 0.0_wp, h(:, damage_at) >= 1.0_wp)
            sums%fracture(:) = sums%fracture + area*h(:, fracture_at)
            if (self%law%histories < closing_at) cycle
            sums%closing(:) = sums%closing + area*h(:, closing_at)
            if (self%law%histories < friction_at) cycle
            sums%friction(:) = sums%friction + area*h(:, friction_at)
         end associate
      end do
   end function sum_lanes

end module plydyn_element_interface_interfaces
