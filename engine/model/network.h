// network.h — the machine before merging: shaft ends as nodes, connections as joints, elements on their nodes.
#pragma once

#include <array>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "engine/elements/any_connection.h"
#include "engine/elements/any_shaft_element.h"
#include "engine/elements/gear_loss.h"
#include "engine/model/component_data.h"
#include "engine/numerics/curve.h"
#include "engine/scene/messages.h"

namespace kurbel {

// A speed prescribed as a function of time.
struct PrescribedSpeed {
  std::vector<double> time, speed;                 // linear between the points; constant before and after [s, rad/s]
  Curve law = {};                                  // instead of points: smooth, formula, periodic [s] → [rad/s]
  double amplitude = 0, frequency = 0, phase = 0;  // + amplitude sin(2π f t + phase) [rad/s, Hz, rad]
  // Instead of all these: the command [rad/s] of this component, and its index after compilation.
  std::string follows = {};
  int command = -1;
  // The active piece is a mode: within a step the law is continued smoothly beyond its end.
  int piece(double t) const;
  double value(double t, int piece) const;
  double slope(double t, int piece) const;  // dω/dt
  double next_edge(double t) const;
  bool is_nothing() const;
  double greatest() const;       // |ω| without the sine
  double settled_speed() const;  // final speed; the mean if periodic
  double settled_from() const;   // time from which it is constant [s]; −∞: always
  double period() const { return law.empty() ? 0 : law.period(); }
};

class Network {
 public:
  struct Node {
    std::string component, label;
    double inertia = 0;  // [kg·m²]
    int prescribed = -1;
  };
  // φ_a = ratio φ_b, plus the twist if the joint is elastic.
  struct Joint {
    int a = 0, b = 0;
    double ratio = 1;
    std::string component;
    ConnectionForm element = nullptr;  // null: always rigid
    bool elastic = false;              // by the present effects
    std::string label = {};            // distinguishes several joints of a component
    bool reported = false;             // always rigid, with its torque as a result
    int chain = -1;                    // index of its chain; −1: none
  };
  // A discretised shaft: joints in a row, consecutive in the network.
  struct Chain {
    std::string component;
    std::vector<int> nodes;             // from one end to the other
    double stiffness = 0, inertia = 0;  // of the whole, if it is a spectral element [N·m/rad, kg·m²]
    int degree = 0;                     // of the element; 0: equal springs
    double wave_rate() const;           // ω at x = β L = 1: √(k/J) [rad/s]
  };
  struct ShaftElement {
    int node = 0;
    std::string component;
    ShaftForm element;
    Window window;
    double phase = 0;
    int account = -1;  // of its work, after compilation
  };
  // A relation between the speeds of two or three shafts, solved at run time: ω₀ + gain₁ ω₁ + gain₂ ω₂ = 0.
  // Planetary gear, differential, gear in a movable housing, gear with losses. It takes the torque λ from node 0 and gives
  // −gain λ to the others.
  struct Relation {
    std::array<int, 3> node{-1, -1, -1};
    std::array<double, 3> gain{1, 0, 0};
    std::array<double, 3> usual{1, 1, 0};  // speeds in the usual motion of the machine; they satisfy the relation
    std::string component;
    bool lossy = false;
    GearLoss loss = {};
    std::string words = {};         // for reports: its law of losses
    std::size_t joints_before = 0;  // its index among the joints, if it becomes one
    int members() const { return node[2] >= 0 ? 3 : 2; }
  };
  // Range of the data of a characteristic; values outside it are not data of the scene, unless the scene defines the
  // continuation.
  struct DataRange {
    enum class Over { time, speed, size_of_speed, ratio_of_speeds, channel };
    std::string component, of;  // "torque", as named in the scene
    Over over = Over::speed;
    int node = 0;              // node of the speed
    int other = -1;            // second node of a ratio, which is the slower speed over the faster one
    int part = -1;             // part of the component that is switched separately, such as a load; −1: all of it
    std::string channel = {};  // or a channel: offset + sign · its value
    double sign = 1, offset = 0, low = 0, high = 0;  // in SI
    std::string unit = {};                           // SI, of these
    Beyond below = Beyond::unspecified, above = Beyond::unspecified;
    bool line_below = false, line_above = false;  // continued by its slope; else constant
    Location at = {};                             // of its table in the scene
  };
  // Adds the range of a curve without period; not if its continuation is defined at both ends.
  // mirrored: points for positive quantities apply to both signs.
  void limit(DataRange range, const Curve& curve, bool mirrored = false);

  struct Ports {
    int in = -1, out = -1;
    std::map<std::string, int> others = {};  // additional shafts by name
  };

  int add_node(const std::string& component, const std::string& label, double inertia);
  void join(int a, int b, double ratio, const std::string& component);
  void relate(Relation relation) {
    relation.joints_before = joints.size();
    relations.push_back(std::move(relation));
  }
  template <class E>
  void connect(int a, int b, double ratio, const std::string& component, E element, const std::string& label = {}) {
    joints.push_back({a, b, ratio, component, connection_form(std::move(element)), false, label});
  }
  template <class E>
  void put(int node, const std::string& component, E element, Window window = {}) {
    put(node, component, shaft_form(std::move(element)), window, 0);
  }
  void put(int node, const std::string& component, ShaftForm element, Window window, double phase);
  void prescribe(int node, PrescribedSpeed speed);

  // Share of a part in the twist of a discretised shaft with the same torque in all parts; 1 for other joints.
  double share_of_twist(const Joint& joint) const;
  // Empty if no scene gives it.
  std::string kind_of(const std::string& component) const;

  std::vector<Node> nodes;
  std::vector<Joint> joints;
  std::vector<Relation> relations;
  std::vector<Chain> chains;
  std::vector<ShaftElement> elements;
  std::vector<PrescribedSpeed> prescribed;
  std::vector<DataRange> ranges;
  std::map<std::string, Ports> ports;        // of each component
  std::map<std::string, std::string> kinds;  // names in the scene: "clutch"
  std::vector<std::string> components;       // canonical order
  ComponentData data;                        // data of components that are not in the equations
};

}  // namespace kurbel
