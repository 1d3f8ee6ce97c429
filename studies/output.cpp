// output.cpp — files appear under their names only when they are whole.
#include "studies/output.h"

#include <fmt/format.h>

#include <filesystem>
#include <fstream>
#include <stdexcept>

namespace kurbel {
namespace {

void write_whole(const std::filesystem::path& path, const std::string& text) {
  const std::filesystem::path temporary = path.string() + ".part";
  std::ofstream out(temporary, std::ios::binary);
  out << text;
  out.close();
  if (!out) throw std::runtime_error(fmt::format("cannot write {}: is there room and permission?", temporary.string()));
  std::filesystem::rename(temporary, path);
}

void make_folder(const std::string& folder) {
  std::error_code status;
  std::filesystem::create_directories(folder, status);
  if (status) throw std::runtime_error(fmt::format("cannot make the folder {}: {}", folder, status.message()));
}

}  // namespace

void write_output(const StudyOutput& output, const std::string& folder, bool plots) {
  make_folder(folder);
  const std::filesystem::path path(folder);
  for (const CsvFile& csv : output.csv) write_whole(path / csv.name, csv.text());
  write_whole(path / "summary.json", output.json + "\n");
  const Report report = output.report();
  write_html(report, (path / "report.html").string());
  if (plots) write_gnuplot(report, (path / "plots").string());
}

}  // namespace kurbel
