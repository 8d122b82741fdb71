!> The part of the listing on mass that is added so that the step is longer.
module plydyn_io_listing_mass_scaling
   use plydyn_base_precision, only : wp
   use plydyn_base_text, only : fixed_text, text
   use plydyn_domain_domain, only : added_mass_type, domain_type
   use plydyn_io_listing_table, only : table_type, write_section
   use plydyn_model_model, only : model_type
   implicit none
   private

   public :: added_mass_warning, write_mass_scaling

   !> Share of the mass of a model above which added mass is warned of
   real(wp), parameter :: most_added = 0.05_wp
   !> Parts of a whole
   real(wp), parameter :: per_cent = 100.0_wp

contains

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
      !> Unit of the listing
      integer, intent(in) :: unit
      type(model_type), intent(in) :: model
      !> The domain, of any rank
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

end module plydyn_io_listing_mass_scaling
