!> The ranks of a run, and what all of them tell each other.
!>
!> A run that nobody launched as several is one rank, and calls nothing of MPI.
module plydyn_parallel_comm
   use, intrinsic :: iso_fortran_env, only : int64
   use mpi_f08, only : mpi_allgatherv, mpi_allreduce, mpi_barrier, mpi_bcast, mpi_character, &
      & mpi_comm_rank, mpi_comm_size, mpi_comm_world, mpi_double_precision, mpi_finalize, &
      & mpi_in_place, mpi_init_thread, mpi_integer, mpi_integer8, mpi_land, mpi_logical, mpi_max, &
      & mpi_min, mpi_sum, mpi_thread_funneled
   use plydyn_base_error, only : error_type, fail
   use plydyn_base_precision, only : wp
   implicit none
   private

   public :: leave_ranks, start_ranks, stop_ranks

   !> The rank that reads the deck and writes the results
   integer, parameter :: root = 0

   !> Numbers of a rank that MPI passes on without asking whether they may come, 4 KB with their
   !> head; up to so many pieces of that length are faster than one message
   integer, parameter :: at_once = 496, most_pieces = 4

   !> The ranks of a run
   type, public :: comm_type
      !> Number of this one, from 0, and how many there are
      integer :: rank = 0, ranks = 1
      !> Whether MPI was begun
      logical, private :: is_launched = .false.
   contains
      procedure :: is_root
      procedure :: add_up
      procedure :: agree
      procedure :: unite
      procedure :: collect
      procedure :: find_greatest
      procedure :: tell_integers
      procedure :: tell_reals
      procedure :: tell_text
      procedure :: tell_error
      procedure :: share => share_error
      generic :: tell => tell_integers, tell_reals, tell_text, tell_error
   end type comm_type

contains

   !> How many ranks the program was launched as, as Open MPI, PMIx or PMI tell; 1 without any
   integer function launched_ranks() result(ranks)
      character(*), parameter :: names(3) = [character(20) :: "OMPI_COMM_WORLD_SIZE", &
         & "PMI_SIZE", "SLURM_STEP_NUM_TASKS"]
      character(20) :: value
      integer :: i, status

      do i = 1, size(names)
         call get_environment_variable(trim(names(i)), value, status=status)
         if (status /= 0) cycle
         read (value, *, iostat=status) ranks
         if (status == 0) return
      end do
      ranks = 1
   end function launched_ranks

   !> Begin to work with the other ranks, if there are any
   subroutine start_ranks(comm)
      !> The ranks
      type(comm_type), intent(out) :: comm
      integer :: level

      comm%is_launched = launched_ranks() > 1
      if (.not. comm%is_launched) return
      call mpi_init_thread(mpi_thread_funneled, level)
      call mpi_comm_rank(mpi_comm_world, comm%rank)
      call mpi_comm_size(mpi_comm_world, comm%ranks)
   end subroutine start_ranks

   !> End the work with the other ranks, once all have come here
   subroutine stop_ranks(comm)
      !> The ranks
      type(comm_type), intent(in) :: comm

      if (.not. comm%is_launched) return
      call mpi_barrier(mpi_comm_world)
      call mpi_finalize()
   end subroutine stop_ranks

   !> Wait for the other ranks before the program ends with files that could not be written: MPI is
   !> not ended, as HDF5 would try to write them again then, and wait for ever
   subroutine leave_ranks(comm)
      !> The ranks
      type(comm_type), intent(in) :: comm

      if (comm%is_launched) call mpi_barrier(mpi_comm_world)
   end subroutine leave_ranks

   !> Whether this rank reads the deck and writes the results
   pure logical function is_root(self)
      class(comm_type), intent(in) :: self

      is_root = self%rank == root
   end function is_root

   !> Add up whole numbers over all ranks
   subroutine add_up(self, values)
      class(comm_type), intent(in) :: self
      !> This rank's numbers in, the sums out
      integer(int64), intent(inout), contiguous :: values(:, :)

      if (self%ranks == 1) return
      call mpi_allreduce(mpi_in_place, values, size(values), mpi_integer8, mpi_sum, &
         & mpi_comm_world)
   end subroutine add_up

   !> Whether all went well on all ranks
   subroutine agree(self, good)
      class(comm_type), intent(in) :: self
      !> Whether it did on this rank in, the same on all ranks out
      logical, intent(inout) :: good

      if (self%ranks == 1) return
      call mpi_allreduce(mpi_in_place, good, 1, mpi_logical, mpi_land, mpi_comm_world)
   end subroutine agree

   !> Let all ranks have numbers of which each is known to one of them, to the last bit
   subroutine unite(self, is_known, values)
      class(comm_type), intent(in) :: self
      !> Which numbers this rank knows
      logical, intent(in) :: is_known(:)
      !> These numbers in, all that any rank knows out; 0 where none does
      real(wp), intent(inout) :: values(:)

      integer(int64) :: bits(size(values), 1)

      bits(:, 1) = transfer(values, bits)
      where (.not. is_known) bits(:, 1) = 0_int64
      call self%add_up(bits)
      values(:) = transfer(bits(:, 1), values)
   end subroutine unite

   !> Let all ranks have what each has a part of
   subroutine collect(self, part, counts, whole)
      class(comm_type), intent(in) :: self
      !> This rank's numbers
      real(wp), intent(in), contiguous :: part(:)
      !> How many each rank has
      integer, intent(in) :: counts(0:)
      !> Those of all ranks, one after the other
      real(wp), intent(out), contiguous :: whole(:)

      integer, dimension(0:size(counts) - 1) :: first, piece
      integer :: longest, r, sent

      if (self%ranks == 1) then
         whole(:) = part
         return
      end if
      first(0) = 0
      do r = 1, size(counts) - 1
         first(r) = first(r - 1) + counts(r - 1)
      end do
      longest = maxval(counts)
      if (longest <= most_pieces*at_once) longest = at_once
      do sent = 0, maxval(counts) - 1, longest
         piece(:) = max(0, min(counts - sent, longest))
         call mpi_allgatherv(part(sent + 1:), piece(self%rank), mpi_double_precision, whole, &
            & piece, first + sent, mpi_double_precision, mpi_comm_world)
      end do
   end subroutine collect

   !> Let all ranks have the greatest of each number
   subroutine find_greatest(self, values)
      class(comm_type), intent(in) :: self
      !> This rank's numbers in, the greatest of all ranks out
      real(wp), intent(inout), contiguous :: values(:)

      if (self%ranks == 1) return
      call mpi_allreduce(mpi_in_place, values, size(values), mpi_double_precision, mpi_max, &
         & mpi_comm_world)
   end subroutine find_greatest

   !> Let all ranks know whole numbers of the root
   subroutine tell_integers(self, values)
      class(comm_type), intent(in) :: self
      !> The root's numbers in, the same on all ranks out
      integer, intent(inout), contiguous :: values(:)

      if (self%ranks == 1) return
      call mpi_bcast(values, size(values), mpi_integer, root, mpi_comm_world)
   end subroutine tell_integers

   !> Let all ranks know reals of the root
   subroutine tell_reals(self, values)
      class(comm_type), intent(in) :: self
      !> The root's numbers in, the same on all ranks out
      real(wp), intent(inout), contiguous :: values(:)

      if (self%ranks == 1) return
      call mpi_bcast(values, size(values), mpi_double_precision, root, mpi_comm_world)
   end subroutine tell_reals

   !> Let all ranks know a text of the root
   subroutine tell_text(self, words)
      class(comm_type), intent(in) :: self
      !> The root's words in, the same on all ranks out
      character(:), allocatable, intent(inout) :: words

      integer :: length(1)

      if (self%ranks == 1) return
      if (self%is_root()) length(1) = len(words)
      call self%tell(length)
      if (.not. self%is_root()) words = repeat(" ", length(1))
      call mpi_bcast(words, length(1), mpi_character, root, mpi_comm_world)
   end subroutine tell_text

   !> Let all ranks know what went wrong on the root, if anything did
   subroutine tell_error(self, error)
      class(comm_type), intent(in) :: self
      !> The root's error in, the same on all ranks out
      type(error_type), allocatable, intent(inout) :: error

      integer :: code(2)

      if (self%ranks == 1) return
      code(:) = 0
      if (self%is_root() .and. allocated(error)) code(:) = [1, error%code]
      call self%tell(code)
      if (code(1) == 0) return
      if (.not. self%is_root()) then
         if (.not. allocated(error)) allocate (error)
         error%code = code(2)
      end if
      call self%tell(error%message)
   end subroutine tell_error

   !> Let all ranks have the same error: that of the first of them that has one, if any does
   subroutine share_error(self, error)
      class(comm_type), intent(in) :: self
      !> This rank's error in, the same on all ranks out
      type(error_type), allocatable, intent(inout) :: error

      character(:), allocatable :: words
      integer :: first, number(2)

      if (self%ranks == 1) return
      first = merge(self%rank, self%ranks, allocated(error))
      call mpi_allreduce(mpi_in_place, first, 1, mpi_integer, mpi_min, mpi_comm_world)
      if (first == self%ranks) return
      if (first == self%rank) then
         number(:) = [error%code, len(error%message)]
         words = error%message
      end if
      call mpi_bcast(number, size(number), mpi_integer, first, mpi_comm_world)
      if (first /= self%rank) words = repeat(" ", number(2))
      call mpi_bcast(words, number(2), mpi_character, first, mpi_comm_world)
      call fail(error, number(1), words)
   end subroutine share_error

end module plydyn_parallel_comm
