!> Keywords of restart files.
module plydyn_input_declare_restart
   use plydyn_deck_declaration, only : keyword_type, new_keyword, standard
   implicit none
   private

   public :: database_binary_d3dump, database_binary_runrsf

   !> Most restart files that replace each other
   integer, parameter :: most_files = 99

contains

   !> Restart files that are kept
   function database_binary_d3dump() result(keyword)
      type(keyword_type) :: keyword

      keyword = new_keyword("DATABASE_BINARY_D3DUMP", standard, "Restart files that are kept.")
      keyword%once = .true.
      keyword%remark = "The files are JOB.dump01, JOB.dump02 and so on; there is one more at the " &
         & //"normal end. A run that is asked to stop writes the next one, with or without the " &
         & //"keyword."
      call keyword%add_card()
      call keyword%add_integer("CYCL", "steps between two files", least=1)
      call keyword%add_unused("LCDT BEAM NPLTC PSETID CID")
   end function database_binary_d3dump

   !> Restart files that replace each other
   function database_binary_runrsf() result(keyword)
      type(keyword_type) :: keyword

      keyword = new_keyword("DATABASE_BINARY_RUNRSF", standard, &
         & "Restart files that replace each other.")
      keyword%once = .true.
      keyword%remark = "The file is JOB.runrsf, or JOB.runrsf1 to JOB.runrsfNR in turn. It is " &
         & //"replaced in one stroke: whenever the run is killed, there is a whole one."
      call keyword%add_card()
      call keyword%add_integer("CYCL", "steps between two files", least=1)
      call keyword%add_integer("NR", "how many files there are, the oldest is replaced", &
         & default=1, least=1, most=most_files)
      call keyword%zero_is_default()
      call keyword%add_unused("BEAM NPLTC PSETID CID")
   end function database_binary_runrsf

end module plydyn_input_declare_restart
