# Compile options shared by every target, and the helpers that declare a layer or a test.

add_library(pseudorigid_options INTERFACE)
target_include_directories(pseudorigid_options INTERFACE ${CMAKE_SOURCE_DIR}/src)
target_compile_features(pseudorigid_options INTERFACE cxx_std_20)
# -Wno-restrict: g++ 12 warns of overlaps that cannot be in "literal" + std::string (GCC bug 105651).
target_compile_options(pseudorigid_options INTERFACE -Wall -Wextra -Wno-restrict
  $<$<BOOL:${PSEUDORIGID_WERROR}>:-Werror>)
if(PSEUDORIGID_SANITIZE)
  target_compile_options(pseudorigid_options INTERFACE -fsanitize=${PSEUDORIGID_SANITIZE} -fno-omit-frame-pointer)
  # Checks multiply with what [[gnu::flatten]] inlines, and compile times with them.
  target_compile_definitions(pseudorigid_options INTERFACE flatten=unused)
  target_link_options(pseudorigid_options INTERFACE -fsanitize=${PSEUDORIGID_SANITIZE})
endif()

# Headers take more than half of the time of a first build. The sources of a layer are compiled in groups, and a group
# reads each header once. To work on the sources, switch it off (-DPSEUDORIGID_UNITY=OFF).
option(PSEUDORIGID_UNITY "Compile several sources of a layer at once" ON)

# pseudorigid_layer(NAME [SOURCES file…] [LIBS target…]): the library of one folder of src/; header-only without SOURCES.
function(pseudorigid_layer name)
  cmake_parse_arguments(LAYER "" "" "SOURCES;LIBS" ${ARGN})
  if(LAYER_SOURCES)
    add_library(${name} STATIC ${LAYER_SOURCES})
    target_link_libraries(${name} PUBLIC pseudorigid_options ${LAYER_LIBS})
    set_target_properties(${name} PROPERTIES UNITY_BUILD ${PSEUDORIGID_UNITY} UNITY_BUILD_BATCH_SIZE 12)
  else()
    add_library(${name} INTERFACE)
    target_link_libraries(${name} INTERFACE pseudorigid_options ${LAYER_LIBS})
  endif()
  add_library(pseudorigid::${name} ALIAS ${name})
endfunction()

# pseudorigid_native(FILE…): sources compiled for this machine's own instructions. They are few, and no Eigen type crosses
# their interface, so nothing else has to agree on an alignment. -Wno-psabi: wide vectors are passed between inlined
# functions only.
function(pseudorigid_native)
  set(options -Wno-psabi)
  if(PSEUDORIGID_NATIVE)
    list(APPEND options -march=native)
  endif()
  if(PSEUDORIGID_SANITIZE)  # at -O1 their small functions are calls, and tests of the ball take hours
    list(APPEND options -O2)
  endif()
  set_source_files_properties(${ARGN} PROPERTIES COMPILE_OPTIONS "${options}" SKIP_PRECOMPILE_HEADERS ON)
endfunction()

# pseudorigid_use_dealii(TARGET): links deal.II. Its own macro deal_ii_setup_target would put -g -O2 on the target after
# ours, so only include directories, definitions and the library are taken from the package.
function(pseudorigid_use_dealii target)
  if(NOT TARGET pseudorigid_dealii)
    include(${DEAL_II_TARGET_CONFIG})
    add_library(pseudorigid_dealii INTERFACE)
    target_include_directories(pseudorigid_dealii SYSTEM INTERFACE ${DEAL_II_INCLUDE_DIRS})
    set(flavour RELEASE)
    if(CMAKE_BUILD_TYPE STREQUAL "Debug" AND DEAL_II_BUILD_TYPE MATCHES "Debug")
      set(flavour DEBUG)
    endif()
    target_compile_definitions(pseudorigid_dealii INTERFACE ${DEAL_II_USER_DEFINITIONS} ${DEAL_II_USER_DEFINITIONS_${flavour}})
    target_link_libraries(pseudorigid_dealii INTERFACE ${DEAL_II_TARGET_${flavour}})
  endif()
  target_link_libraries(${target} PUBLIC pseudorigid_dealii)
endfunction()

# Seconds that a test may take, and the factor to its own limits: sanitizers make programs ten times slower and more.
set(pseudorigid_test_patience 1)
if(PSEUDORIGID_SANITIZE)
  set(pseudorigid_test_patience 20)
endif()
math(EXPR pseudorigid_test_timeout "300 * ${pseudorigid_test_patience}")

# pseudorigid_test(NAME LABEL label SOURCES file… [LIBS target…]): one GoogleTest executable, one ctest entry per test case.
function(pseudorigid_test name)
  cmake_parse_arguments(TEST "" "LABEL" "SOURCES;LIBS" ${ARGN})
  add_executable(${name} ${TEST_SOURCES})
  target_link_libraries(${name} PRIVATE pseudorigid_options ${TEST_LIBS} GTest::gtest_main)
  set_target_properties(${name} PROPERTIES RUNTIME_OUTPUT_DIRECTORY ${CMAKE_BINARY_DIR}/tests)
  if("continuum" IN_LIST TEST_LIBS)
    pseudorigid_precompiled(${name} dealii)
  else()
    pseudorigid_precompiled(${name} tests)
  endif()
  gtest_discover_tests(${name} NO_PRETTY_VALUES DISCOVERY_TIMEOUT 60 PROPERTIES LABELS ${TEST_LABEL}
    TIMEOUT ${pseudorigid_test_timeout})
endfunction()
