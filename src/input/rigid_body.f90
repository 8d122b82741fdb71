!> Fields that impactors and fixtures share: friction coefficients and curves of a motion.
module plydyn_input_rigid_body
   use plydyn_base_precision, only : wp
   use plydyn_base_text, only : text
   use plydyn_contact_solve_coulomb, only : friction_type
   use plydyn_input_card_visitor, only : card_visitor_type
   use plydyn_input_catalogue, only : a_curve
   implicit none
   private

   public :: visit_friction, visit_motion

   !> Fields of the curves of a motion
   character(3), parameter, public :: motion_names(3) = ["LCX", "LCY", "LCZ"]

contains

   !> Friction coefficients: sliding is never harder than sticking
   subroutine visit_friction(card, friction)
      class(card_visitor_type), intent(inout) :: card
      !> The coefficients
      type(friction_type), intent(inout) :: friction

      call card%nonnegative("FS", "-", "static friction coefficient; at a sliding speed v it is " &
         & //"FD + (FS - FD) exp(-DC v)", friction%static)
      call card%nonnegative("FD", "-", "dynamic friction coefficient", friction%dynamic)
      call card%nonnegative("DC", "time/length", "decay; 0 for FS at any speed", friction%decay)
      if (.not. card%reads) return
      if (friction%decay > 0.0_wp) then
         if (friction%dynamic > friction%static) call card%refuse("FD", "FD = " &
            & //text(friction%dynamic)//", the dynamic coefficient of friction, is larger than " &
            & //"FS = "//text(friction%static)//", the static one", "FD not larger than FS")
      else if (friction%dynamic > 0.0_wp) then
         if (abs(friction%dynamic - friction%static) > 0.0_wp) call card%warn_idle("FD", &
            & "DC above 0")
      end if
   end subroutine visit_friction

   !> Curves of a prescribed motion along x, y, z; 0 where there is none
   subroutine visit_motion(card, what, motion)
      class(card_visitor_type), intent(inout) :: card
      !> What the curves give
      character(*), intent(in) :: what
      !> Indices of the curves
      integer, intent(inout) :: motion(3)

      integer :: c

      do c = 1, size(motion_names)
         call card%refer(a_curve, motion_names(c), "curve of its "//what//" along " &
            & //motion_names(c)(3:)//"; 0 for none", motion(c), default=0, least=0)
      end do
   end subroutine visit_motion

end module plydyn_input_rigid_body
