!> Readers of impactors and contacts.
module plydyn_input_read_impact
   use plydyn_base_precision, only : wp
   use plydyn_contact_bodies_revolved_body, only : cone_body, cylinder_body, sphere_body, &
      & tup_body
   use plydyn_deck_cards, only : cards_type
   use plydyn_input_catalogue, only : a_contact, a_part, an_impactor, catalogue_type
   use plydyn_input_rigid_body, only : motion_names, read_friction, read_motion
   use plydyn_model_impactor, only : contact_type, impactor_type
   use plydyn_model_model, only : model_type
   use plydyn_model_support, only : prescribes_acceleration, prescribes_displacement
   implicit none
   private

   public :: read_contact_impactor, read_impactor

   !> The kind of impactor that can rotate
   character(*), parameter :: ball = "sphere"
   !> Values of DOF
   integer, parameter :: is_free = 0, is_guided = 1
   !> Moment of inertia of a solid ball over mass and radius squared
   real(wp), parameter :: solid_ball = 0.4_wp
   !> Radians
   real(wp), parameter :: degree = acos(-1.0_wp)/180.0_wp
   !> Fields of velocity and weight
   character(2), parameter :: velocity_names(3) = ["VX", "VY", "VZ"]
   character(5), parameter :: weight_names(3) = ["GRAVX", "GRAVY", "GRAVZ"]

contains

   !> *IMPACTOR_SPHERE, _TUP, _CYLINDER, _CONE: a rigid body of revolution
   subroutine read_impactor(cards, catalogue, model)
      type(cards_type), intent(in) :: cards
      type(catalogue_type), intent(inout) :: catalogue
      type(model_type), intent(inout) :: model

      type(impactor_type) :: impactor

      call read_shape(cards, catalogue, impactor)
      call read_flight(cards, catalogue, model, impactor)
      if (cards%name == "IMPACTOR_SPHERE") then
         impactor%inertia = cards%real("INERTIA")
         if (impactor%inertia > 0.0_wp .and. .not. impactor%rotates) call catalogue%refuse(cards, &
            & "INERTIA", "this impactor does not rotate", "DOF 0, or no INERTIA")
         if (impactor%inertia <= 0.0_wp) then
            impactor%inertia = solid_ball*impactor%mass*impactor%body%radius**2
         end if
      end if
      model%impactors = [model%impactors, impactor]
   end subroutine read_impactor

   !> Body and axis of an impactor
   subroutine read_shape(cards, catalogue, impactor)
      type(cards_type), intent(in) :: cards
      type(catalogue_type), intent(inout) :: catalogue
      !> Gets them, and its kind
      type(impactor_type), intent(inout) :: impactor

      associate (radius => cards%real("RADIUS"))
         select case (cards%name)
         case ("IMPACTOR_SPHERE")
            impactor%kind = ball
            if (cards%integer("SHAPE") == 1) impactor%kind = "hemisphere"
            impactor%body = sphere_body(radius)
         case ("IMPACTOR_TUP")
            impactor%kind = "tup"
            impactor%body = tup_body(radius, cards%real("LENGTH"))
            call read_axis(cards, impactor)
         case ("IMPACTOR_CYLINDER")
            impactor%kind = "cylinder"
            associate (length => cards%real("LENGTH"), edge => cards%real("EDGE"))
               if (edge >= min(radius, 0.5_wp*length)) call catalogue%refuse(cards, "EDGE", &
                  & "the cylinder is narrower or shorter than its edges", &
                  & "EDGE below RADIUS and below half of LENGTH")
               impactor%body = cylinder_body(radius, length, edge)
            end associate
            call read_axis(cards, impactor)
            ! both ends are alike
            if (all(abs(impactor%body%axis) <= 0.0_wp)) impactor%body%axis(3) = 1.0_wp
         case default ! *IMPACTOR_CONE
            impactor%kind = "cone"
            associate (tip => cards%real("TIP"))
               if (tip >= radius) call catalogue%refuse(cards, "TIP", &
                  & "the tip is wider than the rod", "TIP below RADIUS, or *IMPACTOR_TUP")
               impactor%body = cone_body(radius, degree*cards%real("ANGLE"), tip, &
                  & cards%real("LENGTH"))
            end associate
            call read_axis(cards, impactor)
         end select
      end associate
   end subroutine read_shape

   !> Unit vector along the axis, zero where the card leaves it to the contact
   subroutine read_axis(cards, impactor)
      type(cards_type), intent(in) :: cards
      !> Gets the axis
      type(impactor_type), intent(inout) :: impactor

      associate (axis => cards%reals(["AX", "AY", "AZ"]))
         if (norm2(axis) > 0.0_wp) impactor%body%axis(:) = axis/norm2(axis)
      end associate
   end subroutine read_axis

   !> Number, mass and motion of an impactor whose body is known
   subroutine read_flight(cards, catalogue, model, impactor)
      type(cards_type), intent(in) :: cards
      type(catalogue_type), intent(inout) :: catalogue
      !> Has the curves
      type(model_type), intent(in) :: model
      !> Gets all of it
      type(impactor_type), intent(inout) :: impactor

      call catalogue%define(an_impactor, cards, "IID")
      impactor%id = cards%integer("IID")
      impactor%title = cards%word("TITLE")
      impactor%mass = cards%real("MASS")
      if (impactor%mass <= 0.0_wp) impactor%mass = cards%real("RO")*impactor%body%volume()
      if (impactor%mass <= 0.0_wp .and. cards%is_fine("MASS")) call catalogue%refuse(cards, &
         & "MASS", "the impactor has no mass", "MASS above 0, or RO above 0")
      impactor%centre(:) = cards%reals(["XC", "YC", "ZC"])
      impactor%velocity(:) = cards%reals(velocity_names)
      impactor%guided = cards%integer("DOF") == is_guided
      impactor%rotates = cards%integer("DOF") == is_free
      impactor%gravity(:) = cards%reals(weight_names)
      if (impactor%guided .and. any(abs(impactor%velocity(:2)) > 0.0_wp)) then
         call catalogue%refuse(cards, "VX", "a guided impactor moves along z only", &
            & "VX = VY = 0, or DOF 0 for a free impactor")
      end if
      call read_prescribed_motion(cards, catalogue, model, impactor)
   end subroutine read_flight

   !> Curves of a prescribed motion, and what they are in conflict with
   subroutine read_prescribed_motion(cards, catalogue, model, impactor)
      type(cards_type), intent(in) :: cards
      type(catalogue_type), intent(inout) :: catalogue
      !> Has the curves
      type(model_type), intent(in) :: model
      !> Gets the motion
      type(impactor_type), intent(inout) :: impactor
      integer :: c
      logical :: is_doubled

      call read_motion(cards, catalogue, impactor%motion)
      impactor%quantity = cards%integer("VAD")
      do c = 1, size(impactor%motion)
         if (impactor%guided .and. c < 3) then
            if (impactor%motion(c) > 0) call catalogue%refuse(cards, motion_names(c), &
               & "a guided impactor moves along z only", "LCZ, or DOF 0 for a free impactor")
            if (abs(impactor%gravity(c)) > 0.0_wp) call catalogue%refuse(cards, weight_names(c), &
               & "a guided impactor moves along z only", "GRAVZ, or DOF 0 for a free impactor")
         end if
         if (impactor%motion(c) == 0) cycle
         if (abs(impactor%gravity(c)) > 0.0_wp) call catalogue%refuse(cards, weight_names(c), &
            & "weight does not move an impactor whose motion is prescribed", "0")
         is_doubled = abs(impactor%velocity(c)) > 0.0_wp &
            & .and. impactor%quantity /= prescribes_acceleration
         if (is_doubled) call catalogue%refuse(cards, velocity_names(c), &
            & "the motion is that of the curve "//motion_names(c), "0")
         if (impactor%quantity /= prescribes_displacement) cycle
         if (abs(model%curves(impactor%motion(c))%at(0.0_wp)) > 0.0_wp) call catalogue%refuse( &
            & cards, motion_names(c), "the displacement does not begin at 0", &
            & "a curve through 0 at time 0, and XC, YC, ZC for the place at time 0")
      end do
   end subroutine read_prescribed_motion

   !> *CONTACT_IMPACTOR: an impactor against a face of all parts or of those named
   subroutine read_contact_impactor(cards, catalogue, model)
      type(cards_type), intent(in) :: cards
      type(catalogue_type), intent(inout) :: catalogue
      type(model_type), intent(inout) :: model

      type(contact_type) :: contact
      integer :: part

      call catalogue%define(a_contact, cards, "CID")
      call catalogue%find(an_impactor, cards, "IID", contact%impactor)
      allocate (contact%parts(0))
      if (cards%integer("PID") > 0) then
         call catalogue%find(a_part, cards, "PID", part)
         contact%parts = [part]
      end if
      if (contact%impactor > 0 .and. any(model%contacts%impactor == contact%impactor)) then
         call catalogue%refuse(cards, "IID", "the impactor has a contact already", &
            & "one contact for each impactor")
      end if
      contact%id = cards%integer("CID")
      contact%face = cards%integer("FACE")
      contact%method = cards%integer("METHOD")
      contact%spacing = cards%real("SPACING")
      contact%line = cards%line_of("METHOD")
      call read_friction(cards, catalogue, contact%friction)
      if (contact%impactor > 0 .and. contact%friction%static > 0.0_wp) then
         associate (impactor => model%impactors(contact%impactor))
            if (impactor%rotates .and. impactor%kind /= ball) call catalogue%refuse(cards, "FS", &
               & "friction would rotate this impactor, a "//impactor%kind &
               & //", and only a sphere can", &
               & "DOF 1 or 2 of the impactor, or FS 0")
         end associate
      end if
      if (contact%impactor > 0) then
         associate (axis => model%impactors(contact%impactor)%body%axis)
            ! its tip towards the plate
            if (all(abs(axis) <= 0.0_wp)) axis(3) = real(contact%face, wp)
         end associate
      end if
      model%contacts = [model%contacts, contact]
   end subroutine read_contact_impactor

end module plydyn_input_read_impact
