# The run-time of exported components (library/fmi): rooms of the engine, drive and mechanisms once more, small (-Os) and
# without what reads files, linked so that it needs libc and libstdc++ alone.
set(rooms engine/base engine/scene engine/elements engine/model engine/equations engine/events engine/steppers engine/run
  engine/numerics engine/matrices engine/values engine/reading engine/tables "drivetrain(/[a-z_]+)?" mechanisms/linkage
  mechanisms/linkages mechanisms/loops mechanisms/bodies mechanisms/friction mechanisms/loads mechanisms/reduced mechanisms/deforming
  mechanisms/link_forces mechanisms/joints mechanisms/kinds)
list(JOIN rooms "|" rooms)
set(run_time ${KURBEL_SOURCES})
list(FILTER run_time INCLUDE REGEX "/((${rooms})/[a-z_]+|library/fmi/(directional|exported_machine|instance|instance_text|ports|variables))\\.cpp$")
list(FILTER run_time EXCLUDE REGEX "/(spreadsheet|mat_text|periodic_schur|multistep_stepper|load_simbody|travel_bodies)\\.cpp$")
add_library(kurbel_fmi SHARED ${run_time} ${KURBEL_FMI_ALONE})
set_target_properties(kurbel_fmi PROPERTIES CXX_VISIBILITY_PRESET hidden VISIBILITY_INLINES_HIDDEN ON LINKER_LANGUAGE CXX
  BUILD_RPATH "$ORIGIN" LIBRARY_OUTPUT_DIRECTORY ${PROJECT_BINARY_DIR})  # the path that the standard asks for
if(KURBEL_UNITY)
  set_target_properties(kurbel_fmi PROPERTIES UNITY_BUILD ON UNITY_BUILD_MODE GROUP)
endif()
target_compile_definitions(kurbel_fmi PRIVATE KURBEL_FMI_RUNTIME FMT_HEADER_ONLY=1 EIGEN_DONT_VECTORIZE)
# Optimised as a whole, in one part: 0.13 MB.
set(as_a_whole $<$<AND:$<CONFIG:Release>,$<CXX_COMPILER_ID:GNU>>:-flto=auto>)
target_compile_options(kurbel_fmi PRIVATE $<$<CONFIG:Release>:-Os> ${as_a_whole} $<$<CXX_COMPILER_ID:GNU>:-fno-guess-branch-probability> -ffunction-sections -fdata-sections -fno-semantic-interposition)
target_include_directories(kurbel_fmi PRIVATE ${PROJECT_SOURCE_DIR})
target_include_directories(kurbel_fmi SYSTEM PRIVATE ${KLU_INCLUDE})
set(archives ${SUNDIALS_ARCHIVES})
list(FILTER archives EXCLUDE REGEX "cvode|sunnonlinsolfixedpoint")
# SUNDIALS' own tables of coefficients are many.
target_link_libraries(kurbel_list_tables PRIVATE ${archives} ${CMAKE_DL_LIBS} m)
add_custom_command(OUTPUT ${PROJECT_BINARY_DIR}/kurbel_fmi_tables.h VERBATIM
  COMMAND sh -c "$<TARGET_FILE:kurbel_list_tables> > ${PROJECT_BINARY_DIR}/kurbel_fmi_tables.h" DEPENDS kurbel_list_tables)
target_sources(kurbel_fmi PRIVATE ${PROJECT_BINARY_DIR}/kurbel_fmi_tables.h)
target_include_directories(kurbel_fmi PRIVATE ${PROJECT_BINARY_DIR})
target_link_libraries(kurbel_fmi PRIVATE Eigen3::Eigen nlohmann_json::nlohmann_json kurbel_warnings ${archives})
foreach(part klu amd colamd btf suitesparseconfig)
  find_library(STATIC_${part} lib${part}.a REQUIRED)
  target_link_libraries(kurbel_fmi PRIVATE ${STATIC_${part}})
endforeach()
# What nothing of the interface leads to is left out of it. Where gold is installed (Debian's binutils have it), functions
# of the same code are held once: 0.3 MB.
find_program(GOLD ld.gold)
if(GOLD AND CMAKE_CXX_COMPILER_ID STREQUAL "GNU")
  target_link_options(kurbel_fmi PRIVATE -fuse-ld=gold -Wl,--icf=all)
endif()
target_link_options(kurbel_fmi PRIVATE -Wl,--gc-sections -Wl,--exclude-libs,ALL -Wl,-O2 -Wl,--as-needed
  -Wl,--version-script=${PROJECT_SOURCE_DIR}/library/fmi/exported.map)
if(CMAKE_BUILD_TYPE STREQUAL "Release")
  target_link_options(kurbel_fmi PRIVATE -s -Os ${as_a_whole} $<$<CXX_COMPILER_ID:GNU>:-flto-partition=one>)
endif()
if(NOT KURBEL_SANITIZE AND NOT KURBEL_LIBFUZZER)
  target_link_options(kurbel_fmi PRIVATE -Wl,-z,defs)
endif()
image_of(kurbel_fmi)
