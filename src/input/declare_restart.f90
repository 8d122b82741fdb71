!> Keywords of restart files.
module plydyn_input_declare_restart
   use plydyn_deck_declaration, only : keyword_type, new_keyword, standard
   implicit none
   private

   public :: restart_keywords

   !> Most restart files that replace each other
   integer, parameter :: most_files = 99

contains

   !> Keywords of restart files
   function restart_keywords() result(keywords)
      type(keyword_type) :: keywords(2)

      keywords(1) = kept_files()
      keywords(2) = running_files()
      keywords%once = .true.
   end function restart_keywords

   !> Restart files that are kept
   function kept_files() result(keyword)
      type(keyword_type) :: keyword

      keyword = new_keyword("DATABASE_BINARY_D3DUMP", standard, "Restart files that are kept.")
      keyword%remark = "The files are JOB.dump01, JOB.dump02 and so on; there is one more at the " &
         & //"normal end. A run that is asked to stop writes the next one, with or without the " &
         & //"keyword."
      call keyword%add_card()
      call keyword%add_integer("CYCL", "steps between two files", least=1)
      call keyword%add_unused("LCDT BEAM NPLTC PSETID CID")
   end function kept_files

   !> Restart files that replace each other
   function running_files() result(keyword)
      type(keyword_type) :: keyword

      keyword = new_keyword("DATABASE_BINARY_RUNRSF", standard, &
         & "Restart files that replace each other.")
      keyword%remark = "The file is JOB.runrsf, or JOB.runrsf1 to JOB.runrsfNR in turn. It is " &
         & //"replaced in one stroke: whenever the run is killed, there is a whole one."
      call keyword%add_card()
      call keyword%add_integer("CYCL", "steps between two files", least=1)
      call keyword%add_integer("NR", "how many files there are, the oldest is replaced", &
         & default=1, least=1, most=most_files)
      call keyword%zero_is_default()
      call keyword%add_unused("BEAM NPLTC PSETID CID")
   end function running_files

end module plydyn_input_declare_restart
