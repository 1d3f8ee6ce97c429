// write_output.cpp — a study's files as one result set.
#include "studies/report/write_output.h"

#include "studies/files/result_set.h"

namespace kurbel {
namespace {

constexpr HashedBeginning of_pages =
#include <kurbel_page_beginning.h>
    ;

}  // namespace

std::filesystem::path write_output(const StudyOutput& output, const std::filesystem::path& folder,
                                   const WriteOptions& options) {
  const bool whole = output.complete && !options.interrupted;
  const std::filesystem::path place = whole ? folder : incomplete_place(folder);
  ResultSet set(place);
  make_table_files(output, options.formats,
                   [&](const std::string& name, const std::string& bytes) { set.add(name, bytes); });
  set.add("summary.json", output.json() + "\n");
  const Report report = output.report();
  set.add("report.html", html_of(report, options.head), of_pages);
  if (options.plots) {
    const std::vector<TextFile> files = gnuplot_files(report);
    for (const TextFile& file : files) set.add("plots/" + file.name, file.text);
    // An interrupted run does not wait for pictures: data and scripts allow drawing them later.
    if (const Descriptor plots = options.interrupted ? Descriptor() : open_folder(set.folder(), "plots"))
      for (const std::string& picture : draw_by_gnuplot(files, plots.get(), set.folder()))
        set.adopt("plots/" + picture);
  }
  set.put_in_place(options.made_by, whole);
  return place;
}

}  // namespace kurbel
