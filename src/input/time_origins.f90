!> Times from which the times of decks count: those of a stage count from its restart.
module plydyn_input_time_origins
   use plydyn_base_precision, only : wp
   use plydyn_deck_deck, only : deck_type
   implicit none
   private

   public :: new_time_origins

   !> Decks, one after the other
   type, public :: time_origins_type
      private
      !> First line of each, and the time of the run from which its times count
      integer, allocatable :: line(:)
      real(wp), allocatable :: time(:)
   contains
      procedure :: of_line
   end type time_origins_type

contains

   !> Times of all decks of a run
   pure function new_time_origins(deck, starts) result(self)
      !> The decks
      type(deck_type), intent(in) :: deck
      !> Time from which the run follows each of them
      real(wp), intent(in) :: starts(:)
      type(time_origins_type) :: self

      integer :: i, line, root
      logical :: is_stage(size(starts))

      allocate (self%line(0), self%time(0))
      is_stage(:) = .false.
      do i = 1, size(deck%keywords)
         if (deck%keywords(i)%name /= "CONTROL_STAGE") cycle
         root = deck%source%root(deck%keywords(i)%line)
         is_stage(root) = deck%keywords(i)%whole("TIME") == 1
      end do
      if (.not. any(is_stage)) return
      do line = 1, deck%source%line_count
         root = deck%source%root(line)
         if (root == size(self%line)) cycle
         self%line = [self%line, line]
         self%time = [self%time, merge(starts(root), 0.0_wp, is_stage(root))]
      end do
   end function new_time_origins

   !> Time of the run from which the times of a deck count
   pure real(wp) function of_line(self, line) result(time)
      class(time_origins_type), intent(in) :: self
      !> A line of the deck
      integer, intent(in) :: line

      integer :: i

      time = 0.0_wp
      if (.not. allocated(self%line)) return
      do i = 1, size(self%line)
         if (line >= self%line(i)) time = self%time(i)
      end do
   end function of_line

end module plydyn_input_time_origins
