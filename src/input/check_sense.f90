!> Impactors that are in another body's place, and friction that no materials have.
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

   !> Share of the radii by which bodies that touch may overlap
   real(wp), parameter :: round_off = 1.0e-9_wp

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
      real(wp) :: apart, depth, inward(2), nearest
      integer :: k

      place = catalogue%location(an_impactor, model%contacts(i)%impactor)
      associate (own => model%impactors(model%contacts(i)%impactor))
         do k = 1, i - 1
            if (model%contacts(k)%impactor == 0) cycle
            associate (other => model%impactors(model%contacts(k)%impactor))
               apart = norm2(own%centre - other%centre)
               nearest = own%body%radius + other%body%radius
               if (apart >= nearest*(1.0_wp - round_off)) cycle
               call catalogue%report%refuse(place, "impactor "//text(own%id)//" is in the place " &
                  & //"of impactor "//text(other%id)//", "//text(apart)//" apart", &
                  & "centres at least "//text(nearest)//" apart, the sum of both radii")
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
                  & //"pass through each other", "a fixture farther away, or on the other face")
               cycle
            end if
            call catalogue%report%refuse(place, "the centre of impactor "//text(own%id) &
               & //" is over fixture "//text(model%fixtures(k)%id)//", which is on the same face", &
               & "a fixture beside the impactor, or on the other face")
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

end module plydyn_input_check_sense
