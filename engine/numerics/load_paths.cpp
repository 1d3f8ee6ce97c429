// load_paths.cpp — breadth-first trees, and the torques that circulate in closed loops.
#include "engine/numerics/load_paths.h"

#include <algorithm>
#include <numeric>

#include "engine/matrices/linear_algebra.h"
#include "engine/numerics/index.h"

namespace kurbel {

LoadPaths::LoadPaths(std::vector<LoadLink> links, std::size_t nodes)
    : links_(std::move(links)), links_at_(nodes), seen_(nodes, 0), used_(links_.size(), 0) {
  for (std::size_t j = 0; j < links_.size(); ++j) {
    links_at_[at(links_[j].a)].push_back(static_cast<int>(j));
    links_at_[at(links_[j].b)].push_back(static_cast<int>(j));
  }
}

std::vector<LoadStep> LoadPaths::from(int root) {
  std::vector<LoadStep> steps;
  std::vector<int> queue = {root};
  seen_[at(root)] = 1;
  for (std::size_t next = 0; next < queue.size(); ++next)
    for (const int j : links_at_[at(queue[next])]) {
      const LoadLink& link = links_[at(j)];
      const int other = link.a == queue[next] ? link.b : link.a;
      if (seen_[at(other)]) continue;
      seen_[at(other)] = 1;
      used_[at(j)] = 1;
      steps.push_back({j, other, queue[next], other == link.b, link.ratio});
      queue.push_back(other);
    }
  std::reverse(steps.begin(), steps.end());
  return steps;
}

std::vector<int> LoadPaths::closing() const {
  std::vector<int> list;
  for (std::size_t j = 0; j < links_.size(); ++j)
    if (!used_[j] && links_[j].a != links_[j].b && seen_[at(links_[j].a)] && seen_[at(links_[j].b)])
      list.push_back(static_cast<int>(j));
  return list;
}

LoadLoops::LoadLoops(const LoadPaths& paths, const std::vector<LoadStep>& steps, std::size_t nodes,
                     const std::vector<int>& names) {
  const std::vector<int> closing = paths.closing();
  if (closing.empty()) return;
  for (const LoadLink& link : paths.links()) compliance_.push_back(link.compliance);
  for (const int j : closing) {
    const LoadLink& link = paths.links()[at(j)];
    std::vector<double> need(nodes, 0.0), torque(compliance_.size(), 0.0);
    need[at(link.a)] += 1;
    need[at(link.b)] -= link.ratio;
    for (const LoadStep& step : steps) pass_on(step, need.data(), torque.data());
    torque[at(j)] = 1;
    std::vector<std::pair<int, double>>& loop = loops_.emplace_back();
    for (std::size_t k = 0; k < torque.size(); ++k)
      if (torque[k] != 0) loop.emplace_back(static_cast<int>(k), torque[k]);
  }
  const auto n = static_cast<Eigen::Index>(loops_.size());
  Eigen::MatrixXd flexibility = Eigen::MatrixXd::Zero(n, n);
  std::vector<double> row(compliance_.size(), 0.0);
  for (Eigen::Index i = 0; i < n; ++i) {
    for (const auto& [k, part] : loops_[static_cast<std::size_t>(i)]) row[at(k)] = part * compliance_[at(k)];
    for (Eigen::Index j = 0; j < n; ++j)
      for (const auto& [k, part] : loops_[static_cast<std::size_t>(j)]) flexibility(i, j) += row[at(k)] * part;
    for (const auto& [k, part] : loops_[static_cast<std::size_t>(i)]) row[at(k)] = 0;
  }
  const FullLu lu(flexibility);
  if (lu.invertible()) {
    const Eigen::MatrixXd inverse = lu.inverse();
    inverse_.assign(inverse.data(), inverse.data() + inverse.size());
    rename(names);
    return;
  }
  // A combination of loops without stiffness.
  const Eigen::VectorXd open = lu.kernel().col(0);
  Eigen::Index most = 0;
  open.cwiseAbs().maxCoeff(&most);
  undetermined_ = closing[static_cast<std::size_t>(most)];
}

void LoadLoops::rename(const std::vector<int>& names) {
  if (names.empty()) return;
  std::vector<double> compliance(at(*std::max_element(names.begin(), names.end())) + 1, 0.0);
  for (std::size_t k = 0; k < names.size(); ++k) compliance[at(names[k])] = compliance_[k];
  compliance_ = std::move(compliance);
  for (auto& loop : loops_)
    for (auto& [link, part] : loop) link = names[at(link)];
}

void LoadLoops::lock_in(const std::vector<double>& twist) {
  gape_.assign(loops_.size(), 0.0);
  for (std::size_t i = 0; i < loops_.size(); ++i)
    for (const auto& [k, part] : loops_[i]) gape_[i] += part * twist[at(k)];
}

void LoadLoops::share(double* torque) const {
  const std::size_t n = loops_.size();
  std::vector<double> twist(n, 0.0);  // whose sums are the gaps of the loops
  for (std::size_t i = 0; i < n; ++i) {
    if (!gape_.empty()) twist[i] = -gape_[i];
    for (const auto& [k, part] : loops_[i]) twist[i] += part * compliance_[at(k)] * torque[k];
  }
  for (std::size_t i = 0; i < n; ++i) {
    const double added = std::inner_product(twist.begin(), twist.end(), inverse_.data() + i * n, 0.0);
    for (const auto& [k, part] : loops_[i]) torque[k] -= part * added;
  }
}

}  // namespace kurbel
