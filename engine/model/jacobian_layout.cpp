// jacobian_layout.cpp — the sparsity of the equations, registered by the elements.
#include <algorithm>
#include <map>
#include <numeric>

#include "engine/model/model.h"

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
  int own(int slot) const override {
    return static_cast<int>(model_.angle_count() + model_.twist_count() + model_.free_shafts) + slot;
  }
  int follower(int row, int shaft) override {
    followers.push_back({row, shaft, entry(-1, -1)});
    return followers.back().slot;
  }
  struct Follower {
    int row, shaft, slot;
  };
  std::vector<std::pair<int, int>> places;  // column, row
  std::vector<Follower> followers;

 private:
  const Model& model_;
};

// Groups of free shafts that slipping connections and relations join, each of two or more.
std::vector<std::vector<int>> coupled_shafts(const Model& model) {
  std::vector<int> group(model.free_shafts);
  std::iota(group.begin(), group.end(), 0);
  const auto is_free = [&](int s) { return static_cast<std::size_t>(s) < model.free_shafts; };
  const auto tie = [&](int a, int b) {
    if (!is_free(a) || !is_free(b)) return;
    const int from = group[static_cast<std::size_t>(b)], to = group[static_cast<std::size_t>(a)];
    std::replace(group.begin(), group.end(), from, to);
  };
  std::vector<char> touched(model.free_shafts, 0);
  const auto touch = [&](int s) {
    if (is_free(s)) touched[static_cast<std::size_t>(s)] = 1;
  };
  for (const ElasticJoint& e : model.elastic)
    if (e.slips) tie(e.shaft_a, e.shaft_b), touch(e.shaft_a), touch(e.shaft_b);
  for (const ShaftRelation& relation : model.relations)
    for (const ShaftGain& entry : relation.motion) {
      touch(entry.shaft);
      for (const ShaftGain& other : relation.motion) tie(entry.shaft, other.shaft);
    }
  std::map<int, std::vector<int>> members;
  for (std::size_t s = 0; s < model.free_shafts; ++s)
    if (touched[s]) members[group[s]].push_back(static_cast<int>(s));
  std::vector<std::vector<int>> groups;
  for (auto& [first, shafts] : members) groups.push_back(std::move(shafts));
  return groups;
}

// Kinematics: dφ/dt = gain ω, dθ/dt = gain_a ω_a − gain_b ω_b. Returns slots and their values.
std::vector<std::pair<std::size_t, double>> record_kinematics(const Model& model, Recorder& record) {
  std::vector<std::pair<std::size_t, double>> kinematic;
  const auto rate = [&](int row, int shaft, double gain) {
    kinematic.emplace_back(static_cast<std::size_t>(record.entry(row, record.speed(shaft))), gain);
  };
  for (std::size_t i = 0; i < model.angles.size(); ++i)
    rate(record.angle(static_cast<int>(i)), model.angles[i].shaft, model.angles[i].gain);
  for (std::size_t i = 0; i < model.elastic.size(); ++i) {
    rate(record.twist(static_cast<int>(i)), model.elastic[i].shaft_a, model.elastic[i].gain_a);
    rate(record.twist(static_cast<int>(i)), model.elastic[i].shaft_b, -model.elastic[i].gain_b);
  }
  return kinematic;
}

// Shafts that a locked clutch or a relation may tie together share all their columns. Returns each group's slots.
std::vector<std::vector<int>> record_coupled(const Model& model, Recorder& record, JacobianLayout& layout) {
  std::vector<std::vector<int>> coupled_slots;
  for (const std::vector<int>& shafts : coupled_shafts(model)) {
    JacobianLayout::Coupled group{shafts, {}, {}};
    for (const auto& [column, row] : record.places)
      if (column >= 0 &&
          std::any_of(shafts.begin(), shafts.end(), [&, row = row](int s) { return record.speed(s) == row; }))
        group.columns.push_back(column);
    for (const int s : shafts) group.columns.push_back(record.speed(s));
    std::sort(group.columns.begin(), group.columns.end());
    group.columns.erase(std::unique(group.columns.begin(), group.columns.end()), group.columns.end());
    std::vector<int>& slots = coupled_slots.emplace_back();
    for (const int column : group.columns)
      for (const int s : shafts) slots.push_back(record.entry(record.speed(s), column));
    layout.coupled.push_back(std::move(group));
  }
  return coupled_slots;
}

// Rows that follow a shaft's acceleration have all columns of its speed's row. Returns pairs of slots, per follower.
std::vector<std::vector<std::pair<std::size_t, std::size_t>>> record_followers(Recorder& record) {
  std::vector<std::vector<std::pair<std::size_t, std::size_t>>> followed;
  for (const Recorder::Follower& follower : record.followers) {
    auto& slots = followed.emplace_back();
    const int speed = record.speed(follower.shaft);
    if (speed < 0) continue;
    std::map<int, int> slot_of_column;
    for (std::size_t k = 0; k < record.places.size(); ++k)
      if (record.places[k].second == speed && record.places[k].first >= 0)
        slot_of_column.emplace(record.places[k].first, static_cast<int>(k));
    for (const auto& [column, slot] : slot_of_column)
      slots.emplace_back(static_cast<std::size_t>(slot), static_cast<std::size_t>(record.entry(follower.row, column)));
  }
  return followed;
}

// Sorts the recorded entries by columns; slots without a state go one past the end.
void sort_slots(const Model& model, const Recorder& record, JacobianLayout& layout) {
  const int states = static_cast<int>(model.state_count());
  std::vector<std::size_t> order(record.places.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::sort(order.begin(), order.end(),
            [&](std::size_t a, std::size_t b) { return record.places[a] < record.places[b]; });
  layout.pattern.size = model.state_count();
  layout.pattern.column_start.assign(model.state_count() + 1, 0);
  layout.slot_position.assign(record.places.size(), 0);
  std::pair<int, int> last{-1, -1};
  std::vector<std::size_t> stateless;
  const int first_speed = record.speed(0) < 0 ? states : record.speed(0);
  for (const std::size_t slot : order) {
    const auto [column, row] = record.places[slot];
    if (column < 0 || row < 0) {
      stateless.push_back(slot);
      continue;
    }
    if (std::pair(column, row) != last) {
      layout.pattern.row.push_back(row);
      const int shaft = row - first_speed;
      layout.row_shaft.push_back(shaft >= 0 && shaft < static_cast<int>(model.free_shafts) ? shaft : -1);
      ++layout.pattern.column_start[static_cast<std::size_t>(column) + 1];
      last = {column, row};
    }
    layout.slot_position[slot] = layout.pattern.row.size() - 1;
  }
  for (std::size_t c = 0; c < model.state_count(); ++c)
    layout.pattern.column_start[c + 1] += layout.pattern.column_start[c];
  for (const std::size_t slot : stateless) layout.slot_position[slot] = layout.pattern.row.size();
}

}  // namespace

JacobianLayout lay_out_jacobian(const Model& model) {
  Recorder record(model);
  for (const auto& pool : model.pools) pool->register_jacobian(record);
  JacobianLayout layout;
  const auto kinematic = record_kinematics(model, record);
  const auto coupled_slots = record_coupled(model, record, layout);
  const auto followed = record_followers(record);
  const int states = static_cast<int>(model.state_count());
  for (int i = 0; i < states; ++i) record.entry(i, i);  // KLU needs every diagonal entry, zeros too
  sort_slots(model, record, layout);
  for (const auto& [slot, value] : kinematic)
    if (layout.slot_position[slot] < layout.pattern.row.size())
      layout.constant.emplace_back(layout.slot_position[slot], value);
  for (std::size_t g = 0; g < layout.coupled.size(); ++g)
    for (const int slot : coupled_slots[g])
      layout.coupled[g].position.push_back(layout.slot_position[static_cast<std::size_t>(slot)]);
  for (std::size_t f = 0; f < followed.size(); ++f) {
    JacobianLayout::Follower follower{static_cast<std::size_t>(record.followers[f].slot), {}};
    for (const auto& [from, to] : followed[f])
      follower.entries.emplace_back(layout.slot_position[from], layout.slot_position[to]);
    layout.followers.push_back(std::move(follower));
  }
  return layout;
}

}  // namespace kurbel
