// agreement.h — one machine under every study: `run` until it is settled against what the other verbs say of it.
//
// A **cell** is one scene and one topic. Each figure of the topic is held against the run, and the worst decides:
//   agrees   |run − study| ≤ e_run + e_study + 1e-7 · scale
//            e_run    of the settled run (settled_run.h);  e_study  stated by the study, 0 where it states none
//            scale    rated quantity of the figure;  1e-7  what a run to 1e-10 a step, settled to 1e-7, leaves
//   reported it does not, and the study says what it omits and how much that is: a note of what is omitted or
//            taken otherwise, with a number
//   refused  the study answers no question of this scene, or not this one, and says why
//   silent   it does not agree, and nothing is said
// A scene whose run never settles is not judged; neither is a topic that has nothing to compare (no coupling, no
// flywheel to size because the speed does not vary).
#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "tests/agreement/settled_run.h"

namespace kurbel::agreement {

enum class Verdict { agrees, reported, refused, silent };  // ascending: the worst counts
const char* name_of(Verdict verdict);

enum class Topic {
  mean_speed,
  mid_speed,
  delta,
  period,
  peaks,
  rms,
  works,
  multipliers,
  energy,
  mean_torques,
  sized_delta,
  frequencies,
  damping,
  forced_orders,
  forced_peaks,
  linear_peaks,
  crank_torque,
  reactions,
  advice
};
inline constexpr std::size_t topic_count = 19;
inline constexpr std::size_t first_of_modes = 11;  // from here on: vibrations (compare_modes)
const char* name_of(Topic topic);

struct Compared {
  Topic topic = Topic::mean_speed;
  std::string figure;
  double run = 0, study = 0;
  double allowed = 0;  // by which they may differ
  Verdict verdict = Verdict::agrees;
  std::string words;  // why it was refused, or what was reported
};

struct Row {
  std::string scene;
  Motion kind = Motion::none;
  std::string orbit;  // of the run, in words
  std::vector<Compared> figures;
  double cpu_seconds = 0;

  // The worst figure of a topic; null: nothing is compared.
  const Compared* cell(Topic topic) const;
};

// Which verbs are asked.
struct Questions {
  bool steady = true, multipliers = true, reduce = true, size = true;
};

// Throws SceneError where the scene makes no machine.
Row compare_verbs(const Scene& scene, const Questions& questions, const SettleSettings& settings = {});

// `modes` against free and forced vibrations of the settled run (free_vibration.h, forced_vibration.h). No cells where
// nothing is elastic. Frequencies, damping: the three lowest vibrations of either, each against the other's nearest;
// forced_orders: amplitudes of every order of every joint's torque; forced_peaks: its mean, greatest and least value.
Row compare_modes(const Scene& scene, const SettleSettings& settings = {});

// `forces` against the settled run of the machine as the scene has it. crank_torque: greatest, least and mean torque on the crank against
// that of the coupling that alone drives it; reactions: main bearing and slider pin of a slider-crank without friction
// against Simbody's in the run's states. No cells where there is no such mechanism.
Row compare_forces(const Scene& scene, const SettleSettings& settings = {});

// `advise` against settled runs of what it recommends and of everything, with loads as they are and ± 20 %: figures of
// the settled motion within the tolerance of the advice, or a warning with its size. No cell where it recommends
// everything.
Row compare_advice(const Scene& scene, double within, const SettleSettings& settings = {});

// `modes`, `forces` and `advise` within 5 %, in one row.
Row compare_second_half(const Scene& scene, const SettleSettings& settings = {});

// Names of tests/agreement/*.toml, in alphabetic order. Templates are files of scenes/.
std::vector<std::string> scene_files(const std::string& folder);

// Notes that say what is omitted, and how much that is.
bool reports_how_much(const std::vector<std::string>& notes);

struct Totals {
  std::array<std::size_t, 4> of{};  // per verdict
  std::size_t cells = 0, unsettled = 0;
  double share(Verdict verdict) const;
};
Totals totals_of(const std::vector<Row>& rows);

// Rows as lines of text, for processes that measure apart, and back.
std::string lines_of(const Row& row);
Row read_row(const std::string& lines);

}  // namespace kurbel::agreement
