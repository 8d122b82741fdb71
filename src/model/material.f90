!> Materials of plies and of interfaces.
module plydyn_model_material
   use plydyn_base_precision, only : wp
   use plydyn_law_cohesive_bilinear, only : cohesive_constants_type
   use plydyn_law_ply_constants, only : ply_constants_type
   use plydyn_law_ply_strain_damage, only : strain_constants_type
   use plydyn_model_curve, only : curve_type
   implicit none
   private

   !> What a material does beyond elasticity
   integer, parameter, public :: law_elastic = 0, law_plastic_kinematic = 1, &
      & law_plastic_curve = 2, law_plastic_johnson_cook = 3, law_ply_damage = 4, &
      & law_strain_damage = 5, last_law = law_strain_damage

   !> Metal plasticity
   type, public :: plasticity_type
      !> Yield stress without plastic strain, and slope of stress over total strain beyond it
      real(wp) :: yield = 0.0_wp, tangent = 0.0_wp
      !> Share of hardening that is isotropic: 1 isotropic, 0 kinematic
      real(wp) :: isotropic = 0.0_wp
      !> Rate at which the yield stress is doubled, 0 for none, and the power of its rise
      !> (Cowper and Symonds)
      real(wp) :: rate = 0.0_wp, power = 0.0_wp
      !> Yield stress over effective plastic strain for each of some rates that rise; one alone
      !> holds at all rates
      type(curve_type), allocatable :: curves(:)
      !> Those rates
      real(wp), allocatable :: rates(:)
      !> Between two rates their logarithm counts
      logical :: logarithmic = .false.
      !> Rise of the yield stress up to a plastic strain of 1, and the power of plastic strain
      !> (Johnson and Cook)
      real(wp) :: factor = 0.0_wp, exponent = 1.0_wp
      !> Its rise with the logarithm of the rate, and the rate from which on it rises
      real(wp) :: sensitivity = 0.0_wp, reference_rate = 1.0_wp
   end type plasticity_type

   !> Constants of a ply, in its own axes: 1 fibre, 2 across in the plane, 3 normal
   type, public :: material_type
      !> The user's number
      integer :: id = 0
      !> Keyword that defined it
      character(:), allocatable :: keyword
      !> Where the deck says what to do about its crack bands: line of all lines, file and line
      integer :: line = 0
      character(:), allocatable :: place
      !> Title, empty without one
      character(:), allocatable :: title
      !> Mass per volume
      real(wp) :: density = 0.0_wp
      !> E1, E2, E3
      real(wp) :: young(3) = 0.0_wp
      !> nu12, nu13, nu23: strain in the second direction from stress along the first
      real(wp) :: poisson(3) = 0.0_wp
      !> G12, G13, G23
      real(wp) :: shear(3) = 0.0_wp
      !> `law_elastic` or what it does beyond
      integer :: law = law_elastic
      !> For the laws of plasticity
      type(plasticity_type) :: plasticity
      !> For `law_ply_damage`: all constants, the elastic ones too
      type(ply_constants_type) :: ply
      !> For `law_strain_damage`: all constants, the elastic ones too
      type(strain_constants_type) :: strains
      !> Radii of the ellipse over which the strains that drive damage are averaged, along the
      !> fibres and across them; 0 for no average
      real(wp) :: radius(2) = 0.0_wp
      !> Where the deck says so, as `line` and `place`
      integer :: radius_line = 0
      character(:), allocatable :: radius_place
      !> Direction from which ply angles are measured, degrees from the x axis
      real(wp) :: axis_angle = 0.0_wp
   contains
      procedure :: is_damaged
      procedure :: averages
   end type material_type

   !> What lies between the faces of two plies: springs, or a bond that softens and fails
   type, public :: interface_material_type
      !> The user's number
      integer :: id = 0
      !> Title, empty without one
      character(:), allocatable :: title
      !> It softens and fails; springs have a stiffness and nothing else
      logical :: fails = .false.
      !> Constants, stress and length
      type(cohesive_constants_type) :: constants
      !> Points at the nodes of a quad instead of the Gauss points
      logical :: nodal = .false.
      !> Strengths lowered until the mesh resolves the zone that softens
      logical :: fitted = .false.
   end type interface_material_type

contains

   !> Whether fibres and matrix lose their stiffness
   elemental logical function is_damaged(self)
      class(material_type), intent(in) :: self

      is_damaged = self%law == law_ply_damage .or. self%law == law_strain_damage
   end function is_damaged

   !> Whether averages over neighbours drive its damage
   elemental logical function averages(self)
      class(material_type), intent(in) :: self

      averages = self%radius(1) > 0.0_wp
   end function averages

end module plydyn_model_material
