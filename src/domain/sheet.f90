!> Stiffness and mass of parts over their area, and the slowest bending of a model.
module plydyn_domain_sheet
   use plydyn_base_matrix, only : invert
   use plydyn_base_precision, only : wp
   use plydyn_law_ply_elastic, only : add_ply_stiffness
   use plydyn_model_model, only : model_type
   implicit none
   private

   public :: beam_period, sheet_of

   real(wp), parameter :: pi = acos(-1.0_wp)

   !> Stiffness and mass of a part over its area, or of a unit of thickness of bricks
   type, public :: sheet_type
      !> Stiffness in the plane, and in bending without strain of the mid-plane
      real(wp) :: a(3, 3) = 0.0_wp, d(3, 3) = 0.0_wp
      !> Thickness, and mass per area
      real(wp) :: thickness = 0.0_wp, mass = 0.0_wp
      !> Whether the part bends as a plate
      logical :: bends = .false.
   end type sheet_type

contains

   !> Longest first period of the parts of a model as simply supported beams; 0 without plates.
   !>
   !> They are twice as long as the longer side of the mesh, which may be a half of the plate.
   !> Plates that are held at all edges are faster.
   pure real(wp) function beam_period(model) result(period)
      !> The model; its mass is that without mass scaling
      type(model_type), intent(in) :: model

      type(sheet_type) :: sheet
      real(wp) :: length(2)
      integer :: axis, p

      length(:) = 2.0_wp*(maxval(model%mesh%position(:2, :), dim=2) &
         & - minval(model%mesh%position(:2, :), dim=2))
      axis = maxloc(length, dim=1)
      period = 0.0_wp
      do p = 1, size(model%parts)
         sheet = sheet_of(model, p)
         if (.not. sheet%bends) cycle
         period = max(period, 2.0_wp*length(axis)**2/pi*sqrt(sheet%mass/sheet%d(axis, axis)))
      end do
   end function beam_period

   !> Stiffness and mass of a part
   pure function sheet_of(model, p) result(sheet)
      type(model_type), intent(in) :: model
      !> Index of the part
      integer, intent(in) :: p
      type(sheet_type) :: sheet

      real(wp) :: b(3, 3), flexibility(3, 3), unused, z
      integer :: i, k

      b(:, :) = 0.0_wp
      associate (part => model%parts(p))
         if (part%brick%points > 0) then
            associate (material => model%materials(part%plies(1)%material))
               do i = 1, size(model%mesh%brick_part)
                  if (model%mesh%brick_part(i) /= p) cycle
                  call add_ply_stiffness(material%law, model%mesh%brick_angle(i), &
                     & [0.0_wp, 1.0_wp], sheet%a, b, sheet%d)
                  sheet%thickness = sheet%thickness + 1.0_wp
               end do
               sheet%mass = material%density*sheet%thickness
            end associate
            return
         end if
         z = 0.0_wp
         do k = 1, size(part%plies)
            associate (ply => part%plies(k), material => model%materials(part%plies(k)%material))
               call add_ply_stiffness(material%law, ply%angle, [z, z + ply%thickness], sheet%a, &
                  & b, sheet%d)
               sheet%mass = sheet%mass + material%density*ply%thickness
               z = z + ply%thickness
            end associate
         end do
         sheet%thickness = z
         sheet%bends = .true.
         call invert(sheet%a, flexibility, unused)
         sheet%d(:, :) = sheet%d - matmul(b, matmul(flexibility, b))
      end associate
   end function sheet_of

end module plydyn_domain_sheet
