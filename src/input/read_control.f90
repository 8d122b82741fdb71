!> Readers of title, units, time step, end and damping.
module plydyn_input_read_control
   use plydyn_base_precision, only : wp
   use plydyn_base_text, only : text
   use plydyn_deck_cards, only : cards_type
   use plydyn_input_catalogue, only : a_curve, catalogue_type
   use plydyn_input_units, only : derived_units
   use plydyn_model_control, only : all_explicit, implicit_interfaces, implicit_thickness, &
      & total_lagrangian
   use plydyn_model_model, only : model_type
   use plydyn_model_support, only : all_planes
   implicit none
   private

   public :: check_control_timestep, read_control_layerwise, read_control_termination, &
      & read_control_timestep, read_control_units, read_plain_control

   !> Share of a step below which two are the same
   real(wp), parameter :: round_off = 1.0e-9_wp

contains

   !> Keywords whose fields are components of the model as they stand
   subroutine read_plain_control(cards, catalogue, model)
      type(cards_type), intent(in) :: cards
      type(catalogue_type), intent(inout) :: catalogue
      type(model_type), intent(inout) :: model

      associate (control => model%control)
         select case (cards%name)
         case ("TITLE"); model%title = cards%word("TITLE")
         case ("CONTROL_PARALLEL"); control%threads = cards%integer("NCPU")
         case ("DAMPING_GLOBAL"); control%damping = cards%real("VALDMP")
         case ("DAMPING_RELAXATION"); control%rest_share = cards%real("DRTOL")
         case default ! *CONTROL_QUASI_STATIC
            control%kinetic_limit = cards%real("SHARE")
            control%load_share = cards%real("FALL")
         end select
      end associate
   end subroutine read_plain_control

   !> *CONTROL_UNITS: names of units
   subroutine read_control_units(cards, catalogue, model)
      type(cards_type), intent(in) :: cards
      type(catalogue_type), intent(inout) :: catalogue
      type(model_type), intent(inout) :: model

      if (.not. (cards%has("LENGTH") .and. cards%has("TIME") .and. cards%has("MASS"))) return
      model%control%units = derived_units(cards%word("LENGTH"), cards%word("TIME"), &
         & cards%word("MASS"))
   end subroutine read_control_units

   !> *CONTROL_TERMINATION: last time and cycle
   subroutine read_control_termination(cards, catalogue, model)
      type(cards_type), intent(in) :: cards
      type(catalogue_type), intent(inout) :: catalogue
      type(model_type), intent(inout) :: model

      model%control%end_time = cards%real("ENDTIM") &
         & + catalogue%times%of_line(cards%line_of("ENDTIM"))
      catalogue%end_is_reported = .not. cards%is_fine("ENDTIM")
      if (model%control%planned_end <= 0.0_wp) model%control%planned_end = model%control%end_time
      model%control%end_cycle = cards%integer("ENDCYC")
      model%control%smallest_share = cards%real("DTMIN")
      model%control%check_only = cards%integer("NOSOL") == 1
      if (model%control%check_only) then
         call catalogue%report%note(cards%place("NOSOL"), "NOSOL is 1", &
            & "the deck is checked and not run")
      end if
   end subroutine read_control_termination

   !> *CONTROL_TIMESTEP: first step, share of the stable one, mass scaling, bound
   subroutine read_control_timestep(cards, catalogue, model)
      type(cards_type), intent(in) :: cards
      type(catalogue_type), intent(inout) :: catalogue
      type(model_type), intent(inout) :: model

      model%control%first_step = cards%real("DTINIT")
      model%control%step_factor = cards%real("TSSFAC")
      model%control%mass_scaled_step = max(0.0_wp, -cards%real("DT2MS"))
      if (cards%real("DT2MS") > 0.0_wp) call catalogue%refuse(cards, "DT2MS", "a positive value, " &
         & //"which adds mass to all elements until they have the same stable step, is not " &
         & //"supported", "a negative value: elements with a stable step below -DT2MS get mass " &
         & //"added until they reach it")
      ! of the card of a restart all fields count
      model%control%step_curve = 0
      if (cards%integer("LCTM") > 0) then
         call catalogue%find(a_curve, cards, "LCTM", model%control%step_curve)
         model%control%curve_line = cards%line_of("LCTM")
      end if
      if (model%control%step_curve == 0) return
      if (all(model%curves(model%control%step_curve)%y > 0.0_wp)) return
      call catalogue%refuse(cards, "LCTM", "the curve bounds the step by 0 or less somewhere", &
         & "a curve with ordinates above 0")
   end subroutine read_control_timestep

   !> Refuse mass that is added for a step that is not taken
   subroutine check_control_timestep(cards, catalogue, model)
      type(cards_type), intent(in) :: cards
      type(catalogue_type), intent(inout) :: catalogue
      type(model_type), intent(inout) :: model

      real(wp) :: bound, step

      associate (control => model%control)
         step = control%step_factor*control%mass_scaled_step
         bound = huge(1.0_wp)
         if (control%largest_step > 0.0_wp) bound = control%largest_step
         if (control%step_curve > 0) bound = min(bound, maxval(model%curves(control%step_curve)%y))
         if (cards%real("DT2MS") >= 0.0_wp .or. step*(1.0_wp - round_off) <= bound) return
      end associate
      call catalogue%refuse(cards, "DT2MS", "mass would be added for a step of "//text(step) &
         & //", TSSFAC times -DT2MS, but DTMAX of *CONTROL_LAYERWISE or the curve LCTM keeps it " &
         & //"at "//text(bound), "a DT2MS nearer to 0, or a larger bound")
   end subroutine check_control_timestep

   !> *CONTROL_LAYERWISE: strain measure, limit of the energy balance, what is implicit
   subroutine read_control_layerwise(cards, catalogue, model)
      type(cards_type), intent(in) :: cards
      type(catalogue_type), intent(inout) :: catalogue
      type(model_type), intent(inout) :: model

      associate (control => model%control)
         control%kinematics = cards%integer("KINEM")
         control%energy_limit = cards%real("ENGLIM")
         control%scheme = cards%integer("IMPL")
         control%largest_step = cards%real("DTMAX")
         control%step_line = cards%line_of("DTMAX")
         if (control%kinematics == total_lagrangian) then
            control%volume_limit = cards%real("VOLLIM")
         else if (abs(cards%real("VOLLIM")) > 0.0_wp) then
            call catalogue%warn_idle(cards, "VOLLIM", "KINEM 1")
         end if
         if (control%scheme == all_explicit) return
         if (size(model%mesh%brick_id) > 0) then
            call catalogue%refuse(cards, "IMPL", "bricks (*ELEMENT_SOLID) have explicit time " &
               & //"integration only", "0")
         else if (size(model%constraints) > 0) then
            call catalogue%refuse(cards, "IMPL", "*CONSTRAINED_LINEAR_GLOBAL and " &
               & //"*CONSTRAINED_FACE_LINEAR need explicit time integration", "0, or no " &
               & //"constraint")
         else if (control%scheme == implicit_interfaces .and. .not. has_interfaces(model)) then
            ! the card that joins plies may be the one that is wrong
            if (.not. catalogue%report%has_errors()) call catalogue%refuse(cards, "IMPL", &
               & "1 makes interfaces implicit, but no plies are joined by one", &
               & "0, or *INTERFACE_COHESIVE between plies")
         else if (control%scheme == implicit_thickness &
            & .and. any(model%motions%face /= all_planes)) then
            call catalogue%refuse(cards, "IMPL", "2, implicit through the thickness, is not " &
               & //"possible with *BOUNDARY_FACE_MOTION of one face only", &
               & "1, or *BOUNDARY_PRESCRIBED_MOTION_SET, which moves all planes")
         end if
      end associate
   end subroutine read_control_layerwise

   !> Whether an interface lies between any two plies
   pure logical function has_interfaces(model)
      type(model_type), intent(in) :: model
      integer :: p

      has_interfaces = .false.
      do p = 1, size(model%parts)
         if (.not. allocated(model%parts(p)%joint)) cycle
         has_interfaces = has_interfaces .or. any(model%parts(p)%joint > 0)
      end do
   end function has_interfaces

end module plydyn_input_read_control
