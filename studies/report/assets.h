// assets.h — the page's parts, built into the program.
#pragma once

#include <string_view>

namespace kurbel::report_assets {

std::string_view page_html();
std::string_view page_css();
std::string_view page_js();
std::string_view plotly_js();
std::string_view plotly_licence();

}  // namespace kurbel::report_assets
