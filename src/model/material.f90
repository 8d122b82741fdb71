!> Materials of plies and of interfaces.
module plydyn_model_material
   use plydyn_base_precision, only : wp
   use plydyn_law_cohesive_bilinear, only : cohesive_constants_type
   use plydyn_law_law, only : law_constants_type, scalars
   use plydyn_law_scatter, only : scatter_type
   implicit none
   private

   public :: add_material

   !> Material of plies or bricks
   type, public :: material_type
      !> The user's number
      integer :: id = 0
      !> Keyword that defined it, and title, empty without one
      character(:), allocatable :: keyword, title
      !> Mass per volume; direction from which ply angles are measured, degrees from the x axis
      real(wp) :: density = 0.0_wp, axis_angle = 0.0_wp
      !> Elastic constants, and those of its law
      class(law_constants_type), allocatable :: law
      !> Where the deck says what to do about its crack bands: line of all lines, file and line
      integer :: line = 0
      character(:), allocatable :: place
      !> Where the deck gives the radii of averages, likewise
      integer :: radius_line = 0
      character(:), allocatable :: radius_place
   contains
      procedure :: is_damaged
      procedure :: shows
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
      !> Scatter of the strengths from point to point
      type(scatter_type) :: scatter
      !> Whether the deck says how it fails beyond its constants
      logical :: has_law = .false.
   end type interface_material_type

contains

   !> Append a material with its constants
   subroutine add_material(materials, material, law)
      !> Materials so far
      type(material_type), allocatable, intent(inout) :: materials(:)
      !> The new one without constants
      type(material_type), intent(in) :: material
      !> Its constants
      class(law_constants_type), intent(in) :: law

      type(material_type), allocatable :: longer(:)
      integer :: i, n

      n = size(materials)
      allocate (longer(n + 1))
      do i = 1, n
         longer(i) = materials(i)
      end do
      longer(n + 1) = material
      allocate (longer(n + 1)%law, source=law)
      call move_alloc(longer, materials)
   end subroutine add_material

   !> Whether fibres and matrix lose their stiffness
   elemental logical function is_damaged(self)
      class(material_type), intent(in) :: self

      is_damaged = self%law%is_damaged()
   end function is_damaged

   !> Whether its law has a scalar for the fields
   elemental logical function shows(self, scalar)
      class(material_type), intent(in) :: self
      !> One of `shows_…` of `plydyn_law_law`
      integer, intent(in) :: scalar

      logical :: shown(scalars)

      shown(:) = self%law%shows()
      shows = shown(scalar)
   end function shows

end module plydyn_model_material
