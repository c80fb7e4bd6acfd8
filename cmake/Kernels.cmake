# Kernels are the few sources that decide what a run costs. They are compiled for this machine (PSEUDORIGID_NATIVE) or,
# so that a package or a mixed cluster has full speed everywhere, once for each level of x86-64, and chosen when the
# program starts (src/mechanics/core/kernel_builds.h).
include(CheckCXXSourceCompiles)

# The levels, the best first.
set(pseudorigid_levels x86-64-v4 x86-64-v3 x86-64-v2)
foreach(level ${pseudorigid_levels})
  string(APPEND asks " + __builtin_cpu_supports(\"${level}\")")
endforeach()
set(CMAKE_REQUIRED_FLAGS -march=x86-64-v4)
check_cxx_source_compiles("int main() { return 0${asks}; }" PSEUDORIGID_HAS_LEVELS)
unset(CMAKE_REQUIRED_FLAGS)

if(PSEUDORIGID_NATIVE)
  set(pseudorigid_instructions native)
elseif(PSEUDORIGID_HAS_LEVELS)
  set(pseudorigid_instructions ${pseudorigid_levels})
else()
  set(pseudorigid_instructions generic)
endif()

# Without binutils a single build is compiled as it is, and shares inlined functions with the program.
if(CMAKE_OBJCOPY AND CMAKE_SYSTEM_NAME STREQUAL Linux AND NOT pseudorigid_instructions STREQUAL generic)
  set(PSEUDORIGID_JOINS_OBJECTS TRUE)
endif()

# pseudorigid_kernel_options(VARIABLE INSTRUCTIONS): how kernels are compiled for them. -Wno-psabi: wide vectors are
# passed between inlined functions only.
function(pseudorigid_kernel_options variable instructions)
  set(options -Wno-psabi)
  if(NOT instructions STREQUAL generic)
    list(APPEND options -march=${instructions})
  endif()
  if(PSEUDORIGID_SANITIZE)  # at -O1 their small functions are calls, and tests of the ball take hours
    list(APPEND options -O2)
  endif()
  set(${variable} ${options} PARENT_SCOPE)
endfunction()

# pseudorigid_native(FILE…): sources compiled as the kernels of this machine are.
function(pseudorigid_native)
  list(GET pseudorigid_instructions -1 instructions)
  pseudorigid_kernel_options(options ${instructions})
  set_source_files_properties(${ARGN} PROPERTIES COMPILE_OPTIONS "${options}" SKIP_PRECOMPILE_HEADERS ON)
endfunction()

# pseudorigid_kernels(TARGET SOURCES file… HEADER file TABLE type BUILDS function [LEVELS]): adds kernels to a target.
#
# One of the sources defines `extern const TABLE PSEUDORIGID_KERNEL_TABLE`; HEADER declares what is defined here, the
# function BUILDS, std::span<const KernelBuild<TABLE>>. No Eigen type whose alignment depends on the
# instructions may cross the functions of the table. LEVELS: all levels of x86-64 in any case.
function(pseudorigid_kernels target)
  cmake_parse_arguments(KERNELS "LEVELS" "HEADER;TABLE;BUILDS" "SOURCES" ${ARGN})
  set(all ${pseudorigid_instructions})
  if(KERNELS_LEVELS AND PSEUDORIGID_HAS_LEVELS)
    set(all ${pseudorigid_levels})
  endif()
  list(LENGTH all n_builds)
  set(declarations)
  set(builds)
  foreach(instructions ${all})
    string(MAKE_C_IDENTIFIER ${target}_${instructions} table)
    string(APPEND declarations "extern const ${KERNELS_TABLE} ${table};\n")
    if(instructions MATCHES "^x86-64")
      set(runs_here "__builtin_cpu_supports(\"${instructions}\") != 0")
    else()
      set(runs_here true)
    endif()
    string(APPEND builds "    {\"${instructions}\", [] { return ${runs_here}; }, &${table}},\n")
    pseudorigid_kernel_options(options ${instructions})
    if(instructions STREQUAL generic OR (n_builds EQUAL 1 AND NOT PSEUDORIGID_JOINS_OBJECTS))
      target_sources(${target} PRIVATE ${KERNELS_SOURCES})
      set_source_files_properties(${KERNELS_SOURCES} PROPERTIES SKIP_PRECOMPILE_HEADERS ON
        COMPILE_OPTIONS "${options}" COMPILE_DEFINITIONS PSEUDORIGID_KERNEL_TABLE=${table})
    else()
      pseudorigid_add_build(${target} ${table} "${options}" ${KERNELS_SOURCES})
    endif()
  endforeach()
  set(source ${CMAKE_CURRENT_BINARY_DIR}/${target}_builds.cpp)
  file(CONFIGURE OUTPUT ${source} @ONLY CONTENT [[
#include "@KERNELS_HEADER@"

@declarations@
std::span<const pseudorigid::mechanics::KernelBuild<@KERNELS_TABLE@>> @KERNELS_BUILDS@() {
  static constexpr pseudorigid::mechanics::KernelBuild<@KERNELS_TABLE@> builds[] = {
@builds@  };
  return builds;
}
]])
  target_sources(${target} PRIVATE ${source})
  set_source_files_properties(${source} PROPERTIES SKIP_UNITY_BUILD_INCLUSION ON SKIP_PRECOMPILE_HEADERS ON)
endfunction()

# pseudorigid_add_build(TARGET TABLE OPTIONS SOURCE…): compiles the sources and adds them to the target as one object in
# which no name but that of the table is visible. What is inlined or instantiated in them, std::vector included, is
# compiled for instructions that the processor may not have; if those names were seen, the linker would take any one of
# the copies, for the rest of the program as well.
function(pseudorigid_add_build target table options)
  add_library(${table} OBJECT EXCLUDE_FROM_ALL ${ARGN})
  target_link_libraries(${table} PRIVATE pseudorigid_options Eigen3::Eigen)
  # objcopy leaves names visible that are unique in a process, as those of static variables of inline functions.
  target_compile_options(${table} PRIVATE ${options} -fPIC $<$<CXX_COMPILER_ID:GNU>:-fno-gnu-unique>)
  target_compile_definitions(${table} PRIVATE PSEUDORIGID_KERNEL_TABLE=${table})
  set(object ${CMAKE_CURRENT_BINARY_DIR}/${table}.o)
  add_custom_command(OUTPUT ${object}
    COMMAND ${CMAKE_LINKER} -r --force-group-allocation -o ${object}.all $<TARGET_OBJECTS:${table}>
    COMMAND ${CMAKE_OBJCOPY} --keep-global-symbol=${table} ${object}.all ${object}
    DEPENDS $<TARGET_OBJECTS:${table}> COMMAND_EXPAND_LISTS VERBATIM COMMENT "Joining ${table}")
  target_sources(${target} PRIVATE ${object})
  set_source_files_properties(${object} PROPERTIES EXTERNAL_OBJECT ON GENERATED ON)
endfunction()
