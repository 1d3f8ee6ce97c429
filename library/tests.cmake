# kurbel as somebody else finds it: installed into a folder of the build, examples built and run from there.
set(PREFIX ${PROJECT_BINARY_DIR}/installed)
add_test(NAME Installed.Install COMMAND ${CMAKE_COMMAND} --install ${PROJECT_BINARY_DIR} --prefix ${PREFIX})
set_tests_properties(Installed.Install PROPERTIES FIXTURES_SETUP installed)
add_test(NAME Installed.FindPackage COMMAND ${PROJECT_SOURCE_DIR}/tests/installed/find_package
  ${PREFIX} ${PROJECT_SOURCE_DIR}/examples ${PROJECT_BINARY_DIR}/consumer)
add_test(NAME Installed.PkgConfig COMMAND ${PROJECT_SOURCE_DIR}/tests/installed/pkg_config
  ${PREFIX} ${PROJECT_SOURCE_DIR}/examples ${PROJECT_BINARY_DIR}/consumer_pc)
add_test(NAME Installed.Program COMMAND ${PROJECT_SOURCE_DIR}/tests/installed/program ${PREFIX})
set_tests_properties(Installed.FindPackage Installed.PkgConfig Installed.Program PROPERTIES
  FIXTURES_REQUIRED installed TIMEOUT 600)
# Its packages, unpacked into a folder: what they hold, and that it runs.
add_test(NAME Installed.Debian COMMAND ${PROJECT_SOURCE_DIR}/scripts/deb ${PROJECT_BINARY_DIR})
set_tests_properties(Installed.Debian PROPERTIES TIMEOUT 300)
