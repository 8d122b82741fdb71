!> The listing of a run: what was read, and what was made of it.
module plydyn_io_listing_listing
   use plydyn_base_precision, only : wp
   use plydyn_base_text, only : fixed_text, padded, text
   use plydyn_domain_domain, only : domain_type
   use plydyn_law_ply_elastic, only : add_ply_stiffness
   use plydyn_model_control, only : total_lagrangian
   use plydyn_model_layup, only : faces_apart, faces_tied, hourglass_viscous, part_type
   use plydyn_model_model, only : model_type
   use plydyn_model_symmetry, only : copies, whole_name
   use plydyn_model_support, only : bottom_face
   use plydyn_io_listing_damage, only : write_damage
   use plydyn_io_listing_effort, only : cost_type, write_effort
   use plydyn_io_listing_duration, only : write_contact_duration, write_loading_rate
   use plydyn_io_listing_cohesive, only : write_crack_zones, write_interface_laws
   use plydyn_method_contact_step, only : contacts_type
   use plydyn_method_simulation, only : simulation_type
   use plydyn_io_listing_time_step, only : write_step
   use plydyn_io_listing_table, only : table_type, write_section
   use plydyn_model_approach, only : find_approach
   implicit none
   private

   public :: write_listing

   !> Share of the size of terms below which their sum is round-off, of a thousand plies too
   real(wp), parameter :: share_of_round_off = 1.0e-12_wp

contains

   !> Everything that is known before the first step
   subroutine write_listing(unit, build, deck, messages, simulation, cost)
      !> Unit of the listing
      integer, intent(in) :: unit
      !> Version and compiler; path of the deck; warnings of the readers
      character(*), intent(in) :: build, deck, messages
      !> Model, domain of any rank, and contacts
      class(simulation_type), intent(in) :: simulation
      !> What a step and a line of energies take
      type(cost_type), intent(in) :: cost

      integer :: p

      associate (model => simulation%model, domain => simulation%domain)
         write (unit, "(a)") build
         write (unit, "(/,2a)") "deck   ", deck
         write (unit, "(2a)") "title  ", model%title
         if (len(messages) > 0) then
            call write_section(unit, "Messages")
            write (unit, "(a)") messages
         end if
         call write_section(unit, "Units")
         associate (u => model%control%units)
            write (unit, "(12a)") trim(u%length), ", ", trim(u%time), ", ", trim(u%mass), ", ", &
               & trim(u%force), ", ", trim(u%stress), ", ", trim(u%energy)
         end associate
         do p = 1, size(model%parts)
            if (model%parts(p)%brick%points == 0) then
               call write_part(unit, model, model%parts(p))
            else
               call write_brick_part(unit, model, p)
            end if
         end do
         call write_damage(unit, model, domain)
         call write_interface_laws(unit, model)
         call write_crack_zones(unit, model)
         call write_masses(unit, model, domain, simulation%contacts)
         call write_step(unit, model, domain)
         call write_loading_rate(unit, model, domain)
         call write_effort(unit, simulation, cost)
      end associate
      flush (unit)
   end subroutine write_listing

   !> Plies of a part from the bottom up
   subroutine write_part(unit, model, part)
      integer, intent(in) :: unit
      type(model_type), intent(in) :: model
      type(part_type), intent(in) :: part

      real(wp) :: total, z
      type(table_type) :: table
      integer :: k

      call write_section(unit, "Part "//text(part%id)//" "//part%title)
      associate (length => model%control%units%length)
         call table%start(unit)
         call table%add_column("ply", 4, "i0")
         call table%add_column("angle [deg]", 11, "f9.2")
         call table%add_column("bottom ["//trim(length)//"]", 12, "g12.5")
         call table%add_column("top ["//trim(length)//"]", 12, "g12.5")
         call table%add_column("material", 8, "i0")
         call table%add_column("order", 5, "i0")
         call table%add_column("layers", 6, "i0")
         call table%add_column("above it", 24, "a")
         call table%write_heads()
      end associate
      total = sum(part%plies%thickness)
      z = part%bottom_offset*total
      do k = 1, size(part%plies)
         associate (ply => part%plies(k))
            call table%put(ply%id)
            call table%put(ply%angle)
            call table%put(beyond_round_off(z, total))
            z = z + ply%thickness
            call table%put(beyond_round_off(z, total))
            call table%put(model%materials(ply%material)%id)
            call table%put(ply%order)
            call table%put(ply%layers)
            call table%put(joint_name(model, part, k))
         end associate
      end do
      call write_laminate(unit, model, part)
   end subroutine write_part

   !> Stiffness of a part as a plate
   subroutine write_laminate(unit, model, part)
      integer, intent(in) :: unit
      type(model_type), intent(in) :: model
      type(part_type), intent(in) :: part

      real(wp) :: a(3, 3), b(3, 3), d(3, 3), total, z
      integer :: k

      a(:, :) = 0.0_wp
      b(:, :) = 0.0_wp
      d(:, :) = 0.0_wp
      total = sum(part%plies%thickness)
      z = part%bottom_offset*total
      do k = 1, size(part%plies)
         associate (ply => part%plies(k), material => model%materials(part%plies(k)%material))
            call add_ply_stiffness(material%law, ply%angle, [z, z + ply%thickness], a, b, d)
            z = z + ply%thickness
         end associate
      end do
      associate (u => model%control%units)
         write (unit, "(/,11a)") "A [", trim(u%force), "/", trim(u%length), "], B [", &
            & trim(u%force), "] and D [", trim(u%force), " ", trim(u%length), &
            & "] of classical laminate theory (xx, yy, xy)"
      end associate
      do k = 1, 3
         write (unit, "(3(3es12.4,3x))") beyond_round_off(a(k, :), maxval(abs(a))), &
            & beyond_round_off(b(k, :), maxval(abs(a))*total), &
            & beyond_round_off(d(k, :), maxval(abs(d)))
      end do
   end subroutine write_laminate

   !> A number, or zero where it is round-off beside the numbers that it is the sum of
   elemental real(wp) function beyond_round_off(number, size) result(rounded)
      !> The number; size of what it is the sum of
      real(wp), intent(in) :: number, size

      rounded = merge(number, 0.0_wp, abs(number) > share_of_round_off*size)
   end function beyond_round_off

   !> A part of bricks
   subroutine write_brick_part(unit, model, p)
      integer, intent(in) :: unit
      type(model_type), intent(in) :: model
      integer, intent(in) :: p

      real(wp), allocatable :: angle(:)

      associate (part => model%parts(p), section => model%parts(p)%brick)
         angle = pack(model%mesh%brick_angle, model%mesh%brick_part == p)
         call write_section(unit, "Part "//text(part%id)//" "//part%title)
         write (unit, "(a,i0,a,i0,a)") "bricks                        ", &
            & count(model%mesh%brick_part == p), " of ", section%points, " points"
         write (unit, "(a,i0,2a)") "material                      ", &
            & model%materials(part%plies(1)%material)%id, ", angle [deg] ", &
            & fixed_text(minval(angle), 2)
         if (maxval(angle) > minval(angle)) write (unit, "(2a)") "   to ", &
            & fixed_text(maxval(angle), 2)
         if (section%points > 1) return
         write (unit, "(2a)") "hourglass control             ", trim(merge("viscous  ", &
            & "stiffness", section%control == hourglass_viscous))//", " &
            & //text(section%coefficient)
      end associate
   end subroutine write_brick_part

   !> What joins a ply to the one above it
   function joint_name(model, part, k) result(name)
      type(model_type), intent(in) :: model
      type(part_type), intent(in) :: part
      integer, intent(in) :: k
      character(:), allocatable :: name

      name = "face of the laminate"
      if (k > size(part%joint)) return
      select case (part%joint(k))
      case (faces_tied); name = "tied"
      case (faces_apart); name = "apart"
      case default
         name = "interface, material "//text(model%interface_materials(part%joint(k))%id)
      end select
   end function joint_name

   !> Sizes and masses
   subroutine write_masses(unit, model, domain, contacts)
      integer, intent(in) :: unit
      type(model_type), intent(in) :: model
      type(domain_type), intent(in) :: domain
      type(contacts_type), intent(in) :: contacts
      integer :: i

      call write_section(unit, "Size and mass")
      call write_elements(unit, model, domain)
      ! without the second points of tied faces
      write (unit, "(a,i0)") "degrees of freedom            ", 3*size(model%mesh%node_id) &
         & *(sum(domain%layers%order + 1) - size(domain%inertia%ties))
      if (domain%control%kinematics == total_lagrangian) then
         write (unit, "(a)") "kinematics                    large displacement, total Lagrangian"
      else
         write (unit, "(a)") "kinematics                    linear strain"
      end if
      if (copies(model) > 1) write (unit, "(2a)") padded("masses, energies and areas", 30), &
         & whole_name(model)
      write (unit, "(a,es14.7,1x,2a)") "mass of the plate            ", &
         & copies(model)*domain%inertia%total_mass, &
         & trim(model%control%units%mass), trim(merge(", added mass included", &
         & "                     ", size(domain%inertia%added) > 0))
      call write_impactors(unit, model, contacts)
      do i = 1, size(domain%contact%fixtures)
         associate (fixture => domain%contact%fixtures(i))
            write (unit, "(2a,es14.7,1x,a)") padded("fixture "//text(fixture%id), 30), &
               & fixture%kind//trim(merge(" below the bottom face", " above the top face   ", &
               & fixture%face == bottom_face))//", over ", &
               & copies(model)*fixture%area, &
               & trim(model%control%units%length)//"2 of it"
         end associate
      end do
   end subroutine write_masses

   !> Nodes, and the elements of each set that show themselves
   subroutine write_elements(unit, model, domain)
      integer, intent(in) :: unit
      type(model_type), intent(in) :: model
      type(domain_type), intent(in) :: domain

      integer, allocatable :: node(:, :), part(:)
      character(30) :: name
      logical :: has_layers

      has_layers = any(domain%layers%order > 0)
      name = "nodes"
      if (has_layers) name = "nodes of the plane"
      write (unit, "(a,i0)") name, size(model%mesh%node_id)
      associate (group => domain%groups(1)%item)
         call model%mesh%list_elements(group%element_kind, part, node)
         name = group%element_kind//"s"
         write (unit, "(a,i0,a,i0,a)") name, size(part), " of ", size(node, 1), " nodes"
      end associate
      if (has_layers) write (unit, "(a,i0)") "numerical layers              ", &
         & size(domain%layers%order)
   end subroutine write_elements

   !> One line for the mass of each impactor, and more for its contact
   subroutine write_impactors(unit, model, contacts)
      integer, intent(in) :: unit
      type(model_type), intent(in) :: model
      type(contacts_type), intent(in) :: contacts

      integer :: i, k

      do i = 1, size(model%impactors)
         associate (own => model%impactors(i), units => model%control%units)
            write (unit, "(a,es14.7,1x,a,es14.7,1x,a)") padded("impactor "//text(own%id), 29), &
               & copies(model)*own%mass, trim(units%mass)//", energy ", &
               & 0.5_wp*copies(model)*own%mass*sum(own%velocity**2), &
               & trim(units%energy)
            write (unit, "(2a,es14.7,1x,a)") padded("   body", 30), own%kind//", radius", &
               & own%body%radius, trim(units%length)
         end associate
         do k = 1, size(model%contacts)
            if (model%contacts(k)%impactor == i) call write_contact(unit, model, contacts, k)
         end do
      end do
   end subroutine write_impactors

   !> Contact nodes, and distance until the first contact
   subroutine write_contact(unit, model, contacts, k)
      integer, intent(in) :: unit
      type(model_type), intent(in) :: model
      type(contacts_type), intent(in) :: contacts
      !> Index of the contact
      integer, intent(in) :: k

      associate (pair => contacts%pairs(k)%pair)
         if (allocated(pair%nodes)) write (unit, "(a,i0,a,es14.7,1x,a)") &
            & padded("   contact nodes", 30), size(pair%nodes%facet), " at the start, spacing", &
            & pair%nodes%range%spacing, trim(model%control%units%length)
      end associate
      associate (approach => find_approach(model, model%contacts(k)))
         if (approach%is_known .and. approach%arrives) then
            write (unit, "(a,es14.7,1x,a)") padded("   distance to first contact", 29), &
               & approach%distance, trim(model%control%units%length)
         else if (approach%is_known) then
            write (unit, "(2a)") padded("   distance to first contact", 30), "none before the end"
         end if
      end associate
      call write_contact_duration(unit, model, k)
   end subroutine write_contact

end module plydyn_io_listing_listing
