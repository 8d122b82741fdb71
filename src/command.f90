!> The command line.
module plydyn_command
   use plydyn_base_error, only : error_type, exit_usage, fail
   use plydyn_base_precision, only : wp
   use plydyn_base_text, only : lower_case, text
   implicit none
   private

   public :: read_command

   !> Usage
   character(*), parameter, public :: usage = &
      & "plydyn run DECK [-j JOB] [-o FOLDER]   run a deck; results are FOLDER/JOB.*" &
      & //new_line("a") &
      & //"plydyn restart FILE [DECK]             continue a run from a restart file; DECK may " &
      & //"change loads, supports or the end"//new_line("a") &
      & //"plydyn check DECK                      report all errors of a deck and print the " &
      & //"listing, without a run"//new_line("a") &
      & //"plydyn --keywords [NAME]               print the pages of all keywords, or of one" &
      & //new_line("a") &
      & //"plydyn --keywords --json               print all fields with unit, bounds and default" &
      & //new_line("a") &
      & //"plydyn --version                       print version, compiler and flags" &
      & //new_line("a") &
      & //"-p NAME=NUMBER                         value of a *PARAMETER of the deck" &
      & //new_line("a") &
      & //"--wall-time H:MM:SS                    stop after this time with a restart file" &
      & //new_line("a") &
      & //"i=DECK, r=FILE and jobid=JOB may replace DECK, restart FILE and -j JOB; " &
      & //"ncpu=N sets the number of threads"

   !> Content of the command line
   type, public :: command_type
      !> run, restart, check, --version, --keywords or --help
      character(:), allocatable :: action
      !> Path of the deck, empty for a restart without one
      character(:), allocatable :: deck
      !> Path of the restart file
      character(:), allocatable :: restart
      !> Path of the results without endings; empty for the one in the restart file
      character(:), allocatable :: job
      !> Folder to make for the results; empty where nothing is said
      character(:), allocatable :: folder
      !> Numbers for parameters, as in `velocity=3.0`, each with a line feed
      character(:), allocatable :: parameters
      !> Wall-clock limit, seconds
      real(wp) :: most_seconds = huge(1.0_wp)
      !> Keyword to explain; empty for all
      character(:), allocatable :: keyword
      !> Threads; 0 for no request
      integer :: threads = 0
   end type command_type

   !> Most threads that a run may ask for: more are a slip of the pen
   integer, parameter :: most_threads = 4096

contains

   !> Read the command line
   subroutine read_command(command, error)
      !> Content of the command line
      type(command_type), intent(out) :: command
      !> An argument that is not understood
      type(error_type), allocatable, intent(out) :: error

      character(:), allocatable :: word
      integer :: i

      command%action = ""
      command%deck = ""
      command%folder = ""
      command%job = ""
      command%keyword = ""
      command%restart = ""
      command%parameters = ""
      i = 1
      do while (i <= command_argument_count())
         word = argument(i)
         select case (word)
         case ("-j", "-o", "-p", "--wall-time")
            i = i + 1
            call take_option(word, argument(i), command, error)
         case default
            call take_word(word, command, error)
         end select
         if (allocated(error)) return
         i = i + 1
      end do
      call finish(command, error)
   end subroutine read_command

   !> One word of the command line
   function argument(i) result(word)
      integer, intent(in) :: i
      character(:), allocatable :: word
      integer :: length

      call get_command_argument(i, length=length)
      allocate (character(length) :: word)
      call get_command_argument(i, word)
   end function argument

   !> A word and the one that belongs to it
   subroutine take_option(word, value, command, error)
      character(*), intent(in) :: word, value
      type(command_type), intent(inout) :: command
      type(error_type), allocatable, intent(out) :: error

      if (len(value) == 0 .or. (any(word == ["-j", "-o"]) .and. index(value, "-") == 1)) then
         call fail(error, exit_usage, word//" needs a name after it")
         return
      end if
      select case (word)
      case ("-j"); call take_name("the job", value, command%job, error)
      case ("-o"); call take_name("the folder of the results", value, command%folder, error)
      case ("-p")
         if (index(value, "=") < 2) then
            call fail(error, exit_usage, "-p needs a name and a number after it, as in -p " &
               & //"velocity=3.0")
         else if (index(new_line("a")//lower_case(command%parameters), new_line("a") &
            & //lower_case(value(:index(value, "=")))) > 0) then
            call fail(error, exit_usage, "-p gives '"//value(:index(value, "=") - 1)//"' twice")
         end if
         command%parameters = command%parameters//value//new_line("a")
      case default
         if (command%most_seconds < huge(1.0_wp)) then
            call fail(error, exit_usage, "--wall-time is given twice")
            return
         end if
         command%most_seconds = seconds_of(value)
         if (command%most_seconds <= 0.0_wp) call fail(error, exit_usage, "--wall-time needs " &
            & //"hours, minutes and seconds after it, as in 11:45:00, or seconds")
      end select
   end subroutine take_option

   !> A name that may be given once
   subroutine take_name(what, value, name, error)
      !> What it is the name of, and the name
      character(*), intent(in) :: what, value
      !> Receives it; empty before
      character(:), allocatable, intent(inout) :: name
      type(error_type), allocatable, intent(out) :: error

      if (len(value) == 0) then
         call fail(error, exit_usage, what//" needs a name behind its =")
      else if (len(name) > 0) then
         call fail(error, exit_usage, what//" is given twice, as '"//name//"' and as '"//value//"'")
      end if
      name = value
   end subroutine take_name

   !> Seconds of h:mm:ss, m:ss or s; zero when it is none of them
   pure real(wp) function seconds_of(word) result(seconds)
      character(*), intent(in) :: word

      !> Most colons
      integer, parameter :: most_colons = 2
      integer :: begin, colon, i, status
      real(wp) :: part

      seconds = 0.0_wp
      if (count([(word(i:i) == ":", i=1, len(word))]) > most_colons) return
      begin = 1
      do
         colon = index(word(begin:)//":", ":")
         status = 1
         if (verify(word(begin:begin + colon - 2), "0123456789.") == 0 .and. colon > 1) then
            read (word(begin:begin + colon - 2), *, iostat=status) part
         end if
         if (status /= 0) then
            seconds = 0.0_wp
            return
         end if
         seconds = 60.0_wp*seconds + part
         begin = begin + colon
         if (begin > len(word)) return
      end do
   end function seconds_of

   !> A word that stands for itself
   subroutine take_word(word, command, error)
      character(*), intent(in) :: word
      type(command_type), intent(inout) :: command
      type(error_type), allocatable, intent(out) :: error

      integer :: equals

      equals = index(word, "=")
      if (equals > 0) then
         select case (lower_case(word(:equals - 1)))
         case ("i"); call take_name("the deck", word(equals + 1:), command%deck, error)
         case ("r"); call take_name("the restart file", word(equals + 1:), command%restart, error)
         case ("jobid"); call take_name("the job", word(equals + 1:), command%job, error)
         case ("ncpu"); call read_threads(word, word(equals + 1:), command%threads, error)
         case default
            call fail(error, exit_usage, "'"//word//"' is not understood"//new_line("a")//usage)
         end select
         if (len(command%action) == 0) command%action = "run"
         return
      end if
      select case (word)
      case ("--help", "-h")
         command%action = "--help"
      case ("run", "restart", "check", "--version", "--keywords")
         if (len(command%action) > 0) then
            call fail(error, exit_usage, "'"//command%action//"' and '"//word &
               & //"' cannot go together"//new_line("a")//usage)
         end if
         command%action = word
      case default
         if (command%action == "--keywords" .and. len(command%keyword) == 0) then
            command%keyword = word
         else if (command%action == "restart" .and. len(command%restart) == 0) then
            command%restart = word
         else if (len(command%deck) == 0 .and. word(1:min(1, len(word))) /= "-") then
            command%deck = word
         else if (len(command%action) == 0 .and. len(command%deck) > 0) then
            ! two words that are no command: the first stands where one should
            call fail(error, exit_usage, "'"//command%deck//"' is not understood" &
               & //new_line("a")//usage)
         else
            call fail(error, exit_usage, "'"//word//"' is not understood"//new_line("a")//usage)
         end if
      end select
   end subroutine take_word

   !> A number of threads
   subroutine read_threads(word, value, threads, error)
      !> The word and what follows its =
      character(*), intent(in) :: word, value
      integer, intent(inout) :: threads
      type(error_type), allocatable, intent(out) :: error

      integer :: status

      if (threads > 0) then
         call fail(error, exit_usage, "ncpu= is given twice")
         return
      end if
      threads = 0
      status = 1
      if (len(value) > 0 .and. verify(value, "0123456789") == 0) then
         read (value, *, iostat=status) threads
      end if
      if (status == 0 .and. threads > 0 .and. threads <= most_threads) return
      call fail(error, exit_usage, "'"//word//"' is not understood: ncpu= takes a number of " &
         & //"threads from 1 to "//text(most_threads))
   end subroutine read_threads

   !> Check for missing arguments, and set the name of the job
   subroutine finish(command, error)
      type(command_type), intent(inout) :: command
      type(error_type), allocatable, intent(out) :: error

      if (len(command%restart) > 0 .and. command%action == "run") command%action = "restart"
      if (is_folder(command%job)) then
         call fail(error, exit_usage, "'"//command%job//"' is no name of a job: right would be " &
            & //"the first part of the names of files, and -o for their folder")
         return
      end if
      select case (command%action)
      case ("--help")
         continue
      case ("run", "check")
         if (len(command%deck) == 0) then
            call fail(error, exit_usage, command%action//" needs a deck"//new_line("a")//usage)
         else if (len(command%restart) > 0) then
            call fail(error, exit_usage, "r= belongs to restart: NOSOL 1 on " &
               & //"*CONTROL_TERMINATION in the deck of the restart checks it")
         else
            call name_job(command%deck, command)
         end if
      case ("restart")
         if (len(command%restart) == 0) then
            call fail(error, exit_usage, "restart needs a restart file"//new_line("a")//usage)
         else if (len(command%parameters) > 0) then
            call fail(error, exit_usage, "-p belongs to run: a restart keeps the parameters that " &
               & //"the run began with")
         else if (len(command%job) > 0 .or. len(command%folder) > 0) then
            call name_job(command%restart, command)
         end if
      case default
         if (len(command%deck) > 0) then
            call fail(error, exit_usage, "'"//command%deck//"' is not understood"//new_line("a") &
               & //usage)
         else if (len(command%action) == 0) then
            call fail(error, exit_usage, usage)
         else if (command%threads > 0 .or. command%most_seconds < huge(1.0_wp) &
            & .or. len(command%job//command%folder//command%restart//command%parameters) > 0) then
            call fail(error, exit_usage, command%action//" takes none of the words that belong " &
               & //"to a run"//new_line("a")//usage)
         end if
      end select
   end subroutine finish

   !> Whether a path ends with a folder, and not with a name for files
   pure logical function is_folder(path)
      character(*), intent(in) :: path

      associate (name => path(index(path, "/", back=.true.) + 1:))
         is_folder = len(path) > 0 .and. (len(name) == 0 .or. name == "." .or. name == "..")
      end associate
   end function is_folder

   !> Path of the results
   subroutine name_job(path, command)
      !> Path of the deck or restart file
      character(*), intent(in) :: path
      type(command_type), intent(inout) :: command

      integer :: first, last

      if (len(command%job) == 0) then
         first = index(path, "/", back=.true.) + 1
         last = index(path, ".", back=.true.) - 1
         if (last < first) last = len(path)
         command%job = path(first:last)
      end if
      if (len(command%folder) > 0) command%job = command%folder//"/"//command%job
   end subroutine name_job

end module plydyn_command
