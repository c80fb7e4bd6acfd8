# Run at build time (cmake -DSOURCE=… -DOUTPUT=… -P): writes the commit of SOURCE to the header OUTPUT, and touches it
# only if that changed. What scripts write into the documentation leaves it as it is. Without git, or in a copy that is
# not itself a checkout, the hash is "unknown".
cmake_minimum_required(VERSION 3.25)
set(hash unknown)
find_program(GIT git)
if(GIT AND EXISTS ${SOURCE}/.git)
  execute_process(COMMAND ${GIT} -C ${SOURCE} rev-parse HEAD
    OUTPUT_VARIABLE commit OUTPUT_STRIP_TRAILING_WHITESPACE RESULT_VARIABLE failed ERROR_QUIET)
  if(NOT failed)
    set(hash ${commit})
    execute_process(COMMAND ${GIT} -C ${SOURCE} diff --quiet HEAD -- src cmake CMakeLists.txt CMakePresets.json
      RESULT_VARIABLE changed ERROR_QUIET)
    if(changed)
      string(APPEND hash -dirty)
    endif()
  endif()
endif()
file(CONFIGURE OUTPUT ${OUTPUT} CONTENT "#define PSEUDORIGID_GIT_HASH \"@hash@\"\n" @ONLY)
