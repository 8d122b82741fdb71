!> Abstract material: its constants, and its law over a batch, which has the constants of the lanes
!> and updates stress and history.
!>
!> A law extends `law_constants_type` by its own constants. The type says which law the lanes of a
!> batch get, hands a lane its constants, and gives all that others need of the material.
!>
!> The lanes of a batch are layers with different materials: constants are arrays over the lanes,
!> and a law works on the lanes it owns. Strain and stress are in ply axes, in the order 11, 22, 33,
!> 12, 13, 23, with engineering shear.
module plydyn_law_law
   use plydyn_base_error, only : error_type
   use plydyn_base_precision, only : lanes, wp
   use plydyn_law_ply_crack_band, only : modes
   implicit none
   private

   !> Mechanisms that dissipate energy, in the order of their columns; those with a history variable
   !> of a ply first
   integer, parameter, public :: by_fibre_damage = 1, by_matrix_damage = 2, &
      & by_ply_plasticity = 3, by_metal_plasticity = 4, by_delamination = 5, by_friction = 6
   integer, parameter, public :: mechanisms = 6
   character(16), parameter, public :: mechanism_names(mechanisms) = [character(16) :: &
      & "fibre damage", "matrix damage", "ply plasticity", "metal plasticity", "delamination", &
      & "friction"]

   !> Scalar output variables of a point, in the order of the recovered values, and the names of
   !> their fields
   integer, parameter, public :: shows_plastic_strain = 1, shows_fibre_damage = 2, &
      & shows_matrix_damage = 3, shows_shear_damage = 4, shows_dissipated = 5
   integer, parameter, public :: scalars = 5
   character(16), parameter, public :: scalar_names(scalars) = [character(16) :: &
      & "plastic_strain", "damage_fibre", "damage_matrix", "damage_shear", "dissipated"]

   !> Constants of a material, in its own axes: 1 fibre, 2 across in the plane, 3 normal
   type, abstract, public :: law_constants_type
      !> E1, E2, E3
      real(wp) :: young(3) = 0.0_wp
      !> nu12, nu13, nu23: strain in the second direction from stress along the first
      real(wp) :: poisson(3) = 0.0_wp
      !> G12, G13, G23
      real(wp) :: shear(3) = 0.0_wp
      !> Radii of the ellipse over which the strains that drive damage are averaged, along the
      !> fibres and across them; 0 for no average
      real(wp) :: radius(2) = 0.0_wp
      !> Cracks of the matrix are lines, and nothing else damages it
      logical :: has_lines = .false.
   contains
      procedure(new_batch), deferred :: new_batch
      procedure(set_lane), deferred :: set_lane
      procedure :: is_elastic
      procedure :: shows
      procedure :: is_damaged
      procedure :: averages
      procedure :: shares_batch
      procedure :: may_crack
      procedure :: crack_strengths
      procedure :: leave_cracks
      procedure :: snaps_back
      procedure :: refuse_snap_back
   end type law_constants_type

   !> A law with the constants of one batch
   type, abstract, public :: law_type
      !> Lanes that have this law
      logical :: owns(lanes) = .false.
      !> History variables of a point; the last is the energy dissipated so far per volume, unless
      !> the law says otherwise in `output_variables`
      integer :: histories = 0
      !> Those that a point without damage may change or begins with, the first ones; the others are
      !> zero there
      integer :: intact_histories = huge(1)
      !> History variable of the energy dissipated so far by each mechanism, which is that energy
      !> unless the law says otherwise in `dissipated_energy`; 0 for none
      integer :: energy_variable(mechanisms) = 0
      !> History variable of the size of the permanent shear strain 12; 0 for none
      integer :: permanent_shear = 0
      !> Rule for the width of the crack band of lanes that soften, as in `band_length`; 0 elsewhere
      integer :: band_rule(lanes) = 0
      !> Width of the crack band of lanes whose deck gives it; 0 elsewhere
      real(wp) :: band_width(lanes) = 0.0_wp
      !> Radii, along and across the fibres, of the ellipse of each lane over which the strains that
      !> drive damage are averaged; 0 where there is no average
      real(wp) :: radius(lanes, 2) = 0.0_wp
      !> How many such strains a point has; its own, for its neighbours in the next step, and their
      !> averages are the last history variables, behind these
      integer :: driving = 0, behind_own = 0, behind_mean = 0
   contains
      procedure(update_batch), deferred :: update
      procedure :: update_points
      procedure :: stress_at
      procedure :: start_history
      procedure :: set_average
      procedure :: exchange_strains
      procedure :: output_variables
      procedure :: dissipated_energy
      procedure :: stored_energy
   end type law_type

   !> The law of some lanes of one block of layers
   type, public :: block_law_type
      !> Block of the batch
      integer :: block = 0
      !> The law
      class(law_type), allocatable :: law
   end type block_law_type

   abstract interface
      !> A law without lanes, of the type that the material needs
      subroutine new_batch(self, law)
         import :: law_constants_type, law_type
         implicit none
         class(law_constants_type), intent(in) :: self
         class(law_type), allocatable, intent(out) :: law
      end subroutine new_batch

      !> Give a lane of a law that `new_batch` made its constants
      pure subroutine set_lane(self, lane, law)
         import :: law_constants_type, law_type
         implicit none
         class(law_constants_type), intent(in) :: self
         !> Lane, which the law owns from then on
         integer, intent(in) :: lane
         class(law_type), intent(inout) :: law
      end subroutine set_lane

      !> Stress at the end of a step, and the history with it
      pure subroutine update_batch(self, step, strain, history, stress)
         import :: lanes, law_type, wp
         implicit none
         class(law_type), intent(in) :: self
         !> Time step, for laws with rates; 0 where there is none
         real(wp), intent(in) :: step
         !> Total strain, (lanes, 6)
         real(wp), intent(in) :: strain(lanes, 6)
         !> History of the point, old in and new out, (lanes, histories); what `start_history` made
         !> of it at time zero
         real(wp), intent(inout) :: history(lanes, *)
         !> Stress; lanes of other laws keep theirs
         real(wp), intent(inout) :: stress(lanes, 6)
      end subroutine update_batch
   end interface

contains

   !> `update` for some points of an element, one after the other; a law that takes less time over
   !> all of them at once overrides this
   pure subroutine update_points(self, points, pitch, step, strain, history, stress)
      class(law_type), intent(in) :: self
      !> Number of points; rows of the history from one of their variables to the next
      integer, intent(in) :: points, pitch
      !> Time step; total strain
      real(wp), intent(in) :: step, strain(lanes, 6, points)
      !> History from the first of the points on, old in and new out: one variable of all points of
      !> all elements after the other, (lanes, points, histories). What a law looks at in every step
      !> is read in the order of memory, however many variables a point has
      real(wp), intent(inout) :: history(lanes, pitch, *)
      !> Stress; lanes of other laws keep theirs
      real(wp), intent(inout) :: stress(lanes, 6, points)

      real(wp) :: h(lanes, self%histories)
      integer :: m

      do m = 1, points
         h(:, :) = history(:, m, :self%histories)
         call self%update(step, strain(:, :, m), h, stress(:, :, m))
         history(:, m, :self%histories) = h
      end do
   end subroutine update_points

   !> Stress that belongs to a strain and its history: nothing goes on
   pure subroutine stress_at(self, strain, history, stress)
      class(law_type), intent(in) :: self
      !> Total strain; history of the point
      real(wp), intent(in) :: strain(lanes, 6), history(lanes, *)
      !> Stress; lanes of other laws keep theirs
      real(wp), intent(inout) :: stress(lanes, 6)

      real(wp) :: copy(lanes, self%histories)

      copy(:, :) = history(:, :self%histories)
      call self%update(0.0_wp, strain, copy, stress)
   end subroutine stress_at

   !> History of a point at time zero, which is all zero; a law that needs more overrides this, for
   !> variables of intact points
   pure subroutine start_history(self, length, widest, history)
      class(law_type), intent(in) :: self
      !> Widths of the crack band for fibres and for matrix; 0 in lanes without a rule for it
      real(wp), intent(in) :: length(lanes, 2)
      !> The largest of those of all points of the element
      real(wp), intent(in) :: widest(lanes)
      !> (lanes, intact histories), zero in
      real(wp), intent(inout) :: history(lanes, *)
   end subroutine start_history

   !> Let averages over neighbours drive the damage of a lane that has just got its constants
   pure subroutine set_average(self, lane, radius, strains)
      class(law_type), intent(inout) :: self
      integer, intent(in) :: lane
      !> Radii of the ellipse along and across the fibres
      real(wp), intent(in) :: radius(2)
      !> How many strains of a point drive damage
      integer, intent(in) :: strains

      self%radius(lane, :) = radius
      self%driving = strains
      self%behind_own = self%histories
      self%behind_mean = self%behind_own + strains
      self%histories = self%behind_mean + strains
      self%intact_histories = self%histories
   end subroutine set_average

   !> Keep the strains of a point for its neighbours, and give the averages that drive damage.
   !> Damage grows with the strain of neighbours: the mean of a driving force over its value at the
   !> end is strain before over strain now, which is what the work of the step less what is stored
   !> comes to
   pure subroutine exchange_strains(self, members, strain, history, mean, share)
      class(law_type), intent(in) :: self
      !> Strains that each mode of damage feels, (strains, modes)
      logical, intent(in) :: members(:, :)
      !> Strains of the point now
      real(wp), intent(in) :: strain(lanes, self%driving)
      !> History of the point, with the strains of the step before in and those of now out
      real(wp), intent(inout) :: history(lanes, self%histories)
      !> Averages, 0 in other lanes; mean of the driving forces of each mode over their values at
      !> the end
      real(wp), intent(out) :: mean(lanes, self%driving), share(lanes, size(members, 2))

      real(wp) :: product(lanes), square(lanes)
      integer :: j, k

      associate (own => self%behind_own, neighbours => self%behind_mean)
         do j = 1, size(members, 2)
            product(:) = 0.0_wp
            square(:) = 0.0_wp
            do k = 1, self%driving
               if (.not. members(k, j)) cycle
               product(:) = product + history(:, own + k)*strain(:, k)
               square(:) = square + strain(:, k)**2
            end do
            share(:, j) = max(product, 0.0_wp)/max(square, tiny(square))
         end do
         do k = 1, self%driving
            where (self%owns) history(:, own + k) = strain(:, k)
            mean(:, k) = merge(history(:, neighbours + k), 0.0_wp, self%owns)
         end do
      end associate
   end subroutine exchange_strains

   !> Scalars of a lane that its fields show; a law that has more than its energies overrides this
   pure function output_variables(self, lane, history) result(values)
      class(law_type), intent(in) :: self
      integer, intent(in) :: lane
      !> History of the point
      real(wp), intent(in) :: history(lanes, *)
      real(wp) :: values(scalars)

      values(:) = 0.0_wp
      if (self%histories > 0) values(shows_dissipated) = history(lane, self%histories)
   end function output_variables

   !> Energy per volume that a mechanism has dissipated at a point
   pure function dissipated_energy(self, mechanism, history) result(energy)
      class(law_type), intent(in) :: self
      !> One that the law has
      integer, intent(in) :: mechanism
      !> History of the point
      real(wp), intent(in) :: history(lanes, *)
      !> Means nothing in lanes of other laws
      real(wp) :: energy(lanes)

      energy(:) = history(:, self%energy_variable(mechanism))
   end function dissipated_energy

   !> Energy per volume that unloading gives back: half of the stress times the elastic strain. A
   !> law with permanent strains other than that of the shear 12 overrides this
   pure function stored_energy(self, strain, history) result(energy)
      class(law_type), intent(in) :: self
      !> Total strain; history of the point that belongs to it
      real(wp), intent(in) :: strain(lanes, 6), history(lanes, *)
      !> Means nothing in lanes of other laws
      real(wp) :: energy(lanes)

      real(wp) :: elastic(lanes, 6), stress(lanes, 6)

      elastic(:, :) = strain
      if (self%permanent_shear > 0) elastic(:, 4) = sign(max(abs(strain(:, 4)) &
         & - history(:, self%permanent_shear), 0.0_wp), strain(:, 4))
      stress(:, :) = 0.0_wp
      call self%stress_at(strain, history, stress)
      energy(:) = 0.5_wp*sum(stress*elastic, 2)
   end function stored_energy

   !> Whether the stress is the stiffness times the strain: such layers need no law of their own
   pure logical function is_elastic(self)
      class(law_constants_type), intent(in) :: self

      is_elastic = .false.
   end function is_elastic

   !> Scalars that the law has for the fields; a law that has more than its energy overrides this
   pure function shows(self)
      class(law_constants_type), intent(in) :: self
      logical :: shows(scalars)

      shows(:) = .false.
      shows(shows_dissipated) = .not. self%is_elastic()
   end function shows

   !> Whether fibres and matrix lose their stiffness
   pure logical function is_damaged(self)
      class(law_constants_type), intent(in) :: self

      logical :: shown(scalars)

      shown(:) = self%shows()
      is_damaged = shown(shows_fibre_damage)
   end function is_damaged

   !> Whether averages over neighbours drive its damage
   pure logical function averages(self)
      class(law_constants_type), intent(in) :: self

      averages = self%radius(1) > 0.0_wp
   end function averages

   !> Whether lanes of two materials can have one law: of the same type, both with averages or both
   !> without
   pure logical function shares_batch(self, other)
      class(law_constants_type), intent(in) :: self
      !> The other material
      class(law_constants_type), intent(in) :: other

      shares_batch = same_type_as(self, other) .and. (self%averages() .eqv. other%averages())
   end function shares_batch

   !> Whether cracks along lines may take the place of its matrix damage
   pure logical function may_crack(self)
      class(law_constants_type), intent(in) :: self

      may_crack = self%is_elastic()
   end function may_crack

   !> Strengths of the matrix: tension across the fibres, shear along them, shear through the
   !> thickness; 0 where the material has none
   pure function crack_strengths(self) result(strengths)
      class(law_constants_type), intent(in) :: self
      real(wp) :: strengths(3)

      strengths(:) = 0.0_wp
   end function crack_strengths

   !> Leave the cracks of the matrix to lines; a law whose matrix is damaged overrides this
   pure subroutine leave_cracks(self)
      class(law_constants_type), intent(inout) :: self
   end subroutine leave_cracks

   !> Modes in which a crack band is too wide for the toughness; a law that softens overrides this
   pure function snaps_back(self, length) result(snaps)
      class(law_constants_type), intent(in) :: self
      !> Widths of the band for broken fibres and for matrix cracks
      real(wp), intent(in) :: length(2)
      logical :: snaps(modes)

      snaps(:) = .false.
   end function snaps_back

   !> Refuse a crack band that snaps back, where the material asks for that
   subroutine refuse_snap_back(self, length, error)
      class(law_constants_type), intent(in) :: self
      !> Widths of the band for broken fibres and for matrix cracks
      real(wp), intent(in) :: length(2)
      !> Names the first mode that does, and the width that would be right
      type(error_type), allocatable, intent(out) :: error
   end subroutine refuse_snap_back

end module plydyn_law_law
