!> The part of the listing on what the deck of a restart changes.
module plydyn_io_listing_changes
   use plydyn_base_precision, only : wp
   use plydyn_base_text, only : text
   use plydyn_io_listing_table, only : write_section
   use plydyn_method_simulation, only : simulation_type
   use plydyn_model_control, only : control_type
   implicit none
   private

   public :: write_changes

   !> Width of the kinds of things, in characters
   integer, parameter :: kind_width = 24

contains

   !> One line for each kind of thing that the deck changes; nothing without such a deck
   subroutine write_changes(unit, deck, simulation)
      !> Unit of the listing
      integer, intent(in) :: unit
      !> Path of the deck, empty for none
      character(*), intent(in) :: deck
      !> Has the changes, and the state from which the run continues
      class(simulation_type), intent(in) :: simulation

      integer :: i
      character(kind_width) :: kind

      if (len(deck) == 0) return
      call write_section(unit, "Changed by "//deck)
      associate (model => simulation%model, state => simulation%state)
         do i = 1, size(model%change_list)
            kind = model%change_list(i)%kind
            write (unit, "(2a)") kind, model%change_list(i)%words
         end do
         kind = "the run ends at"
         write (unit, "(6a,/)") kind, "time ", text(state%end%time), " ", &
            & trim(model%control%units%time), &
            & trim(merge(", or before", "           ", ends_before(model%control, &
            & state%end%cycle)))
      end associate
      flush (unit)
   end subroutine write_changes

   !> Whether something else than the time may end the run
   pure logical function ends_before(control, cycle)
      type(control_type), intent(in) :: control
      !> Last cycle, 0 for none
      integer, intent(in) :: cycle

      ends_before = cycle > 0 .or. control%rest_share > 0.0_wp .or. control%load_share > 0.0_wp
   end function ends_before

end module plydyn_io_listing_changes
