!> The parts of the listing on cohesive surfaces, interfaces between plies and cracks along lines in
!> them: laws, the mesh, and what the surfaces have come to.
module plydyn_io_listing_cohesive
   use plydyn_base_precision, only : wp
   use plydyn_base_text, only : text
   use plydyn_domain_element_energies, only : ply_cracks_type
   use plydyn_domain_delamination, only : delamination_type, failing_interfaces
   use plydyn_domain_domain, only : domain_type
   use plydyn_element_interface_process_zones, only : new_process_zone, process_zone_type
   use plydyn_law_cohesive_bilinear, only : cohesive_constants_type, cohesive_type, new_cohesive
   use plydyn_law_cohesive_softening, only : normal, shear
   use plydyn_law_cohesive_check, only : final_over_onset
   use plydyn_law_cohesive_process_zone_length, only : least_points, least_stiffness_ratio, &
      & stiffness_ratio, strength_factor
   use plydyn_law_scatter, only : scatter_type
   use plydyn_model_control, only : units_type
   use plydyn_model_crack_zone, only : crack_zone_type
   use plydyn_model_model, only : model_type
   use plydyn_model_symmetry, only : copies, whole_name
   use plydyn_io_listing_table, only : table_type, write_section
   implicit none
   private

   public :: write_crack_lengths, write_crack_zones, write_interface_laws, write_interface_losses

   !> Strengths that are fitted leave the factor at 1 but for this
   real(wp), parameter :: rounded = 1.0e-9_wp
   !> Opening stiffness in moduli over thickness of plies above which only the step feels it
   real(wp), parameter :: most_stiffness_ratio = 1.0e4_wp
   !> Names of the modes
   character(*), parameter :: mode_name(2) = [character(7) :: "opening", "sliding"]

contains

   !> Constants, openings at onset and failure, and the zone that softens, of each material that
   !> fails
   subroutine write_interface_laws(unit, model)
      !> Unit of the listing
      integer, intent(in) :: unit
      type(model_type), intent(in) :: model

      type(process_zone_type) :: zone
      integer :: m

      do m = 1, size(model%interface_materials)
         associate (material => model%interface_materials(m))
            if (.not. material%fails) cycle
            zone = new_process_zone(model, m)
            if (zone%interfaces == 0) cycle
            call write_section(unit, "Interface material "//text(material%id)//" "//material%title)
            call write_options(unit, material%constants, material%nodal, material%fitted)
            call write_modes(unit, model%control%units, material%constants, zone)
            call write_scatter(unit, model%control%units, material%scatter)
            call write_notes(unit, model%control%units, material%constants, zone, &
               & size(model%crack_zones) == 0)
         end associate
      end do
   end subroutine write_interface_laws

   !> What the card of the interface chooses
   subroutine write_options(unit, constants, nodal, fitted)
      integer, intent(in) :: unit
      type(cohesive_constants_type), intent(in) :: constants
      !> Points at the nodes; strengths fitted to the mesh
      logical, intent(in) :: nodal, fitted

      write (unit, "(2a)") "points                        ", &
         & trim(merge("nodes       ", "Gauss points", nodal))
      write (unit, "(2a)") "stiffness of closed faces     ", &
         & trim(merge("falls with damage", "stays whole      ", constants%falling_penalty))
      write (unit, "(2a)") "friction of failed faces      ", text(constants%friction, 3)
      if (constants%by_work) write (unit, "(a)") "mix of modes                  " &
         & //"of the work so far"
      if (constants%pressure_gain > 0.0_wp) write (unit, "(2a)") &
         & "shear strength over pressure  ", text(constants%pressure_gain, 3)
      if (constants%consistent) write (unit, "(a)") "shear stiffness               " &
         & //"fitted to the energy"
      if (fitted) write (unit, "(a)") "strengths                     fitted to the mesh, quad by " &
         & //"quad"
   end subroutine write_options

   !> A line for each mode
   subroutine write_modes(unit, units, constants, zone)
      integer, intent(in) :: unit
      type(units_type), intent(in) :: units
      type(cohesive_constants_type), intent(in) :: constants
      !> Zone, with the strengths that count
      type(process_zone_type), intent(in) :: zone

      type(cohesive_constants_type) :: used
      type(cohesive_type) :: law
      type(table_type) :: table
      real(wp) :: onset
      integer :: mode

      used = constants
      used%strength(:) = zone%strength
      law = new_cohesive(used)
      call start_table(table, unit, units)
      do mode = normal, shear
         onset = zone%strength(mode)/law%stiffness(mode)
         call table%put(mode_name(mode))
         call table%put([law%stiffness(mode), zone%strength(mode), constants%toughness(mode), &
            & onset, onset*final_over_onset(law, real(mode - normal, wp)), zone%length(mode), &
            & zone%length(mode)/zone%spacing])
      end do
   end subroutine write_modes

   !> Headers of the table of modes
   subroutine start_table(table, unit, units)
      type(table_type), intent(inout) :: table
      integer, intent(in) :: unit
      type(units_type), intent(in) :: units

      call table%start(unit)
      call table%add_column("mode", 7, "a")
      call table%add_column("stiffness", 12, "g12.5")
      call table%add_column("strength", 11, "g11.4")
      call table%add_column("toughness", 11, "g11.4")
      call table%add_column("onset ["//trim(units%length)//"]", 11, "g11.4")
      call table%add_column("failure ["//trim(units%length)//"]", 12, "g12.4")
      call table%add_column("zone ["//trim(units%length)//"]", 11, "g11.4")
      call table%add_column("spacings", 8, "f8.2")
      call table%write_heads()
   end subroutine start_table

   !> The scatter of the strengths
   subroutine write_scatter(unit, units, scatter)
      integer, intent(in) :: unit
      type(units_type), intent(in) :: units
      type(scatter_type), intent(in) :: scatter

      if (.not. scatter%modulus > 0.0_wp) return
      write (unit, "(9a)") "scatter of the strengths: modulus of Weibull ", &
         & text(scatter%modulus, 3), ", correlated over ", text(scatter%length, 3), &
         & " "//trim(units%length)//", seed ", text(scatter%seed), "; the strengths above are means"
   end subroutine write_scatter

   !> What the mesh or the stiffness cannot do
   subroutine write_notes(unit, units, constants, zone, may_fit)
      integer, intent(in) :: unit
      type(units_type), intent(in) :: units
      type(cohesive_constants_type), intent(in) :: constants
      type(process_zone_type), intent(in) :: zone
      !> Whether strengths may be fitted to the mesh
      logical, intent(in) :: may_fit

      character(:), allocatable :: remedy
      real(wp) :: factor, ratio
      integer :: mode

      factor = strength_factor(zone%across, constants%toughness, zone%strength, zone%spacing)
      if (any(zone%highest > zone%strength*(1.0_wp + rounded))) then
         write (unit, "(10a)") "note: the strengths above are those of the coarsest quad; in the " &
            & //"finest they are ", text(zone%highest(normal), 3), " and ", &
            & text(zone%highest(shear), 3), " "//trim(units%stress)
      end if
      remedy = "smaller quads help"
      if (may_fit .and. factor < 1.0_wp - rounded) then
         remedy = remedy//", or FIT 2 of *INTERFACE_COHESIVE"
      end if
      do mode = normal, shear
         if (zone%coarse(mode) == 0) cycle
         write (unit, "(20a)") "note: the process zone of ", trim(mode_name(mode)), ", ", &
            & text(zone%length(mode), 3), " "//trim(units%length)//", spans ", &
            & text(zone%length(mode)/zone%spacing, 2), " distances between nodes, fewer than ", &
            & text(least_points), ", in the coarsest quad, and fewer than ", text(least_points), &
            & " in ", text(zone%coarse(mode)), " of ", text(zone%quads), &
            & " quads: delaminations may need too much force there; ", remedy
      end do
      ratio = stiffness_ratio(constants%stiffness(normal), zone%across, zone%thickness)
      if (ratio < least_stiffness_ratio) then
         write (unit, "(5a)") "note: the opening stiffness is ", text(ratio, 3), &
            & " times modulus over thickness of the plies beside it, less than ", &
            & text(nint(least_stiffness_ratio)), ": the interface makes the laminate softer"
      else if (ratio > most_stiffness_ratio) then
         write (unit, "(5a)") "note: the opening stiffness is ", text(ratio, 3), &
            & " times modulus over thickness of the plies beside it, more than ", &
            & text(most_stiffness_ratio), ": the laminate is no stiffer, and the step is short"
      end if
   end subroutine write_notes

   !> Area and energy of every interface that can fail
   subroutine write_interface_losses(unit, model, domain, lost)
      !> Unit of the listing
      integer, intent(in) :: unit
      type(model_type), intent(in) :: model
      type(domain_type), intent(in) :: domain
      !> What each interface has lost in the whole model
      type(delamination_type), intent(in) :: lost(:)

      type(table_type) :: table
      integer, allocatable :: interfaces(:)
      integer :: i

      interfaces = failing_interfaces(domain)
      if (size(interfaces) == 0) return
      call write_section(unit, "Interfaces at the end")
      if (copies(model) > 1) write (unit, "(a)") whole_name(model)
      associate (u => model%control%units)
         call table%start(unit)
         call table%add_column("interface", 9, "i0")
         call table%add_column("damaged ["//trim(u%length)//"2]", 14, "g12.5")
         call table%add_column("delaminated ["//trim(u%length)//"2]", 18, "g12.5")
         call table%add_column("failed ["//trim(u%length)//"2]", 13, "g12.5")
         call table%add_column("fracture ["//trim(u%energy)//"]", 14, "g12.5")
         call table%add_column("penalty ["//trim(u%energy)//"]", 13, "g12.5")
         call table%add_column("friction ["//trim(u%energy)//"]", 14, "g12.5")
      end associate
      call table%write_heads()
      do i = 1, size(interfaces)
         call table%put(interfaces(i))
         associate (here => lost(interfaces(i)))
            call table%put(copies(model)*[here%begun, here%delaminated, here%failed, &
               & here%fracture, here%closing, here%friction])
         end associate
      end do
   end subroutine write_interface_losses

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

end module plydyn_io_listing_cohesive
