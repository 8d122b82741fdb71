!> The most that a core can do: fused multiplications and additions that wait for nothing, and
!> numbers from the memory and back.
module plydyn_bench_probe
   use plydyn_base_precision, only : lanes, wp
   implicit none
   private

   public :: move, move_together, multiply_add

   !> Chains side by side, enough to hide the latency of one, and rounds of a probe
   integer, parameter, public :: chains = 12
   integer, parameter :: rounds = 2000
   !> Operations of a probe
   real(wp), parameter, public :: probe_flops = 2.0_wp*real(chains*lanes*rounds, wp)
   !> Numbers of an array that no cache holds, and bytes that it takes to read two of them and to
   !> write one back
   integer, parameter, public :: far_numbers = 8000000
   real(wp), parameter, public :: moved_bytes = 24.0_wp*real(far_numbers, wp)

contains

   !> All chains, in registers
   pure subroutine multiply_add(x)
      !> Start and end of the chains
      real(wp), intent(inout) :: x(lanes, chains)

      real(wp) :: a, b, c, d, e, f, g, h, i, j, k, l
      real(wp), parameter :: factor = 0.999_wp, term = 1.0e-3_wp
      integer :: n, r

      !$omp simd private(a, b, c, d, e, f, g, h, i, j, k, l, r)
      do n = 1, lanes
         a = x(n, 1)
         b = x(n, 2)
         c = x(n, 3)
         d = x(n, 4)
         e = x(n, 5)
         f = x(n, 6)
         g = x(n, 7)
         h = x(n, 8)
         i = x(n, 9)
         j = x(n, 10)
         k = x(n, 11)
         l = x(n, 12)
         do r = 1, rounds
            a = factor*a + term
            b = factor*b + term
            c = factor*c + term
            d = factor*d + term
            e = factor*e + term
            f = factor*f + term
            g = factor*g + term
            h = factor*h + term
            i = factor*i + term
            j = factor*j + term
            k = factor*k + term
            l = factor*l + term
         end do
         x(n, 1) = a
         x(n, 2) = b
         x(n, 3) = c
         x(n, 4) = d
         x(n, 5) = e
         x(n, 6) = f
         x(n, 7) = g
         x(n, 8) = h
         x(n, 9) = i
         x(n, 10) = j
         x(n, 11) = k
         x(n, 12) = l
      end do
   end subroutine multiply_add

   !> A pass over two arrays as that of a motion over a step
   pure subroutine move(v, u)
      !> What is added, and to what
      real(wp), intent(in), contiguous :: v(:)
      real(wp), intent(inout), contiguous :: u(:)

      integer :: k

      !$omp simd
      do k = 1, size(u)
         u(k) = u(k) + 1.0e-3_wp*v(k)
      end do
   end subroutine move

   !> The same by some threads at once, each on its own part
   subroutine move_together(threads, v, u)
      !> How many
      integer, intent(in) :: threads
      !> As in `move`
      real(wp), intent(in), contiguous :: v(:)
      real(wp), intent(inout), contiguous :: u(:)

      integer :: length, part

      length = size(u)/threads
      !$omp parallel do schedule(static, 1) num_threads(threads)
      do part = 1, threads
         call move(v((part - 1)*length + 1:part*length), u((part - 1)*length + 1:part*length))
      end do
      !$omp end parallel do
   end subroutine move_together

end module plydyn_bench_probe
