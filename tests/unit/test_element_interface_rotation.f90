!> Faces that turn while they stand open: work on a closed path is none, and moments balance.
program test_element_interface_rotation
   use faces, only : lay_interfaces
   use plydyn_base_precision, only : lanes, wp
   use plydyn_element_interface_axes, only : find_axes
   use plydyn_element_interface_interfaces, only : interface_type
   use plydyn_element_interface_kernel, only : add_face_forces
   use plydyn_element_quad, only : quad_node_metric
   use plydyn_law_cohesive_bilinear, only : new_springs
   use plydyn_model_mesh, only : mesh_type
   use testing, only : begin, check, finish
   implicit none

   !> Thickness nodes of the layers, and interfaces
   integer, parameter :: levels = 2, joints = 3
   !> Steps around the closed path: its sum is exact to round-off from half of them on
   integer, parameter :: steps = 96
   real(wp), parameter :: pi = acos(-1.0_wp)
   integer :: side
   logical :: adjacent, nodal

   do side = 2, 3
      call test_axes(0.01_wp)
      call test_axes(0.3_wp)
      nodal = .false.
      do
         adjacent = .false.
         do
            call test_closed_path()
            call test_moment()
            if (adjacent) exit
            adjacent = .true.
         end do
         if (nodal) exit
         nodal = .true.
      end do
   end do
   call finish()

contains

   !> The axes of a face that is stretched, sheared and turned are the turn, and their stretch is
   !> the stretch; small ones and large ones, of which roots are taken in two ways
   subroutine test_axes(size_of_strain)
      real(wp), intent(in) :: size_of_strain

      real(wp) :: axes(lanes, 3, 3, side**2), metric(5, side**2), middle(lanes, 3, side**2)
      real(wp) :: strain(2, 2), stretch(lanes, 3, side**2), turn(3, 3), x(2, side**2)
      integer :: q

      call begin("axes of a stretched and turned face")
      strain(:, :) = size_of_strain*reshape([0.9_wp, 0.3_wp, 0.3_wp, -0.7_wp], [2, 2])
      turn(:, :) = matmul(rotation(1, 2, 0.4_wp), matmul(rotation(2, 3, -0.7_wp), &
         & rotation(1, 3, 0.3_wp)))
      do q = 1, side**2
         x(:, q) = [local(mod(q - 1, side)), local((q - 1)/side)]
         middle(:, :, q) = spread(2.0_wp*(matmul(turn(:, :2), x(:, q) + matmul(strain, x(:, q))) &
            & - [x(:, q), 0.0_wp]), 1, lanes)
      end do
      metric(:, :) = quad_node_metric(side, x)
      call find_axes(side, metric, middle, axes, stretch)
      do q = 1, side**2
         call check(reshape(axes(1, :, :, q), [9]), reshape(turn, [9]), 1.0e-14_wp, "the turn")
         call check(stretch(lanes, :, q), [1.0_wp + strain(1, 1), strain(1, 2), &
            & 1.0_wp + strain(2, 2)], 1.0e-14_wp, "the stretch")
      end do
   end subroutine test_axes

   !> Local coordinate of a node along a side, counted from 0
   pure real(wp) function local(node)
      integer, intent(in) :: node

      local = 2.0_wp*real(node, wp)/real(side - 1, wp) - 1.0_wp
   end function local

   !> Rotation from one axis to another
   pure function rotation(from, to, angle) result(r)
      integer, intent(in) :: from, to
      real(wp), intent(in) :: angle
      real(wp) :: r(3, 3)

      r(:, :) = reshape([1.0_wp, 0.0_wp, 0.0_wp, 0.0_wp, 1.0_wp, 0.0_wp, 0.0_wp, 0.0_wp, 1.0_wp], &
         & [3, 3])
      r(from, from) = cos(angle)
      r(to, to) = cos(angle)
      r(to, from) = sin(angle)
      r(from, to) = -sin(angle)
   end function rotation

   !> Interfaces between four layers over a distorted plate, stiffer in opening than in sliding
   subroutine make(self, mesh)
      type(interface_type), intent(out) :: self
      type(mesh_type), intent(out) :: mesh

      call lay_interfaces(side, levels, joints, nodal, adjacent, self, mesh)
      self%law = new_springs([1000.0_wp, 400.0_wp])
   end subroutine make

   !> Displacements without any order, up to a fortieth of a quad
   pure function disorder(number, points) result(u)
      !> Which of them
      integer, intent(in) :: number
      !> Size
      integer, intent(in) :: points
      real(wp) :: u(points)

      integer :: i

      u(:) = [(0.05_wp*sin(1.0e4_wp*sin(real(i + 1000*number, wp))), i=1, points)]
   end function disorder

   !> Forces of the interfaces
   function forces(self, displacement) result(force)
      type(interface_type), intent(in) :: self
      real(wp), intent(in), contiguous :: displacement(:)
      real(wp) :: force(size(displacement)), history(0)

      force(:) = 0.0_wp
      call add_face_forces(self, [1, size(self%node, 2)], .true., displacement, history, force)
   end function forces

   !> Springs store energy and nothing else: a path that comes back takes no work
   subroutine test_closed_path()
      type(interface_type) :: self
      type(mesh_type) :: mesh
      real(wp), allocatable :: a(:), b(:), speed(:), u(:)
      real(wp) :: angle, power(steps)
      integer :: k, points

      call begin("closed path of faces that turn")
      call make(self, mesh)
      points = 3*lanes*levels*size(mesh%node_id)
      a = disorder(1, points)
      b = disorder(2, points)
      do k = 1, steps
         angle = 2.0_wp*pi*real(k, wp)/real(steps, wp)
         u = a*sin(angle) + b*(1.0_wp - cos(angle))
         speed = a*cos(angle) + b*sin(angle)
         power(k) = dot_product(forces(self, u), speed)
      end do
      call check(sum(power), 0.0_wp, 1.0e-9_wp*sum(abs(power)), "takes no work")
   end subroutine test_closed_path

   !> Inner forces have no moment about any point
   subroutine test_moment()
      type(interface_type) :: self
      type(mesh_type) :: mesh
      real(wp), allocatable :: force(:), u(:)
      real(wp) :: f(3), moment(3), size_of(3), total(3), x(3)
      integer :: c, k, n, t

      call begin("moments of open faces")
      call make(self, mesh)
      u = disorder(3, 3*lanes*levels*size(mesh%node_id))
      force = forces(self, u)
      moment(:) = 0.0_wp
      size_of(:) = 0.0_wp
      total(:) = 0.0_wp
      do n = 1, size(mesh%node_id)
         do t = 1, levels
            do k = 1, lanes
               do c = 1, 3
                  associate (place => k + lanes*(t - 1 + levels*(c - 1 + 3*(n - 1))))
                     x(c) = mesh%position(c, n) + u(place)
                     f(c) = force(place)
                  end associate
               end do
               total(:) = total + f
               moment(:) = moment + cshift(x, 1)*cshift(f, 2) - cshift(x, 2)*cshift(f, 1)
               size_of(:) = size_of + abs(cshift(x, 1)*cshift(f, 2))
            end do
         end do
      end do
      call check(total, [0.0_wp, 0.0_wp, 0.0_wp], 1.0e-9_wp, "forces balance")
      call check(moment, [0.0_wp, 0.0_wp, 0.0_wp], 1.0e-12_wp*maxval(size_of), "moments balance")
   end subroutine test_moment

end program test_element_interface_rotation
