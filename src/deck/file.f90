!> Files of a deck, read as a whole, and their lines; files that include each other.
module plydyn_deck_file
   use, intrinsic :: iso_fortran_env, only : int64
   use plydyn_base_file_identity, only : file_identity_type, identity_of, is_same_file, no_file, &
      & pipe_file, regular_file
   use plydyn_base_text, only : text
   use plydyn_deck_report, only : deck_location_type, report_type
   implicit none
   private

   public :: check_chain, cut_line, move_file, name_other_kind, read_content

   !> Status of a pipe with more than `most_bytes`
   integer, parameter :: too_long = -1000
   character(*), parameter :: line_feed = achar(10), carriage_return = achar(13)
   !> Blank characters at the end of a line
   character(*), parameter :: blanks = " "//achar(9)
   !> Byte order mark of UTF-8, which some editors write
   character(*), parameter :: byte_order_mark = char(239)//char(187)//char(191)
   !> First bytes of an HDF5 file
   character(*), parameter :: hdf5_mark = char(137)//"HDF"
   !> First bytes of a text of two bytes per character, as of redirected output on Windows
   character(2), parameter :: wide_marks(2) = [char(255)//char(254), char(254)//char(255)]
   !> Characters read from a pipe at a time
   integer, parameter :: buffer_length = 4096
   !> Most bytes of a file: its characters are counted in default integers
   integer(int64), parameter :: most_bytes = 2000000000_int64
   !> Most files that lead from a deck to one that is included, and most files of all decks
   integer, parameter :: most_depth = 100, most_files = 10000

   !> One file
   type, public :: file_type
      !> Path, as it is shown to the user, and everything in it
      character(:), allocatable :: path, content
      !> Index of the file that includes this one, 0 for the deck, and how many files lead to it
      integer :: parent = 0, depth = 0
      !> Its identity for the operating system; none for a stored file
      type(file_identity_type) :: identity
   end type file_type

   !> One line, as a part of the content of its file
   type, public :: line_type
      !> Index of the file, and number in it
      integer :: file = 0, number = 0
      !> First and last character in the content
      integer :: first = 1, last = 0
   end type line_type

contains

   !> Everything in a file
   subroutine read_content(path, content, wrong)
      !> Path of the file
      character(*), intent(in) :: path
      !> Its content, with a line feed at the end; why it cannot be read, empty when all went well
      character(:), allocatable, intent(out) :: content, wrong

      type(file_identity_type) :: identity
      integer :: status, unit

      identity = identity_of(path, follow=.true.)
      wrong = "cannot be read"
      select case (identity%kind)
      case (no_file)
         return
      case (pipe_file)
         call read_pipe(path, content, status)
      case (regular_file)
         if (identity%length > most_bytes) then
            wrong = "is larger than 2 GB"
            return
         end if
         ! files of the operating system itself say that they have no length
         if (identity%length == 0) call read_pipe(path, content, status)
         if (identity%length > 0) then
            open (newunit=unit, file=path, access="stream", form="unformatted", status="old", &
               & action="read", iostat=status)
            if (status /= 0) return
            allocate (character(identity%length) :: content, stat=status)
            if (status == 0) read (unit, iostat=status) content
            close (unit)
         end if
      case default
         wrong = "cannot be read: it is no regular file"
         return
      end select
      if (status == too_long) wrong = "is larger than 2 GB"
      if (status /= 0) return
      wrong = ""
      call tidy(content)
   end subroutine read_content

   !> Let a content end with a line feed, and begin without the mark of an editor
   subroutine tidy(content)
      character(:), allocatable, intent(inout) :: content

      if (len(content) == 0) content = line_feed
      if (content(len(content):) /= line_feed) content = content//line_feed
      if (content(:min(len(content), len(byte_order_mark))) == byte_order_mark) content = &
         & content(len(byte_order_mark) + 1:)
   end subroutine tidy

   !> Content of a pipe, or of an empty file: neither reports a size
   subroutine read_pipe(path, content, status)
      character(*), intent(in) :: path
      character(:), allocatable, intent(out) :: content
      !> 0 on success
      integer, intent(out) :: status

      character(:), allocatable :: longer
      character(buffer_length) :: piece
      integer :: length, part, unit

      open (newunit=unit, file=path, access="stream", form="formatted", status="old", &
         & action="read", iostat=status)
      if (status /= 0) return
      allocate (character(buffer_length) :: content)
      length = 0
      do
         read (unit, "(a)", advance="no", size=part, iostat=status) piece
         if (status > 0 .or. is_iostat_end(status)) exit
         if (length > most_bytes/2) then
            status = too_long
            exit
         end if
         if (length + part >= len(content)) then
            allocate (character(2*len(content)) :: longer)
            longer(:length) = content(:length)
            call move_alloc(longer, content)
         end if
         content(length + 1:length + part) = piece(:part)
         length = length + part
         if (.not. is_iostat_eor(status)) cycle
         length = length + 1
         content(length:length) = line_feed
      end do
      close (unit)
      if (is_iostat_end(status)) status = 0
      content = content(:length)
   end subroutine read_pipe

   !> Move a file without copying its content
   subroutine move_file(from, to)
      !> The file, empty afterwards, and its new place
      type(file_type), intent(inout) :: from, to

      call move_alloc(from%path, to%path)
      call move_alloc(from%content, to%content)
      to%parent = from%parent
      to%depth = from%depth
      to%identity = from%identity
   end subroutine move_file

   !> Name a file that cannot be a deck, of HDF5, with two bytes per character, with line ends of
   !> old machines or a recipe, and what to do with it
   pure subroutine name_other_kind(file, wrong, right)
      type(file_type), intent(in) :: file
      !> What it is, and what would be right; unchanged for a deck
      character(:), allocatable, intent(inout) :: wrong, right

      if (index(file%content(:min(len(file%content), len(hdf5_mark))), hdf5_mark) == 1) then
         wrong = "is an HDF5 file, not a deck"
         right = "a deck; 'plydyn restart FILE' continues from a restart file"
      else if (any(file%content(:min(2, len(file%content))) == wide_marks)) then
         wrong = "has characters of two bytes (UTF-16)"
         right = "a deck in UTF-8 or ASCII, as editors save it on request"
      else if (has_old_ends(file%content)) then
         wrong = "has no line feeds: its lines end with carriage returns alone"
         right = "lines that end with line feeds, as editors and tr '\r' '\n' make them"
      else if (index(file%path//" ", ".toml ") > 0 &
         & .and. file%content(:min(1, len(file%content))) /= "*") then
         wrong = "is a recipe, not a deck"
         right = "the deck that 'plydyn-pre deck "//file%path//"' makes"
      end if
   end subroutine name_other_kind

   !> Whether lines end with carriage returns alone, as those of old machines do
   pure logical function has_old_ends(content)
      !> Content that ends with a line feed
      character(*), intent(in) :: content

      has_old_ends = index(content, line_feed) == len(content) .and. &
         & index(content(:max(0, len(content) - 2)), carriage_return) > 0
   end function has_old_ends

   !> A file is none of those that lead to it, by whatever path, and there are not too many of them
   subroutine check_chain(files, file, place, report, is_fine)
      !> Files so far, and the file without its content
      type(file_type), intent(in) :: files(:), file
      !> Line that includes it
      type(deck_location_type), intent(in) :: place
      !> Findings
      type(report_type), intent(inout) :: report
      !> Whether it can be read
      logical, intent(out) :: is_fine

      integer :: ancestor

      is_fine = .false.
      ancestor = file%parent
      do while (ancestor > 0)
         associate (other => files(ancestor))
            if (other%path == file%path .or. is_same_file(other%identity, file%identity)) exit
         end associate
         ancestor = files(ancestor)%parent
      end do
      if (ancestor > 0) then
         call report%refuse(place, "the file '"//file%path//"' includes itself", &
            & "a file that does not lead back to one that is being read")
      else if (file%depth > most_depth) then
         call report%refuse(place, "the file '"//file%path//"' is the last of more than " &
            & //text(most_depth)//" that include each other", "files that are nested less deeply")
      else if (size(files) >= most_files) then
         call report%refuse(place, "the file '"//file%path//"' is one of more than " &
            & //text(most_files), "fewer *INCLUDE; a file may be included only where it is needed")
      else
         is_fine = .true.
      end if
   end subroutine check_chain

   !> Find the end of a line
   pure subroutine cut_line(content, next, line)
      !> Content of the file
      character(*), intent(in) :: content
      !> First character of the line in, of the next line out
      integer, intent(inout) :: next
      !> Number and range of characters, without trailing blanks and tabs
      type(line_type), intent(inout) :: line

      integer :: feed

      feed = next + index(content(next:), line_feed) - 1
      line%number = line%number + 1
      line%first = next
      next = feed + 1
      if (feed > line%first) then
         if (content(feed - 1:feed - 1) == carriage_return) feed = feed - 1
      end if
      line%last = line%first + verify(content(line%first:feed - 1), blanks, back=.true.) - 1
   end subroutine cut_line

end module plydyn_deck_file
