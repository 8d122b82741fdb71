!> Keywords of the frame of a deck, of the control of a run, and of its restarts.
module plydyn_input_declare_control
   use plydyn_base_precision, only : wp
   use plydyn_deck_declaration, only : extension, keyword_type, new_keyword, standard
   implicit none
   private

   public :: control_energy, control_layerwise, control_parallel, control_quasi_static, &
      & control_stage, control_termination, control_timestep, control_units, damping_global, &
      & damping_relaxation, database_binary_d3dump, database_binary_runrsf, delete_body, &
      & frame_keywords, title

   !> Most restart files that replace each other
   integer, parameter :: most_files = 99

   !> LS-DYNA's value for no limit on added mass
   real(wp), parameter :: no_mass_limit = 1.0e8_wp

contains

   !> Keywords that the parser reads itself
   function frame_keywords() result(keywords)
      type(keyword_type) :: keywords(7)

      keywords(1) = new_keyword("KEYWORD", standard, &
         & "First keyword of a deck; LONG=Y behind it gives every field 20 columns.")
      keywords(2) = new_keyword("COMMENT", standard, &
         & "Lines of comment, up to the next keyword.")
      keywords(3) = new_keyword("END", standard, &
         & "Last keyword of a deck. A deck without it is an error, since its end may be " &
         & //"missing.")
      keywords(4) = new_keyword("INCLUDE", standard, &
         & "Files that are read in place of this keyword.")
      keywords(4)%remark = "One path per line, relative to the file that includes it; the " &
         & //"folders of *INCLUDE_PATH come next. A file must not include itself."
      keywords(5) = new_keyword("INCLUDE_PATH", standard, &
         & "Folders in which include files are looked for, one per line.")
      keywords(6) = new_keyword("PARAMETER", standard, "Names for numbers.")
      keywords(6)%remark = "Up to four pairs on a line: in the first field R (real) or I " &
         & //"(integer) and the name, in the second the number. Any later field may hold &name " &
         & //"or -&name."
      keywords(7) = new_keyword("PARAMETER_EXPRESSION", standard, "Names for computed numbers.")
      keywords(7)%remark = "One on a line: R or I and the name in the first field, then the " &
         & //"expression to the end of the line; a line with a blank first field goes on with " &
         & //"it. Numbers, earlier parameters, pi, + - * / ** ( ), sqrt, sin, cos, tan " &
         & //"(radians), abs, exp, log (natural), min and max with two arguments. All " &
         & //"arithmetic is real."
   end function frame_keywords

   !> Title of the run
   function title() result(keyword)
      type(keyword_type) :: keyword

      keyword = new_keyword("TITLE", standard, "Title of the run.")
      keyword%once = .true.
      call keyword%add_text_card("TITLE", "title")
   end function title

   !> Names of units
   function control_units() result(keyword)
      type(keyword_type) :: keyword

      keyword = new_keyword("CONTROL_UNITS", standard, &
         & "Names of the units of the deck, for listings and result files.")
      keyword%once = .true.
      keyword%remark = "Nothing is converted: all numbers of a deck are in one consistent set of " &
         & //"units. Force, stress and energy follow from length, time and mass. Without the " &
         & //"keyword: mm, s, t, hence N, MPa, mJ."
      call keyword%add_word("LENGTH", "unit of length", "M MM CM UM", required=.true.)
      call keyword%add_word("TIME", "unit of time", "S SEC MS US", required=.true.)
      call keyword%add_word("MASS", "unit of mass", "KG G MG T TON MTRC_TON", required=.true.)
      call keyword%add_word("TEMP", "unit of temperature; nothing depends on it", "K C", &
         & required=.false.)
   end function control_units

   !> When to stop
   function control_termination() result(keyword)
      type(keyword_type) :: keyword

      keyword = new_keyword("CONTROL_TERMINATION", standard, "When the run ends.")
      keyword%once = .true.
      call keyword%add_real("ENDTIM", "time", "last time", above=0.0_wp)
      call keyword%add_integer("ENDCYC", "last cycle; 0 for none", default=0, least=0)
      call keyword%add_real("DTMIN", "-", &
         & "the run stops when the step falls below this share of the first one; 0 for never", &
         & default=0.0_wp, least=0.0_wp, most=1.0_wp)
      call keyword%add_unused("ENDENG")
      call keyword%add_unused("ENDMAS", neutral=[0.0_wp, no_mass_limit])
      call keyword%add_integer("NOSOL", "1 checks the deck and does not run", default=0, &
         & allowed=[0, 1])
   end function control_termination

   !> The time step
   function control_timestep() result(keyword)
      type(keyword_type) :: keyword

      keyword = new_keyword("CONTROL_TIMESTEP", standard, "The time step.")
      keyword%once = .true.
      call keyword%add_nonnegative("DTINIT", "time", "first step; 0 for the stable one")
      call keyword%add_real("TSSFAC", "-", &
         & "time-step scale factor: share of the stable step that is taken", &
         & default=0.9_wp, above=0.0_wp, most=1.0_wp)
      call keyword%zero_is_default()
      call keyword%add_unused("ISDO TSLIMT")
      call keyword%add_real("DT2MS", "time", "mass scaling: negative; elements with a " &
         & //"stable step below -DT2MS get mass added until they reach it; 0 for none", &
         & default=0.0_wp)
      call keyword%add_integer("LCTM", "curve of the largest step over time; 0 for none", &
         & default=0, least=0)
      call keyword%add_unused("ERODE MS1ST")
      call keyword%add_card(optional=.true.)
      call keyword%add_unused("DT2MSF DT2MSLC IMSCL UNUSED1 UNUSED2 RMSCL UNUSED3 IHDO")
      keyword%remark = "DT2MS scales a layer over a quad, or a brick, as one element: the step " &
         & //"is then TSSFAC times -DT2MS. Added mass has inertia and weight; the listing and " &
         & //"plydyn check tell how much there is of it in each part, with a warning above 5 % " &
         & //"unless *CONTROL_QUASI_STATIC watches the kinetic energy. A positive DT2MS, one " &
         & //"step for all elements, is refused. A restart may change the keyword: all its " &
         & //"fields count from there on, velocities stay, and the kinetic energy of the mass " &
         & //"that is added or taken is external work. See the theory, Mass scaling."
   end function control_timestep

   !> Energies
   function control_energy() result(keyword)
      type(keyword_type) :: keyword

      keyword = new_keyword("CONTROL_ENERGY", standard, &
         & "Energies to be computed in LS-DYNA; plydyn always computes all energies.")
      keyword%once = .true.
      call keyword%add_unused("HGEN RWEN SLNTEN RYLEN IRGEN MATEN DRLEN DISEN", &
         & neutral=[0.0_wp, 1.0_wp, 2.0_wp])
   end function control_energy

   !> Processors
   function control_parallel() result(keyword)
      type(keyword_type) :: keyword

      keyword = new_keyword("CONTROL_PARALLEL", standard, &
         & "Number of threads.")
      keyword%once = .true.
      call keyword%add_integer("NCPU", "number of threads; 0: as many as OMP_NUM_THREADS says. " &
         & //"ncpu=N of the command line has precedence. Results do not depend on it", &
         & default=0, least=0)
      call keyword%add_unused("NUMRHS")
      call keyword%add_unused("CONST", neutral=[0.0_wp, 1.0_wp])
      call keyword%add_unused("PARA")
   end function control_parallel

   !> Layer-wise plates
   function control_layerwise() result(keyword)
      type(keyword_type) :: keyword

      keyword = new_keyword("CONTROL_LAYERWISE", extension, &
         & "Kinematics, limits of energy and volume, and time integration scheme.")
      keyword%once = .true.
      call keyword%add_integer("KINEM", &
         & "0 linear strain, 1 large displacement (total Lagrangian)", default=1, allowed=[0, 1])
      call keyword%add_real("ENGLIM", "-", &
         & "the run stops when the energy balance is off by more than this share", &
         & default=0.05_wp, above=0.0_wp)
      call keyword%add_integer("IMPL", "0 explicit central differences, 1 interfaces locally " &
         & //"implicit: their stiffness does not limit the time step, 2 interfaces and " &
         & //"thickness: the thickness of plies does not limit it, either", &
         & default=0, allowed=[0, 1, 2])
      call keyword%add_nonnegative("DTMAX", "time", "largest step; 0 for none")
      call keyword%add_real("VOLLIM", "-", "with KINEM 1 the run stops when the volume of an " &
         & //"element at a Gauss point falls below this share of that at time zero", &
         & default=0.0_wp, most=1.0_wp)
      keyword%remark = "IMPL 1 and 2 allow a time step that is several times larger. They add " &
         & //"inertia to the opening and sliding of interfaces, and IMPL 2 also to stretch and " &
         & //"shear through the thickness. The added inertia is proportional to the square of " &
         & //"the step; the listing prints it, and DTMAX limits it. LS-DYNA's selective mass " &
         & //"scaling is similar. IMPL 2 does not work with *BOUNDARY_FACE_MOTION. See the " &
         & //"theory, Locally implicit operators."
   end function control_layerwise

   !> Damping in proportion to mass
   function damping_global() result(keyword)
      type(keyword_type) :: keyword

      keyword = new_keyword("DAMPING_GLOBAL", standard, &
         & "Mass-proportional damping: forces against the velocity of every point of the " &
         & //"plate.")
      keyword%once = .true.
      call keyword%add_unused("LCID")
      call keyword%add_nonnegative("VALDMP", "1/time", "force per mass and velocity")
      call keyword%add_unused("STX STY STZ SRX SRY SRZ")
   end function damping_global

   !> Dynamic relaxation
   function damping_relaxation() result(keyword)
      type(keyword_type) :: keyword

      keyword = new_keyword("DAMPING_RELAXATION", extension, "Brings the plate to rest by " &
         & //"dynamic relaxation, and ends the run there.")
      keyword%once = .true.
      keyword%remark = "Damping forces act against the velocity of every point of the plate. " &
         & //"The damping is critical for the lowest frequency of the present motion, which is " &
         & //"estimated every 50 steps. The deck of a restart may begin dynamic relaxation or, " &
         & //"with DRTOL 0, end it. Impactors are not damped. A message says when the plate is " &
         & //"at rest. See the theory, Dynamic relaxation."
      call keyword%add_real("DRTOL", "-", "the run ends normally when the kinetic energy is " &
         & //"below this share of the largest since dynamic relaxation began; 0 for no dynamic " &
         & //"relaxation", default=1.0e-4_wp, least=0.0_wp, most=1.0_wp)
   end function damping_relaxation

   !> Limit of the kinetic energy
   function control_quasi_static() result(keyword)
      type(keyword_type) :: keyword

      keyword = new_keyword("CONTROL_QUASI_STATIC", extension, "Checks that a run is " &
         & //"quasi-static.")
      keyword%once = .true.
      keyword%remark = "A warning gives the first time at which the kinetic energy of the " &
         & //"plate exceeds a share of the internal energy, and a message at the end gives the " &
         & //"largest share. The first tenth of the time with the present supports and loads is " &
         & //"not checked, since little energy is stored when loading begins. With FALL the run " &
         & //"ends normally behind that tenth, after the largest load has passed. The load is " &
         & //"measured by the power of the supports and loads, averaged over each hundredth of " &
         & //"that time. It is proportional to the force where they move at a constant velocity. " &
         & //"Where points are moved along x or y, the listing has the loading rate: passages of " &
         & //"a wave in the loading time, and the kinetic energy to be expected."
      call keyword%add_real("SHARE", "-", "kinetic energy over internal energy above which there " &
         & //"is a warning; 0 for none", default=0.05_wp, least=0.0_wp, most=1.0_wp)
      call keyword%add_real("FALL", "-", "share of the largest load so far below which the run " &
         & //"ends; 0 for no such end", default=0.0_wp, least=0.0_wp, most=1.0_wp)
   end function control_quasi_static

   !> Restart files that are kept
   function database_binary_d3dump() result(keyword)
      type(keyword_type) :: keyword

      keyword = new_keyword("DATABASE_BINARY_D3DUMP", standard, "Restart files that are kept.")
      keyword%once = .true.
      keyword%remark = "The files are JOB.dump01, JOB.dump02 and so on; there is one more at the " &
         & //"normal end. A run that is asked to stop writes the next one, with or without the " &
         & //"keyword."
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
      call keyword%add_integer(field, "number of the body", least=1)
   end function delete_body

end module plydyn_input_declare_control
