# How parts are installed, and what Debian's packages say of themselves. Each part is installed by the folder that makes it:
# program by app, dev by library, python by python.
include(GNUInstallDirs)

# The first install rule of a folder, whose other rules are then those of a part that is built. One that is not is left out,
# and is an error where it was asked for (--component, a package).
function(install_what_is_built target component)
  install(CODE "
  if(NOT EXISTS \"$<TARGET_FILE:${target}>\")
    set(WHY \"$<TARGET_FILE_NAME:${target}> is not built (cmake --build ${PROJECT_BINARY_DIR} --target ${target})\")
    if(CMAKE_INSTALL_COMPONENT)
      message(FATAL_ERROR \"\${WHY}\")
    endif()
    message(STATUS \"Left out: component ${component}, as \${WHY}\")
    return()
  endif()" COMPONENT ${component})
endfunction()

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
# Simbody's libraries are loaded by name, which dpkg-shlibdeps does not see.
string(REGEX MATCH "^[0-9]+\\.[0-9]+" SIMBODY_PACKAGE "${Simbody_VERSION}")
set(SIMBODY_PACKAGE libsimbody${SIMBODY_PACKAGE})
set(CPACK_DEBIAN_PROGRAM_PACKAGE_DEPENDS ${SIMBODY_PACKAGE})
set(CPACK_DEBIAN_PROGRAM_PACKAGE_SECTION science)
set(CPACK_DEBIAN_PROGRAM_PACKAGE_NAME kurbel)
set(CPACK_DEBIAN_PROGRAM_PACKAGE_SHLIBDEPS ON)
set(CPACK_DEBIAN_PROGRAM_PACKAGE_SUGGESTS "gnuplot-nox")
set(CPACK_DEBIAN_DEV_PACKAGE_NAME libkurbel-dev)
set(CPACK_DEBIAN_DEV_PACKAGE_SECTION libdevel)
set(CPACK_DEBIAN_DEV_PACKAGE_DEPENDS "${SIMBODY_PACKAGE}, libsundials-dev, libsuitesparse-dev, libtomlplusplus-dev, libfmt-dev, libsqlite3-dev, libxlsxwriter-dev, libzip-dev, zlib1g-dev, libpugixml-dev, libssl-dev")
set(CPACK_DEBIAN_DEV_PACKAGE_SUGGESTS "g++, cmake, pkg-config")
set(CPACK_DEBIAN_PYTHON_PACKAGE_NAME python3-kurbel)
set(CPACK_DEBIAN_PYTHON_PACKAGE_SECTION python)
set(CPACK_DEBIAN_PYTHON_PACKAGE_SHLIBDEPS ON)
set(CPACK_DEBIAN_PYTHON_PACKAGE_DEPENDS "python3 (>= 3.11), python3 (<< 3.12), python3-numpy, ${SIMBODY_PACKAGE}")
set(CPACK_DEBIAN_PYTHON_PACKAGE_SUGGESTS "python3-pandas, python3-distributed")
set(CPACK_STRIP_FILES ON)

# Pages of <kurbel/…>, by Doxygen.
add_custom_target(reference COMMAND ${PROJECT_SOURCE_DIR}/scripts/reference ${PROJECT_BINARY_DIR}/reference USES_TERMINAL)
