!> Keywords of interfaces that are damaged or broken from the start.
module plydyn_input_initial_damage
   use plydyn_base_precision, only : wp
   use plydyn_base_text, only : text
   use plydyn_deck_declaration, only : extension
   use plydyn_fem_quadrature, only : quad_points
   use plydyn_input_card_visitor, only : card_visitor_type
   use plydyn_input_catalogue, only : a_part, a_quad_set
   use plydyn_input_cohesive, only : of_failure
   use plydyn_input_keyword_row, only : keyword_list_type, stage_support
   use plydyn_model_layup, only : initial_damage_type
   use plydyn_model_model, only : model_type
   implicit none
   private

   public :: add_initial_damage, visit_range

contains

   !> Add these keywords
   subroutine add_initial_damage(list)
      type(keyword_list_type), intent(inout) :: list

      call list%add("INITIAL_DELAMINATION", initial_damage, stage_support)
      call list%add("INITIAL_DAMAGE", initial_damage, stage_support)
   end subroutine add_initial_damage

   !> Interfaces that are open or damaged from the start
   subroutine initial_damage(card, model)
      class(card_visitor_type), intent(inout) :: card
      type(model_type), intent(inout) :: model

      logical :: is_open
      type(initial_damage_type) :: initial

      is_open = card%name == "INITIAL_DELAMINATION"
      if (is_open) then
         call card%keyword(extension, "Delaminations that exist at the start of the run.")
         call card%remark("The interfaces need a material that fails, which gives their faces " &
            & //"contact and friction. The area counts as failed; its fracture energy is not " &
            & //"part of the energies. A circle must contain a point of the interfaces, see NQ " &
            & //"of *INTERFACE_COHESIVE.")
         call card%example(of_failure, "1, 1, 1, 0, 20.0, 20.0, 5.0")
      else
         call card%keyword(extension, "Damage of interfaces at the start of the run.")
         call card%remark("The damage is the damage variable of the law: with DAMAGE d the " &
            & //"interface has 1 - d of its stiffness, and dissipates the rest of its fracture " &
            & //"energy. Of two values for one point the larger counts.")
         call card%example(of_failure, "1, 1, 1, 0, 0.5, 20.0, 20.0, 5.0")
      end if
      do while (card%next())
         initial = initial_damage_type()
         call visit_place(card, model, initial)
         if (.not. is_open) call card%positive("DAMAGE", "-", "damage, above 0 and up to 1", &
            & initial%damage, most=1.0_wp)
         call visit_circle(card, model, initial)
      end do
   end subroutine initial_damage

   !> Part and a range of its interfaces
   subroutine visit_range(card, model, part, range)
      class(card_visitor_type), intent(inout) :: card
      type(model_type), intent(in) :: model
      !> Index of the part, 0 for one that is not defined
      integer, intent(inout) :: part
      !> First and last interface; empty where there are no such interfaces, which is reported
      integer, intent(inout) :: range(2)

      call card%refer(a_part, "PID", "part", part)
      call card%integer("IFAC1", "first interface; 0 with IFAC2 = 0 for all", range(1), least=0)
      call card%integer("IFAC2", "last interface", range(2), least=0)
      if (.not. card%reads .or. part == 0) return
      associate (count => size(model%parts(part)%joint))
         if (all(range == 0) .and. count > 0) then
            range(:) = [1, count]
         else if (range(1) < 1 .or. range(2) < range(1) .or. range(2) > count) then
            call card%refuse(merge("IFAC1", "IFAC2", range(1) < 1 .or. range(1) > count), &
               & "interfaces "//text(range(1))//" to "//text(range(2))//" do not exist", &
               & "a range within the "//text(count)//" interfaces of the part, or 0 and 0 for all")
            range(:) = [1, 0]
         end if
      end associate
   end subroutine visit_range

   !> Part, interfaces and elements
   subroutine visit_place(card, model, initial)
      class(card_visitor_type), intent(inout) :: card
      type(model_type), intent(in) :: model
      type(initial_damage_type), intent(inout) :: initial

      integer :: e, i, part

      call visit_range(card, model, initial%part, initial%interfaces)
      call card%members(a_quad_set, "SSID", "set of elements; 0 for all of the part", &
         & initial%quads, default=0, least=0)
      part = initial%part
      if (.not. card%reads .or. part == 0) return
      call check_joints(card, model, initial)
      if (.not. allocated(initial%quads)) then
         initial%quads = pack([(e, e=1, size(model%mesh%quad_id))], model%mesh%quad_part == part)
         return
      end if
      i = findloc(model%mesh%quad_part(initial%quads) /= part, .true., 1)
      if (i > 0) call card%refuse("SSID", "element "//text(model%mesh%quad_id(initial%quads(i))) &
         & //" of the set is not in part "//text(model%parts(part)%id), &
         & "a set of elements of the part")
   end subroutine visit_place

   !> All of the interfaces can fail
   subroutine check_joints(card, model, initial)
      class(card_visitor_type), intent(inout) :: card
      type(model_type), intent(in) :: model
      type(initial_damage_type), intent(in) :: initial

      logical :: fails
      integer :: k

      if (card%catalogue%report%has_errors()) return
      do k = initial%interfaces(1), initial%interfaces(2)
         associate (joint => model%parts(initial%part)%joint(k))
            fails = joint > 0
            if (fails) fails = model%interface_materials(joint)%fails
         end associate
         if (fails) cycle
         call card%refuse("IFAC1", "interface "//text(k)//" cannot fail", "*INTERFACE_COHESIVE " &
            & //"with a material such as *MAT_COHESIVE_MIXED_MODE; faces that nothing joins " &
            & //"anywhere have MID -1 there")
         return
      end do
   end subroutine check_joints

   !> Circle that bounds what is broken
   subroutine visit_circle(card, model, initial)
      class(card_visitor_type), intent(inout) :: card
      !> Gets the damage
      type(model_type), intent(inout) :: model
      type(initial_damage_type), intent(inout) :: initial

      real(wp) :: centre(2), radius

      call card%real("X", "length", "x of the centre of a circle", centre(1), default=0.0_wp)
      call card%real("Y", "length", "y of the centre of a circle", centre(2), default=0.0_wp)
      call card%nonnegative("R", "length", "only points within this distance of the centre; 0 " &
         & //"for whole elements", radius)
      if (.not. card%reads .or. initial%part == 0) return
      if (radius > 0.0_wp) then
         initial%centre(:) = centre
         initial%radius = radius
         call check_met(card, model, initial)
      else if (any(abs(centre) > 0.0_wp) .and. card%is_fine("R")) then
         call card%refuse("R", "a centre is given without a radius", &
            & "a radius above 0, or X = Y = 0 for whole elements")
      end if
      model%initial_damages = [model%initial_damages, initial]
   end subroutine visit_circle

   !> The circle has a point of an interface in it
   subroutine check_met(card, model, initial)
      class(card_visitor_type), intent(inout) :: card
      type(model_type), intent(in) :: model
      type(initial_damage_type), intent(in) :: initial

      integer :: i, k

      if (card%catalogue%report%has_errors()) return
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
      call card%refuse("R", "no point of the interfaces lies in the circle", &
         & "a circle on the elements, as large as the distance between their points")
   end subroutine check_met

end module plydyn_input_initial_damage
