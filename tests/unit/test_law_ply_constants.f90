!> Constants of a ply say how wide a crack band may be.
program test_law_ply_constants
   use plydyn_base_error, only : error_type
   use plydyn_base_precision, only : wp
   use plydyn_law_ply_constants, only : ply_constants_type, snap_refuse
   use plydyn_law_ply_crack_band, only : modes
   use ply_point, only : paper_ply
   use testing, only : begin, check, check_error, finish
   implicit none

   type(ply_constants_type) :: ply
   type(error_type), allocatable :: error
   real(wp) :: longest(modes)

   call begin("longest_lengths")
   ply = paper_ply()
   longest(:) = ply%longest_lengths()
   call check(longest, [4.355_wp, 9.794_wp, 0.674_wp, 0.407_wp, 0.326_wp], 5.0e-4_wp, &
      & "are those of an independent program")
   ply%shear_toughness = 1.1_wp
   ply%plateau = 0.5_wp
   call check(ply%longest_lengths(), [longest(1), 4.0_wp*longest(2), longest(3:4), 1.630_wp], &
      & 5.0e-4_wp, "grow with a toughness of shear, and with a plateau by 1/(1 - share)**2")

   call begin("snaps_back")
   ply = paper_ply()
   call check(all(ply%snaps_back([5.0_wp, 0.39_wp]) &
      & .eqv. [.true., .false., .false., .true., .true.]), "each mode has a width of its own")

   call begin("refuse_snap_back")
   ply = paper_ply()
   call ply%refuse_snap_back([4.2_wp, 0.65_wp], error)
   call check(.not. allocated(error), "takes any band unless the material asks for a refusal")
   ply%snap_back = snap_refuse
   call ply%refuse_snap_back([4.1_wp, 0.31_wp], error)
   call check(.not. allocated(error), "takes a band that is narrow enough")
   call ply%refuse_snap_back([4.2_wp, 0.31_wp], error)
   call check_error(error, "fibre tension is 4.2", "names the mode and its width")
   call ply%refuse_snap_back([4.1_wp, 0.65_wp], error)
   call check_error(error, "matrix tension is 0.65", "looks at matrix cracks at their own width")
   call check_error(error, "less than 0.6419", "says what would be right, with the ratio of 1.05")
   call finish()
end program test_law_ply_constants
