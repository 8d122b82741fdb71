!> A file of field states, of whatever grid: what does not change, then state by state. What the
!> file says about itself: version, deck, units, plies, impactors.
module plydyn_io_vtkhdf_field_file
   use plydyn_base_error, only : error_type
   use plydyn_domain_domain, only : domain_type
   use plydyn_model_model, only : model_type
   use plydyn_model_symmetry, only : plane_words
   use plydyn_io_job, only : job_type
   use plydyn_io_vtkhdf_vtkhdf, only : vtkhdf_type
   use plydyn_method_simulation, only : simulation_type
   use plydyn_state_state, only : state_type
   use plydyn_base_precision, only : wp
   use plydyn_contact_bodies_revolved_body, only : revolved_body_type
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
      procedure(write_fields), deferred :: write_fields
      procedure, non_overridable :: write => write_state
      procedure, non_overridable :: write_values
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

      !> Write all fields of the present state
      subroutine write_fields(self, domain, state)
         import :: domain_type, field_file_type, state_type
         implicit none
         class(field_file_type), intent(inout) :: self
         type(domain_type), intent(in) :: domain
         type(state_type), intent(in) :: state
      end subroutine write_fields
   end interface

contains

   !> Create the file, if the domain has something to show: grid, plies, units, fields
   subroutine open_file(self, ending, job, simulation, error)
      class(field_file_type), intent(inout) :: self
      !> What the path of the file has behind that of the results
      character(*), intent(in) :: ending
      !> The job, with the places in files of an earlier run
      type(job_type), intent(in) :: job
      class(simulation_type), intent(in) :: simulation
      !> Why it could not be written
      type(error_type), allocatable, intent(out) :: error

      integer :: i

      call self%create_grid(job%path//ending, simulation%model, simulation%domain, error)
      if (allocated(error) .or. .not. self%file%is_open()) return
      call describe_file(self%file, job, simulation%model)
      call self%add_cell_fields(simulation%model, simulation%domain)
      do i = 1, size(self%names)
         call self%file%declare_point_data(trim(self%names(i)), self%components(i))
      end do
      call self%file%put_in_place(job%places, error)
   end subroutine open_file

   !> Write the present state, if the file is open; it is whole in the file when this returns
   subroutine write_state(self, domain, state, error)
      class(field_file_type), intent(inout) :: self
      type(domain_type), intent(in) :: domain
      type(state_type), intent(in) :: state
      !> Why it could not be written
      type(error_type), allocatable, intent(out) :: error

      if (.not. self%file%is_open()) return
      call self%write_fields(domain, state)
      call self%file%end_step(state%time, error)
   end subroutine write_state

   !> Write all fields of the present state
   subroutine write_values(self, values)
      class(field_file_type), intent(inout) :: self
      !> Their values at the points of this rank, field by field, (values, points)
      real(wp), intent(in) :: values(:, :)

      integer :: i, last

      last = 0
      do i = 1, size(self%names)
         call self%file%write_point_data(trim(self%names(i)), &
            & values(last + 1:last + self%components(i), :))
         last = last + self%components(i)
      end do
   end subroutine write_values

   !> Attributes and tables of the group /plydyn
   subroutine describe_file(file, job, model)
      type(vtkhdf_type), intent(inout) :: file
      !> Has the path of the deck and the version of the program
      type(job_type), intent(in) :: job
      type(model_type), intent(in) :: model

      character(16), parameter :: ply_columns(6) = [character(16) :: "part", "ply", "ply_id", &
         & "angle", "bottom", "top"]
      character(16), parameter :: impactor_columns(6) = [character(16) :: "id", "radius", "mass", &
         & "x", "y", "z"]
      character(16), parameter :: outline_columns(8) = [character(16) :: "id", "rounding", &
         & "axis x", "axis y", "axis z", "back", "along", "across"]
      real(wp), allocatable :: table(:, :)
      integer :: i

      call file%describe("version", job%version)
      call file%describe("title", model%title)
      call file%describe("deck", job%deck)
      call file%describe("symmetry", plane_words(model))
      associate (units => model%control%units)
         call file%describe("length", trim(units%length))
         call file%describe("time", trim(units%time))
         call file%describe("mass", trim(units%mass))
         call file%describe("force", trim(units%force))
         call file%describe("stress", trim(units%stress))
         call file%describe("energy", trim(units%energy))
      end associate
      call file%add_table("plies", ply_columns, ply_table(model))
      table = reshape([(real(model%impactors(i)%id, wp), model%impactors(i)%body%radius, &
         & model%impactors(i)%mass, model%impactors(i)%centre, i=1, size(model%impactors))], &
         & [6, size(model%impactors)])
      if (size(table) == 0) return
      call file%add_table("impactors", impactor_columns, table)
      call file%add_table("impactor_outlines", outline_columns, outline_table(model))
   end subroutine describe_file

   !> One row for each ply of each part: part, ply from the bottom, its number, angle, z range
   pure function ply_table(model) result(table)
      type(model_type), intent(in) :: model
      real(wp), allocatable :: table(:, :)

      real(wp) :: z
      integer :: k, p

      allocate (table(6, 0))
      do p = 1, size(model%parts)
         associate (part => model%parts(p))
            z = part%bottom_offset*sum(part%plies%thickness)
            do k = 1, size(part%plies)
               table = reshape([table, real(part%id, wp), real(k, wp), &
                  & real(part%plies(k)%id, wp), part%plies(k)%angle, z, &
                  & z + part%plies(k)%thickness], [6, size(table, 2) + 1])
               z = z + part%plies(k)%thickness
            end do
         end associate
      end do
   end function ply_table

   !> One row for each corner of the core of each impactor: its number, the radius by which the core
   !> is widened, the axis, where along it the body ends, and the corner along and across the axis
   pure function outline_table(model) result(table)
      type(model_type), intent(in) :: model
      real(wp), allocatable :: table(:, :)

      integer :: c, i

      allocate (table(8, 0))
      do i = 1, size(model%impactors)
         associate (body => model%impactors(i)%body)
            do c = 1, size(body%corner, 2)
               table = reshape([table, real(model%impactors(i)%id, wp), body%rounding, body%axis, &
                  & back_end(body), min(body%corner(1, c), back_end(body)), body%corner(2, c)], &
                  & [8, size(table, 2) + 1])
            end do
         end associate
      end do
   end function outline_table

   !> Where a body ends behind its centre: a rod without a length is shown as long as it is wide
   pure real(wp) function back_end(body)
      type(revolved_body_type), intent(in) :: body

      back_end = merge(body%length, 2.0_wp*body%radius, body%length > 0.0_wp)
   end function back_end

end module plydyn_io_vtkhdf_field_file
