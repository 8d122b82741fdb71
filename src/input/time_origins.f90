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
      !> First line of each, the time of the run from which its times count, and that from which
      !> the run follows it
      integer, allocatable :: line(:)
      real(wp), allocatable :: time(:), start(:)
   contains
      procedure :: of_line
      procedure :: start_of_line
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

      allocate (self%line(0), self%time(0), self%start(0))
      is_stage(:) = .false.
      do i = 1, size(deck%keywords)
         if (deck%keywords(i)%name /= "CONTROL_STAGE") cycle
         root = deck%source%root(deck%keywords(i)%line)
         is_stage(root) = deck%keywords(i)%whole("TIME") == 1
      end do
      do line = 1, deck%source%line_count
         root = deck%source%root(line)
         if (root == size(self%line)) cycle
         self%line = [self%line, line]
         self%time = [self%time, merge(starts(root), 0.0_wp, is_stage(root))]
         self%start = [self%start, starts(root)]
      end do
   end function new_time_origins

   !> Time of the run from which the times of a deck count
   pure real(wp) function of_line(self, line) result(time)
      class(time_origins_type), intent(in) :: self
      !> A line of the deck
      integer, intent(in) :: line

      time = 0.0_wp
      if (allocated(self%line)) time = sum(self%time(last_before(self, line)))
   end function of_line

   !> Time from which the run follows a deck
   pure real(wp) function start_of_line(self, line) result(time)
      class(time_origins_type), intent(in) :: self
      !> A line of the deck
      integer, intent(in) :: line

      time = 0.0_wp
      if (allocated(self%line)) time = sum(self%start(last_before(self, line)))
   end function start_of_line

   !> The deck of a line; none where there is none
   pure function last_before(self, line) result(deck)
      type(time_origins_type), intent(in) :: self
      !> A line
      integer, intent(in) :: line
      integer, allocatable :: deck(:)

      integer :: i

      i = count(self%line <= line)
      allocate (deck(merge(1, 0, i > 0)))
      deck(:) = i
   end function last_before

end module plydyn_input_time_origins
