// report_question.cpp — kurbel report: asks modes and compare once each, and combines their findings into one document.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <memory>
#include <stdexcept>

#include "engine/model/model.h"
#include "engine/numerics/deadline.h"
#include "engine/reading/tolerances.h"
#include "engine/scene/document.h"
#include "engine/scene/messages.h"
#include "engine/scene/units.h"
#include "studies/claims/ranges.h"
#include "studies/findings/figure_text.h"
#include "studies/question/question.h"
#include "studies/reduce/reduce.h"
#include "studies/run/compare.h"
#include "studies/train_report/markdown.h"
#include "studies/train_report/sections.h"

namespace kurbel {
namespace {

using namespace train_report;

struct ReportRequest {
  std::vector<std::string> cases, sections;
  std::string revision, document;
};

std::vector<bool> wanted_sections(const std::vector<std::string>& asked) {
  std::vector<bool> wanted(section_names.size(), asked.empty());
  std::vector<std::string> words;
  for (const SectionName& name : section_names) words.emplace_back(name.word);
  for (const std::string& word : asked) {
    const auto found = std::find(words.begin(), words.end(), word);
    if (found == words.end())
      throw std::invalid_argument(fmt::format("--sections {}: no such section{}; allowed: {}", in_quotes(word),
                                              suggestion(word, words), listed(words, "and")));
    wanted[static_cast<std::size_t>(found - words.begin())] = true;
  }
  return wanted;
}

// A question that cannot be answered does not end the report: the reason is given.
Part asked(const std::string& question, const Inquiry& inquiry, const GivenOptions& given) {
  Part part{question};
  try {
    part.output = question_named(question).answer(inquiry, given);
  } catch (const SceneError&) {
    throw;
  } catch (const OutOfTime& out) {
    if (out.interrupted()) throw;
    part.why = out.what();
  } catch (const std::logic_error& refused) {
    part.why = refused.what();
  } catch (const std::runtime_error& failed) {
    part.why = failed.what();
  }
  return part;
}

double number_in(const Value* record, const std::string& key) {
  for (const Field& field : record && record->as<Record>() ? *record->as<Record>() : Record{})
    if (const double* number = field.key == key ? field.value.as<double>() : nullptr) return *number;
  return 0;
}
std::string word_in(const Value* record, const std::string& key) {
  for (const Field& field : record && record->as<Record>() ? *record->as<Record>() : Record{})
    if (const std::string* word = field.key == key ? field.value.as<std::string>() : nullptr) return *word;
  return {};
}

// Files that the scene takes data from, with their lines in it.
void add_files(const DocumentValue& value, Lines& lines) {
  for (const DocumentEntry& entry : value.entries) {
    if ((entry.key == "file" || entry.key == "return_file") && entry.value.type == DocumentValue::Type::text)
      lines.push_back({entry.value.text, fmt::format("line {} of the scene", entry.at.line)});
    add_files(entry.value, lines);
  }
  for (const DocumentValue& item : value.items) add_files(item, lines);
}

const char* name_of(Tolerance::Distribution distribution) {
  constexpr const char* names[] = {"normal", "uniform", "triangular"};
  return names[static_cast<std::size_t>(distribution)];
}

class TrainReport {
 public:
  TrainReport(const Inquiry& inquiry, const ReportRequest& asked)
      : inquiry_(inquiry), asked_(asked), wanted_(wanted_sections(asked.sections)) {}

  StudyOutput output() {
    ask();
    StudyOutput out;
    Findings& f = out;
    open(f);
    f.claim(claims_of(*parts_));
    if (f.claims.empty()) f.conclude(false, "Nothing could be assessed");
    std::vector<Chapter> chapters;
    for (std::size_t s = 0; s < section_names.size(); ++s)
      chapters.push_back(f.chapter(title_of(static_cast<Place>(s), elastic_)));
    const auto chapter = [&](Place s) { return chapters[static_cast<std::size_t>(s)]; };
    const std::vector<std::string> open_points = open_list();
    if (wants(Place::scope)) say_scope(f, chapter(Place::scope), open_points, why_no_verdict(f.claims));
    for (const Part& part : *parts_) {
      if (!part.assessed()) continue;
      if (part.question == "compare" && wants(Place::time)) say_figures(part, f, chapter(Place::time));
      take(*parts_, part, wanted_, chapters, f);
    }
    if (wants(Place::train)) say_train(f, chapter(Place::train));
    if (wants(Place::input))
      f.show(chapter(Place::input), Text{.title = inquiry_.scene.file, .body = inquiry_.scene.text, .verbatim = true});
    for (std::size_t s = 0; s < section_names.size(); ++s)
      if (wanted_[s] && is_empty(f, chapters[s]))
        f.show(chapters[s], Text{.title = "", .body = why_empty(*parts_, static_cast<Place>(s))});
    state(out, open_points);
    out.study = parts_;
    return out;
  }

 private:
  bool wants(Place s) const { return wanted_[static_cast<std::size_t>(s)]; }

  // First `compare`, which draws the machine, then `modes`, which assesses it: the order of findings within a section.
  // A machine without an elastic part has nothing to compare with: `run`.
  void ask() {
    GivenOptions of_modes;
    for (const std::string& name : asked_.cases) of_modes.emplace_back("cases", name);
    const auto any = [&](std::initializer_list<Place> sections) {
      return std::any_of(sections.begin(), sections.end(), [&](Place s) { return wants(s); });
    };
    if (any({Place::scope, Place::modes, Place::margins, Place::response, Place::assumptions}))
      parts_->push_back(asked("modes", inquiry_, of_modes));
    if (!elastic_ && !parts_->empty() && parts_->front().why.starts_with("nothing is elastic"))
      parts_->front().why = nothing_elastic;
    if (any({Place::scope, Place::train, Place::response, Place::time, Place::assumptions}))
      parts_->push_back(asked(elastic_ ? "compare" : "run", inquiry_, {}));
  }

  void open(Findings& f) const {
    const std::vector<std::pair<const char*, const std::string*>> said = {
        {"document ", &asked_.document}, {"revision ", &asked_.revision}, {"by ", &inquiry_.author}};
    f.title = inquiry_.scene.heading(), f.page_title = f.title + ": torsional report";
    for (const auto& [what, value] : said)
      if (!value->empty()) f.subtitle += (f.subtitle.empty() ? "" : " · ") + std::string(what) + *value;
    f.scene_file = inquiry_.scene.file, f.speed_unit = inquiry_.scene.speed_unit.name;
    f.opening = Findings::Opening::title_and_conclusion;
    f.footer = report_footer();
    for (const Part& part : *parts_) {
      add_figures(part, f);
      if (part.assessed() && !part.output.complete) f.complete = false, f.diagnosis = part.output.diagnosis;
      if (!part.output.unconfirmed.empty()) f.unconfirmed = part.output.unconfirmed;
      for (const NamedTable& table : part.output.tables) f.tables.push_back(table);
    }
  }

  // A row of tiles: three natural frequencies, the largest amplitude; the two largest torques in time.
  static void add_figures(const Part& part, Findings& f) {
    const std::size_t most = f.figures.empty() ? 3 : 2;
    std::size_t number = 0;
    for (const KeyFigure& figure : part.output.figures)
      if (figure.means == "largest_amplitude" || (number < most && figure.means != "processor_time")) {
        KeyFigure& tile = f.figures.emplace_back(figure);
        tile.digits = headline_digits, tile.error.reset(), ++number;
      }
  }

  const Part* part_of(const std::string& question) const {
    for (const Part& part : *parts_)
      if (part.question == question && part.assessed()) return &part;
    return nullptr;
  }
  const Value* range() const {
    const Part* modes = part_of("modes");
    return modes ? reported(*modes, "operating_range") : nullptr;
  }

  std::vector<std::string> open_list() const {
    std::vector<std::string> lines = not_assessed(*parts_);
    const Scene& scene = inquiry_.scene;
    if (scene.operation.speeds.empty())
      lines.push_back("a range of operating speeds: the scene gives none ([operation])");
    if (cases_of(scene.text, scene.file).empty())
      lines.push_back("cases of failure: the scene names none ([[case]])");
    else if (asked_.cases.size() == 1 && asked_.cases.front() == "none")
      lines.push_back("the scene's cases of failure: omitted by --cases");
    if (tolerances_of(scene.text, scene.file).empty())
      lines.push_back("the influence of tolerances on the margins: the scene gives none");
    std::vector<std::string> omitted;
    for (std::size_t s = 0; s < section_names.size(); ++s)
      if (!wanted_[s]) omitted.emplace_back(section_names[s].word);
    if (!omitted.empty()) lines.push_back(fmt::format("sections omitted by --sections: {}", fmt::join(omitted, ", ")));
    lines.push_back(
        "lateral and axial vibration; faults of the mains, and whatever else neither the scene's sequence nor its "
        "cases contain");
    for (std::string& line : lines) line = capitalised(line);
    return lines;
  }

  void say_scope(Findings& f, Chapter in, const std::vector<std::string>& open_points,
                 const std::string& no_verdict) const {
    const Scene& scene = inquiry_.scene;
    Lines lines = {{"machine", scene.heading()}, {"scene", scene.file}};
    if (!no_verdict.empty()) lines.push_back({"verdict", no_verdict});
    if (!inquiry_.settings.empty())
      lines.push_back({"set beside it", fmt::format("{}", fmt::join(inquiry_.settings, "; "))});
    if (const double fastest = number_in(range(), "fastest"); fastest > 0) {
      const double slowest = number_in(range(), "slowest");
      lines.push_back({"operating speeds", fmt::format("{}, {}; margin wanted ± {:.3g} %",
                                                       speed_range(slowest, fastest, scene.speed_unit, 5),
                                                       word_in(range(), "of"), 100 * number_in(range(), "margin"))});
    }
    lines.push_back({"effects", scene.effects.describe()});
    for (const Part& part : *parts_)
      if (part.assessed() && !part.output.subtitle.empty())
        lines.push_back({part.question == "modes" ? "in frequency" : "in time", part.output.subtitle});
    std::vector<std::string> names;
    if (const Part* modes = part_of("modes"))
      if (const Value* cases = reported(*modes, "cases"))
        for (const Value& one : *cases->as<List>()) names.push_back(word_in(&one, "name"));
    if (!names.empty()) lines.push_back({"cases", fmt::format("{}", fmt::join(names, "; "))});
    Rows table = words_table("Scope", {"", ""}, lines);
    table.text_columns = table.text_columns_on_terminal = 2;
    f.say(in, std::move(table));
    f.say(
        in,
        Sentences{
            .lines = open_points, .title = "Not assessed", .heading = "not assessed:", .indent = "  ", .apart = true});
  }

  // The key figures of the rigid and the elastic machine, side by side in their notes.
  static void say_figures(const Part& compare, Findings& f, Chapter in) {
    Lines lines;
    for (const KeyFigure& figure : compare.output.figures)
      if (!figure.note.empty() && figure.means != "processor_time")
        lines.push_back({figure.name,
                         fmt::format("{} {}", tile_text(figure, figure.digits).value, pretty_unit(figure.unit)),
                         figure.note});
    if (lines.empty()) return;
    Rows table = words_table("Rigid against elastic: key figures", {"figure", "elastic machine", "beside it"}, lines);
    table.text_columns = 3, table.terminal = false;
    f.say(in, std::move(table));
  }

  void say_train(Findings& f, Chapter in) const {
    const Scene& scene = inquiry_.scene;
    const auto model = compile(scene, scene.effects);
    const auto chain = std::make_shared<const Chain>(elastic_chain(*model, model->reduction_node));
    Rows table = chain_table(*chain, model->node_label(model->reduction_node), number_in(range(), "slowest"),
                             number_in(range(), "fastest"), scene.speed_unit);
    table.terminal = false;
    f.say(in, std::move(table));
    if (!chain->springs.empty()) f.draw(in, [chain] { return chain_plot(*chain); });
    Lines sources = {{scene.file, "the scene, in the appendix; remarks there say where values come from"}};
    add_files(parse_toml(scene.text, scene.file), sources);
    Rows files = words_table("Sources of data", {"file", "where"}, sources);
    files.text_columns = 2, files.terminal = false;
    f.say(in, std::move(files));
    Lines given;
    for (const Tolerance& t : tolerances_of(scene.text, scene.file))
      given.push_back({t.path, name_of(t.distribution), with_unit(t.value, t.unit, 6), with_unit(t.low, t.unit, 6),
                       with_unit(t.high, t.unit, 6)});
    if (given.empty()) return;
    Rows tolerances = words_table("Tolerances", {"value", "distribution", "as given", "from", "to"}, given);
    tolerances.text_columns = 2, tolerances.terminal = false;
    f.say(in, std::move(tolerances));
  }

  // The same document for programs, and as Markdown.
  void state(StudyOutput& f, const std::vector<std::string>& open_points) const {
    f.record("document",
             Record{{"number", asked_.document}, {"revision", asked_.revision}, {"author", inquiry_.author}});
    f.record("not_assessed", open_points);
    const Report page = f.report();
    f.record("sections", sections_of(page));
    for (const Part& part : *parts_)
      if (part.assessed()) f.record(part.question, summary_of(part.output));
    f.files.emplace_back("report.md", markdown_of(page));
  }
  const Inquiry& inquiry_;
  const ReportRequest& asked_;
  std::vector<bool> wanted_;
  bool elastic_ = is_elastic(*compile(inquiry_.scene, models_to_compare(inquiry_.scene).b));
  std::shared_ptr<std::vector<Part>> parts_ = std::make_shared<std::vector<Part>>();
};

StudyOutput reported(const Inquiry& inquiry, ReportRequest asked) { return TrainReport(inquiry, asked).output(); }

}  // namespace

Question report_question() {
  return make_question(
      {.place = 75,
       .name = "report",
       .arguments = "scene.toml",
       .help = "one document for a drive train: data, modes, margins, response, starts, what was not assessed",
       .does = "one document for a drive train, to be handed over: scope, verdict and what was not assessed on its "
               "first page; mass–elastic data; modes; margins; forced response with the scene's cases; starts and "
               "stops; assumptions; the input. It uses the results of `modes` and `compare`, each computed once. "
               "`report.html` "
               "prints to A4, `report.md` and `summary.json` contain the same document"},
      OptionsOf<ReportRequest>()
          .add({.name = "cases",
                .doc = "names of the scene's [[case]]s to compute; none: no case (default: all)",
                .each_time = true},
               &ReportRequest::cases)
          .add({.name = "sections",
                .doc = "of the document: scope, train, modes, margins, response, time, assumptions, input, joined by "
                       "commas (default: all)"},
               &ReportRequest::sections)
          .add({.name = "revision", .doc = "of the document, below its title"}, &ReportRequest::revision)
          .add({.name = "document", .doc = "number of the document, below its title"}, &ReportRequest::document),
      reported);
}

}  // namespace kurbel
