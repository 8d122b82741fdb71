!> Readers of plies that are damaged.
module plydyn_input_read_damage
   use plydyn_base_precision, only : wp
   use plydyn_base_text, only : text
   use plydyn_deck_cards, only : cards_type
   use plydyn_input_catalogue, only : a_material, catalogue_type
   use plydyn_input_check_scatter_length, only : check_scatter_length
   use plydyn_input_declare_damage, only : usual_shear_strain
   use plydyn_input_read_material, only : begin_material, check_stability, read_axes, read_ply
   use plydyn_input_read_shear_points, only : check_shear, read_shear_points
   use plydyn_law_constants, only : law_constants_type
   use plydyn_law_ply_crack_band, only : rule_band, rule_gauss_point, rule_root_point, &
      & rule_root_quad
   use plydyn_law_ply_constants, only : onset_hashin, onset_quadratic, ply_constants_type, &
      & snap_drop, snap_reduce, snap_refuse
   use plydyn_law_scatter, only : strength_scatter_type
   use plydyn_law_ply_shear_curve, only : new_exponential_curve, new_power_curve
   use plydyn_law_ply_strain_damage, only : strain_constants_type, strain_mechanisms
   use plydyn_model_curve, only : curve_type
   use plydyn_model_material, only : add_material, material_type
   use plydyn_model_model, only : model_type
   implicit none
   private

   public :: check_strengths, choice, read_mat_codam2, read_mat_ply_codam2, read_ply_scatter

   !> Numbers of the card to those of the law, which begin where the card says 0
   integer, parameter, public :: rules(0:3) = [rule_band, rule_gauss_point, rule_root_point, &
      & rule_root_quad]
   integer, parameter :: snaps(0:2) = [snap_reduce, snap_refuse, snap_drop]
   integer, parameter :: onsets(0:1) = [onset_quadratic, onset_hashin]
   !> Shapes of the shear curve as on the card
   integer, parameter :: exponential = 1, table = 2, power = 3
   !> Least modulus of Weibull: with less, strengths vary by more than their half
   real(wp), parameter :: least_modulus = 2.0_wp

contains

   !> *MAT_PLY_CODAM2: damage of fibres and matrix after nonlinear shear
   subroutine read_mat_ply_codam2(cards, catalogue, model)
      type(cards_type), intent(in) :: cards
      type(catalogue_type), intent(inout) :: catalogue
      type(model_type), intent(inout) :: model

      type(material_type) :: material
      type(ply_constants_type) :: ply

      call begin_material(cards, catalogue, material)
      call read_ply(cards, catalogue, ply)
      ply%fibre_strength(:) = cards%reals(["XT", "XC"])
      ply%matrix_strength(:) = cards%reals(["YT", "YC"])
      ply%shear_strength = cards%real("SL")
      ply%cross_strength = cards%real("ST")
      ply%fibre_toughness(:) = cards%reals(["G1T", "G1C"])
      ply%matrix_toughness(:) = cards%reals(["G2T", "G2C"])
      ply%shear_toughness = cards%real("G2S")
      ply%band_width = cards%real("LSTAR")
      ply%residual = 1.0_wp - cards%real("DMAX")
      call check_strengths(cards, ply, catalogue)
      call read_switches(cards, catalogue, ply)
      material%line = cards%line_of("MID")
      if (cards%has("SNAP")) material%line = cards%line_of("SNAP")
      call read_shear_curve(cards, catalogue, model%curves, ply)
      call read_average(cards, catalogue, ply)
      if (ply%averages()) material%radius_line = cards%line_of("R1")
      call add_material(model%materials, material, ply)
   end subroutine read_mat_ply_codam2

   !> A strain of onset of 1 and more is a strength in other units than its modulus
   subroutine check_strengths(cards, ply, catalogue)
      !> The keyword
      type(cards_type), intent(in) :: cards
      !> The ply
      class(law_constants_type), intent(in) :: ply
      !> Gets the findings
      type(catalogue_type), intent(inout) :: catalogue

      character(2), parameter :: names(5) = ["XT", "XC", "YT", "YC", "SL"]
      character(3), parameter :: moduli(5) = ["E1 ", "E1 ", "E2 ", "E2 ", "G12"]
      real(wp) :: modulus(5)
      integer :: i

      modulus(:) = [ply%young([1, 1, 2, 2]), ply%shear(1)]
      do i = 1, size(names)
         if (.not. (cards%has(names(i)) .and. cards%has(trim(moduli(i))))) cycle
         if (cards%real(names(i)) < modulus(i)) cycle
         call catalogue%refuse(cards, names(i), names(i)//" is "//text(cards%real( &
            & names(i)))//": damage would start at a strain of "//text( &
            & cards%real(names(i))/modulus(i)), "a strength far below "//trim(moduli(i))//" = " &
            & //text(modulus(i))//", in the same unit")
      end do
   end subroutine check_strengths

   !> Choices within the law
   subroutine read_switches(cards, catalogue, ply)
      type(cards_type), intent(in) :: cards
      type(catalogue_type), intent(inout) :: catalogue
      type(ply_constants_type), intent(inout) :: ply

      ply%band_rule = rules(choice(cards, "LRULE"))
      ply%snap_back = snaps(choice(cards, "SNAP"))
      ply%snap_ratio = cards%real("RSNAP")
      ply%onset = onsets(choice(cards, "MCOMP"))
      ply%intact_onset = choice(cards, "TRIAL") == 1
      ply%closes = choice(cards, "CLOSE") == 1
      ply%plateau = cards%real("PLATEAU")
      ply%brittle = cards%real("BRITTLE")
      if (min(ply%plateau, ply%brittle) > 0.0_wp) then
         call catalogue%refuse(cards, "BRITTLE", "PLATEAU = "//text(ply%plateau) &
            & //" keeps stress in crushed fibres, and BRITTLE drops it at once", "0 for PLATEAU " &
            & //"or for BRITTLE")
      end if
      if (cards%is_fine("GZ")) ply%weakens_across = cards%integer("GZ") == 0
      if (ply%onset == onset_hashin .and. cards%is_fine("ST") &
         & .and. ply%cross_strength <= 0.0_wp) then
         call catalogue%refuse(cards, "ST", "ST is missing", "a strength above 0, which Hashin's " &
            & //"onset (MCOMP 1) needs")
      end if
   end subroutine read_switches

   !> Radii of the average over neighbours
   subroutine read_average(cards, catalogue, ply)
      type(cards_type), intent(in) :: cards
      type(catalogue_type), intent(inout) :: catalogue
      type(ply_constants_type), intent(inout) :: ply

      character(2), parameter :: names(2) = ["R1", "R2"]
      real(wp) :: radius(2)
      integer :: missing

      if (.not. (cards%is_fine("R1") .and. cards%is_fine("R2"))) return
      radius(:) = cards%reals(names)
      if (maxval(radius) <= 0.0_wp) return
      missing = minloc(radius, 1)
      if (radius(missing) <= 0.0_wp) then
         call catalogue%refuse(cards, names(missing), names(missing)//" is missing beside " &
            & //names(3 - missing)//" = "//text(radius(3 - missing)), "both radii of the " &
            & //"ellipse, or none")
      else if (ply%closes) then
         call catalogue%refuse(cards, "CLOSE", "cracks that close do not go with an average over " &
            & //"neighbours", "0, or no R1 and R2")
      end if
      ply%radius(:) = radius
   end subroutine read_average

   !> Number of a choice; 0 where the deck says none, or what cannot be
   pure integer function choice(cards, name)
      !> The keyword
      type(cards_type), intent(in) :: cards
      !> Name of the field
      character(*), intent(in) :: name

      choice = 0
      if (cards%is_fine(name)) choice = cards%integer(name)
   end function choice

   !> Curve of shear in the plane
   subroutine read_shear_curve(cards, catalogue, curves, ply)
      type(cards_type), intent(in) :: cards
      type(catalogue_type), intent(inout) :: catalogue
      type(curve_type), intent(in) :: curves(:)
      type(ply_constants_type), intent(inout) :: ply

      if (.not. (cards%is_fine("G12") .and. cards%is_fine("SL"))) return
      select case (choice(cards, "SHEAR"))
      case (exponential)
         if (.not. cards%is_fine("GAMU")) return
         if (cards%real("GAMU")*ply%shear(1) <= ply%shear_strength) then
            call catalogue%refuse(cards, "GAMU", "the shear curve cannot reach SL at a strain of " &
               & //text(cards%real("GAMU")), "a strain above SL/G12 = " &
               & //text(ply%shear_strength/ply%shear(1)))
            return
         end if
         ply%curve = new_exponential_curve(ply%shear(1), ply%shear_strength, cards%real("GAMU"))
      case (table)
         call read_shear_points(cards, catalogue, curves, ply%shear(1), ply%shear_strength, &
            & ply%curve)
      case (power)
         if (.not. (cards%is_fine("ALPHA") .and. cards%is_fine("N"))) return
         ply%curve = new_power_curve(ply%shear(1)*cards%real("ALPHA"), cards%real("N"))
         call check_shear(cards, merge("N    ", "ALPHA", cards%real("ALPHA") > 0.0_wp), &
            & ply%curve, [ply%shear(1), ply%shear_strength], "ALPHA such that ALPHA SL**N is " &
            & //"the plastic strain at the strength, and N above 1", catalogue)
      case default
         continue
      end select
      call warn_of_idle(cards, catalogue)
   end subroutine read_shear_curve

   !> Constants of another curve of shear mean nothing, nor do those of what is not chosen
   subroutine warn_of_idle(cards, catalogue)
      type(cards_type), intent(in) :: cards
      type(catalogue_type), intent(inout) :: catalogue

      character(5), parameter :: names(6) = ["GAMU ", "LCID ", "ALPHA", "N    ", "LRULE", "ST   "]
      character(*), parameter :: right(6) = ["SHEAR 1", "SHEAR 2", "SHEAR 3", "SHEAR 3", &
         & "LSTAR 0", "MCOMP 1"]
      logical :: is_idle(6)
      integer :: i

      associate (shear => choice(cards, "SHEAR"))
         is_idle(:) = [shear /= exponential &
            & .and. abs(cards%real("GAMU") - usual_shear_strain) > 0.0_wp, &
            & shear /= table .and. cards%integer("LCID") > 0, &
            & shear /= power .and. cards%real("ALPHA") > 0.0_wp, &
            & shear /= power .and. cards%real("N") > 0.0_wp, &
            & cards%real("LSTAR") > 0.0_wp .and. choice(cards, "LRULE") > 0, &
            & onsets(choice(cards, "MCOMP")) /= onset_hashin .and. cards%real("ST") > 0.0_wp]
      end associate
      do i = 1, size(names)
         if (is_idle(i)) call catalogue%warn_idle(cards, trim(names(i)), right(i))
      end do
   end subroutine warn_of_idle

   !> *PLY_SCATTER: strengths of a material from point to point
   subroutine read_ply_scatter(cards, catalogue, model)
      type(cards_type), intent(in) :: cards
      type(catalogue_type), intent(inout) :: catalogue
      type(model_type), intent(inout) :: model

      integer :: material, nth

      do nth = 1, cards%sets()
         call check_moduli(cards, nth, catalogue)
         call check_scatter_length(cards, nth, catalogue, model%mesh)
         call catalogue%find(a_material, cards, "MID", material, nth)
         if (material == 0) cycle
         if (.not. can_scatter(model%materials(material)%law)) then
            call catalogue%refuse(cards, "MID", "the strengths of *" &
               & //model%materials(material)%keyword//" cannot scatter", &
               & "a material of *MAT_PLY_CODAM2", nth)
         else if (model%materials(material)%law%scatter%scatters()) then
            call catalogue%refuse(cards, "MID", "the strengths of material " &
               & //text(cards%integer("MID", nth))//" scatter already", &
               & "one row for each material", nth)
         else
            model%materials(material)%law%scatter = strength_scatter_type( &
               & cards%integer("SEED", nth), [cards%real("MF", nth), cards%real("M", nth)], &
               & cards%real("LENGTH", nth))
         end if
      end do
   end subroutine read_ply_scatter

   !> Whether the strengths of a material may scatter
   pure logical function can_scatter(law)
      !> Its constants
      class(law_constants_type), intent(in) :: law

      select type (law)
      type is (ply_constants_type)
         can_scatter = .true.
      class default
         can_scatter = .false.
      end select
   end function can_scatter

   !> Refuse moduli of Weibull between 0 and the least, and a row without any
   subroutine check_moduli(cards, nth, catalogue)
      !> *PLY_SCATTER, and the row
      type(cards_type), intent(in) :: cards
      integer, intent(in) :: nth
      !> Gets the findings
      type(catalogue_type), intent(inout) :: catalogue

      character(2), parameter :: names(2) = ["M ", "MF"]
      real(wp) :: modulus(2)
      integer :: k

      if (.not. (cards%is_fine("M", nth) .and. cards%is_fine("MF", nth))) return
      do k = 1, size(names)
         modulus(k) = cards%real(names(k), nth)
         if (modulus(k) > 0.0_wp .and. modulus(k) < least_modulus) call catalogue%refuse(cards, &
            & trim(names(k)), trim(names(k))//" = "//text(modulus(k))//" would scatter the " &
            & //"strengths by more than half", text(least_modulus)//" or more, or 0 for no " &
            & //"scatter", nth)
      end do
      if (all(modulus <= 0.0_wp)) call catalogue%refuse(cards, "M", &
         & "no strength scatters with M and MF of 0", "a modulus of "//text(least_modulus) &
         & //" or more in one of them, or no card", nth)
   end subroutine check_moduli

   !> *MAT_CODAM2: damage between strains of the deck, for a ply alike in all directions across
   subroutine read_mat_codam2(cards, catalogue, model)
      type(cards_type), intent(in) :: cards
      type(catalogue_type), intent(inout) :: catalogue
      type(model_type), intent(inout) :: model

      type(material_type) :: material
      type(strain_constants_type) :: ply
      real(wp) :: along, across

      call begin_material(cards, catalogue, material)
      along = cards%real("EA")
      across = cards%real("EB")
      ply%young(:) = [along, across, across]
      ply%poisson(3) = cards%real("PRCB")
      ply%shear(:2) = cards%real("GAB")
      if (along > 0.0_wp .and. across > 0.0_wp) then
         ply%poisson(:2) = cards%real("PRBA")*along/across
         call check_stability(cards, ["PRBA", "PRBA", "PRCB"], ply, catalogue)
      end if
      if (abs(ply%poisson(3)) < 1.0_wp) then
         ply%shear(3) = across/(2.0_wp*(1.0_wp + ply%poisson(3)))
      end if
      call read_axes(cards, catalogue, material)
      material%axis_angle = material%axis_angle + cards%real("ANGLE1")
      if (cards%is_fine("NLAYER") .and. cards%integer("NLAYER") /= 1) then
         call catalogue%refuse(cards, "NLAYER", "a sub-laminate of " &
            & //text(cards%integer("NLAYER"))//" layers is not supported", &
            & "1, and each layer a ply of *PART_COMPOSITE with an angle of its own")
      end if
      call read_strains(cards, catalogue, ply)
      ply%radius(:) = cards%real("R1")
      material%radius_line = cards%line_of("R1")
      call add_material(model%materials, material, ply)
   end subroutine read_mat_codam2

   !> Strains between which damage grows
   subroutine read_strains(cards, catalogue, strains)
      type(cards_type), intent(in) :: cards
      type(catalogue_type), intent(inout) :: catalogue
      !> The ply
      type(strain_constants_type), intent(inout) :: strains

      character(3), parameter :: names(strain_mechanisms) = ["FIB", "MAT", "LOC"]
      character(1), parameter :: senses(2) = ["T", "C"]
      character(5) :: first, last
      integer :: i, j

      do j = 1, size(senses)
         do i = 1, size(names)
            first = "I"//names(i)//senses(j)
            last = "S"//names(i)//senses(j)
            if (.not. (cards%is_fine(first) .and. cards%is_fine(last))) cycle
            strains%onset(i, j) = cards%real(first)
            strains%finish(i, j) = cards%real(last)
            if (strains%finish(i, j) > strains%onset(i, j)) cycle
            call catalogue%refuse(cards, last, "damage would be complete at " &
               & //text(strains%finish(i, j))//" and begin at " &
               & //text(strains%onset(i, j)), "a strain above "//first)
         end do
      end do
   end subroutine read_strains

end module plydyn_input_read_damage
