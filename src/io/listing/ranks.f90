!> What the listing says of the ranks of a run.
module plydyn_io_listing_ranks
   use plydyn_base_precision, only : wp
   use plydyn_base_text, only : fixed_text
   use plydyn_io_listing_table, only : write_section
   implicit none
   private

   public :: write_ranks

   !> What each rank has, in the order of the table's columns
   integer, parameter, public :: rank_numbers = 7

   !> Bytes in a kilobyte and in a megabyte
   real(wp), parameter :: kilobyte = 1.0e3_wp, megabyte = 1.0e6_wp

contains

   !> What each rank has and sends
   subroutine write_ranks(unit, ranks)
      !> Unit of the listing
      integer, intent(in) :: unit
      !> Chunks, nodes, nodes that another rank counts, ranks that it meets, bytes that it sends
      !> them in a step, and bytes of mesh and motion and of histories, (`rank_numbers`, ranks)
      real(wp), intent(in) :: ranks(:, :)
      integer :: r

      call write_section(unit, "Ranks")
      write (unit, "(a)") "rank   chunks    nodes  shared  meets  sends in a step [kB]" &
         & //"  mesh, motion [MB]  histories [MB]"
      do r = 1, size(ranks, 2)
         write (unit, "(i4,i9,i9,i8,i7,f22.3,f19.3,f16.3)") r - 1, nint(ranks(:4, r)), &
            & ranks(5, r)/kilobyte, ranks(6:7, r)/megabyte
      end do
      if (any(ranks(1, :) < 1.0_wp)) then
         write (unit, "(a,i0,a)") "more ranks than chunks: ", count(ranks(1, :) < 1.0_wp), &
            & " of them have nothing to do"
      end if
      write (unit, "(2a)") "all ranks send in a step [kB] ", &
         & fixed_text(sum(ranks(5, :))/kilobyte, 3)
   end subroutine write_ranks

end module plydyn_io_listing_ranks
