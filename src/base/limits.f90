!> Limits that the system sets to the program: stack and memory.
module plydyn_base_limits
   use, intrinsic :: iso_c_binding, only : c_int, c_long
   use plydyn_base_error, only : error_type, exit_run, fail
   use plydyn_base_precision, only : wp
   use plydyn_base_text, only : lower_case, text
   implicit none
   private

   public :: available_memory, bytes_left_by_groups, check_stacks

   !> Least stack of the program and of each of its threads, KiB. Kernels take a batch of scratch
   !> arrays from it, and nothing that grows with the mesh
   integer, parameter :: least_stack = 256
   real(wp), parameter :: kibibyte = 1024.0_wp
   !> Numbers of RLIMIT_STACK and RLIMIT_AS on Linux
   integer(c_int), parameter :: of_stack = 3_c_int, of_addresses = 9_c_int
   !> Longest line of a file that is read here
   integer, parameter :: line_length = 512

   !> C's struct rlimit; a negative number is no limit
   type, bind(c) :: limits_type
      integer(c_long) :: now = -1_c_long, most = -1_c_long
   end type limits_type

   interface
      integer(c_int) function c_getrlimit(resource, limits) bind(c, name="getrlimit")
         import :: c_int, limits_type
         implicit none
         integer(c_int), value :: resource
         type(limits_type), intent(out) :: limits
      end function c_getrlimit
   end interface

contains

   !> Refuse stacks that the program would overrun, of the first thread and of others
   subroutine check_stacks(error)
      !> Which is too small
      type(error_type), allocatable, intent(out) :: error

      character(*), parameter :: right = "; right would be: at least "
      character(20) :: value
      integer :: stack, status

      stack = int(min(limit_of(of_stack)/kibibyte, real(huge(stack), wp)))
      if (stack < least_stack) then
         call fail(error, exit_run, "the stack is limited to "//text(stack)//" KiB"//right &
            & //text(least_stack)//", as by ulimit -s 8192 before the run")
         return
      end if
      call get_environment_variable("OMP_STACKSIZE", value, status=status)
      if (status /= 0) return
      if (kibibytes(value) < least_stack) call fail(error, exit_run, "OMP_STACKSIZE limits the " &
         & //"stacks of threads to "//trim(value)//right//text(least_stack)//"K")
   end subroutine check_stacks

   !> Size in KiB of a text such as 512, 512k, 4M or 1G; the largest number if it is none
   integer function kibibytes(value)
      character(*), intent(in) :: value

      real(wp) :: number
      integer :: last, status

      kibibytes = huge(kibibytes)
      last = verify(trim(value), "0123456789 ") - 1
      if (last < 0) last = len_trim(value)
      read (value(:last), *, iostat=status) number
      if (status /= 0) return
      select case (lower_case(value(last + 1:last + 1)))
      case ("b"); number = number/kibibyte
      case ("m"); number = number*kibibyte
      case ("g"); number = number*kibibyte**2
      case default; continue   ! KiB
      end select
      kibibytes = int(min(number, real(huge(kibibytes), wp)))
   end function kibibytes

   !> Bytes that the program may still take: the least of what the machine has, its control groups
   !> and its limit of addresses leave
   real(wp) function available_memory() result(bytes)

      bytes = min(kibibyte*number_behind("/proc/meminfo", "MemAvailable:"), &
         & bytes_left_by_groups("/proc/self/cgroup", "/sys/fs/cgroup"), &
         & limit_of(of_addresses) - kibibyte*number_behind("/proc/self/status", "VmSize:"))
   end function available_memory

   !> A limit of the system, bytes; the largest number without one
   real(wp) function limit_of(resource)
      integer(c_int), intent(in) :: resource

      type(limits_type) :: limits

      limit_of = huge(1.0_wp)
      if (c_getrlimit(resource, limits) /= 0) return
      if (limits%now >= 0) limit_of = real(limits%now, wp)
   end function limit_of

   !> Bytes that the control groups of a process leave, those of version 2
   real(wp) function bytes_left_by_groups(list, root) result(bytes)
      !> File that names the groups of the process, and folder of all groups
      character(*), intent(in) :: list, root

      character(line_length) :: path
      integer :: status, unit
      real(wp) :: used

      bytes = huge(1.0_wp)
      open (newunit=unit, file=list, action="read", status="old", iostat=status)
      if (status /= 0) return
      path = ""
      do while (status == 0 .and. index(path, "0::/") /= 1)
         read (unit, "(a)", iostat=status) path
      end do
      close (unit)
      if (status /= 0) return
      path = path(4:)
      ! the group and those that it is in
      do
         associate (folder => root//trim(path)//"/")
            ! what cannot be given back
            used = number_behind(folder//"memory.stat", "anon ")
            if (used >= huge(1.0_wp)) used = 0.0_wp
            bytes = min(bytes, max(0.0_wp, number_behind(folder//"memory.max", "") - used))
         end associate
         if (len_trim(path) < 2) return
         path(index(path, "/", back=.true.):) = " "
      end do
   end function bytes_left_by_groups

   !> First number of the line of a file that begins with a word; the largest number without one
   real(wp) function number_behind(path, word) result(number)
      character(*), intent(in) :: path, word

      character(line_length) :: line
      integer :: status, unit

      number = huge(1.0_wp)
      open (newunit=unit, file=path, action="read", status="old", iostat=status)
      if (status /= 0) return
      do
         read (unit, "(a)", iostat=status) line
         if (status /= 0) exit
         if (index(line, word) /= 1) cycle
         read (line(len(word) + 1:), *, iostat=status) number
         if (status /= 0) number = huge(1.0_wp)
         exit
      end do
      close (unit)
   end function number_behind

end module plydyn_base_limits
