!> The listing has the strains of fibres at onset and at the end, as the band allows them.
program test_io_listing_fibre_lines
   use plydyn_base_precision, only : wp
   use plydyn_io_listing_fibre_lines, only : fibre_lines_of, fibre_modes_type, fibres_of
   use plydyn_law_ply_constants, only : ply_constants_type, snap_drop, snap_reduce
   use testing, only : begin, check, finish
   implicit none

   integer, parameter :: tension = 1, compression = 2
   real(wp), parameter :: young = 160.0e3_wp, strength(2) = [2400.0_wp, 1600.0_wp]
   real(wp), parameter :: toughness(2) = [90.0_wp, 50.0_wp], plateau = 0.2_wp, ratio = 1.1_wp
   real(wp), parameter :: digits = 1.0e-12_wp
   !> Widths within which the stress falls along a line, and without a line at all
   real(wp), parameter :: narrow = 1.0_wp, wide = 10.0_wp
   type(ply_constants_type) :: ply
   type(fibre_modes_type) :: fibres
   real(wp) :: line(4), reduced

   ply%young(1) = young
   ply%fibre_strength = strength
   ply%fibre_toughness = toughness
   ply%plateau = plateau
   ply%snap_ratio = ratio

   call begin("fibres_of")
   fibres = fibres_of(ply)
   call check(fibres%toughness, toughness/[1.0_wp, (1.0_wp - plateau)**2], digits, &
      & "above a plateau all of the energy is dissipated")
   call check(fibres%ratio, ratio, 0.0_wp, "the end lies behind the onset")
   ply%snap_back = snap_drop
   fibres = fibres_of(ply)
   call check(fibres%ratio, 0.0_wp, 0.0_wp, "or the stress drops")

   call begin("fibre_lines_of")
   ply%snap_back = snap_reduce
   line(:) = fibre_lines_of(fibres_of(ply), tension, narrow)
   call check(line(1), strength(1)/young, digits, "onset at the strength")
   call check(line(4), 2.0_wp*toughness(1)/(narrow*strength(1)), digits, "end of a triangle")
   line(:) = fibre_lines_of(fibres_of(ply), compression, narrow)
   call check(line(4), 2.0_wp*toughness(2)/((1.0_wp - plateau)**2*narrow*strength(2)), digits, &
      & "of another one above the plateau")
   line(:) = fibre_lines_of(fibres_of(ply), tension, wide)
   reduced = sqrt(2.0_wp*young*toughness(1)/(ratio*wide))
   call check(line(1), reduced/young, digits, "onset of a strength that is reduced")
   call check(line(4)/line(1), ratio, 1.0e-9_wp, "to keep the ratio of both strains")
   ply%snap_back = snap_drop
   line(:) = fibre_lines_of(fibres_of(ply), tension, wide)
   call check(line([1, 4]), spread(strength(1)/young, 1, 2), digits, "a drop at the full strength")
   call finish()
end program test_io_listing_fibre_lines
