# What `cmake --install` puts where (docs/install.md): the component "program" is what people run, "development" is the
# library, of which each layer installs its own part (pseudorigid_layer). The target `uninstall` takes all of it away.
include(CMakePackageConfigHelpers)
set(CMAKE_INSTALL_DEFAULT_COMPONENT_NAME program)
set(data ${CMAKE_INSTALL_DATADIR}/pseudorigid)

if(PSEUDORIGID_PROGRAM)
  install(TARGETS pseudorigid)
  if(PSEUDORIGID_CONTINUUM)  # the program opens it
    install(TARGETS pseudorigid-continuum DESTINATION ${CMAKE_INSTALL_LIBDIR}/pseudorigid)
  endif()
  install(DIRECTORY params meshes DESTINATION ${data} FILES_MATCHING PATTERN "*.prm" PATTERN "*.msh" PATTERN "README.md")
  # Debian's Python finds the package there if the prefix is /usr.
  install(DIRECTORY python/pseudorigid DESTINATION lib/python3/dist-packages PATTERN "__pycache__" EXCLUDE)
  install(DIRECTORY python/examples DESTINATION ${CMAKE_INSTALL_DOCDIR}/python PATTERN "__pycache__" EXCLUDE)
  install(DIRECTORY docs DESTINATION ${CMAKE_INSTALL_DOCDIR})
  install(FILES README.md LICENSE DESTINATION ${CMAKE_INSTALL_DOCDIR})
  install(FILES tools/completion.bash DESTINATION ${CMAKE_INSTALL_DATADIR}/bash-completion/completions RENAME pseudorigid)

  # The manual page is what the program says of itself. It is written at installation, so that a build of the program
  # alone can be installed.
  set(manual ${PROJECT_BINARY_DIR}/pseudorigid.1)
  install(CODE "execute_process(COMMAND_ERROR_IS_FATAL ANY COMMAND \"${CMAKE_COMMAND}\" \"-DPROGRAM=$<TARGET_FILE:pseudorigid>\"
    \"-DOUTPUT=${manual}\" -DVERSION=${PROJECT_VERSION} \"-DDATA=${CMAKE_INSTALL_FULL_DATADIR}/pseudorigid\"
    \"-DPAGES=${CMAKE_INSTALL_FULL_DOCDIR}\" -P \"${PROJECT_SOURCE_DIR}/cmake/install/manual_page.cmake\")")
  install(FILES ${manual} DESTINATION ${CMAKE_INSTALL_MANDIR}/man1)
endif()

# Where find_package(pseudorigid) looks.
set(package ${CMAKE_INSTALL_LIBDIR}/cmake/pseudorigid)
configure_package_config_file(${PROJECT_SOURCE_DIR}/cmake/install/pseudorigidConfig.cmake.in
  ${PROJECT_BINARY_DIR}/pseudorigidConfig.cmake INSTALL_DESTINATION ${package} NO_SET_AND_CHECK_MACRO)
write_basic_package_version_file(${PROJECT_BINARY_DIR}/pseudorigidConfigVersion.cmake COMPATIBILITY SameMinorVersion)
install(FILES ${PROJECT_BINARY_DIR}/pseudorigidConfig.cmake ${PROJECT_BINARY_DIR}/pseudorigidConfigVersion.cmake
  DESTINATION ${package} COMPONENT development)
install(EXPORT pseudorigid NAMESPACE pseudorigid:: FILE pseudorigidTargets.cmake DESTINATION ${package}
  COMPONENT development)
install(DIRECTORY examples DESTINATION ${CMAKE_INSTALL_DOCDIR} COMPONENT development)

configure_file(${PROJECT_SOURCE_DIR}/cmake/install/uninstall.cmake.in ${PROJECT_BINARY_DIR}/uninstall.cmake @ONLY)
add_custom_target(uninstall COMMAND ${CMAKE_COMMAND} -P ${PROJECT_BINARY_DIR}/uninstall.cmake VERBATIM)
