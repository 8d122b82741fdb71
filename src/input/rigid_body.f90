!> Fields that impactors and fixtures share: friction coefficients and curves of a motion.
module plydyn_input_rigid_body
   use plydyn_base_precision, only : wp
   use plydyn_base_text, only : text
   use plydyn_contact_solve_coulomb, only : friction_type
   use plydyn_deck_cards, only : cards_type
   use plydyn_deck_declaration, only : keyword_type
   use plydyn_input_catalogue, only : a_curve, catalogue_type
   implicit none
   private

   public :: add_friction, add_motion, read_friction, read_motion

   !> Fields of the curves of a motion
   character(3), parameter, public :: motion_names(3) = ["LCX", "LCY", "LCZ"]

contains

   !> Friction coefficients
   subroutine add_friction(keyword)
      !> The keyword of a contact or a fixture
      type(keyword_type), intent(inout) :: keyword

      call keyword%add_real("FS", "-", "static friction coefficient; at a sliding speed v it is " &
         & //"FD + (FS - FD) exp(-DC v)", default=0.0_wp, least=0.0_wp)
      call keyword%add_real("FD", "-", "dynamic friction coefficient", default=0.0_wp, least=0.0_wp)
      call keyword%add_real("DC", "time/length", "decay; 0 for FS at any speed", default=0.0_wp, &
         & least=0.0_wp)
   end subroutine add_friction

   !> Curves of a prescribed motion
   subroutine add_motion(keyword, what)
      !> The keyword of a body
      type(keyword_type), intent(inout) :: keyword
      !> What the curves give
      character(*), intent(in) :: what
      integer :: c

      do c = 1, size(motion_names)
         call keyword%add_integer(motion_names(c), "curve of its "//what//" along " &
            & //motion_names(c)(3:)//"; 0 for none", default=0, least=0)
      end do
   end subroutine add_motion

   !> Friction coefficients: sliding is never harder than sticking
   subroutine read_friction(cards, catalogue, friction)
      type(cards_type), intent(in) :: cards
      type(catalogue_type), intent(inout) :: catalogue
      !> The coefficients
      type(friction_type), intent(out) :: friction

      logical :: is_idle

      friction%static = cards%real("FS")
      friction%dynamic = cards%real("FD")
      friction%decay = cards%real("DC")
      if (friction%decay <= 0.0_wp) then
         is_idle = friction%dynamic > 0.0_wp .and. abs(friction%dynamic - friction%static) > 0.0_wp
         if (is_idle) call catalogue%warn_idle(cards, "FD", "DC above 0")
      else if (friction%dynamic > friction%static) then
         call catalogue%refuse(cards, "FD", "FD = "//text(friction%dynamic)//", the dynamic " &
            & //"coefficient of friction, is larger than FS = "//text(friction%static) &
            & //", the static one", "FD not larger than FS")
      end if
   end subroutine read_friction

   !> Curves of a motion along x, y, z; 0 where there is none
   subroutine read_motion(cards, catalogue, motion)
      type(cards_type), intent(in) :: cards
      type(catalogue_type), intent(inout) :: catalogue
      !> Indices of the curves
      integer, intent(out) :: motion(3)
      integer :: c

      motion(:) = 0
      do c = 1, size(motion_names)
         if (cards%integer(motion_names(c)) == 0) cycle
         call catalogue%find(a_curve, cards, motion_names(c), motion(c))
      end do
   end subroutine read_motion

end module plydyn_input_rigid_body
