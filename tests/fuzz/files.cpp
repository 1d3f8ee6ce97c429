// files.cpp — valid files are made, changed and read.
#include "tests/fuzz/files.h"

#include <fmt/format.h>
#include <sys/mman.h>
#include <unistd.h>
#include <zip.h>
#include <zlib.h>

#include <bit>
#include <cmath>
#include <memory>

#include "engine/run/checkpoint.h"
#include "engine/tables/spreadsheet.h"
#include "engine/tables/table_text.h"
#include "studies/accuracy/known_accuracy.h"
#include "studies/scenes/kinds.h"
#include "studies/scenes/train_sheet.h"
#include "tests/fuzz/seeds.h"

namespace kurbel::fuzz {
namespace {

// A file that the readers can open by its path.
class MemoryFile {
 public:
  explicit MemoryFile(const std::string& bytes) : file_(memfd_create("fuzzed", 0)) {
    if (file_ < 0 || write(file_, bytes.data(), bytes.size()) != static_cast<ssize_t>(bytes.size()))
      throw std::runtime_error("no memory file");
  }
  ~MemoryFile() { close(file_); }
  MemoryFile(const MemoryFile&) = delete;
  MemoryFile& operator=(const MemoryFile&) = delete;
  std::string path() const { return fmt::format("/proc/self/fd/{}", file_); }

 private:
  int file_;
};

// Every refusal has words; nothing else is thrown.
template <class Ask>
std::string judged(const Ask& ask) {
  try {
    return ask();
  } catch (const SceneError& error) {
    if (error.messages.empty()) return "a refusal without a message";
    for (const Message& m : error.messages)
      if (m.text.empty()) return "a message without words";
    return {};
  } catch (const UnfitCheckpoint& error) {
    return std::string(error.what()).empty() ? "a refusal without words" : "";
  } catch (const std::exception& error) {
    return fmt::format("an exception that is no refusal: {}", error.what());
  }
}

void change_number(std::string& bytes, Random& random) {
  const std::vector<std::uint32_t> wild = {0,          1,          2,          14,         15,        0x7FFFFFFF,
                                           0xFFFFFFFF, 0xFFFFFFF8, 0x80000000, 0x00040001, 1'048'576, 0x0800};
  if (bytes.size() < 4) return;
  const std::size_t at = random.index(bytes.size() / 4) * 4;
  const std::uint32_t value = random.one_of(wild);
  for (std::size_t i = 0; i < 4; ++i) bytes[at + i] = static_cast<char>(value >> 8 * i);
}

std::string archive_of(const std::vector<std::pair<std::string, std::string>>& parts) {
  zip_error_t error;
  zip_error_init(&error);
  zip_source_t* const memory = zip_source_buffer_create(nullptr, 0, 0, &error);
  zip_source_keep(memory);
  zip_t* const archive = zip_open_from_source(memory, ZIP_TRUNCATE, &error);
  for (const auto& [name, text] : parts)
    zip_file_add(archive, name.c_str(), zip_source_buffer(archive, text.data(), text.size(), 0), ZIP_FL_OVERWRITE);
  zip_close(archive);
  zip_stat_t about;
  zip_source_stat(memory, &about);
  std::string bytes(about.size, '\0');
  zip_source_open(memory);
  zip_source_read(memory, bytes.data(), bytes.size());
  zip_source_close(memory);
  zip_source_free(memory);
  zip_error_fini(&error);
  return bytes;
}

std::string cell(int row, int column, const std::string& content, Random& random, std::vector<std::string>& words) {
  const std::string place = random.chance(0.9) ? fmt::format(" r=\"{}\"", cell_name(row, column)) : "";
  const bool number = !content.empty() && content.find_first_not_of("0123456789.eE+-") == std::string::npos;
  if (number) return fmt::format("<c{}><v>{}</v></c>", place, content);
  if (random.chance(0.5)) return fmt::format("<c{} t=\"inlineStr\"><is><t>{}</t></is></c>", place, content);
  words.push_back(content);
  return fmt::format("<c{} t=\"s\"><v>{}</v></c>", place, words.size() - 1);
}

std::string little_endian(std::uint32_t value) {
  std::string bytes;
  for (int i = 0; i < 4; ++i) bytes += static_cast<char>(value >> 8 * i);
  return bytes;
}
std::string element(std::uint32_t type, std::string data) {
  std::string bytes = little_endian(type) + little_endian(static_cast<std::uint32_t>(data.size())) + data;
  while (type != 15 && bytes.size() % 8 != 0) bytes += '\0';
  return bytes;
}
std::string compressed(const std::string& bytes) {
  uLongf size = compressBound(bytes.size());
  std::string packed(size, '\0');
  compress(reinterpret_cast<Bytef*>(packed.data()), &size, reinterpret_cast<const Bytef*>(bytes.data()), bytes.size());
  packed.resize(size);
  return packed;
}

std::string mat_array(Random& random) {
  const std::uint32_t rows = 1 + static_cast<std::uint32_t>(random.index(9)),
                      columns = 1 + static_cast<std::uint32_t>(random.index(3));
  std::string values;
  const std::uint32_t stored = random.chance(0.6) ? 9 : 1 + static_cast<std::uint32_t>(random.index(18));
  for (std::uint32_t i = 0; i < rows * columns; ++i) {
    const auto bits = std::bit_cast<std::uint64_t>(random.factor(1e6));
    values += little_endian(static_cast<std::uint32_t>(bits)) + little_endian(static_cast<std::uint32_t>(bits >> 32));
  }
  const std::vector<std::string> names = {"t",    "speed",       "torque",   "Aclass",
                                          "name", "description", "dataInfo", "data_1"};
  const std::uint32_t kind = random.chance(0.7) ? 6 : static_cast<std::uint32_t>(random.index(19));
  return element(14, element(6, little_endian(kind) + little_endian(0)) +
                         element(5, little_endian(rows) + little_endian(columns)) + element(1, random.one_of(names)) +
                         element(stored, values));
}

const char* const machine = R"(line = ["rotor", "shaft", "fan"]
rotor = { kind = "inertia", inertia = "0.1 kg*m2" }
shaft = { kind = "coupling", stiffness = "800 N*m/rad", damping = "1 N*m*s/rad" }
fan = { kind = "inertia", inertia = "0.4 kg*m2" }
drive = { kind = "torque source", torque = "15 N*m", on = "rotor" }
brake = { kind = "brake", torque = "10 N*m", on = "fan" }
effects = { elasticity = true }
run = { until = "0.1 s", start = { speed = "10 rad/s" } }
)";

class SmallMachine {
 public:
  SmallMachine() : scene_(parse_scene(machine, scene_path(), all_kinds())) {
    Equations at_start(compile(scene_, scene_.effects), false);
    model_ = at_start.shared_model();
    RunOptions options = limited();
    options.until = 0.05, options.to_go_on = true;
    checkpoint_ = text_of(integrate(at_start, options, {}).checkpoint, at_start);
    summary_ = fmt::format(
        R"({{"fingerprint": "{}", "models": [{{"name": "elastic", "effects": "{}", "figures": [{{"agreement": 1e-9}}]}}],
"settings": [{{"model": "elastic", "method": "dop853", "tolerance": 1e-6, "trajectory_error": 1e-7,
"figures": [{{"numerical_error": 1e-7}}], "seconds": {{"median": 0.001}}}}]}})",
        fingerprint(scene_.text), scene_.effects.describe());
  }
  const std::string& checkpoint() const { return checkpoint_; }
  const std::string& summary() const { return summary_; }

  std::string go_on_from(const std::string& text) const {
    Equations equations(model_, false);
    const Checkpoint checkpoint = checkpoint_from(text, equations);
    RunOptions options = limited();
    options.checkpoint = &checkpoint, options.until = checkpoint.state.t + 0.01;
    const RunOutcome outcome = integrate(equations, options, {});
    if (!outcome.complete) return outcome.diagnosis.empty() ? "an incomplete run without a diagnosis" : "";
    for (const double value : outcome.state)
      if (!std::isfinite(value)) return "complete, but a state is not finite";
    return {};
  }
  std::string setting_of(const std::string& text) const {
    const MemoryFile file(text);
    const KnownSetting known = known_setting(file.path(), scene_, scene_.effects, 1e-3);
    return known.tolerance > 0 && known.tolerance < 1 && known.error <= 1e-3 ? "" : "a setting that is none";
  }

 private:
  static RunOptions limited() {
    RunOptions options;
    options.budget = 0.1;
    return options;
  }
  Scene scene_;
  std::shared_ptr<const Model> model_;
  std::string checkpoint_, summary_;
};
const SmallMachine& small_machine() {
  static const SmallMachine made;
  return made;
}

}  // namespace

std::string mutated_file(const std::string& bytes, Random& random, const MutationStyle&) {
  std::string changed = bytes;
  for (std::size_t i = 1 + random.index(4); i-- > 0;)
    if (random.chance(0.4))
      change_number(changed, random);
    else
      change_bytes(changed, random);
  return changed;
}

std::string workbook_input(std::uint64_t seed, const MutationStyle&) {
  Random random(seed);
  const std::string& table = random.one_of(tables()).text;
  std::string rows;
  std::vector<std::string> words;
  int row = 1;
  for (std::size_t at = 0; at < table.size() && row < 40; ++row) {
    const std::size_t end = std::min(table.find('\n', at), table.size());
    rows += fmt::format("<row r=\"{}\">", row);
    int column = 1;
    for (std::size_t begin = at; begin <= end; ++column) {
      const std::size_t stop = std::min(table.find_first_of(",;\t\n", begin), end);
      rows += cell(row, column, table.substr(begin, stop - begin), random, words);
      begin = stop + 1;
    }
    rows += "</row>";
    at = end + 1;
  }
  std::string shared = "<sst>";
  for (const std::string& word : words) shared += "<si><t>" + word + "</t></si>";
  std::vector<std::pair<std::string, std::string>> parts = {
      {"xl/workbook.xml", "<workbook><sheets><sheet name=\"one\" sheetId=\"1\" r:id=\"rId1\"/></sheets></workbook>"},
      {"xl/_rels/workbook.xml.rels",
       "<Relationships><Relationship Id=\"rId1\" Target=\"worksheets/sheet1.xml\"/></Relationships>"},
      {"xl/worksheets/sheet1.xml", "<worksheet><sheetData>" + rows + "</sheetData></worksheet>"},
      {"xl/sharedStrings.xml", shared + "</sst>"}};
  for (std::size_t i = random.index(5); i-- > 0;)
    change_bytes(parts[random.chance(0.7) ? 2 : random.index(4)].second, random);
  const std::string archive = archive_of(parts);
  return random.chance(0.3) ? mutated_file(archive, random) : archive;
}

std::string mat_input(std::uint64_t seed, const MutationStyle&) {
  Random random(seed);
  std::string bytes(124, ' ');
  bytes += std::string("\x00\x01IM", 4);
  for (std::size_t i = 1 + random.index(5); i-- > 0;) {
    const std::string array = mat_array(random);
    const bool spoilt = random.chance(0.3);
    const std::string inner = spoilt ? mutated_file(array, random) : array;
    bytes += random.chance(0.4) ? element(15, compressed(inner)) : inner;
  }
  return random.chance(0.5) ? mutated_file(bytes, random) : bytes;
}

std::string train_sheet_input(std::uint64_t seed, const MutationStyle& style) {
  Random random(seed);
  return mutated_table(random.one_of(train_sheets()).text, random, style);
}

std::string json_input(std::uint64_t seed, const MutationStyle&) {
  Random random(seed);
  std::string text = random.chance(0.7) ? small_machine().checkpoint() : small_machine().summary();
  const std::vector<std::string> wild = {"null", "1e999", "-1", "0",    "1e308",  "[]",   "{}",
                                         "\"\"", "true",  "2",  "-2.5", "1e-320", "1e18", "\"dopri5\""};
  for (std::size_t i = 1 + random.index(4); i-- > 0;) {
    const std::size_t begin = text.find_first_of("0123456789\"", random.index(text.size()));
    if (begin == std::string::npos || random.chance(0.3)) {
      change_bytes(text, random);
      continue;
    }
    const std::size_t end = std::min(text.find_first_of(",\n]}:", begin), text.size());
    text.replace(begin, end - begin, random.one_of(wild));
  }
  return text;
}

std::string judge_sheet(const std::string& bytes) {
  return judged([&]() -> std::string {
    const std::string text = sheet_as_text(bytes, "", "fuzzed", max_table_bytes);
    if (text.size() > max_table_bytes + 64) return "more text than the limit allows";
    return text.find('\0') == std::string::npos ? "" : "a text with a zero byte";
  });
}

std::string judge_train_sheet(const std::string& text) {
  return judged([&]() -> std::string {
    const MemoryFile file(text);
    std::string scene;
    try {
      scene = scene_of_sheet(file.path());
    } catch (const SceneError& error) {
      for (const Message& m : error.messages)
        if (m.at.line < 1) return fmt::format("a message without place: {}", m.text);
      throw;
    }
    try {
      parse_scene(scene, "sheet.toml", all_kinds());
    } catch (const SceneError& error) {
      return fmt::format("a scene was made that cannot be read: {}", error.messages.front().text);
    }
    return {};
  });
}

std::string judge_json(const std::string& text) {
  return judged([&] {
    return text.find("\"fingerprint\"") == std::string::npos ? small_machine().go_on_from(text)
                                                             : small_machine().setting_of(text);
  });
}

}  // namespace kurbel::fuzz
