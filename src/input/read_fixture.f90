!> Readers of fixtures.
module plydyn_input_read_fixture
   use plydyn_base_precision, only : wp
   use plydyn_contact_bodies_outline, only : circle_outline, outline_type, rectangle_outline, &
      & strip_outline
   use plydyn_deck_cards, only : cards_type
   use plydyn_input_catalogue, only : a_fixture, catalogue_type
   use plydyn_input_read_load, only : find_curve
   use plydyn_input_rigid_body, only : read_friction, read_motion
   use plydyn_model_fixture, only : fixture_type
   use plydyn_model_model, only : model_type
   implicit none
   private

   public :: read_fixture

   !> Shapes of windows and punches, numbered as on the card
   integer, parameter :: a_rectangle = 1, a_circle = 2

contains

   !> *FIXTURE_PLANE, _RING, _PUNCH, _BAR: a rigid body along the plate; _CLAMP: a tip that presses
   subroutine read_fixture(cards, catalogue, model)
      type(cards_type), intent(in) :: cards
      type(catalogue_type), intent(inout) :: catalogue
      type(model_type), intent(inout) :: model

      type(fixture_type) :: fixture

      select case (cards%name)
      case ("FIXTURE_PLANE")
         call read_body(cards, "plane", "EDGE", catalogue, fixture)
         call read_outline(cards, cards%integer("WINDOW"), .true., catalogue, fixture)
      case ("FIXTURE_RING")
         call read_body(cards, "ring", "EDGE", catalogue, fixture)
         call read_ring(cards, catalogue, fixture)
         call check_edge(cards, fixture, 0.5_wp*(cards%real("RO") - cards%real("RI")), catalogue)
      case ("FIXTURE_PUNCH")
         call read_body(cards, "punch", "EDGE", catalogue, fixture)
         call read_outline(cards, cards%integer("SHAPE"), .false., catalogue, fixture)
         call check_edge(cards, fixture, minval(fixture%body%outlines(1)%half), catalogue)
      case ("FIXTURE_BAR")
         call read_body(cards, "bar", "RADIUS", catalogue, fixture)
         call read_axis(cards, catalogue, fixture)
      case default ! *FIXTURE_CLAMP
         call read_head(cards, "clamp", catalogue, fixture)
         fixture%is_clamp = .true.
         fixture%force = cards%real("FORCE")
         fixture%stiffness = cards%real("STIFF")
         call find_curve(cards, 1, catalogue, model%curves, fixture%curve)
         call read_ring(cards, catalogue, fixture)
      end select
      model%fixtures = [model%fixtures, fixture]
   end subroutine read_fixture

   !> Two edges fit into the width
   subroutine check_edge(cards, fixture, half_width, catalogue)
      type(cards_type), intent(in) :: cards
      type(fixture_type), intent(in) :: fixture
      !> Half of its width
      real(wp), intent(in) :: half_width
      type(catalogue_type), intent(inout) :: catalogue

      if (fixture%body%edge > half_width) call catalogue%refuse(cards, "EDGE", "the " &
         & //fixture%kind//" is narrower than its two edges", "an edge of half the width of the " &
         & //fixture%kind//" at most")
   end subroutine check_edge

   !> Axis of a bar
   subroutine read_axis(cards, catalogue, fixture)
      type(cards_type), intent(in) :: cards
      type(catalogue_type), intent(inout) :: catalogue
      !> Gets its outline
      type(fixture_type), intent(inout) :: fixture

      associate (first => cards%reals(["X1", "Y1"]), last => cards%reals(["X2", "Y2"]))
         if (norm2(last - first) > 0.0_wp) then
            fixture%body%outlines = [strip_outline(first, last, fixture%body%edge)]
         else
            call catalogue%refuse(cards, "X2", "the bar has no length", "two ends that are apart")
         end if
      end associate
   end subroutine read_axis

   !> Number, face, distance, edge, friction and motion of a rigid body
   subroutine read_body(cards, kind, edge, catalogue, fixture)
      type(cards_type), intent(in) :: cards
      !> What it is, and the field of the radius of its edges
      character(*), intent(in) :: kind, edge
      type(catalogue_type), intent(inout) :: catalogue
      type(fixture_type), intent(out) :: fixture

      call read_head(cards, kind, catalogue, fixture)
      fixture%gap = cards%real("GAP")
      fixture%body%edge = cards%real(edge)
      call read_motion(cards, catalogue, fixture%motion)
   end subroutine read_body

   !> Number, face and friction of a fixture
   subroutine read_head(cards, kind, catalogue, fixture)
      type(cards_type), intent(in) :: cards
      !> What it is
      character(*), intent(in) :: kind
      type(catalogue_type), intent(inout) :: catalogue
      type(fixture_type), intent(out) :: fixture

      call catalogue%define(a_fixture, cards, "FID")
      fixture%id = cards%integer("FID")
      fixture%kind = kind
      fixture%face = cards%integer("FACE")
      fixture%body%upward = -fixture%face
      allocate (fixture%body%outlines(0))
      call read_friction(cards, catalogue, fixture%friction)
      fixture%line = cards%line_of("FID")
   end subroutine read_head

   !> Outline of a rectangle or a circle; none for shape 0
   subroutine read_outline(cards, shape_number, is_hole, catalogue, fixture)
      type(cards_type), intent(in) :: cards
      !> `a_rectangle`, `a_circle` or 0
      integer, intent(in) :: shape_number
      !> Whether the body lies outside of it
      logical, intent(in) :: is_hole
      type(catalogue_type), intent(inout) :: catalogue
      !> Gets the outline
      type(fixture_type), intent(inout) :: fixture

      type(outline_type) :: outline
      real(wp) :: centre(2), sides(2)

      centre(:) = cards%reals(["XC", "YC"])
      sides(:) = cards%reals(["LX", "LY"])
      associate (radius => cards%real("RADIUS"))
         if (shape_number == a_rectangle) then
            outline = rectangle_outline(centre, sides, radius, is_hole)
            if (minval(sides) <= 0.0_wp) call catalogue%refuse(cards, "LX", &
               & "the rectangle has no area", "LX and LY above 0")
            if (2.0_wp*radius > minval(sides)) call catalogue%refuse(cards, "RADIUS", &
               & "the corners are rounder than the rectangle is wide", &
               & "half of its shorter side at most")
         else if (shape_number == a_circle) then
            outline = circle_outline(centre, radius, is_hole)
            if (radius <= 0.0_wp) call catalogue%refuse(cards, "RADIUS", &
               & "the circle has no radius", "RADIUS above 0")
         else
            return
         end if
      end associate
      fixture%body%outlines = [outline]
   end subroutine read_outline

   !> Outlines of a ring, or of a circle where there is no inner radius
   subroutine read_ring(cards, catalogue, fixture)
      type(cards_type), intent(in) :: cards
      type(catalogue_type), intent(inout) :: catalogue
      !> Gets the outlines
      type(fixture_type), intent(inout) :: fixture

      associate (centre => cards%reals(["XC", "YC"]), inner => cards%real("RI"), &
         & outer => cards%real("RO"))
         fixture%body%outlines = [circle_outline(centre, outer, .false.)]
         if (inner > 0.0_wp) fixture%body%outlines = [fixture%body%outlines, &
            & circle_outline(centre, inner, .true.)]
         if (inner >= outer) call catalogue%refuse(cards, "RO", &
            & "the outer radius is not above the inner one", "RO above RI")
      end associate
   end subroutine read_ring

end module plydyn_input_read_fixture
