// constraints.cpp — what others see of the constraints, without the matrices behind them.
#include "engine/equations/constraints.h"

#include "engine/equations/constraint_system.h"

namespace kurbel {

Constraints::Constraints(std::size_t free_shafts) : system_(std::make_unique<System>(free_shafts)) {}
Constraints::Constraints(const Constraints& other) : system_(std::make_unique<System>(*other.system_)) {}
Constraints& Constraints::operator=(const Constraints& other) {
  *system_ = *other.system_;
  return *this;
}
Constraints::Constraints(Constraints&&) noexcept = default;
Constraints& Constraints::operator=(Constraints&&) noexcept = default;
Constraints::~Constraints() = default;
void Constraints::set(const std::vector<ConstraintRow>& rows) { system_->set(rows); }
bool Constraints::empty() const { return system_->empty(); }
bool Constraints::repeats() const { return system_->repeats(); }
void Constraints::share_by(const std::vector<double>& capacity) { system_->share_by(capacity); }
void Constraints::solve(std::span<const double> inertia, std::span<const double> torque, std::span<double> alpha,
                        std::span<double> multiplier) {
  system_->solve(inertia, torque, alpha, multiplier);
}
const std::optional<Constraints::Trouble>& Constraints::trouble() const { return system_->trouble(); }
void Constraints::project(std::span<const double> inertia, std::span<double> speed) {
  system_->project(inertia, speed);
}
std::vector<double> Constraints::mobility(std::span<const double> inertia, std::span<const int> shafts) {
  return system_->mobility(inertia, shafts);
}
double Constraints::mobility(std::span<const double> inertia, std::span<const ShaftGain> motion,
                             std::span<const ShaftGain> torque) {
  return system_->mobility(inertia, motion, torque);
}

}  // namespace kurbel
