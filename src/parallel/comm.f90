!> The ranks of a run and their collective operations.
!>
!> A run that was not launched as several ranks is one rank, and calls nothing of MPI.
module plydyn_parallel_comm
   use, intrinsic :: iso_fortran_env, only : int64
   use mpi_f08, only : mpi_allgatherv, mpi_allreduce, mpi_barrier, mpi_bcast, mpi_character, &
      & mpi_comm_rank, mpi_comm_size, mpi_comm_world, mpi_double_precision, mpi_finalize, &
      & mpi_in_place, mpi_init_thread, mpi_integer, mpi_integer8, mpi_land, mpi_logical, mpi_max, &
      & mpi_min, mpi_recv, mpi_send, mpi_status_ignore, mpi_sum, mpi_thread_funneled
   use plydyn_base_error, only : error_type, fail
   use plydyn_base_precision, only : wp
   implicit none
   private

   public :: leave_ranks, start_ranks, stop_ranks

   !> The rank that reads the deck and writes the results
   integer, parameter :: root = 0
   !> Tag of messages to it
   integer, parameter :: root_tag = 4

   !> Numbers of a rank that MPI passes on without asking whether they may come, 4 KB with their
   !> head; up to so many parts of that length are faster than one message
   integer, parameter :: at_once = 496, most_pieces = 4

   !> The ranks of a run
   type, public :: comm_type
      !> Number of this one, from 0, and how many there are
      integer :: rank = 0, ranks = 1
      !> Whether MPI was begun
      logical, private :: is_launched = .false.
   contains
      procedure :: is_root
      procedure :: sum => sum_integers
      procedure :: max => max_reals
      procedure :: keep_largest
      procedure :: all_true
      procedure :: merge => merge_reals
      procedure :: allgather => allgather_reals
      !> Send a value of the root to all ranks, or the error of any rank
      generic :: broadcast => broadcast_integers, broadcast_reals, broadcast_text, broadcast_error
      procedure :: broadcast_error
      procedure :: send_to_root
      procedure, private :: broadcast_integers, broadcast_reals, broadcast_text
   end type comm_type

contains

   !> Number of ranks that the launcher set in the environment (Open MPI, PMI, Slurm); 1 without one
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

   !> Initialise MPI if there are several ranks
   subroutine start_ranks(comm)
      type(comm_type), intent(out) :: comm
      integer :: level

      comm%is_launched = launched_ranks() > 1
      if (.not. comm%is_launched) return
      call mpi_init_thread(mpi_thread_funneled, level)
      call mpi_comm_rank(mpi_comm_world, comm%rank)
      call mpi_comm_size(mpi_comm_world, comm%ranks)
   end subroutine start_ranks

   !> Finalise MPI, once all ranks have come here
   subroutine stop_ranks(comm)
      type(comm_type), intent(in) :: comm

      if (.not. comm%is_launched) return
      call mpi_barrier(mpi_comm_world)
      call mpi_finalize()
   end subroutine stop_ranks

   !> Wait for the other ranks before the program ends with files that could not be written: MPI is
   !> not ended, as HDF5 would try to write them again then, and wait for ever
   subroutine leave_ranks(comm)
      type(comm_type), intent(in) :: comm

      if (comm%is_launched) call mpi_barrier(mpi_comm_world)
   end subroutine leave_ranks

   !> Whether this rank reads the deck and writes the results
   pure logical function is_root(self)
      class(comm_type), intent(in) :: self

      is_root = self%rank == root
   end function is_root

   !> Sum integers over all ranks
   subroutine sum_integers(self, values)
      class(comm_type), intent(in) :: self
      !> This rank's numbers in, the sums out
      integer(int64), intent(inout), contiguous :: values(:, :)

      if (self%ranks == 1) return
      call mpi_allreduce(mpi_in_place, values, size(values), mpi_integer8, mpi_sum, &
         & mpi_comm_world)
   end subroutine sum_integers

   !> Whether a condition holds on all ranks
   subroutine all_true(self, good)
      class(comm_type), intent(in) :: self
      !> The condition on this rank in, on all ranks out
      logical, intent(inout) :: good

      if (self%ranks == 1) return
      call mpi_allreduce(mpi_in_place, good, 1, mpi_logical, mpi_land, mpi_comm_world)
   end subroutine all_true

   !> Merge numbers each of which is known to one rank, to the last bit
   subroutine merge_reals(self, numbers, is_known, values)
      class(comm_type), intent(in) :: self
      !> How many numbers there are, in arrays of any rank
      integer, intent(in) :: numbers
      !> Which of them this rank has
      logical, intent(in) :: is_known(numbers)
      !> These numbers in, all that any rank has out; 0 where none does
      real(wp), intent(inout) :: values(numbers)

      integer(int64) :: bits(numbers, 1)

      bits(:, 1) = transfer(values, bits)
      where (.not. is_known) bits(:, 1) = 0_int64
      call self%sum(bits)
      values(:) = transfer(bits(:, 1), values)
   end subroutine merge_reals

   !> Gather the parts of all ranks on all ranks
   subroutine allgather_reals(self, part, counts, whole)
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
   end subroutine allgather_reals

   !> Maximum of each number over all ranks
   subroutine max_reals(self, values)
      class(comm_type), intent(in) :: self
      !> This rank's numbers in, the maxima out
      real(wp), intent(inout), contiguous :: values(:)

      if (self%ranks == 1) return
      call mpi_allreduce(mpi_in_place, values, size(values), mpi_double_precision, mpi_max, &
         & mpi_comm_world)
   end subroutine max_reals

   !> The largest value of all ranks; of several alike that with the least number
   subroutine keep_largest(self, value, number, place)
      class(comm_type), intent(in) :: self
      !> This rank's value in, the largest out
      real(wp), intent(inout) :: value
      !> What has that value; of the largest out
      integer, intent(inout) :: number
      !> Where it is found there, not negative; of the largest out
      integer, intent(inout) :: place(2)

      real(wp) :: largest(1), least(1), found(2)

      if (self%ranks == 1) return
      largest(1) = value
      call self%max(largest)
      ! the least is the greatest below zero
      least(1) = -huge(1.0_wp)
      if (value >= largest(1)) least(1) = -real(number, wp)
      call self%max(least)
      found(:) = 0.0_wp
      if (value >= largest(1) .and. number == nint(-least(1))) found(:) = place
      call self%max(found)
      value = largest(1)
      number = nint(-least(1))
      place(:) = nint(found)
   end subroutine keep_largest

   !> Broadcast integers of the root
   subroutine broadcast_integers(self, values)
      class(comm_type), intent(in) :: self
      !> The root's numbers in, the same on all ranks out
      integer, intent(inout), contiguous :: values(:)

      if (self%ranks == 1) return
      call mpi_bcast(values, size(values), mpi_integer, root, mpi_comm_world)
   end subroutine broadcast_integers

   !> Broadcast reals of the root
   subroutine broadcast_reals(self, values)
      class(comm_type), intent(in) :: self
      !> The root's numbers in, the same on all ranks out
      real(wp), intent(inout), contiguous :: values(:)

      if (self%ranks == 1) return
      call mpi_bcast(values, size(values), mpi_double_precision, root, mpi_comm_world)
   end subroutine broadcast_reals

   !> Broadcast a text of the root
   subroutine broadcast_text(self, words)
      class(comm_type), intent(in) :: self
      !> The root's words in, the same on all ranks out
      character(:), allocatable, intent(inout) :: words

      integer :: length(1)

      if (self%ranks == 1) return
      if (self%is_root()) length(1) = len(words)
      call self%broadcast(length)
      if (.not. self%is_root()) words = repeat(" ", length(1))
      call mpi_bcast(words, length(1), mpi_character, root, mpi_comm_world)
   end subroutine broadcast_text

   !> Broadcast the error of the first rank that has one, if any does
   subroutine broadcast_error(self, error)
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
   end subroutine broadcast_error

   !> Send reals of one rank to the root; only these two ranks need to call it
   subroutine send_to_root(self, source, values)
      class(comm_type), intent(in) :: self
      !> The rank that has them
      integer, intent(in) :: source
      !> Its reals in, the same on the root out
      real(wp), intent(inout), contiguous :: values(:)

      if (source == root) return
      if (self%rank == source) then
         call mpi_send(values, size(values), mpi_double_precision, root, root_tag, mpi_comm_world)
      else if (self%is_root()) then
         call mpi_recv(values, size(values), mpi_double_precision, source, root_tag, &
            & mpi_comm_world, mpi_status_ignore)
      end if
   end subroutine send_to_root

end module plydyn_parallel_comm
