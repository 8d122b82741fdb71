!> Columns that this rank counts, of those that it has.
module plydyn_io_owned_columns
   use plydyn_domain_domain, only : domain_type
   implicit none
   private

   public :: counted_columns

contains

   !> Whether each column is counted by this rank, not by another one that it meets there
   pure function counted_columns(domain) result(is_counted)
      !> The domain of this rank
      type(domain_type), intent(in) :: domain
      logical :: is_counted(domain%columns%count)

      integer :: c

      is_counted(:) = .true.
      do c = 1, size(domain%chunks%list)
         is_counted(domain%chunks%list(c)%ghost_columns) = .false.
      end do
   end function counted_columns

end module plydyn_io_owned_columns
