# kurbel as somebody else finds it: installed into a folder of the build, examples built and run from there.
set(PREFIX ${PROJECT_BINARY_DIR}/installed)
add_test(NAME Installed.Install COMMAND ${CMAKE_COMMAND} --install ${PROJECT_BINARY_DIR} --prefix ${PREFIX})
set_tests_properties(Installed.Install PROPERTIES FIXTURES_SETUP installed)
add_test(NAME Installed.Program COMMAND ${PROJECT_SOURCE_DIR}/tests/installed/program ${PREFIX})
set_tests_properties(Installed.Program PROPERTIES FIXTURES_REQUIRED installed TIMEOUT 600)
add_test(NAME Installed.ProgramAlone COMMAND ${PROJECT_SOURCE_DIR}/tests/installed/program_alone ${PROJECT_SOURCE_DIR} ${PROJECT_BINARY_DIR})
set_tests_properties(Installed.ProgramAlone PROPERTIES TIMEOUT 300)
# The ways in, by the lines of README.md. Debian's packages are tried by scripts/deb before they are installed.
function(add_way_in name way)
  add_test(NAME Installed.${name} COMMAND ${PROJECT_SOURCE_DIR}/tests/installed/readme ${way} ${PROJECT_SOURCE_DIR} ${PROJECT_BINARY_DIR})
  set_tests_properties(Installed.${name} PROPERTIES TIMEOUT 600 SKIP_RETURN_CODE 77)
endfunction()
add_way_in(FindPackage "C++, by find_package")
add_way_in(PkgConfig "C++, by pkg-config")
# Where Python's module was asked for and not built, they fail.
if(KURBEL_PYTHON)
  add_way_in(Python Python)
  add_way_in(Debian Debian)
  # Both look whether there is something to build.
  set_tests_properties(Installed.Python Installed.Debian PROPERTIES RESOURCE_LOCK build)
endif()
# Every public name has its words. `cmake --build build/release --target reference` makes the same pages.
add_test(NAME Reference.EveryPublicNameIsDocumented COMMAND ${PROJECT_SOURCE_DIR}/scripts/reference ${PROJECT_BINARY_DIR}/reference)
set_tests_properties(Reference.EveryPublicNameIsDocumented PROPERTIES TIMEOUT 120)
