!> The lines of the listing on fibres that soften on two lines.
module plydyn_io_listing_fibre_lines
   use plydyn_base_precision, only : wp
   use plydyn_element_crack_bands, only : crack_band_type
   use plydyn_io_listing_table, only : table_type
   use plydyn_law_ply_constants, only : in_compression, ply_constants_type, snap_drop
   use plydyn_law_ply_crack_band, only : mode_names
   use plydyn_law_ply_fibre_lines, only : first_reach, kink_of, last_reach, tail_share
   use plydyn_model_control, only : units_type
   implicit none
   private

   public :: fibre_lines_of, fibres_of, write_fibre_lines

   !> What a ply says of its fibres in uniaxial stress, in tension and in compression
   type, public :: fibre_modes_type
      !> E1
      real(wp) :: modulus = 0.0_wp
      !> Strengths; fracture energies; shares of both in one of two laws
      real(wp) :: strength(2) = 0.0_wp, toughness(2) = 0.0_wp
      real(wp) :: strength_share(2) = 1.0_wp, energy_share(2) = 1.0_wp
      !> Least ratio of the strains at the end and at the onset; 0 where the stress drops at once
      real(wp) :: ratio = 0.0_wp
   end type fibre_modes_type

contains

   !> The fibres of a ply of CODAM2: above a plateau all of the energy is dissipated
   pure function fibres_of(ply) result(fibres)
      class(ply_constants_type), intent(in) :: ply
      type(fibre_modes_type) :: fibres

      fibres = fibre_modes_type(ply%young(1), ply%fibre_strength, ply%fibre_toughness, &
         & ply%line_strength, ply%line_toughness, merge(0.0_wp, ply%snap_ratio, &
         & ply%snap_back == snap_drop))
      fibres%toughness(in_compression) = fibres%toughness(in_compression)/(1.0_wp - ply%plateau)**2
   end function fibres_of

   !> Strain at onset, strain and stress at the kink, and strain at the end, with some crack band
   pure function fibre_lines_of(fibres, sense, width) result(line)
      !> The fibres, tension or compression
      type(fibre_modes_type), intent(in) :: fibres
      integer, intent(in) :: sense
      !> Width of the band
      real(wp), intent(in) :: width
      real(wp) :: line(4)

      real(wp) :: kink(2), last, onset, strength

      associate (share => fibres%strength_share(sense), energy => fibres%energy_share(sense), &
         & g => fibres%toughness(sense))
         strength = fibres%strength(sense)
         if (fibres%ratio > 0.0_wp) strength = min(strength, sqrt(2.0_wp*fibres%modulus*g &
            & *first_reach(share, energy)/(fibres%ratio*width)))
         onset = strength/fibres%modulus
         last = max(last_reach(share, energy)*2.0_wp*g/(width*strength), onset)
         kink(:) = kink_of(onset, last, tail_share(share, energy), last_reach(share, energy) &
            & /first_reach(share, energy))
         line(:) = [onset, kink(1), strength*kink(2), last]
      end associate
   end function fibre_lines_of

   !> Shares, kinks and ends, if fibres have two lines
   subroutine write_fibre_lines(unit, fibres, band, units)
      !> Unit of the listing
      integer, intent(in) :: unit
      type(fibre_modes_type), intent(in) :: fibres
      type(crack_band_type), intent(in) :: band
      type(units_type), intent(in) :: units

      type(table_type) :: table
      integer :: sense

      if (all(fibres%strength_share >= 1.0_wp)) return
      write (unit, "(/,a,/)") "fibres soften by two laws, each with a share of the strength and " &
         & //"of the energy: on one line to the kink, where the first law ends, and on another"
      call start_table(unit, units, table)
      do sense = 1, 2
         if (fibres%strength_share(sense) >= 1.0_wp) cycle
         ! strain and stress at the kink, and the end
         associate (narrow => fibre_lines_of(fibres, sense, band%narrowest(1)), &
            & wide => fibre_lines_of(fibres, sense, band%widest(1)))
            call table%put(trim(mode_names(sense)))
            call table%put([fibres%strength_share(sense), fibres%energy_share(sense), &
               & narrow(2:), wide(2:)])
         end associate
      end do
   end subroutine write_fibre_lines

   !> Headers of the table
   subroutine start_table(unit, units, table)
      integer, intent(in) :: unit
      type(units_type), intent(in) :: units
      type(table_type), intent(out) :: table

      character(*), parameter :: bands(2) = [character(6) :: "narrow", "wide"]
      integer :: k

      call table%start(unit)
      call table%add_column("mode", 18, "a")
      call table%add_column("share of strength", 10, "f8.4")
      call table%add_column("share of energy", 10, "f8.4")
      do k = 1, 2
         call table%add_column("kink strain, "//trim(bands(k))//" band", 12, "es12.5")
         call table%add_column("kink stress ["//trim(units%stress)//"]", 12, "g12.5")
         call table%add_column("end, "//trim(bands(k))//" band", 12, "es12.5")
      end do
      call table%write_heads()
   end subroutine start_table

end module plydyn_io_listing_fibre_lines
