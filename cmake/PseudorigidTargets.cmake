# Compile options of this project's own sources, and the helpers that declare a layer or a test. Targets begin with
# "pseudorigid", so that a project which adds this one may have a target of its own called io or scene.

# For our own sources only: nothing of this reaches who links a layer.
add_library(pseudorigid_options INTERFACE)
target_include_directories(pseudorigid_options INTERFACE ${PROJECT_SOURCE_DIR}/src)
target_compile_features(pseudorigid_options INTERFACE cxx_std_20)
# -Wno-restrict: g++ 12 warns of overlaps that cannot be in "literal" + std::string (GCC bug 105651).
target_compile_options(pseudorigid_options INTERFACE -Wall -Wextra -Wno-restrict
  $<$<BOOL:${PSEUDORIGID_WERROR}>:-Werror>)
# By default g++ collects garbage as soon as it uses 128 MB. The largest sources use up to 2.4 GB, and it costs a sixth
# of their time or more.
if(CMAKE_CXX_COMPILER_ID STREQUAL "GNU")
  target_compile_options(pseudorigid_options INTERFACE "SHELL:--param ggc-min-heapsize=3000000")
endif()
if(PSEUDORIGID_SANITIZE)
  target_compile_options(pseudorigid_options INTERFACE -fsanitize=${PSEUDORIGID_SANITIZE} -fno-omit-frame-pointer)
  target_link_options(pseudorigid_options INTERFACE -fsanitize=${PSEUDORIGID_SANITIZE})
endif()

# Headers take more than half of the time of a first build. The sources of a layer are compiled in groups, and a group
# reads each header once. To work on the sources, switch it off (-DPSEUDORIGID_UNITY=OFF).
option(PSEUDORIGID_UNITY "Compile several sources of a layer at once" ON)

# pseudorigid_target(VARIABLE NAME): the target of a layer, or the target that is called so.
function(pseudorigid_target variable name)
  if(TARGET pseudorigid_${name})
    set(name pseudorigid_${name})
  endif()
  set(${variable} ${name} PARENT_SCOPE)
endfunction()

# pseudorigid::headers: all headers of the library, and Eigen. Who only uses templates links it and compiles nothing else.
add_library(pseudorigid_headers INTERFACE)
target_compile_features(pseudorigid_headers INTERFACE cxx_std_20)
target_include_directories(pseudorigid_headers INTERFACE
  "$<BUILD_INTERFACE:${PROJECT_SOURCE_DIR}/src;${PROJECT_BINARY_DIR}/include>"
  "$<INSTALL_INTERFACE:${CMAKE_INSTALL_INCLUDEDIR}/pseudorigid;${CMAKE_INSTALL_INCLUDEDIR}>")
target_link_libraries(pseudorigid_headers INTERFACE Eigen3::Eigen)
# pseudorigid::pseudorigid: the whole library.
add_library(pseudorigid_library INTERFACE)
target_link_libraries(pseudorigid_library INTERFACE pseudorigid_headers)

# pseudorigid_export(TARGET NAME): the target is pseudorigid::NAME, here and for those who find the installed library.
function(pseudorigid_export target name)
  add_library(pseudorigid::${name} ALIAS ${target})
  set_target_properties(${target} PROPERTIES EXPORT_NAME ${name})
  if(PSEUDORIGID_INSTALL)
    install(TARGETS ${target} EXPORT pseudorigid COMPONENT development)
  endif()
endfunction()
pseudorigid_export(pseudorigid_headers headers)
pseudorigid_export(pseudorigid_library pseudorigid)

# pseudorigid_layer(NAME [INSTALL] [SOURCES file…] [LIBS layer or target…]): the library of one folder of src/,
# pseudorigid::NAME. Names without "::" in LIBS are layers. INSTALL: the layer is part of the installed library.
function(pseudorigid_layer name)
  cmake_parse_arguments(LAYER "INSTALL" "" "SOURCES;LIBS" ${ARGN})
  set(library pseudorigid_${name})
  list(TRANSFORM LAYER_LIBS PREPEND pseudorigid:: REGEX "^[^:]+$")
  if(LAYER_SOURCES)
    add_library(${library} STATIC ${LAYER_SOURCES})
    set_target_properties(${library} PROPERTIES UNITY_BUILD ${PSEUDORIGID_UNITY} UNITY_BUILD_BATCH_SIZE 12)
    target_link_libraries(${library} PUBLIC pseudorigid_headers ${LAYER_LIBS} PRIVATE $<BUILD_INTERFACE:pseudorigid_options>)
    # A project that adds this one compiles the layers that it links, and no others.
    if(NOT PSEUDORIGID_PROGRAM AND NOT PSEUDORIGID_INSTALL)
      set_target_properties(${library} PROPERTIES EXCLUDE_FROM_ALL ON)
    endif()
  else()
    add_library(${library} INTERFACE)
    target_link_libraries(${library} INTERFACE pseudorigid_headers ${LAYER_LIBS})
  endif()
  if(LAYER_INSTALL)
    target_link_libraries(pseudorigid_library INTERFACE ${library})
    pseudorigid_export(${library} ${name})
  else()
    add_library(pseudorigid::${name} ALIAS ${library})
  endif()
  if(LAYER_INSTALL AND PSEUDORIGID_INSTALL)
    install(DIRECTORY ${CMAKE_CURRENT_SOURCE_DIR}/ DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/pseudorigid/${name}
      COMPONENT development FILES_MATCHING PATTERN "*.h")
  endif()
endfunction()

# pseudorigid_link(TARGET layer or target…): links layers to an executable of this project.
function(pseudorigid_link target)
  list(TRANSFORM ARGN PREPEND pseudorigid:: REGEX "^[^:]+$")
  target_link_libraries(${target} PRIVATE pseudorigid_options ${ARGN})
endfunction()

# pseudorigid_use_dealii(TARGET): links deal.II. Its own macro deal_ii_setup_target would put -g -O2 on the target after
# ours; deal.II 9.6 has a target for that, and of others include directories, definitions and the library are taken.
function(pseudorigid_use_dealii target)
  if(NOT TARGET pseudorigid_dealii)
    add_library(pseudorigid_dealii INTERFACE)
    if(TARGET dealii::dealii)
      target_link_libraries(pseudorigid_dealii INTERFACE dealii::dealii)
    else()
      include(${DEAL_II_TARGET_CONFIG})
      target_include_directories(pseudorigid_dealii SYSTEM INTERFACE ${DEAL_II_INCLUDE_DIRS})
      set(flavour RELEASE)
      if(CMAKE_BUILD_TYPE STREQUAL "Debug" AND DEAL_II_BUILD_TYPE MATCHES "Debug")
        set(flavour DEBUG)
      endif()
      target_compile_definitions(pseudorigid_dealii INTERFACE ${DEAL_II_USER_DEFINITIONS} ${DEAL_II_USER_DEFINITIONS_${flavour}})
      # Under --as-needed, which Debian's g++ passes, ld.bfd saves all names that it knows and restores them for each of
      # the 200 libraries behind deal.II that is not needed. Before deal.II it knows few names: 3 s a link, not 16.
      get_target_property(behind ${DEAL_II_TARGET_${flavour}} INTERFACE_LINK_LIBRARIES)
      target_link_libraries(pseudorigid_dealii INTERFACE ${behind} $<TARGET_FILE:${DEAL_II_TARGET_${flavour}}>)
    endif()
    # deal.II has a BLAS. Eigen's own products would be those of the oldest x86-64.
    target_compile_definitions(pseudorigid_dealii INTERFACE EIGEN_USE_BLAS)
    # The program opens it as a library, in which nobody replaces a function.
    target_compile_options(pseudorigid_dealii INTERFACE -fPIC -fno-semantic-interposition)
  endif()
  pseudorigid_target(target ${target})
  target_link_libraries(${target} PUBLIC pseudorigid_dealii)
endfunction()

# Seconds that a test may take, and the factor to its own limits: sanitizers make programs ten times slower and more.
set(pseudorigid_test_patience 1)
if(PSEUDORIGID_SANITIZE)
  set(pseudorigid_test_patience 20)
endif()
math(EXPR pseudorigid_test_timeout "300 * ${pseudorigid_test_patience}")

# pseudorigid_suites(NAME LABEL label SOURCES file…): one ctest entry per test suite of a GoogleTest executable, and one for
# the tests of no known suite, so that all tests run. An executable with finite elements takes 0.4 s to load deal.II.
function(pseudorigid_suites name)
  cmake_parse_arguments(TEST "" "LABEL" "SOURCES" ${ARGN})
  set(suites)
  set(tests)
  foreach(source ${TEST_SOURCES})
    file(STRINGS ${source} lines REGEX "^(TYPED_)?TEST(_[FP])?\\(")
    foreach(line ${lines})
      string(REGEX REPLACE "^[A-Z_]+\\(([A-Za-z0-9_]+),.*" "\\1" suite "${line}")
      list(APPEND suites ${suite})
    endforeach()
  endforeach()
  list(REMOVE_DUPLICATES suites)
  set(known)
  foreach(suite ${suites})
    set(filter "${suite}.*:*/${suite}.*:${suite}/*:*/${suite}/*")
    add_test(NAME ${name}.${suite} COMMAND ${name} --gtest_filter=${filter})
    list(APPEND known ${filter})
    list(APPEND tests ${name}.${suite})
  endforeach()
  list(JOIN known ":" known)
  add_test(NAME ${name}.others COMMAND ${name} --gtest_filter=-${known})
  math(EXPR timeout "3 * ${pseudorigid_test_timeout}")
  set_tests_properties(${tests} ${name}.others PROPERTIES LABELS ${TEST_LABEL} TIMEOUT ${timeout})
  # GoogleTest succeeds without a test. A suite may have got another name since the sources were read.
  set_tests_properties(${tests} PROPERTIES FAIL_REGULAR_EXPRESSION "Running 0 tests")
  set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS ${TEST_SOURCES})
endfunction()

# pseudorigid_test(NAME LABEL label SOURCES file… [LIBS layer or target…] [CASES]): one GoogleTest executable, one ctest
# entry per test case, or per test suite if the executable has finite elements. With CASES it has an entry per test case
# even then, so that ctest reports a skipped test as skipped.
function(pseudorigid_test name)
  cmake_parse_arguments(TEST "CASES" "LABEL" "SOURCES;LIBS" ${ARGN})
  add_executable(${name} ${TEST_SOURCES})
  pseudorigid_link(${name} ${TEST_LIBS} test_support GTest::gtest_main)
  set_target_properties(${name} PROPERTIES RUNTIME_OUTPUT_DIRECTORY ${PROJECT_BINARY_DIR}/tests
    UNITY_BUILD ${PSEUDORIGID_UNITY} UNITY_BUILD_BATCH_SIZE 6)
  if("continuum" IN_LIST TEST_LIBS)
    pseudorigid_precompiled(${name} dealii)
    set_target_properties(${name} PROPERTIES UNITY_BUILD_BATCH_SIZE 12)
  else()
    pseudorigid_precompiled(${name} tests)
  endif()
  if("continuum" IN_LIST TEST_LIBS AND NOT TEST_CASES)
    pseudorigid_suites(${name} LABEL ${TEST_LABEL} SOURCES ${TEST_SOURCES})
  else()
    gtest_discover_tests(${name} NO_PRETTY_VALUES DISCOVERY_TIMEOUT 60 PROPERTIES LABELS ${TEST_LABEL}
      TIMEOUT ${pseudorigid_test_timeout})
  endif()
endfunction()
