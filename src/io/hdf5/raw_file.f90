!> Calls of HDF5 that make and end files, on the one rank that has them open.
module plydyn_io_hdf5_raw_file
   use hdf5, only : h5dont_atexit_f, h5eset_auto_f, h5f_acc_trunc_f, h5f_close_strong_f, &
      & h5f_scope_global_f, h5fclose_f, h5fcreate_f, h5fflush_f, h5open_f, h5p_file_access_f, &
      & h5p_file_create_f, h5pclose_f, h5pcreate_f, h5pset_fclose_degree_f, &
      & h5pset_file_locking_f, h5pset_istore_k_f, hid_t
   implicit none
   private

   public :: close_file, create_file, flush_file

   !> Half the entries in a node of the index of chunks: a dataset of up to twice as many chunks
   !> has one node, which a kill in the midst of a flush cannot leave half split
   integer, parameter, public :: half_index = 256

   !> An open file
   type, public :: handle_type
      !> Handle of the library; negative for none
      integer(hid_t) :: id = -1_hid_t
   end type handle_type

contains

   !> Create a file, in place of one that was there
   subroutine create_file(path, file, good)
      !> Path of the file
      character(*), intent(in) :: path
      !> Its handle
      type(handle_type), intent(out) :: file
      !> True when all went well
      logical, intent(out) :: good

      integer(hid_t) :: access, creation
      integer :: status(10)

      ! at the program's end the library is not to tidy up: after a failure it would crash, and
      ! whoever wants a file whole closes it; asked a second time it refuses, which is as well
      call h5dont_atexit_f(status(1))
      call h5open_f(status(1))
      call h5eset_auto_f(0, status(2))
      call h5pcreate_f(h5p_file_access_f, access, status(3))
      call h5pset_fclose_degree_f(access, h5f_close_strong_f, status(4))
      call h5pset_file_locking_f(access, .false., .true., status(5))
      call h5pcreate_f(h5p_file_create_f, creation, status(6))
      call h5pset_istore_k_f(creation, half_index, status(7))
      call h5fcreate_f(path, h5f_acc_trunc_f, file%id, status(8), creation, access)
      call h5pclose_f(creation, status(9))
      call h5pclose_f(access, status(10))
      good = all(status >= 0)
   end subroutine create_file

   !> Hand all that was written to the operating system: it outlives this process
   subroutine flush_file(file, good)
      !> The file
      type(handle_type), intent(in) :: file
      !> True when all went well
      logical, intent(out) :: good

      integer :: status

      call h5fflush_f(file%id, h5f_scope_global_f, status)
      good = status >= 0
   end subroutine flush_file

   !> Close a file and all that is open in it
   subroutine close_file(file, good)
      !> The file
      type(handle_type), intent(in) :: file
      !> True when all went well
      logical, intent(out) :: good

      integer :: status

      call h5fclose_f(file%id, status)
      good = status >= 0
   end subroutine close_file

end module plydyn_io_hdf5_raw_file
