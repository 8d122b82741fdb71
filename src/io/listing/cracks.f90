!> The parts of the listing on crack zones: what they are, and what their cracks have come to.
module plydyn_io_listing_cracks
   use plydyn_base_text, only : text
   use plydyn_domain_element_energies, only : ply_cracks_type
   use plydyn_io_listing_table, only : table_type, write_section
   use plydyn_model_control, only : units_type
   use plydyn_model_crack_zone, only : crack_zone_type
   use plydyn_model_model, only : model_type
   implicit none
   private

   public :: write_crack_lengths, write_crack_zones

contains

   !> Lines and strengths of the plies of each zone
   subroutine write_crack_zones(unit, model)
      !> Unit of the listing
      integer, intent(in) :: unit
      type(model_type), intent(in) :: model

      integer :: z

      do z = 1, size(model%crack_zones)
         associate (zone => model%crack_zones(z), units => model%control%units)
            call write_section(unit, "Crack lines of part "//text(model%parts(zone%part)%id))
            write (unit, "(2a)") "nodes with a twin             ", text(size(zone%node))
            write (unit, "(4a)") "energy per area               ", text(zone%toughness, 4), " ", &
               & trim(units%force)//"/"//trim(units%length)
            write (unit, "(2a)") "friction of closed cracks     ", text(zone%friction, 3)
            write (unit, "(4a)") "opening that debris holds     ", text(zone%debris, 4), " ", &
               & trim(units%length)
            write (unit, "(a,/)") "matrix damage                 none in this part"
            call write_plies(unit, model, zone, units)
         end associate
      end do
   end subroutine write_crack_zones

   !> A line for each ply
   subroutine write_plies(unit, model, zone, units)
      integer, intent(in) :: unit
      type(model_type), intent(in) :: model
      type(crack_zone_type), intent(in) :: zone
      type(units_type), intent(in) :: units

      type(table_type) :: table
      integer :: p

      call table%start(unit)
      call table%add_column("ply", 4, "i0")
      call table%add_column("spacing ["//trim(units%length)//"]", 12, "f12.4")
      call table%add_column("YT ["//trim(units%stress)//"]", 12, "f12.3")
      call table%add_column("SL ["//trim(units%stress)//"]", 12, "f12.3")
      call table%add_column("ST ["//trim(units%stress)//"]", 12, "f12.3")
      call table%add_column("STIFF ["//trim(units%stress)//"/"//trim(units%length)//"]", 12, &
         & "es12.5")
      call table%write_heads()
      do p = 1, size(zone%plies)
         associate (ply => zone%plies(p))
            call table%put(model%parts(zone%part)%plies(p)%id)
            call table%put([ply%every*ply%pitch, ply%strength, ply%stiffness])
         end associate
      end do
   end subroutine write_plies

   !> Length and energy of the cracks of each ply, and a note where they are cut off
   subroutine write_crack_lengths(unit, model, cracks)
      integer, intent(in) :: unit
      type(model_type), intent(in) :: model
      !> Cracks of each ply from the bottom up
      type(ply_cracks_type), intent(in) :: cracks(:)

      type(table_type) :: table
      integer :: k

      write (unit, "(a)")
      associate (units => model%control%units)
         call table%start(unit)
         call table%add_column("ply", 4, "i0")
         call table%add_column("cracks ["//trim(units%length)//"]", 14, "f14.3")
         call table%add_column("failed ["//trim(units%length)//"]", 14, "f14.3")
         call table%add_column("fracture ["//trim(units%energy)//"]", 14, "es12.5")
         call table%add_column("friction ["//trim(units%energy)//"]", 14, "es12.5")
         call table%add_column("ends of lines", 13, "i0")
      end associate
      call table%write_heads()
      do k = 1, size(cracks)
         call table%put(k)
         call table%put([cracks(k)%length, cracks(k)%failed, cracks(k)%fracture, &
            & cracks(k)%friction])
         call table%put(cracks(k)%ends)
      end do
      if (any(cracks%ends > 0)) then
         write (unit, "(/,a,*(i0,:,', '))", advance="no") &
            & "note: cracks have come to the ends of their lines in ply ", &
            & pack([(k, k=1, size(cracks))], cracks%ends > 0)
         write (unit, "(a)") ": at the edge of the part, unless the plate ends there. A larger &
            &part, in recipes a larger core and radius of [cracks], lets them go on"
      end if
   end subroutine write_crack_lengths

end module plydyn_io_listing_cracks
