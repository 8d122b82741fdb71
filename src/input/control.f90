!> Keywords of the control of a run: title, units, end, time step, schemes, damping, relaxation.
module plydyn_input_control
   use plydyn_base_precision, only : wp
   use plydyn_base_text, only : text
   use plydyn_deck_declaration, only : extension, standard
   use plydyn_input_card_visitor, only : card_visitor_type
   use plydyn_input_catalogue, only : a_curve
   use plydyn_input_changes, only : control_stage, delete_body
   use plydyn_input_keyword_row, only : keyword_list_type, stage_control, stage_definition
   use plydyn_input_units, only : derived_units
   use plydyn_model_control, only : all_explicit, implicit_interfaces, implicit_thickness, &
      & total_lagrangian
   use plydyn_model_model, only : model_type
   use plydyn_model_support, only : all_planes
   implicit none
   private

   public :: add_control

   !> LS-DYNA's value for no limit on added mass
   real(wp), parameter :: no_mass_limit = 1.0e8_wp
   !> Share of a step below which two are the same
   real(wp), parameter :: round_off = 1.0e-9_wp
   !> Share of the largest kinetic energy above which a plate still moves as one sees it
   real(wp), parameter :: largest_rest = 0.1_wp

contains

   !> Add these keywords
   subroutine add_control(list)
      type(keyword_list_type), intent(inout) :: list

      call list%add("TITLE", title, stage_definition)
      call list%add("CONTROL_UNITS", control_units, stage_definition)
      call list%add("CONTROL_TERMINATION", control_termination, stage_control)
      call list%add("CONTROL_STAGE", control_stage)
      call list%add("DELETE_IMPACTOR", delete_body)
      call list%add("DELETE_FIXTURE", delete_body)
      call list%add("CONTROL_TIMESTEP", control_timestep, stage_control, check=check_mass_scaling)
      call list%add("CONTROL_ENERGY", control_energy)
      call list%add("CONTROL_PARALLEL", control_parallel, stage_control)
      call list%add("CONTROL_LAYERWISE", control_layerwise, stage_control)
      call list%add("DAMPING_GLOBAL", damping_global, stage_control)
      call list%add("DAMPING_RELAXATION", damping_relaxation, stage_control, check=check_impactors)
      call list%add("CONTROL_QUASI_STATIC", control_quasi_static, stage_control)
      call list%add("CONTROL_END_OF_CONTACT", control_end_of_contact, stage_control, &
         & check=check_contact_end)
   end subroutine add_control

   !> Title of the run
   subroutine title(card, model)
      class(card_visitor_type), intent(inout) :: card
      type(model_type), intent(inout) :: model

      call card%keyword(standard, "Title of the run.", once=.true., change="title")
      call card%example("decks.md#a-whole-deck", "A ball on a clamped plate")
      call card%text_line("TITLE", "title", model%title)
   end subroutine title

   !> Names of units
   subroutine control_units(card, model)
      class(card_visitor_type), intent(inout) :: card
      type(model_type), intent(inout) :: model

      character(:), allocatable :: length, mass, temperature, time

      call card%keyword(standard, "Names of the units of the deck, for listings and result " &
         & //"files.", once=.true.)
      call card%remark("Nothing is converted: all numbers of a deck are in one consistent set of " &
         & //"units. Force, stress and energy follow from length, time and mass. Without the " &
         & //"keyword: mm, s, t, hence N, MPa, mJ.")
      call card%example("decks.md#a-whole-deck", "mm, s, t")
      call card%word("LENGTH", "unit of length", length, "M MM CM UM IN FT", required=.true.)
      call card%word("TIME", "unit of time", time, "S SEC MS US", required=.true.)
      call card%word("MASS", "unit of mass", mass, &
         & "KG G MG T TON MTRC_TON SLINCH SLUG", required=.true.)
      call card%word("TEMP", "unit of temperature; nothing depends on it", temperature, "K C", &
         & required=.false.)
      if (.not. card%reads) return
      if (.not. (card%has("LENGTH") .and. card%has("TIME") .and. card%has("MASS"))) return
      model%control%units = derived_units(length, time, mass)
   end subroutine control_units

   !> When to stop
   subroutine control_termination(card, model)
      class(card_visitor_type), intent(inout) :: card
      type(model_type), intent(inout) :: model

      call card%keyword(standard, "When the run ends.", once=.true., change="end")
      call card%example("9-central-differences", "4.0e-4")
      associate (control => model%control)
         call card%positive("ENDTIM", "time", "last time", control%end_time)
         call card%integer("ENDCYC", "last cycle; 0 for none", control%end_cycle, default=0, &
            & least=0)
         call card%real("DTMIN", "-", "the run stops when the step falls below this share of the " &
            & //"first one; 0 for never", control%smallest_share, default=0.0_wp, least=0.0_wp, &
            & most=1.0_wp)
         call card%unused("ENDENG")
         call card%unused("ENDMAS", neutral=[0.0_wp, no_mass_limit])
         call card%flag("NOSOL", "1 checks the deck and does not run", control%check_only)
         if (.not. card%reads) return
         control%end_time = control%end_time + card%catalogue%origin(card%root)
         card%catalogue%end_is_reported = .not. card%is_fine("ENDTIM")
         if (control%planned_end <= 0.0_wp) control%planned_end = control%end_time
         if (control%check_only) call card%note("NOSOL", "NOSOL is 1", "the deck is checked and " &
            & //"not run")
      end associate
   end subroutine control_termination

   !> The time step
   subroutine control_timestep(card, model)
      class(card_visitor_type), intent(inout) :: card
      type(model_type), intent(inout) :: model

      real(wp) :: scaled

      call card%keyword(standard, "The time step.", once=.true., change="time step")
      call card%remark("DT2MS scales a layer over a quad, or a brick, as one element: the step " &
         & //"is then TSSFAC times -DT2MS. Added mass has inertia and weight; the listing and " &
         & //"plydyn check tell how much there is of it in each part, with a warning above 5 % " &
         & //"unless *CONTROL_QUASI_STATIC watches the kinetic energy. A positive DT2MS, one " &
         & //"step for all elements, is refused. A restart may change the keyword: all its " &
         & //"fields count from there on, velocities stay, and the kinetic energy of the mass " &
         & //"that is added or taken is external work. See the theory, Mass scaling.")
      call card%example("10-the-stable-step", "0.0, 0.8")
      associate (control => model%control)
         call card%nonnegative("DTINIT", "time", "first step; 0 for the stable one", &
            & control%first_step)
         call card%real("TSSFAC", "-", "time-step scale factor: share of the stable step that " &
            & //"is taken; 0 for 0.8 with large displacement and 0.9 with linear strain (KINEM " &
            & //"of *CONTROL_LAYERWISE), also without this keyword", control%step_factor, &
            & default=0.0_wp, least=0.0_wp, most=1.0_wp)
         call card%unused("ISDO TSLIMT")
         call card%real("DT2MS", "time", "mass scaling: negative; elements with a stable step " &
            & //"below -DT2MS get mass added until they reach it; 0 for none", scaled, &
            & default=0.0_wp)
         call card%refer(a_curve, "LCTM", "curve of the largest step over time; 0 for none", &
            & control%step_curve, default=0, least=0)
         call card%unused("ERODE MS1ST")
         call card%card(optional=.true.)
         call card%unused("DT2MSF DT2MSLC IMSCL UNUSED1 UNUSED2 RMSCL UNUSED3 IHDO")
         if (.not. card%reads) return
         control%mass_scaled_step = max(0.0_wp, -scaled)
         if (scaled > 0.0_wp) call card%refuse("DT2MS", "a positive value, which adds mass to " &
            & //"all elements until they have the same stable step, is not supported", "a " &
            & //"negative value: elements with a stable step below -DT2MS get mass added until " &
            & //"they reach it")
         if (control%step_curve == 0) return
         control%curve_line = card%line_of("LCTM")
         if (all(model%curves(control%step_curve)%y > 0.0_wp)) return
      end associate
      call card%refuse("LCTM", "the curve bounds the step by 0 or less somewhere", &
         & "a curve with ordinates above 0")
   end subroutine control_timestep

   !> Refuse mass that is added for a step that is not taken
   subroutine check_mass_scaling(card, model)
      class(card_visitor_type), intent(inout) :: card
      type(model_type), intent(inout) :: model

      real(wp) :: bound, step

      associate (control => model%control)
         step = control%step_share()*control%mass_scaled_step
         bound = huge(1.0_wp)
         if (control%largest_step > 0.0_wp) bound = control%largest_step
         if (control%step_curve > 0) bound = min(bound, maxval(model%curves(control%step_curve)%y))
      end associate
      if (step*(1.0_wp - round_off) > bound) call card%refuse("DT2MS", "mass would be added for " &
         & //"a step of "//text(step)//", TSSFAC times -DT2MS, but DTMAX of *CONTROL_LAYERWISE " &
         & //"or the curve LCTM keeps it at "//text(bound), "a DT2MS nearer to 0, or a larger " &
         & //"bound")
   end subroutine check_mass_scaling

   !> Energies
   subroutine control_energy(card, model)
      class(card_visitor_type), intent(inout) :: card
      type(model_type), intent(inout) :: model

      call card%keyword(standard, "Energies to be computed in LS-DYNA; plydyn always computes " &
         & //"all energies.", once=.true.)
      call card%example("12-the-energy-balance", "2, 1, 2, 2")
      call card%unused("HGEN RWEN SLNTEN RYLEN IRGEN MATEN DRLEN DISEN", &
         & neutral=[0.0_wp, 1.0_wp, 2.0_wp])
   end subroutine control_energy

   !> Processors
   subroutine control_parallel(card, model)
      class(card_visitor_type), intent(inout) :: card
      type(model_type), intent(inout) :: model

      call card%keyword(standard, "Number of threads.", once=.true.)
      call card%example("running.md#threads-and-ranks", "1")
      call card%integer("NCPU", "number of threads; 0: as many as OMP_NUM_THREADS says. ncpu=N " &
         & //"of the command line has precedence. Results do not depend on it", &
         & model%control%threads, default=0, least=0)
      call card%unused("NUMRHS")
      call card%unused("CONST", neutral=[0.0_wp, 1.0_wp])
      call card%unused("PARA")
   end subroutine control_parallel

   !> Layer-wise plates
   subroutine control_layerwise(card, model)
      class(card_visitor_type), intent(inout) :: card
      type(model_type), intent(inout) :: model

      real(wp) :: volume_limit

      call card%keyword(extension, "Kinematics, limits of energy and volume, and time " &
         & //"integration scheme.", once=.true.)
      call card%remark("IMPL 1 and 2 allow a time step that is several times larger. They add " &
         & //"inertia to the opening and sliding of interfaces, and IMPL 2 also to stretch and " &
         & //"shear through the thickness. The added inertia is proportional to the square of " &
         & //"the step; the listing prints it, and DTMAX limits it. LS-DYNA's selective mass " &
         & //"scaling is similar. IMPL 2 does not work with *BOUNDARY_FACE_MOTION. See the " &
         & //"theory, Locally implicit operators.")
      call card%example("3-strain-and-stress", "0, 0.05")
      associate (control => model%control)
         call card%integer("KINEM", "0 linear strain, 1 large displacement (total Lagrangian)", &
            & control%kinematics, default=1, allowed=[0, 1])
         call card%positive("ENGLIM", "-", "the run stops when the energy balance is off by more " &
            & //"than this share", control%energy_limit, default=0.05_wp)
         call card%integer("IMPL", "0 explicit central differences, 1 interfaces locally " &
            & //"implicit: their stiffness does not limit the time step, 2 interfaces and " &
            & //"thickness: the thickness of plies does not limit it, either", control%scheme, &
            & default=0, allowed=[0, 1, 2])
         call card%nonnegative("DTMAX", "time", "largest step; 0 for none", control%largest_step)
         call card%real("VOLLIM", "-", "with KINEM 1 the run stops when the volume of an element " &
            & //"at a Gauss point falls below this share of that at time zero", volume_limit, &
            & default=0.0_wp, most=1.0_wp)
         if (.not. card%reads) return
         control%step_line = card%line_of("DTMAX")
         if (control%kinematics == total_lagrangian) then
            control%volume_limit = volume_limit
         else if (abs(volume_limit) > 0.0_wp) then
            call card%warn_idle("VOLLIM", "KINEM 1")
         end if
         if (control%scheme /= all_explicit) call check_scheme(card, model)
      end associate
   end subroutine control_layerwise

   !> Refuse what does not go with implicit operators
   subroutine check_scheme(card, model)
      class(card_visitor_type), intent(inout) :: card
      type(model_type), intent(in) :: model

      if (size(model%mesh%brick_id) > 0) then
         call card%refuse("IMPL", "bricks (*ELEMENT_SOLID) have explicit time integration only", &
            & "0")
      else if (size(model%constraints) > 0) then
         call card%refuse("IMPL", "*CONSTRAINED_LINEAR_GLOBAL and *CONSTRAINED_FACE_LINEAR need " &
            & //"explicit time integration", "0, or no constraint")
      else if (model%control%scheme == implicit_interfaces .and. .not. has_interfaces(model)) then
         ! the card that joins plies may be the one that is wrong
         if (.not. card%catalogue%report%has_errors()) call card%refuse("IMPL", &
            & "1 makes interfaces implicit, but no plies are joined by one", &
            & "0, or *INTERFACE_COHESIVE between plies")
      else if (model%control%scheme == implicit_thickness &
         & .and. any(model%motions%face /= all_planes)) then
         call card%refuse("IMPL", "2, implicit through the thickness, is not possible with " &
            & //"*BOUNDARY_FACE_MOTION of one face only", &
            & "1, or *BOUNDARY_PRESCRIBED_MOTION_SET, which moves all planes")
      end if
   end subroutine check_scheme

   !> Whether an interface lies between any two plies
   pure logical function has_interfaces(model)
      type(model_type), intent(in) :: model

      integer :: p

      has_interfaces = any([(any(model%parts(p)%joint > 0), p=1, size(model%parts))])
   end function has_interfaces

   !> Damping in proportion to mass
   subroutine damping_global(card, model)
      class(card_visitor_type), intent(inout) :: card
      type(model_type), intent(inout) :: model

      call card%keyword(standard, "Mass-proportional damping: forces against the velocity of " &
         & //"every point of the plate.", once=.true., change="damping")
      call card%example("9-central-differences", "0, 2.0e3")
      call card%unused("LCID")
      call card%nonnegative("VALDMP", "1/time", "force per mass and velocity", &
         & model%control%damping)
      if (card%reads) model%control%damping_line = card%line_of("VALDMP")
      call card%unused("STX STY STZ SRX SRY SRZ")
   end subroutine damping_global

   !> Dynamic relaxation
   subroutine damping_relaxation(card, model)
      class(card_visitor_type), intent(inout) :: card
      type(model_type), intent(inout) :: model

      call card%keyword(extension, "Brings the plate to rest by dynamic relaxation, and ends the " &
         & //"run there.", once=.true., change="dynamic relaxation")
      call card%remark("Damping forces act against the velocity of every point of the plate. " &
         & //"The damping is critical for the lowest frequency of the present motion, which is " &
         & //"estimated every 50 steps. The deck of a restart may begin dynamic relaxation or, " &
         & //"with DRTOL 0, end it. Impactors are not damped. A message says when the plate is " &
         & //"at rest. See the theory, Dynamic relaxation.")
      call card%example("9-central-differences", "1.0e-4")
      call card%real("DRTOL", "-", "the run ends normally when the kinetic energy is below this " &
         & //"share of the largest since dynamic relaxation began; 0 for no dynamic relaxation", &
         & model%control%rest_share, default=1.0e-4_wp, least=0.0_wp, most=1.0_wp)
      if (.not. card%reads) return
      if (model%control%rest_share >= 1.0_wp) then
         call card%refuse("DRTOL", "every motion has this share of the largest kinetic energy: " &
            & //"the run would end where it begins", "a small share, such as 1e-4")
      else if (model%control%rest_share > largest_rest) then
         call card%warn("DRTOL", "a plate with "//text(model%control%rest_share)//" of its " &
            & //"largest kinetic energy is not at rest", "a small share, such as 1e-4")
      end if
   end subroutine damping_relaxation

   !> Warn of impactors in a run that is to come to rest
   subroutine check_impactors(card, model)
      class(card_visitor_type), intent(inout) :: card
      type(model_type), intent(inout) :: model

      integer :: i

      if (model%control%rest_share <= 0.0_wp) return
      do i = 1, size(model%contacts)
         associate (own => model%impactors(model%contacts(i)%impactor))
            if (own%motion(3) > 0) cycle
            call card%warn("DRTOL", "impactor "//text(own%id)//" is not damped: a plate that it " &
               & //"touches does not come to rest", "no dynamic relaxation before a stage with " &
               & //"*DELETE_IMPACTOR, or a curve along z for the impactor")
         end associate
      end do
   end subroutine check_impactors

   !> Limit of the kinetic energy
   subroutine control_quasi_static(card, model)
      class(card_visitor_type), intent(inout) :: card
      type(model_type), intent(inout) :: model

      call card%keyword(extension, "Checks that a run is quasi-static.", once=.true., &
         & change="quasi-static control")
      call card%remark("A warning gives the first time at which the kinetic energy of the " &
         & //"plate exceeds a share of the internal energy, and a message at the end gives the " &
         & //"largest share. The first tenth of the time with the present supports and loads is " &
         & //"not checked, since little energy is stored when loading begins. With FALL the run " &
         & //"ends normally behind that tenth, after the largest load has passed. The load is " &
         & //"measured by the power of the supports and loads, averaged over each hundredth of " &
         & //"that time. It is proportional to the force where they move at a constant velocity. " &
         & //"Where points are moved along x or y, the listing has the loading rate: passages of " &
         & //"a wave in the loading time, and the kinetic energy to be expected.")
      call card%example("static.md#the-loading-rate-of-a-compression-or-tension-test", "0.05")
      call card%real("SHARE", "-", "kinetic energy over internal energy above which there is a " &
         & //"warning; 0 for none", model%control%kinetic_limit, default=0.05_wp, least=0.0_wp, &
         & most=1.0_wp)
      call card%real("FALL", "-", "share of the largest load so far below which the run ends; 0 " &
         & //"for no such end", model%control%load_share, default=0.0_wp, least=0.0_wp, most=1.0_wp)
   end subroutine control_quasi_static

   !> An end after the contact
   subroutine control_end_of_contact(card, model)
      class(card_visitor_type), intent(inout) :: card
      type(model_type), intent(inout) :: model

      call card%keyword(extension, "Ends the run after the contact of the impactors.", &
         & once=.true., change="end after contact")
      call card%remark("The time counts from the last step in which any impactor touched the " &
         & //"plate, and not before each of them has touched it: a rebound that hits again " &
         & //"begins it anew, and an impactor that stays or misses leaves the end to ENDTIM of " &
         & //"*CONTROL_TERMINATION. Restart files hold the time of the last contact. The " &
         & //"listing has an estimate of the duration of the contact.")
      call card%example("running.md#an-end-after-the-contact", "2.0e-4")
      call card%nonnegative("DUR", "time", "the run ends normally when this time has passed " &
         & //"since the last contact; 0 for no such end", model%control%contact_pause)
   end subroutine control_end_of_contact

   !> Warn of an end after the contact of no impactor
   subroutine check_contact_end(card, model)
      class(card_visitor_type), intent(inout) :: card
      type(model_type), intent(inout) :: model

      real(wp) :: length

      if (model%control%contact_pause > 0.0_wp .and. size(model%impactors) == 0) then
         call card%warn_idle("DUR", "*IMPACTOR_SPHERE or another impactor")
      else if (card%line_of("DUR") > card%catalogue%stored_lines) then
         length = model%control%end_time - card%catalogue%start(card%root)
         if (length > 0.0_wp .and. model%control%contact_pause >= length) call card%warn_idle( &
            & "DUR", "a time below the "//text(length)//" of the run")
      end if
   end subroutine check_contact_end

end module plydyn_input_control
