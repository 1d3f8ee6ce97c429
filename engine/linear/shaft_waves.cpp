// shaft_waves.cpp — exact against discretised stiffness of shafts between their ends, along modes and as a count.
#include "engine/linear/shaft_waves.h"

#include <cmath>
#include <vector>

#include "engine/matrices/linear_algebra.h"
#include "engine/numerics/index.h"
#include "engine/numerics/lobatto_element.h"

namespace kurbel {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;

// A continuous shaft that is elastic, and how its ends move with the coordinates.
struct Waves {
  const Network::Chain* chain = nullptr;
  Eigen::RowVectorXd in, out;
  double x(double omega) const { return omega / chain->wave_rate(); }
};

std::vector<Waves> waves_of(const LinearDrive& drive) {
  const Model& m = *drive.model;
  std::vector<char> elastic(m.network.chains.size(), 0);
  for (const ElasticJoint& e : m.elastic)
    if (const int chain = m.network.joints[at(e.joint)].chain; chain >= 0) elastic[at(chain)] = 1;
  std::vector<Index> row(m.shafts.size(), -1);
  for (std::size_t i = 0; i < drive.shaft.size(); ++i) row[at(drive.shaft[i])] = static_cast<Index>(i);
  const auto motion_of = [&](int node) -> Eigen::RowVectorXd {
    const Index r = row[at(m.shaft_of_node[at(node)])];
    if (r < 0) return Eigen::RowVectorXd::Zero(drive.size());
    const Eigen::VectorXd unit = Eigen::VectorXd::Unit(drive.motion.rows(), r);
    return m.gain_of_node[at(node)] * (drive.motion.transpose() * unit).transpose();
  };
  std::vector<Waves> all;
  for (std::size_t c = 0; c < m.network.chains.size(); ++c) {
    const Network::Chain& chain = m.network.chains[c];
    if (elastic[c] && chain.degree > 0)
      all.push_back({&chain, motion_of(chain.nodes.front()), motion_of(chain.nodes.back())});
  }
  return all;
}

}  // namespace

double wave_error(const LinearDrive& drive, const Eigen::VectorXd& shape, double omega) {
  if (!(omega > 0) || drive.model->network.chains.empty()) return 0;
  double work = 0;
  for (const Waves& w : waves_of(drive)) {
    const double in = w.in * shape, out = w.out * shape, x = w.x(omega);
    const double exact = exact_stiffness(x).of(in, out), element = element_stiffness(w.chain->degree, x).of(in, out);
    work += w.chain->stiffness * (exact - element);
  }
  return std::abs(work) / (2 * omega * drive.inertia.dot(shape.cwiseAbs2()));
}

int continuous_modes_below(const LinearDrive& drive, double omega) {
  MatrixXd d = drive.stiffness;
  d.diagonal() -= omega * omega * drive.inertia;
  int held = 0;
  for (const Waves& w : waves_of(drive)) {
    const double x = w.x(omega), k = w.chain->stiffness;
    const EndStiffness exact = exact_stiffness(x), element = element_stiffness(w.chain->degree, x);
    const Eigen::RowVectorXd together = w.in + w.out, against = w.in - w.out;
    d += 0.5 * k * (exact.together - element.together) * together.transpose() * together;
    d += 0.5 * k * (exact.against - element.against) * against.transpose() * against;
    held += held_modes_below(x) - held_modes_below(w.chain->degree, x);
  }
  // Its scale takes no part in the signs.
  const Eigen::VectorXd scale = drive.inertia.cwiseSqrt().cwiseInverse();
  const MatrixXd scaled = scale.asDiagonal() * d * scale.asDiagonal();
  const Eigen::VectorXd values = symmetric_eigenvalues(scaled);
  return held + static_cast<int>((values.array() < 0).count());
}

}  // namespace kurbel
