// jacobian_layout.cpp — the sparsity of the equations comes from the elements themselves.
#include <algorithm>
#include <numeric>

#include "engine/model.h"

namespace kurbel {
namespace {

class Recorder final : public JacobianPattern {
 public:
  explicit Recorder(const Model& model) : model_(model) {}
  int entry(int row, int column) override {
    places.push_back({column, row});
    return static_cast<int>(places.size()) - 1;
  }
  int angle(int tracked) const override { return tracked; }
  int twist(int connection) const override { return static_cast<int>(model_.angle_count()) + connection; }
  int speed(int shaft) const override {
    if (static_cast<std::size_t>(shaft) >= model_.free_shafts) return -1;
    return static_cast<int>(model_.angle_count() + model_.twist_count()) + shaft;
  }
  std::vector<std::pair<int, int>> places;  // column, row

 private:
  const Model& model_;
};

}  // namespace

JacobianLayout lay_out_jacobian(const Model& model) {
  Recorder record(model);
  for (const auto& pool : model.pools) pool->register_jacobian(record);
  // Kinematics: dφ/dt = gain ω, dθ/dt = gain_a ω_a − gain_b ω_b.
  std::vector<std::pair<std::size_t, double>> kinematic;  // slot, value
  const auto rate = [&](int row, int shaft, double gain) {
    kinematic.emplace_back(static_cast<std::size_t>(record.entry(row, record.speed(shaft))), gain);
  };
  for (std::size_t i = 0; i < model.angles.size(); ++i)
    rate(record.angle(static_cast<int>(i)), model.angles[i].shaft, model.angles[i].gain);
  for (std::size_t i = 0; i < model.elastic.size(); ++i) {
    rate(record.twist(static_cast<int>(i)), model.elastic[i].shaft_a, model.elastic[i].gain_a);
    rate(record.twist(static_cast<int>(i)), model.elastic[i].shaft_b, -model.elastic[i].gain_b);
  }
  const int states = static_cast<int>(model.state_count());
  for (int i = 0; i < states; ++i) record.entry(i, i);  // KLU needs every diagonal entry, zeros too

  std::vector<std::size_t> order(record.places.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::sort(order.begin(), order.end(),
            [&](std::size_t a, std::size_t b) { return record.places[a] < record.places[b]; });
  JacobianLayout layout;
  layout.pattern.size = model.state_count();
  layout.pattern.column_start.assign(model.state_count() + 1, 0);
  layout.slot_position.assign(record.places.size(), 0);
  std::pair<int, int> last{-1, -1};
  std::vector<std::size_t> stateless;
  const int first_speed = states - static_cast<int>(model.free_shafts);
  for (const std::size_t slot : order) {
    const auto [column, row] = record.places[slot];
    if (column < 0 || row < 0) {
      stateless.push_back(slot);
      continue;
    }
    if (std::pair(column, row) != last) {
      layout.pattern.row.push_back(row);
      layout.row_shaft.push_back(row >= first_speed ? row - first_speed : -1);
      ++layout.pattern.column_start[static_cast<std::size_t>(column) + 1];
      last = {column, row};
    }
    layout.slot_position[slot] = layout.pattern.row.size() - 1;
  }
  for (std::size_t c = 0; c < model.state_count(); ++c)
    layout.pattern.column_start[c + 1] += layout.pattern.column_start[c];
  for (const std::size_t slot : stateless) layout.slot_position[slot] = layout.pattern.row.size();
  for (const auto& [slot, value] : kinematic)
    if (layout.slot_position[slot] < layout.pattern.row.size())
      layout.constant.emplace_back(layout.slot_position[slot], value);
  return layout;
}

}  // namespace kurbel
