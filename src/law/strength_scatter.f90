!> Scatter of the strengths of a ply: one factor of those of its fibres, one of those of its matrix.
!> The two are not correlated, nor are those of different plies and of interfaces.
module plydyn_law_strength_scatter
   use plydyn_base_precision, only : wp
   use plydyn_law_scatter, only : scatter_type
   implicit none
   private

   !> Scatter of the strengths of a material; by default none
   type, public :: strength_scatter_type
      !> Number of the realisation
      integer :: seed = 0
      !> Moduli of Weibull of the strengths of fibres and of matrix; 0 without scatter
      real(wp) :: modulus(2) = 0.0_wp
      !> Length of the correlation
      real(wp) :: length = 0.0_wp
   contains
      procedure :: scatters
      procedure :: factors
   end type strength_scatter_type

contains

   !> Whether any strength scatters
   elemental logical function scatters(self)
      class(strength_scatter_type), intent(in) :: self

      scatters = any(self%modulus > 0.0_wp)
   end function scatters

   !> Factors of the strengths of fibres and of matrix at a point; 1 without scatter
   pure function factors(self, place, ply) result(factor)
      class(strength_scatter_type), intent(in) :: self
      !> Position in the plane
      real(wp), intent(in) :: place(2)
      !> Ply of the part, counted from the bottom
      integer, intent(in) :: ply
      real(wp) :: factor(2)

      type(scatter_type) :: field
      integer :: k

      factor(:) = 1.0_wp
      do k = 1, 2
         if (.not. self%modulus(k) > 0.0_wp) cycle
         field = scatter_type(self%seed, self%modulus(k), self%length)
         ! interfaces have the numbers above 0
         factor(k) = field%factor(place, 1 - 2*ply - k)
      end do
   end function factors

end module plydyn_law_strength_scatter
