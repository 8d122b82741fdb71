# Say in version.f90 what is built: run at each build, so that the commit is that of the build.
# In an archive that git made, commit.txt has it; in a clone git is asked.
file(STRINGS ${SOURCE_DIR}/src/commit.txt PLYDYN_COMMIT)
if(PLYDYN_COMMIT MATCHES "Format")
  set(PLYDYN_COMMIT "commit unknown")
  execute_process(COMMAND git -C ${SOURCE_DIR} rev-parse --short HEAD
    OUTPUT_VARIABLE commit OUTPUT_STRIP_TRAILING_WHITESPACE ERROR_QUIET RESULT_VARIABLE status)
  if(status EQUAL 0)
    set(PLYDYN_COMMIT ${commit})
    execute_process(COMMAND git -C ${SOURCE_DIR} status --porcelain --untracked-files=no -- src
      CMakeLists.txt CMakePresets.json OUTPUT_VARIABLE changes ERROR_QUIET)
    if(changes)
      string(APPEND PLYDYN_COMMIT ", changed since")
    endif()
  endif()
endif()
# one flag on a line, however many there are
string(REPLACE " " " \" &\n         & //\"" PLYDYN_FLAGS "${FLAGS}")
configure_file(${SOURCE_DIR}/src/version.f90.in ${OUTPUT} @ONLY)
