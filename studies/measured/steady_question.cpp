// steady_question.cpp — kurbel steady: the steady motion found directly, rigid and elastic, a test's record over it.
#include "studies/measured/measurement_options.h"
#include "studies/measured/overlay.h"
#include "studies/question/question.h"

namespace kurbel {

const OptionsOf<MeasurementRequest>& measurement_options() {
  static const auto made =
      OptionsOf<MeasurementRequest>()
          .add(
              {.name = "measured",
               .doc = "a test's record (CSV, XLSX or MAT: headings with units, a column \"time [s]\"; rows that lack a "
                      "number are omitted), drawn over the plots; the difference is given as figures"},
              &MeasurementRequest::file)
          .add({.name = "map",
                .doc = "which column of the record is which channel, e.g. \"T1=torque.main_coupling\"; with a unit "
                       "where the heading has none, \"T1=torque.main_coupling [kN*m]\"; \"COLUMN=time [ms]\" for the "
                       "time; for steady cycles \"COLUMN=angle [deg]\": over the link's angle; repeatable",
                .each_time = true},
               &MeasurementRequest::maps)
          .add({.name = "shift",
                .doc = "added to the record's times, e.g. \"0.2 s\"; fit: found by least squares (default: none)"},
               &MeasurementRequest::shift)
          .add({.name = "offset",
                .doc = "offset that is subtracted from a column, e.g. \"T1=5 N*m\"; \"T1=fit\", or fit for every "
                       "column: found as the mean (default: none); repeatable",
                .each_time = true},
               &MeasurementRequest::offsets);
  return made;
}

namespace {

struct SteadyRequest : SteadyOptions {
  std::optional<Effects> effects;
  MeasurementRequest measured;
};

void held(std::optional<double>& speed, const std::optional<double>& other, const OptionValues& given) {
  given.read(speed);
  if (*speed == 0) given.refuse(given.text(), "a speed other than 0, e.g. \"60 rpm\"");
  if (other) given.refuse(given.text(), "one of mid speed and mean speed");
}

StudyOutput steady_motion(const Inquiry& inquiry, SteadyRequest asked) {
  asked.watch = inquiry.watch;
  asked.traces = inquiry.page;
  const std::vector<Effects> effects =
      asked.effects ? std::vector{*asked.effects} : effects_side_by_side(inquiry.scene);
  return cycles_under(asked.measured, inquiry.scene, effects, asked);
}

}  // namespace

Question steady_question() {
  return make_question(
      {.place = 80,
       .name = "steady",
       .arguments = "scene.toml",
       .help = "the steady cycle directly: its figures, its stability, operating points",
       .does = "the steady cycle directly, rigid and elastic: δ at every shaft, torques, works, Floquet multipliers "
               "(is it stable?), operating points, motor use, start time; `--mid-speed \"60 rpm\"` finds the drive "
               "torque for a speed; `--measured test.csv --map \"T1=torque.main_coupling\"` lays a test's record over "
               "the cycle, its time taken modulo the period"},
      OptionsOf<SteadyRequest>()
          .add({.name = "effects",
                .doc = "none, elasticity, or elasticity:COUPLING,… (default: rigid and the scene's, side by side)"},
               &SteadyRequest::effects)
          .add({.name = "at",
                .doc = "the machine in another state: after \"step 2\" of the sequence, at \"1.5 s\", or at a mid "
                       "speed (default: where its own start leads to; of a machine that rests in the end, the last "
                       "motion that it keeps before)"},
               OptionForm::one,
               [](SteadyRequest& asked, const OptionValues& given) { asked.at = given.moment(asked.mid_speed); })
          .add({.name = "mid_speed",
                .doc = "(ω_max + ω_min)/2 of the crank, e.g. \"60 1/min\": finds the drive torque that it needs",
                .example = "60 rpm",
                .what = "a speed other than 0"},
               OptionForm::one,
               [](SteadyRequest& asked, const OptionValues& given) { held(asked.mid_speed, asked.mean_speed, given); })
          .add({.name = "mean_speed",
                .doc = "the same of the mean speed over time, 2π n/T",
                .example = "60 rpm",
                .what = "a speed other than 0"},
               OptionForm::one,
               [](SteadyRequest& asked, const OptionValues& given) { held(asked.mean_speed, asked.mid_speed, given); })
          .add({.name = "hold_by",
                .doc = "COMPONENT.KEY, e.g. \"load.torque\": the quantity of the scene that is scaled to keep that "
                       "speed (default: a torque is added to the drive)"},
               &SteadyOptions::hold_by)
          .add(
              {.name = "periods",
               .doc =
                   "cycles after which the motion repeats; up to twelve times as many where it needs them (default: 1)",
               .domain = {.low = 1, .high = 64}},
              &SteadyOptions::periods)
          .add(measurement_options(), &SteadyRequest::measured)
          .add({.name = "no_start", .doc = "skip the start from rest and the gearbox ratio that starts fastest"},
               &SteadyOptions::start_search, false),
      steady_motion);
}

}  // namespace kurbel
