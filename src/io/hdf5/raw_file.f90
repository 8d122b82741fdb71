!> Calls of HDF5 that make and end a file, and make its groups and attributes.
!> `plydyn_io_hdf5_raw` has those for datasets, `plydyn_io_hdf5_input` those that read. No other
!> module uses the library.
!>
!> Each procedure makes one thing in a file and says whether every call went well.
module plydyn_io_hdf5_raw_file
   use, intrinsic :: iso_c_binding, only : c_int, c_int64_t, c_loc
   use hdf5, only : h5_integer_kind, h5aclose_f, h5acreate_f, h5aexists_f, h5aopen_f, h5awrite_f, &
      & h5dont_atexit_f, h5eset_auto_f, h5f_acc_trunc_f, h5f_close_strong_f, h5f_libver_latest_f, &
      & h5f_scope_global_f, h5fclose_f, h5fcreate_f, h5fflush_f, h5gclose_f, h5gcreate_f, &
      & h5kind_to_type, h5oclose_f, h5oopen_f, h5open_f, h5p_file_access_f, h5p_file_create_f, &
      & h5p_group_create_f, h5pclose_f, h5pcreate_f, h5pset_fclose_degree_f, &
      & h5pset_file_locking_f, h5pset_istore_k_f, h5pset_obj_track_times_f, h5s_scalar_f, &
      & h5sclose_f, h5screate_f, h5screate_simple_f, h5t_native_character, h5t_std_i64le, &
      & h5t_str_nullpad_f, h5tclose_f, h5tcopy_f, h5tset_size_f, h5tset_strpad_f, hid_t, hsize_t, &
      & size_t
   implicit none
   private

   public :: close_file, create_file, create_group, flush_file, prepare_access, write_attribute, &
      & write_text_attribute

   !> Half the entries in a node of the index of chunks: a dataset of up to twice as many chunks
   !> has one node, which a kill in the midst of a flush cannot leave half split
   integer, parameter :: half_index = 256

   !> An open file, or an open dataset
   type, public :: handle_type
      !> Handle of the library; negative for none
      integer(hid_t) :: id = -1_hid_t
   end type handle_type

   interface
      !> Formats of what is made from now on, which HDF5 1.10 sets of an open file in C only
      integer(c_int) function c_set_format(file, lowest, highest) &
         & bind(c, name="H5Fset_libver_bounds")
         import :: c_int, c_int64_t
         implicit none
         integer(c_int64_t), value :: file
         integer(c_int), value :: lowest, highest
      end function c_set_format
   end interface

contains

   !> Start the library, and prepare the opening of a file
   subroutine prepare_access(access, good)
      !> Handle of the access
      integer(hid_t), intent(out) :: access
      !> True when all went well
      logical, intent(out) :: good

      integer :: status(6)

      ! at its end the program must not flush files whose disk has failed: HDF5 would crash; this is
      ! refused when it is asked for again, which does not matter
      call h5dont_atexit_f(status(1))
      call h5open_f(status(2))
      call h5eset_auto_f(0, status(3))
      call h5pcreate_f(h5p_file_access_f, access, status(4))
      call h5pset_fclose_degree_f(access, h5f_close_strong_f, status(5))
      ! a running job can be looked at
      call h5pset_file_locking_f(access, .false., .true., status(6))
      good = all(status(2:) >= 0)
   end subroutine prepare_access

   !> Create a file, in place of one that was there
   subroutine create_file(path, is_checked, file, good)
      !> Path of the file
      character(*), intent(in) :: path
      !> Whether metadata have check sums: the latest format; else the earliest, in which a file
      !> opens again with all that was flushed before a kill
      logical, intent(in) :: is_checked
      !> Its handle
      type(handle_type), intent(out) :: file
      !> True when all went well
      logical, intent(out) :: good

      integer(hid_t) :: access, creation
      integer :: status(6)

      call prepare_access(access, good)
      call h5pcreate_f(h5p_file_create_f, creation, status(1))
      call h5pset_istore_k_f(creation, half_index, status(2))
      call h5fcreate_f(path, h5f_acc_trunc_f, file%id, status(3), creation, access)
      call h5pclose_f(creation, status(4))
      call h5pclose_f(access, status(5))
      status(6) = 0
      ! not from the start: HDF5 1.10 would put the time of day into the top group
      if (is_checked) status(6) = c_set_format(file%id, h5f_libver_latest_f, h5f_libver_latest_f)
      good = good .and. all(status >= 0)
   end subroutine create_file

   !> Write all that the library holds back: it outlives a kill of this process
   subroutine flush_file(file, good)
      type(handle_type), intent(in) :: file
      !> True when all went well
      logical, intent(out) :: good

      integer :: status

      call h5fflush_f(file%id, h5f_scope_global_f, status)
      good = status >= 0
   end subroutine flush_file

   !> Close a file and all that is open in it
   subroutine close_file(file, good)
      type(handle_type), intent(in) :: file
      !> True when all went well
      logical, intent(out) :: good

      integer :: status

      call h5fclose_f(file%id, status)
      good = status >= 0
   end subroutine close_file

   !> Create a group
   subroutine create_group(file, name, good)
      type(handle_type), intent(in) :: file
      !> Path of the group in the file
      character(*), intent(in) :: name
      !> True when all went well
      logical, intent(out) :: good

      integer(hid_t) :: creation, group
      integer :: status(5)

      call h5pcreate_f(h5p_group_create_f, creation, status(1))
      call h5pset_obj_track_times_f(creation, .false., status(2))
      call h5gcreate_f(file%id, name, group, status(3), gcpl_id=creation)
      call h5gclose_f(group, status(4))
      call h5pclose_f(creation, status(5))
      good = all(status >= 0)
   end subroutine create_group

   !> Write an attribute of text, of exactly its length
   subroutine write_text_attribute(file, place, name, value, good)
      type(handle_type), intent(in) :: file
      !> Path of the group or dataset that gets the attribute, and name of the attribute
      character(*), intent(in) :: place, name
      !> Its value, of at least one character
      character(*), intent(in), target :: value
      !> True when all went well
      logical, intent(out) :: good

      integer(hid_t) :: string, space, object, attribute
      integer :: status(11)

      call h5tcopy_f(h5t_native_character, string, status(1))
      call h5tset_size_f(string, int(len(value), size_t), status(2))
      call h5tset_strpad_f(string, h5t_str_nullpad_f, status(3))
      call h5screate_f(h5s_scalar_f, space, status(4))
      call h5oopen_f(file%id, place, object, status(5))
      call h5acreate_f(object, name, string, space, attribute, status(6))
      call h5awrite_f(attribute, string, c_loc(value), status(7))
      call h5aclose_f(attribute, status(8))
      call h5oclose_f(object, status(9))
      call h5sclose_f(space, status(10))
      call h5tclose_f(string, status(11))
      good = all(status >= 0)
   end subroutine write_text_attribute

   !> Write an attribute of long integers: in place when it is there, else create it
   subroutine write_attribute(file, place, name, values, good)
      type(handle_type), intent(in) :: file
      !> Path of the group or dataset that gets the attribute, and name of the attribute
      character(*), intent(in) :: place, name
      !> Its values; one of them is a number, not a list
      integer, intent(in), target, contiguous :: values(:)
      !> True when all went well
      logical, intent(out) :: good

      integer(hid_t) :: object, attribute, space
      integer :: status(8)
      logical :: exists

      status(:) = 0
      call h5oopen_f(file%id, place, object, status(1))
      call h5aexists_f(object, name, exists, status(2))
      if (exists) then
         call h5aopen_f(object, name, attribute, status(3))
      else
         if (size(values) == 1) then
            call h5screate_f(h5s_scalar_f, space, status(3))
         else
            call h5screate_simple_f(1, shape(values, hsize_t), space, status(3))
         end if
         call h5acreate_f(object, name, h5t_std_i64le, space, attribute, status(4))
         call h5sclose_f(space, status(5))
      end if
      call h5awrite_f(attribute, h5kind_to_type(kind(0), h5_integer_kind), c_loc(values), status(6))
      call h5aclose_f(attribute, status(7))
      call h5oclose_f(object, status(8))
      good = all(status >= 0)
   end subroutine write_attribute

end module plydyn_io_hdf5_raw_file
