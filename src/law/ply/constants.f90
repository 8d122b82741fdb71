!> Constants of plies that are damaged, and those of the ply-damage law.
module plydyn_law_ply_constants
   use plydyn_base_error, only : error_type, exit_input, fail
   use plydyn_base_precision, only : wp
   use plydyn_base_text, only : text
   use plydyn_law_law, only : law_constants_type, law_type, scalars, shows_dissipated, &
      & shows_fibre_damage, shows_matrix_damage, shows_shear_damage
   use plydyn_law_ply_crack_band, only : longest_length, mode_names, modes, rule_band
   use plydyn_law_ply_fibre_lines, only : first_reach
   use plydyn_law_ply_shear_curve, only : shear_curve_type
   implicit none
   private

   !> Places of tension and of compression in pairs of constants
   integer, parameter, public :: in_tension = 1, in_compression = 2

   !> Onset of matrix damage in compression: quadratic in stress and shear (A), or Hashin's of 1980,
   !> where compression raises the shear that is borne (B)
   integer, parameter, public :: onset_quadratic = 1, onset_hashin = 2

   !> What to do where the crack band is too wide for the toughness: start damage early, at the
   !> stress that leaves the toughness right; refuse the mesh; let the stress drop at once
   integer, parameter, public :: snap_reduce = 1, snap_refuse = 2, snap_drop = 3

   !> Factor of strengths that no stress reaches
   real(wp), parameter :: out_of_reach = 1.0e6_wp

   !> Constants of a ply that is damaged, besides the elastic ones. Pairs are in tension and in
   !> compression, where nothing else is said
   type, abstract, public, extends(law_constants_type) :: damaged_ply_type
      !> Shear 12 in the plane until the matrix cracks: stress over total strain of monotone loading
      type(shear_curve_type) :: curve
      !> XT, XC; YT, YC; S12
      real(wp) :: fibre_strength(2) = 0.0_wp, matrix_strength(2) = 0.0_wp
      real(wp) :: shear_strength = 0.0_wp
      !> Energies per area of crack of fibres, and of the matrix: in tension and in compression, or
      !> when it is opened and when it is sheared
      real(wp) :: fibre_toughness(2) = 0.0_wp, matrix_toughness(2) = 0.0_wp
      !> Shares of the strength and of the energy of fibres in one of two laws of softening; 1 on
      !> one line
      real(wp) :: line_strength(2) = 1.0_wp, line_toughness(2) = 1.0_wp
      !> Share of the strength that crushed fibres keep in compression
      real(wp) :: plateau = 0.0_wp
      !> Rule for the width of the crack band; the width itself, 0: by the rule
      integer :: band_rule = rule_band
      real(wp) :: band_width = 0.0_wp
   contains
      procedure :: may_crack
      procedure :: crack_strengths
   end type damaged_ply_type

   !> Constants of the ply-damage law
   type, public, extends(damaged_ply_type) :: ply_constants_type
      !> S23, which Hashin's onset only needs
      real(wp) :: cross_strength = 0.0_wp
      !> Energy per area of a matrix crack by shear; 0: that of the sign of the stress across
      real(wp) :: shear_toughness = 0.0_wp
      !> Onset of matrix damage in compression, quadratic or Hashin's
      integer :: onset = onset_quadratic
      !> Tension and compression have damage of their own: cracks close
      logical :: closes = .true.
      !> Damage also weakens the shear across the thickness
      logical :: weakens_across = .false.
      !> Least integrity
      real(wp) :: residual = 0.01_wp
      !> What to do about snap-back
      integer :: snap_back = snap_reduce
      !> Least ratio of the strain at the end of softening to that at onset, where damage starts
      !> early
      real(wp) :: snap_ratio = 1.05_wp
   contains
      procedure :: new_batch
      procedure :: set_lane
      procedure :: shows
      procedure :: leave_cracks
      procedure :: longest_lengths
      procedure :: snaps_back
      procedure :: refuse_snap_back
   end type ply_constants_type

   ! the law of a batch uses these constants: a submodule can use the law
   interface
      !> A law without lanes
      module subroutine new_batch(self, law)
         implicit none
         class(ply_constants_type), intent(in) :: self
         class(law_type), allocatable, intent(out) :: law
      end subroutine new_batch

      !> Give a lane its ply
      pure module subroutine set_lane(self, lane, law)
         implicit none
         class(ply_constants_type), intent(in) :: self
         integer, intent(in) :: lane
         class(law_type), intent(inout) :: law
      end subroutine set_lane
   end interface

contains

   !> Scalars that the law has for the fields
   pure function shows(self)
      class(ply_constants_type), intent(in) :: self
      logical :: shows(scalars)

      shows(:) = .false.
      shows([shows_fibre_damage, shows_matrix_damage, shows_shear_damage, shows_dissipated]) &
         & = .true.
   end function shows

   !> Damage that averages drive has no place beside cracks
   pure logical function may_crack(self)
      class(damaged_ply_type), intent(in) :: self

      may_crack = .not. self%averages()
   end function may_crack

   !> YT, S12, and YT again: a crack by shear through the thickness opens at 45 degrees
   pure function crack_strengths(self) result(strengths)
      class(damaged_ply_type), intent(in) :: self
      real(wp) :: strengths(3)

      strengths(:) = [self%matrix_strength(in_tension), self%shear_strength, &
         & self%matrix_strength(in_tension)]
   end function crack_strengths

   !> No stress damages the matrix; fibres break, and shear follows its curve
   pure subroutine leave_cracks(self)
      class(ply_constants_type), intent(inout) :: self

      self%has_lines = .true.
      self%matrix_strength(:) = out_of_reach*self%matrix_strength
      self%cross_strength = out_of_reach*self%cross_strength
      self%shear_strength = out_of_reach*self%shear_strength
      self%matrix_toughness(:) = out_of_reach**2*self%matrix_toughness
      self%shear_toughness = out_of_reach**2*self%shear_toughness
   end subroutine leave_cracks

   !> Widest crack band of each mode in uniaxial stress at which softening does not snap back
   pure function longest_lengths(self) result(longest)
      class(ply_constants_type), intent(in) :: self
      real(wp) :: longest(modes)

      real(wp) :: shear_toughness

      shear_toughness = self%matrix_toughness(in_tension)
      if (self%shear_toughness > 0.0_wp) shear_toughness = self%shear_toughness
      longest(1:2) = longest_length(self%young(1), self%fibre_toughness, self%fibre_strength) &
         & *first_reach(self%line_strength, self%line_toughness)
      longest(in_compression) = longest(in_compression)/(1.0_wp - self%plateau)**2
      longest(3:4) = longest_length(self%young(2), self%matrix_toughness, self%matrix_strength)
      longest(5) = longest_length(self%shear(1), shear_toughness, self%shear_strength)
   end function longest_lengths

   !> Modes in which a crack band is too wide: damage starts early there, or the stress drops
   pure function snaps_back(self, length) result(snaps)
      class(ply_constants_type), intent(in) :: self
      real(wp), intent(in) :: length(2)
      logical :: snaps(modes)

      real(wp) :: longest(modes)

      longest(:) = self%longest_lengths()/self%snap_ratio
      snaps(:in_compression) = length(1) > longest(:in_compression)
      snaps(in_compression + 1:) = length(2) > longest(in_compression + 1:)
   end function snaps_back

   !> Refuse a crack band that snaps back, where the material asks for that
   subroutine refuse_snap_back(self, length, error)
      class(ply_constants_type), intent(in) :: self
      real(wp), intent(in) :: length(2)
      type(error_type), allocatable, intent(out) :: error

      real(wp) :: longest(modes), width
      integer :: i

      if (self%snap_back /= snap_refuse) return
      longest(:) = self%longest_lengths()/self%snap_ratio
      do i = 1, modes
         width = merge(length(1), length(2), i <= in_compression)
         if (width <= longest(i)) cycle
         call fail(error, exit_input, "the crack band of "//trim(mode_names(i))//" is " &
            & //text(width)//" wide and would snap back: make it less than "//text(longest(i)) &
            & //" by a finer mesh, or let damage start early")
         return
      end do
   end subroutine refuse_snap_back

end module plydyn_law_ply_constants
