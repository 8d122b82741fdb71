!> All histories that the deck may ask for.
module plydyn_io_csv_histories
   use plydyn_base_precision, only : wp
   use plydyn_base_text, only : text
   use plydyn_io_csv_body_history, only : contact_history_type, fixture_history_type, &
      & impactor_history_type
   use plydyn_io_csv_damage_history, only : crack_history_type, delamination_history_type
   use plydyn_io_csv_energy_history, only : energy_history_type
   use plydyn_io_csv_history_recorder, only : history_recorder_type
   use plydyn_io_csv_node_history, only : node_history_type
   use plydyn_io_csv_profile, only : profile_file_type
   use plydyn_io_csv_support_history, only : constraint_history_type, support_history_type
   use plydyn_method_simulation, only : simulation_type
   implicit none
   private

   public :: all_histories

   !> One history of a list
   type, public :: history_item_type
      class(history_recorder_type), allocatable :: item
   end type history_item_type

contains

   !> The histories, in the order in which they write: those that say in `prepare` whether the deck
   !> asks for them, and others if it does
   function all_histories(simulation) result(list)
      !> Has the model and the domain
      class(simulation_type), intent(in) :: simulation
      type(history_item_type), allocatable :: list(:)

      type(history_item_type), allocatable :: room(:)
      integer :: i, n

      n = 0
      associate (model => simulation%model, request => simulation%model%request)
         allocate (room(7 + size(model%impactors) + size(model%fixtures) + size(request%profiles)))
         call add(energy_history_type(), ".energy.csv", request%energy_interval, .true.)
         call add(node_history_type())
         call add(support_history_type())
         if (size(model%constraints) > 0 .and. request%support_interval >= 0.0_wp) then
            call add(constraint_history_type(), ".constraints.csv", request%support_interval, &
               & .false.)
         end if
         do i = 1, size(model%impactors)
            call add(impactor_history_type(impactor=i), ".impactor_" &
               & //text(model%impactors(i)%id)//".csv", request%impactor_interval, .false.)
         end do
         do i = 1, size(model%fixtures)
            call add(fixture_history_type(fixture=i), ".fixture_" &
               & //text(model%fixtures(i)%id)//".csv", request%fixture_interval, .true.)
         end do
         do i = 1, size(request%profiles)
            call add(profile_file_type(profile=i))
         end do
         call add(delamination_history_type())
         if (simulation%domain%cracks%whole > 0) call add(crack_history_type(), ".cracks.csv", &
            & request%delamination_interval, .false.)
         if (size(model%impactors) > 0) call add(contact_history_type(), ".contact.csv", &
            & request%impactor_interval, .false.)
      end associate
      allocate (list(n))
      do i = 1, n
         call move_alloc(room(i)%item, list(i)%item)
      end do

   contains

      !> Put a history into the next place
      subroutine add(history, ending, interval, reads_motion)
         class(history_recorder_type), intent(in) :: history
         !> As in `history_recorder_type` and `observer_type`
         character(*), intent(in), optional :: ending
         real(wp), intent(in), optional :: interval
         logical, intent(in), optional :: reads_motion

         n = n + 1
         allocate (room(n)%item, source=history)
         if (.not. (present(ending) .and. present(interval) .and. present(reads_motion))) return
         room(n)%item%ending = ending
         room(n)%item%interval = interval
         room(n)%item%reads_motion = reads_motion
      end subroutine add

   end function all_histories

end module plydyn_io_csv_histories
