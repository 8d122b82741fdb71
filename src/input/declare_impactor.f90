!> Keywords of impactors.
module plydyn_input_declare_impactor
   use plydyn_base_precision, only : wp
   use plydyn_deck_declaration, only : keyword_type, new_keyword, extension
   use plydyn_input_rigid_body, only : add_motion
   implicit none
   private

   public :: impactor_cone, impactor_cylinder, impactor_sphere, impactor_tup

contains

   !> A rigid sphere
   function impactor_sphere() result(keyword)
      type(keyword_type) :: keyword

      keyword = new_impactor("IMPACTOR_SPHERE", "A rigid sphere or hemisphere.", &
         & "the centre")
      call add_flight(keyword, "0 free: friction makes it rotate; 1 guided along z; " &
         & //"2 free to move but not to rotate")
      call keyword%add_integer("SHAPE", &
         & "0 sphere, 1 hemisphere that faces the plate; contact sees the same", default=0, &
         & allowed=[0, 1])
      call keyword%add_card(optional=.true.)
      call keyword%add_nonnegative("INERTIA", "mass length2", "moment of inertia about the " &
         & //"centre; 0 for that of a solid ball")
      call add_prescribed_motion(keyword)
   end function impactor_sphere

   !> A hemisphere on a rod
   function impactor_tup() result(keyword)
      type(keyword_type) :: keyword

      keyword = new_impactor("IMPACTOR_TUP", "A rigid hemisphere on a rod of its radius: the tup " &
         & //"of a drop tower.", "the centre of the hemisphere")
      call keyword%add_card()
      call add_rod(keyword)
      call add_axis(keyword, "axis from the tip to the rod; 0 0 0 for away from the face")
      call add_flight(keyword, "0 or 2 free to move but not to rotate, 1 guided along z")
      call keyword%add_card(optional=.true.)
      call add_prescribed_motion(keyword)
   end function impactor_tup

   !> A cylinder
   function impactor_cylinder() result(keyword)
      type(keyword_type) :: keyword

      keyword = new_impactor("IMPACTOR_CYLINDER", "A rigid cylinder: upright, a flat punch; " &
         & //"lying, a bar.", "the middle")
      call keyword%add_card()
      call keyword%add_real("LENGTH", "length", "length along the axis", above=0.0_wp)
      call keyword%add_nonnegative("EDGE", "length", "radius of the edges of both end faces")
      call add_axis(keyword, "axis; 0 0 0 for upright")
      call add_flight(keyword, "0 or 2 free to move but not to rotate, 1 guided along z")
      call keyword%add_card(optional=.true.)
      call add_prescribed_motion(keyword)
   end function impactor_cylinder

   !> A cone on a rod
   function impactor_cone() result(keyword)
      type(keyword_type) :: keyword

      keyword = new_impactor("IMPACTOR_CONE", "A rigid cone with a round tip, on a rod.", &
         & "the middle of the circle where cone and rod meet")
      call keyword%add_card()
      call keyword%add_real("ANGLE", "degrees", "angle between the axis and the side of the cone", &
         & above=0.0_wp, most=89.0_wp)
      call keyword%add_nonnegative("TIP", "length", "radius of the tip, and of the edge between " &
         & //"cone and rod; 0 for sharp")
      call add_rod(keyword)
      call add_axis(keyword, "axis from the tip to the rod; 0 0 0 for away from the face")
      call add_flight(keyword, "0 or 2 free to move but not to rotate, 1 guided along z")
      call keyword%add_card(optional=.true.)
      call add_prescribed_motion(keyword)
   end function impactor_cone

   !> A keyword with number, size and mass of an impactor
   function new_impactor(name, sentence, centre) result(keyword)
      !> Name and meaning of the keyword, and what its centre is
      character(*), intent(in) :: name, sentence, centre
      type(keyword_type) :: keyword

      keyword = new_keyword(name, extension, sentence, suffixes="TITLE")
      call keyword%add_integer("IID", "number of the impactor", least=1)
      call keyword%add_real("RADIUS", "length", "radius", above=0.0_wp)
      call keyword%add_nonnegative("MASS", "mass", "mass; 0 for one made from RO")
      call keyword%add_real("XC", "length", "x of "//centre//" at time zero")
      call keyword%add_real("YC", "length", "y of it")
      call keyword%add_real("ZC", "length", "z of it")
      call keyword%add_nonnegative("RO", "mass/length3", "density, where MASS is 0")
   end function new_impactor

   !> Length of a rod
   subroutine add_rod(keyword)
      type(keyword_type), intent(inout) :: keyword

      call keyword%add_nonnegative("LENGTH", "length", "length of the rod: for its mass from RO " &
         & //"and for pictures; contact sees no end of it")
   end subroutine add_rod

   !> Direction of an axis
   subroutine add_axis(keyword, what)
      type(keyword_type), intent(inout) :: keyword
      !> Meaning
      character(*), intent(in) :: what

      call keyword%add_real("AX", "-", "x of the "//what, default=0.0_wp)
      call keyword%add_real("AY", "-", "y of it", default=0.0_wp)
      call keyword%add_real("AZ", "-", "z of it", default=0.0_wp)
   end subroutine add_axis

   !> Velocity, freedom and weight
   subroutine add_flight(keyword, freedom)
      type(keyword_type), intent(inout) :: keyword
      !> Meaning of DOF
      character(*), intent(in) :: freedom

      call keyword%add_card()
      call keyword%add_real("VX", "length/time", "velocity along x at time zero")
      call keyword%add_real("VY", "length/time", "velocity along y at time zero")
      call keyword%add_real("VZ", "length/time", "velocity along z at time zero")
      call keyword%add_integer("DOF", freedom, default=0, allowed=[0, 1, 2])
      call keyword%add_real("GRAVZ", "length/time2", "acceleration along z at all times", &
         & default=0.0_wp)
   end subroutine add_flight

   !> Weight along the plate, and curves of a motion
   subroutine add_prescribed_motion(keyword)
      type(keyword_type), intent(inout) :: keyword

      call keyword%add_real("GRAVX", "length/time2", "acceleration along x at all times", &
         & default=0.0_wp)
      call keyword%add_real("GRAVY", "length/time2", "acceleration along y at all times", &
         & default=0.0_wp)
      call add_motion(keyword, "prescribed motion")
      call keyword%add_integer("VAD", "what these curves give: 0 velocity, 1 acceleration, " &
         & //"2 displacement", default=0, allowed=[0, 1, 2])
   end subroutine add_prescribed_motion

end module plydyn_input_declare_impactor
