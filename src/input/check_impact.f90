!> Checks of impactors and the plate at time zero.
module plydyn_input_check_impact
   use plydyn_base_precision, only : wp
   use plydyn_base_text, only : text
   use plydyn_deck_report, only : deck_location_type
   use plydyn_deck_values, only : number_words
   use plydyn_input_catalogue, only : an_impactor, catalogue_type
   use plydyn_model_impactor, only : contact_type
   use plydyn_model_model, only : model_type
   use plydyn_model_outer_faces, only : faces_of_part
   use plydyn_model_support, only : top_face
   implicit none
   private

   public :: check_impact

   !> Share of the radius by which a node may be inside a sphere: what is less, the contact itself
   !> judges by its own points
   real(wp), parameter :: surely = 1.0e-3_wp
   !> Sizes of the plate and the sphere beyond which their distance drowns the sizes in round-off
   real(wp), parameter :: far = 1.0e9_wp

contains

   !> No impactor begins inside the plate
   subroutine check_impact(model, catalogue)
      !> A sound model
      type(model_type), intent(in) :: model
      !> Gets findings
      type(catalogue_type), intent(inout) :: catalogue

      type(deck_location_type) :: place
      real(wp) :: inside
      integer :: i

      call check_faces(model, catalogue)
      do i = 1, size(model%contacts)
         associate (contact => model%contacts(i))
            if (min(contact%impactor, contact%part) == 0) cycle
            inside = depth(model, contact)
            place%line = catalogue%registers(an_impactor)%line(contact%impactor)
            if (inside <= surely*model%impactors(contact%impactor)%radius) then
               call check_way(model, contact, place, catalogue)
               cycle
            end if
            call catalogue%report%refuse(place, "impactor " &
               & //text(model%impactors(contact%impactor)%id)//" begins "//number_words(inside) &
               & //" inside part "//text(model%parts(contact%part)%id), &
               & "its centre so much further away, or the other FACE on *CONTACT_IMPACTOR")
         end associate
      end do
   end subroutine check_impact

   !> Bricks have an outer face where an impactor is to meet them
   subroutine check_faces(model, catalogue)
      type(model_type), intent(in) :: model
      !> Gets findings
      type(catalogue_type), intent(inout) :: catalogue

      type(deck_location_type) :: place
      integer :: i

      if (size(model%mesh%brick_id) == 0) return
      place%keyword = "*CONTACT_IMPACTOR"
      place%field = "FACE"
      do i = 1, size(model%contacts)
         associate (contact => model%contacts(i))
            if (contact%part == 0) cycle
            if (size(faces_of_part(model%mesh, contact%part, contact%face)) > 0) cycle
            place%line = contact%line
            call catalogue%report%refuse(place, "part "//text(model%parts(contact%part)%id) &
               & //" has no outer face that looks "//trim(merge("up  ", "down", &
               & contact%face == top_face)), "the other FACE, or the part whose face it is")
         end associate
      end do
   end subroutine check_faces

   !> A sphere can come to its part; a warning where only the motion of the plate could bring them
   !> together
   subroutine check_way(model, contact, place, catalogue)
      type(model_type), intent(in) :: model
      !> The impactor and the face
      type(contact_type), intent(in) :: contact
      !> Where the deck has the impactor
      type(deck_location_type), intent(in) :: place
      !> Gets findings
      type(catalogue_type), intent(inout) :: catalogue

      character(:), allocatable :: part, who
      real(wp) :: beside, high(2), low(2), side

      call find_extent(model, contact%part, low, high)
      part = " part "//text(model%parts(contact%part)%id)
      side = real(contact%face, wp)
      associate (sphere => model%impactors(contact%impactor))
         who = "impactor "//text(sphere%id)
         beside = norm2(max(low - sphere%centre(:2), sphere%centre(:2) - high, 0.0_wp))
         if (beside > far*(sphere%radius + maxval(high - low))) then
            call catalogue%report%refuse(place, who//" begins "//number_words(beside)//" beside" &
               & //part, "a centre near the part")
         else if (beside > sphere%radius .and. norm2(sphere%velocity(:2)) <= 0.0_wp) then
            call catalogue%report%warn(place, who//" passes by: its centre lies " &
               & //number_words(beside)//" beside"//part, "a centre above or below the part")
         else if (side*sphere%velocity(3) > 0.0_wp .and. side*sphere%gravity >= 0.0_wp) then
            call catalogue%report%warn(place, who//" moves away from"//part, &
               & "the other sign of VZ, or the other FACE on *CONTACT_IMPACTOR")
         end if
      end associate
   end subroutine check_way

   !> Smallest and largest x and y of a part
   subroutine find_extent(model, part, low, high)
      type(model_type), intent(in) :: model
      !> Index of the part
      integer, intent(in) :: part
      !> Its corners
      real(wp), intent(out) :: low(2), high(2)

      integer :: e

      low(:) = huge(low)
      high(:) = -huge(high)
      associate (mesh => model%mesh)
         do e = 1, size(mesh%quad_id)
            if (mesh%quad_part(e) == part) call stretch(mesh%position(:2, mesh%quad_node(:, e)))
         end do
         do e = 1, size(mesh%brick_id)
            if (mesh%brick_part(e) == part) call stretch(mesh%position(:2, mesh%brick_node(:, e)))
         end do
      end associate

   contains

      !> Let some places lie within
      subroutine stretch(place)
         real(wp), intent(in) :: place(:, :)

         low(:) = min(low, minval(place, dim=2))
         high(:) = max(high, maxval(place, dim=2))
      end subroutine stretch

   end subroutine find_extent

   !> How far a sphere reaches through the face that it is to touch, at the nodes within its reach
   pure real(wp) function depth(model, contact)
      type(model_type), intent(in) :: model
      !> The impactor and the face
      type(contact_type), intent(in) :: contact

      real(wp) :: away(3), height, side
      integer :: e, k

      depth = 0.0_wp
      side = real(contact%face, wp)
      associate (part => model%parts(contact%part), sphere => model%impactors(contact%impactor))
         height = sum(part%plies%thickness) &
            & *(part%bottom_offset + merge(1.0_wp, 0.0_wp, contact%face == top_face))
         do e = 1, size(model%mesh%quad_id)
            if (model%mesh%quad_part(e) /= contact%part) cycle
            do k = 1, size(model%mesh%quad_node, 1)
               away(:) = sphere%centre - model%mesh%position(:, model%mesh%quad_node(k, e))
               away(3) = side*(away(3) - height)
               if (norm2(away(:2)) >= sphere%radius) cycle
               ! how far the sphere must go up until it is above the node
               depth = max(depth, sqrt(sphere%radius**2 - sum(away(:2)**2)) - away(3))
            end do
         end do
      end associate
   end function depth

end module plydyn_input_check_impact
