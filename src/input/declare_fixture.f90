!> Keywords of fixtures.
module plydyn_input_declare_fixture
   use plydyn_base_precision, only : wp
   use plydyn_deck_declaration, only : extension, keyword_type, new_keyword
   use plydyn_input_rigid_body, only : add_friction, add_motion
   implicit none
   private

   public :: fixture_bar, fixture_clamp, fixture_plane, fixture_punch, fixture_ring

contains

   !> A flat plane, with a window in it
   function fixture_plane() result(keyword)
      type(keyword_type) :: keyword

      keyword = new_body("FIXTURE_PLANE", "A rigid plane along the plate, whole or with a window " &
         & //"of a rectangle or a circle: the base of a test frame.")
      call keyword%add_card()
      call keyword%add_integer("WINDOW", "0 none, 1 a rectangle, 2 a circle", default=0, &
         & allowed=[0, 1, 2])
      call add_place(keyword, "window")
      call add_outline(keyword)
      call add_path(keyword)
   end function fixture_plane

   !> A flat ring
   function fixture_ring() result(keyword)
      type(keyword_type) :: keyword

      keyword = new_body("FIXTURE_RING", "A rigid flat ring along the plate.")
      call keyword%add_card()
      call add_place(keyword, "ring")
      call keyword%add_real("RI", "length", "inner radius", above=0.0_wp)
      call keyword%add_real("RO", "length", "outer radius", above=0.0_wp)
      call add_path(keyword)
   end function fixture_ring

   !> A flat punch
   function fixture_punch() result(keyword)
      type(keyword_type) :: keyword

      keyword = new_body("FIXTURE_PUNCH", "A rigid flat punch, rectangular or round.")
      call keyword%add_card()
      call keyword%add_integer("SHAPE", "1 a rectangle, 2 a circle", allowed=[1, 2])
      call add_place(keyword, "punch")
      call add_outline(keyword)
      call add_path(keyword)
   end function fixture_punch

   !> Size of a rectangle or a circle
   subroutine add_outline(keyword)
      type(keyword_type), intent(inout) :: keyword

      call keyword%add_nonnegative("LX", "length", "length of the rectangle along x")
      call keyword%add_nonnegative("LY", "length", "its length along y")
      call keyword%add_nonnegative("RADIUS", "length", "radius of its corners, or of the circle")
   end subroutine add_outline

   !> A round bar
   function fixture_bar() result(keyword)
      type(keyword_type) :: keyword

      keyword = new_keyword("FIXTURE_BAR", extension, &
         & "A rigid round bar with round ends along the plate; of a small radius, a knife edge.", &
         & suffixes="TITLE")
      call add_head(keyword)
      call keyword%add_real("RADIUS", "length", "radius of the bar", above=0.0_wp)
      call add_friction(keyword)
      call keyword%add_card()
      call keyword%add_real("X1", "length", "x of one end of the axis")
      call keyword%add_real("Y1", "length", "y of that end")
      call keyword%add_real("X2", "length", "x of the other end")
      call keyword%add_real("Y2", "length", "y of that end")
      call add_path(keyword)
   end function fixture_bar

   !> A clamp
   function fixture_clamp() result(keyword)
      type(keyword_type) :: keyword

      keyword = new_keyword("FIXTURE_CLAMP", extension, &
         & "The soft tip of a clamp, round or a ring, " &
         & //"that presses a face with a force.", suffixes="TITLE")
      keyword%remark = "The force is spread evenly over the points under the tip at time zero. " &
         & //"With STIFF the pressure there grows as the face moves towards the tip and falls as " &
         & //"it moves away, never below zero."
      call keyword%add_integer("FID", "number of the fixture", least=1)
      call add_face(keyword)
      call keyword%add_real("FORCE", "force", "force of the clamp", least=0.0_wp)
      call keyword%add_integer("LCID", "curve of its factor over time; 0 for the constant 1", &
         & default=0, least=0)
      call keyword%add_nonnegative("STIFF", "force/length", "stiffness of the tip")
      call add_friction(keyword)
      call keyword%add_card()
      call add_place(keyword, "tip")
      call keyword%add_nonnegative("RI", "length", "inner radius, 0 for a round tip")
      call keyword%add_real("RO", "length", "outer radius", above=0.0_wp)
   end function fixture_clamp

   !> A body with a flat face
   function new_body(name, sentence) result(keyword)
      !> Name of the keyword, and what it is
      character(*), intent(in) :: name, sentence
      type(keyword_type) :: keyword

      keyword = new_keyword(name, extension, sentence, suffixes="TITLE")
      call add_head(keyword)
      call keyword%add_nonnegative("EDGE", "length", "radius of its edges")
      call add_friction(keyword)
   end function new_body

   !> Number, face and distance
   subroutine add_head(keyword)
      !> The keyword of a body
      type(keyword_type), intent(inout) :: keyword

      call keyword%add_integer("FID", "number of the fixture", least=1)
      call add_face(keyword)
      call keyword%add_nonnegative("GAP", "length", "distance from that face at time zero")
   end subroutine add_head

   !> The face that a fixture meets
   subroutine add_face(keyword)
      !> The keyword of a fixture
      type(keyword_type), intent(inout) :: keyword

      call keyword%add_integer("FACE", "face of all parts that it meets: -1 bottom, from below; " &
         & //"1 top, from above", allowed=[-1, 1])
   end subroutine add_face

   !> Centre in the plane
   subroutine add_place(keyword, what)
      !> The keyword of a fixture
      type(keyword_type), intent(inout) :: keyword
      !> What it is the centre of
      character(*), intent(in) :: what

      call keyword%add_real("XC", "length", "x of the centre of the "//what, default=0.0_wp)
      call keyword%add_real("YC", "length", "y of the centre", default=0.0_wp)
   end subroutine add_place

   !> Curves of a prescribed motion
   subroutine add_path(keyword)
      !> The keyword of a body
      type(keyword_type), intent(inout) :: keyword

      call keyword%add_card(optional=.true.)
      call add_motion(keyword, "displacement")
   end subroutine add_path

end module plydyn_input_declare_fixture
