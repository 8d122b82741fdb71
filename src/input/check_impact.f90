!> Checks of impactors: the plate and other bodies at time zero, friction that no materials have.
!> Where an impactor comes with a restart the plate has moved: its depth is judged when the contacts
!> are made on the state of the restart file.
module plydyn_input_check_impact
   use plydyn_base_precision, only : wp
   use plydyn_base_text, only : text
   use plydyn_contact_solve_coulomb, only : friction_type, largest_friction
   use plydyn_deck_report, only : deck_location_type
   use plydyn_input_catalogue, only : a_fixture, an_impactor, catalogue_type
   use plydyn_input_check_fixture, only : check_holding
   use plydyn_input_check_motion, only : check_motion, moves_plate
   use plydyn_model_approach, only : approach_type, contact_face_type, face_points, find_approach, &
      & new_contact_face
   use plydyn_model_body, only : contact_type
   use plydyn_model_model, only : model_type
   use plydyn_model_support, only : top_face
   implicit none
   private

   public :: check_impact, check_sense

   !> Share of the radius by which a node may be inside a sphere: what is less, the contact itself
   !> judges by its own points
   real(wp), parameter :: surely = 1.0e-3_wp
   !> Share of the radii by which bodies that touch may overlap
   real(wp), parameter :: round_off = 1.0e-9_wp

contains

   !> No impactor begins inside the plate
   subroutine check_impact(model, catalogue)
      !> A sound model
      type(model_type), intent(in) :: model
      !> Gets findings
      type(catalogue_type), intent(inout) :: catalogue

      type(contact_face_type) :: face
      type(deck_location_type) :: place
      real(wp) :: inside
      real(wp), allocatable :: points(:, :)
      integer :: i
      logical :: is_off, is_sound

      is_sound = .not. catalogue%report%has_errors()
      do i = 1, size(model%contacts)
         associate (contact => model%contacts(i))
            if (contact%impactor == 0) cycle
            face = new_contact_face(model, contact)
            if (size(face%facet) == 0) then
               call refuse_face(contact, catalogue)
               cycle
            end if
            points = face_points(model, face)
            inside = 0.0_wp
            if (.not. contact%is_later) inside = depth(model, contact, points)
            place = catalogue%location(an_impactor, contact%impactor)
            if (inside <= surely*model%impactors(contact%impactor)%body%radius) then
               call check_motion(model, contact, points, place, is_sound, catalogue, is_off)
               if (.not. contact%is_later) then
                  call check_approach(model, contact, place, is_off .or. .not. is_sound, catalogue)
               end if
               cycle
            end if
            call catalogue%report%refuse(place, "impactor " &
               & //text(model%impactors(contact%impactor)%id)//" begins "//text(inside) &
               & //" inside the plate", &
               & "its centre so much further away, or the other FACE on *CONTACT_IMPACTOR")
         end associate
      end do
   end subroutine check_impact

   !> Bricks have no outer face where an impactor is to meet them
   subroutine refuse_face(contact, catalogue)
      type(contact_type), intent(in) :: contact
      type(catalogue_type), intent(inout) :: catalogue

      type(deck_location_type) :: place

      place%keyword = "*CONTACT_IMPACTOR"
      place%field = "FACE"
      place%line = contact%line
      call catalogue%report%refuse(place, "no outer face of the parts looks "//trim(merge("up  ", &
         & "down", contact%face == top_face)), "the other FACE, or the part whose face it is")
   end subroutine refuse_face

   !> An impactor meets the face, not the edge, in time, and no part that the contact leaves out
   subroutine check_approach(model, contact, place, is_off, catalogue)
      type(model_type), intent(in) :: model
      type(contact_type), intent(in) :: contact
      type(deck_location_type), intent(in) :: place
      !> Whether its way has been blamed, or cannot be trusted as something in the deck is wrong
      logical, intent(in) :: is_off
      type(catalogue_type), intent(inout) :: catalogue

      type(approach_type) :: approach
      character(:), allocatable :: who
      integer :: p

      approach = find_approach(model, contact)
      if (.not. approach%is_known) return
      who = "impactor "//text(model%impactors(contact%impactor)%id)
      if (approach%arrives .and. approach%is_at_edge) then
         call catalogue%report%refuse(place, who//" touches the edge of the plate first, and " &
            & //"there is no contact at edges", "a position or a motion with which it first " &
            & //"touches the face that FACE of *CONTACT_IMPACTOR names")
      else if (.not. (approach%arrives .or. is_off) .and. approach%distance > 0.0_wp &
         & .and. .not. moves_plate(model, contact%face, contact%impactor)) then
         call catalogue%report%warn(place, who//" does not reach the plate before the end", &
            & "a later ENDTIM of *CONTROL_TERMINATION, or a centre nearer to the plate")
      end if
      if (size(contact%parts) == 0) return
      do p = 1, size(model%parts)
         if (any(contact%parts == p)) cycle
         if (.not. reaches_over(model, contact, approach%centre(:2), p)) cycle
         call catalogue%report%warn(place, who//" lies over part " &
            & //text(model%parts(p)%id)//", too, which its contact leaves out", &
            & "PID 0 on *CONTACT_IMPACTOR for all parts")
      end do
   end subroutine check_approach

   !> Whether an impactor lies over a node of a part
   pure logical function reaches_over(model, contact, place, part)
      type(model_type), intent(in) :: model
      type(contact_type), intent(in) :: contact
      !> Its centre in the plane, length
      real(wp), intent(in) :: place(2)
      !> Index of the part
      integer, intent(in) :: part

      type(contact_type) :: other
      real(wp), allocatable :: points(:, :)
      integer :: i

      other = contact
      other%parts = [part]
      points = face_points(model, new_contact_face(model, other))
      reaches_over = .false.
      associate (radius => model%impactors(contact%impactor)%body%radius)
         do i = 1, size(points, 2)
            reaches_over = norm2(points(:2, i) - place) < radius
            if (reaches_over) return
         end do
      end associate
   end function reaches_over

   !> How far an impactor must go up until it is above the face that it is to touch
   pure real(wp) function depth(model, contact, points)
      type(model_type), intent(in) :: model
      type(contact_type), intent(in) :: contact
      !> Points of the face, (3, points)
      real(wp), intent(in) :: points(:, :)

      integer :: i

      depth = 0.0_wp
      associate (own => model%impactors(contact%impactor))
         do i = 1, size(points, 2)
            depth = max(depth, -own%body%vertical_gap(own%centre - points(:, i), contact%face))
         end do
      end associate
   end function depth

   !> Refuse bodies in one place, and warn of those that do nothing
   subroutine check_sense(model, catalogue)
      !> A sound model
      type(model_type), intent(in) :: model
      !> Gets findings
      type(catalogue_type), intent(inout) :: catalogue

      integer :: i

      do i = 1, size(model%contacts)
         call check_places(model, i, catalogue)
         associate (contact => model%contacts(i))
            call check_friction(contact%friction, catalogue%location(an_impactor, &
               & contact%impactor), "the contact of impactor " &
               & //text(model%impactors(contact%impactor)%id), catalogue)
         end associate
      end do
      do i = 1, size(model%fixtures)
         call check_friction(model%fixtures(i)%friction, catalogue%location(a_fixture, i), &
            & "fixture "//text(model%fixtures(i)%id), catalogue)
      end do
      call check_holding(model, catalogue)
   end subroutine check_sense

   !> An impactor, those before it and the fixtures of its face have places of their own
   subroutine check_places(model, i, catalogue)
      type(model_type), intent(in) :: model
      !> Index of the contact
      integer, intent(in) :: i
      type(catalogue_type), intent(inout) :: catalogue

      type(deck_location_type) :: place
      real(wp) :: apart, depth, inward(2), nearest
      integer :: k

      place = catalogue%location(an_impactor, model%contacts(i)%impactor)
      associate (own => model%impactors(model%contacts(i)%impactor))
         do k = 1, i - 1
            associate (other => model%impactors(model%contacts(k)%impactor))
               apart = norm2(own%centre - other%centre)
               nearest = own%body%radius + other%body%radius
               if (apart >= nearest*(1.0_wp - round_off)) cycle
               call catalogue%report%refuse(place, "impactor "//text(own%id)//" is in the place " &
                  & //"of impactor "//text(other%id)//", "//text(apart)//" apart", &
                  & "centres at least "//text(nearest)//" apart, the sum of both radii", &
                  & catalogue%registers(an_impactor)%line(model%contacts(k)%impactor))
            end associate
         end do
         do k = 1, size(model%fixtures)
            if (model%fixtures(k)%face /= model%contacts(i)%face) cycle
            call model%fixtures(k)%body%find_depth(own%centre(:2), depth, inward)
            if (depth <= -own%body%radius) cycle
            if (depth <= 0.0_wp) then
               call catalogue%report%warn(place, "fixture "//text(model%fixtures(k)%id) &
                  & //" begins "//text(-depth)//" beside the axis of impactor "//text(own%id) &
                  & //", inside of its radius of "//text(own%body%radius)//", and rigid bodies " &
                  & //"pass through each other", "a fixture farther away, or on the other face", &
                  & catalogue%registers(a_fixture)%line(k))
               cycle
            end if
            call catalogue%report%refuse(place, "the centre of impactor "//text(own%id) &
               & //" is over fixture "//text(model%fixtures(k)%id)//", which is on the same face", &
               & "a fixture beside the impactor, or on the other face", &
               & catalogue%registers(a_fixture)%line(k))
         end do
      end associate
   end subroutine check_places

   !> A coefficient of friction is that of materials
   subroutine check_friction(friction, place, who, catalogue)
      type(friction_type), intent(in) :: friction
      type(deck_location_type), intent(in) :: place
      character(*), intent(in) :: who
      type(catalogue_type), intent(inout) :: catalogue

      associate (largest => max(friction%static, friction%dynamic))
         if (largest <= largest_friction) return
         call catalogue%report%warn(place, "the friction coefficient of "//who//" is " &
            & //text(largest), "0.1 to 1, as materials have it")
      end associate
   end subroutine check_friction

end module plydyn_input_check_impact
