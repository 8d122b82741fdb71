!> The lines of the listing on how long impactors will touch the plate.
module plydyn_io_listing_contact_duration
   use plydyn_base_precision, only : wp
   use plydyn_base_text, only : fixed_text, padded, text
   use plydyn_domain_contact_duration, only : contact_duration_type, estimate_contact
   use plydyn_model_model, only : model_type
   implicit none
   private

   public :: contact_duration_warning, write_contact_duration

contains

   !> A warning where the run ends before the contact, else empty
   function contact_duration_warning(model) result(words)
      type(model_type), intent(in) :: model
      character(:), allocatable :: words

      type(contact_duration_type) :: found
      character(:), allocatable :: unit
      real(wp) :: end
      integer :: k

      words = ""
      unit = " "//trim(model%control%units%time)
      do k = 1, size(model%contacts)
         call estimate_contact(model, model%contacts(k), found)
         if (.not. found%is_known) cycle
         end = found%start + found%duration
         if (model%control%end_time >= end) cycle
         words = "warning: impactor "//text(model%impactors(model%contacts(k)%impactor)%id) &
            & //" will touch the plate for about "//text(found%duration, 2)//unit//" from " &
            & //text(found%start, 2)//unit//" on, longer than the run lasts; right would be " &
            & //"ENDTIM of *CONTROL_TERMINATION above "//text(end, 2)//unit//", and " &
            & //"*CONTROL_END_OF_CONTACT for an end after the contact"
         return
      end do
   end function contact_duration_warning

   !> The estimate for one contact
   subroutine write_contact_duration(unit, model, k)
      !> Unit of the listing
      integer, intent(in) :: unit
      type(model_type), intent(in) :: model
      !> Index of the contact
      integer, intent(in) :: k

      type(contact_duration_type) :: found
      character(:), allocatable :: sides

      call estimate_contact(model, model%contacts(k), found)
      if (.not. found%is_known) return
      associate (units => model%control%units, span => found%span)
         if (minval(span) > 0.0_wp) then
            sides = "plate of "//fixed_text(span(1), 1)//" x "//fixed_text(span(2), 1)
         else
            sides = "beam of "//fixed_text(maxval(span), 1)
         end if
         write (unit, "(a,es14.7,6a)") padded("   duration, about", 29), found%duration, " ", &
            & trim(units%time), ", half a period on a simply supported ", sides, " ", &
            & trim(units%length)
      end associate
   end subroutine write_contact_duration

end module plydyn_io_listing_contact_duration
