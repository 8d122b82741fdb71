!> One point of a ply with planes of fracture, led along a path: strain in, stress and energies out.
module fracture_point
   use plydyn_base_precision, only : lanes, wp
   use plydyn_law_law, only : by_fibre_damage, by_friction, by_matrix_damage, by_ply_plasticity
   use plydyn_law_ply_elastic, only : ply_stiffness
   use plydyn_law_ply_fracture_constants, only : fracture_constants_type
   use plydyn_law_ply_fracture_fracture, only : ply_fracture_type
   use plydyn_law_ply_fracture_history, only : crushed, fibre_damage, histories, lost_integrity, &
      & matrix_damage, plane_cosine, plane_sine, plastic_shear, slip, to_compression
   use plydyn_law_ply_shear_curve, only : new_hardening_curve
   implicit none
   private

   public :: fracture_ply, new_fracture_point

   real(wp), parameter :: degree = acos(-1.0_wp)/180.0_wp

   !> A point and all that has happened to it
   type, public :: fracture_point_type
      !> Its ply
      type(fracture_constants_type) :: ply
      !> The law, with the ply in every lane
      type(ply_fracture_type) :: law
      !> History, stress and strain now, of one lane: all are alike
      real(wp) :: history(histories) = 0.0_wp, stress(6) = 0.0_wp, strain(6) = 0.0_wp
      !> Work done per volume
      real(wp) :: work = 0.0_wp
   contains
      procedure :: move
      procedure :: lead
      procedure :: pull
      procedure :: stored
      procedure :: stored_by_law
      procedure :: dissipated
      procedure :: energy_of
      procedure :: angle
   end type fracture_point_type

contains

   !> IM7/8552 of 134 g/m2 in mm, N and MPa, alike in all directions across its fibres, with linear
   !> hardening of the shear
   pure function fracture_ply() result(ply)
      type(fracture_constants_type) :: ply

      ply%young = [171.42e3_wp, 9.08e3_wp, 9.08e3_wp]
      ply%poisson = [0.32_wp, 0.32_wp, 0.45_wp]
      ply%shear = [5.29e3_wp, 5.29e3_wp, 9.08e3_wp/2.9_wp]
      ply%fibre_strength = [2326.2_wp, 1200.1_wp]
      ply%matrix_strength = [62.3_wp, 199.8_wp]
      ply%shear_strength = 92.3_wp
      ply%fibre_toughness = [97.8_wp, 106.3_wp]
      ply%matrix_toughness = [0.277_wp, 0.788_wp]
      ply%mode_exponent = 1.634_wp
      ply%friction = 0.3_wp
      ply%residual = 1.0e-3_wp
      ply%curve = new_hardening_curve(ply%shear(1), 66.9_wp, 0.05_wp)
   end function fracture_ply

   !> A point at rest
   pure function new_fracture_point(ply, length) result(self)
      !> Its ply
      type(fracture_constants_type), intent(in) :: ply
      !> Widths of the crack band for fibres and for matrix
      real(wp), intent(in) :: length(2)
      type(fracture_point_type) :: self

      real(wp) :: history(lanes, histories)
      integer :: l

      self%ply = ply
      do l = 1, lanes
         call self%law%set_lane(l, ply)
      end do
      history(:, :) = 0.0_wp
      call self%law%start_history(spread(length, 1, lanes), spread(maxval(length), 1, lanes), &
         & history)
      self%history = history(1, :)
   end function new_fracture_point

   !> Strain the point in one step
   pure subroutine move(self, strain)
      class(fracture_point_type), intent(inout) :: self
      !> Total strain
      real(wp), intent(in) :: strain(6)

      real(wp) :: history(lanes, histories), stress(lanes, 6)

      history(:, :) = spread(self%history, 1, lanes)
      stress(:, :) = 0.0_wp
      call self%law%update(0.0_wp, spread(strain, 1, lanes), history, stress)
      self%history = history(1, :)
      self%work = self%work + 0.5_wp*dot_product(self%stress + stress(1, :), strain - self%strain)
      self%stress = stress(1, :)
      self%strain = strain
   end subroutine move

   !> Strain the point straight from where it is, in some steps
   pure subroutine lead(self, strain, steps)
      class(fracture_point_type), intent(inout) :: self
      !> Total strain at the end
      real(wp), intent(in) :: strain(6)
      !> How many steps
      integer, intent(in) :: steps

      real(wp) :: from(6)
      integer :: i

      from(:) = self%strain
      do i = 1, steps
         call self%move(from + (strain - from)*real(i, wp)/real(steps, wp))
      end do
   end subroutine lead

   !> Strain one component, with no stress of the others: Newton's method with the intact stiffness
   !> of what remains, to a stress of 1e-9 of the modulus
   subroutine pull(self, component, strain, steps)
      class(fracture_point_type), intent(inout) :: self
      !> Component of the strain
      integer, intent(in) :: component
      !> Its value at the end
      real(wp), intent(in) :: strain
      !> How many steps
      integer, intent(in) :: steps

      integer, parameter :: most = 400
      type(fracture_point_type) :: ahead
      real(wp) :: c(6, 6), from, total(6)
      integer :: i, k, turn

      c(:, :) = ply_stiffness(self%ply%young, self%ply%poisson, self%ply%shear)
      from = self%strain(component)
      do i = 1, steps
         total(:) = self%strain
         total(component) = from + (strain - from)*real(i, wp)/real(steps, wp)
         do turn = 1, most
            ahead = self
            call ahead%move(total)
            ahead%stress(component) = 0.0_wp
            if (maxval(abs(ahead%stress)) < 1.0e-9_wp*c(2, 2)) exit
            do k = 1, 6
               if (k /= component) total(k) = total(k) - 0.7_wp*ahead%stress(k)/c(k, k)
            end do
         end do
         call self%move(total)
      end do
   end subroutine pull

   !> Energy per volume that unloading gives back, as the law has it
   pure real(wp) function stored_by_law(self)
      class(fracture_point_type), intent(in) :: self

      real(wp) :: energy(lanes)

      energy(:) = self%law%stored_energy(spread(self%strain, 1, lanes), &
         & spread(self%history, 1, lanes))
      stored_by_law = energy(1)
   end function stored_by_law

   !> Energy stored per volume: that of the intact and of the cracked share, each with its strain
   pure real(wp) function stored(self)
      class(fracture_point_type), intent(in) :: self

      real(wp) :: apart(6), c(6, 6), elastic(6), left, normal(6, 3), s(3, 3), sheared

      elastic(:) = self%strain
      elastic(4:6) = elastic(4:6) - self%history(plastic_shear:plastic_shear + 2)
      elastic(3) = elastic(3) - self%history(crushed)
      ! compliance with what is left of E1, G12 and G13, inverted
      left = 1.0_wp - self%history(lost_integrity)
      sheared = 1.0_wp - maxval(self%history([fibre_damage, fibre_damage + to_compression]))
      associate (e => self%ply%young, nu => self%ply%poisson)
         s(1, :) = [1.0_wp/(left*e(1)), -nu(1)/e(1), -nu(2)/e(1)]
         s(2, :) = [-nu(1)/e(1), 1.0_wp/e(2), -nu(3)/e(2)]
         s(3, :) = [-nu(2)/e(1), -nu(3)/e(2), 1.0_wp/e(3)]
      end associate
      c(:, :) = 0.0_wp
      c(:3, :3) = inverse(s)
      c(4, 4) = sheared*self%ply%shear(1)
      c(5, 5) = sheared*self%ply%shear(2)
      c(6, 6) = self%ply%shear(3)
      ! strain of unit jumps: n n, n t and n l made symmetric, with engineering shear
      associate (x => self%history(plane_cosine), y => self%history(plane_sine))
         normal(:, :) = 0.0_wp
         normal([2, 3, 6], 1) = [x*x, y*y, 2.0_wp*x*y]
         normal([2, 3, 6], 2) = [-x*y, x*y, x*x - y*y]
         normal([4, 5], 3) = [x, y]
      end associate
      apart(:) = elastic - matmul(normal, self%history(slip:slip + 2))
      associate (d => self%history(matrix_damage))
         stored = 0.5_wp*((1.0_wp - d)*dot_product(elastic, matmul(c, elastic)) &
            & + d*dot_product(apart, matmul(c, apart)))
      end associate
   end function stored

   !> Inverse of a symmetric matrix by its adjugate
   pure function inverse(a) result(b)
      real(wp), intent(in) :: a(3, 3)
      real(wp) :: b(3, 3)

      integer :: i, i1, i2, j, j1, j2

      do i = 1, 3
         do j = 1, 3
            i1 = modulo(i, 3) + 1
            i2 = modulo(i + 1, 3) + 1
            j1 = modulo(j, 3) + 1
            j2 = modulo(j + 1, 3) + 1
            b(j, i) = a(i1, j1)*a(i2, j2) - a(i1, j2)*a(i2, j1)
         end do
      end do
      b(:, :) = b/dot_product(a(1, :), b(:, 1))
   end function inverse

   !> Energy dissipated per volume by all mechanisms
   pure real(wp) function dissipated(self)
      class(fracture_point_type), intent(in) :: self

      dissipated = self%energy_of(by_fibre_damage) + self%energy_of(by_matrix_damage) &
         & + self%energy_of(by_ply_plasticity) + self%energy_of(by_friction)
   end function dissipated

   !> Energy dissipated per volume by one mechanism
   pure real(wp) function energy_of(self, mechanism)
      class(fracture_point_type), intent(in) :: self
      !> One of `by_…`
      integer, intent(in) :: mechanism

      real(wp) :: energy(lanes)

      energy(:) = self%law%dissipated_energy(mechanism, spread(self%history, 1, lanes))
      energy_of = energy(1)
   end function energy_of

   !> Angle of the plane of fracture about the fibres, degrees from axis 2
   pure real(wp) function angle(self)
      class(fracture_point_type), intent(in) :: self

      angle = atan2(self%history(plane_sine), self%history(plane_cosine))/degree
   end function angle

end module fracture_point
