!> Impactors in the listing: mass and energy, contact nodes, and the way to the plate.
module plydyn_io_listing_impactors
   use plydyn_base_precision, only : wp
   use plydyn_method_contact_step, only : contacts_type
   use plydyn_model_approach, only : approach_type, find_approach
   use plydyn_model_model, only : model_type
   implicit none
   private

   public :: write_impactors

contains

   !> One line for the mass of each impactor, and more for its contact
   subroutine write_impactors(unit, model, contacts)
      integer, intent(in) :: unit
      type(model_type), intent(in) :: model
      type(contacts_type), intent(in) :: contacts

      integer :: i, k

      do i = 1, size(model%impactors)
         associate (own => model%impactors(i), units => model%control%units)
            write (unit, "(a,i0,t30,es14.7,1x,a,es14.7,1x,a)") "impactor ", own%id, own%mass, &
               & trim(units%mass)//", energy ", 0.5_wp*own%mass*sum(own%velocity**2), &
               & trim(units%energy)
            write (unit, "(a,t31,a,es14.7,1x,a)") "   body", own%kind//", radius", &
               & own%body%radius, trim(units%length)
         end associate
         do k = 1, size(model%contacts)
            if (model%contacts(k)%impactor == i) call write_contact(unit, model, contacts, k)
         end do
      end do
   end subroutine write_impactors

   !> Contact nodes, and distance until the first contact
   subroutine write_contact(unit, model, contacts, k)
      integer, intent(in) :: unit
      type(model_type), intent(in) :: model
      type(contacts_type), intent(in) :: contacts
      !> Index of the contact
      integer, intent(in) :: k

      associate (pair => contacts%pairs(k)%pair)
         if (pair%node_count() > 0) write (unit, "(a,t31,i0,a,es14.7,1x,a)") "   contact nodes", &
            & pair%node_count(), " at the start, spacing", pair%node_spacing(), &
            & trim(model%control%units%length)
      end associate
      call write_approach(unit, find_approach(model, model%contacts(k)), model%control%units%length)
   end subroutine write_contact

   !> Distance until the first contact, where it is known
   subroutine write_approach(unit, approach, length)
      integer, intent(in) :: unit
      type(approach_type), intent(in) :: approach
      !> Unit of length
      character(len=*), intent(in) :: length

      if (.not. approach%is_known) return
      if (approach%arrives) then
         write (unit, "(a,t30,es14.7,1x,a)") "   distance to first contact", approach%distance, &
            & trim(length)
      else
         write (unit, "(a,t31,a)") "   distance to first contact", "none before the end"
      end if
   end subroutine write_approach

end module plydyn_io_listing_impactors
