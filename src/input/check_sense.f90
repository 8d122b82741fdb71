!> Bodies that are in each other's place, and those that hold, load or move nothing.
module plydyn_input_check_sense
   use plydyn_base_precision, only : wp
   use plydyn_base_text, only : text
   use plydyn_contact_solve_coulomb, only : friction_type, largest_friction
   use plydyn_deck_report, only : deck_location_type
   use plydyn_input_catalogue, only : a_fixture, an_impactor, catalogue_type
   use plydyn_input_check_holding, only : check_holding
   use plydyn_model_model, only : model_type
   implicit none
   private

   public :: check_sense

contains

   !> Refuse bodies in one place, and warn of those that do nothing
   subroutine check_sense(model, catalogue)
      !> A sound model
      type(model_type), intent(in) :: model
      !> Gets findings
      type(catalogue_type), intent(inout) :: catalogue

      integer :: i

      do i = 1, size(model%contacts)
         if (model%contacts(i)%impactor == 0) cycle
         call check_places(model, i, catalogue)
         call check_motion(model, i, catalogue)
         call check_friction(model%contacts(i)%friction, catalogue%location(an_impactor, &
            & model%contacts(i)%impactor), "the contact of impactor " &
            & //text(model%impactors(model%contacts(i)%impactor)%id), catalogue)
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
      real(wp) :: depth, inward(2)
      integer :: k

      place = catalogue%location(an_impactor, model%contacts(i)%impactor)
      associate (own => model%impactors(model%contacts(i)%impactor))
         do k = 1, i - 1
            if (model%contacts(k)%impactor == 0) cycle
            associate (other => model%impactors(model%contacts(k)%impactor))
               if (norm2(own%centre - other%centre) >= max(own%body%radius, &
                  & other%body%radius)) cycle
               call catalogue%report%refuse(place, "impactor "//text(own%id)//" is in the place " &
                  & //"of impactor "//text(other%id), "centres at least both radii apart")
            end associate
         end do
         do k = 1, size(model%fixtures)
            if (model%fixtures(k)%face /= model%contacts(i)%face) cycle
            call model%fixtures(k)%body%find_depth(own%centre(:2), depth, inward)
            if (depth <= 0.0_wp) cycle
            call catalogue%report%refuse(place, "the centre of impactor "//text(own%id) &
               & //" is over fixture "//text(model%fixtures(k)%id)//", which is on the same face", &
               & "a fixture beside the impactor, or on the other face")
         end do
      end associate
   end subroutine check_places

   !> Something moves the impactor or the plate, and not away
   subroutine check_motion(model, i, catalogue)
      type(model_type), intent(in) :: model
      !> Index of the contact
      integer, intent(in) :: i
      type(catalogue_type), intent(inout) :: catalogue

      type(deck_location_type) :: place

      place = catalogue%location(an_impactor, model%contacts(i)%impactor)
      associate (own => model%impactors(model%contacts(i)%impactor), side => model%contacts(i)%face)
         if (own%motion(3) > 0) then
            associate (y => side*model%curves(own%motion(3))%y)
               if (minval(y) >= 0.0_wp .and. maxval(y) > 0.0_wp) call catalogue%report%warn(place, &
                  & "the curve of impactor "//text(own%id)//" along z leads away from the plate", &
                  & "the other sign of its values, or the other FACE on *CONTACT_IMPACTOR")
            end associate
         end if
         if (any(own%motion > 0) .or. norm2(own%velocity) > 0.0_wp &
            & .or. norm2(own%gravity) > 0.0_wp .or. moves_plate(model)) return
         call catalogue%report%warn(place, "impactor "//text(own%id)//" is at rest, and nothing " &
            & //"moves it or the plate", "a velocity, a weight or a motion of the impactor")
      end associate
   end subroutine check_motion

   !> Whether loads, supports, fixtures or an initial velocity move the plate
   pure logical function moves_plate(model)
      type(model_type), intent(in) :: model

      integer :: k

      moves_plate = size(model%motions) + size(model%initial_velocities) + size(model%point_loads) &
         & + size(model%line_loads) + size(model%pressures) + size(model%segment_loads) &
         & + size(model%body_loads) + size(model%impactors) > 1
      do k = 1, size(model%fixtures)
         moves_plate = moves_plate .or. model%fixtures(k)%is_clamp &
            & .or. any(model%fixtures(k)%motion > 0)
      end do
   end function moves_plate

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

end module plydyn_input_check_sense
