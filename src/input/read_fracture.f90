!> Reader of plies whose matrix cracks on planes of fracture.
module plydyn_input_read_fracture
   use plydyn_base_precision, only : wp
   use plydyn_base_text, only : text
   use plydyn_deck_cards, only : cards_type
   use plydyn_input_catalogue, only : catalogue_type
   use plydyn_input_read_damage, only : check_strengths, choice, rules
   use plydyn_input_read_material, only : begin_material, read_ply
   use plydyn_input_read_shear_points, only : read_shear_points
   use plydyn_law_ply_fracture_constants, only : fracture_constants_type, shear_elastic, &
      & shear_hardening, shear_points, shear_power
   use plydyn_law_ply_shear_curve, only : shape_table
   use plydyn_model_curve, only : curve_type
   use plydyn_model_material, only : add_material, material_type
   use plydyn_model_model, only : model_type
   implicit none
   private

   public :: read_mat_ply_fracture_3d

   !> Kinds of permanent shear as on the card
   integer, parameter :: points = 2, power = 3, hardening = 4

contains

   !> *MAT_PLY_FRACTURE_3D: matrix cracks on planes of fracture, permanent shear
   subroutine read_mat_ply_fracture_3d(cards, catalogue, model)
      type(cards_type), intent(in) :: cards
      type(catalogue_type), intent(inout) :: catalogue
      type(model_type), intent(inout) :: model

      type(material_type) :: material
      type(fracture_constants_type) :: ply

      call begin_material(cards, catalogue, material)
      call read_ply(cards, catalogue, ply)
      ply%fibre_strength(:) = cards%reals(["XT", "XC"])
      ply%matrix_strength(:) = cards%reals(["YT", "YC"])
      ply%shear_strength = cards%real("SL")
      ply%fracture_angle = cards%real("ALPHA0")
      ply%fibre_toughness(:) = cards%reals(["G1T", "G1C"])
      ply%matrix_toughness(:) = cards%reals(["G2T", "G2S"])
      ply%mode_exponent = cards%real("BK")
      ply%band_width = cards%real("LSTAR")
      ply%band_rule = rules(choice(cards, "LRULE"))
      ply%residual = 1.0_wp - cards%real("DMAX")
      ply%friction = cards%real("FRIC")
      ply%plateau = cards%real("PLATEAU")
      ply%crush_stress = cards%real("PCRUSH")
      call check_strengths(cards, ply, catalogue)
      call read_shear(cards, catalogue, model%curves, ply)
      call read_debris(cards, catalogue, ply)
      call warn_of_idle(cards, catalogue)
      material%line = cards%line_of("MID")
      call add_material(model%materials, material, ply)
   end subroutine read_mat_ply_fracture_3d

   !> Permanent shear
   subroutine read_shear(cards, catalogue, curves, ply)
      type(cards_type), intent(in) :: cards
      type(catalogue_type), intent(inout) :: catalogue
      !> Curves of the deck
      type(curve_type), intent(in) :: curves(:)
      type(fracture_constants_type), intent(inout) :: ply

      ply%shear_curve = shear_elastic
      select case (choice(cards, "SHEAR"))
      case (points)
         if (.not. (cards%is_fine("G12") .and. cards%is_fine("SL"))) return
         call read_shear_points(cards, catalogue, curves, ply%shear(1), ply%shear_strength, &
            & ply%curve)
         if (ply%curve%shape == shape_table) ply%shear_curve = shear_points
      case (power)
         if (.not. (cards%is_fine("ALPHA") .and. cards%is_fine("N"))) return
         ply%coefficient = cards%real("ALPHA")
         ply%exponent = cards%real("N")
         if (ply%coefficient <= 0.0_wp) then
            call catalogue%refuse(cards, "ALPHA", "ALPHA is missing", "ALPHA such that " &
               & //"ALPHA SL**N is the permanent strain at the strength, above 0")
         else if (ply%exponent <= 1.0_wp) then
            call catalogue%refuse(cards, "N", "N is "//text(ply%exponent)//", with which the " &
               & //"stress of SHEAR 3 would not level off", "an exponent above 1")
         else
            ply%shear_curve = shear_power
         end if
      case (hardening)
         if (.not. (cards%is_fine("SP") .and. cards%is_fine("KP") .and. cards%is_fine("SL"))) return
         ply%first_yield = cards%real("SP")
         ply%hardening = cards%real("KP")
         if (ply%first_yield <= 0.0_wp .or. ply%first_yield >= ply%shear_strength) then
            call catalogue%refuse(cards, "SP", "SP = "//text(ply%first_yield) &
               & //", where permanent shear strain begins, is not between 0 and the shear " &
               & //"strength SL = "//text(ply%shear_strength), "a stress above 0 and below SL")
         else if (ply%hardening <= 0.0_wp) then
            call catalogue%refuse(cards, "KP", "KP is missing: without hardening the stress " &
               & //"would never reach SL", "a share of the modulus above 0, such as 0.05")
         else
            ply%shear_curve = shear_hardening
         end if
      case default
         continue
      end select
   end subroutine read_shear

   !> What debris holds open: both numbers, or none
   subroutine read_debris(cards, catalogue, ply)
      type(cards_type), intent(in) :: cards
      type(catalogue_type), intent(inout) :: catalogue
      type(fracture_constants_type), intent(inout) :: ply

      character(6), parameter :: names(2) = ["DEBRIS", "SHARE "]
      real(wp) :: value(2)
      integer :: missing

      if (.not. (cards%is_fine("DEBRIS") .and. cards%is_fine("SHARE"))) return
      value(:) = [cards%real("DEBRIS"), cards%real("SHARE")]
      missing = minloc(value, 1)
      if (maxval(value) > 0.0_wp .and. value(missing) <= 0.0_wp) then
         call catalogue%refuse(cards, trim(names(missing)), trim(names(missing)) &
            & //" is missing beside "//trim(names(3 - missing))//" = " &
            & //text(value(3 - missing)), "both numbers of the debris, or none")
      end if
      ply%debris_limit = value(1)
      ply%debris_share = value(2)
   end subroutine read_debris

   !> Constants of another curve of shear mean nothing, nor does a rule beside a width
   subroutine warn_of_idle(cards, catalogue)
      type(cards_type), intent(in) :: cards
      type(catalogue_type), intent(inout) :: catalogue

      character(5), parameter :: names(4) = ["ALPHA", "N    ", "SP   ", "KP   "]
      integer, parameter :: wanted(4) = [power, power, hardening, hardening]
      integer :: i

      do i = 1, size(names)
         if (choice(cards, "SHEAR") == wanted(i)) cycle
         if (cards%real(trim(names(i))) > 0.0_wp) call catalogue%warn_idle(cards, trim(names(i)), &
            & merge("SHEAR 3", "SHEAR 4", wanted(i) == power))
      end do
      if (choice(cards, "SHEAR") /= points .and. choice(cards, "LCID") > 0) then
         call catalogue%warn_idle(cards, "LCID", "SHEAR 2")
      end if
      if (cards%real("LSTAR") > 0.0_wp .and. choice(cards, "LRULE") > 0) then
         call catalogue%warn_idle(cards, "LRULE", "LSTAR 0")
      end if
   end subroutine warn_of_idle

end module plydyn_input_read_fracture
