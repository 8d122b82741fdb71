!> The section of the listing on plies that are damaged: strengths, strains, crack bands.
module plydyn_io_listing_damage
   use plydyn_base_precision, only : wp
   use plydyn_base_text, only : text
   use plydyn_domain_domain, only : domain_type
   use plydyn_element_crack_bands, only : crack_band_type
   use plydyn_law_ply_constants, only : in_compression, ply_constants_type, snap_drop
   use plydyn_law_ply_crack_band, only : mode_names, modes, rule_gauss_point, rule_root_point, &
      & rule_root_quad
   use plydyn_law_ply_fracture_constants, only : fracture_constants_type, snap_ratio
   use plydyn_law_ply_shear_curve, only : shape_line
   use plydyn_law_ply_strain_damage, only : by_fibres, by_locking, by_matrix, strain_constants_type
   use plydyn_model_control, only : units_type
   use plydyn_model_model, only : model_type
   use plydyn_io_listing_fibre_lines, only : fibre_lines_of, fibre_modes_type, fibres_of, &
      & write_fibre_lines
   use plydyn_io_listing_table, only : table_type, write_section
   implicit none
   private

   public :: write_damage

contains

   !> One section for each material with damage
   subroutine write_damage(unit, model, domain)
      !> Unit of the listing
      integer, intent(in) :: unit
      type(model_type), intent(in) :: model
      type(domain_type), intent(in) :: domain

      character(:), allocatable :: title
      integer :: i, p

      do i = 1, size(domain%crack_bands)
         if (.not. model%materials(i)%is_damaged()) cycle
         title = "Damage of material "//text(model%materials(i)%id)//" "//model%materials(i)%title
         ! it has another one elsewhere
         if (model%materials(i)%law%has_lines) title = title//" where its cracks are lines"
         call write_section(unit, title)
         if (.not. any([(any(model%parts(p)%plies%material == i), p=1, size(model%parts))])) then
            write (unit, "(a)") "no ply has this material"
            cycle
         end if
         associate (law => model%materials(i)%law, band => domain%crack_bands(i), &
            & units => model%control%units)
            if (law%averages()) call write_average(unit, law%radius, &
               & domain%averaging%neighbours(:, i), units)
            select type (law)
            class is (ply_constants_type)
               call write_bands(unit, rule_words(law%averages(), law%band_rule, law%band_width), &
                  & band, units)
               call write_remainder(unit, law%residual, law%weakens_across, law%closes, &
                  & law%averages())
               call write_modes(unit, law, band, units)
               call write_fibre_lines(unit, fibres_of(law), band, units)
               call write_snap_back(unit, law, band)
            class is (fracture_constants_type)
               call write_bands(unit, rule_words(law%averages(), law%band_rule, law%band_width), &
                  & band, units)
               call write_remainder(unit, law%residual)
               call write_fracture(unit, law, band, units)
               call write_fibre_lines(unit, fibre_modes_type(law%young(1), law%fibre_strength, &
                  & law%fibre_toughness, law%line_strength, law%line_toughness, snap_ratio), band, &
                  & units)
            class is (strain_constants_type)
               call write_strains(unit, law, band, units)
            end select
         end associate
      end do
   end subroutine write_damage

   !> The ellipse of the average over neighbours
   subroutine write_average(unit, radius, points, units)
      integer, intent(in) :: unit
      !> Along the fibres and across them
      real(wp), intent(in) :: radius(2)
      !> Fewest and most points in it
      integer, intent(in) :: points(2)
      type(units_type), intent(in) :: units

      write (unit, "(2(a,es12.5),2a)") "strains averaged within ", radius(1), &
         & " along the fibres and ", radius(2), " across them ", trim(units%length)
      write (unit, "(2(a,i0),/)") "  Gauss points in the ellipse ", points(1), " to ", points(2)
   end subroutine write_average

   !> Rule and widths of the crack band
   subroutine write_bands(unit, rule, band, units)
      integer, intent(in) :: unit
      !> The rule in words
      character(*), intent(in) :: rule
      type(crack_band_type), intent(in) :: band
      type(units_type), intent(in) :: units

      write (unit, "(2a)") "width of the crack band       ", rule
      write (unit, "(a,2(es12.5,a))") "  across broken fibres       ", band%narrowest(1), " to", &
         & band%widest(1), " "//trim(units%length)
      write (unit, "(a,2(es12.5,a))") "  across matrix cracks       ", band%narrowest(2), " to", &
         & band%widest(2), " "//trim(units%length)
   end subroutine write_bands

   !> What damage leaves of the stiffness
   subroutine write_remainder(unit, residual, weakens_across, closes, averages)
      integer, intent(in) :: unit
      !> Least integrity
      real(wp), intent(in) :: residual
      !> Whether damage weakens the shear across the thickness, where the law has both
      logical, intent(in), optional :: weakens_across
      !> Whether cracks close, and whether averages drive damage
      logical, intent(in), optional :: closes, averages

      write (unit, "(a)") "largest damage                "//text(1.0_wp - residual)
      if (present(weakens_across)) then
         write (unit, "(2a)") "shear across the thickness    ", &
            & trim(merge("weakened by damage (GZ 0)", "not weakened (GZ 1)      ", weakens_across))
      end if
      if (present(closes) .and. present(averages)) write (unit, "(2a)") &
         & "cracks                        ", closure_words(closes, averages)
      write (unit, "()")
   end subroutine write_remainder

   !> Whether cracks close, in words
   pure function closure_words(closes, averages) result(words)
      !> Whether they do, and whether averages drive damage
      logical, intent(in) :: closes, averages
      character(:), allocatable :: words

      if (closes) then
         words = "close in compression, which has damage of its own (CLOSE 1)"
      else if (averages) then
         words = "never close, since averages drive damage (R1)"
      else
         words = "never close (CLOSE 0)"
      end if
   end function closure_words

   !> The rule in words
   function rule_words(averages, rule, width) result(words)
      !> Whether averages drive damage
      logical, intent(in) :: averages
      !> Rule for the width; the width itself, 0: by the rule
      integer, intent(in) :: rule
      real(wp), intent(in) :: width
      character(:), allocatable :: words

      if (width > 0.0_wp) then
         words = "given (LSTAR)"
         return
      else if (averages) then
         words = "1.4 radii of the average, or what the quad has where that is wider"
         return
      end if
      select case (rule)
      case (rule_gauss_point); words = "length of the Gauss point along the direction"
      case (rule_root_point); words = "root of the area of the Gauss point"
      case (rule_root_quad); words = "root of the area of the quad"
      case default; words = "share of the length of the quad along the direction"
      end select
   end function rule_words

   !> Strengths and strains of each mode in uniaxial stress, at the narrowest and widest band
   subroutine write_modes(unit, ply, band, units)
      integer, intent(in) :: unit
      class(ply_constants_type), intent(in) :: ply
      type(crack_band_type), intent(in) :: band
      type(units_type), intent(in) :: units

      type(table_type) :: table
      real(wp) :: early(2), finish, line(4), longest(modes), modulus(modes), strength(modes)
      real(wp) :: width(2)
      integer :: direction, k, mode

      call start_table(unit, units, .true., table)
      strength(:) = [ply%fibre_strength, ply%matrix_strength, ply%shear_strength]
      modulus(:) = [ply%young([1, 1, 2, 2]), ply%shear(1)]
      longest(:) = ply%longest_lengths()
      do mode = 1, merge(in_compression, modes, ply%has_lines)
         direction = merge(1, 2, mode <= in_compression)
         width(:) = [band%narrowest(direction), band%widest(direction)]
         early(:) = early_share(ply, longest(mode), width)
         call table%put(trim(mode_names(mode)))
         call table%put([strength(mode), longest(mode)/ply%snap_ratio, &
            & strength(mode)*minval(early), strength(mode)*early(1)/modulus(mode)])
         do k = 1, 2
            line(:) = fibre_lines_of(fibres_of(ply), min(mode, in_compression), width(k))
            ! where the line of softening meets zero
            finish = max(longest(mode)/(width(k)*early(k)), early(k))*strength(mode)/modulus(mode)
            call table%put(merge(line(4), finish, mode <= in_compression))
         end do
         call table%put(band%too_wide(mode))
      end do
   end subroutine write_modes

   !> Headers of the table of modes
   subroutine start_table(unit, units, has_strains, table)
      integer, intent(in) :: unit
      type(units_type), intent(in) :: units
      !> Whether it has the strains at onset and end
      logical, intent(in) :: has_strains
      type(table_type), intent(out) :: table

      call table%start(unit)
      call table%add_column("mode", 18, "a")
      call table%add_column("strength ["//trim(units%stress)//"]", 12, "g12.5")
      call table%add_column("widest band ["//trim(units%length)//"]", 12, "g12.5")
      call table%add_column("least strength ["//trim(units%stress)//"]", 12, "g12.5")
      if (has_strains) then
         call table%add_column("onset strain", 12, "es12.5")
         call table%add_column("end, narrow band", 12, "es12.5")
         call table%add_column("end, wide band", 12, "es12.5")
      end if
      call table%add_column("points too wide", 8, "i0")
      call table%write_heads()
   end subroutine start_table

   !> Share of the strength at which damage starts in uniaxial stress: 1 where the band is narrow
   !> enough, else that of the strength sqrt(2 E G/(ratio band))
   pure function early_share(ply, longest, width) result(share)
      class(ply_constants_type), intent(in) :: ply
      real(wp), intent(in) :: longest, width(2)
      real(wp) :: share(2)

      share(:) = 1.0_wp
      if (ply%snap_back == snap_drop) return
      share(:) = min(1.0_wp, sqrt(longest/(ply%snap_ratio*width)))
   end function early_share

   !> What is done where the band is too wide
   subroutine write_snap_back(unit, ply, band)
      integer, intent(in) :: unit
      class(ply_constants_type), intent(in) :: ply
      type(crack_band_type), intent(in) :: band

      character(:), allocatable :: words

      if (all(band%too_wide == 0)) return
      if (ply%snap_back == snap_drop) then
         words = "the stress drops at once and more than the toughness is dissipated (SNAP 2)"
      else
         words = "damage starts below the strength, and the fracture energy is right (SNAP 0)"
      end if
      write (unit, "(/,a,i0,a)") "of ", band%points, " Gauss points; where the band is too wide " &
         & //words
   end subroutine write_snap_back

   !> Strains of each mode of damage between given strains, and what a crack costs in uniaxial
   !> stress at the narrowest and widest band of the mesh
   subroutine write_strains(unit, ply, band, units)
      integer, intent(in) :: unit
      class(strain_constants_type), intent(in) :: ply
      type(crack_band_type), intent(in) :: band
      type(units_type), intent(in) :: units

      integer, parameter :: mechanism(modes) = [by_fibres, by_fibres, by_matrix, &
         & by_matrix, by_matrix]
      ! shear counts by half, with the strains of tension
      integer, parameter :: sense(modes) = [1, 2, 1, 2, 1]
      real(wp), parameter :: factor(modes) = [1.0_wp, 1.0_wp, 1.0_wp, 1.0_wp, 2.0_wp]
      type(table_type) :: table
      real(wp) :: limits(2), modulus(modes)
      integer :: direction, mode

      call table%start(unit)
      call table%add_column("mode", 18, "a")
      call table%add_column("onset strain", 12, "es12.5")
      call table%add_column("complete at", 12, "es12.5")
      call table%add_column("stress at onset ["//trim(units%stress)//"]", 12, "g12.5")
      call table%add_column("crack, narrow band ["//energy_per_area(units)//"]", 12, "g12.5")
      call table%add_column("crack, wide band ["//energy_per_area(units)//"]", 12, "g12.5")
      call table%write_heads()
      modulus(:) = [ply%young([1, 1, 2, 2]), ply%shear(1)]
      do mode = 1, modes
         direction = merge(1, 2, mode <= in_compression)
         limits(:) = factor(mode)*[ply%onset(mechanism(mode), sense(mode)), &
            & ply%finish(mechanism(mode), sense(mode))]
         call table%put(trim(mode_names(mode)))
         call table%put([limits, modulus(mode)*limits(1), 0.5_wp*modulus(mode)*product(limits) &
            & *[band%narrowest(direction), band%widest(direction)]])
      end do
      write (unit, "(/,4(a,es12.5))") "locking from a principal strain of", &
         & ply%onset(by_locking, 1), " to", ply%finish(by_locking, 1), ", in compression of", &
         & ply%onset(by_locking, 2), " to", ply%finish(by_locking, 2)
   end subroutine write_strains

   !> Unit of energy over area
   pure function energy_per_area(units) result(name)
      type(units_type), intent(in) :: units
      character(:), allocatable :: name

      name = trim(units%energy)//"/"//trim(units%length)//"2"
   end function energy_per_area

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

      call start_table(unit, units, .false., table)
      strength(:) = [ply%fibre_strength, ply%matrix_strength, ply%shear_strength]
      longest(:) = ply%longest_lengths()
      do mode = 1, merge(in_compression, modes, ply%has_lines)
         call table%put(trim(mode_names(mode)))
         call table%put([strength(mode), longest(mode), strength(mode)*sqrt(min(longest(mode) &
            & /max(band%widest(merge(1, 2, mode <= 2)), longest(mode)), 1.0_wp))])
         call table%put(band%too_wide(mode))
      end do
      write (unit, "(/,a,es12.5,2a)") "shear strength across the fibres ", ply%cross_strength(), &
         & " ", trim(units%stress)
      if (any(band%too_wide > 0)) write (unit, "(a)") "of "//text(band%points)//" Gauss points; " &
         & //"where the band is too wide damage starts below the strength"
      if (ply%curve%shape == shape_line) return
      yields(:) = ply%first_yields()
      write (unit, "(a,2(es12.5,a))") "permanent shear from stresses of ", yields(1), &
         & " along the fibres and ", yields(3), " across them "//trim(units%stress)
   end subroutine write_fracture

end module plydyn_io_listing_damage
