!> One point of a damaged ply, pulled along a path: strain in, stress and work out.
module ply_point
   use plydyn_base_precision, only : lanes, wp
   use plydyn_law_law, only : by_ply_plasticity, scalars, shows_dissipated
   use plydyn_law_ply_constants, only : ply_constants_type
   use plydyn_law_ply_damage, only : ply_damage_type
   use plydyn_law_ply_history, only : fibre_damage, fibre_onset, histories_most, &
      & matrix_damage, matrix_onset, shear_peak, shear_set, to_compression
   use plydyn_law_ply_shear_curve, only : new_exponential_curve, shape_exponential
   implicit none
   private

   public :: new_point, paper_ply

   !> A point and all that has happened to it
   type, public :: point_type
      !> Its ply
      type(ply_constants_type) :: ply
      !> The law, with the ply in every lane
      type(ply_damage_type) :: law
      !> History, stress and strain now, of one lane: all are alike
      real(wp) :: history(histories_most) = 0.0_wp, stress(6) = 0.0_wp, strain(6) = 0.0_wp
      !> Work done per volume
      real(wp) :: work = 0.0_wp
   contains
      procedure :: move
      procedure :: pull
      procedure :: dissipated
      procedure :: plastic
      procedure :: stays
      procedure :: stored
      procedure :: stored_by_law
   end type point_type

contains

   !> The ply of the paper's Table 5 in mm, N and MPa, with a line or a curve of shear
   pure function paper_ply(curved) result(ply)
      !> Shear by the exponential that reaches the strength at a strain of 0.05, else a line
      logical, intent(in), optional :: curved
      type(ply_constants_type) :: ply

      ply%young = [153.0e3_wp, 10.3e3_wp, 10.3e3_wp]
      ply%poisson = [0.3_wp, 0.3_wp, 0.4_wp]
      ply%shear = [6.0e3_wp, 6.0e3_wp, 3.7e3_wp]
      ply%fibre_strength = [2537.0_wp, 1580.0_wp]
      ply%matrix_strength = [82.0_wp, 236.0_wp]
      ply%shear_strength = 90.0_wp
      ply%cross_strength = 40.0_wp
      ply%fibre_toughness = [91.6_wp, 79.9_wp]
      ply%matrix_toughness = [0.22_wp, 1.1_wp]
      ply%closes = .false.
      ! all that damage can take, as far as it can
      ply%weakens_across = .true.
      ply%residual = 1.0e-6_wp
      if (.not. present(curved)) return
      if (curved) ply%curve = new_exponential_curve(ply%shear(1), ply%shear_strength, 0.05_wp)
   end function paper_ply

   !> A point at rest
   pure function new_point(ply, length) result(self)
      !> Its ply
      type(ply_constants_type), intent(in) :: ply
      !> Widths of the crack band for fibres and for matrix
      real(wp), intent(in) :: length(2)
      type(point_type) :: self

      real(wp) :: history(lanes, histories_most)
      integer :: l

      self%ply = ply
      do l = 1, lanes
         call self%law%set_lane(l, ply)
      end do
      history(:, :) = 0.0_wp
      call self%law%start_history(spread(length, 1, lanes), spread(maxval(length), 1, lanes), &
         & history)
      self%history = history(1, :)
   end function new_point

   !> Strain the point
   pure subroutine move(self, strain)
      class(point_type), intent(inout) :: self
      !> Total strain
      real(wp), intent(in) :: strain(6)

      real(wp) :: history(lanes, histories_most), stress(lanes, 6)

      history(:, :) = spread(self%history, 1, lanes)
      stress(:, :) = 0.0_wp
      call self%law%update(0.0_wp, spread(strain, 1, lanes), history, stress)
      self%history = history(1, :)
      self%work = self%work + 0.5_wp*dot_product(self%stress + stress(1, :), strain - self%strain)
      self%stress = stress(1, :)
      self%strain = strain
   end subroutine move

   !> Strain the point along the fibres or across them, with shear in the plane and no other stress.
   !> The path meets onset exactly: the trial stress is that of an intact ply, which the lateral
   !> strains of a damaged one would take off the uniaxial ray.
   pure subroutine pull(self, direction, strain, shear)
      class(point_type), intent(inout) :: self
      !> 1 along the fibres, 2 across
      integer, intent(in) :: direction
      !> Strain along the direction
      real(wp), intent(in) :: strain
      !> Shear strain 12
      real(wp), intent(in) :: shear

      integer, parameter :: halvings = 52
      type(point_type) :: ahead
      real(wp) :: high, low, middle, from(2), way(2)
      integer :: i, onset

      onset = merge(fibre_onset, matrix_onset, direction == 1)
      if (self%ply%closes .and. strain < 0.0_wp) onset = onset + to_compression
      from(:) = self%strain([direction, 4])
      way(:) = [strain, shear] - from
      ahead = copy(self)
      call go(ahead, direction, strain, shear)
      if (abs(ahead%history(onset) - self%history(onset)) > 0.0_wp) then
         low = 0.0_wp
         high = 1.0_wp
         do i = 1, halvings
            middle = 0.5_wp*(low + high)
            ahead = copy(self)
            call go(ahead, direction, from(1) + middle*way(1), from(2) + middle*way(2))
            if (abs(ahead%history(onset) - self%history(onset)) > 0.0_wp) then
               high = middle
            else
               low = middle
            end if
         end do
         call go(self, direction, from(1) + high*way(1), from(2) + high*way(2))
      end if
      call go(self, direction, strain, shear)
   end subroutine pull

   !> One step of `pull`: lateral strains are Poisson's share of what remains of the strain
   pure subroutine go(self, direction, strain, shear)
      class(point_type), intent(inout) :: self
      integer, intent(in) :: direction
      real(wp), intent(in) :: strain, shear

      type(point_type) :: before
      real(wp) :: remains, total(6)
      integer :: i

      before = copy(self)
      remains = 1.0_wp
      do i = 1, 3
         self%history = before%history
         self%stress = before%stress
         self%strain = before%strain
         self%work = before%work
         total(:) = 0.0_wp
         total(direction) = strain
         total(4) = shear
         associate (nu => self%ply%poisson, young => self%ply%young)
            if (direction == 1) total(2:3) = -nu(1:2)*remains*strain
            if (direction == 2) total([1, 3]) = -[nu(1)*young(2)/young(1), nu(3)]*remains*strain
         end associate
         call self%move(total)
         remains = 1.0_wp - acting(self, merge(fibre_damage, matrix_damage, direction == 1), strain)
      end do
   end subroutine go

   !> Damage that acts on a normal stress
   pure real(wp) function acting(self, damage, strain)
      class(point_type), intent(in) :: self
      !> History of the damage
      integer, intent(in) :: damage
      !> Its sign is that of the stress
      real(wp), intent(in) :: strain

      acting = self%history(damage)
      if (.not. self%ply%closes) return
      acting = self%history(damage + to_compression)
      if (strain >= 0.0_wp) acting = max(acting, self%history(damage))
   end function acting

   !> The same point
   pure function copy(self) result(point)
      class(point_type), intent(in) :: self
      type(point_type) :: point

      point%ply = self%ply
      point%law = self%law
      point%history = self%history
      point%stress = self%stress
      point%strain = self%strain
      point%work = self%work
   end function copy

   !> Energy dissipated per volume
   pure real(wp) function dissipated(self)
      class(point_type), intent(in) :: self

      real(wp) :: values(scalars)

      values(:) = self%law%output_variables(1, spread(self%history, 1, lanes))
      dissipated = values(shows_dissipated)
   end function dissipated

   !> Energy dissipated per volume by the shear that stays
   pure real(wp) function plastic(self)
      class(point_type), intent(in) :: self

      real(wp) :: energy(lanes)

      energy(:) = self%law%dissipated_energy(by_ply_plasticity, spread(self%history, 1, lanes))
      plastic = energy(1)
   end function plastic

   !> Shear strain that stays: kept, or that of the exponential
   pure real(wp) function stays(self)
      class(point_type), intent(in) :: self

      stays = self%history(shear_set)
      if (self%ply%curve%shape /= shape_exponential) return
      associate (asymptote => self%ply%curve%asymptote, modulus => self%ply%shear(1), &
         & peak => abs(self%history(shear_peak)))
         stays = peak - asymptote/modulus*(1.0_wp - exp(-modulus*peak/asymptote))
      end associate
   end function stays

   !> Energy per volume that unloading gives back, as the law has it
   pure real(wp) function stored_by_law(self)
      class(point_type), intent(in) :: self

      real(wp) :: energy(lanes)

      energy(:) = self%law%stored_energy(spread(self%strain, 1, lanes), &
         & spread(self%history, 1, lanes))
      stored_by_law = energy(1)
   end function stored_by_law

   !> Energy per volume that unloading gives back
   pure real(wp) function stored(self)
      class(point_type), intent(in) :: self

      real(wp) :: elastic(6)

      elastic(:) = self%strain
      elastic(4) = sign(max(abs(self%strain(4)) - self%stays(), 0.0_wp), self%strain(4))
      stored = 0.5_wp*dot_product(self%stress, elastic)
   end function stored

end module ply_point
