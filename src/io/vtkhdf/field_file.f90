!> A file of field states, of whatever grid: what does not change, then state by state.
module plydyn_io_vtkhdf_field_file
   use plydyn_base_error, only : error_type
   use plydyn_domain_domain, only : domain_type
   use plydyn_model_model, only : model_type
   use plydyn_io_vtkhdf_description, only : describe_file
   use plydyn_state_file_positions, only : file_positions_type
   use plydyn_io_vtkhdf_vtkhdf, only : vtkhdf_type
   use plydyn_state_state, only : state_type
   implicit none
   private

   !> A file of fields; an extension has its grid and its values
   type, public, abstract :: field_file_type
      !> The file; not open where the domain has nothing to show in it
      type(vtkhdf_type) :: file
      !> Names of the fields on the points, and values per point of each
      character(16), allocatable :: names(:)
      integer, allocatable :: components(:)
   contains
      procedure :: open => open_file
      procedure(create_grid), deferred :: create_grid
      procedure(add_cell_fields), deferred :: add_cell_fields
      procedure(write_state), deferred :: write
      procedure :: mark => mark_file
      procedure :: close => close_file
   end type field_file_type

   abstract interface
      !> Create the file with its grid and name the fields, if the domain has something to show
      subroutine create_grid(self, path, model, domain, error)
         import :: domain_type, error_type, field_file_type, model_type
         implicit none
         class(field_file_type), intent(inout) :: self
         !> Path of the file
         character(*), intent(in) :: path
         type(model_type), intent(in) :: model
         type(domain_type), intent(in) :: domain
         !> Why it could not be created
         type(error_type), allocatable, intent(out) :: error
      end subroutine create_grid

      !> Write what does not change from state to state
      subroutine add_cell_fields(self, model, domain)
         import :: domain_type, field_file_type, model_type
         implicit none
         class(field_file_type), intent(inout) :: self
         type(model_type), intent(in) :: model
         type(domain_type), intent(in) :: domain
      end subroutine add_cell_fields

      !> Write the present state, if the file is open; it is whole in the file when this returns
      subroutine write_state(self, domain, state, error)
         import :: domain_type, error_type, field_file_type, state_type
         implicit none
         class(field_file_type), intent(inout) :: self
         type(domain_type), intent(in) :: domain
         type(state_type), intent(in) :: state
         !> Why it could not be written
         type(error_type), allocatable, intent(out) :: error
      end subroutine write_state
   end interface

contains

   !> Create the file, if the domain has something to show: grid, plies, units, fields
   subroutine open_file(self, path, deck, version, model, domain, places, error)
      class(field_file_type), intent(inout) :: self
      !> Path of the file
      character(*), intent(in) :: path
      !> Path of the deck, version of the program
      character(*), intent(in) :: deck, version
      type(model_type), intent(in) :: model
      type(domain_type), intent(in) :: domain
      !> Where to go on with files of an earlier run
      type(file_positions_type), intent(in) :: places
      !> Why it could not be written
      type(error_type), allocatable, intent(out) :: error

      integer :: i

      call self%create_grid(path, model, domain, error)
      if (allocated(error) .or. .not. self%file%is_open()) return
      call describe_file(self%file, deck, version, model)
      call self%add_cell_fields(model, domain)
      do i = 1, size(self%names)
         call self%file%declare_point_data(trim(self%names(i)), self%components(i))
      end do
      call self%file%put_in_place(places, error)
   end subroutine open_file

   !> Put all states on the disk, and note how many there are
   subroutine mark_file(self, places, error)
      class(field_file_type), intent(inout) :: self
      !> Places in all files
      type(file_positions_type), intent(inout) :: places
      !> Why they are not all there
      type(error_type), allocatable, intent(out) :: error

      call self%file%mark(places, error)
   end subroutine mark_file

   !> Close the file
   subroutine close_file(self, error)
      class(field_file_type), intent(inout) :: self
      !> Why it could not be closed
      type(error_type), allocatable, intent(out) :: error

      call self%file%close(error)
   end subroutine close_file

end module plydyn_io_vtkhdf_field_file
