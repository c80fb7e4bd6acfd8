# What `cmake --install` puts where (docs/install.md). The target `uninstall` takes all of it away.
set(CMAKE_INSTALL_DEFAULT_COMPONENT_NAME program)
set(data ${CMAKE_INSTALL_DATADIR}/pseudorigid)

# The first becomes the second, which stands beside it.
install(TARGETS pseudorigid)
if(PSEUDORIGID_CONTINUUM)
  install(TARGETS pseudorigid-continuum)
endif()
install(DIRECTORY params meshes tools DESTINATION ${data}
  FILES_MATCHING PATTERN "*.prm" PATTERN "*.msh" PATTERN "*.py" PATTERN "README.md"
  PATTERN "mutation" EXCLUDE PATTERN "__pycache__" EXCLUDE)
install(DIRECTORY docs DESTINATION ${CMAKE_INSTALL_DOCDIR})
install(FILES README.md LICENSE DESTINATION ${CMAKE_INSTALL_DOCDIR})
install(FILES tools/completion.bash DESTINATION ${CMAKE_INSTALL_DATADIR}/bash-completion/completions RENAME pseudorigid)

# The manual page is what the program says of itself.
set(manual ${PROJECT_BINARY_DIR}/pseudorigid.1)
add_custom_command(OUTPUT ${manual}
  COMMAND ${CMAKE_COMMAND} -DPROGRAM=$<TARGET_FILE:pseudorigid> -DOUTPUT=${manual} -DVERSION=${PROJECT_VERSION}
    -DDATA=${CMAKE_INSTALL_FULL_DATADIR}/pseudorigid -DPAGES=${CMAKE_INSTALL_FULL_DOCDIR}
    -P ${PROJECT_SOURCE_DIR}/cmake/install/manual_page.cmake
  DEPENDS pseudorigid ${PROJECT_SOURCE_DIR}/cmake/install/manual_page.cmake
  COMMENT "Writing the manual page" VERBATIM)
add_custom_target(pseudorigid_manual ALL DEPENDS ${manual})
install(FILES ${manual} DESTINATION ${CMAKE_INSTALL_MANDIR}/man1)

configure_file(${PROJECT_SOURCE_DIR}/cmake/install/uninstall.cmake.in ${PROJECT_BINARY_DIR}/uninstall.cmake @ONLY)
add_custom_target(uninstall COMMAND ${CMAKE_COMMAND} -P ${PROJECT_BINARY_DIR}/uninstall.cmake VERBATIM)
