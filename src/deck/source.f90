!> Lines of a deck and of all files that it includes, each with its file and number.
module plydyn_deck_source
   use plydyn_base_archive, only : bundle_type
   use plydyn_base_file_identity, only : identity_of
   use plydyn_base_text, only : text, upper_case
   use plydyn_deck_file, only : check_chain, cut_line, file_type, line_type, move_file, &
      & name_other_kind, read_content
   use plydyn_deck_report, only : deck_location_type, report_type
   implicit none
   private

   public :: add_source, begin_source

   !> A deck with its include files in place, without comments, with blank lines
   type, public :: source_type
      !> The files
      type(file_type), allocatable :: files(:)
      !> Number of files
      integer :: file_count = 0
      !> The lines
      type(line_type), allocatable :: lines(:)
      !> Number of lines
      integer :: line_count = 0
      !> Search path of include files: folders, each with a line feed
      character(:), allocatable :: include_path
      !> Whether the last deck has its *END
      logical :: ended = .false.
      !> Files that replace those on the disk
      type(bundle_type) :: stored
   contains
      procedure :: line
      procedure :: width
      procedure :: is_keyword
      procedure :: where
      procedure :: root
      procedure :: bundle
   end type source_type

   character(*), parameter :: line_feed = achar(10), carriage_return = achar(13)

contains

   !> A source without lines
   pure subroutine begin_source(source)
      !> The lines
      type(source_type), intent(out) :: source

      allocate (source%files(4), source%lines(1024), source%stored%documents(0))
      source%include_path = ""
   end subroutine begin_source

   !> Append a deck with all files that it includes
   subroutine add_source(path, source, report, stored)
      !> Path of the deck
      character(*), intent(in) :: path
      !> Receives its lines
      type(source_type), intent(inout) :: source
      !> Findings
      type(report_type), intent(inout) :: report
      !> Files that replace those on the disk
      type(bundle_type), intent(in), optional :: stored

      integer :: files

      source%ended = .false.
      source%include_path = ""
      if (present(stored)) source%stored = stored
      files = source%file_count
      call load(source, path, 0, 0, report)
      ! a deck that cannot be read is not reported as truncated, too
      if (source%file_count == files) source%ended = .true.
      deallocate (source%stored%documents)
      allocate (source%stored%documents(0))
   end subroutine add_source

   !> Number of the deck that a line belongs to, directly or by include files
   pure integer function root(self, i)
      class(source_type), intent(in) :: self
      !> Index of the line
      integer, intent(in) :: i

      integer :: file

      file = self%lines(i)%file
      do while (self%files(file)%parent > 0)
         file = self%files(file)%parent
      end do
      root = count(self%files(:file)%parent == 0)
   end function root

   !> The files of a deck, verbatim
   pure function bundle(self, root)
      class(source_type), intent(in) :: self
      !> 1 for the first deck
      integer, intent(in) :: root
      type(bundle_type) :: bundle

      integer :: deck, i

      allocate (bundle%documents(0))
      deck = 0
      do i = 1, self%file_count
         if (self%files(i)%parent == 0) deck = deck + 1
         if (deck == root) call bundle%add_document(self%files(i)%path, self%files(i)%content)
      end do
   end function bundle

   !> Text of a line
   pure function line(self, i) result(content)
      class(source_type), intent(in) :: self
      !> Index of the line
      integer, intent(in) :: i
      character(:), allocatable :: content

      content = self%files(self%lines(i)%file)%content(self%lines(i)%first:self%lines(i)%last)
   end function line

   !> Number of characters in a line
   pure integer function width(self, i)
      class(source_type), intent(in) :: self
      !> Index of the line
      integer, intent(in) :: i

      width = self%lines(i)%last - self%lines(i)%first + 1
   end function width

   !> Whether a line begins with a star
   pure logical function is_keyword(self, i)
      class(source_type), intent(in) :: self
      !> Index of the line
      integer, intent(in) :: i

      is_keyword = begins_with(self, self%lines(i), "*")
   end function is_keyword

   !> File and number of a line, as in `plate.k:12`
   pure function where(self, i) result(words)
      class(source_type), intent(in) :: self
      !> Index of the line
      integer, intent(in) :: i
      character(:), allocatable :: words

      words = self%files(self%lines(i)%file)%path//":"//text(self%lines(i)%number)
   end function where

   !> Read one file with all that it includes
   recursive subroutine load(source, path, parent, include_line, report)
      !> Lines so far
      type(source_type), intent(inout) :: source
      character(*), intent(in) :: path
      !> Index of the file that includes it, and line that names it
      integer, intent(in) :: parent, include_line
      type(report_type), intent(inout) :: report

      type(file_type) :: file
      type(deck_location_type) :: place
      character(:), allocatable :: right, wrong
      integer :: document
      logical :: is_fine

      place%keyword = merge("*INCLUDE", "        ", parent > 0)
      ! a deck that cannot be read is in no other one
      place%line = merge(include_line, -1, parent > 0)
      file%path = path
      file%parent = parent
      if (parent > 0) file%depth = source%files(parent)%depth + 1
      document = source%stored%find(path)
      if (document == 0) file%identity = identity_of(path, follow=.true.)
      call check_chain(source%files(:source%file_count), file, place, report, is_fine)
      if (.not. is_fine) return
      wrong = ""
      if (document > 0) then
         file%content = source%stored%documents(document)%content
      else
         call read_content(path, file%content, wrong)
      end if
      right = "the path of a file"//repeat(", relative to the file that includes it", &
         & merge(1, 0, parent > 0))
      if (len(wrong) == 0) call name_other_kind(file, wrong, right)
      if (len(wrong) == 0) then
         call add_file(source, file)
         call add_lines(source, (source%file_count), report)
      else
         call report%refuse(place, "the file '"//path//"' "//wrong, right)
      end if
   end subroutine load

   !> Append a file
   subroutine add_file(source, file)
      !> Files so far
      type(source_type), intent(inout) :: source
      !> The new one; its content moves
      type(file_type), intent(inout) :: file

      type(file_type), allocatable :: longer(:)
      integer :: i

      if (source%file_count == size(source%files)) then
         allocate (longer(2*source%file_count))
         do i = 1, source%file_count
            call move_file(source%files(i), longer(i))
         end do
         call move_alloc(longer, source%files)
      end if
      source%file_count = source%file_count + 1
      call move_file(file, source%files(source%file_count))
   end subroutine add_file

   !> Append the lines of a file, with those of include files in place
   recursive subroutine add_lines(source, file, report)
      type(source_type), intent(inout) :: source
      !> Index of the file
      integer, intent(in) :: file
      type(report_type), intent(inout) :: report

      type(line_type) :: line
      integer :: next, pending

      line%file = file
      next = 1
      pending = 0
      do while (next <= len(source%files(file)%content))
         call cut_line(source%files(file)%content, next, line)
         if (begins_with(source, line, "$")) cycle
         if (begins_with(source, line, "*")) call include_pending(source, pending, report)
         call add_line(source, line)
         if (.not. begins_with(source, line, "*")) cycle
         select case (upper_case(source%line(source%line_count)))
         case ("*END")
            if (source%files(file)%parent == 0) source%ended = .true.
            call warn_after_end(source, source%files(file)%content(next:), report)
            return
         case ("*INCLUDE", "*INCLUDE_PATH", "*INCLUDE_PATH_RELATIVE")
            pending = source%line_count
         case default
            pending = 0
         end select
      end do
      call include_pending(source, pending, report)
   end subroutine add_lines

   !> Whether a line begins with a character
   pure logical function begins_with(source, line, mark)
      !> Files
      type(source_type), intent(in) :: source
      !> A line of one of them
      type(line_type), intent(in) :: line
      !> One character
      character(1), intent(in) :: mark

      begins_with = .false.
      if (line%last < line%first) return
      begins_with = source%files(line%file)%content(line%first:line%first) == mark
   end function begins_with

   !> Append a line
   subroutine add_line(source, line)
      type(source_type), intent(inout) :: source
      !> The new one
      type(line_type), intent(in) :: line

      type(line_type), allocatable :: longer(:)

      if (source%line_count == size(source%lines)) then
         allocate (longer(2*source%line_count))
         longer(:source%line_count) = source%lines
         call move_alloc(longer, source%lines)
      end if
      source%line_count = source%line_count + 1
      source%lines(source%line_count) = line
   end subroutine add_line

   !> Read the files, or add the folders, that the last lines name
   recursive subroutine include_pending(source, pending, report)
      type(source_type), intent(inout) :: source
      !> Line of the *INCLUDE to process; 0 for none, and afterwards
      integer, intent(inout) :: pending
      type(report_type), intent(inout) :: report

      integer :: i, last

      if (pending == 0) return
      last = source%line_count
      do i = pending + 1, last
         if (source%width(i) == 0) cycle
         if (upper_case(source%line(pending)) == "*INCLUDE") then
            call load(source, found_path(source, i), (source%lines(i)%file), i, report)
         else
            source%include_path = source%include_path//relative_path(source, i)//"/"//line_feed
            call check_folder(source, i, report)
         end if
      end do
      pending = 0
   end subroutine include_pending

   !> Warn of a missing folder of *INCLUDE_PATH; stored decks need none
   subroutine check_folder(source, i, report)
      type(source_type), intent(in) :: source
      !> Line that names the folder
      integer, intent(in) :: i
      type(report_type), intent(inout) :: report

      type(deck_location_type) :: place
      logical :: exists

      inquire (file=relative_path(source, i)//"/.", exist=exists)
      if (exists .or. size(source%stored%documents) > 0) return
      place%line = i
      place%keyword = "*INCLUDE_PATH"
      call report%warn(place, "there is no folder '"//relative_path(source, i)//"'", &
         & "the path of a folder, relative to the file that this line is in")
   end subroutine check_folder

   !> Path of an include file: relative to the including file, or in a folder of *INCLUDE_PATH
   function found_path(source, i) result(path)
      type(source_type), intent(in) :: source
      !> Line that names the file
      integer, intent(in) :: i
      character(:), allocatable :: path

      character(:), allocatable :: name
      integer :: begin, last
      logical :: exists

      name = trim(adjustl(source%line(i)))
      path = relative_path(source, i)
      exists = is_there(source, path)
      begin = 1
      do while (.not. exists .and. begin <= len(source%include_path))
         last = begin + index(source%include_path(begin:), line_feed) - 2
         exists = is_there(source, source%include_path(begin:last)//name)
         if (exists) path = source%include_path(begin:last)//name
         begin = last + 2
      end do
   end function found_path

   !> Whether a file exists, stored or on the disk
   logical function is_there(source, path)
      type(source_type), intent(in) :: source
      character(*), intent(in) :: path

      is_there = source%stored%find(path) > 0
      if (.not. is_there) inquire (file=path, exist=is_there)
   end function is_there

   !> Path that a line names, relative to the file that the line is in
   pure function relative_path(source, i) result(path)
      type(source_type), intent(in) :: source
      !> Index of the line
      integer, intent(in) :: i
      character(:), allocatable :: path

      path = trim(adjustl(source%line(i)))
      if (path(1:1) == "/") return
      associate (asking => source%files(source%lines(i)%file)%path)
         path = asking(:index(asking, "/", back=.true.))//path
      end associate
   end function relative_path

   !> Warn of text after *END
   subroutine warn_after_end(source, rest, report)
      !> Lines so far, the last one is *END
      type(source_type), intent(in) :: source
      !> Text after it
      character(*), intent(in) :: rest
      type(report_type), intent(inout) :: report

      type(deck_location_type) :: place

      if (verify(rest, " "//line_feed//carriage_return) == 0) return
      place%line = source%line_count
      place%keyword = "*END"
      call report%warn(place, "text after *END is ignored", "*END as the last line")
   end subroutine warn_after_end

end module plydyn_deck_source
