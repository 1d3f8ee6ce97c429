// security_test.cpp — SECURITY.md, sentence by sentence: what a scene from a stranger may do at most.
#include <fcntl.h>
#include <gtest/gtest.h>
#include <poll.h>
#include <signal.h>
#include <sys/ptrace.h>
#include <sys/resource.h>
#include <sys/socket.h>
#include <sys/stat.h>
#include <sys/un.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <filesystem>
#include <fstream>
#include <functional>
#include <map>
#include <nlohmann/json.hpp>
#include <random>
#include <regex>
#include <sstream>
#include <thread>

#include "engine/scene/document.h"
#include "engine/tables/table_text.h"
#include "tests/support/files.h"
#include "tests/support/program.h"
#include "tests/support/sanitized.h"

namespace kurbel::security_test {
namespace {

namespace fs = std::filesystem;
using Clock = std::chrono::steady_clock;

using test::text_of;
void write_text(const fs::path& path, const std::string& text) {
  fs::create_directories(path.parent_path());
  std::ofstream(path, std::ios::binary) << text;
}

using test::Ended;

class Security : public test::ProgramTest {
 protected:
  Security() : ProgramTest("scene") {}

  // scene/NAME, whose torque stands in a data file.
  void scene_with_data(const std::string& name, const std::string& file) {
    write_text(
        folder_ / "scene" / name,
        "line = [\"wheel\"]\nwheel = { kind = \"flywheel\", inertia = \"1 kg*m2\" }\n"
        "source = { kind = \"torque source\", on = \"wheel\", table = { over = \"time\", unit = [\"s\", \"N*m\"], "
        "file = " +
            nlohmann::json(file).dump() + " } }\nrun = { until = \"1 s\" }\n");
  }
  void scene(const std::string& name, const std::string& title, const std::string& run = "until = \"0.2 s\"") {
    write_text(folder_ / "scene" / name,
               "title = " + std::regex_replace(nlohmann::json(title).dump(), std::regex("\x7F"), "\\u007F") +
                   "\nline = [\"motor\", \"coupling\", \"fan\"]\n"
                   "motor = { kind = \"dc shunt motor\", stall_torque = \"60 N*m\", no_load_speed = \"40 rad/s\", "
                   "inertia = \"1 kg*m2\" }\n"
                   "coupling = { kind = \"coupling\", stiffness = \"4 kN*m/rad\", damping = \"2 N*m*s/rad\" }\n"
                   "fan = { kind = \"load\", quadratic = \"0.02 N*m*s2/rad2\", inertia = \"0.6 kg*m2\" }\n"
                   "effects = { elasticity = true }\nrun = { accuracy = 1e-3, " +
                   run + " }\n");
  }

  // All that there is below the test's folder, links not followed, with its content; but the program's own streams.
  std::map<std::string, std::string> all_files() const {
    std::map<std::string, std::string> files;
    for (const auto& entry : fs::recursive_directory_iterator(folder_)) {
      const std::string name = fs::relative(entry.path(), folder_);
      if (name == "stdout" || name == "stderr") continue;
      const auto status = entry.symlink_status();
      files[name] = fs::is_symlink(status)        ? "link to " + fs::read_symlink(entry.path()).string()
                    : fs::is_regular_file(status) ? text_of(entry.path())
                                                  : "";
    }
    return files;
  }
};

constexpr const char* table = "0,0\n1,5\n2,5\n";

TEST_F(Security, ReadsOnlyDataFilesBelowItsOwnFolder) {
  write_text(folder_ / "secret.csv", table);
  write_text(folder_ / "scene/data/own.csv", table);
  fs::create_symlink("../secret.csv", folder_ / "scene/link.csv");
  fs::create_directory_symlink("..", folder_ / "scene/up");
  fs::create_symlink("data/own.csv", folder_ / "scene/inner.csv");
  for (const std::string& inside :
       {std::string("data/own.csv"), std::string("./data/../data/own.csv"), std::string("inner.csv"),
        std::string("../scene/data/own.csv"), (folder_ / "scene/data/own.csv").string()}) {
    scene_with_data("s.toml", inside);
    const Ended r = kurbel({"check", "s.toml"});
    EXPECT_EQ(r.code, 0) << inside << r.err;
  }
  for (const std::string& outside :
       {std::string("../secret.csv"), std::string("data/../../secret.csv"), (folder_ / "secret.csv").string(),
        std::string("link.csv"), std::string("up/secret.csv"), std::string("/etc/passwd"), std::string("../absent.csv"),
        std::string("../scene2/x.csv")}) {
    scene_with_data("s.toml", outside);
    for (const char* verb : {"check", "figures", "run", "compare", "modes"}) {
      const Ended r = kurbel({verb, "s.toml"});
      EXPECT_EQ(r.code, 2) << outside;
      EXPECT_EQ(r.err.rfind("s.toml:3:", 0), 0u) << r.err;
      EXPECT_NE(r.err.find("lies outside of the scene's folder"), std::string::npos) << r.err;
      EXPECT_NE(r.err.find("--allow-files"), std::string::npos) << r.err;
      EXPECT_EQ(r.err.find("root:"), std::string::npos);
    }
  }
  EXPECT_FALSE(fs::exists(folder_ / "scene/results"));
}

TEST_F(Security, ReadsAnywhereWhereTheUserAllowsIt) {
  write_text(folder_ / "secret.csv", table);
  scene_with_data("s.toml", "../secret.csv");
  EXPECT_EQ(kurbel({"check", "s.toml", "--allow-files"}).code, 0);
  const Ended r = kurbel({"run", "s.toml", "--allow-files", "--no-files", "--no-error"});
  EXPECT_EQ(r.code, 0) << r.err;
}

TEST_F(Security, ReadsRegularFilesOnly) {
  const fs::path own = folder_ / "scene";
  ASSERT_EQ(mkfifo((own / "pipe.csv").c_str(), 0600), 0);
  ASSERT_EQ(mkfifo((own / "pipe.toml").c_str(), 0600), 0);
  fs::create_directories(own / "folder.csv");
  const int socket_file = socket(AF_UNIX, SOCK_STREAM, 0);
  sockaddr_un address{.sun_family = AF_UNIX, .sun_path = {}};
  const fs::path before = fs::current_path();
  fs::current_path(own);
  std::strcpy(address.sun_path, "socket.csv");
  ASSERT_EQ(bind(socket_file, reinterpret_cast<const sockaddr*>(&address), sizeof address), 0);
  fs::current_path(before);
  const struct {
    std::string file, said;
  } data[] = {{"pipe.csv", "is a pipe; give a regular file"},
              {"folder.csv", "is a folder"},
              {"socket.csv", "is a socket; give a regular file"},
              {std::string("x\0y", 3), "no such file"}};
  for (const auto& d : data) {
    scene_with_data("s.toml", d.file);
    const auto begin = Clock::now();
    const Ended r = kurbel({"check", "s.toml"});
    EXPECT_EQ(r.code, 2) << d.file;
    EXPECT_NE(r.err.find(d.said), std::string::npos) << r.err;
    EXPECT_LT(Clock::now() - begin, std::chrono::seconds(5));
  }
  for (const char* file : {"pipe.toml", "/dev/zero", "/dev/null", "/dev/tty"}) {
    const Ended r = kurbel({"check", file});
    EXPECT_EQ(r.code, 2) << file;
    EXPECT_TRUE(r.err.find("give a regular file") != std::string::npos || r.err.find("cannot be opened") < r.err.size())
        << r.err;
  }
  scene("t.toml", "t");
  const Ended setting = kurbel({"run", "t.toml", "--setting", "pipe.toml"});
  EXPECT_EQ(setting.code, 2);
  EXPECT_NE(setting.err.find("is a pipe"), std::string::npos) << setting.err;
  close(socket_file);
}

TEST_F(Security, HasNothingWrittenButWhatTheCommandLineNames) {
  // A title, a name that a folder could be made of, an output that could be a path.
  scene("s.toml", "../../title");
  const std::vector<std::vector<std::string>> verbs = {
      {"check"}, {"figures"}, {"run"},    {"compare"},
      {"modes"}, {"effects"}, {"steady"}, {"advise", "--within", "50 %", "--no-held-out"},
  };
  const auto with = [](std::vector<std::string> words, const std::vector<std::string>& more) {
    words.insert(words.begin() + 1, "s.toml");
    words.insert(words.end(), more.begin(), more.end());
    return words;
  };
  const auto before = all_files();
  const auto home = [this] { setenv("HOME", folder_.path.c_str(), 1), setenv("TMPDIR", folder_.path.c_str(), 1); };
  for (const auto& verb : verbs) {
    const bool files = verb[0] != "check" && verb[0] != "figures";
    const Ended r =
        kurbel(with(verb, files ? std::vector<std::string>{"--no-files"} : std::vector<std::string>{}), home);
    EXPECT_EQ(r.code, 0) << verb[0] << r.err;
    EXPECT_EQ(all_files(), before) << verb[0];
    if (!files) continue;
    ASSERT_EQ(kurbel(with(verb, {"--out", "../out"}), home).code, 0);
    auto after = all_files();
    std::erase_if(after, [](const auto& file) { return file.first == "out" || file.first.starts_with("out/"); });
    EXPECT_EQ(after, before) << verb[0];
    EXPECT_TRUE(fs::exists(folder_ / "out/set.sha256")) << verb[0];
    fs::remove_all(folder_ / "out");
  }
  ASSERT_EQ(kurbel({"run", "s.toml"}, home).code, 0);
  auto after = all_files();
  std::erase_if(after, [](const auto& file) { return file.first.starts_with("scene/results"); });
  EXPECT_EQ(after, before);
  EXPECT_TRUE(fs::exists(folder_ / "scene/results/s/run/set.sha256"));
  // Names of scenes that are no names of folders.
  for (const char* name : {".toml", "..toml", "...toml"}) {
    scene(name, "t");
    ASSERT_EQ(kurbel({"run", name, "--no-error"}).code, 0);
    fs::remove(folder_ / "scene" / name);
  }
  EXPECT_TRUE(fs::exists(folder_ / "scene/results/_toml/run/set.sha256"));
  EXPECT_TRUE(fs::exists(folder_ / "scene/results/_/run/set.sha256"));
  after = all_files();
  std::erase_if(after, [](const auto& file) { return file.first.starts_with("scene/results"); });
  EXPECT_EQ(after, before);
}

TEST_F(Security, HasNoFileWrittenThroughALink) {
  const fs::path own = folder_ / "scene";
  scene("s.toml", "t");
  write_text(folder_ / "victim", "precious");
  // As earlier versions named what they put together.
  for (const char* name : {"summary.json.part", "report.html.part", "lean.toml.part", "lean.toml", "new.toml.part"})
    fs::create_symlink("../victim", own / name);
  fs::create_directories(own / "out/plots");
  fs::create_symlink("../../victim", own / "out/summary.json.part");
  fs::create_symlink("../../victim", own / "out/summary.json");
  EXPECT_EQ(kurbel({"run", "s.toml", "--out", "out"}).code, 2) << "a folder of links is none of results";
  EXPECT_EQ(kurbel({"run", "s.toml", "--out", "fresh", "--plots", "--no-error"}).code, 0);
  EXPECT_EQ(
      kurbel({"advise", "s.toml", "--within", "50 %", "--no-held-out", "--no-files", "--write", "lean.toml"}).code, 0);
  EXPECT_EQ(kurbel({"new", "press", "new.toml"}).code, 0);
  // Links in the place of a set's files go with them, one in the place of its folder is the user's.
  fs::remove(own / "fresh/summary.json");
  fs::create_symlink("../../victim", own / "fresh/summary.json");
  fs::remove_all(own / "fresh/plots");
  fs::create_directory_symlink("../..", own / "fresh/plots");
  EXPECT_EQ(kurbel({"run", "s.toml", "--out", "fresh", "--plots", "--no-error"}).code, 0);
  EXPECT_TRUE(fs::is_regular_file(fs::symlink_status(own / "fresh/summary.json")));
  EXPECT_TRUE(fs::is_directory(fs::symlink_status(own / "fresh/plots")));
  EXPECT_EQ(fs::read_symlink(own / "fresh/plots.kept-1"), "../..");
  for (const auto& entry : fs::directory_iterator(own))
    EXPECT_EQ(entry.path().filename().string().find(".kurbel-"), std::string::npos) << entry.path();
  EXPECT_EQ(text_of(folder_ / "victim"), "precious");
  EXPECT_EQ(text_of(own / "lean.toml").rfind("title", 0), 0u);
}

// Every new process and every program that is started is seen, by ptrace.
TEST_F(Security, HasNoCommandRun) {
  scene("s.toml", "$(touch ran) `touch ran` | touch ran; touch ran");
  for (const std::vector<std::string>& words : std::vector<std::vector<std::string>>{
           {"check", "s.toml"}, {"run", "s.toml"}, {"compare", "s.toml"}, {"modes", "s.toml"}, {"steady", "s.toml"}}) {
    const pid_t child = start(words, [] {
      setenv("ASAN_OPTIONS", "detect_leaks=0", 1);  // which traces, too
      ptrace(PTRACE_TRACEME, 0, nullptr, nullptr);
      raise(SIGSTOP);
    });
    int status = 0;
    waitpid(child, &status, 0);
    if (!WIFSTOPPED(status) ||
        ptrace(PTRACE_SETOPTIONS, child, nullptr,
               PTRACE_O_TRACEFORK | PTRACE_O_TRACEVFORK | PTRACE_O_TRACEEXEC | PTRACE_O_EXITKILL)) {
      kill(child, SIGKILL);
      waitpid(child, &status, 0);
      GTEST_SKIP() << "no ptrace here";
    }
    int programs = 0, processes = 0;
    for (int signal = 0; ptrace(PTRACE_CONT, child, nullptr, signal) == 0;) {
      if (waitpid(child, &status, 0) != child || !WIFSTOPPED(status)) break;
      const int event = status >> 16;
      programs += event == PTRACE_EVENT_EXEC;
      processes += event == PTRACE_EVENT_FORK || event == PTRACE_EVENT_VFORK;
      signal = event || WSTOPSIG(status) == SIGTRAP ? 0 : WSTOPSIG(status);
    }
    EXPECT_TRUE(WIFEXITED(status) && WEXITSTATUS(status) == 0) << words[0] << text_of(folder_ / "stderr");
    EXPECT_EQ(programs, 1) << words[0] << ": kurbel alone";
    EXPECT_EQ(processes, 0) << words[0];
  }
}

TEST_F(Security, TitleIsNoCommandOfGnuplotOrOfAShell) {
  scene("s.toml",
        "x'\nsystem(\"touch ran\")\n!touch ran\nset output '|touch ran'\n`touch ran`$(touch ran)\"; touch ran;\n'");
  const Ended r = kurbel({"run", "s.toml", "--plots", "--no-error", "--out", "out"});
  EXPECT_EQ(r.code, 0) << r.err;
  for (const auto& [name, text] : all_files()) {
    EXPECT_EQ(name.find("ran"), std::string::npos) << name;
    if (name.ends_with(".gp")) {
      EXPECT_EQ(text.find("\nsystem"), std::string::npos) << text;
      EXPECT_EQ(text.find("\n!"), std::string::npos) << text;
    }
  }
  EXPECT_TRUE(fs::exists(folder_ / "scene/out/plots"));
}

TEST_F(Security, ReportsTheTerminalNothingButText) {
  const std::string evil = "\033]0;owned\007\033[2J\u009B31m\u202E\r\x7F";
  const std::string name = "s\033[31m\xFF\n.toml";
  scene(name, evil);
  const auto clean = [](const std::string& text) {
    for (const char c : text)
      if ((static_cast<unsigned char>(c) < 0x20 && c != '\n' && c != '\t') || c == 0x7F) return false;
    return text.find("\u009B") == std::string::npos && text.find("\u202E") == std::string::npos &&
           text.find('\xFF') == std::string::npos;
  };
  for (const std::vector<std::string>& more :
       std::vector<std::vector<std::string>>{{}, {"--json"}, {"--quiet"}, {"--verbose"}, {"--explain"}})
    for (const char* verb : {"run", "compare", "modes", "check", "steady"}) {
      if (!more.empty() && (std::string(verb) == "check" || (more[0] == "--explain" && std::string(verb) != "run")))
        continue;
      std::vector<std::string> words = {verb, name};
      words.insert(words.end(), more.begin(), more.end());
      const Ended r = kurbel(words);
      EXPECT_EQ(r.code, 0) << r.err;
      EXPECT_TRUE(clean(r.out) && clean(r.err)) << testing::PrintToString(r.out + r.err);
      if (!more.empty() && more[0] == "--json") {
        EXPECT_EQ(nlohmann::json::parse(r.out)["title"], evil);
      }
    }
  for (const std::vector<std::string>& words :
       std::vector<std::vector<std::string>>{{"check", "absent\033[31m.toml"},
                                             {"\033[31mrun"},
                                             {"run", name, "--\033[31m"},
                                             {"new", "\033[31m"},
                                             {"run", name, "--out", "/dev/null/\033[31m"},
                                             {"run", name, "--effects", "\033[31m"}}) {
    const Ended r = kurbel(words);
    EXPECT_EQ(r.code, 2);
    EXPECT_TRUE(!r.err.empty() && clean(r.out) && clean(r.err)) << testing::PrintToString(r.out + r.err);
  }
}

TEST_F(Security, ReportAsksNoNetwork) {
  scene("s.toml", "</script><script src=\"https://example.org/x.js\"></script>");
  ASSERT_EQ(kurbel({"run", "s.toml", "--no-error", "--out", "out"}).code, 0);
  const std::string page = text_of(folder_ / "scene/out/report.html");
  EXPECT_NE(page.find("Content-Security-Policy\" content=\"default-src 'none';"), std::string::npos);
  EXPECT_EQ(page.find("<script src"), std::string::npos);
}

TEST_F(Security, LargerFilesAreRefusedAndEndlessOnesNotReadOn) {
  // Sparse: they take no space on disk, and would take the memory.
  const auto sparse = [](const fs::path& path, std::uintmax_t size) {
    write_text(path, "");
    fs::resize_file(path, size);
  };
  sparse(folder_ / "scene/large.toml", 1ull << 36);
  sparse(folder_ / "scene/large.csv", 1ull << 36);
  scene_with_data("s.toml", "large.csv");
  const auto little = [] {
    if (test::sanitized) return;  // it maps terabytes
    const rlimit limit{std::uint64_t{1} << 30, std::uint64_t{1} << 30};
    setrlimit(RLIMIT_AS, &limit);
  };
  const Ended large = kurbel({"check", "large.toml"}, little), data = kurbel({"check", "s.toml"}, little);
  EXPECT_EQ(large.code, 2);
  const std::string scenes = std::to_string(max_scene_bytes / 1'000'000) + " MB",
                    tables = std::to_string(max_table_bytes / 1'000'000) + " MB";
  EXPECT_NE(large.err.find("is larger than " + scenes), std::string::npos) << large.err;
  EXPECT_EQ(data.code, 2);
  EXPECT_NE(data.err.find("is larger than " + tables), std::string::npos) << data.err;
  const std::string promised = text_of(std::string(KURBEL_SOURCE_DIR) + "/SECURITY.md");
  EXPECT_NE(promised.find("A scene of more than " + scenes + " and a data file of more than " + tables),
            std::string::npos);
}

// Pieces of tables beyond their ends, senses and speeds by dice: a state that fits by its sizes alone.
TEST_F(Security, WildStatesEndInWords) {
  std::mt19937 dice(3);
  for (const char* name : {"piston_pump", "single_cylinder_engine", "crank_press", "stick_slip"}) {
    const std::string scene = KURBEL_SOURCE_DIR "/scenes/" + std::string(name) + ".toml";
    ASSERT_EQ(
        kurbel({"run", scene, "--until", "0.05 s", "--no-files", "--no-error", "--save-state", "state.json"}).code, 0)
        << name;
    const nlohmann::json whole = nlohmann::json::parse(text_of(folder_ / "scene" / "state.json"));
    for (int round = 0; round < 6; ++round) {
      nlohmann::json wild = whole;
      std::uniform_int_distribution<int> any(-10'000'000, 10'000'000), sense(-1, 1);
      for (auto& piece : wild["modes"]["piece"]) piece = round % 2 ? any(dice) : 10 * sense(dice);
      for (const char* senses : {"direction", "slip", "loss_direction"})
        for (auto& one : wild["modes"][senses]) one = sense(dice);
      for (auto& value : wild["y"]) value = value.get<double>() + round * 0.3 * sense(dice);
      write_text(folder_ / "scene" / "wild.json", wild.dump());
      const Ended ended =
          kurbel({"run", scene, "--until", "0.06 s", "--no-files", "--no-error", "--from-state", "wild.json"});
      EXPECT_TRUE(ended.code == 0 || ended.code == 2 || ended.code == 3) << name << " " << round << ": " << ended.code;
    }
  }
}

TEST_F(Security, EndsByItsBudgetAndByCtrlC) {
  // A pulsation: without one the steps would grow without limit.
  const std::string pulse =
      "until = \"10000000 s\" }\npulse = { kind = \"torque source\", amplitude = \"5 N*m\", "
      "frequency = \"5 Hz\", on = \"fan\"";
  scene("long.toml", "t", "budget = \"0.1 s\", " + pulse);
  const auto begin = Clock::now();
  EXPECT_EQ(kurbel({"run", "long.toml", "--no-files"}).code, 3);
  EXPECT_LT(Clock::now() - begin, std::chrono::seconds(8));
  scene("longer.toml", "t", pulse);
  const pid_t child = start({"run", "longer.toml", "--no-files"});
  test::wait_for_handler(child);
  std::this_thread::sleep_for(std::chrono::milliseconds(300));
  const auto asked = Clock::now();
  kill(child, SIGINT);
  EXPECT_EQ(wait(child).code, 130);
  EXPECT_LT(Clock::now() - asked, std::chrono::seconds(2));
}

}  // namespace
}  // namespace kurbel::security_test
