// built_in.h — files built into the program.
#pragma once

#include <string_view>

// Defines NAME(), the text of a file. Included by the assembler: a megabyte as a C++ array would take seconds to
// compile. At file scope, each name once in the program.
#define KURBEL_BUILT_IN(name, path)                   \
  asm(".section .rodata\n"                            \
      ".global kurbel_file_" #name                    \
      "_begin\n"                                      \
      ".global kurbel_file_" #name                    \
      "_end\n"                                        \
      "kurbel_file_" #name                            \
      "_begin:\n"                                     \
      ".incbin \"" path                               \
      "\"\n"                                          \
      "kurbel_file_" #name                            \
      "_end:\n"                                       \
      ".byte 0\n"                                     \
      ".previous\n");                                 \
  extern "C" const char kurbel_file_##name##_begin[]; \
  extern "C" const char kurbel_file_##name##_end[];   \
  static std::string_view name() { return {kurbel_file_##name##_begin, kurbel_file_##name##_end}; }
