!> Keywords of impactors and their contact.
module plydyn_input_impactor
   use plydyn_base_precision, only : wp
   use plydyn_base_text, only : text
   use plydyn_contact_bodies_revolved_body, only : cone_body, cylinder_body, sphere_body, tup_body
   use plydyn_deck_declaration, only : extension
   use plydyn_input_card_visitor, only : card_visitor_type
   use plydyn_input_catalogue, only : a_contact, a_part, an_impactor
   use plydyn_input_fixture, only : motion_names, visit_friction, visit_motion
   use plydyn_input_keyword_row, only : keyword_list_type, stage_laminate, stage_part
   use plydyn_model_body, only : contact_type, impactor_type, points_on_plate
   use plydyn_model_model, only : model_type
   use plydyn_model_support, only : prescribes_acceleration, prescribes_displacement
   implicit none
   private

   public :: add_impactors

   !> The kind of impactor that can rotate
   character(*), parameter :: ball = "sphere"
   !> Values of DOF, and what they are for a body that cannot rotate
   integer, parameter :: is_free = 0, is_guided = 1
   character(*), parameter :: without_rotation = "0 or 2 free to move but not to rotate, 1 " &
      & //"guided along z"
   !> Moment of inertia of a solid ball over mass and radius squared
   real(wp), parameter :: solid_ball = 0.4_wp
   !> Radians
   real(wp), parameter :: degree = acos(-1.0_wp)/180.0_wp
   !> Fields of velocity and weight
   character(2), parameter :: velocity_names(3) = ["VX", "VY", "VZ"]
   character(5), parameter :: weight_names(3) = ["GRAVX", "GRAVY", "GRAVZ"]

contains

   !> Add these keywords
   subroutine add_impactors(list)
      type(keyword_list_type), intent(inout) :: list

      call list%add("IMPACTOR_SPHERE", impactor_sphere, stage_part)
      call list%add("IMPACTOR_TUP", impactor_tup, stage_part)
      call list%add("IMPACTOR_CYLINDER", impactor_cylinder, stage_part)
      call list%add("IMPACTOR_CONE", impactor_cone, stage_part)
      call list%add("CONTACT_IMPACTOR", contact_impactor, stage_laminate)
   end subroutine add_impactors

   !> A rigid sphere
   subroutine impactor_sphere(card, model)
      class(card_visitor_type), intent(inout) :: card
      type(model_type), intent(inout) :: model

      logical :: is_half
      real(wp) :: density, radius
      type(impactor_type) :: impactor

      call visit_head(card, "A rigid sphere or hemisphere.", "the centre", impactor, radius, &
         & density)
      call card%example("11-contact", "1, 8.0, 2.0e-6, 20.0, 20.0, 8.5|0.0, 0.0, -2000.0")
      call visit_flight(card, "0 free: friction makes it rotate; 1 guided along z; 2 free to " &
         & //"move but not to rotate", impactor)
      call card%flag("SHAPE", "0 sphere, 1 hemisphere that faces the plate: half of the mass by " &
         & //"RO; contact sees the same", is_half)
      call card%card(optional=.true.)
      call card%nonnegative("INERTIA", "mass length2", "moment of inertia about the centre; 0 " &
         & //"for that of a solid ball", impactor%inertia)
      call visit_prescribed_motion(card, impactor)
      if (.not. card%reads) return
      impactor%kind = ball
      impactor%body = sphere_body(radius)
      if (is_half) then
         impactor%kind = "hemisphere"
         ! the body of contact is the whole ball
         density = 0.5_wp*density
      end if
      call end_impactor(card, density, spread(0.0_wp, 1, 3), model, impactor)
      if (impactor%inertia > 0.0_wp .and. .not. impactor%rotates) call card%refuse("INERTIA", &
         & "this impactor does not rotate", "DOF 0, or no INERTIA")
      associate (last => model%impactors(size(model%impactors)))
         if (last%inertia <= 0.0_wp) last%inertia = solid_ball*last%mass*radius**2
      end associate
   end subroutine impactor_sphere

   !> A hemisphere on a rod
   subroutine impactor_tup(card, model)
      class(card_visitor_type), intent(inout) :: card
      type(model_type), intent(inout) :: model

      real(wp) :: axis(3), density, length, radius
      type(impactor_type) :: impactor

      call visit_head(card, "A rigid hemisphere on a rod of its radius: the tup of a drop tower.", &
         & "the centre of the hemisphere", impactor, radius, density)
      call card%example("11-contact", "1, 8.0, 2.0e-6, 20.0, 20.0, 8.5|40.0|0.0, 0.0, -2000.0")
      call card%card()
      call visit_rod(card, length, axis)
      call visit_flight(card, without_rotation, impactor)
      call card%card(optional=.true.)
      call visit_prescribed_motion(card, impactor)
      if (.not. card%reads) return
      impactor%kind = "tup"
      impactor%body = tup_body(radius, length)
      call end_impactor(card, density, axis, model, impactor)
   end subroutine impactor_tup

   !> A cylinder
   subroutine impactor_cylinder(card, model)
      class(card_visitor_type), intent(inout) :: card
      type(model_type), intent(inout) :: model

      real(wp) :: axis(3), density, edge, length, radius
      type(impactor_type) :: impactor

      call visit_head(card, "A rigid cylinder: upright, a flat punch; lying, a bar.", &
         & "the middle", impactor, radius, density)
      call card%example("11-contact", "1, 5.0, 2.0e-6, 20.0, 20.0, 5.5|10.0, 1.0|0.0, 0.0, -2000.0")
      call card%card()
      call card%positive("LENGTH", "length", "length along the axis", length)
      call card%nonnegative("EDGE", "length", "radius of the edges of both end faces", edge)
      call visit_axis(card, "axis; 0 0 0 for upright", axis)
      call visit_flight(card, without_rotation, impactor)
      call card%card(optional=.true.)
      call visit_prescribed_motion(card, impactor)
      if (.not. card%reads) return
      if (edge >= min(radius, 0.5_wp*length) .and. card%is_fine("RADIUS") &
         & .and. card%is_fine("LENGTH") .and. card%is_fine("EDGE")) call card%refuse("EDGE", &
         & "the cylinder is narrower or shorter than its edges", &
         & "EDGE below RADIUS and below half of LENGTH")
      impactor%kind = "cylinder"
      impactor%body = cylinder_body(radius, length, edge)
      ! both ends are alike
      impactor%body%axis(:) = [0.0_wp, 0.0_wp, 1.0_wp]
      call end_impactor(card, density, axis, model, impactor)
   end subroutine impactor_cylinder

   !> A cone on a rod
   subroutine impactor_cone(card, model)
      class(card_visitor_type), intent(inout) :: card
      type(model_type), intent(inout) :: model

      real(wp) :: angle, axis(3), density, length, radius, tip
      type(impactor_type) :: impactor

      call visit_head(card, "A rigid cone with a round tip, on a rod.", &
         & "the middle of the circle where cone and rod meet", impactor, radius, density)
      call card%example("11-contact", "1, 5.0, 2.0e-6, 20.0, 20.0, 5.5|45.0, 1.0|0.0, 0.0, -2000.0")
      call card%card()
      call card%positive("ANGLE", "degrees", "angle between the axis and the side of the cone", &
         & angle, most=89.0_wp)
      call card%nonnegative("TIP", "length", "radius of the tip, and of the edge between cone " &
         & //"and rod; 0 for sharp", tip)
      call visit_rod(card, length, axis)
      call visit_flight(card, without_rotation, impactor)
      call card%card(optional=.true.)
      call visit_prescribed_motion(card, impactor)
      if (.not. card%reads) return
      if (tip >= radius .and. card%is_fine("RADIUS") .and. card%is_fine("TIP")) call card%refuse( &
         & "TIP", "the tip is wider than the rod", "TIP below RADIUS, or *IMPACTOR_TUP")
      impactor%kind = "cone"
      impactor%body = cone_body(radius, degree*angle, tip, length)
      call end_impactor(card, density, axis, model, impactor)
   end subroutine impactor_cone

   !> Number, size, mass and place of an impactor
   subroutine visit_head(card, sentence, centre, impactor, radius, density)
      class(card_visitor_type), intent(inout) :: card
      !> Meaning of the keyword, and what its centre is
      character(*), intent(in) :: sentence, centre
      type(impactor_type), intent(inout) :: impactor
      !> Its radius, and its density
      real(wp), intent(inout) :: radius, density

      character(:), allocatable :: title

      call card%keyword(extension, sentence, change="impactors")
      call card%title(title)
      call card%define(an_impactor, "IID", "number of the impactor", impactor%id)
      call card%positive("RADIUS", "length", "radius", radius)
      call card%nonnegative("MASS", "mass", "mass; 0 for one made from RO", impactor%mass)
      call card%real("XC", "length", "x of "//centre//" at time zero", impactor%centre(1))
      call card%real("YC", "length", "y of it", impactor%centre(2))
      call card%real("ZC", "length", "z of it", impactor%centre(3))
      call card%nonnegative("RO", "mass/length3", "density, where MASS is 0", density)
   end subroutine visit_head

   !> Length of a rod, and its axis
   subroutine visit_rod(card, length, axis)
      class(card_visitor_type), intent(inout) :: card
      real(wp), intent(inout) :: length, axis(3)

      call card%nonnegative("LENGTH", "length", "length of the rod: for its mass from RO and for " &
         & //"pictures; contact sees no end of it", length)
      call visit_axis(card, "axis from the tip to the rod; 0 0 0 for away from the face", axis)
   end subroutine visit_rod

   !> Direction of an axis
   subroutine visit_axis(card, what, axis)
      class(card_visitor_type), intent(inout) :: card
      !> Meaning
      character(*), intent(in) :: what
      !> The vector on the card
      real(wp), intent(inout) :: axis(3)

      call card%real("AX", "-", "x of the "//what, axis(1), default=0.0_wp)
      call card%real("AY", "-", "y of it", axis(2), default=0.0_wp)
      call card%real("AZ", "-", "z of it", axis(3), default=0.0_wp)
   end subroutine visit_axis

   !> Velocity, freedom and weight
   subroutine visit_flight(card, freedom, impactor)
      class(card_visitor_type), intent(inout) :: card
      !> Meaning of DOF
      character(*), intent(in) :: freedom
      type(impactor_type), intent(inout) :: impactor

      integer :: c, dof

      call card%card()
      do c = 1, 3
         call card%real(velocity_names(c), "length/time", &
            & "velocity along "//achar(iachar("w") + c) //" at time zero", impactor%velocity(c))
      end do
      call card%integer("DOF", freedom, dof, default=0, allowed=[0, 1, 2])
      call card%real("GRAVZ", "length/time2", "acceleration along z at all times", &
         & impactor%gravity(3), default=0.0_wp)
      if (.not. card%reads) return
      impactor%guided = dof == is_guided
      impactor%rotates = dof == is_free
   end subroutine visit_flight

   !> Weight along the plate, and curves of a motion
   subroutine visit_prescribed_motion(card, impactor)
      class(card_visitor_type), intent(inout) :: card
      type(impactor_type), intent(inout) :: impactor

      call card%real("GRAVX", "length/time2", "acceleration along x at all times", &
         & impactor%gravity(1), default=0.0_wp)
      call card%real("GRAVY", "length/time2", "acceleration along y at all times", &
         & impactor%gravity(2), default=0.0_wp)
      call visit_motion(card, "prescribed motion", impactor%motion)
      call card%integer("VAD", "what these curves give: 0 velocity, 1 acceleration, 2 " &
         & //"displacement", impactor%quantity, default=0, allowed=[0, 1, 2])
   end subroutine visit_prescribed_motion

   !> Axis and mass of an impactor whose body is known, and what its motion is in conflict with
   subroutine end_impactor(card, density, axis, model, impactor)
      class(card_visitor_type), intent(inout) :: card
      !> Its density, where the card has no mass
      real(wp), intent(in) :: density
      !> Vector along its axis; zero leaves that to the body, or to the contact
      real(wp), intent(in) :: axis(3)
      !> Has the curves, and gets the impactor
      type(model_type), intent(inout) :: model
      type(impactor_type), intent(inout) :: impactor

      integer :: c

      if (norm2(axis) > 0.0_wp) impactor%body%axis(:) = axis/norm2(axis)
      if (impactor%mass > 0.0_wp .and. density > 0.0_wp) call card%warn_idle("RO", "MASS 0")
      if (impactor%quantity /= 0 .and. all(impactor%motion == 0)) call card%warn_idle("VAD", &
         & "LCX, LCY or LCZ")
      if (impactor%mass <= 0.0_wp) impactor%mass = density*impactor%body%volume()
      if (impactor%mass <= 0.0_wp .and. card%is_fine("MASS")) call card%refuse("MASS", &
         & "the impactor has no mass", "MASS above 0, or RO above 0")
      if (impactor%guided .and. any(abs(impactor%velocity(:2)) > 0.0_wp)) call card%refuse("VX", &
         & "a guided impactor moves along z only", "VX = VY = 0, or DOF 0 for a free impactor")
      do c = 1, size(impactor%motion)
         if (impactor%guided .and. c < 3) then
            if (impactor%motion(c) > 0) call card%refuse(motion_names(c), &
               & "a guided impactor moves along z only", "LCZ, or DOF 0 for a free impactor")
            if (abs(impactor%gravity(c)) > 0.0_wp) call card%refuse(weight_names(c), &
               & "a guided impactor moves along z only", "GRAVZ, or DOF 0 for a free impactor")
         end if
         if (impactor%motion(c) > 0) call check_motion(card, c, model, impactor)
      end do
      model%impactors = [model%impactors, impactor]
   end subroutine end_impactor

   !> What a prescribed motion is in conflict with
   subroutine check_motion(card, c, model, impactor)
      class(card_visitor_type), intent(inout) :: card
      !> Its direction
      integer, intent(in) :: c
      type(model_type), intent(in) :: model
      type(impactor_type), intent(in) :: impactor

      real(wp) :: start

      if (abs(impactor%gravity(c)) > 0.0_wp) call card%refuse(weight_names(c), &
         & "weight does not move an impactor whose motion is prescribed", "0")
      if (abs(impactor%velocity(c)) > 0.0_wp &
         & .and. impactor%quantity /= prescribes_acceleration) then
         call card%refuse(velocity_names(c), "the motion is that of the curve "//motion_names(c), &
            & "0")
      end if
      if (impactor%quantity /= prescribes_displacement) return
      if (card%line_of(motion_names(c)) <= card%catalogue%stored_lines) return
      start = card%catalogue%start(card%root)
      if (abs(model%curves(impactor%motion(c))%at(start)) > 0.0_wp) call card%refuse( &
         & motion_names(c), "the displacement does not begin at 0", "a curve through 0 at time " &
         & //text(start)//", and XC, YC, ZC for the place then")
   end subroutine check_motion

   !> Contact of an impactor with a face of all parts, or of those named
   subroutine contact_impactor(card, model)
      class(card_visitor_type), intent(inout) :: card
      type(model_type), intent(inout) :: model

      type(contact_type) :: contact
      integer :: part

      call card%keyword(extension, "Contact between an impactor and a face of the plate.", &
         & suffixes="TITLE", change="contact faces")
      call card%example("11-contact", "1, 1, 1, 1")
      call card%define(a_contact, "CID", "number of the contact", contact%id)
      call card%refer(an_impactor, "IID", "impactor", contact%impactor)
      call card%refer(a_part, "PID", "part; 0 for all parts", part, default=0, least=0)
      call card%integer("FACE", "-1 bottom face, 1 top face", contact%face, allowed=[-1, 1])
      call card%integer("METHOD", "1 nodes on the impactor against the facets of the plate, 2 " &
         & //"points of the plate against the exact body", contact%method, default=1, &
         & allowed=[1, 2])
      call card%nonnegative("SPACING", "length", "distance between nodes on the impactor; 0 for " &
         & //"one made from the mesh", contact%spacing)
      call card%card(optional=.true.)
      call visit_friction(card, contact%friction)
      if (.not. card%reads) return
      if (contact%method == points_on_plate .and. contact%spacing > 0.0_wp) then
         call card%warn_idle("SPACING", "METHOD 1")
      end if
      contact%line = card%line_of("METHOD")
      allocate (contact%parts(0))
      if (part > 0) contact%parts = [part]
      if (contact%impactor > 0) call check_contact(card, model, contact)
      model%contacts = [model%contacts, contact]
   end subroutine contact_impactor

   !> One contact for each impactor, without friction for one that it would rotate; an axis that the
   !> impactor leaves open points away from the face
   subroutine check_contact(card, model, contact)
      class(card_visitor_type), intent(inout) :: card
      type(model_type), intent(inout) :: model
      type(contact_type), intent(in) :: contact

      if (any(model%contacts%impactor == contact%impactor)) call card%refuse("IID", &
         & "the impactor has a contact already", "one contact for each impactor")
      associate (impactor => model%impactors(contact%impactor))
         if (contact%friction%static > 0.0_wp .and. impactor%rotates &
            & .and. impactor%kind /= ball) then
            call card%refuse("FS", "friction would rotate this impactor, a "//impactor%kind &
               & //", and only a sphere can", "DOF 1 or 2 of the impactor, or FS 0")
         end if
         if (all(abs(impactor%body%axis) <= 0.0_wp)) impactor%body%axis(3) = real(contact%face, wp)
      end associate
   end subroutine check_contact

end module plydyn_input_impactor
