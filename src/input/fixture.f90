!> Keywords of fixtures: rigid bodies that the plate lies on, and clamps; friction and motions,
!> which impactors have, too.
module plydyn_input_fixture
   use plydyn_base_precision, only : wp
   use plydyn_base_text, only : text
   use plydyn_contact_bodies_flat_body, only : circle_outline, rectangle_outline, strip_outline
   use plydyn_contact_solve_coulomb, only : friction_type
   use plydyn_deck_declaration, only : extension
   use plydyn_input_card_visitor, only : card_visitor_type
   use plydyn_input_catalogue, only : a_curve, a_fixture
   use plydyn_input_keyword_row, only : keyword_list_type, stage_laminate
   use plydyn_input_load, only : visit_curve
   use plydyn_model_body, only : fixture_type
   use plydyn_model_model, only : model_type
   implicit none
   private

   public :: add_fixtures, visit_friction, visit_motion

   !> Fields of the curves of a motion
   character(3), parameter, public :: motion_names(3) = ["LCX", "LCY", "LCZ"]
   !> Shapes of windows and punches, numbered as on the card
   integer, parameter :: a_rectangle = 1, a_circle = 2

contains

   !> Add these keywords
   subroutine add_fixtures(list)
      type(keyword_list_type), intent(inout) :: list

      call list%add("FIXTURE_PLANE", fixture_plane, stage_laminate)
      call list%add("FIXTURE_RING", fixture_ring, stage_laminate)
      call list%add("FIXTURE_PUNCH", fixture_punch, stage_laminate)
      call list%add("FIXTURE_BAR", fixture_bar, stage_laminate)
      call list%add("FIXTURE_CLAMP", fixture_clamp, stage_laminate)
   end subroutine add_fixtures

   !> A flat plane, with a window in it
   subroutine fixture_plane(card, model)
      class(card_visitor_type), intent(inout) :: card
      type(model_type), intent(inout) :: model

      type(fixture_type) :: fixture
      integer :: window

      call card%keyword(extension, "A rigid plane along the plate, whole or with a window of a " &
         & //"rectangle or a circle: the base of a test frame.", change="fixtures")
      call card%example("fixtures", "1, -1, 0, 0, 0.3|1, 20.0, 20.0, 30.0, 30.0, 2.0")
      call visit_flat_body(card, "plane", fixture)
      call card%integer("WINDOW", "0 none, 1 a rectangle, 2 a circle", window, default=0, &
         & allowed=[0, 1, 2])
      call visit_outline(card, "window", window, fixture)
      call visit_path(card, model, fixture)
   end subroutine fixture_plane

   !> A flat ring
   subroutine fixture_ring(card, model)
      class(card_visitor_type), intent(inout) :: card
      type(model_type), intent(inout) :: model

      type(fixture_type) :: fixture
      real(wp) :: radii(2)

      call card%keyword(extension, "A rigid flat ring along the plate.", change="fixtures")
      call card%example("fixtures", "1, -1|20.0, 20.0, 13.0, 25.0")
      call visit_flat_body(card, "ring", fixture)
      call visit_ring(card, "ring", radii, fixture)
      if (card%reads) call check_edge(card, fixture, 0.5_wp*(radii(2) - radii(1)))
      call visit_path(card, model, fixture)
   end subroutine fixture_ring

   !> A flat punch
   subroutine fixture_punch(card, model)
      class(card_visitor_type), intent(inout) :: card
      type(model_type), intent(inout) :: model

      type(fixture_type) :: fixture
      integer :: shape_number

      call card%keyword(extension, "A rigid flat punch, rectangular or round.", change="fixtures")
      call card%example("fixtures", "1, -1|2, 20.0, 20.0, 0, 0, 6.0|0, 0, 1")
      call visit_flat_body(card, "punch", fixture)
      call card%integer("SHAPE", "1 a rectangle, 2 a circle", shape_number, allowed=[1, 2])
      call visit_outline(card, "punch", shape_number, fixture)
      if (size(fixture%body%outlines) > 0) call check_edge(card, fixture, &
         & minval(fixture%body%outlines(1)%half))
      call visit_path(card, model, fixture)
   end subroutine fixture_punch

   !> A round bar
   subroutine fixture_bar(card, model)
      class(card_visitor_type), intent(inout) :: card
      type(model_type), intent(inout) :: model

      type(fixture_type) :: fixture
      real(wp) :: first(2), last(2)

      call card%keyword(extension, "A rigid round bar with round ends along the plate; of a " &
         & //"small radius, a knife edge.", change="fixtures")
      call card%example("fixtures", "1, -1, 0, 2.0|10.0, 0, 10.0, 40.0")
      call visit_head(card, "bar", fixture)
      call card%nonnegative("GAP", "length", "distance from that face at time zero", fixture%gap)
      call card%positive("RADIUS", "length", "radius of the bar", fixture%body%edge)
      call visit_friction(card, fixture%friction)
      call card%card()
      call card%real("X1", "length", "x of one end of the axis", first(1))
      call card%real("Y1", "length", "y of that end", first(2))
      call card%real("X2", "length", "x of the other end", last(1))
      call card%real("Y2", "length", "y of that end", last(2))
      if (card%reads) then
         if (norm2(last - first) > 0.0_wp) then
            fixture%body%outlines = [strip_outline(first, last, fixture%body%edge)]
         else if (card%is_fine("X1") .and. card%is_fine("Y1") .and. card%is_fine("X2") &
            & .and. card%is_fine("Y2")) then
            call card%refuse("X2", "the bar has no length", "two ends that are apart")
         end if
      end if
      call visit_path(card, model, fixture)
   end subroutine fixture_bar

   !> A clamp
   subroutine fixture_clamp(card, model)
      class(card_visitor_type), intent(inout) :: card
      type(model_type), intent(inout) :: model

      type(fixture_type) :: fixture
      real(wp) :: radii(2)

      call card%keyword(extension, "The soft tip of a clamp, round or a ring, that presses a " &
         & //"face with a force.", change="fixtures")
      call card%remark("The force is spread evenly over the points under the tip at time zero. " &
         & //"With STIFF the pressure there grows as the face moves towards the tip and falls as " &
         & //"it moves away, never below zero.")
      call card%example("fixtures", "1, 1, 100.0, 0, 0, 0.3|10.0, 10.0, 0, 3.0")
      call visit_head(card, "clamp", fixture)
      fixture%is_clamp = .true.
      call card%real("FORCE", "force", "force of the clamp", fixture%force, least=0.0_wp)
      call visit_curve(card, "curve of its factor over time; 0 for the constant 1", model%curves, &
         & fixture%curve, default=0)
      call card%nonnegative("STIFF", "force/length", "stiffness of the tip", fixture%stiffness)
      call visit_friction(card, fixture%friction)
      call card%card()
      call visit_ring(card, "tip", radii, fixture)
      if (.not. card%reads) return
      fixture%line = card%line_of("STIFF")
      model%fixtures = [model%fixtures, fixture]
   end subroutine fixture_clamp

   !> Number, face, distance, edge and friction of a body with a flat face
   subroutine visit_flat_body(card, kind, fixture)
      class(card_visitor_type), intent(inout) :: card
      !> What it is
      character(*), intent(in) :: kind
      type(fixture_type), intent(inout) :: fixture

      call visit_head(card, kind, fixture)
      call card%nonnegative("GAP", "length", "distance from that face at time zero", fixture%gap)
      call card%nonnegative("EDGE", "length", "radius of its edges", fixture%body%edge)
      call visit_friction(card, fixture%friction)
      call card%card()
   end subroutine visit_flat_body

   !> Number of a fixture, and the face that it meets
   subroutine visit_head(card, kind, fixture)
      class(card_visitor_type), intent(inout) :: card
      !> What it is
      character(*), intent(in) :: kind
      type(fixture_type), intent(inout) :: fixture

      character(:), allocatable :: title

      call card%title(title)
      call card%define(a_fixture, "FID", "number of the fixture", fixture%id)
      call card%integer("FACE", "face of all parts that it meets: -1 bottom, from below; 1 top, " &
         & //"from above", fixture%face, allowed=[-1, 1])
      fixture%kind = kind
      allocate (fixture%body%outlines(0))
      if (.not. card%reads) return
      fixture%body%upward = -fixture%face
   end subroutine visit_head

   !> Outline of a rectangle or a circle; none for shape 0. A window is a hole.
   subroutine visit_outline(card, what, shape_number, fixture)
      class(card_visitor_type), intent(inout) :: card
      !> What it is
      character(*), intent(in) :: what
      !> `a_rectangle`, `a_circle` or 0
      integer, intent(in) :: shape_number
      type(fixture_type), intent(inout) :: fixture

      character(6), parameter :: names(3) = ["LX    ", "LY    ", "RADIUS"]
      integer :: i
      real(wp) :: centre(2), radius, sides(2)

      call visit_centre(card, what, centre)
      call card%nonnegative("LX", "length", "length of the rectangle along x", sides(1))
      call card%nonnegative("LY", "length", "its length along y", sides(2))
      call card%nonnegative("RADIUS", "length", "radius of its corners, or of the circle", radius)
      if (.not. card%reads) return
      if (shape_number == a_rectangle) then
         fixture%body%outlines = [rectangle_outline(centre, sides, radius, what == "window")]
         if (minval(sides) <= 0.0_wp) call card%refuse("LX", "the rectangle has no area", &
            & "LX and LY above 0")
         if (2.0_wp*radius > minval(sides)) call card%refuse("RADIUS", &
            & "the corners are rounder than the rectangle is wide", "half of its shorter side at " &
            & //"most")
      else if (shape_number == a_circle) then
         fixture%body%outlines = [circle_outline(centre, radius, what == "window")]
         if (radius <= 0.0_wp) call card%refuse("RADIUS", "the circle has no radius", &
            & "RADIUS above 0")
         do i = 1, size(sides)
            if (sides(i) > 0.0_wp) call card%warn_idle(trim(names(i)), "a rectangle, 1, in place " &
               & //"of a circle, 2")
         end do
      else if (what == "window" .and. card%is_fine("WINDOW")) then
         i = findloc([sides, radius] > 0.0_wp, .true., 1)
         if (i > 0) call card%refuse(trim(names(i)), trim(names(i))//" is given for a plane " &
            & //"without a window", "WINDOW 1 for a rectangle, 2 for a circle, or 0 here")
      end if
   end subroutine visit_outline

   !> Centre in the plane
   subroutine visit_centre(card, what, centre)
      class(card_visitor_type), intent(inout) :: card
      !> What it is the centre of
      character(*), intent(in) :: what
      real(wp), intent(inout) :: centre(2)

      call card%real("XC", "length", "x of the centre of the "//what, centre(1), default=0.0_wp)
      call card%real("YC", "length", "y of the centre", centre(2), default=0.0_wp)
   end subroutine visit_centre

   !> Outlines of a ring, or of a round tip without an inner radius
   subroutine visit_ring(card, what, radii, fixture)
      class(card_visitor_type), intent(inout) :: card
      !> What it is
      character(*), intent(in) :: what
      !> Inner and outer radius
      real(wp), intent(inout) :: radii(2)
      type(fixture_type), intent(inout) :: fixture

      real(wp) :: centre(2)

      call visit_centre(card, what, centre)
      if (what == "tip") then
         call card%nonnegative("RI", "length", "inner radius, 0 for a round tip", radii(1))
      else
         call card%positive("RI", "length", "inner radius", radii(1))
      end if
      call card%positive("RO", "length", "outer radius", radii(2))
      if (.not. card%reads) return
      fixture%body%outlines = [circle_outline(centre, radii(2), .false.)]
      if (radii(1) > 0.0_wp) fixture%body%outlines = [fixture%body%outlines, &
         & circle_outline(centre, radii(1), .true.)]
      if (radii(1) >= radii(2)) call card%refuse("RO", &
         & "the outer radius is not above the inner one", "RO above RI")
   end subroutine visit_ring

   !> Two edges fit into the width
   subroutine check_edge(card, fixture, half_width)
      class(card_visitor_type), intent(inout) :: card
      type(fixture_type), intent(in) :: fixture
      !> Half of its width
      real(wp), intent(in) :: half_width

      if (fixture%body%edge > half_width) call card%refuse("EDGE", "the "//fixture%kind &
         & //" is narrower than its two edges", "an edge of half the width of the "//fixture%kind &
         & //" at most")
   end subroutine check_edge

   !> Curves of a prescribed motion, the last card of a body
   subroutine visit_path(card, model, fixture)
      class(card_visitor_type), intent(inout) :: card
      !> Gets the body
      type(model_type), intent(inout) :: model
      type(fixture_type), intent(inout) :: fixture

      call card%card(optional=.true.)
      call visit_motion(card, "displacement", fixture%motion)
      if (.not. card%reads) return
      call check_start(card, model, fixture)
      model%fixtures = [model%fixtures, fixture]
   end subroutine visit_path

   !> Warn of a fixture that is displaced where it begins; GAP is its distance then
   subroutine check_start(card, model, fixture)
      class(card_visitor_type), intent(inout) :: card
      !> Has the curves
      type(model_type), intent(in) :: model
      type(fixture_type), intent(in) :: fixture

      integer :: c
      real(wp) :: start

      if (card%line_of("LCX") <= card%catalogue%stored_lines) return
      start = card%catalogue%start(card%root)
      do c = 1, size(motion_names)
         if (fixture%motion(c) == 0) cycle
         associate (way => model%curves(fixture%motion(c))%at(start))
            if (abs(way) > 0.0_wp) call card%warn(motion_names(c), "the fixture is displaced by " &
               & //text(way)//" where it begins", "a curve that is 0 at time "//text(start) &
               & //", and the place on the cards before")
         end associate
      end do
   end subroutine check_start

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
         if (max(friction%static, friction%dynamic) <= 0.0_wp) call card%warn_idle("DC", &
            & "FS above 0")
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

end module plydyn_input_fixture
