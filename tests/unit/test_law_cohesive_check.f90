!> Constants that cannot belong together are found, and said so.
program test_law_cohesive_check
   use bond, only : table_6
   use plydyn_base_precision, only : wp
   use plydyn_law_cohesive_bilinear, only : cohesive_constants_type, new_cohesive
   use plydyn_law_cohesive_softening, only : normal, shear
   use plydyn_law_cohesive_check, only : about_criterion, about_exponent, about_friction, &
      & about_stiffness, about_strength, about_toughness, check_cohesive, final_over_onset, &
      & finding_type
   use testing, only : begin, check, finish
   implicit none

   type(cohesive_constants_type) :: constants
   type(finding_type), allocatable :: findings(:)

   call begin("final_over_onset")
   call check([final_over_onset(new_cohesive(table_6()), 0.0_wp), &
      & final_over_onset(new_cohesive(table_6()), 1.0_wp)], [198.1_wp, 91.5_wp], 0.05_wp, &
      & "is that of table 6")

   call begin("check_cohesive")
   call check_cohesive(table_6(), findings)
   call check(size(findings), 0, "finds nothing in table 6")

   constants = table_6()
   constants%strength(normal) = 1.0e-6_wp
   call check_cohesive(constants, findings)
   call check(size(findings), 0, "nor in a strength far below the other")
   constants = table_6()
   constants%toughness(shear) = -0.79_wp
   call expect(about_toughness, shear, "the shear toughness is -0.79", "a negative toughness")
   constants = table_6()
   constants%strength(normal) = 0.0_wp
   call expect(about_strength, normal, "the normal strength is 0", "no strength")
   constants = table_6()
   constants%stiffness(shear) = 0.0_wp
   call expect(about_stiffness, shear, "the shear stiffness is 0", "no stiffness")
   constants%consistent = .true.
   call check_cohesive(constants, findings)
   call check(size(findings), 0, "needs no shear stiffness where it follows from the rest")
   constants = table_6()
   constants%exponent = 0.0_wp
   call expect(about_exponent, 0, "exponent", "an exponent of zero")
   constants = table_6()
   constants%criterion = 3
   call expect(about_criterion, 0, "no criterion 3", "an unknown criterion")
   constants = table_6()
   constants%friction = -0.1_wp
   call expect(about_friction, 0, "friction is -0.1", "a negative friction")
   constants = table_6()
   constants%toughness(normal) = 0.0014_wp
   call expect(about_toughness, normal, "the final opening lies below the onset", &
      & "a toughness too small for the stiffness")
   constants = table_6()
   constants%stiffness(:) = [62.3_wp**2/(1.9_wp*0.28_wp), 92.3_wp**2/(1.9_wp*0.79_wp)]
   constants%toughness(normal) = 0.0281_wp
   constants%stiffness(normal) = 62.3_wp**2/(1.9_wp*0.0281_wp)
   constants%exponent = 8.0_wp
   call expect(about_toughness, 0, "of the energy", "a mix of modes with too little toughness")

   constants%toughness(:) = -1.0_wp
   constants%friction = -1.0_wp
   call check_cohesive(constants, findings)
   call check(size(findings), 3, "finds all that is wrong at once")
   call finish()

contains

   !> The constants must give one finding
   subroutine expect(constant, mode, words, what)
      integer, intent(in) :: constant, mode
      character(*), intent(in) :: words, what

      call check_cohesive(constants, findings)
      call check(size(findings), 1, what//" is one finding")
      if (size(findings) == 0) return
      call check(findings(1)%constant == constant .and. findings(1)%mode == mode, &
         & what//" is blamed on the right constant")
      call check(index(findings(1)%wrong, words) > 0, &
         & what//" is said: "//findings(1)%wrong//"; "//findings(1)%right)
   end subroutine expect

end program test_law_cohesive_check
