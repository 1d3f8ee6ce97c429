// assets.cpp — includes the files by the assembler: a megabyte as a C++ array would take seconds to compile.
#include "studies/report/assets.h"

#define KURBEL_ASSET(name, file)                                                               \
  asm(".section .rodata\n"                                                                     \
      ".global kurbel_asset_" #name                                                            \
      "_begin\n"                                                                               \
      ".global kurbel_asset_" #name                                                            \
      "_end\n"                                                                                 \
      "kurbel_asset_" #name                                                                    \
      "_begin:\n"                                                                              \
      ".incbin \"" KURBEL_REPORT_FOLDER "/" file                                               \
      "\"\n"                                                                                   \
      "kurbel_asset_" #name                                                                    \
      "_end:\n"                                                                                \
      ".byte 0\n"                                                                              \
      ".previous\n");                                                                          \
  extern "C" const char kurbel_asset_##name##_begin[];                                         \
  extern "C" const char kurbel_asset_##name##_end[];                                           \
  namespace kurbel::report_assets {                                                            \
  std::string_view name() { return {kurbel_asset_##name##_begin, kurbel_asset_##name##_end}; } \
  }

KURBEL_ASSET(page_html, "page.html")
KURBEL_ASSET(page_css, "page.css")
KURBEL_ASSET(page_js, "page.js")
KURBEL_ASSET(plotly_js, "vendor/plotly-basic.min.js")
KURBEL_ASSET(plotly_licence, "vendor/plotly-LICENSE")
