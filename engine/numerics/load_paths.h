// load_paths.h — how torques pass from the nodes that need them through rigid links to a root, and how closed loops share
// them.
//
//     need = what a node takes from its links [N·m];   a link passes τ from a to b: a gives τ, b gets ratio τ
// In a tree statics alone says what every link passes. Where links close loops, any L c may be added, with a column of L
// for each closing link: τ there and what it makes the tree pass, so that no node feels it. Of all those the links take
// the one of least energy, Σ τ²/2k least (Castigliano):
//     (Lᵀ C L) c = −Lᵀ (C τ_tree − θ),   C = 1/k, 0 where a link has no stiffness; θ twists that were there before
// which is what elastic links come to the stiffer they are. A loop without any stiffness leaves its share open.
#pragma once

#include <cstddef>
#include <utility>
#include <vector>

namespace kurbel {

struct LoadLink {
  int a = 0, b = 0;       // nodes; ω_a = ratio ω_b; a link of a node with itself leads nowhere
  double ratio = 1;       // torque on b over torque of a
  double compliance = 0;  // 1/k [rad/(N·m)]; 0: nothing that twists
};

// One link of a tree, and which end of it lies towards the root.
struct LoadStep {
  int link = 0, child = 0, parent = 0;
  bool child_is_b = false;
  double ratio = 1;
};

// The child's need goes on to its parent.
inline void pass_on(const LoadStep& step, double* need, double* torque) {
  const double wanted = need[step.child];
  torque[step.link] = step.child_is_b ? wanted / step.ratio : -wanted;
  need[step.parent] += step.child_is_b ? wanted / step.ratio : step.ratio * wanted;
}

// Trees grown from roots; what closes a loop is left over.
class LoadPaths {
 public:
  LoadPaths(std::vector<LoadLink> links, std::size_t nodes);
  // What hangs on this root and was not reached before, leaves first.
  std::vector<LoadStep> from(int root);
  bool reached(std::size_t node) const { return seen_[node] != 0; }
  // Links of which no step was made, though both ends were reached.
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
  // `steps`: of all roots, each tree leaves first. Afterwards links have these names; none: their own.
  LoadLoops(const LoadPaths& paths, const std::vector<LoadStep>& steps, std::size_t nodes,
            const std::vector<int>& names = {});

  bool any() const { return !loops_.empty(); }
  std::size_t size() const { return loops_.size(); }
  // L, a column a loop: links and what they pass.
  const std::vector<std::vector<std::pair<int, double>>>& loops() const { return loops_; }
  // A link that lies in a loop none of whose links has a stiffness; −1: none.
  int undetermined() const { return undetermined_; }
  // Twists of links that were there before any load: the loops gape by what they add up to.
  void lock_in(const std::vector<double>& twist);
  // Adds the share of least energy to what trees pass, and what is locked in.
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
