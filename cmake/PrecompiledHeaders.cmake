# Precompiled headers: what many files include and nobody here edits, parsed once. Every source still includes what it
# uses, and is compiled without them where the option is off.
#
# Off with a compiler launcher: ccache keeps nothing of what is compiled with them. Off in the library alone, which has
# few sources.
if(CMAKE_CXX_COMPILER_LAUNCHER OR NOT PSEUDORIGID_PROGRAM)
  set(precompile OFF)
else()
  set(precompile ON)
endif()
option(PSEUDORIGID_PRECOMPILE "Precompile headers of libraries" ${precompile})

# pseudorigid_precompiled_headers(NAME HEADERS <header>… [LIBS target…]): a set of them. The flags and definitions with
# which it is made must be those with which it is used, so LIBS are those that bring definitions.
function(pseudorigid_precompiled_headers name)
  cmake_parse_arguments(SET "" "" "HEADERS;LIBS" ${ARGN})
  if(NOT PSEUDORIGID_PRECOMPILE)
    return()
  endif()
  set(source ${PROJECT_BINARY_DIR}/precompiled/${name}.cpp)
  file(CONFIGURE OUTPUT ${source} CONTENT "")
  add_library(pseudorigid_precompiled_${name} OBJECT EXCLUDE_FROM_ALL ${source})
  target_link_libraries(pseudorigid_precompiled_${name} PRIVATE pseudorigid_options ${SET_LIBS})
  target_precompile_headers(pseudorigid_precompiled_${name} PRIVATE ${SET_HEADERS})
endfunction()

# pseudorigid_precompiled(TARGET NAME): compiles the target, or the layer, with that set, and with the definitions of its libraries.
function(pseudorigid_precompiled target name)
  if(PSEUDORIGID_PRECOMPILE)
    pseudorigid_target(target ${target})
    target_precompile_headers(${target} REUSE_FROM pseudorigid_precompiled_${name})
    target_compile_definitions(${target} PRIVATE $<TARGET_PROPERTY:pseudorigid_precompiled_${name},COMPILE_DEFINITIONS>)
  endif()
endfunction()

# pseudorigid_not_precompiled(FILE…): sources where g++ 12 sees overflows in "literal" + std::string if the header of the
# latter is precompiled (GCC bug 105651).
function(pseudorigid_not_precompiled)
  set_source_files_properties(${ARGN} PROPERTIES SKIP_PRECOMPILE_HEADERS ON SKIP_UNITY_BUILD_INCLUSION ON)
endfunction()
