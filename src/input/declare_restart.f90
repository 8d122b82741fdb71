!> Keywords of restart files.
module plydyn_input_declare_restart
   use plydyn_deck_declaration, only : extension, keyword_type, new_keyword, standard
   implicit none
   private

   public :: control_stage, database_binary_d3dump, database_binary_runrsf, delete_body

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
      keyword%remark = "The file is JOB.runrsf, or JOB.runrsf1 to JOB.runrsfNR in turn. A new " &
         & //"file replaces the old one only when it is complete, so that there is a complete " &
         & //"file whenever the run is killed."
      call keyword%add_card()
      call keyword%add_integer("CYCL", "steps between two files", least=1)
      call keyword%add_integer("NR", "how many files there are, the oldest is replaced", &
         & default=1, least=1, most=most_files)
      call keyword%zero_is_default()
      call keyword%add_unused("BEAM NPLTC PSETID CID")
   end function database_binary_runrsf

   !> Times of the deck of a restart
   function control_stage() result(keyword)
      type(keyword_type) :: keyword

      keyword = new_keyword("CONTROL_STAGE", extension, "Start of time in the deck of a " &
         & //"restart (a stage).")
      keyword%once = .true.
      keyword%remark = "The end of the stage before is usually not known in advance. The time " &
         & //"of the restart file is therefore added to ENDTIM and to the abscissas of the " &
         & //"curves of this deck."
      call keyword%add_card()
      call keyword%add_integer("TIME", "1 ENDTIM and the curves of this deck count from the " &
         & //"restart, 0 from the beginning of the run", default=1, allowed=[0, 1])
   end function control_stage

   !> Bodies that a restart removes
   function delete_body(kind, field) result(keyword)
      !> IMPACTOR or FIXTURE
      character(*), intent(in) :: kind
      !> Name of the number
      character(*), intent(in) :: field
      type(keyword_type) :: keyword

      keyword = new_keyword("DELETE_"//kind, extension, "Bodies that a restart removes.", &
         & repeated=.true.)
      keyword%remark = "For a deck that changes a run. New bodies need new " &
         & //"numbers. The kinetic energy of impactors leaves the energy balance as " &
         & //"external work."
      call keyword%add_card()
      call keyword%add_integer(field, "number of the body", least=1)
   end function delete_body

end module plydyn_input_declare_restart
