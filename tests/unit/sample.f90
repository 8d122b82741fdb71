!> Small models for the tests, made without a deck.
module sample
   use plydyn_base_precision, only : wp
   use plydyn_fem_shape, only : local_nodes
   use plydyn_law_ply_elastic, only : elastic_constants_type
   use plydyn_model_control, only : linear_strain, request_type
   use plydyn_model_curve, only : curve_type
   use plydyn_model_layup, only : faces_tied, part_type, ply_type
   use plydyn_model_material, only : material_type
   use plydyn_model_mesh, only : mesh_type
   use plydyn_model_model, only : model_type
   implicit none
   private

   public :: flat_surface, rectangle_mesh, rectangle_model

contains

   !> Points and facets of a flat surface around the origin: squares of side one with nine points
   subroutine flat_surface(squares, position, facet)
      !> Squares along an edge
      integer, intent(in) :: squares
      !> Surface points, (3, (2 squares + 1)**2)
      real(wp), intent(out) :: position(:, :)
      !> Facets
      integer, intent(out) :: facet(9, squares**2)

      integer :: f, i, j, line, place(2, 9)

      line = 2*squares + 1
      do j = 1, line
         do i = 1, line
            position(:, i + (j - 1)*line) = [0.5_wp*(i - 1) - 0.5_wp*squares, &
               & 0.5_wp*(j - 1) - 0.5_wp*squares, 0.0_wp]
         end do
      end do
      place(:, :) = nint(local_nodes(9)) + 1
      do f = 1, squares**2
         facet(:, f) = 1 + 2*modulo(f - 1, squares) + place(1, :) &
            & + line*(2*((f - 1)/squares) + place(2, :))
      end do
   end subroutine flat_surface

   !> A rectangle of n x m quads, its inner nodes moved by a smooth map that keeps the border
   pure function rectangle_mesh(side, n, m, length, width, distortion) result(mesh)
      !> Nodes along a side of a quad
      integer, intent(in) :: side
      !> Quads along x and y
      integer, intent(in) :: n, m
      !> Size
      real(wp), intent(in) :: length, width
      !> Share of the size by which nodes are moved
      real(wp), intent(in) :: distortion
      type(mesh_type) :: mesh

      real(wp), parameter :: pi = acos(-1.0_wp)
      integer, parameter :: of_q4(4) = [1, 2, 4, 3], of_q9(9) = [1, 3, 9, 7, 2, 6, 8, 4, 5]
      integer :: e, first, i, j, k, columns, tensor(side*side)
      real(wp) :: s, t

      columns = n*(side - 1) + 1
      mesh%node_id = [(10*k, k=1, columns*(m*(side - 1) + 1))]
      allocate (mesh%position(3, size(mesh%node_id)))
      do k = 1, size(mesh%node_id)
         s = real(mod(k - 1, columns), wp)/real(columns - 1, wp)
         t = real((k - 1)/columns, wp)/real(m*(side - 1), wp)
         mesh%position(:, k) = [length*(s + distortion*sin(pi*s)*sin(2.0_wp*pi*t)), &
            & width*(t + distortion*sin(2.0_wp*pi*s)*sin(pi*t)), 0.0_wp]
      end do
      mesh%quad_id = [(100 + e, e=1, n*m)]
      allocate (mesh%brick_id(0), mesh%brick_part(0), mesh%brick_node(8, 0))
      mesh%quad_part = spread(1, 1, n*m)
      allocate (mesh%quad_node(side*side, n*m))
      do e = 1, n*m
         first = 1 + (side - 1)*mod(e - 1, n) + (side - 1)*columns*((e - 1)/n)
         tensor(:) = [((first + i + columns*j, i=0, side - 1), j=0, side - 1)]
         if (side == 2) then
            mesh%quad_node(:, e) = tensor(of_q4)
         else
            mesh%quad_node(:, e) = tensor(of_q9)
         end if
      end do
   end function rectangle_mesh

   !> A laminate of IM7/8552 (the paper's table 1) in mm, s, t
   pure function rectangle_model(mesh, angle, thickness, order) result(model)
      !> Nodes and quads
      type(mesh_type), intent(in) :: mesh
      !> Fibre direction of each ply from the bottom up
      real(wp), intent(in) :: angle(:)
      !> Thickness of each ply
      real(wp), intent(in) :: thickness
      !> Order of each ply
      integer, intent(in) :: order(:)
      type(model_type) :: model

      integer :: k

      model%title = "sample"
      model%mesh = mesh
      allocate (model%materials(1), model%interface_materials(0), model%parts(1), model%curves(1))
      model%materials(1)%id = 1
      model%materials(1)%title = "IM7/8552"
      model%materials(1)%density = 1.7e-9_wp
      allocate (model%materials(1)%law, source=elastic_constants_type( &
         & young=[165.0e3_wp, 9.0e3_wp, 9.0e3_wp], poisson=[0.34_wp, 0.34_wp, 0.5_wp], &
         & shear=[5.6e3_wp, 5.6e3_wp, 2.8e3_wp]))
      model%parts(1)%id = 1
      model%parts(1)%title = "laminate"
      model%parts(1)%plies = [(ply_type(id=k, material=1, thickness=thickness, angle=angle(k), &
         & order=order(k)), k=1, size(angle))]
      model%parts(1)%joint = spread(faces_tied, 1, size(angle) - 1)
      model%curves(1) = curve_type(id=0, x=[0.0_wp], y=[1.0_wp])
      allocate (model%supports(0), model%motions(0), model%initial_velocities(0))
      allocate (model%initial_damages(0), model%point_loads(0), model%line_loads(0))
      allocate (model%pressures(0), model%segment_loads(0))
      allocate (model%body_loads(0), model%impactors(0), model%contacts(0), &
         & model%fixtures(0), model%constraints(0))
      model%control%end_time = 1.0e-4_wp
      model%control%kinematics = linear_strain
      model%request = request_type(field_interval=1.0e-5_wp)
      allocate (model%request%fields(0), model%request%nodes(0), model%request%profiles(0))
   end function rectangle_model

end module sample
