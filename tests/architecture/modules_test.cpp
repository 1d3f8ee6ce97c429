// modules_test.cpp — the architecture as drawn: which module may import which, how large modules and files are, and that each
// module's README is its table of contents. The order of the modules is that of add_subdirectory in the CMakeLists.txt.
#include <gtest/gtest.h>

#include <algorithm>
#include <cctype>
#include <filesystem>
#include <fstream>
#include <map>
#include <regex>
#include <set>
#include <sstream>
#include <string>
#include <vector>

namespace kurbel::modules_test {
namespace {

namespace fs = std::filesystem;

const std::vector<std::string> areas = {"engine", "drivetrain", "mechanisms", "studies", "library", "app"};

constexpr std::size_t most_files = 20;
// Families of elements may be more; the others named here have grown too large, and may not grow further.
const std::map<std::string, std::size_t> families = {
    {"engine/model", 23},
    {"engine/run", 21},
    {"studies/findings", 21},
    {"studies/run", 22},
};

constexpr long most_lines = 450;

std::string path_of(const std::string& relative) { return KURBEL_SOURCE_DIR "/" + relative; }

// Read once.
const std::vector<std::string>& lines_of(const std::string& relative) {
  static std::map<std::string, std::vector<std::string>> read;
  const auto [place, fresh] = read.try_emplace(relative);
  if (fresh) {
    std::ifstream in(path_of(relative));
    EXPECT_TRUE(in) << relative;
    for (std::string line; std::getline(in, line);) place->second.push_back(line);
  }
  return place->second;
}

std::string text_of(const std::string& relative) {
  std::stringstream text;
  text << std::ifstream(path_of(relative)).rdbuf();
  return text.str();
}

// What stands between `open` and `close` behind `begin` at a line's begin; empty: nothing.
std::string quoted(const std::string& line, const std::string& begin, char close) {
  if (!line.starts_with(begin)) return {};
  const std::size_t end = line.find(close, begin.size());
  return end == std::string::npos ? std::string{} : line.substr(begin.size(), end - begin.size());
}

bool is_source(const std::string& name) { return name.ends_with(".h") || name.ends_with(".cpp"); }

std::string module_of(const std::string& file) { return file.substr(0, file.rfind('/')); }

// "engine/numerics", …, "engine", "drivetrain/shared", …: each may import those before it.
std::vector<std::string> modules_in_order() {
  std::vector<std::string> modules;
  for (const std::string& area : areas) {
    for (const std::string& line : lines_of(area + "/CMakeLists.txt"))
      if (const std::string module = quoted(line, "add_subdirectory(", ')'); !module.empty())
        modules.push_back(area + "/" + module);
    modules.push_back(area);
  }
  return modules;
}

// Files of a module by their names; folders (what others have written, brought along) with a "/" behind.
std::vector<std::string> files_in(const std::string& module) {
  std::vector<std::string> names;
  for (const auto& entry : fs::directory_iterator(path_of(module)))
    if (!entry.is_directory() || !fs::is_empty(entry))
      names.push_back(entry.path().filename().string() + (entry.is_directory() ? "/" : ""));
  std::sort(names.begin(), names.end());
  return names;
}

struct Include {
  std::string file, of;
};

std::vector<Include> includes_of(const std::string& file) {
  std::vector<Include> all;
  for (const std::string& line : lines_of(file))
    if (const std::string of = quoted(line, "#include \"", '"'); !of.empty()) all.push_back({file, of});
  return all;
}

std::vector<std::string> sources_of(const std::string& module) {
  std::vector<std::string> files;
  for (const std::string& name : files_in(module))
    if (is_source(name)) files.push_back(module + "/" + name);
  return files;
}

bool speaks_simbody(const std::string& file) {
  for (const std::string& line : lines_of(file)) {
    std::string name = quoted(line, "#include <", '>') + quoted(line, "#include \"", '"');
    std::transform(name.begin(), name.end(), name.begin(), [](unsigned char c) { return std::tolower(c); });
    if (name.starts_with("simbody") || name.starts_with("simtk")) return true;
  }
  return false;
}

// With all that it includes.
bool shows_simbody(const std::string& file) {
  static std::map<std::string, bool> known;
  const auto [place, fresh] = known.try_emplace(file, false);
  if (!fresh) return place->second;
  bool shows = speaks_simbody(file);
  for (const Include& i : includes_of(file)) shows = shows_simbody(i.of) || shows;
  return known[file] = shows;
}

// Names in backquotes in the first column of a README's tables of files.
std::set<std::string> names_listed(const std::string& readme) {
  std::set<std::string> names;
  bool files = false;
  for (const std::string& line : lines_of(readme)) {
    files = line.starts_with("| file |") || (files && line.starts_with("|"));
    if (!files) continue;
    const std::string column = line.substr(0, line.find('|', 1));
    for (std::size_t open = column.find('`'); open != std::string::npos;) {
      const std::size_t close = column.find('`', open + 1);
      if (close == std::string::npos) break;
      names.insert(column.substr(open + 1, close - open - 1));
      open = column.find('`', close + 1);
    }
  }
  return names;
}

}  // namespace

// A module is understood with those before it alone.
TEST(Architecture, NoImportRunsBack) {
  const std::vector<std::string> modules = modules_in_order();
  const auto place = [&](const std::string& module) { return std::find(modules.begin(), modules.end(), module); };
  for (const std::string& module : modules)
    for (const std::string& file : sources_of(module))
      for (const Include& i : includes_of(file)) {
        const std::string from = module_of(i.of);
        ASSERT_NE(place(from), modules.end()) << file << " includes " << i.of << ", which is in no module";
        EXPECT_LE(place(from), place(module))
            << file << " includes " << i.of << ": " << module << " comes before " << from
            << ", so it may not import it; move what both need into an earlier module";
      }
}

// Linkages need no motors, and a page needs no study to be written.
TEST(Architecture, MechanismsKnowNoDrivetrainAndTheReportNoStudy) {
  for (const std::string& module : modules_in_order())
    for (const std::string& file : sources_of(module))
      for (const Include& i : includes_of(file)) {
        const std::string from = module_of(i.of);
        const bool drive = module.starts_with("mechanisms/") && from.starts_with("drivetrain");
        const bool study = module == "studies/report" && from.starts_with("studies/") && from != module &&
                           from != "studies/data" && from != "studies/files" && from != "studies/findings" &&
                           from != "studies/tables";
        EXPECT_FALSE(drive || study) << file << " includes " << i.of;
      }
}

// docs/modules.svg shows every area and every module of the engine: "engine/run", or "periodic" beside another.
TEST(Architecture, ThePictureShowsEveryModule) {
  std::string picture;
  for (const std::string& line : lines_of("docs/modules.svg")) picture += line + "\n";
  std::vector<std::string> shown(areas.begin(), areas.end());
  shown.insert(shown.end(), {"python", "report"});
  for (const std::string& module : modules_in_order())
    if (module.starts_with("engine/")) shown.push_back(module.substr(module.find('/') + 1));
  for (const std::string& name : shown)
    EXPECT_TRUE(std::regex_search(picture, std::regex("[> /]" + name + "[<,: /]"))) << name;
}

TEST(Architecture, ModulesHaveAtMostTwentyFiles) {
  for (const std::string& module : modules_in_order()) {
    const auto family = families.find(module);
    EXPECT_LE(sources_of(module).size(), family == families.end() ? most_files : family->second)
        << module << ": make a module of what belongs together";
  }
}

TEST(Architecture, FilesAreAtMost450Lines) {
  for (const std::string& module : modules_in_order())
    for (const std::string& file : sources_of(module))
      EXPECT_LE(static_cast<long>(lines_of(file).size()), most_lines) << file << ": split it";
}

// A header that describes physics knows what an element is, and nothing of networks and models: what an element becomes
// under effects is a free function, declared beside it and defined where networks are built.
TEST(Architecture, PhysicsKnowsNoNetwork) {
  int headers = 0;
  for (const std::string& module : modules_in_order()) {
    if (!module.starts_with("drivetrain")) continue;
    for (const std::string& file : sources_of(module)) {
      if (!file.ends_with(".h")) continue;
      ++headers;
      for (const Include& i : includes_of(file)) {
        const std::string from = module_of(i.of);
        EXPECT_TRUE(from.starts_with("drivetrain") || from == "engine/elements" || from == "engine/numerics" ||
                    from == "engine/scene")
            << file << " includes " << i.of;
        EXPECT_FALSE(i.of.starts_with("engine/elements/any_")) << file << " includes " << i.of;
      }
    }
  }
  EXPECT_GT(headers, 25);
}

// What happens is worded in one place: elsewhere nothing gives an event its words.
TEST(Architecture, EventsAreGivenWordsInOnePlace) {
  int files = 0;
  for (const std::string& module : modules_in_order()) {
    if (!module.starts_with("engine/")) continue;
    for (const std::string& file : sources_of(module)) {
      if (file.ends_with("event_words.cpp")) continue;
      ++files;
      const std::string text = text_of(file);
      for (const char* words :
           {".what = \"", ".what = fmt", "events.push_back({", "log.push_back({", "log->push_back({"})
        EXPECT_EQ(text.find(words), std::string::npos) << file << " words an event: " << words;
    }
  }
  EXPECT_GT(files, 100);
}

// Its headers do not compile as C++20.
TEST(Architecture, OnlyBodiesSpeakSimbody) {
  int within = 0;
  for (const std::string& module : modules_in_order())
    for (const std::string& file : sources_of(module)) {
      if (module == "mechanisms/bodies") {
        within += speaks_simbody(file);
      } else {
        EXPECT_FALSE(shows_simbody(file)) << file << " includes Simbody, itself or through another header";
      }
    }
  EXPECT_GT(within, 0);
}

// Every source is built, and by its own module's list.
TEST(Architecture, EveryModuleListsItsSources) {
  for (const std::string& module : modules_in_order()) {
    const std::string list = text_of(module + "/CMakeLists.txt");
    for (const std::string& name : files_in(module))
      EXPECT_TRUE(!name.ends_with(".cpp") || list.find(" " + name) != std::string::npos)
          << module << "/CMakeLists.txt does not list " << name;
  }
}

// The README of a module is its table of contents: all that is there, nothing that is not.
TEST(Architecture, EveryReadmeIsItsModulesTableOfContents) {
  for (const std::string& module : modules_in_order()) {
    const std::string readme = module + "/README.md";
    ASSERT_TRUE(fs::exists(path_of(readme))) << module << " has no README.md";
    const std::set<std::string> listed = names_listed(readme);
    for (const std::string& name : files_in(module))
      EXPECT_TRUE(listed.contains(name) || name == "README.md" || name == "CMakeLists.txt")
          << readme << " does not name " << name << ": add a line that says what it is";
    for (const std::string& name : listed)
      EXPECT_TRUE(fs::exists(path_of(module + "/" + name))) << readme << " names " << name << ", which is not there";
  }
}

// "Imports: `engine/numerics`, `engine/scene`." in the README are the modules that the sources include, or "nothing".
TEST(Architecture, EveryReadmeStatesWhatItsModuleImports) {
  for (const std::string& module : modules_in_order()) {
    if (std::find(areas.begin(), areas.end(), module) != areas.end()) continue;
    std::set<std::string> imported;
    for (const std::string& file : sources_of(module))
      for (const Include& i : includes_of(file))
        if (module_of(i.of) != module) imported.insert("`" + module_of(i.of) + "`");
    std::string listed = "Imports: ";
    for (const std::string& name : imported) listed += (name == *imported.begin() ? "" : ", ") + name;
    if (imported.empty()) listed += "nothing";
    const std::vector<std::string> lines = lines_of(module + "/README.md");
    EXPECT_NE(std::find(lines.begin(), lines.end(), listed + "."), lines.end())
        << module << "/README.md must have the line\n"
        << listed << ".";
  }
}

// A name of the namespace is one thing: two types of one name in two sources are linked into one without a word, with the
// members of either (ODR).
TEST(Architecture, NoTwoHeadersDefineTypesOfOneName) {
  const std::regex type("(?:struct|class) ([A-Za-z]+)(?: final)?(?: :[^:].*)? \\{.*");
  std::map<std::string, std::string> defined_in;
  std::vector<std::string> modules = modules_in_order();
  modules.push_back("library/kurbel");
  for (const std::string& module : modules)
    for (const std::string& file : sources_of(module)) {
      if (!file.ends_with(".h")) continue;
      for (const std::string& line : lines_of(file))
        if (std::smatch found; std::regex_match(line, found, type)) {
          const auto [place, fresh] = defined_in.try_emplace(found[1], file);
          EXPECT_TRUE(fresh || place->second == file) << file << " and " << place->second << " define " << found[1];
        }
    }
  EXPECT_GT(defined_in.size(), 400u);
}

// Links within the project lead somewhere.
TEST(Architecture, LinksBetweenDocumentsResolve) {
  std::vector<std::string> folders = {"", "tests", "bench", "docs", "docs/theory", "docs/tasks", "scenes"};
  for (const std::string& module : modules_in_order()) folders.push_back(module);
  int links = 0;
  for (const std::string& folder : folders)
    for (const auto& entry : fs::directory_iterator(path_of(folder))) {
      if (entry.path().extension() != ".md") continue;
      const std::string file = (folder.empty() ? "" : folder + "/") + entry.path().filename().string();
      const std::string text = text_of(file);
      for (std::size_t at = text.find("]("); at != std::string::npos; at = text.find("](", at + 2)) {
        const std::string link = text.substr(at + 2, text.find_first_of(")#\n", at + 2) - at - 2);
        if (link.empty() || link.find("://") != std::string::npos) continue;
        ++links;
        EXPECT_TRUE(fs::exists(path_of(folder) + "/" + link)) << file << " links to " << link << ", which is not there";
      }
    }
  EXPECT_GT(links, 30);
}

}  // namespace kurbel::modules_test
