!> States of an earlier run, copied from its file of fields into a new one.
!>
!> A file whose run was killed can be read but should not be written again: what was not flushed
!> is half there. So a restart copies the states that it goes on from.
module plydyn_io_vtkhdf_copy
   use, intrinsic :: iso_fortran_env, only : int64
   use plydyn_base_error, only : error_type, exit_output, fail
   use plydyn_base_precision, only : wp
   use plydyn_io_hdf5_output, only : hdf5_output_type, hyperslab_type
   use plydyn_io_hdf5_input, only : hdf5_input_type
   use plydyn_io_vtkhdf_layout, only : add_state, point_data, point_data_offsets, state_times
   implicit none
   private

   public :: copy_states

   !> Longest name of a list of offsets
   integer, parameter :: longest_name = 64
   !> Bytes of a value of a field
   integer(int64), parameter :: value_bytes = 4

contains

   !> Copy the first states of a file
   subroutine copy_states(path, states, points, names, components, still, file, error)
      !> Path of the file that has them
      character(*), intent(in) :: path
      !> How many
      integer, intent(in) :: states
      !> Points of each that this rank copies
      type(hyperslab_type), intent(in) :: points
      !> Names of the fields on points, and their values per point
      character(*), intent(in) :: names(:)
      integer, intent(in) :: components(:)
      !> Lists of the fields that are written once
      character(*), intent(in) :: still(:)
      !> The new file, with all that comes before the first state
      type(hdf5_output_type), intent(inout) :: file
      !> Why they could not be copied
      type(error_type), allocatable, intent(out) :: error

      type(hdf5_input_type) :: old
      logical :: good
      integer :: found, s

      call old%open(path, good)
      if (good) call old%read_number("VTKHDF/Steps", "NSteps", found, good)
      if (good) good = found >= states
      call file%agree(good)
      if (.not. good) then
         call old%close()
         call fail(error, exit_output, "cannot go on with "//path//": it must be there with all " &
            & //"the states that it had when the restart file was written")
         return
      end if
      do s = 1, states
         associate (first => (s - 1_int64)*points%whole*points%levels)
            call file%reserve_rows(value_bytes*points%whole*points%levels*sum(components), s - 1, &
               & error)
            if (allocated(error)) exit
            call copy_state(old, path, first, points, names, components, file, error)
            if (allocated(error)) exit
            call count_state(old, path, s, first, names, still, file, error)
         end associate
         if (allocated(error)) exit
      end do
      call old%close()
   end subroutine copy_states

   !> Copy the fields of a state
   subroutine copy_state(old, path, first, points, names, components, file, error)
      type(hdf5_input_type), intent(in) :: old
      character(*), intent(in) :: path
      !> Rows before those of the state
      integer(int64), intent(in) :: first
      type(hyperslab_type), intent(in) :: points
      character(*), intent(in) :: names(:)
      integer, intent(in) :: components(:)
      type(hdf5_output_type), intent(inout) :: file
      type(error_type), allocatable, intent(out) :: error

      real(wp), allocatable :: values(:, :)
      logical :: good
      integer :: i

      do i = 1, size(names)
         allocate (values(components(i), points%count*points%levels))
         call old%read_slab(point_data//trim(names(i)), first, points, values, good)
         call file%agree(good)
         if (.not. good) then
            call fail(error, exit_output, "cannot go on with "//path//": its field " &
               & //trim(names(i))//" is not that of this deck, or damaged")
         else if (components(i) == 1) then
            call file%append(point_data//trim(names(i)), values(1, :), error, points)
         else
            call file%append(point_data//trim(names(i)), values, error, points)
         end if
         deallocate (values)
         if (allocated(error)) return
      end do
   end subroutine copy_state

   !> Give the copied state its time, and count it
   subroutine count_state(old, path, state, first, names, still, file, error)
      type(hdf5_input_type), intent(in) :: old
      character(*), intent(in) :: path
      !> Number of the state, and rows before those of it
      integer, intent(in) :: state
      integer(int64), intent(in) :: first
      character(*), intent(in) :: names(:), still(:)
      type(hdf5_output_type), intent(inout) :: file
      type(error_type), allocatable, intent(out) :: error

      character(longest_name) :: moving(size(names))
      real(wp) :: time(1, 1)
      logical :: good
      integer :: i

      call old%read_slab(state_times, state - 1_int64, hyperslab_type(whole=1, count=1), time, good)
      call file%agree(good)
      if (.not. good) then
         call fail(error, exit_output, "cannot go on with "//path//": a state has no time")
         return
      end if
      do i = 1, size(names)
         moving(i) = point_data_offsets//names(i)
      end do
      call add_state(file, state, time(1, 1), moving, first, still, error)
   end subroutine count_state

end module plydyn_io_vtkhdf_copy
