!> Readers of initial damage of interfaces.
module plydyn_input_read_initial
   use plydyn_base_precision, only : wp
   use plydyn_base_text, only : text
   use plydyn_deck_cards, only : cards_type
   use plydyn_fem_quadrature, only : quad_points
   use plydyn_input_catalogue, only : a_part, a_quad_set, catalogue_type
   use plydyn_input_read_interface, only : find_interfaces
   use plydyn_model_initial, only : initial_damage_type
   use plydyn_model_model, only : model_type
   implicit none
   private

   public :: read_initial_damage

contains

   !> *INITIAL_DELAMINATION and *INITIAL_DAMAGE: damage of interfaces at time zero
   subroutine read_initial_damage(cards, catalogue, model)
      type(cards_type), intent(in) :: cards
      type(catalogue_type), intent(inout) :: catalogue
      type(model_type), intent(inout) :: model

      type(initial_damage_type) :: initial
      integer :: nth

      do nth = 1, cards%sets()
         initial = initial_damage_type()
         if (cards%name == "INITIAL_DAMAGE") initial%damage = cards%real("DAMAGE", nth)
         call catalogue%find(a_part, cards, "PID", initial%part, nth)
         if (initial%part == 0) cycle
         call find_interfaces(cards, nth, size(model%parts(initial%part)%joint), catalogue, &
            & initial%interfaces(1), initial%interfaces(2))
         call check_joints(cards, nth, model, initial, catalogue)
         call read_quads(cards, nth, catalogue, model, initial)
         if (cards%real("R", nth) > 0.0_wp) then
            initial%centre(:) = cards%reals(["X", "Y"], nth)
            initial%radius = cards%real("R", nth)
            call check_met(cards, nth, model, initial, catalogue)
         else
            call check_circle(cards, nth, catalogue)
         end if
         model%initial_damages = [model%initial_damages, initial]
      end do
   end subroutine read_initial_damage

   !> All of the interfaces can fail
   subroutine check_joints(cards, nth, model, initial, catalogue)
      type(cards_type), intent(in) :: cards
      !> Which row
      integer, intent(in) :: nth
      type(model_type), intent(in) :: model
      type(initial_damage_type), intent(in) :: initial
      type(catalogue_type), intent(inout) :: catalogue

      logical :: fails
      integer :: k

      if (catalogue%report%has_errors()) return
      do k = initial%interfaces(1), initial%interfaces(2)
         associate (joint => model%parts(initial%part)%joint(k))
            fails = joint > 0
            if (fails) fails = model%interface_materials(joint)%fails
         end associate
         if (fails) cycle
         call catalogue%refuse(cards, "IFAC1", "interface "//text(k)//" cannot fail", &
            & "*INTERFACE_COHESIVE with a material such as *MAT_COHESIVE_MIXED_MODE; faces that " &
            & //"nothing joins anywhere have MID -1 there", nth)
         return
      end do
   end subroutine check_joints

   !> Elements of the set, or all of the part
   subroutine read_quads(cards, nth, catalogue, model, initial)
      type(cards_type), intent(in) :: cards
      !> Which row
      integer, intent(in) :: nth
      type(catalogue_type), intent(inout) :: catalogue
      type(model_type), intent(in) :: model
      !> Gets its quads
      type(initial_damage_type), intent(inout) :: initial

      integer :: e, i

      if (cards%integer("SSID", nth) == 0) then
         initial%quads = pack([(e, e=1, size(model%mesh%quad_id))], &
            & model%mesh%quad_part == initial%part)
         return
      end if
      call catalogue%find_set(a_quad_set, cards, "SSID", initial%quads, nth)
      do i = 1, size(initial%quads)
         if (model%mesh%quad_part(initial%quads(i)) == initial%part) cycle
         call catalogue%refuse(cards, "SSID", "element "//text(model%mesh%quad_id( &
            & initial%quads(i)))//" of the set is not in part " &
            & //text(model%parts(initial%part)%id), "a set of elements of the part", nth)
         return
      end do
   end subroutine read_quads

   !> The circle has a point of an interface in it
   subroutine check_met(cards, nth, model, initial, catalogue)
      type(cards_type), intent(in) :: cards
      integer, intent(in) :: nth
      type(model_type), intent(in) :: model
      type(initial_damage_type), intent(in) :: initial
      type(catalogue_type), intent(inout) :: catalogue

      integer :: i, k

      if (catalogue%report%has_errors()) return
      do k = initial%interfaces(1), initial%interfaces(2)
         associate (joint => model%parts(initial%part)%joint(k))
            do i = 1, size(initial%quads)
               associate (nodes => model%mesh%quad_node(:, initial%quads(i)))
                  if (any(initial%encloses(quad_points(model%mesh%position(:2, nodes), &
                     & model%interface_materials(joint)%nodal)))) return
               end associate
            end do
         end associate
      end do
      call catalogue%refuse(cards, "R", "no point of the interfaces lies in the circle", &
         & "a circle on the elements, as large as the distance between their points", nth)
   end subroutine check_met

   !> A centre without a radius means nothing
   subroutine check_circle(cards, nth, catalogue)
      type(cards_type), intent(in) :: cards
      !> Which row
      integer, intent(in) :: nth
      type(catalogue_type), intent(inout) :: catalogue

      if (.not. cards%is_fine("R", nth)) return
      if (all(abs(cards%reals(["X", "Y"], nth)) <= 0.0_wp)) return
      call catalogue%refuse(cards, "R", "a centre is given without a radius", &
         & "a radius above 0, or X = Y = 0 for whole elements", nth)
   end subroutine check_circle

end module plydyn_input_read_initial
