!> Rows that others than the library bring to a dataset lie where it says, across chunks too.
program test_io_hdf5_raw_series
   use, intrinsic :: iso_fortran_env, only : int64, real32
   use plydyn_base_files, only : remove_file
   use plydyn_base_precision, only : wp
   use plydyn_io_hdf5_input, only : hdf5_input_type
   use plydyn_io_hdf5_numbers, only : dataset_layout_type, hyperslab_type, store_single
   use plydyn_io_hdf5_raw_file, only : close_file, create_file, handle_type
   use plydyn_io_hdf5_raw_series, only : add_rows, create_series
   use testing, only : begin, check, finish
   implicit none

   character(*), parameter :: path = "test_io_hdf5_raw_series.h5"
   integer, parameter :: rows = 6, rows_per_chunk = 4
   type(dataset_layout_type) :: rooms(2)
   logical :: good

   call places()
   call make_file()
   call bring_rows()
   call read_rows()
   call remove_file(path)
   call finish()

contains

   !> Runs of four rows of 24 bytes, of which the first row is the second of the first run
   subroutine places()
      type(dataset_layout_type) :: room

      call begin("place")
      room = dataset_layout_type(row_bytes=24, rows_per_run=4, before=1, start=[100_int64, &
         & 5000000000_int64])
      call check(room%place(0_int64) == 124, "the first row")
      call check(room%place(2_int64) == 172, "the last of the first run")
      call check(room%place(4_int64) == 5000000024_int64, "the second of the next")
      call check(room%left(0_int64) == 3 .and. room%left(3_int64) == 4, "rows left in a run")
   end subroutine places

   !> Room for six rows of a table and for six more
   subroutine make_file()
      type(handle_type) :: file
      type(dataset_layout_type) :: none
      integer :: k

      call begin("add_rows")
      call create_file(path, file, good)
      call create_series(file, "table", 3, rows_per_chunk, store_single, good)
      do k = 1, size(rooms)
         call add_rows(file, "table", [3, rows], rooms(k), good)
         call check(good, "makes room")
      end do
      call add_rows(file, "table", [2, rows], none, good)
      call check(.not. good, "of the width that the table has")
      call close_file(file, good)
      call check(all(rooms%row_bytes == 12), "three numbers of four bytes each")
      call check(size(rooms(1)%start) == 2 .and. size(rooms(2)%start) == 2, "in two chunks each")
      call check(rooms(2)%before == 2, "the second begins in the midst of a chunk")
   end subroutine make_file

   !> Write the rows without the library, numbered through
   subroutine bring_rows()
      integer(int64) :: r
      integer :: k, unit

      open (newunit=unit, file=path, access="stream", action="readwrite", status="old")
      do k = 1, size(rooms)
         do r = 0, rows - 1
            write (unit, pos=rooms(k)%place(r) + 1) real(3*((k - 1)*rows + r) + [1, 2, 3], real32)
         end do
      end do
      close (unit)
   end subroutine bring_rows

   !> Read them with it
   subroutine read_rows()
      type(hdf5_input_type) :: file
      real(wp) :: table(3, 2*rows)
      integer :: i

      call begin("rows that were brought")
      call file%open(path, good)
      call check(good, "leave the file whole")
      call file%read_slab("table", 0_int64, hyperslab_type(whole=2*rows, count=2*rows), table, good)
      call check(good, "can be read")
      call check(reshape(table, [6*rows]), [(real(i, wp), i=1, 6*rows)], 0.0_wp, "in their order")
      call file%close()
   end subroutine read_rows

end program test_io_hdf5_raw_series
