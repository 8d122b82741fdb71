!> Stable merge sort.
module plydyn_base_sort
   implicit none
   private

   public :: each_once, sorted_order

contains

   !> Indices of keys in ascending order; equal keys keep their order
   pure function sorted_order(key) result(order)
      !> The keys
      integer, intent(in) :: key(:)
      integer :: order(size(key))

      integer, allocatable :: merged(:)
      integer :: first, i, last, middle, width

      order(:) = [(i, i=1, size(key))]
      allocate (merged(size(key)))
      width = 1
      do while (width < size(key))
         do first = 1, size(key), 2*width
            middle = min(first + width - 1, size(key))
            last = min(middle + width, size(key))
            call merge_runs(key, order(first:middle), order(middle + 1:last), merged(first:last))
         end do
         order(:) = merged
         width = 2*width
      end do
   end function sorted_order

   !> Numbers in rising order, each once
   pure function each_once(list) result(numbers)
      !> The numbers
      integer, intent(in) :: list(:)
      integer, allocatable :: numbers(:)

      numbers = list(sorted_order(list))
      if (size(list) > 1) numbers = pack(numbers, [.true., numbers(2:) /= numbers(:size(list) - 1)])
   end function each_once

   !> Two runs in rising order to one
   pure subroutine merge_runs(key, left, right, merged)
      integer, intent(in) :: key(:), left(:), right(:)
      integer, intent(out) :: merged(:)

      integer :: i, l, r
      logical :: from_left

      l = 1
      r = 1
      do i = 1, size(merged)
         from_left = r > size(right)
         if (l <= size(left) .and. .not. from_left) from_left = key(left(l)) <= key(right(r))
         if (from_left) then
            merged(i) = left(l)
            l = l + 1
         else
            merged(i) = right(r)
            r = r + 1
         end if
      end do
   end subroutine merge_runs

end module plydyn_base_sort
