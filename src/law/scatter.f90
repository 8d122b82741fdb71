!> Scatter of strengths over a laminate: a field of factors with the distribution of Weibull and
!> mean 1, correlated over a length.
!>
!> Numbers of a normal distribution stand at the places of a lattice as wide as the length; each is
!> hashed from the seed, the layer and the two indices of the place. At a point their mean, weighted
!> by exp(-(distance/length)**2) and divided by the root of the sum of squared weights, is normal
!> again, and its correlation falls nearly as exp(-(distance/length)**2/2). It depends on nothing
!> but the point: not on the mesh, nor on ranks. Its quantile is that of the factor.
module plydyn_law_scatter
   use, intrinsic :: iso_fortran_env, only : int64
   use plydyn_base_precision, only : wp
   implicit none
   private

   !> A scatter of strengths
   type, public :: scatter_type
      !> Number of the realisation
      integer :: seed = 0
      !> Modulus of Weibull, 0 without scatter, and length of the correlation
      real(wp) :: modulus = 0.0_wp, length = 0.0_wp
   contains
      procedure :: factor
      procedure :: largest_factor
   end type scatter_type

   !> Lattice places beyond which weights are dropped, and the largest normal number
   integer, parameter :: half_width = 3
   real(wp), parameter :: most = 4.0_wp
   !> Lattice places after which the field repeats itself
   real(wp), parameter, public :: period = 2.0_wp**30
   !> Bits of a hash, and its halves
   integer(int64), parameter :: bits = 4294967295_int64, half = 65535_int64

contains

   !> Factor of the strengths at a point of a layer
   pure real(wp) function factor(self, place, layer)
      class(scatter_type), intent(in) :: self
      !> Position in the plane, and number of the layer or interface
      real(wp), intent(in) :: place(2)
      integer, intent(in) :: layer

      real(wp) :: squares, total, weight, x(2)
      integer :: first(2), i, j

      x(:) = place/self%length
      ! the lattice repeats itself, far beyond a plate, so that its indices are integers
      x(:) = x - period*anint(x/period)
      first(:) = floor(x)
      total = 0.0_wp
      squares = 0.0_wp
      do j = first(2) - half_width + 1, first(2) + half_width
         do i = first(1) - half_width + 1, first(1) + half_width
            weight = exp(-(x(1) - i)**2 - (x(2) - j)**2)
            total = total + weight*normal_number([self%seed, layer, i, j])
            squares = squares + weight**2
         end do
      end do
      factor = quantile(self%modulus, total/sqrt(squares))
   end function factor

   !> Largest factor that there can be
   pure real(wp) function largest_factor(self)
      class(scatter_type), intent(in) :: self

      largest_factor = quantile(self%modulus, most)
   end function largest_factor

   !> Quantile of Weibull's distribution with mean 1 where a normal number stands
   pure real(wp) function quantile(modulus, number)
      !> Modulus, and the number, cut at `most`
      real(wp), intent(in) :: modulus, number

      real(wp) :: beyond

      beyond = 0.5_wp*erfc(min(max(number, -most), most)/sqrt(2.0_wp))
      quantile = (-log(beyond))**(1.0_wp/modulus)/gamma(1.0_wp + 1.0_wp/modulus)
   end function quantile

   !> A normal number that depends on four integers (Box and Muller)
   pure real(wp) function normal_number(key)
      !> The integers
      integer, intent(in) :: key(4)

      real(wp), parameter :: two_pi = 2.0_wp*acos(-1.0_wp)
      integer(int64) :: bit_string
      real(wp) :: uniform(2)
      integer :: k

      bit_string = 0
      do k = 1, size(key)
         bit_string = hash(ieor(bit_string, iand(int(key(k), int64), bits)))
      end do
      do k = 1, 2
         bit_string = hash(bit_string + k)
         uniform(k) = (real(bit_string, wp) + 0.5_wp)/real(bits + 1, wp)
      end do
      normal_number = sqrt(-2.0_wp*log(uniform(1)))*cos(two_pi*uniform(2))
   end function normal_number

   !> Hash of 32 bits (Wellons, 2018)
   pure integer(int64) function hash(key)
      !> What is hashed: its lower 32 bits
      integer(int64), intent(in) :: key

      hash = iand(key, bits)
      hash = product_of(ieor(hash, shiftr(hash, 16)), 2146121005_int64)
      hash = product_of(ieor(hash, shiftr(hash, 15)), 2221713035_int64)
      hash = ieor(hash, shiftr(hash, 16))
   end function hash

   !> Product of two numbers of 32 bits, its lower 32 bits, without overflow
   pure integer(int64) function product_of(one, other)
      !> The numbers
      integer(int64), intent(in) :: one, other

      product_of = iand(one*iand(other, half) &
         & + shiftl(iand(one*shiftr(other, 16), half), 16), bits)
   end function product_of

end module plydyn_law_scatter
