# deal.II needs some 200 libraries, and a process that starts resolves 190,000 names in them before main(). The dynamic
# linker looks a name up in one library after the other, in the order in which the program names them, and most names are
# found in the library that asks. So the programs name first the libraries that look up most names, which saves a third of
# the time of a start.
#
# pseudorigid_name_first(TARGET LIBRARY): links the library, and all that it needs, to a target before all else, those with
# the most relocations by name first. It does nothing where ldd or readelf is missing; under a sanitizer, whose runtime must
# come first; and with PSEUDORIGID_NATIVE=OFF, since a package must not name libraries that it does not use itself.
find_program(PSEUDORIGID_LDD ldd)
find_program(PSEUDORIGID_READELF readelf)
mark_as_advanced(PSEUDORIGID_LDD PSEUDORIGID_READELF)

# How many names a library looks up when it is loaded.
function(pseudorigid_count_names variable library)
  execute_process(COMMAND ${PSEUDORIGID_READELF} -dW ${library} OUTPUT_VARIABLE dynamic ERROR_QUIET)
  set(${variable} 0 PARENT_SCOPE)
  if(dynamic MATCHES "\\(RELASZ\\) +([0-9]+)")
    math(EXPR all "${CMAKE_MATCH_1} / 24")  # bytes of an entry
    set(relative 0)
    if(dynamic MATCHES "\\(RELACOUNT\\) +([0-9]+)")
      set(relative ${CMAKE_MATCH_1})
    endif()
    math(EXPR names "${all} - ${relative}")
    set(${variable} ${names} PARENT_SCOPE)
  endif()
endfunction()

function(pseudorigid_name_first target library)
  if(NOT PSEUDORIGID_LDD OR NOT PSEUDORIGID_READELF OR PSEUDORIGID_SANITIZE OR NOT PSEUDORIGID_NATIVE)
    return()
  endif()
  execute_process(COMMAND ${PSEUDORIGID_LDD} ${library} OUTPUT_VARIABLE needed ERROR_QUIET)
  string(REGEX MATCHALL "/[^ \n]+" needed "${needed}")
  set(numbered)
  foreach(file ${library} ${needed})
    pseudorigid_count_names(names ${file})
    if(names GREATER 200)  # the others ask too little to matter
      list(APPEND numbered "${names} ${file}")
    endif()
  endforeach()
  if(numbered)
    list(SORT numbered COMPARE NATURAL ORDER DESCENDING)
    list(TRANSFORM numbered REPLACE "^[0-9]+ " "")
    list(JOIN numbered " " files)
    target_link_options(${target} INTERFACE "SHELL:-Wl,--push-state -Wl,--no-as-needed ${files} -Wl,--pop-state")
  endif()
endfunction()
