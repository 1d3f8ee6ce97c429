# What is installed: the program, the archive, <kurbel/…>, and how others find them. No path of this machine is written
# down: what the archive is linked with is found again where it is used.
include(GNUInstallDirs)
include(CMakePackageConfigHelpers)

install(TARGETS kurbel_app RUNTIME)
install(TARGETS kurbel ARCHIVE)
install(DIRECTORY library/kurbel DESTINATION ${CMAKE_INSTALL_INCLUDEDIR} FILES_MATCHING PATTERN "*.h")
install(FILES engine/numerics/dual.h mechanisms/loops/taylor.h DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/kurbel)
install(DIRECTORY scenes DESTINATION ${CMAKE_INSTALL_DATADIR}/kurbel)
install(FILES docs/kurbel.1 DESTINATION ${CMAKE_INSTALL_MANDIR}/man1)
install(FILES scripts/kurbel.bash-completion DESTINATION ${CMAKE_INSTALL_DATADIR}/bash-completion/completions RENAME kurbel)

set(KURBEL_CMAKE_DIR ${CMAKE_INSTALL_LIBDIR}/cmake/kurbel)
configure_package_config_file(library/kurbelConfig.cmake.in ${PROJECT_BINARY_DIR}/kurbelConfig.cmake
  INSTALL_DESTINATION ${KURBEL_CMAKE_DIR} PATH_VARS CMAKE_INSTALL_INCLUDEDIR CMAKE_INSTALL_LIBDIR)
write_basic_package_version_file(${PROJECT_BINARY_DIR}/kurbelConfigVersion.cmake COMPATIBILITY SameMinorVersion)
install(FILES ${PROJECT_BINARY_DIR}/kurbelConfig.cmake ${PROJECT_BINARY_DIR}/kurbelConfigVersion.cmake
  DESTINATION ${KURBEL_CMAKE_DIR})

file(RELATIVE_PATH KURBEL_PC_TO_PREFIX /p/${CMAKE_INSTALL_LIBDIR}/pkgconfig /p)
configure_file(library/kurbel.pc.in ${PROJECT_BINARY_DIR}/kurbel.pc @ONLY)
install(FILES ${PROJECT_BINARY_DIR}/kurbel.pc DESTINATION ${CMAKE_INSTALL_LIBDIR}/pkgconfig)
