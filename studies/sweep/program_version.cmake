# program_version.cmake — writes the source whose text says which program this is: cmake -D SOURCE=… -D OUT=…
# -D VERSION=… -D BUILT_BY=… -P. It is left alone where it would not change.
file(GLOB_RECURSE sources LIST_DIRECTORIES false RELATIVE ${SOURCE}
  ${SOURCE}/engine/*.cpp ${SOURCE}/engine/*.h ${SOURCE}/drivetrain/*.cpp ${SOURCE}/drivetrain/*.h
  ${SOURCE}/mechanisms/*.cpp ${SOURCE}/mechanisms/*.h ${SOURCE}/studies/*.cpp ${SOURCE}/studies/*.h)
list(SORT sources)
set(all "${BUILT_BY}")
foreach(name IN LISTS sources)
  file(SHA256 ${SOURCE}/${name} mark)
  string(APPEND all "\n${name} ${mark}")
endforeach()
string(SHA256 mark "${all}")
string(SUBSTRING ${mark} 0 12 mark)
file(CONFIGURE OUTPUT ${OUT} @ONLY CONTENT [[
#include "studies/sweep/program_version.h"

namespace kurbel {
std::string program_version() { return "kurbel @VERSION@ (@mark@)"; }
}  // namespace kurbel
]])
