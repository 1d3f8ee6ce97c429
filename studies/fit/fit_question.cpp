// fit_question.cpp — kurbel fit: its options, records, what is predicted.
#include <fmt/format.h>

#include <filesystem>
#include <stdexcept>

#include "engine/scene/document.h"
#include "engine/scene/messages.h"
#include "studies/files/whole_file.h"
#include "studies/fit/fit.h"
#include "studies/question/option.h"
#include "studies/question/question.h"
#include "studies/variants/in_threads.h"

namespace kurbel {
namespace {

struct FitRequest {
  FitRequest() { jobs = threads_of(0); }
  std::vector<std::string> measured, maps, over, free, hold, orders, predict, window, cycles, teeth;
  std::size_t starts = 1;
  std::uint64_t seed = 1;
  int jobs = 1;
  bool checks = true;
  std::string write;
};

// What stands behind a word of a text is cut off: "half.csv in half.toml" at " in ".
std::string behind(std::string& text, const std::string& word) {
  const std::size_t at = text.rfind(word);
  if (at == std::string::npos) return "";
  std::string rest = text.substr(at + word.size());
  text.resize(at);
  return rest;
}

// The scene itself, or another file's text.
MachineQuestion scene_of(const Inquiry& inquiry, const std::string& file) {
  MachineQuestion question = question_of(inquiry, {.of = "steady", .measure_error = false});
  if (file.empty()) return question;
  question.text = read_text_file(file, max_scene_bytes), question.file = file, question.settings.clear();
  return question;
}

double speed_of(const std::string& option, const std::string& text) {
  return quantity_of(option, text, "a speed", "3000 rpm", any_number);
}

class Asking {
 public:
  Asking(const Inquiry& inquiry, const FitRequest& asked) : inquiry_(inquiry), asked_(asked) {}

  FitOptions options() {
    FitOptions options;
    options.free = asked_.free, options.starts = asked_.starts, options.seed = asked_.seed, options.jobs = asked_.jobs;
    options.checks = asked_.checks, options.watch = inquiry_.watch;
    read_records();
    each("over", asked_.over, [](RecordRequest& r, const std::string& t) { r.over = over_named(t); });
    each("map", asked_.maps, [](RecordRequest& r, const std::string& t) { r.maps.push_back(t); });
    each("hold", asked_.hold, [this](RecordRequest& r, const std::string& t) { hold(r, t); });
    each("cycles", asked_.cycles, [this](RecordRequest& r, const std::string& t) {
      r.cycles = static_cast<int>(quantity_of("--cycles", t, "a number of cycles", "47", {.low = 1, .high = 1e6}));
    });
    each("teeth", asked_.teeth, [](RecordRequest& r, const std::string& t) { r.teeth = t; });
    each("window", asked_.window, [this](RecordRequest& r, const std::string& t) {
      r.window = quantity_of("--window", t, r.over == Over::time ? "a time > 0" : "an angle > 0",
                             r.over == Over::time ? "1 ms" : "12 deg", positive);
    });
    each("orders", asked_.orders, [this](RecordRequest& r, const std::string& t) { orders(r, t); });
    options.records = records_;
    for (const std::string& text : asked_.predict) options.predictions.push_back(prediction(text));
    return options;
  }

 private:
  void read_records() {
    if (asked_.measured.empty())
      throw std::invalid_argument(
          "--measured: give the measured record, e.g. --measured half.csv --map \"speed=speed.engine\"");
    for (std::string text : asked_.measured) {
      RecordRequest& r = records_.emplace_back();
      r.scene = scene_of(inquiry_, behind(text, " in "));
      const std::size_t equals = text.find('=');
      r.file = equals == std::string::npos ? text : text.substr(equals + 1);
      r.name = equals == std::string::npos ? std::filesystem::path(text).stem().string() : text.substr(0, equals);
      for (const std::string& other : names_)
        if (other == r.name)
          throw std::invalid_argument(
              fmt::format("--measured {}: two records have the name {}; give one a name of its own, e.g. \"second={}\"",
                          in_quotes(text), r.name, r.file));
      names_.push_back(r.name);
    }
  }

  template <class Take>
  void each(const std::string& option, const std::vector<std::string>& texts, const Take& take) {
    for (const std::string& text : texts) {
      const OfRecord of = of_record("--" + option + " " + in_quotes(text), text, names_);
      for (std::size_t r = 0; r < records_.size(); ++r)
        if (!of.record || *of.record == r) take(records_[r], of.rest);
    }
  }

  void hold(RecordRequest& r, std::string text) {
    const std::string by = behind(text, " by ");
    if (!text.starts_with("mean speed") || by.empty())
      throw std::invalid_argument(
          fmt::format("--hold {}: must be \"mean speed by COMPONENT.KEY\" or \"mean speed=3000 rpm by COMPONENT.KEY\"",
                      in_quotes(text)));
    r.hold_by = by;
    if (const std::size_t equals = text.find('='); equals != std::string::npos)
      r.mean_speed = speed_of("--hold", text.substr(equals + 1));
  }

  void orders(RecordRequest& r, const std::string& text) {
    for (std::size_t begin = 0; begin <= text.size();) {
      const std::size_t comma = std::min(text.find(',', begin), text.size());
      r.orders.push_back(quantity_of("--orders", text.substr(begin, comma - begin), "an order > 0", "0.5", positive));
      begin = comma + 1;
    }
  }

  PredictionRequest prediction(const std::string& text) {
    const OfRecord of = of_record("--predict " + in_quotes(text), text, names_);
    PredictionRequest made{.given = text, .like = of.record.value_or(0)};
    std::string rest = of.rest;
    made.against = behind(rest, " against ");
    if (const std::string speed = behind(rest, " at "); !speed.empty()) {
      if (records_[made.like].hold_by.empty())
        throw std::invalid_argument(fmt::format(
            "--predict {}: a speed can be held only as in the fit; give --hold \"mean speed by COMPONENT.KEY\"",
            in_quotes(text)));
      made.mean_speed = speed_of("--predict", speed);
    }
    made.scene = scene_of(inquiry_, rest);
    return made;
  }

  const Inquiry& inquiry_;
  const FitRequest& asked_;
  std::vector<RecordRequest> records_;
  std::vector<std::string> names_;
};

StudyOutput fitted(const Inquiry& inquiry, FitRequest asked) {
  if (!asked.write.empty())
    if (const std::string why = why_no_file_at(asked.write); !why.empty())
      throw std::invalid_argument(fmt::format("--write {}: {}", asked.write, why));
  FitStudy study = fit_machine(Asking(inquiry, asked).options());
  if (!asked.write.empty() && study.complete) write_whole(asked.write, study.written);
  return output_of(std::move(study));
}

OptionsOf<FitRequest> options() {
  const std::string record = "; \"half: …\" for the record half.csv alone";
  OptionsOf<FitRequest> options;
  const auto texts = [&](const char* name, std::vector<std::string> FitRequest::*member, const std::string& doc) {
    options.add({.name = name, .doc = doc + "; repeatable", .each_time = true}, member);
  };
  texts("measured", &FitRequest::measured,
        "a measured record (CSV, XLSX, MAT): \"half.csv\", \"half=file.csv\" with a name of its own, \"down.csv in "
        "down.toml\" of another scene");
  texts("map", &FitRequest::maps,
        "which column is which channel, \"speed=speed.engine\"; \"c*=speed.engine\": columns of many cycles; "
        "\"sd=scatter of speed.engine\": the deviation of one cycle; \"COLUMN=angle [deg]\"; of modes "
        "natural_frequency, damped_frequency, damping_ratio" +
            record);
  texts("over", &FitRequest::over, "angle (steady; default), time (run) or modes" + record);
  texts("free", &FitRequest::free,
        "an unknown with its bounds: \"rotor.inertia=0.005..0.05 kg*m2\"; \"each: KEY=…\" one for every record; \"gain "
        "of TABLE=0.9..1.1\", \"offset of TABLE=-0.1..0.1 bar\", \"shift of TABLE=-2..2 deg\", \"dead centre of "
        "TABLE=-2..2 deg\"; \"shift=…\", \"gain of CHANNEL=…\", \"offset of CHANNEL=…\", \"pattern of CHANNEL=1,2\" of "
        "a record" +
            record);
  texts("hold", &FitRequest::hold,
        "\"mean speed by load.torque\": the record's mean speed is kept by that quantity, \"mean speed=3000 rpm by "
        "load.torque\" another one" +
            record);
  texts("orders", &FitRequest::orders,
        "orders of the reduction link's turns that are compared, 0.5,1.5,2.5 (default: all points)" + record);
  texts("window", &FitRequest::window, "width over which each point is averaged, \"12 deg\", \"1 ms\"" + record);
  texts("cycles", &FitRequest::cycles,
        "number of cycles from which mean and scatter were formed (default: 1)" + record);
  texts("teeth", &FitRequest::teeth,
        "the mapped column holds the times at which an encoder's teeth pass: pitches of a turn less the missing teeth, "
        "60-2" +
            record);
  texts("predict", &FitRequest::predict,
        "a scene whose record is predicted with the fitted values: \"full.toml\", \"full.toml at 3060 rpm\" (mean "
        "speed held), \"full.toml against full.csv\"");
  return options
      .add({.name = "starts",
            .doc = "starts within the bounds, the scene's own values first (default: 1)",
            .domain = {.low = 1, .high = 10'000}},
           &FitRequest::starts)
      .add({.name = "seed", .doc = "of the starts (default: 1)", .domain = {.low = 0, .high = 9007199254740992}},
           &FitRequest::seed)
      .add({.name = "jobs", .doc = "threads (default: one for each core)", .domain = {.low = 1, .high = 1024}},
           &FitRequest::jobs)
      .add({.name = "no_checks", .doc = "skip the fits without each record, and with each effect that is off"},
           &FitRequest::checks, false)
      .add({.name = "write", .doc = "writes the fitted scene of the first record"}, &FitRequest::write);
}

}  // namespace

Question fit_question() {
  return make_question(
      {.place = 118,
       .name = "fit",
       .arguments =
           "scene.toml --measured half.csv --map \"speed=speed.engine\" --free \"rotor.inertia=0.005..0.05 kg*m2\"",
       .help = "parameters of the machine from measured records, with errors; predictions of other records",
       .does =
           "values of the scene by least squares from measured records, of `steady` over the angle, `run` over time, "
           "or `modes`: errors, correlations, what the data cannot separate, residuals and whether an effect that is "
           "off would explain it; `--predict full.toml` another record with its interval; `--write fitted.toml`"},
      options(), fitted);
}

}  // namespace kurbel
