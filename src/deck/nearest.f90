!> Spelling suggestions by edit distance (Damerau, 1964).
module plydyn_deck_nearest
   implicit none
   private

   public :: nearest_word, edit_distance

contains

   !> Index of the closest word in a list; 0 when none is close
   pure integer function nearest_word(word, known) result(best)
      !> Misspelt word, and words to choose from
      character(*), intent(in) :: word, known(:)

      integer :: distance, i, least

      best = 0
      least = max(1, len_trim(word)/3) + 1
      do i = 1, size(known)
         if (abs(len_trim(known(i)) - len_trim(word)) >= least) cycle
         distance = edit_distance(trim(word), trim(known(i)))
         if (distance >= least) cycle
         least = distance
         best = i
      end do
   end function nearest_word

   !> Number of insertions, deletions, substitutions and transpositions between two words
   pure integer function edit_distance(from, to) result(distance)
      !> One word, and the other
      character(*), intent(in) :: from, to

      integer :: cost(-1:len(from), -1:len(to)), i, j
      logical :: same, swapped

      cost(:, -1) = len(from) + len(to)
      cost(-1, :) = len(from) + len(to)
      cost(0:, 0) = [(i, i=0, len(from))]
      cost(0, 0:) = [(j, j=0, len(to))]
      do j = 1, len(to)
         do i = 1, len(from)
            same = from(i:i) == to(j:j)
            swapped = i > 1 .and. j > 1
            if (swapped) swapped = from(i - 1:i) == to(j:j)//to(j - 1:j - 1)
            cost(i, j) = min(cost(i - 1, j) + 1, cost(i, j - 1) + 1, &
               & cost(i - 1, j - 1) + merge(0, 1, same))
            if (swapped) cost(i, j) = min(cost(i, j), cost(i - 2, j - 2) + 1)
         end do
      end do
      distance = cost(len(from), len(to))
   end function edit_distance

end module plydyn_deck_nearest
