# What is installed: the program, the archive, <kurbel/…>, and how others find them. No path of this machine is written
# down: what the archive is linked with is found again where it is used.
include(GNUInstallDirs)
include(CMakePackageConfigHelpers)

install(TARGETS kurbel_app RUNTIME COMPONENT program)
install(TARGETS kurbel ARCHIVE COMPONENT dev)
install(DIRECTORY library/kurbel DESTINATION ${CMAKE_INSTALL_INCLUDEDIR} COMPONENT dev FILES_MATCHING PATTERN "*.h")
install(FILES engine/numerics/dual.h mechanisms/loops/taylor.h DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/kurbel
  COMPONENT dev)
install(DIRECTORY scenes DESTINATION ${CMAKE_INSTALL_DATADIR}/kurbel COMPONENT program)
install(FILES docs/kurbel.1 DESTINATION ${CMAKE_INSTALL_MANDIR}/man1 COMPONENT program)
install(FILES scripts/kurbel.bash-completion DESTINATION ${CMAKE_INSTALL_DATADIR}/bash-completion/completions RENAME kurbel
  COMPONENT program)
install(FILES THIRD_PARTY.md DESTINATION ${CMAKE_INSTALL_DOCDIR} COMPONENT program)
# As Debian has it: each package with its own.
install(FILES library/copyright DESTINATION ${CMAKE_INSTALL_DATADIR}/doc/kurbel COMPONENT program)
install(FILES library/copyright DESTINATION ${CMAKE_INSTALL_DATADIR}/doc/libkurbel-dev COMPONENT dev)
install(DIRECTORY examples DESTINATION ${CMAKE_INSTALL_DATADIR}/doc/libkurbel-dev COMPONENT dev)

set(KURBEL_CMAKE_DIR ${CMAKE_INSTALL_LIBDIR}/cmake/kurbel)
configure_package_config_file(library/kurbelConfig.cmake.in ${PROJECT_BINARY_DIR}/kurbelConfig.cmake
  INSTALL_DESTINATION ${KURBEL_CMAKE_DIR} PATH_VARS CMAKE_INSTALL_INCLUDEDIR CMAKE_INSTALL_LIBDIR)
write_basic_package_version_file(${PROJECT_BINARY_DIR}/kurbelConfigVersion.cmake COMPATIBILITY SameMinorVersion)
install(FILES ${PROJECT_BINARY_DIR}/kurbelConfig.cmake ${PROJECT_BINARY_DIR}/kurbelConfigVersion.cmake
  DESTINATION ${KURBEL_CMAKE_DIR} COMPONENT dev)

file(RELATIVE_PATH KURBEL_PC_TO_PREFIX /p/${CMAKE_INSTALL_LIBDIR}/pkgconfig /p)
configure_file(library/kurbel.pc.in ${PROJECT_BINARY_DIR}/kurbel.pc @ONLY)
install(FILES ${PROJECT_BINARY_DIR}/kurbel.pc DESTINATION ${CMAKE_INSTALL_LIBDIR}/pkgconfig COMPONENT dev)

# Debian packages: kurbel, libkurbel-dev, python3-kurbel (scripts/deb).
set(CPACK_GENERATOR DEB)
set(CPACK_PACKAGE_NAME kurbel)
set(CPACK_PACKAGE_CONTACT "kurbel's maintainers <maintainers@kurbel.invalid>")
set(CPACK_PACKAGE_DESCRIPTION_SUMMARY "dynamics of machine units, rigid against elastic, with measured errors")
set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
set(CPACK_COMPONENTS_ALL program dev)
set(CPACK_DEB_COMPONENT_INSTALL ON)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_PRE_BUILD_SCRIPTS ${PROJECT_SOURCE_DIR}/library/package.cmake)
set(CPACK_DEBIAN_PACKAGE_PRIORITY optional)
set(CPACK_DEBIAN_PACKAGE_CONTROL_STRICT_PERMISSION ON)
set(CPACK_COMPONENT_PROGRAM_DESCRIPTION "The program, its manual page, completion for bash, and scenes to start from:
motor, coupling, gearbox, flywheel, crank mechanism and load as one scene file,
simulated rigid and elastic, with the error of every figure.")
set(CPACK_COMPONENT_DEV_DESCRIPTION "Headers <kurbel/...>, the static library, and what CMake's find_package and
pkg-config find them by; examples of elements and mechanisms of one's own.")
set(CPACK_COMPONENT_PYTHON_DESCRIPTION "import kurbel: runs with numpy arrays, every study, motions stepped by their
caller, sweeps by any executor.")
set(CPACK_DEBIAN_PROGRAM_PACKAGE_SECTION science)
set(CPACK_DEBIAN_PROGRAM_PACKAGE_NAME kurbel)
set(CPACK_DEBIAN_PROGRAM_PACKAGE_SHLIBDEPS ON)
set(CPACK_DEBIAN_PROGRAM_PACKAGE_SUGGESTS "gnuplot-nox")
set(CPACK_DEBIAN_DEV_PACKAGE_NAME libkurbel-dev)
set(CPACK_DEBIAN_DEV_PACKAGE_SECTION libdevel)
set(CPACK_DEBIAN_DEV_PACKAGE_DEPENDS "libsimbody-dev, libsundials-dev, libsuitesparse-dev, libtomlplusplus-dev, libfmt-dev, libsqlite3-dev, libxlsxwriter-dev, libmatio-dev, libzip-dev, libpugixml-dev")
set(CPACK_DEBIAN_DEV_PACKAGE_SUGGESTS "g++, cmake, pkg-config")
set(CPACK_DEBIAN_PYTHON_PACKAGE_NAME python3-kurbel)
set(CPACK_DEBIAN_PYTHON_PACKAGE_SECTION python)
set(CPACK_DEBIAN_PYTHON_PACKAGE_SHLIBDEPS ON)
set(CPACK_DEBIAN_PYTHON_PACKAGE_DEPENDS "python3 (>= 3.11), python3 (<< 3.12), python3-numpy")
set(CPACK_DEBIAN_PYTHON_PACKAGE_SUGGESTS "python3-pandas, python3-distributed")
set(CPACK_STRIP_FILES ON)

# Pages of <kurbel/…>, by Doxygen.
add_custom_target(reference COMMAND ${PROJECT_SOURCE_DIR}/scripts/reference ${PROJECT_BINARY_DIR}/reference USES_TERMINAL)
