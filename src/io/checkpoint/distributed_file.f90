!> A file to which every rank brings numbers by itself, at places that it is told: no rank waits for
!> another in it, whatever happens to the disk of either.
module plydyn_io_checkpoint_distributed_file
   use, intrinsic :: iso_c_binding, only : c_f_pointer
   use, intrinsic :: iso_fortran_env, only : int64, int8, real32
   use mpi_f08, only : mpi_byte, mpi_comm_self, mpi_file, mpi_file_close, mpi_file_null, &
      & mpi_file_open, mpi_file_sync, mpi_file_write_at, mpi_get_count, mpi_info_null, &
      & mpi_mode_wronly, mpi_offset_kind, mpi_status, mpi_success
   use plydyn_base_precision, only : wp
   use plydyn_io_hdf5_numbers, only : is_long, is_real, numbers_type, dataset_layout_type, &
      & hyperslab_type
   implicit none
   private

   !> Most numbers that are written at once
   integer(int64), parameter :: numbers_per_call = 2_int64**18

   !> Bits of a byte
   integer, parameter :: bits = 8

   !> A file that is there
   type, public :: distributed_file_type
      private
      !> Its handle, of this rank alone
      type(mpi_file) :: file = mpi_file_null
      !> True between `open` and `close`
      logical :: is_open = .false.
   contains
      procedure :: open => open_file
      procedure :: write => write_rows
      procedure :: secure
      procedure :: close => close_file
   end type distributed_file_type

contains

   !> Open a file
   subroutine open_file(self, path, good)
      class(distributed_file_type), intent(inout) :: self
      !> Path of the file
      character(*), intent(in) :: path
      !> True when all went well
      logical, intent(out) :: good

      integer :: status

      call mpi_file_open(mpi_comm_self, path, mpi_mode_wronly, mpi_info_null, self%file, status)
      good = status == mpi_success
      self%is_open = good
   end subroutine open_file

   !> Bring the rows of this rank to their places
   subroutine write_rows(self, numbers, slab, room, good)
      class(distributed_file_type), intent(in) :: self
      !> What to write: whole rows, those of one level after those of the other
      type(numbers_type), intent(in) :: numbers
      !> Which rows these are of all that are written now
      type(hyperslab_type), intent(in) :: slab
      !> Where all of them lie
      type(dataset_layout_type), intent(in) :: room
      !> True when all went well
      logical, intent(out) :: good

      integer(int64) :: done, level, row, rows, width

      good = .true.
      width = product(numbers%extent(:size(numbers%extent) - 1))
      do level = 0, slab%levels - 1
         done = 0
         do while (good .and. done < slab%count)
            row = slab%whole*level + slab%first + done
            rows = min(slab%count - done, room%left(row), max(1_int64, numbers_per_call/width))
            call write_bytes(self, room%place(row), &
               & stored(numbers, room%row_bytes/width, width*(slab%count*level + done), &
               & width*rows), good)
            done = done + rows
         end do
      end do
   end subroutine write_rows

   !> Write some bytes; what the disk has no room for is not always told as an error
   subroutine write_bytes(self, place, bytes, good)
      class(distributed_file_type), intent(in) :: self
      !> Bytes of the file before them
      integer(int64), intent(in) :: place
      integer(int8), intent(in) :: bytes(:)
      logical, intent(out) :: good

      type(mpi_status) :: told
      integer :: status, written

      written = 0
      call mpi_file_write_at(self%file, int(place, mpi_offset_kind), bytes, size(bytes), mpi_byte, &
         & told, status)
      if (status == mpi_success) call mpi_get_count(told, mpi_byte, written)
      good = written == size(bytes)
   end subroutine write_bytes

   !> Numbers as the file has them, on a machine that puts low bytes first
   function stored(numbers, each, before, count) result(bytes)
      type(numbers_type), intent(in) :: numbers
      !> Bytes of a number in the file
      integer(int64), intent(in) :: each
      !> Numbers in memory before those that are wanted, and how many are
      integer(int64), intent(in) :: before, count
      integer(int8), allocatable :: bytes(:)

      integer(int64), pointer :: longs(:)
      integer, pointer :: integers(:)
      real(wp), pointer :: reals(:)

      select case (numbers%number)
      case (is_real)
         call c_f_pointer(numbers%address, reals, [before + count])
         if (each < storage_size(0.0_wp)/bits) then
            bytes = transfer(real(reals(before + 1:), real32), [0_int8])
         else
            bytes = transfer(reals(before + 1:), [0_int8])
         end if
      case (is_long)
         call c_f_pointer(numbers%address, longs, [before + count])
         bytes = transfer(longs(before + 1:), [0_int8])
      case default
         call c_f_pointer(numbers%address, integers, [before + count])
         bytes = stored_integers(integers(before + 1:), each)
      end select
   end function stored

   !> The same of integers
   pure function stored_integers(values, each) result(bytes)
      integer, intent(in) :: values(:)
      integer(int64), intent(in) :: each
      integer(int8), allocatable :: bytes(:)

      if (each > storage_size(values)/bits) then
         bytes = transfer(int(values, int64), [0_int8])
         return
      end if
      bytes = transfer(values, [0_int8])
      ! the lowest of each
      if (each == 1) bytes = bytes(1::storage_size(values)/bits)
   end function stored_integers

   !> Wait until all that this rank has written is on the disk
   subroutine secure(self, good)
      class(distributed_file_type), intent(in) :: self
      !> True when all went well
      logical, intent(out) :: good

      integer :: status

      call mpi_file_sync(self%file, status)
      good = status == mpi_success
   end subroutine secure

   !> Close the file, if it is open
   subroutine close_file(self, good)
      class(distributed_file_type), intent(inout) :: self
      !> True when all went well
      logical, intent(out) :: good

      integer :: status

      good = .true.
      if (.not. self%is_open) return
      self%is_open = .false.
      call mpi_file_close(self%file, status)
      good = status == mpi_success
   end subroutine close_file

end module plydyn_io_checkpoint_distributed_file
