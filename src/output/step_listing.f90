!> The part of the listing that tells where the time step comes from.
module plydyn_output_step_listing
   use plydyn_base_precision, only : wp
   use plydyn_base_text, only : text
   use plydyn_domain_domain, only : domain_type
   use plydyn_model_control, only : all_explicit
   use plydyn_model_model, only : model_type
   use plydyn_output_table, only : table_type, write_section
   implicit none
   private

   public :: write_step

   !> Quads named in the table of smallest steps
   integer, parameter :: smallest_shown = 20

contains

   !> The stable step, what governs it, and the quads that have the smallest
   subroutine write_step(unit, model, domain)
      !> Unit of the listing
      integer, intent(in) :: unit
      !> The model
      type(model_type), intent(in) :: model
      !> The domain
      type(domain_type), intent(in) :: domain

      character(:), allocatable :: time

      time = " "//trim(model%control%units%time)
      call write_section(unit, "Stable step")
      associate (limit => domain%limit)
         write (unit, "(a,es12.5,a)") "stable step                  ", limit%step, time
         if (limit%interface_rest > limit%ply_rate) then
            write (unit, "(a)") "governed by                   the springs of interfaces"
         else
            write (unit, "(3a)") "governed by                   ", "quad "//text(limit%quad), &
               & ", ply "//text(limit%ply)
         end if
         write (unit, "(a,es12.5,a)") "plies alone                  ", &
            & 2.0_wp/sqrt(limit%ply_rate), time
         if (limit%interface_rate > 0.0_wp) then
            write (unit, "(a,es12.5,2a)") "interfaces alone             ", &
               & 2.0_wp/sqrt(limit%interface_rate), time, &
               & trim(merge("; implicit, no limit", "                    ", &
               & domain%control%scheme /= all_explicit .and. limit%interface_rest <= 0.0_wp))
         end if
         write (unit, "(a,es12.5,3a)") "largest step taken           ", domain%step, time, &
            & ", TSSFAC "//text(domain%control%step_factor), &
            & trim(merge(", DTMAX or LCTM", "               ", domain%step &
            & < domain%control%step_factor*limit%step))
      end associate
      call write_added(unit, model, domain)
      call write_smallest(unit, model, domain)
   end subroutine write_step

   !> How much inertia the implicit operators add
   subroutine write_added(unit, model, domain)
      integer, intent(in) :: unit
      type(model_type), intent(in) :: model
      type(domain_type), intent(in) :: domain

      character(:), allocatable :: units
      real(wp) :: lightest
      integer :: k

      if (.not. domain%pairs%active) return
      units = " "//trim(model%control%units%mass)//"/"//trim(model%control%units%length)//"2"
      lightest = huge(1.0_wp)
      associate (layers => domain%layers, ply => model%parts(1)%plies)
         do k = 1, size(layers%ply)
            lightest = min(lightest, model%materials(ply(layers%ply(k))%material)%density &
               & *ply(layers%ply(k))%thickness)
         end do
      end associate
      write (unit, "(a,es12.5,2a,es12.5)") "inertia added to opening     ", &
         & maxval(domain%pairs%inertia(3, :)), units, " at most; the lightest ply has", lightest
      write (unit, "(a,es12.5,2a)") "inertia added to sliding     ", &
         & maxval(domain%pairs%inertia(1:2, :)), units, " at most"
   end subroutine write_added

   !> Table of the quads with the smallest steps
   subroutine write_smallest(unit, model, domain)
      integer, intent(in) :: unit
      type(model_type), intent(in) :: model
      type(domain_type), intent(in) :: domain

      type(table_type) :: table
      logical :: left(size(domain%limit%quad_step))
      integer :: i, worst

      write (unit, "(a)") ""
      call table%start(unit)
      call table%add_column("quad", 8, "i0")
      call table%add_column("ply", 6, "i0")
      call table%add_column("step ["//trim(model%control%units%time)//"]", 12, "es12.5")
      call table%write_heads()
      left(:) = .true.
      associate (limit => domain%limit)
         do i = 1, min(smallest_shown, size(left))
            worst = minloc(limit%quad_step, 1, left)
            left(worst) = .false.
            call table%put(model%mesh%quad_id(worst))
            call table%put(limit%quad_ply(worst))
            call table%put(limit%quad_step(worst))
         end do
      end associate
   end subroutine write_smallest

end module plydyn_output_step_listing
