# Say in version.f90 what is built: run at each build, so that the commit is that of the build.
execute_process(COMMAND git -C ${SOURCE_DIR} rev-parse --short HEAD
  OUTPUT_VARIABLE PLYDYN_COMMIT OUTPUT_STRIP_TRAILING_WHITESPACE ERROR_QUIET)
# one flag on a line, however many there are
string(REPLACE " " " \" &\n         & //\"" PLYDYN_FLAGS "${FLAGS}")
configure_file(${SOURCE_DIR}/src/version.f90.in ${OUTPUT} @ONLY)
