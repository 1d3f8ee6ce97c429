// fit.h — parameters of a machine from measured records: values with errors, what the records cannot determine,
// residuals, and predictions of other records.
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
  std::size_t like = 0;  // index of the record whose comparison, held speed and own unknowns are used
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

// Values in the unknown's unit, with the standard error; none: on a bound, or not determined.
struct FittedUnknown : Estimate {
  Unknown unknown;
  std::optional<double> low = {}, high = {};  // 95 %
  std::string remark = {};                    // "on its lower bound", "not determined", "without influence"
};

struct Correlation {
  std::size_t a = 0, b = 0;
  double value = 0;
};

// Residual between a channel of a record and the machine.
struct ChannelResidual {
  std::string record, channel, unit;
  std::string of = {};                    // "points", "orders"
  std::size_t count = 0;                  // values compared
  double rms = 0;                         // of the residual
  std::optional<double> range_part = {};  // over the measured range; of orders over the greatest amplitude
  double variation_part = 0;              // over the deviation of what was measured; of orders as range_part
  std::optional<double> scatter = {};     // of the mean: RMS of the deviations
  double correlation_length = 1;          // number of correlated values, τ ≥ 1: 1 for noise
  double alike = 0;                       // correlation of measured and fitted points
  double peak = 0, peak_fitted = 0;       // greatest magnitude of the points
  std::optional<double> times() const { return scatter && *scatter > 0 ? std::optional(rms / *scatter) : std::nullopt; }
  static constexpr double noise = 3;  // longest correlation of it
  // More than a third of what varies, above the scatter, and no noise: no value of the unknowns shows the record.
  bool is_unexplained() const {
    return variation_part > 1.0 / 3 && times().value_or(variation_part * 1e9) > 2 &&
           (of == "orders" || correlation_length > noise);
  }
};

// For a record over the angle, or a predicted one.
struct OrderFigure {
  std::string record, channel, unit;
  double order = 0;
  std::optional<OrderPart> measured = {};
  OrderPart shown = {};                // errors of a prediction: 95 %
  std::optional<double> left = {};     // magnitude of the difference
  std::optional<double> scatter = {};  // of the measured mean
};

// For a record over time: RMS within a frequency band, of the whole record about its mean, without a window (powers_of).
struct BandResidual {
  std::string record, channel, unit;
  double from = 0, to = 0;  // [Hz]
  double measured = 0, fitted = 0, left = 0;
};

struct EffectTried {
  std::string words, failed = {};
  double reduction = 0;  // of the weighted sum of squares after refitting: 1 − with/without
};

// An unknown as determined by the other records.
struct WithoutRecord {
  std::string record, name, unit;
  double value = 0, fitted = 0;       // in its unit
  std::optional<double> errors = {};  // difference over the standard error
  double rms = 0, rms_fitted = 0;     // of that record's residual over the deviations: predicted, fitted
};

// The curve of a record over its axis, with 95 % limits if it is predicted.
struct Curve95 {
  std::string record, channel, unit;
  Over over = Over::angle;
  std::vector<double> at, measured, shown, low = {}, high = {};  // measured empty: not known
  std::vector<double> orders = {};                               // that were compared; empty: all points
};

struct Prediction {
  std::string given, failed = {};
  std::optional<Estimate> delta = {};  // (max − min)/mid of the first speed, 95 %
  std::optional<double> measured_delta = {};
  std::optional<HeldQuantity> held = {};
  // Against the file, over the angle about the mean: RMS of the prediction's residual, and with the fitted record in its place.
  std::optional<double> rms = {}, rms_of_fitted_record = {};
  std::optional<double> inside = {};  // fraction of the points within 95 %
};

struct FitStudy : SceneStudy {
  std::vector<FittedUnknown> unknowns;
  std::vector<Correlation> correlations;  // strongest first
  std::vector<std::string> confounded;    // a sentence for each combination that the data cannot separate
  std::vector<ChannelResidual> residuals;
  std::vector<OrderFigure> orders, predicted_orders;
  std::vector<BandResidual> bands;
  std::vector<EffectTried> effects;
  std::vector<WithoutRecord> omitted;
  std::vector<Curve95> curves, predicted_curves;
  std::vector<Prediction> predictions;
  std::vector<std::string> held;  // "half: load.torque = 7.9 N·m keeps 3000 rpm"
  Eigen::MatrixXd covariance;     // of the unknowns in their units
  std::string errors_from;        // "the scatter of cycles", …
  double chi_squared = 0;         // over its degrees of freedom, by scatter; 0: not known
  std::size_t values = 0, runs = 0;
  int steps = 0;
  bool converged = false;
  std::string written;  // text of the fitted scene
};

FitStudy fit_machine(const FitOptions& options);

// --- parts of it (fit_checks.cpp, fit_predictions.cpp) ---

struct FitState {
  BoundedFit best;
  Determination determined;
  Eigen::MatrixXd covariance;  // of u, including the residuals
  double interval = 1.96;      // factor from standard error to 95 % (Student)
  bool has_errors = true;      // as many unknowns as values without scatter have none
};
void try_starts(FitProblem& problem, const FitOptions& options, FitState& state, FitStudy& study);
void leave_records_out(FitProblem& problem, const FitState& state, FitStudy& study);
void try_off_effects(FitProblem& problem, const FitState& state, FitStudy& study);
void predict(FitProblem& problem, const FitOptions& options, const FitState& state, FitStudy& study);

// The orders reported for records over the angle: those compared, otherwise the first eight of the cycle.
std::vector<double> reported_orders(const RecordRequest& request, const FitRecord& record);

// "0.5, 1.5, 2.5": each once, ascending.
std::string list_of_orders(std::vector<double> orders);

Findings findings_of(const FitStudy& study);

}  // namespace kurbel
