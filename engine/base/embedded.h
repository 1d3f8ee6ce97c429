// embedded.h — a file as a part of the program.
#pragma once

// At namespace scope of one source: NAME_begin[] … NAME_end are the bytes of `file`, which the build system names.
#define KURBEL_EMBEDDED(name, file)                                                \
  asm(".section .rodata\n.balign 16\n.global " #name "_begin\n" #name              \
      "_begin:\n"                                                                  \
      ".incbin \"" file "\"\n.global " #name "_end\n" #name "_end:\n.previous\n"); \
  extern "C" const char name##_begin[];                                            \
  extern "C" const char name##_end[]
