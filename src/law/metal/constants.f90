!> Constants that all laws of metal plasticity share.
module plydyn_law_metal_constants
   use plydyn_law_constants, only : law_constants_type
   use plydyn_law_law, only : scalars, shows_dissipated, shows_plastic_strain
   implicit none
   private

   !> Constants of a metal; the yield stress is left to its law
   type, abstract, public, extends(law_constants_type) :: metal_constants_type
   contains
      procedure :: shows
   end type metal_constants_type

contains

   !> Scalars that the law has for the fields
   pure function shows(self)
      class(metal_constants_type), intent(in) :: self
      logical :: shows(scalars)

      shows(:) = .false.
      shows([shows_plastic_strain, shows_dissipated]) = .true.
   end function shows

end module plydyn_law_metal_constants
