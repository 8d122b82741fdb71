!> What a file of states says about itself: version, deck, units, plies, impactors.
module plydyn_io_vtkhdf_description
   use plydyn_base_precision, only : wp
   use plydyn_contact_bodies_revolved_body, only : revolved_body_type
   use plydyn_model_model, only : model_type
   use plydyn_io_vtkhdf_vtkhdf, only : vtkhdf_type
   implicit none
   private

   public :: describe_file

contains

   !> Attributes and tables of the group /plydyn
   subroutine describe_file(file, deck, version, model)
      type(vtkhdf_type), intent(inout) :: file
      !> Path of the deck, version of the program
      character(*), intent(in) :: deck, version
      type(model_type), intent(in) :: model

      character(16), parameter :: ply_columns(6) = [character(16) :: "part", "ply", "ply_id", &
         & "angle", "bottom", "top"]
      character(16), parameter :: impactor_columns(6) = [character(16) :: "id", "radius", "mass", &
         & "x", "y", "z"]
      character(16), parameter :: outline_columns(8) = [character(16) :: "id", "rounding", &
         & "axis x", "axis y", "axis z", "back", "along", "across"]
      real(wp), allocatable :: table(:, :)
      integer :: i

      call file%describe("version", version)
      call file%describe("title", model%title)
      call file%describe("deck", deck)
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

end module plydyn_io_vtkhdf_description
