!> Empty model, and defaults for what its deck does not give.
module plydyn_input_defaults
   use plydyn_base_precision, only : wp
   use plydyn_deck_deck, only : deck_type
   use plydyn_input_read_mesh, only : new_mesh
   use plydyn_law_law, only : scalar_names, shows_fibre_damage, shows_shear_damage
   use plydyn_model_model, only : model_type
   implicit none
   private

   public :: begin_model, end_model

   !> Field states of a run that does not say how many
   integer, parameter :: usual_states = 20
   !> Lines of the history of delamination, likewise
   integer, parameter :: usual_lines = 1000
   !> Profiles of each place, likewise
   integer, parameter :: usual_profiles = 100

contains

   !> An empty model
   subroutine begin_model(model)
      type(model_type), intent(inout) :: model

      model%title = ""
      model%mesh = new_mesh()
      allocate (model%parts(0), model%materials(0), model%interface_materials(0))
      allocate (model%change_list(0))
      allocate (model%curves(0), model%supports(0), model%motions(0), model%initial_velocities(0))
      allocate (model%constraints(0), model%initial_damages(0))
      allocate (model%point_loads(0), model%line_loads(0), model%pressures(0))
      allocate (model%segment_loads(0), model%body_loads(0))
      allocate (model%impactors(0), model%contacts(0), model%fixtures(0))
      allocate (model%request%fields(0), model%request%nodes(0), model%request%profiles(0))
   end subroutine begin_model

   !> What the deck does not say
   subroutine end_model(deck, model)
      type(deck_type), intent(in) :: deck
      type(model_type), intent(inout) :: model

      integer :: i

      do i = 1, size(model%materials)
         model%materials(i)%place = place_of(deck, model%materials(i)%line)
         model%materials(i)%radius_place = place_of(deck, model%materials(i)%radius_line)
      end do
      model%control%curve_place = place_of(deck, model%control%curve_line)
      model%control%step_place = place_of(deck, model%control%step_line)
      do i = 1, size(model%contacts)
         model%contacts(i)%place = place_of(deck, model%contacts(i)%line)
      end do
      do i = 1, size(model%request%profiles)
         if (model%request%profiles(i)%interval < 0.0_wp) then
            model%request%profiles(i)%interval = model%control%planned_end/usual_profiles
         end if
         model%request%profiles(i)%place = place_of(deck, model%request%profiles(i)%line)
      end do
      associate (request => model%request)
         if (size(request%fields) == 0) then
            request%fields = [character(len(request%fields)) :: &
               & "displacement", "velocity", "stress"]
            if (any(model%materials%is_damaged())) request%fields = [request%fields, &
               & scalar_names(shows_fibre_damage:shows_shear_damage)]
         end if
         if (request%field_interval <= 0.0_wp) then
            request%field_interval = model%control%planned_end/usual_states
         end if
         if (request%delamination_interval < 0.0_wp) then
            request%delamination_interval = model%control%planned_end/usual_lines
         end if
      end associate
   end subroutine end_model

   !> File and number of a line, empty for none
   pure function place_of(deck, line) result(place)
      type(deck_type), intent(in) :: deck
      !> Index of the line
      integer, intent(in) :: line
      character(:), allocatable :: place

      place = ""
      if (line > 0) place = deck%source%where(line)
   end function place_of

end module plydyn_input_defaults
