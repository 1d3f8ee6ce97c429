// network.h — the machine before merging: every shaft end a node, every connection a joint, every element on its node.
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

// A speed that is given as a function of time.
struct PrescribedSpeed {
  std::vector<double> time, speed;                 // straight between the points; constant before and after [s, rad/s]
  Curve law = {};                                  // in their place: smooth, a formula, what repeats [s] → [rad/s]
  double amplitude = 0, frequency = 0, phase = 0;  // + amplitude sin(2π f t + phase) [rad/s, Hz, rad]
  // In place of all that: the command [rad/s] of this component, and its place among the commands once compiled.
  std::string follows = {};
  int command = -1;
  // The piece in force is a mode: within a step the law goes on smoothly beyond its end.
  int piece(double t) const;
  double value(double t, int piece) const;
  double slope(double t, int piece) const;  // dω/dt
  double next_edge(double t) const;
  bool is_nothing() const;
  double greatest() const;       // |ω| without the sine
  double settled_speed() const;  // that it comes to; the mean of what repeats
  double settled_from() const;   // [s]; −∞: from the first
  double period() const { return law.empty() ? 0 : law.period(); }
};

class Network {
 public:
  struct Node {
    std::string component, label;
    double inertia = 0;  // [kg·m²]
    int prescribed = -1;
  };
  // φ_a = ratio φ_b, plus the twist where the joint is elastic.
  struct Joint {
    int a = 0, b = 0;
    double ratio = 1;
    std::string component;
    ConnectionForm element = nullptr;  // null: always rigid
    bool elastic = false;              // by the effects that are on
    std::string label = {};            // tells several joints of a component apart
    bool told = false;                 // rigid always, and its torque is a result
    int chain = -1;                    // of which it is a part
  };
  // A shaft that is cut into parts: joints in a row, in the network one after the other.
  struct Chain {
    std::string component;
    std::vector<int> nodes;             // from its one end to the other
    double stiffness = 0, inertia = 0;  // of the whole, where it is one spectral element [N·m/rad, kg·m²]
    int degree = 0;                     // of that element; 0: equal springs
    double wave_rate() const;           // ω at x = β L = 1: √(k/J) [rad/s]
  };
  struct ShaftElement {
    int node = 0;
    std::string component;
    ShaftForm element;
    Window window;
    double phase = 0;
    int account = -1;  // of the work it does, once compiled
  };
  // A relation between the speeds of two or three shafts that holds at run time: ω₀ + gain₁ ω₁ + gain₂ ω₂ = 0.
  // Planetary gear, differential, gear in a housing that moves, gear with losses. The torque λ that it takes from
  // node 0 comes out at the others, −gain λ.
  struct Relation {
    std::array<int, 3> node{-1, -1, -1};
    std::array<double, 3> gain{1, 0, 0};
    std::array<double, 3> usual{1, 1, 0};  // speeds in the usual motion of the machine; they obey the relation
    std::string component;
    bool lossy = false;
    GearLoss loss = {};
    std::string words = {};         // for people: its law of losses
    std::size_t joints_before = 0;  // its place among the joints, where it becomes one
    int members() const { return node[2] >= 0 ? 3 : 2; }
  };
  // Where a characteristic is given over a quantity; what a motion takes from elsewhere is no datum of the scene, unless
  // that says how it goes on.
  struct DataRange {
    enum class Over { time, speed, size_of_speed, ratio_of_speeds, channel };
    std::string component, of;  // "torque", in the scene's words
    Over over = Over::speed;
    int node = 0;              // whose speed
    int other = -1;            // of a ratio, which is the slower speed over the faster: between these
    int part = -1;             // of the component that may be switched by itself, a mechanism's load; −1: all of it
    std::string channel = {};  // or a channel: offset + sign · its value
    double sign = 1, offset = 0, low = 0, high = 0;  // in SI
    std::string unit = {};                           // SI, of these
    Beyond below = Beyond::unsaid, above = Beyond::unsaid;
    bool line_below = false, line_above = false;  // its slope goes on there; else its value holds
    Location at = {};                             // of its table in the scene
  };
  // Of a curve without a period; nothing where it says how it goes on at both ends.
  // Mirrored: points of positive quantities count for both signs.
  void limit(DataRange range, const Curve& curve, bool mirrored = false);

  struct Ports {
    int in = -1, out = -1;
    std::map<std::string, int> others = {};  // further shafts, by name
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

  // Of the twist of a shaft that is cut into parts, where all carry the same torque at rest; of any other joint 1.
  double share_of_twist(const Joint& joint) const;
  // Empty where no scene names it.
  std::string kind_of(const std::string& component) const;

  std::vector<Node> nodes;
  std::vector<Joint> joints;
  std::vector<Relation> relations;
  std::vector<Chain> chains;
  std::vector<ShaftElement> elements;
  std::vector<PrescribedSpeed> prescribed;
  std::vector<DataRange> ranges;
  std::map<std::string, Ports> ports;        // of each component
  std::map<std::string, std::string> kinds;  // as the scene names them: "clutch"
  std::vector<std::string> components;       // canonical order
  ComponentData data;                        // what they state beside their part in the equations
};

}  // namespace kurbel
