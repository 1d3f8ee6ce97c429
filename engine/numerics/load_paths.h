// load_paths.h — torques in rigid links from the nodes that need them to a root, and their distribution in closed loops.
//
//     need = torque that a node takes from its links [N·m];   a link passes τ from a to b: a gives τ, b gets ratio τ
// In a tree all torques follow from equilibrium. With closed loops any L c may be added, with one column of L for each
// closing link: a self-equilibrated set of torques with τ = 1 there. The actual distribution has the least energy
// Σ τ²/2k (Castigliano):
//     (Lᵀ C L) c = −Lᵀ (C τ_tree − θ),   C = 1/k, 0 for a link without stiffness; θ: initial twists
// which is the limit of elastic links for large stiffness. A loop without any stiffness is undetermined.
#pragma once

#include <cstddef>
#include <utility>
#include <vector>

namespace kurbel {

struct LoadLink {
  int a = 0, b = 0;       // nodes; ω_a = ratio ω_b; a link of a node with itself is ignored
  double ratio = 1;       // torque on b over torque of a
  double compliance = 0;  // 1/k [rad/(N·m)]; 0: no twist
};

// One link of a tree with its end towards the root.
struct LoadStep {
  int link = 0, child = 0, parent = 0;
  bool child_is_b = false;
  double ratio = 1;
};

// Passes the child's need to its parent.
inline void pass_on(const LoadStep& step, double* need, double* torque) {
  const double wanted = need[step.child];
  torque[step.link] = step.child_is_b ? wanted / step.ratio : -wanted;
  need[step.parent] += step.child_is_b ? wanted / step.ratio : step.ratio * wanted;
}

// Trees from given roots; links that close loops remain.
class LoadPaths {
 public:
  LoadPaths(std::vector<LoadLink> links, std::size_t nodes);
  // The tree of the nodes connected to this root and not reached before, leaves first.
  std::vector<LoadStep> from(int root);
  bool reached(std::size_t node) const { return seen_[node] != 0; }
  // Links that are in no tree although both ends were reached.
  std::vector<int> closing() const;
  const std::vector<LoadLink>& links() const { return links_; }

 private:
  std::vector<LoadLink> links_;
  std::vector<std::vector<int>> links_at_;  // per node
  std::vector<char> seen_, used_;           // per node, per link
};

// The loops of such trees.
class LoadLoops {
 public:
  LoadLoops() = default;
  // `steps`: of all roots, each tree leaves first. `names`: new numbers of the links; empty: unchanged.
  LoadLoops(const LoadPaths& paths, const std::vector<LoadStep>& steps, std::size_t nodes,
            const std::vector<int>& names = {});

  bool any() const { return !loops_.empty(); }
  std::size_t size() const { return loops_.size(); }
  // L, one column per loop: links and their torques.
  const std::vector<std::vector<std::pair<int, double>>>& loops() const { return loops_; }
  // A link of a loop without any stiffness; −1: none.
  int undetermined() const { return undetermined_; }
  // Sets twists of links without load, which add up to the gaps of the loops.
  void lock_in(const std::vector<double>& twist);
  // Adds the distribution of least energy and the locked-in torques to the torques of the trees.
  void share(double* torque) const;

 private:
  void rename(const std::vector<int>& names);

  std::vector<std::vector<std::pair<int, double>>> loops_;
  std::vector<double> compliance_;  // per link
  std::vector<double> gape_;        // per loop [rad]; none: closed
  std::vector<double> inverse_;     // (Lᵀ C L)⁻¹, symmetric
  int undetermined_ = -1;
};

}  // namespace kurbel
