!> Exact sums: the same bits for any order of the terms and any number of ranks and threads.
!>
!> A sum is a long fixed-point number (Kulisch, 1971) in limbs of 32 bits, each stored in a word of
!> 64 bits: two thousand million terms fit before a carry. Terms below 2**-384 count as zero.
module plydyn_base_exact_sum
   use, intrinsic :: ieee_arithmetic, only : ieee_quiet_nan, ieee_value
   use, intrinsic :: iso_fortran_env, only : int64
   use plydyn_base_precision, only : wp
   implicit none
   private

   public :: new_exact_sums

   !> Bits of a limb, and limbs of a sum
   integer, parameter :: limb_bits = 32, limbs = 24
   !> Binary exponent of the lowest bit
   integer, parameter :: lowest = -384
   !> Bits of the fraction of a double, mask of its exponent, and offset from the exponent to the
   !> power of two of its last bit
   integer, parameter :: fraction_bits = 52, exponent_mask = 2047, exponent_offset = 1075
   !> Masks of a limb and of the fraction, and the hidden bit
   integer(int64), parameter :: limb_mask = 2_int64**limb_bits - 1_int64
   integer(int64), parameter :: fraction_mask = 2_int64**fraction_bits - 1_int64
   integer(int64), parameter :: hidden_bit = 2_int64**fraction_bits

   !> One sum
   type, public :: exact_sum_type
      !> Limbs in ascending order; entry 0 counts terms that were too large or not numbers. The
      !> sum of parts is the sum of their limbs
      integer(int64) :: limb(0:limbs) = 0_int64
   contains
      procedure :: add => add_term
      procedure :: value => value_of_sum
   end type exact_sum_type

   !> Sums with an index
   type, public :: exact_sums_type
      !> Limbs in ascending order, (0:limbs, sums); row 0 counts terms that were too large or not
      !> numbers
      integer(int64), allocatable :: limb(:, :)
   contains
      procedure :: clear
      procedure :: add
      procedure :: value
   end type exact_sums_type

contains

   !> Sums that are zero
   pure function new_exact_sums(sums) result(self)
      !> Number of sums
      integer, intent(in) :: sums
      type(exact_sums_type) :: self

      allocate (self%limb(0:limbs, sums), source=0_int64)
   end function new_exact_sums

   !> Set all sums to zero
   pure subroutine clear(self)
      class(exact_sums_type), intent(inout) :: self

      self%limb(:, :) = 0_int64
   end subroutine clear

   !> Add a term
   pure subroutine add(self, k, term)
      class(exact_sums_type), intent(inout) :: self
      !> Index of the sum
      integer, intent(in) :: k
      !> The term
      real(wp), intent(in) :: term

      call add_to_limbs(self%limb(:, k), term)
   end subroutine add

   !> Add a term
   pure subroutine add_term(self, term)
      class(exact_sum_type), intent(inout) :: self
      !> The term
      real(wp), intent(in) :: term

      call add_to_limbs(self%limb, term)
   end subroutine add_term

   !> Add a term to the limbs of a sum
   pure subroutine add_to_limbs(limb, term)
      integer(int64), intent(inout) :: limb(0:limbs)
      real(wp), intent(in) :: term

      integer(int64) :: bits, high, low, sign_of
      integer :: first, place

      bits = transfer(term, bits)
      place = int(iand(shiftr(bits, fraction_bits), int(exponent_mask, int64))) &
         & - exponent_offset - lowest
      if (place < 0) return
      first = place/limb_bits + 1
      if (first > limbs - 2) then
         limb(0) = limb(0) + 1_int64
         return
      end if
      sign_of = merge(-1_int64, 1_int64, bits < 0_int64)
      bits = ior(iand(bits, fraction_mask), hidden_bit)
      place = mod(place, limb_bits)
      low = shiftl(iand(bits, limb_mask), place)
      high = shiftl(shiftr(bits, limb_bits), place) + shiftr(low, limb_bits)
      limb(first) = limb(first) + sign_of*iand(low, limb_mask)
      limb(first + 1) = limb(first + 1) + sign_of*iand(high, limb_mask)
      limb(first + 2) = limb(first + 2) + sign_of*shiftr(high, limb_bits)
   end subroutine add_to_limbs

   !> Value of a sum, correct to the last bit but one; NaN if a term was not a number
   pure real(wp) function value(self, k)
      class(exact_sums_type), intent(in) :: self
      !> Index of the sum
      integer, intent(in) :: k

      value = value_of_limbs(self%limb(:, k))
   end function value

   !> Value of the sum, correct to the last bit but one; NaN if a term was not a number
   pure real(wp) function value_of_sum(self) result(value)
      class(exact_sum_type), intent(in) :: self

      value = value_of_limbs(self%limb)
   end function value_of_sum

   !> Value of the limbs of a sum
   pure real(wp) function value_of_limbs(limb) result(value)
      integer(int64), intent(in) :: limb(0:limbs)

      real(wp), parameter :: limb_size = 2.0_wp**limb_bits
      integer(int64) :: digit(-1:limbs)
      integer :: first, top

      if (limb(0) /= 0_int64) then
         value = ieee_value(value, ieee_quiet_nan)
         return
      end if
      call find_ends(limb(1:), first, top)
      value = 0.0_wp
      if (top == 0) return
      digit(first - 2:first - 1) = 0_int64
      digit(first:top) = limb(first:top)
      call carry(digit(first:top))
      value = 1.0_wp
      if (digit(top) < 0_int64) then
         value = -1.0_wp
         digit(first:top) = -limb(first:top)
         call carry(digit(first:top))
      end if
      do top = top, first + 1, -1
         if (digit(top) /= 0_int64) exit
      end do
      ! three limbs hold at least 65 bits
      value = value*scale((real(digit(top), wp)*limb_size + real(digit(top - 1), wp))*limb_size &
         & + real(digit(top - 2), wp), limb_bits*(top - 3) + lowest)
   end function value_of_limbs

   !> Lowest nonzero limb, and the one that the highest may carry into; 0 when all are zero
   pure subroutine find_ends(limb, first, last)
      integer(int64), intent(in) :: limb(limbs)
      integer, intent(out) :: first, last

      first = 1
      do last = limbs, 1, -1
         if (limb(last) /= 0_int64) exit
      end do
      if (last == 0) return
      last = min(last + 1, limbs)
      do while (limb(first) == 0_int64)
         first = first + 1
      end do
   end subroutine find_ends

   !> Propagate carries: every limb but the last from 0 to 2**32 - 1
   pure subroutine carry(digit)
      integer(int64), intent(inout) :: digit(:)
      integer :: i

      do i = 1, size(digit) - 1
         digit(i + 1) = digit(i + 1) + shifta(digit(i), limb_bits)
         digit(i) = iand(digit(i), limb_mask)
      end do
   end subroutine carry

end module plydyn_base_exact_sum
