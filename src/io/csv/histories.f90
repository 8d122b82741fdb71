!> All histories of a model, whether or not the deck asks for them.
module plydyn_io_csv_histories
   use plydyn_io_csv_body_history, only : contact_history_type, fixture_history_type, &
      & impactor_history_type
   use plydyn_io_csv_damage_history, only : crack_history_type, delamination_history_type
   use plydyn_io_csv_energy_history, only : energy_history_type
   use plydyn_io_csv_history_recorder, only : history_recorder_type
   use plydyn_io_csv_node_history, only : node_history_type
   use plydyn_io_csv_profile, only : profile_file_type
   use plydyn_io_csv_support_history, only : constraint_history_type, support_history_type
   use plydyn_model_model, only : model_type
   implicit none
   private

   public :: all_histories

   !> One history of a list
   type, public :: history_item_type
      class(history_recorder_type), allocatable :: item
   end type history_item_type

contains

   !> The histories, in the order in which they write
   function all_histories(model) result(list)
      !> The model
      type(model_type), intent(in) :: model
      type(history_item_type), allocatable :: list(:)

      integer :: i, n

      n = 0
      associate (impactors => size(model%impactors), fixtures => size(model%fixtures), &
         & profiles => size(model%request%profiles))
         allocate (list(7 + impactors + fixtures + profiles))
         call add(energy_history_type())
         call add(node_history_type())
         call add(support_history_type())
         call add(constraint_history_type())
         do i = 1, impactors
            call add(impactor_history_type(impactor=i))
         end do
         do i = 1, fixtures
            call add(fixture_history_type(fixture=i))
         end do
         do i = 1, profiles
            call add(profile_file_type(profile=i))
         end do
      end associate
      call add(delamination_history_type())
      call add(crack_history_type())
      call add(contact_history_type())

   contains

      !> Put a history into the next place
      subroutine add(history)
         class(history_recorder_type), intent(in) :: history

         n = n + 1
         allocate (list(n)%item, source=history)
      end subroutine add

   end function all_histories

end module plydyn_io_csv_histories
