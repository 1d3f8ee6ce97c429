// run_time_image.cpp — takes the shared library in as it is, by the assembler.
#include "library/export/run_time_image.h"

#include <cstddef>

#include <kurbel_fmi_image.h>  // its checksum: a cache of objects sees no other change

// clang-format off
asm(".section .rodata\n"
    ".balign 16\n"
    ".global kurbel_fmi_image_begin\n"
    "kurbel_fmi_image_begin:\n"
    ".incbin \"" KURBEL_FMI_IMAGE "\"\n"
    ".global kurbel_fmi_image_end\n"
    "kurbel_fmi_image_end:\n"
    ".previous\n");
// clang-format on

extern "C" const char kurbel_fmi_image_begin[];
extern "C" const char kurbel_fmi_image_end[];

namespace kurbel {

std::string_view run_time_image() {
  return {kurbel_fmi_image_begin, static_cast<std::size_t>(kurbel_fmi_image_end - kurbel_fmi_image_begin)};
}

}  // namespace kurbel
