// progressive_coupling.cpp — from points or a formula to pieces, their areas, and the way back from torque to twist.
#include "drivetrain/couplings/progressive_coupling.h"
#include "engine/numerics/roots.h"

#include <fmt/format.h>

#include <cmath>
#include <numbers>
#include <stdexcept>

namespace kurbel {
namespace {

constexpr double far_beyond = 1000;  // the straight ends reach this many times the range of the points

// Drops the points that lie on the straight line through their neighbours: no event where nothing changes.
void drop_straight_points(std::vector<double>& x, std::vector<double>& y) {
  std::vector<double> kept_x = {x.front()}, kept_y = {y.front()};
  for (std::size_t i = 1; i + 1 < x.size(); ++i) {
    const double before = (y[i] - kept_y.back()) / (x[i] - kept_x.back()),
                 after = (y[i + 1] - y[i]) / (x[i + 1] - x[i]);
    if (std::abs(before - after) <= 1e-12 * std::abs(before)) continue;
    kept_x.push_back(x[i]);
    kept_y.push_back(y[i]);
  }
  kept_x.push_back(x.back());
  kept_y.push_back(y.back());
  x = std::move(kept_x);
  y = std::move(kept_y);
}

void check_rises(const Curve& formula) {
  constexpr int samples = 1000;
  double before = -HUGE_VAL;
  for (int k = 0; k <= samples; ++k) {
    const double twist = formula.x().front() + (formula.x().back() - formula.x().front()) * k / samples;
    const double torque =
        formula.value_in(std::clamp(formula.piece(twist), 0, static_cast<int>(formula.x().size()) - 2), twist);
    if (!(torque > before))
      throw std::invalid_argument(fmt::format(
          "the torque does not rise at a twist of {:.4g} rad; it must, or no twist belongs to a torque", twist));
    before = torque;
  }
}

}  // namespace

ProgressiveCoupling::ProgressiveCoupling(const std::vector<double>& twist, const std::vector<double>& torque,
                                         Curve::Form form, double damping)
    : damping_(damping) {
  std::vector<double> x = twist, y = torque;
  const auto origin = std::find(x.begin(), x.end(), 0.0);
  if (origin == x.end() || y[static_cast<std::size_t>(origin - x.begin())] != 0)
    throw std::invalid_argument("the table does not pass through the origin; give the point [0, 0]");
  for (std::size_t i = 1; i < x.size(); ++i)
    if (x[i] == x[i - 1])
      throw std::invalid_argument(
          fmt::format("the torque jumps at point {}; no twist belongs to a torque within the jump (a preload is a "
                      "coupling with \"contact\")",
                      i + 1));
  for (std::size_t i = 1; i < x.size(); ++i)
    if (!(y[i] > y[i - 1]))
      throw std::invalid_argument(
          fmt::format("the torque does not rise from point {} to point {}; it must, or no twist belongs to a torque (a "
                      "gap is \"backlash\" of a coupling)",
                      i, i + 1));
  if (x.front() < 0 && x.back() <= 0)
    throw std::invalid_argument("the table ends at the origin; give the side of positive twist");
  given_twist_ = x.back(), given_torque_ = y.back();
  if (x.front() == 0) {  // one side counts for both
    std::vector<double> both_x, both_y;
    for (std::size_t i = x.size(); i-- > 1;) both_x.push_back(-x[i]), both_y.push_back(-y[i]);
    both_x.insert(both_x.end(), x.begin(), x.end());
    both_y.insert(both_y.end(), y.begin(), y.end());
    x = std::move(both_x);
    y = std::move(both_y);
  }
  const double range = x.back() - x.front();
  const auto beyond = [&](std::size_t inner, std::size_t end) {
    return (y[end] - y[inner]) / (x[end] - x[inner]) * far_beyond * range;
  };
  const std::size_t n = x.size();
  const double low = y.front() - beyond(1, 0), high = y.back() + beyond(n - 2, n - 1);
  x.insert(x.begin(), x.front() - far_beyond * range);
  y.insert(y.begin(), low);
  x.push_back(x.back() + far_beyond * range);
  y.push_back(high);
  if (form == Curve::Form::linear) drop_straight_points(x, y);
  curve_ = Curve(x, y, form);
  twist_scale_ = range;
  sum_up();
}

ProgressiveCoupling::ProgressiveCoupling(const Curve& formula) {
  std::vector<double> knots = formula.x();
  std::vector<FormulaProgram> programs = formula.programs();
  if (knots.front() > 0 || knots.back() <= 0)
    throw std::invalid_argument("the range of the formula must reach from 0 or below it to a positive twist");
  if (!(std::abs(formula.value(0.0)) <= 1e-9 * formula.max_abs()))
    throw std::invalid_argument(
        fmt::format("the formula gives {:.6g} N·m at zero twist; it must be 0 there", formula.value(0.0)));
  check_rises(formula);
  given_twist_ = knots.back(), given_torque_ = formula.y().back();
  if (knots.front() == 0) {  // one side counts for both
    std::vector<double> both;
    std::vector<FormulaProgram> both_programs;
    for (std::size_t i = knots.size(); i-- > 1;) both.push_back(-knots[i]);
    for (std::size_t i = programs.size(); i-- > 0;) both_programs.push_back(programs[i].mirrored());
    both.insert(both.end(), knots.begin(), knots.end());
    both_programs.insert(both_programs.end(), programs.begin(), programs.end());
    knots = std::move(both);
    programs = std::move(both_programs);
  }
  twist_scale_ = knots.back() - knots.front();
  // Straight on at either end.
  const auto tangent = [](const FormulaProgram& program, double at) {
    const Dual<1> end = program(Dual<1>::input(at, 0));
    FormulaProgram line;
    for (const double number : {end.value, end.d[0]}) line.push({FormulaOp::number, number});
    line.push({FormulaOp::variable, 0});
    line.push({FormulaOp::number, at});
    for (const FormulaOp op : {FormulaOp::subtract, FormulaOp::multiply, FormulaOp::add}) line.push({op, 0});
    return line;
  };
  programs.insert(programs.begin(), tangent(programs.front(), knots.front()));
  programs.push_back(tangent(programs.back(), knots.back()));
  knots.insert(knots.begin(), knots.front() - far_beyond * twist_scale_);
  knots.push_back(knots.back() + far_beyond * twist_scale_);
  curve_ = Curve(std::move(knots), std::move(programs));
  sum_up();
}

void ProgressiveCoupling::sum_up() {
  // Areas from θ = 0 outwards: those of the far ends are a million times as large.
  energy_.assign(curve_.x().size(), 0.0);
  const int middle = piece_at(0);
  const auto m = static_cast<std::size_t>(middle);
  energy_[m] = -curve_.area(middle, curve_.x()[m], 0);
  for (std::size_t i = m; i-- > 0;)
    energy_[i] = energy_[i + 1] - curve_.area(static_cast<int>(i), curve_.x()[i], curve_.x()[i + 1]);
  energy_[m + 1] = curve_.area(middle, 0, curve_.x()[m + 1]);
  for (std::size_t i = m + 2; i < energy_.size(); ++i)
    energy_[i] = energy_[i - 1] + curve_.area(static_cast<int>(i) - 1, curve_.x()[i - 1], curve_.x()[i]);

  const auto slope = [&](int piece) { return curve_.value_in(piece, Dual<1>::input(0.0, 0)).d[0]; };
  const int before = curve_.piece_begin(middle) == 0 ? middle - 1 : middle;
  rest_stiffness_ = 0.5 * (slope(before) + slope(middle));
}

double ProgressiveCoupling::energy(double twist) const {
  const int piece = piece_at(twist);
  const double begin = curve_.piece_begin(piece), end = curve_.piece_end(piece);
  if (begin >= 0) return energy_[static_cast<std::size_t>(piece)] + curve_.area(piece, begin, twist);
  if (end <= 0) return energy_[static_cast<std::size_t>(piece) + 1] - curve_.area(piece, twist, end);
  return curve_.area(piece, 0, twist);
}

double ProgressiveCoupling::twist_at(double torque) const {
  // The piece first, then halving to the last digit.
  const auto& y = curve_.y();
  const auto above = std::clamp<std::ptrdiff_t>(std::upper_bound(y.begin(), y.end(), torque) - y.begin(), 1,
                                                static_cast<std::ptrdiff_t>(y.size()) - 1);
  const int piece = static_cast<int>(above) - 1;
  const auto [low, high] = halved({curve_.piece_begin(piece), curve_.piece_end(piece)}, 200,
                                  [&](double twist) { return curve_.value_in(piece, twist) < torque; });
  return std::abs(curve_.value_in(piece, low) - torque) < std::abs(curve_.value_in(piece, high) - torque) ? low : high;
}

std::string ProgressiveCoupling::describe() const {
  return fmt::format(
      "progressive by a {} up to {:.4g}°, {:.6g} N·m; beyond it straight on; stiffness {:.6g} N·m/rad at zero twist",
      curve_.form() == Curve::Form::formula ? "formula" : "table", given_twist_ * 180 / std::numbers::pi, given_torque_,
      rest_stiffness_);
}

}  // namespace kurbel
