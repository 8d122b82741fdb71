!> Fields: an observer that writes states of the whole model to VTKHDF files.
module plydyn_io_vtkhdf_field_output
   use, intrinsic :: iso_fortran_env, only : int64, real32
   use plydyn_base_error, only : error_type, exit_run
   use plydyn_base_precision, only : wp
   use plydyn_io_job, only : job_type, output_type
   use plydyn_io_vtkhdf_crack_fields, only : crack_fields_type
   use plydyn_io_vtkhdf_element_fields, only : element_fields_type
   use plydyn_io_vtkhdf_field_file, only : field_file_type
   use plydyn_io_vtkhdf_interface_fields, only : interface_fields_type
   use plydyn_method_clock, only : every_interval
   use plydyn_method_observer, only : requests_type
   use plydyn_method_simulation, only : simulation_type
   use plydyn_state_file_positions, only : file_positions_type
   implicit none
   private

   !> One file of a list
   type :: file_item_type
      class(field_file_type), allocatable :: item
   end type file_item_type

   !> The files; each rank writes its part of them
   type, public, extends(output_type) :: field_output_type
      private
      !> Elements, interfaces, cracks
      type(file_item_type), allocatable :: files(:)
      !> Time of the last state in the files
      real(wp) :: time = -1.0_wp
      !> Name of the position that holds the instants
      character(:), allocatable :: instants
   contains
      procedure :: open => open_files
      procedure :: begin
      procedure :: notify
      procedure :: mark
      procedure :: close => close_files
   end type field_output_type

   !> Endings of the files, and of the position that holds their instants
   character(*), parameter :: endings(3) = [character(18) :: ".vtkhdf", ".interfaces.vtkhdf", &
      & ".cracks.vtkhdf"], instants_ending = ".vtkhdf instants"

contains

   !> Create all files, or go on with those of an earlier run
   subroutine open_files(self, job, simulation, error)
      class(field_output_type), intent(inout) :: self
      type(job_type), intent(in) :: job
      class(simulation_type), intent(in) :: simulation
      type(error_type), allocatable, intent(out) :: error

      integer :: i

      self%instants = job%path//instants_ending
      self%clocks = [every_interval(simulation%model%request%field_interval)]
      call self%clocks%resume(job%places%at(self%instants))
      allocate (self%files(size(endings)))
      allocate (element_fields_type :: self%files(1)%item)
      allocate (interface_fields_type :: self%files(2)%item)
      allocate (crack_fields_type :: self%files(3)%item)
      do i = 1, size(self%files)
         call self%files(i)%item%open(trim(endings(i)), job, simulation, error)
         if (allocated(error)) return
      end do
   end subroutine open_files

   !> Add the state to the files, if it is due
   subroutine begin(self, simulation, error)
      class(field_output_type), intent(inout) :: self
      class(simulation_type), intent(in) :: simulation
      type(error_type), allocatable, intent(out) :: error

      if (self%is_due(simulation%state)) call write_state(self, simulation, error)
   end subroutine begin

   !> Add the state to the files, if it is due or requested
   subroutine notify(self, simulation, requests, error)
      class(field_output_type), intent(inout) :: self
      class(simulation_type), intent(in) :: simulation
      type(requests_type), intent(inout) :: requests
      type(error_type), allocatable, intent(out) :: error

      call self%begin(simulation, error)
      if (allocated(error)) return
      if (requests%fields .and. simulation%state%time > self%time) then
         call write_state(self, simulation, error)
      end if
   end subroutine notify

   !> Add the state to the files, unless its numbers are too large for them
   subroutine write_state(self, simulation, error)
      type(field_output_type), intent(inout) :: self
      class(simulation_type), intent(in) :: simulation
      type(error_type), allocatable, intent(out) :: error

      integer :: i

      if (.not. can_be_written(simulation)) return
      self%time = simulation%state%time
      do i = 1, size(self%files)
         call self%files(i)%item%write(simulation%domain, simulation%state, error)
         if (allocated(error)) return
      end do
   end subroutine write_state

   !> Whether a motion can be written in single precision, the stresses of its strains too, which
   !> grow with the square of the displacement; the same on all ranks
   logical function can_be_written(simulation)
      class(simulation_type), intent(in) :: simulation

      real(wp), parameter :: largest = huge(1.0_real32)
      integer :: n

      associate (state => simulation%state)
         n = simulation%domain%columns%freedoms
         ! numbers that are not finite are not below the bounds either
         can_be_written = all(abs(state%displacement(:n)) < largest**(1.0_wp/3.0_wp)) &
            & .and. all(abs(state%velocity(:n)) < largest) &
            & .and. all(abs(state%acceleration(:n)) < largest)
      end associate
      call simulation%domain%comm%all_true(can_be_written)
   end function can_be_written

   !> Flush all files to the disk, and add how far each of them has been written
   subroutine mark(self, positions, error)
      class(field_output_type), intent(inout) :: self
      type(file_positions_type), intent(inout) :: positions
      type(error_type), allocatable, intent(out) :: error

      integer :: i

      call positions%add(self%instants, self%clocks(1)%mark(0_int64))
      do i = 1, size(self%files)
         call self%files(i)%item%file%mark(positions, error)
         if (allocated(error)) return
      end do
   end subroutine mark

   !> Close all files. A run that the method ended leaves its last state in them, if this can be
   !> written: the reason for the end is more important than a failure here
   subroutine close_files(self, simulation, outcome, error)
      class(field_output_type), intent(inout) :: self
      class(simulation_type), intent(in) :: simulation
      type(error_type), allocatable, intent(in) :: outcome
      type(error_type), allocatable, intent(out) :: error

      type(error_type), allocatable :: each
      integer :: i

      if (allocated(outcome)) then
         if (outcome%code == exit_run .and. simulation%state%time > self%time) then
            call write_state(self, simulation, each)
         end if
      end if
      do i = 1, size(self%files)
         call self%files(i)%item%file%close(each)
         if (.not. allocated(error)) call move_alloc(each, error)
      end do
   end subroutine close_files

end module plydyn_io_vtkhdf_field_output
