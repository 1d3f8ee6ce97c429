// sha256.h — SHA-256 (FIPS 180-4), by which a result set tells whether it is whole.
#pragma once

#include <string>
#include <string_view>

namespace kurbel {

// 64 hexadecimal digits, as sha256sum prints them.
std::string sha256(std::string_view data);

}  // namespace kurbel
