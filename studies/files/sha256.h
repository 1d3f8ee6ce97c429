// sha256.h — SHA-256 (FIPS 180-4), to check whether a result set is complete.
#pragma once

#include <string>
#include <string_view>

namespace kurbel {

// 64 hexadecimal digits, as sha256sum prints them.
std::string sha256(std::string_view data);

}  // namespace kurbel
