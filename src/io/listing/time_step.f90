!> The part of the listing on the origin of the time step, and on mass that is added for a longer
!> one.
module plydyn_io_listing_time_step
   use plydyn_base_precision, only : wp
   use plydyn_base_text, only : fixed_text, text
   use plydyn_domain_domain, only : added_mass_type, domain_type
   use plydyn_model_control, only : all_explicit, implicit_thickness, total_lagrangian
   use plydyn_model_model, only : model_type
   use plydyn_io_listing_table, only : table_type, write_section
   implicit none
   private

   public :: added_mass_warning, first_step_warning, write_step

   !> Share of an eigenvalue that the plane has where the thickness of a ply governs it
   real(wp), parameter :: plane_share = 0.5_wp
   !> Share of its stable step up to which the motion through a ply bears large strains with large
   !> displacement, and round-off of it
   real(wp), parameter :: roomy_share = 0.8_wp, slack = 1.0e-6_wp
   !> Share of the mass of a model above which added mass is warned of; parts of a whole
   real(wp), parameter :: most_added = 0.05_wp, per_cent = 100.0_wp

contains

   !> A warning where the deck asks for a first step above that which is taken; empty otherwise
   function first_step_warning(domain) result(words)
      !> The domain, of any rank
      type(domain_type), intent(in) :: domain
      character(:), allocatable :: words

      words = ""
      if (domain%control%first_step <= domain%step) return
      words = "warning: DTINIT of *CONTROL_TIMESTEP, "//text(domain%control%first_step) &
         & //", is without effect: no step is above "//text(domain%step)//"; right would be 0, " &
         & //"or a first step below that"
   end function first_step_warning

   !> The stable step, what governs it, the quads that have the smallest, and the mass that is added
   !> for a larger one
   subroutine write_step(unit, model, domain)
      !> Unit of the listing
      integer, intent(in) :: unit
      type(model_type), intent(in) :: model
      type(domain_type), intent(in) :: domain

      character(:), allocatable :: time

      time = " "//trim(model%control%units%time)
      call write_section(unit, "Stable step")
      associate (limit => domain%limit)
         write (unit, "(a,es12.5,a)") "stable step                  ", limit%step, time
         if (size(domain%inertia%added) > 0) write (unit, "(a,es12.5,a)") &
            & "without added mass           ", limit%unscaled_step, time
         write (unit, "(a)") "governed by                   "//governor(domain)
         write (unit, "(a,es12.5,a)") "plies alone                  ", &
            & 2.0_wp/sqrt(limit%slowest(1)%rate), time
         if (domain%control%scheme /= implicit_thickness .and. limit%plane_rate > 0.0_wp) then
            write (unit, "(a,es12.5,a)") "thickness implicit, about    ", &
               & 2.0_wp/sqrt(limit%plane_rate), time
         end if
         if (limit%interface_rate > 0.0_wp) then
            write (unit, "(a,es12.5,2a)") "interfaces alone             ", &
               & 2.0_wp/sqrt(limit%interface_rate), time, &
               & trim(merge("; implicit, no limit", "                    ", &
               & domain%control%scheme /= all_explicit .and. limit%interface_rest <= 0.0_wp))
         end if
         write (unit, "(a,es12.5,3a)") "largest step taken           ", domain%step, time, &
            & ", TSSFAC "//text(domain%control%step_share())//share_source(domain), &
            & trim(merge(", DTMAX or LCTM", "               ", domain%step &
            & < domain%control%step_share()*limit%step))
      end associate
      call write_room(unit, domain)
      call write_added(unit, model, domain)
      call write_smallest(unit, model, domain)
      call write_mass_scaling(unit, model, domain)
   end subroutine write_step

   !> Where the share of the stable step comes from, if not from the deck
   function share_source(domain) result(words)
      type(domain_type), intent(in) :: domain
      character(:), allocatable :: words

      words = ""
      if (domain%control%step_factor > 0.0_wp) return
      words = " (linear strain)"
      if (domain%control%kinematics == total_lagrangian) words = " (large displacement)"
   end function share_source

   !> What governs the step without added mass
   function governor(domain) result(words)
      type(domain_type), intent(in) :: domain
      character(:), allocatable :: words

      associate (limit => domain%limit)
         associate (group => domain%groups(limit%slowest(1)%group)%item)
            words = group%element_kind//" "//text(limit%element_id)//", "//group%layer_kind &
               & //" "//text(limit%slowest(1)%layer)
         end associate
         if (limit%interface_rest > limit%slowest(1)%rate) then
            words = "the springs of interfaces"
         else if (limit%plane_rate <= 0.0_wp) then
            return
         else if (limit%plane_rate < plane_share*limit%slowest(1)%rate) then
            words = words//", its thickness"
         else
            words = words//", its size in the plane"
         end if
      end associate
   end function governor

   !> Note where large displacement leaves waves through the plies little room; see section 10 of
   !> the theory
   subroutine write_room(unit, domain)
      integer, intent(in) :: unit
      type(domain_type), intent(in) :: domain

      real(wp) :: share

      associate (limit => domain%limit)
         share = 0.5_wp*domain%step*sqrt(limit%element_rate)
         if (domain%control%kinematics /= total_lagrangian .or. limit%plane_rate <= 0.0_wp) return
         if (limit%plane_rate >= plane_share*limit%slowest(1)%rate) return
         if (share <= roomy_share + slack) return
      end associate
      write (unit, "(5a)") "note: large displacement, ", fixed_text(share, 3), " of the stable ", &
         & "step of plies: after a hard impact, waves that strain a ply by some per cent may ", &
         & "become unstable; with TSSFAC 0.8 strains up to 14 % stay stable"
   end subroutine write_room

   !> How much inertia the implicit operators add
   subroutine write_added(unit, model, domain)
      integer, intent(in) :: unit
      type(model_type), intent(in) :: model
      type(domain_type), intent(in) :: domain

      character(:), allocatable :: units
      real(wp) :: lightest
      integer :: k

      if (domain%control%scheme == all_explicit) return
      units = " "//trim(model%control%units%mass)//"/"//trim(model%control%units%length)//"2"
      lightest = huge(1.0_wp)
      associate (layers => domain%layers, ply => model%parts(1)%plies)
         do k = 1, size(layers%ply)
            lightest = min(lightest, model%materials(ply(layers%ply(k))%material)%density &
               & *ply(layers%ply(k))%thickness)
         end do
      end associate
      write (unit, "(a,es12.5,2a)") "mass of the lightest ply     ", lightest, units
      if (size(domain%inertia%pairs%inertia) > 0) then
         write (unit, "(a,es12.5,a,es12.5,2a)") "inertia added to interfaces  ", &
            & maxval(domain%inertia%pairs%inertia(3, :)), " (opening),", &
            & maxval(domain%inertia%pairs%inertia(1:2, :)), " (sliding)", units
      end if
      if (domain%inertia%thickness%active) then
         write (unit, "(a,es12.5,a,es12.5,2a)") "inertia added to plies       ", &
            & largest_stretch(domain, 3), " (stretch),", largest_stretch(domain, 1), " (shear)", &
            & units
      end if
   end subroutine write_added

   !> Largest inertia per area against the relative motion of both faces of a layer, linear
   !> between them
   pure real(wp) function largest_stretch(domain, direction) result(largest)
      type(domain_type), intent(in) :: domain
      !> 1 for x and y, 3 for z
      integer, intent(in) :: direction
      integer :: f, p

      largest = 0.0_wp
      do f = 1, size(domain%inertia%thickness%stretches)
         associate (stretch => domain%inertia%thickness%stretches(f), &
            & z => domain%columns%order_groups(f)%expansion%node)
            largest = max(largest, maxval(sum(reshape([(0.25_wp*(z(stretch%level(2, p)) &
               & - z(stretch%level(1, p)))**2*stretch%inertia(:, p, direction, 1), &
               & p=1, size(stretch%level, 2))], [size(stretch%inertia, 1), &
               & size(stretch%level, 2)]), 2)))
         end associate
      end do
   end function largest_stretch

   !> Table of the quads with the smallest steps without added mass
   subroutine write_smallest(unit, model, domain)
      integer, intent(in) :: unit
      type(model_type), intent(in) :: model
      type(domain_type), intent(in) :: domain

      type(table_type) :: table
      integer :: i

      write (unit, "(a)") ""
      call table%start(unit)
      associate (group => domain%groups(domain%limit%slowest(1)%group)%item)
         call table%add_column(group%element_kind, 8, "i0")
         call table%add_column(group%layer_kind, 6, "i0")
      end associate
      call table%add_column("step ["//trim(model%control%units%time)//"]", 12, "es12.5")
      call table%write_heads()
      do i = 1, size(domain%limit%slowest)
         associate (slow => domain%limit%slowest(i))
            call table%put(model%mesh%element_id(domain%groups(slow%group)%item%element_kind, &
               & slow%element))
            call table%put(slow%layer)
            call table%put(2.0_wp/sqrt(slow%rate))
         end associate
      end do
   end subroutine write_smallest

   !> A warning where much mass is added to a run that nothing watches the kinetic energy of; empty
   !> otherwise
   function added_mass_warning(domain) result(words)
      !> The domain, of any rank
      type(domain_type), intent(in) :: domain
      character(:), allocatable :: words

      type(added_mass_type) :: total

      words = ""
      if (size(domain%inertia%added) == 0 .or. domain%control%kinetic_limit > 0.0_wp) return
      total = total_of(domain%inertia%added)
      if (total%added <= most_added*total%own) return
      words = "warning: mass scaling (DT2MS of *CONTROL_TIMESTEP) adds " &
         & //fixed_text(share_of(total), 2)//" % to the mass of the plate, more than " &
         & //fixed_text(per_cent*most_added, 0)//" %: where the run is to be quasi-static, let " &
         & //"*CONTROL_QUASI_STATIC watch the kinetic energy; else take a DT2MS nearer to 0"
   end function added_mass_warning

   !> What the deck asks for, and the mass that each part gets
   subroutine write_mass_scaling(unit, model, domain)
      integer, intent(in) :: unit
      type(model_type), intent(in) :: model
      type(domain_type), intent(in) :: domain

      character(:), allocatable :: time

      if (domain%control%mass_scaled_step <= 0.0_wp) return
      time = " "//trim(model%control%units%time)
      call write_section(unit, "Mass scaling")
      write (unit, "(a,es12.5,2a)") "stable step asked for        ", &
         & domain%control%mass_scaled_step, time, ", DT2MS"
      write (unit, "(a,es12.5,a)") "stable step without it       ", domain%limit%unscaled_step, time
      if (size(domain%inertia%added) == 0) then
         write (unit, "(a)") "no mass is added: no element has a smaller step"
         return
      end if
      if (domain%limit%step < domain%control%mass_scaled_step) then
         write (unit, "(a,es12.5,a)") "no more than                 ", domain%limit%step, &
            & time//": quads that may crack take no mass"
      end if
      write (unit, "(a)") ""
      call write_parts(unit, trim(model%control%units%mass), domain%inertia%added)
   end subroutine write_mass_scaling

   !> Table of the parts, and their sum
   subroutine write_parts(unit, mass, added)
      integer, intent(in) :: unit
      !> Unit of mass
      character(*), intent(in) :: mass
      !> All parts
      type(added_mass_type), intent(in) :: added(:)

      type(table_type) :: table
      integer :: p

      call table%start(unit)
      call table%add_column("part", 8, "a")
      call table%add_column("mass ["//mass//"]", 14, "es14.7")
      call table%add_column("added ["//mass//"]", 14, "es14.7")
      call table%add_column("added [%]", 10, "f10.4")
      call table%add_column("elements", 9, "i0")
      call table%add_column("with more", 9, "i0")
      call table%add_column("most times", 10, "f10.4")
      call table%write_heads()
      do p = 1, size(added)
         ! quads that may crack take no mass, and have none here
         if (added(p)%own <= 0.0_wp) cycle
         call write_row(text(added(p)%part), added(p))
      end do
      call write_row("all", total_of(added))

   contains

      !> A line of the table
      subroutine write_row(name, row)
         character(*), intent(in) :: name
         type(added_mass_type), intent(in) :: row

         call table%put(name)
         call table%put([row%own, row%added, share_of(row)])
         call table%put(row%elements)
         call table%put(row%raised)
         call table%put(row%largest)
      end subroutine write_row

   end subroutine write_parts

   !> Sum of all parts
   pure type(added_mass_type) function total_of(parts) result(total)
      type(added_mass_type), intent(in) :: parts(:)

      total%own = sum(parts%own)
      total%added = sum(parts%added)
      total%elements = sum(parts%elements)
      total%raised = sum(parts%raised)
      total%largest = maxval(parts%largest)
   end function total_of

   !> Added mass in per cent of the mass without it; 0 where no element takes any
   pure real(wp) function share_of(part) result(share)
      type(added_mass_type), intent(in) :: part

      share = 0.0_wp
      if (part%own > 0.0_wp) share = per_cent*part%added/part%own
   end function share_of

end module plydyn_io_listing_time_step
