!> The history of delamination: area and energy of every interface that can fail.
module plydyn_io_csv_delamination_history
   use plydyn_base_error, only : error_type
   use plydyn_base_precision, only : lanes, wp
   use plydyn_base_text, only : text
   use plydyn_domain_delamination, only : interface_ply
   use plydyn_domain_domain, only : domain_type
   use plydyn_model_control, only : units_type
   use plydyn_io_checkpoint_file_positions, only : file_positions_type
   use plydyn_io_csv_history_recorder, only : history_recorder_type
   use plydyn_io_csv_global_history, only : global_history_type
   implicit none
   private

   public :: failing_interfaces

   !> The file
   type, public, extends(history_recorder_type) :: delamination_history_type
      private
      !> Interfaces that can fail, counted from the bottom
      integer, allocatable :: interfaces(:)
   contains
      procedure :: open => open_delamination
      procedure :: record => record_delamination
   end type delamination_history_type

contains

   !> Interfaces that can fail, counted from the bottom
   pure function failing_interfaces(domain) result(interfaces)
      !> The domain
      type(domain_type), intent(in) :: domain
      integer, allocatable :: interfaces(:)

      logical :: fails(maxval(domain%layers%ply))
      integer :: b, k, l

      fails(:) = .false.
      do b = 1, size(domain%interfaces)
         if (domain%interfaces(b)%law%histories == 0) cycle
         do l = 1, lanes
            if (domain%interfaces(b)%lower(l) == 0) cycle
            fails(interface_ply(domain, domain%interfaces(b), l)) = .true.
         end do
      end do
      interfaces = pack([(k, k=1, size(fails))], fails)
   end function failing_interfaces

   !> Create the file, if something can fail
   subroutine open_delamination(self, path, units, interval, domain, places, error)
      class(delamination_history_type), intent(inout) :: self
      !> Path of the file
      character(*), intent(in) :: path
      !> Names of the units
      type(units_type), intent(in) :: units
      !> Time between two lines
      real(wp), intent(in) :: interval
      !> The domain
      type(domain_type), intent(in) :: domain
      !> Where to go on with files of an earlier run
      type(file_positions_type), intent(in) :: places
      !> Why it could not be created
      type(error_type), allocatable, intent(out) :: error

      character(40), allocatable :: names(:), unit(:)
      integer :: i, n

      self%interfaces = failing_interfaces(domain)
      n = size(self%interfaces)
      if (n == 0) return
      allocate (names(2*n + 3), unit(2*n + 3))
      names(1) = "time"
      unit(1) = units%time
      do i = 1, n
         names(1 + i) = "interface "//text(self%interfaces(i))//" area"
         names(3 + n + i) = "interface "//text(self%interfaces(i))//" energy"
      end do
      names(n + 2) = "sum"
      names(n + 3) = "projected area"
      unit(2:n + 3) = trim(units%length)//"2"
      unit(n + 4:) = units%energy
      call self%history%open(path, names, unit, interval, places, error)
   end subroutine open_delamination

   !> Add a line if one is due
   subroutine record_delamination(self, rows, time, is_last, error)
      class(delamination_history_type), intent(inout) :: self
      !> What the interfaces have lost
      type(global_history_type), intent(in) :: rows
      !> Time now
      real(wp), intent(in) :: time
      !> Whether the run ends here
      logical, intent(in) :: is_last
      !> Why it could not be written
      type(error_type), allocatable, intent(out) :: error

      if (.not. self%history%is_open()) return
      if (.not. (self%history%due(time) .or. is_last)) return
      associate (lost => rows%lost(self%interfaces))
         call self%history%record(time, [time, lost%failed, sum(lost%failed), &
            & rows%projected_area, lost%fracture + lost%closing + lost%friction], error)
      end associate
   end subroutine record_delamination

end module plydyn_io_csv_delamination_history
