!> Checks of the constants of an interface.
module plydyn_law_cohesive_check
   use plydyn_base_precision, only : wp
   use plydyn_base_text, only : text
   use plydyn_law_cohesive_bilinear, only : cohesive_constants_type, cohesive_type, new_cohesive
   use plydyn_law_cohesive_softening, only : benzeggagh_kenane, normal, power_law, shear
   implicit none
   private

   public :: check_cohesive, final_over_onset

   !> Constants that a finding can be about
   integer, parameter, public :: about_stiffness = 1, about_strength = 2, about_toughness = 3, &
      & about_criterion = 4, about_exponent = 5, about_friction = 6

   !> What is wrong with a constant
   type, public :: finding_type
      !> Which constant, one of `about_…`
      integer :: constant = 0
      !> Its mode, `normal` or `shear`; 0 for constants of both
      integer :: mode = 0
      !> What is wrong, and what would be right
      character(:), allocatable :: wrong, right
   end type finding_type

   !> Names of the modes in messages
   character(*), parameter :: mode_name(2) = [character(6) :: "normal", "shear"]
   !> Mixes of modes that are looked at
   integer, parameter :: mixes = 100

contains

   !> Find what is wrong with the constants; nothing where all is well
   pure subroutine check_cohesive(constants, findings)
      type(cohesive_constants_type), intent(in) :: constants
      !> What is wrong
      type(finding_type), allocatable, intent(out) :: findings(:)

      real(wp) :: stiffness(2)

      allocate (findings(0))
      stiffness(:) = constants%stiffness
      if (constants%consistent) stiffness(shear) = stiffness(normal)
      call check_sign(about_stiffness, "stiffness", stiffness, findings)
      call check_sign(about_strength, "strength", constants%strength, findings)
      call check_sign(about_toughness, "toughness", constants%toughness, findings)
      if (all(constants%criterion /= [benzeggagh_kenane, power_law])) then
         call add(findings, about_criterion, 0, "there is no criterion " &
            & //text(constants%criterion), "Benzeggagh-Kenane or the power law")
      end if
      if (.not. constants%exponent > 0.0_wp) then
         call add(findings, about_exponent, 0, "the exponent of the mixed-mode toughness is " &
            & //text(constants%exponent), "a positive exponent: with 0 the toughness of a mode " &
            & //"would jump as the other one comes in")
      end if
      if (.not. constants%friction >= 0.0_wp) then
         call add(findings, about_friction, 0, "the friction is "//text(constants%friction), &
            & "a coefficient of 0 or more")
      end if
      if (size(findings) == 0) call check_openings(constants, findings)
   end subroutine check_cohesive

   !> Both constants of a pair must be positive
   pure subroutine check_sign(constant, name, pair, findings)
      !> Which constants
      integer, intent(in) :: constant
      !> Their name
      character(*), intent(in) :: name
      !> Normal and shear
      real(wp), intent(in) :: pair(2)
      !> What is wrong
      type(finding_type), allocatable, intent(inout) :: findings(:)
      integer :: mode

      do mode = normal, shear
         if (pair(mode) > 0.0_wp) cycle
         call add(findings, constant, mode, "the "//trim(mode_name(mode))//" "//name//" is " &
            & //text(pair(mode)), "a positive "//name)
      end do
   end subroutine check_sign

   !> The toughness must exceed the elastic energy at the strength, in every mix of modes
   pure subroutine check_openings(constants, findings)
      !> Constants that are sound one by one
      type(cohesive_constants_type), intent(in) :: constants
      !> What is wrong
      type(finding_type), allocatable, intent(inout) :: findings(:)

      type(cohesive_type) :: law
      real(wp) :: mix
      integer :: i, mode

      law = new_cohesive(constants)
      do mode = normal, shear
         if (final_over_onset(law, real(mode - normal, wp)) > 1.0_wp) cycle
         call add(findings, about_toughness, mode, "the "//trim(mode_name(mode))//" toughness " &
            & //text(constants%toughness(mode))//" is less than the elastic energy at the " &
            & //"strength, "//text(0.5_wp/law%onset(mode)) &
            & //": the final opening lies below the onset", &
            & "strength squared over twice the stiffness to be less than the toughness")
      end do
      if (size(findings) > 0) return
      do i = 1, mixes - 1
         mix = real(i, wp)/real(mixes, wp)
         if (final_over_onset(law, mix) > 1.0_wp) cycle
         call add(findings, about_toughness, 0, "where shear has the share "//text(mix, 2) &
            & //" of the energy, the toughness is less than the elastic energy at the onset", &
            & "a higher toughness or stiffness, or a lower strength")
         return
      end do
   end subroutine check_openings

   !> Final opening of a straight path over that at its onset
   pure real(wp) function final_over_onset(law, mix) result(ratio)
      type(cohesive_type), intent(in) :: law
      !> Share of the energy that is of shear, from 0 to 1
      real(wp), intent(in) :: mix

      ratio = 2.0_wp*law%toughness_of(mix)*(law%onset(normal)*(1.0_wp - mix) &
         & + law%onset(shear)*mix)
   end function final_over_onset

   !> Add a finding
   pure subroutine add(findings, constant, mode, wrong, right)
      !> What is wrong so far
      type(finding_type), allocatable, intent(inout) :: findings(:)
      !> Which constant, and its mode
      integer, intent(in) :: constant, mode
      !> What is wrong, and what would be right
      character(*), intent(in) :: wrong, right

      findings = [findings, finding_type(constant, mode, wrong, right)]
   end subroutine add

end module plydyn_law_cohesive_check
