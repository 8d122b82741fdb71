!> Constants of a material: the elastic ones, which every material has, and those of its law.
!>
!> A law extends `law_constants_type` by its own constants. The type says which law the lanes of a
!> batch get, hands a lane its constants, and gives all that others need of the material.
module plydyn_law_constants
   use plydyn_base_error, only : error_type
   use plydyn_base_precision, only : wp
   use plydyn_law_law, only : law_type, scalars, shows_dissipated, shows_fibre_damage
   use plydyn_law_ply_crack_band, only : modes
   implicit none
   private

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

   abstract interface
      !> A law without lanes, of the type that the material needs
      subroutine new_batch(self, law)
         import :: law_constants_type, law_type
         implicit none
         class(law_constants_type), intent(in) :: self
         !> The law
         class(law_type), allocatable, intent(out) :: law
      end subroutine new_batch

      !> Give a lane of a law that `new_batch` made its constants
      pure subroutine set_lane(self, lane, law)
         import :: law_constants_type, law_type
         implicit none
         class(law_constants_type), intent(in) :: self
         !> Lane, which the law owns from then on
         integer, intent(in) :: lane
         !> The law
         class(law_type), intent(inout) :: law
      end subroutine set_lane
   end interface

contains

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

end module plydyn_law_constants
