!> Requests to a running job in its control file JOB.ctl.
module plydyn_run_control_file
   use, intrinsic :: ieee_arithmetic, only : ieee_is_finite
   use plydyn_base_file_identity, only : file_identity_type, identity_of, no_file, regular_file
   use plydyn_base_files, only : rename_file
   use plydyn_base_precision, only : wp
   use plydyn_base_text, only : lower_case, text
   implicit none
   private

   public :: take_requests

   !> Requests of a control file
   type, public :: control_requests_type
      !> End with a restart file; write a restart file and go on
      logical :: stop = .false., dump = .false.
      !> Write a field state; write a progress line; flush histories to the disk
      logical :: plot = .false., status = .false., flush = .false.
      !> New end time; negative for none
      real(wp) :: end_time = -1.0_wp
      !> Answer to the file, a line for each of its lines
      character(:), allocatable :: answer
   end type control_requests_type

   !> Behind the name of a file of requests that was read
   character(*), parameter :: was_read = ".read"
   !> Longest line, most lines that are read, and most that are answered one by one
   integer, parameter :: longest = 200, most = 100000, most_answers = 100
   character(*), parameter :: words = "stop, dump, plot, status, flush, end-time TIME " &
      & //"(or sw1, sw3, sw4, sw2, d3kil)"

contains

   !> Read the file of requests, if there is one, and set it aside
   subroutine take_requests(path, time, requests, found)
      !> Path of the file
      character(*), intent(in) :: path
      !> Time now
      real(wp), intent(in) :: time
      !> Its requests
      type(control_requests_type), intent(out) :: requests
      !> Whether there was such a file
      logical, intent(out) :: found

      type(file_identity_type) :: identity
      logical :: good

      requests%answer = ""
      identity = identity_of(path, follow=.true.)
      found = identity%kind /= no_file
      if (.not. found) return
      ! renamed it is no longer written to, and is read once
      call rename_file(path, path//was_read, good)
      if (good .and. identity%kind == regular_file) call take_lines(path, time, requests, good)
      if (.not. good) then
         requests%answer = path//": cannot be read and is ignored"
      else if (identity%kind /= regular_file) then
         requests%answer = path//": ignored, since it is no regular file"
      end if
   end subroutine take_requests

   !> All lines of the file that was set aside
   subroutine take_lines(path, time, requests, good)
      !> Path that the file had
      character(*), intent(in) :: path
      !> Time now
      real(wp), intent(in) :: time
      !> Its requests
      type(control_requests_type), intent(inout) :: requests
      !> Whether it could be read
      logical, intent(out) :: good

      character(longest + 1) :: line
      character(:), allocatable :: answers
      integer :: i, status, unit

      answers = ""
      open (newunit=unit, file=path//was_read, status="old", action="read", iostat=status)
      good = status == 0
      if (.not. good) return
      do i = 1, most
         read (unit, "(a)", iostat=status) line
         if (status /= 0) exit
         if (len_trim(line) > 0) call take_line(path, trim(adjustl(line)), time, requests)
         if (i == most_answers) answers = requests%answer
         if (i > most_answers) requests%answer = answers
      end do
      close (unit)
      if (i > most_answers + 1) requests%answer = answers//path//": and " &
         & //text(i - 1 - most_answers)//" more lines, which are read too"//new_line("a")
      if (i > most) requests%answer = requests%answer//path//": lines beyond " &
         & //text(most)//" are not read"//new_line("a")
   end subroutine take_lines

   !> One line
   subroutine take_line(path, line, time, requests)
      character(*), intent(in) :: path, line
      real(wp), intent(in) :: time
      type(control_requests_type), intent(inout) :: requests

      character(:), allocatable :: answer
      integer :: blank

      blank = scan(line//" ", " =")
      answer = "taken"
      select case (lower_case(line(:blank - 1)))
      case ("stop", "sw1", "d3kil"); requests%stop = .true.
      case ("dump", "sw3"); requests%dump = .true.
      case ("plot", "sw4"); requests%plot = .true.
      case ("status", "sw2"); requests%status = .true.
      case ("flush"); requests%flush = .true.
      case ("end-time")
         call take_end_time(line(blank + verify(line(blank:)//"x", " =") - 1:), time, requests, &
            & answer)
         blank = len(line) + 1
      case default
         answer = "not understood and ignored; right would be "//words
      end select
      if (len(line) > longest .and. answer == "taken") then
         answer = "taken; ignored is what follows column "//text(longest)
      else if (answer == "taken" .and. blank < len(line)) then
         answer = "taken; ignored is what follows the first word"
      end if
      requests%answer = requests%answer//path//": '"//printable(line)//"' "//answer//new_line("a")
   end subroutine take_line

   !> A text with question marks in place of characters that are not printable
   pure function printable(line) result(shown)
      character(*), intent(in) :: line
      character(len(line)) :: shown
      integer :: i

      do i = 1, len(line)
         shown(i:i) = merge(line(i:i), "?", line(i:i) >= " " .and. line(i:i) <= "~")
      end do
   end function printable

   !> A new end time, not before now
   subroutine take_end_time(word, time, requests, answer)
      character(*), intent(in) :: word
      real(wp), intent(in) :: time
      type(control_requests_type), intent(inout) :: requests
      character(:), allocatable, intent(inout) :: answer

      real(wp) :: wanted
      integer :: status

      status = verify(trim(word), "0123456789.eEdD+-")
      if (status == 0) read (word, *, iostat=status) wanted
      if (status == 0) status = merge(0, 1, ieee_is_finite(wanted))
      if (status /= 0) then
         answer = "not understood and ignored; right would be a time, as in end-time 0.005"
      else if (wanted <= time) then
         answer = "ignored: the run is at time "//text(time)//" already"
      else
         requests%end_time = wanted
      end if
   end subroutine take_end_time

end module plydyn_run_control_file
