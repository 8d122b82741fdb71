!> What the listing says of plies that crack on planes of fracture: strengths, widths, permanent
!> strain.
module plydyn_io_listing_fracture
   use plydyn_base_precision, only : wp
   use plydyn_base_text, only : text
   use plydyn_element_crack_bands, only : crack_band_type
   use plydyn_io_listing_table, only : table_type
   use plydyn_law_ply_crack_band, only : mode_names, modes
   use plydyn_law_ply_fracture_constants, only : fracture_constants_type, shear_elastic
   use plydyn_model_control, only : units_type
   implicit none
   private

   public :: write_fracture

contains

   !> Strengths and widths of each mode in uniaxial stress, and what the constants make of them
   subroutine write_fracture(unit, ply, band, units)
      !> Unit of the listing
      integer, intent(in) :: unit
      !> The ply
      class(fracture_constants_type), intent(in) :: ply
      !> Crack bands of the mesh
      type(crack_band_type), intent(in) :: band
      !> Units of the deck
      type(units_type), intent(in) :: units

      type(table_type) :: table
      real(wp) :: longest(modes), strength(modes), yields(3)
      integer :: mode

      call table%start(unit)
      call table%add_column("mode", 18, "a")
      call table%add_column("strength ["//trim(units%stress)//"]", 12, "g12.5")
      call table%add_column("widest band ["//trim(units%length)//"]", 12, "g12.5")
      call table%add_column("least strength ["//trim(units%stress)//"]", 12, "g12.5")
      call table%add_column("points too wide", 8, "i0")
      call table%write_heads()
      strength(:) = [ply%fibre_strength, ply%matrix_strength, ply%shear_strength]
      longest(:) = ply%longest_lengths()
      do mode = 1, modes
         call table%put(trim(mode_names(mode)))
         call table%put(strength(mode))
         call table%put(longest(mode))
         call table%put(strength(mode)*sqrt(min(longest(mode)/max(band%widest(merge(1, 2, &
            & mode <= 2)), longest(mode)), 1.0_wp)))
         call table%put(band%too_wide(mode))
      end do
      write (unit, "(/,a,es12.5,2a)") "shear strength across the fibres ", ply%cross_strength(), &
         & " ", trim(units%stress)
      if (any(band%too_wide > 0)) write (unit, "(a)") "of "//text(band%points)//" Gauss points; " &
         & //"where the band is too wide damage starts below the strength"
      if (ply%shear_curve == shear_elastic) return
      yields(:) = ply%first_yields()
      write (unit, "(a,2(es12.5,a))") "permanent shear from stresses of ", yields(1), &
         & " along the fibres and ", yields(3), " across them "//trim(units%stress)
   end subroutine write_fracture

end module plydyn_io_listing_fracture
