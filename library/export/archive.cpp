// archive.cpp — the one source here that includes libzip.
#include "library/export/archive.h"

#include <fmt/format.h>
#include <kurbel_fmi_image.h>  // its checksum: a cache of objects sees no other change
#include <zip.h>

#include <cstddef>
#include <memory>
#include <stdexcept>

#include "engine/base/embedded.h"

KURBEL_EMBEDDED(kurbel_fmi_image, KURBEL_FMI_IMAGE);

namespace kurbel {

std::string zip_of(const std::vector<std::pair<std::string, std::string>>& files) {
  zip_error_t error;
  zip_error_init(&error);
  const auto fail = [&](const char* what) {
    const std::string why = zip_error_strerror(&error);
    zip_error_fini(&error);
    throw std::runtime_error(fmt::format("the archive cannot be {}: {}", what, why));
  };
  zip_source_t* const memory = zip_source_buffer_create(nullptr, 0, 0, &error);
  if (!memory) fail("begun");
  const std::unique_ptr<zip_source_t, void (*)(zip_source_t*)> kept(memory, zip_source_free);
  zip_source_keep(memory);
  zip_t* const archive = zip_open_from_source(memory, ZIP_TRUNCATE, &error);
  if (!archive) {
    zip_source_free(memory);
    fail("begun");
  }
  for (const auto& [name, bytes] : files) {
    zip_source_t* const source = zip_source_buffer(archive, bytes.data(), bytes.size(), 0);
    const zip_int64_t at = source ? zip_file_add(archive, name.c_str(), source, ZIP_FL_ENC_UTF_8) : -1;
    if (at < 0) {
      if (source) zip_source_free(source);
      zip_discard(archive);
      fail(("given " + name).c_str());
    }
    constexpr zip_uint16_t time = 0, date = (40 << 9) | (1 << 5) | 1;  // of DOS: 2020-01-01, 0:00
    zip_file_set_dostime(archive, static_cast<zip_uint64_t>(at), time, date, 0);
  }
  if (zip_close(archive) != 0) {
    zip_discard(archive);
    fail("written");
  }
  std::string all;
  zip_stat_t status;
  if (zip_source_open(memory) != 0 || zip_source_stat(memory, &status) != 0) fail("read");
  all.resize(status.size);
  const zip_int64_t got = zip_source_read(memory, all.data(), all.size());
  zip_source_close(memory);
  if (got != static_cast<zip_int64_t>(all.size())) fail("read");
  zip_error_fini(&error);
  return all;
}

std::string_view run_time_image() {
  return {kurbel_fmi_image_begin, static_cast<std::size_t>(kurbel_fmi_image_end - kurbel_fmi_image_begin)};
}

}  // namespace kurbel
