# What others get: `cmake --install`, find_package(radiosity), and a Debian package by CPack.

include(CMakePackageConfigHelpers)
set(package_folder ${CMAKE_INSTALL_LIBDIR}/cmake/radiosity)
configure_package_config_file(cmake/radiosityConfig.cmake.in generated/radiosityConfig.cmake
                              INSTALL_DESTINATION ${package_folder})
# Before 1.0 a minor version may change the interface.
write_basic_package_version_file(generated/radiosityConfigVersion.cmake
                                 COMPATIBILITY SameMinorVersion)
install(FILES ${PROJECT_BINARY_DIR}/generated/radiosityConfig.cmake
              ${PROJECT_BINARY_DIR}/generated/radiosityConfigVersion.cmake
        DESTINATION ${package_folder})
install(EXPORT radiosity-targets NAMESPACE radiosity:: DESTINATION ${package_folder})
if(RADIOSITY_BUILD_VTK)
  install(EXPORT radiosity-vtk-targets NAMESPACE radiosity:: DESTINATION ${package_folder})
endif()

if(NOT RADIOSITY_BUILD_PROGRAM)
  return()
endif()
install(TARGETS radiosity_program)
if(TARGET radiosity_mpi_program)
  install(TARGETS radiosity_mpi_program)
endif()
if(TARGET radiosity_petsc)
  # Where radiosity-mpi looks for it.
  install(TARGETS radiosity_petsc LIBRARY DESTINATION libexec/radiosity)
endif()
install(DIRECTORY scenes DESTINATION ${CMAKE_INSTALL_DATADIR}/radiosity)
install(DIRECTORY tests/data DESTINATION ${CMAKE_INSTALL_DATADIR}/radiosity/tests)
# The README links to files that are installed elsewhere.
file(READ README.md readme)
foreach(link "scenes/README.md;${CMAKE_INSTALL_DATADIR}/radiosity"
             "radiosity/radiosity.h;${CMAKE_INSTALL_INCLUDEDIR}/radiosity")
  list(GET link 0 file)
  list(GET link 1 folder)
  cmake_path(RELATIVE_PATH folder BASE_DIRECTORY ${CMAKE_INSTALL_DOCDIR})
  string(REPLACE "](${file})" "](${folder}/${file})" readme "${readme}")
endforeach()
file(CONFIGURE OUTPUT generated/README.md CONTENT "${readme}" @ONLY)
set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS README.md)
install(FILES ${PROJECT_BINARY_DIR}/generated/README.md CHANGELOG.md LICENSE
        DESTINATION ${CMAKE_INSTALL_DOCDIR})
install(DIRECTORY docs DESTINATION ${CMAKE_INSTALL_DOCDIR})
install(FILES apps/radiosity.bash DESTINATION ${CMAKE_INSTALL_DATADIR}/bash-completion/completions
        RENAME radiosity)

# Manual pages: one for the program and one for each of its commands.
find_program(HELP2MAN help2man)
if(HELP2MAN AND NOT RADIOSITY_SANITIZE)
  set(manual ${PROJECT_BINARY_DIR}/generated/man)
  set(pages ${manual}/radiosity.1)
  add_custom_command(
    OUTPUT ${manual}/radiosity.1
    COMMAND ${CMAKE_COMMAND} -E make_directory ${manual}
    COMMAND ${HELP2MAN} --no-info --name "how light spreads between diffuse surfaces"
            --output ${manual}/radiosity.1 $<TARGET_FILE:radiosity_program>
    DEPENDS radiosity_program
    VERBATIM)
  foreach(command solve form-factors merge exchange comfort light daylight daylight-year render view
                  inspect batch validate)
    list(APPEND pages ${manual}/radiosity-${command}.1)
    add_custom_command(
      OUTPUT ${manual}/radiosity-${command}.1
      COMMAND ${CMAKE_COMMAND} -E make_directory ${manual}
      COMMAND ${HELP2MAN} --no-info --name "a command of radiosity" --version-string
              ${PROJECT_VERSION} --output ${manual}/radiosity-${command}.1
              "$<TARGET_FILE:radiosity_program> ${command}"
      DEPENDS radiosity_program
      VERBATIM)
  endforeach()
  add_custom_target(manual ALL DEPENDS ${pages})
  install(FILES ${pages} DESTINATION ${CMAKE_INSTALL_MANDIR}/man1)
endif()

set(CPACK_GENERATOR DEB)
set(CPACK_PACKAGE_CONTACT "radiosity")
set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
set(CPACK_STRIP_FILES ON)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_SECTION science)
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS ON)
set(CPACK_DEBIAN_PACKAGE_DEPENDS fonts-dejavu-core)
# To build programs with the library.
set(CPACK_DEBIAN_PACKAGE_SUGGESTS
    "libeigen3-dev, libembree-dev, libtbb-dev, libopenmesh-dev, nlohmann-json3-dev, libhdf5-dev, libpng-dev, libopenexr-dev, libfmt-dev, libvtk9-dev, paraview"
)
include(CPack)
