// linkage_drawing.cpp — links, pins, slides and paths of one mechanism; numbers where its pins stand.
#include "studies/sheet/linkage_drawing.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>

#include "engine/numerics/angles.h"

namespace kurbel {
namespace {

constexpr int path_points = 240;  // of a turn
constexpr double space_for_labels = 12, label_size = 2.7;

using Joints = std::vector<PlanePoint>;

class LinkageDrawer {
 public:
  LinkageDrawer(Canvas& canvas, const Box& box, const MechanismOnSheet& mechanism,
                const std::vector<SheetPosition>& positions, double sense)
      : c_(canvas),
        m_(mechanism),
        drawing_(mechanism.mechanism.data.drawing()),
        positions_(positions),
        sense_(sense * (mechanism.ratio < 0 ? -1 : 1)) {
    const double way = mechanism.mechanism.cycle();
    const int points = static_cast<int>(std::lround(path_points * way / turn));
    for (int i = 0; i <= points; ++i) path_.push_back(m_.joints(way * i / points));
    for (const SheetPosition& p : positions) at_.push_back(m_.joints(m_.crank_angle(p.phi)));
    choose_scale(box);
  }

  PlanPlaced draw() {
    draw_paths();
    for (const LinkageDrawing::Link& link : drawing_.links)
      if (link.shape == "slider") draw_guide(link);
    for (std::size_t k = 0; k < at_.size(); ++k) draw_links(at_[k], positions_[k].numbered ? Pen::thin : Pen::edge);
    const Joints& shown = at_[shown_position()];
    draw_links(shown, Pen::thick);
    for (const LinkageDrawing::Link& link : drawing_.links) draw_block(link, shown);
    for (const int joint : drawing_.fixed) draw_bearing(shown[index(joint)]);
    number_pins();
    name_joints(shown);
    draw_rotation(shown);
    return placed_;
  }

 private:
  static std::size_t index(int i) { return static_cast<std::size_t>(i); }
  bool is_fixed(std::size_t joint) const {
    return std::find(drawing_.fixed.begin(), drawing_.fixed.end(), static_cast<int>(joint)) != drawing_.fixed.end();
  }
  bool slides(std::size_t joint) const {
    return std::any_of(drawing_.links.begin(), drawing_.links.end(), [&](const LinkageDrawing::Link& link) {
      return link.shape == "slider" && link.joints[0] == static_cast<int>(joint);
    });
  }
  // One that shows all links apart: the third of twelve.
  std::size_t shown_position() const {
    const std::string label = std::to_string(
        std::count_if(positions_.begin(), positions_.end(), [](const SheetPosition& p) { return p.numbered; }) / 6);
    for (std::size_t k = 0; k < positions_.size(); ++k)
      if (positions_[k].label == label) return k;
    return 0;
  }

  void choose_scale(const Box& box) {
    placed_.direction = drawing_.direction;
    double left = HUGE_VAL, right = -HUGE_VAL, low = HUGE_VAL, high = -HUGE_VAL;
    const double c = std::cos(placed_.direction), s = std::sin(placed_.direction);
    for (const Joints& joints : path_)
      for (const PlanePoint& p : joints) {
        const double x = c * p.x - s * p.y, y = s * p.x + c * p.y;
        left = std::min(left, x), right = std::max(right, x), low = std::min(low, y), high = std::max(high, y);
      }
    const double room = std::min((box.width - 2 * space_for_labels) / (right - left),
                                 (box.height - 2 * space_for_labels) / std::max(high - low, 1e-9 * (right - left)));
    placed_.scale = scale_for("μ_l", "m", 1, room);
    const double mu = placed_.scale.per_mm;
    placed_.origin = {box.x + box.width / 2 - 0.5 * (left + right) / mu,
                      box.y + box.height / 2 + 0.5 * (low + high) / mu};
  }

  Spot spot(PlanePoint p) const { return placed_.spot(p); }

  void draw_paths() {
    for (std::size_t joint = 0; joint < path_.front().size(); ++joint) {
      if (is_fixed(joint)) continue;
      std::vector<Spot> spots;
      for (const Joints& joints : path_) spots.push_back(spot(joints[joint]));
      c_.curve(spots, Pen::path);
    }
    std::map<std::string, std::vector<Spot>> centres;
    const double way = m_.mechanism.cycle();
    for (std::size_t i = 0; i < path_.size(); ++i) {
      const double phi = (way * static_cast<double>(i) / static_cast<double>(path_.size() - 1) - m_.mechanism.phase);
      for (const JointMotion& p : motion_at(m_, phi / m_.ratio, 1, 0).centres) centres[p.name].push_back(spot(p.place));
    }
    for (const auto& [name, spots] : centres) {
      c_.curve(spots, Pen::path);
      c_.symbols({spots.front().x + 1, spots.front().y - 1}, name,
                 {.size = label_size, .pen = Pen::path, .ground = true});
    }
  }

  void draw_links(const Joints& joints, Pen pen) {
    for (const LinkageDrawing::Link& link : drawing_.links) {
      if (link.shape == "slider" || link.shape == "block" || link.shape == "point") continue;
      std::vector<Spot> spots;
      for (const int joint : link.joints) spots.push_back(spot(joints[index(joint)]));
      if (link.shape == "slot") extend(link, spots);
      c_.curve(spots, pen);
    }
    for (std::size_t k = 0; k < joints.size(); ++k)
      if (!is_fixed(k)) c_.circle(spot(joints[k]), pen == Pen::thick ? 1.1 : 0.5, pen == Pen::thick ? Pen::body : pen);
  }

  // A slotted lever goes on beyond the block, as far as the block ever is from its bearing.
  void extend(const LinkageDrawing::Link& slot, std::vector<Spot>& spots) const {
    const std::size_t bearing = index(slot.joints[0]), block = index(slot.joints[1]);
    double longest = 0;
    for (const Joints& j : path_)
      longest = std::max(longest, std::hypot(j[block].x - j[bearing].x, j[block].y - j[bearing].y));
    const double now = std::hypot(spots[1].x - spots[0].x, spots[1].y - spots[0].y),
                 factor = placed_.scale.mm(longest) / now;
    spots[1] = {spots[0].x + factor * (spots[1].x - spots[0].x), spots[0].y + factor * (spots[1].y - spots[0].y)};
  }

  void draw_guide(const LinkageDrawing::Link& link) {
    const std::size_t joint = index(link.joints[0]);
    PlanePoint least = path_.front()[joint], most = least;
    for (const Joints& joints : path_) {
      if (joints[joint].x < least.x) least = joints[joint];
      if (joints[joint].x > most.x) most = joints[joint];
    }
    const double more = 8 * placed_.scale.per_mm, half = 2.9 * placed_.scale.per_mm;
    for (const double side : {-half, half})
      c_.line(spot({least.x - more, least.y + side}), spot({most.x + more, most.y + side}), Pen::thin);
  }

  void draw_block(const LinkageDrawing::Link& link, const Joints& joints) {
    if (link.shape != "slider" && link.shape != "block") return;
    const Spot at = spot(joints[index(link.joints[0])]);
    double turned = -placed_.direction * 360 / turn;
    if (link.shape == "block") {
      const Spot next = spot(joints[index(link.joints[1])]);
      turned = std::atan2(next.y - at.y, next.x - at.x) * 360 / turn;
    }
    c_.block(at, link.shape == "slider" ? 10 : 7, link.shape == "slider" ? 5.8 : 4, turned, Pen::body);
    c_.circle(at, 1.1, Pen::body);
  }

  void draw_bearing(PlanePoint p) {
    const Spot at = spot(p);
    c_.curve({at, {at.x - 2.4, at.y + 4}, {at.x + 2.4, at.y + 4}}, Pen::body, true);
    c_.line({at.x - 3.6, at.y + 4}, {at.x + 3.6, at.y + 4}, Pen::body);
    for (double x = -3.2; x < 3.6; x += 1.4) c_.line({at.x + x, at.y + 4}, {at.x + x - 1, at.y + 5.2}, Pen::thin);
    c_.circle(at, 1.1, Pen::body);
  }

  // Crank pins outside of their circle, others on the left of their motion: to and fro on either side. Letters that
  // would stand on each other share a place.
  void number_pins() {
    const Spot centre = spot(at_.front()[0]);
    const auto put = [&](std::size_t joint, std::size_t k, const std::string& label) {
      const Spot at = spot(at_[k][joint]);
      const Spot away = joint == 1 ? Spot{at.x - centre.x, at.y - centre.y} : left_of_motion(k, joint);
      put_number(at, away, label, positions_[k].numbered, slides(joint) ? 4.9 : 3.4);
    };
    for (std::size_t joint = 1; joint < at_.front().size(); ++joint) {
      if (is_fixed(joint)) continue;
      for (std::size_t k = 0; k < positions_.size(); ++k)
        if (positions_[k].numbered) put(joint, k, positions_[k].label);
      for (const std::vector<std::size_t>& group : letters_close_at(joint)) {
        std::string label = positions_[group.front()].label;
        if (group.size() > 1) label += (group.size() > 2 ? "…" : ",") + positions_[group.back()].label;
        put(joint, group[group.size() / 2], label);
      }
    }
  }
  std::vector<std::vector<std::size_t>> letters_close_at(std::size_t joint) const {
    std::vector<std::vector<std::size_t>> groups;
    for (std::size_t k = 0; k < positions_.size(); ++k) {
      if (positions_[k].numbered) continue;
      const Spot here = spot(at_[k][joint]);
      const bool close = !groups.empty() && groups.back().back() + 1 == k && [&] {
        const Spot first = spot(at_[groups.back().front()][joint]);
        return std::hypot(first.x - here.x, first.y - here.y) < label_size;
      }();
      if (!close) groups.emplace_back();
      groups.back().push_back(k);
    }
    return groups;
  }
  Spot left_of_motion(std::size_t k, std::size_t joint) const {
    const double angle = m_.crank_angle(positions_[k].phi), step = 0.02 * sense_;
    const Spot before = spot(m_.joints(angle - step)[joint]), after = spot(m_.joints(angle + step)[joint]);
    const Spot here = spot(at_[k][joint]);
    const Spot along = {after.x - before.x, after.y - before.y};
    const Spot bent = {after.x + before.x - 2 * here.x, after.y + before.y - 2 * here.y};
    // At a dead centre: beyond the end.
    if (std::hypot(along.x, along.y) < 1.5 * std::hypot(bent.x, bent.y)) return {-bent.x, -bent.y};
    return {along.y, -along.x};
  }
  void put_number(Spot at, Spot away, const std::string& label, bool numbered, double distance) {
    const double length = std::hypot(away.x, away.y);
    if (!(length > 0)) away = {0, -1};
    const double unit = length > 0 ? 1 / length : 1;
    Spot place;
    for (int i = 0; i < 5; ++i) {
      const double far = distance + (numbered ? 0 : 1) + 2.6 * i;
      place = {at.x + far * unit * away.x, at.y + far * unit * away.y};
      if (std::none_of(taken_.begin(), taken_.end(),
                       [&](const Spot& t) { return std::hypot(t.x - place.x, t.y - place.y) < label_size; }))
        break;
    }
    taken_.push_back(place);
    c_.words({place.x, place.y + 0.35 * label_size}, label,
             {.size = label_size,
              .at = "middle",
              .bold = !numbered,
              .pen = numbered ? Pen::body : Pen::load,
              .ground = true});
  }

  // Beside a slider, where no number stands.
  Spot free_beside(Spot at) const {
    const std::array<Spot, 6> around = {{{6.5, 8}, {-6.5, 8}, {6.5, -6}, {-6.5, -6}, {11, 1}, {-11, 1}}};
    for (const Spot& by : around) {
      const Spot place = {at.x + by.x, at.y + by.y};
      if (std::none_of(taken_.begin(), taken_.end(),
                       [&](const Spot& t) { return std::hypot(t.x - place.x, t.y - place.y) < 4.5; }))
        return place;
    }
    return {at.x + around[0].x, at.y + around[0].y};
  }

  // Inside of the crank's circle, below a slider, else beside the joint.
  void name_joints(const Joints& joints) {
    const Spot centre = spot(joints[0]);
    for (std::size_t k = 0; k < joints.size(); ++k) {
      const Spot at = spot(joints[k]);
      Spot place = {at.x + 5.4, at.y + 5};
      if (k == 0) {
        const double angle = angle_on_paper(joints) + 1.9;
        place = {at.x + 4.6 * std::cos(angle), at.y + 4.6 * std::sin(angle) + 1.2};
      } else if (k == 1) {
        const double angle = std::atan2(centre.y - at.y, centre.x - at.x) - 0.7;
        place = {at.x + 4.6 * std::cos(angle), at.y + 4.6 * std::sin(angle) + 1.2};
      } else if (!is_fixed(k)) {
        place = slides(k) ? free_beside(at) : Spot{at.x + 3, at.y + 3.6};
      }
      c_.words(place, m_.letter(k), {.size = 3.6, .at = "middle", .bold = true, .ground = true});
    }
  }

  // Of the crank, clockwise from the paper's right.
  double angle_on_paper(const Joints& joints) const {
    const Spot o = spot(joints[0]), a = spot(joints[1]);
    return std::atan2(a.y - o.y, a.x - o.x);
  }
  void draw_rotation(const Joints& shown) {
    const Spot centre = spot(shown[0]);
    const double radius = std::clamp(0.6 * placed_.scale.mm(std::hypot(shown[1].x, shown[1].y)), 4.0, 9.0);
    const double middle = angle_on_paper(shown) - 1.9;
    const auto at = [&](double angle, double r) {
      return Spot{centre.x + r * std::cos(angle), centre.y + r * std::sin(angle)};
    };
    std::vector<Spot> arc;
    for (int i = 0; i <= 20; ++i) arc.push_back(at(middle - sense_ * 1.3 * (i / 20.0 - 0.5), radius));
    c_.curve(arc, Pen::accent);
    c_.arrow(arc[18], arc[20], Pen::accent);
    const Spot name = at(middle, radius + 2.6);
    c_.words({name.x, name.y + 1}, "ω", {.size = 3.4, .at = "middle", .pen = Pen::accent, .ground = true});
  }

  Canvas& c_;
  const MechanismOnSheet& m_;
  LinkageDrawing drawing_;
  const std::vector<SheetPosition>& positions_;
  double sense_;  // of the crank
  std::vector<Joints> path_, at_;
  std::vector<Spot> taken_;
  PlanPlaced placed_;
};

}  // namespace

Spot PlanPlaced::spot(PlanePoint p) const {
  const double c = std::cos(direction), s = std::sin(direction);
  return {origin.x + scale.mm(c * p.x - s * p.y), origin.y - scale.mm(s * p.x + c * p.y)};
}

PlanPlaced draw_linkage(Canvas& canvas, const Box& box, const MechanismOnSheet& mechanism,
                        const std::vector<SheetPosition>& positions, double sense) {
  return LinkageDrawer(canvas, box, mechanism, positions, sense).draw();
}

std::string lengths_in_words(const MechanismOnSheet& m, const Scale& scale) {
  const double ratio = 1e3 * scale.per_mm;
  std::string text = fmt::format("{} (M {})", scale.words(),
                                 ratio >= 1 ? fmt::format("1:{:g}", ratio) : fmt::format("{:g}:1", 1 / ratio));
  const std::vector<PlanePoint> joints = m.joints(m.crank_angle(1));
  for (const LinkageDrawing::Link& link : m.mechanism.data.drawing().links) {
    if (link.shape != "crank" && link.shape != "link") continue;
    const auto a = static_cast<std::size_t>(link.joints[0]), b = static_cast<std::size_t>(link.joints[1]);
    const double length = std::hypot(joints[a].x - joints[b].x, joints[a].y - joints[b].y);
    text +=
        fmt::format("; {}{} = {:.5g} mm, drawn {:.4g} mm", m.letter(a), m.letter(b), 1e3 * length, scale.mm(length));
  }
  return text;
}

}  // namespace kurbel
