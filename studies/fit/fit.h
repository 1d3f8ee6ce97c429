// fit.h — parameters of a machine from measured records: values with errors, what the records cannot tell, what is left,
// and predictions of other records.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "studies/findings/output.h"
#include "studies/fit/fit_problem.h"

namespace kurbel {

// A record to be predicted: "full.toml at 3060 rpm against full.csv".
struct PredictionRequest {
  std::string given;
  std::size_t like = 0;  // compared, held, and with unknowns of its own as this record
  MachineQuestion scene = {};
  std::optional<double> mean_speed = {};  // to be held [rad/s]; none: that of the record `like`
  std::string against = {};               // a measured file; empty: none
};

struct FitOptions {
  std::vector<RecordRequest> records;
  std::vector<std::string> free;
  std::vector<PredictionRequest> predictions = {};
  std::size_t starts = 1;
  std::uint64_t seed = 1;
  int jobs = 1;
  bool checks = true;  // leave records out, try effects that are off
  Watch watch = {};
};

struct FittedUnknown {
  Unknown unknown;
  double value = 0;                           // in its unit, as those below
  std::optional<double> error = {};           // standard error; none: on a bound, or not determined
  std::optional<double> low = {}, high = {};  // 95 %
  std::string remark = {};                    // "on its lower bound", "not determined", "without influence"
};

struct Correlation {
  std::size_t a = 0, b = 0;
  double value = 0;
};

// Of a record's channel: what is left between it and the machine.
struct ChannelResidual {
  std::string record, channel, unit;
  std::string of = {};                    // "points", "orders"
  std::size_t count = 0;                  // values compared
  double rms = 0;                         // of the residual
  std::optional<double> range_part = {};  // over the measured range; of orders over the greatest amplitude
  std::optional<double> scatter = {};     // of the mean, RMS of the deviations
  double correlation_length = 1;          // values that go together, τ ≥ 1: 1 of noise
  double alike = 0;                       // correlation of measured and fitted points
  double peak = 0, peak_fitted = 0;       // greatest magnitude of the points
  std::optional<double> times() const { return scatter && *scatter > 0 ? std::optional(rms / *scatter) : std::nullopt; }
};

// Of a record over the angle, or of one that is predicted.
struct OrderFigure {
  std::string record, channel, unit;
  double order = 0;
  std::optional<OrderPart> measured = {};
  OrderPart shown = {};
  std::optional<double> left = {};                               // magnitude of the difference
  std::optional<double> scatter = {};                            // of the measured mean
  std::optional<double> amplitude_error = {}, phase_error = {};  // 95 %, of a prediction
};

// Of a record over time: RMS within a band of frequencies (Hann's window).
struct BandResidual {
  std::string record, channel, unit;
  double from = 0, to = 0;  // [Hz]
  double measured = 0, fitted = 0, left = 0;
};

struct EffectTried {
  std::string words, failed = {};
  double reduction = 0;  // of the weighted sum of squares, refitted: 1 − with/without
};

// An unknown as the other records find it.
struct WithoutRecord {
  std::string record, name, unit;
  double value = 0, fitted = 0;       // in its unit
  std::optional<double> errors = {};  // the difference over the standard error
  double rms = 0, rms_fitted = 0;     // of that record's residual over the deviations: predicted, fitted
};

// What a record shows: points over its axis, with 95 % where it is predicted.
struct Curve95 {
  std::string record, channel, unit;
  Over over = Over::angle;
  std::vector<double> at, measured, shown, low = {}, high = {};  // measured empty: not known
};

struct Prediction {
  std::string given, failed = {};
  std::optional<Estimate> delta = {};  // (max − min)/mid of the first speed, 95 %
  std::optional<double> measured_delta = {};
  std::optional<HeldQuantity> held = {};
  // Against the file, over the angle about the mean: what is left, and what taking the fitted record for it would leave.
  std::optional<double> rms = {}, rms_of_fitted_record = {};
  std::optional<double> inside = {};  // part of the points within 95 %
};

struct FitStudy {
  std::string title, scene_file, scene_text;
  SpeedUnit speed_unit;
  std::vector<FittedUnknown> unknowns;
  std::vector<Correlation> correlations;  // the strongest first
  std::vector<std::string> confounded;    // a sentence for each combination that the data cannot separate
  std::vector<ChannelResidual> residuals;
  std::vector<OrderFigure> orders, predicted_orders;
  std::vector<BandResidual> bands;
  std::vector<EffectTried> effects;
  std::vector<WithoutRecord> left_out;
  std::vector<Curve95> curves, predicted_curves;
  std::vector<Prediction> predictions;
  std::vector<std::string> held;  // "half: load.torque = 7.9 N·m keeps 3000 rpm"
  Eigen::MatrixXd covariance;     // of the unknowns in their units
  std::string errors_from;        // "scatter of 47 cycles", "what is left"
  double chi_squared = 0;         // over its degrees of freedom, by scatter; 0: none is known
  std::size_t values = 0, runs = 0;
  int steps = 0;
  bool converged = false;
  std::string written;  // text of the fitted scene
  std::vector<std::string> notes;
  std::string conclusion;
  bool complete = true;
  std::string diagnosis;
};

FitStudy fit_machine(const FitOptions& options);

// --- parts of it (fit_checks.cpp, fit_predictions.cpp) ---

struct FitState {
  BoundedFit best;
  Determination determined;
  Eigen::MatrixXd covariance;  // of u, with what the residuals leave
  double interval = 1.96;      // 95 % over the standard error (Student)
};
void try_starts(FitProblem& problem, const FitOptions& options, FitState& state, FitStudy& study);
void leave_records_out(FitProblem& problem, const FitState& state, FitStudy& study);
void try_off_effects(FitProblem& problem, const FitState& state, FitStudy& study);
void predict(FitProblem& problem, const FitOptions& options, const FitState& state, FitStudy& study);

// The orders that are told of records over the angle: those compared, else the first eight of the cycle.
std::vector<double> told_orders(const RecordRequest& request, const FitRecord& record);

Findings findings_of(const FitStudy& study);

}  // namespace kurbel
