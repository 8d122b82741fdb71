!> What bounds the final over onset opening from below.
program test_law_cohesive_softening
   use plydyn_base_precision, only : lanes, wp
   use plydyn_law_cohesive_softening, only : benzeggagh_kenane, power_law, softening_type
   use testing, only : begin, check, finish
   implicit none

   !> Toughness of opening and sliding: table 6 of the paper, and the other way round
   real(wp), parameter :: each(2, 2) = reshape([0.28_wp, 0.79_wp, 0.9_wp, 0.3_wp], [2, 2])
   !> Squares of the load per twice the elastic energy, of the paper and the other way round
   real(wp), parameter :: onset(2, 2) = reshape([353.8_wp, 57.9_wp, 60.0_wp, 400.0_wp], [2, 2])
   real(wp), parameter :: exponents(5) = [0.3_wp, 0.8_wp, 1.0_wp, 1.634_wp, 4.0_wp]

   integer :: c, i, j, k

   call begin("least_ratio")
   do c = benzeggagh_kenane, power_law
      do i = 1, size(exponents)
         do j = 1, 2
            do k = 1, 2
               call compare(softening_type(onset(:, k), each(:, j), c, exponents(i)))
            end do
         end do
      end do
   end do
   call finish()

contains

   !> The bound and the least of many mixes
   subroutine compare(law)
      type(softening_type), intent(in) :: law

      !> Mixes per lane
      integer, parameter :: mixes = 2000
      real(wp) :: bound, least, mix(lanes), toughness(lanes)
      integer :: i, l

      least = huge(least)
      do i = 0, mixes
         mix(:) = [(real(i*lanes + l, wp)/real((mixes + 1)*lanes - 1, wp), l=0, lanes - 1)]
         call law%find_toughness(mix, toughness)
         least = min(least, 2.0_wp*minval(toughness*(law%onset(1) &
            & + (law%onset(2) - law%onset(1))*mix)))
      end do
      bound = law%least_ratio()
      call check(bound <= least, "is no more than the ratio of any mix")
      call check(bound >= 0.9_wp*least, "and not much less than the least")
   end subroutine compare

end program test_law_cohesive_softening
