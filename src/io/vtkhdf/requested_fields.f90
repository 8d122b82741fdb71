!> The fields that a deck asks for by name, at the points of whatever grid.
module plydyn_io_vtkhdf_requested_fields
   use plydyn_base_error, only : error_type
   use plydyn_base_precision, only : wp
   use plydyn_domain_domain, only : domain_type
   use plydyn_element_recovered, only : ply_strain_at, ply_stress_at, scalars_at, strain_at, &
      & stress_at
   use plydyn_law_law, only : scalar_names
   use plydyn_io_vtkhdf_components, only : tensor, tensor_share
   use plydyn_io_vtkhdf_field_file, only : field_file_type
   use plydyn_state_state, only : state_type
   implicit none
   private

   !> A file of motion, strain, stress and scalars of laws; an extension has the points
   type, public, abstract, extends(field_file_type) :: point_fields_type
   contains
      procedure :: write => write_fields
      procedure(motion_values), deferred :: motion_values
      procedure(recovered_values), deferred :: recovered_values
   end type point_fields_type

   abstract interface
      !> Displacement or velocity at the points that this rank writes, (3, points)
      function motion_values(self, domain, motion) result(values)
         import :: domain_type, point_fields_type, wp
         implicit none
         class(point_fields_type), intent(in) :: self
         type(domain_type), intent(in) :: domain
         !> Displacement or velocity of all freedoms
         real(wp), intent(in) :: motion(:)
         real(wp), allocatable :: values(:, :)
      end function motion_values

      !> Strain, stress and scalars at the points that this rank writes,
      !> (recovered, points)
      function recovered_values(self, domain, state) result(values)
         import :: domain_type, point_fields_type, state_type, wp
         implicit none
         class(point_fields_type), intent(in) :: self
         type(domain_type), intent(in) :: domain
         type(state_type), intent(in) :: state
         real(wp), allocatable :: values(:, :)
      end function recovered_values
   end interface

contains

   !> Write the present state; it is whole in the file when this returns
   subroutine write_fields(self, domain, state, error)
      class(point_fields_type), intent(inout) :: self
      type(domain_type), intent(in) :: domain
      type(state_type), intent(in) :: state
      !> Why it could not be written
      type(error_type), allocatable, intent(out) :: error

      real(wp), allocatable :: values(:, :)
      integer :: i

      if (.not. self%file%is_open()) return
      if (any(self%names /= "displacement" .and. self%names /= "velocity")) then
         values = self%recovered_values(domain, state)
      else
         allocate (values(0, 0))
      end if
      do i = 1, size(self%names)
         call write_field(self, domain, state, trim(self%names(i)), values)
      end do
      call self%file%end_step(state%time, error)
   end subroutine write_fields

   !> Write one field of the present state; the velocity is that of its time
   subroutine write_field(self, domain, state, name, values)
      class(point_fields_type), intent(inout) :: self
      type(domain_type), intent(in) :: domain
      type(state_type), intent(in) :: state
      !> Name of the field
      character(*), intent(in) :: name
      !> Strain, stress and scalars where a field asks for them, (recovered, points)
      real(wp), intent(in) :: values(:, :)

      associate (file => self%file)
         select case (name)
         case ("displacement")
            call file%write_point_data(name, self%motion_values(domain, state%displacement))
         case ("velocity")
            call file%write_point_data(name, self%motion_values(domain, state%velocity &
               & + 0.5_wp*state%step_before*state%acceleration(:size(state%velocity))))
         case ("strain")
            call file%write_point_data(name, tensor(values, strain_at, tensor_share))
         case ("stress")
            call file%write_point_data(name, tensor(values, stress_at))
         case ("strain_ply")
            call file%write_point_data(name, tensor(values, ply_strain_at, tensor_share))
         case ("stress_ply")
            call file%write_point_data(name, tensor(values, ply_stress_at))
         case default
            call file%write_point_data(name, &
               & values(scalars_at + findloc(scalar_names == name, .true., 1), :))
         end select
      end associate
   end subroutine write_field

end module plydyn_io_vtkhdf_requested_fields
