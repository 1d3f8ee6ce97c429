// gears_findings.cpp — words, tables and formulas of gear pairs.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "engine/numerics/angles.h"
#include "studies/findings/output.h"
#include "studies/gears/gears.h"
#include "studies/gears/gears_plots.h"

namespace kurbel {
namespace {

std::string length(double v) { return std::isfinite(v) ? fmt::format("{:.4f}", in_millimetres * v) : "—"; }
std::string angle(double v) { return fmt::format("{:.4f}", v / degree); }

const char* word_of(Finding finding) {
  constexpr const char* words[] = {"good", "note", "warning", "fault"};
  return words[static_cast<std::size_t>(finding)];
}

std::string shape_of(const GearPair& p) {
  return fmt::format("{} {} pair", p.internal() ? "internal" : "external", p.data.helix == 0 ? "spur" : "helical");
}

std::string summary_of(const GearStage& s) {
  const GearPair& p = s.pair;
  std::string text = fmt::format("{}: {} {}/{}, m_n = {:g} mm, ε_α = {:.4g}", s.name, shape_of(p), p.data.teeth[0],
                                 p.data.teeth[1], in_millimetres * p.data.module, p.contact_ratio);
  if (p.overlap_ratio > 0) text += fmt::format(", ε_β = {:.3f}", p.overlap_ratio);
  const Finding worst = worst_of(s);
  if (worst < Finding::warning) return text + ": valid geometry";
  int count = 0;
  std::string first;
  for (const GearVerdict& v : s.verdicts)
    if (v.finding == worst && ++count == 1) first = v.text;
  while (first.ends_with('.')) first.pop_back();
  return text + fmt::format(": {}{}", first,
                            count > 1 ? fmt::format(" (first of {} {}s in its verdicts)", count, word_of(worst)) : "");
}

std::string conclusion_of(const Gears& g) {
  std::string text;
  for (const GearStage& s : g.stages) text += (text.empty() ? "" : "; ") + summary_of(s);
  return text + "; strength is not judged.";
}

// --- tables ---

MeasuredQuantities<MeshedWheel> wheels_of(const GearStage& s) {
  using W = const MeshedWheel&;
  const GearPair& p = s.pair;
  const auto rounding = [&s](std::size_t i, const std::function<double(W)>& get) {
    return s.error_of([&](const GearPair& pair) { return get(pair.wheel[i]); });
  };
  const auto quadrature = [&s](std::size_t i, const std::function<double(W)>&) { return inertia_error(s, i); };
  MeasuredQuantities<MeshedWheel> q("Wheels", {"of the wheels", "symbol", "1", "2", "unit"}, p.wheel, rounding);
  q.quantity("teeth", "teeth", "z", "", &MeshedWheel::teeth)
      .quantity("shift", "profile shift", "x", "", &MeshedWheel::shift)
      .quantity("generating_shift", "generating shift", "x_E", "", &MeshedWheel::generating_shift)
      .quantity("least_shift", "least shift without undercut", "x_min", "", &MeshedWheel::least_shift_generated,
                ReadAs{.digits = 5})
      .only_for_programs("undercut", &MeshedWheel::undercut)
      .quantity("reference_diameter", "reference diameter", "d", "mm", &MeshedWheel::reference_diameter, length)
      .quantity("working_diameter", "working diameter", "d_w", "mm", &MeshedWheel::working_diameter, length)
      .quantity("base_diameter", "base diameter", "d_b", "mm", &MeshedWheel::base_diameter, length)
      .quantity("tip_diameter", "tip diameter", "d_a", "mm", &MeshedWheel::tip_diameter, length)
      .quantity(
          "", "greatest tip diameter without interference", "d_a,max", "mm",
          [](W w) { return w.internal() ? -w.greatest_tip_diameter : w.greatest_tip_diameter; }, length)
      .quantity("root_diameter", "root diameter", "d_f", "mm", &MeshedWheel::root_diameter, length)
      .quantity("form_diameter", "root form diameter", "d_Ff", "mm", &MeshedWheel::form_diameter, length)
      .quantity("active_diameter", "start of active profile", "d_Nf", "mm", &MeshedWheel::active_diameter, length)
      .quantity(
          "thickness_normal", "tooth thickness on the reference circle, normal", "s_n", "mm",
          [](W w) { return w.thickness_normal(w.reference_diameter); }, length)
      .quantity(
          "", "the same, transverse", "s_t", "mm", [](W w) { return w.thickness(w.reference_diameter); }, length)
      .quantity(
          "", "on the working circle", "s_wt", "mm", [](W w) { return w.thickness(w.working_diameter); }, length)
      .quantity("tip_thickness", "at the tip, normal", "s_an", "mm", &MeshedWheel::tip_thickness, length)
      .quantity("", "diameter where the tooth is pointed", "", "mm", &MeshedWheel::pointed_diameter, length)
      .quantity("tip_clearance", "tip clearance", "c", "mm", &MeshedWheel::tip_clearance, length);
  const bool wide = p.wheel[0].inertia > 0 || p.wheel[1].inertia > 0;
  if (!wide)
    return q.only_for_programs("width", &MeshedWheel::width).only_for_programs("inertia", &MeshedWheel::inertia);
  return q.quantity("width", "width", "b", "mm", &MeshedWheel::width, length)
      .quantity("", "bore, or outer diameter of the rim", "", "mm", &MeshedWheel::bore, length)
      .quantity_with(quadrature, "inertia", "moment of inertia", "J", "kg·m²", &MeshedWheel::inertia);
}

MeasuredQuantities<GearPair> mesh_of(const GearStage& s) {
  using P = const GearPair&;
  constexpr ReadAs five{.digits = 5}, stiffness{.factor = 1e-9, .digits = 5}, mrad{.factor = 1e3, .digits = 5};
  using Get = std::function<double(P)>;
  const auto by_backlash = [&s](std::size_t, const Get& get) { return backlash_error(s, get); };
  const auto by_method = [&s](std::size_t, const Get& get) { return stiffness_error(s.stiffness, get(s.pair)); };
  const auto by_distance = [&s](std::size_t, const Get& get) {
    return s.error_of(get, 2 * std::abs(s.pair.centre_distance) / s.pair.data.module);
  };
  MeasuredQuantities<GearPair> q("Mesh", {"of the mesh", "symbol", "value", "unit"}, std::span(&s.pair, 1),
                                 [&s](std::size_t, const Get& get) { return s.error_of(get); });
  q.quantity("ratio", "ratio", "u = z₂/z₁", "", &GearPair::ratio)
      .quantity(
          "", "pressure angle, normal", "α_n", "°", [](P p) { return p.data.rack.pressure_angle; }, angle)
      .quantity(
          "", "pressure angle, transverse", "α_t", "°", [](P p) { return p.wheel[0].transverse_angle; }, angle)
      .quantity("working_angle", "working pressure angle", "α_wt", "°", &GearPair::working_angle, angle);
  if (s.pair.data.helix != 0)
    q.quantity(
        "", "base helix angle", "β_b", "°", [](P p) { return p.wheel[0].base_helix; }, angle);
  q.quantity("reference_centre_distance", "reference centre distance", "a", "mm", &GearPair::reference_centre_distance,
             length)
      .quantity("centre_distance", "centre distance", "a_w", "mm", &GearPair::centre_distance, length)
      .quantity("shift_sum", "sum of shifts", "Σx", "", &GearPair::shift_sum)
      .quantity("", "sum of shifts that closes the backlash", "Σx(a_w)", "", &GearPair::mating_shift_sum)
      .quantity_with(by_distance, "tip_shortening", "tip shortening", "k", "m_n", &GearPair::tip_shortening, five)
      .quantity("base_pitch", "base pitch", "p_et", "mm", &GearPair::base_pitch, length)
      .quantity("contact_ratio", "contact ratio", "ε_α", "", &GearPair::contact_ratio)
      .quantity("overlap_ratio", "overlap ratio", "ε_β", "", &GearPair::overlap_ratio)
      .quantity("", "total contact ratio", "ε_γ", "", &GearPair::total_contact_ratio)
      .quantity_with(by_backlash, "backlash_normal", "backlash along the normal", "j_bn", "mm",
                     &GearPair::backlash_normal, length)
      .quantity_with(by_backlash, "", "backlash on the working circle", "j_wt", "mm", &GearPair::backlash_arc, length)
      .quantity_with(
          by_backlash, "", "backlash angle at wheel 1", "", "mrad", [](P p) { return p.backlash_angle(0); }, mrad)
      .quantity_with(
          by_backlash, "", "backlash angle at wheel 2", "", "mrad", [](P p) { return p.backlash_angle(1); }, mrad)
      .quantity_with(
          by_method, "", "stiffness of a pair of teeth per width", "c′", "N/(mm·µm)",
          [&](P) { return s.stiffness.single; }, stiffness)
      .quantity_with(
          by_method, "", "mesh stiffness per width", "c_γα", "N/(mm·µm)", [&](P) { return s.stiffness.mean; },
          stiffness);
  if (s.stiffness.torsional > 0)
    q.quantity_with(by_method, "", "torsional mesh stiffness about wheel 1", "k", "N·m/rad",
                    [&](P) { return s.stiffness.torsional; });
  q.quantity(
      "", "least teeth without undercut, x = 0", "z_min", "",
      [](P p) { return least_teeth(p.data.rack, p.data.helix); }, five);
  if (s.pair.internal())
    q.quantity("", "margin against tip fouling", "", "rad", tip_fouling_margin, ReadAs{.digits = 4})
        .quantity("", "margin of radial assembly", "", "rad", radial_assembly_margin, ReadAs{.digits = 4});
  if (s.speed)
    q.quantity("mesh_frequency", "gear-mesh frequency", "f_z", "Hz", [&](P p) { return p.mesh_frequency(*s.speed); });
  return q;
}

struct PathPoint {
  std::string name;
  double g = 0, sliding_over_omega = 0;
  std::array<double, 2> radius{}, curvature{}, specific_sliding{};
  double g_error = 0, sliding_error = 0, length_error = 0;  // the last: largest of what people get as a length
  std::array<double, 2> specific_sliding_error{};
};

PathPoint path_point(const GearStage& s, char name) {
  using P = const GearPair&;
  const GearPair& p = s.pair;
  const double g = p.point(name);
  PathPoint q;
  q.name = std::string(1, name), q.g = g, q.sliding_over_omega = p.sliding_speed(g, 1);
  q.radius = p.radius(g), q.curvature = p.curvature(g), q.specific_sliding = p.specific_sliding(g);
  q.g_error = s.error_of([name](P x) { return x.point(name); });
  q.sliding_error = s.error_of([name](P x) { return x.sliding_speed(x.point(name), 1); });
  std::vector<double> lengths = {q.g_error, q.sliding_error};
  for (const std::size_t i : {0UL, 1UL}) {
    lengths.push_back(2 * s.error_of([&](P x) { return x.radius(x.point(name))[i]; }));
    lengths.push_back(s.error_of([&](P x) { return x.curvature(x.point(name))[i]; }));
    q.specific_sliding_error[i] = s.error_of([&](P x) { return x.specific_sliding(x.point(name))[i]; }, 1);
  }
  q.length_error = largest_error(lengths);
  return q;
}

Rows path_table(const GearStage& s) {
  using P = const PathPoint&;
  std::vector<PathPoint> points;
  for (const char name : {'A', 'B', 'C', 'D', 'E'}) points.push_back(path_point(s, name));
  return table_of("path", "Along the path of contact", std::move(points))
      .column("point", "point", &PathPoint::name)
      .only_for_people("g [mm]", &PathPoint::g, length)
      .only_for_programs("g",
                         [](P p) {
                           return Estimate{p.g, p.g_error};
                         })
      .only_for_people(
          "d₁ [mm]", [](P p) { return 2 * p.radius[0]; }, length)
      .only_for_people(
          "d₂ [mm]", [](P p) { return 2 * p.radius[1]; }, length)
      .only_for_people(
          "ρ₁ [mm]", [](P p) { return p.curvature[0]; }, length)
      .only_for_people(
          "ρ₂ [mm]", [](P p) { return p.curvature[1]; }, length)
      .only_for_people(
          "± [mm]", [](P p) { return p.length_error; }, [](double e) { return error_text(in_millimetres * e); })
      .only_for_people(s.speed ? "v_g [m/s]" : "v_g/ω₁ [mm]",
                       [&](P p) {
                         return s.speed ? read_as(s.pair.sliding_speed(p.g, *s.speed), {.digits = 5})
                                        : length(p.sliding_over_omega);
                       })
      .only_for_programs("sliding_over_omega",
                         [](P p) {
                           return Estimate{p.sliding_over_omega, p.sliding_error};
                         })
      .only_for_programs("specific_sliding", &PathPoint::specific_sliding)
      .only_for_programs("specific_sliding_error", &PathPoint::specific_sliding_error)
      .only_for_people("ζ₁", [](P p) { return p.specific_sliding[0]; }, {.digits = 5})
      .only_for_people("ζ₂", [](P p) { return p.specific_sliding[1]; }, {.digits = 5})
      .only_for_people(
          "± ζ", [](P p) { return largest_error(p.specific_sliding_error); }, error_text);
}

// --- for programs and files ---

std::function<double(const GearPair&)> backlash_angle_of(int wheel) {
  return [wheel](const GearPair& p) { return p.backlash_angle(wheel); };
}

Record stage_record(const GearStage& s) {
  const GearPair& p = s.pair;
  Record r = {{"name", s.name}, {"module", p.data.module}, {"helix", p.data.helix}};
  const MeasuredQuantities<GearPair> mesh = mesh_of(s);
  r.insert(r.end(), mesh.records().front().begin(), mesh.records().front().end());
  const auto report = [&](const char* key, Value value) { r.push_back({key, std::move(value)}); };
  report("wheels", wheels_of(s).records());
  report("path", path_table(s).list());
  report("backlash_angle", std::array{p.backlash_angle(0), p.backlash_angle(1)});
  report("backlash_angle_error",
         std::array{backlash_error(s, backlash_angle_of(0)), backlash_error(s, backlash_angle_of(1))});
  const auto with_its_error = [&](double value) { return Estimate{value, stiffness_error(s.stiffness, value)}; };
  report("mesh_stiffness", Record{{"single", with_its_error(s.stiffness.single)},
                                  {"mean", with_its_error(s.stiffness.mean)},
                                  {"torsional", with_its_error(s.stiffness.torsional)},
                                  {"within_range_of_method", s.stiffness.within}});
  report("verdicts", each(s.verdicts, [](const GearVerdict& v) {
           return Record{{"finding", word_of(v.finding)}, {"text", v.text}};
         }));
  return r;
}

DataTable path_data(const GearPair& p) {
  return data_of(along_path(p))
      .in_file("g", "m", std::identity())
      .in_file("r1", "m", [&p](double g) { return p.radius(g)[0]; })
      .in_file("r2", "m", [&p](double g) { return p.radius(g)[1]; })
      .in_file("rho1", "m", [&p](double g) { return p.curvature(g)[0]; })
      .in_file("rho2", "m", [&p](double g) { return p.curvature(g)[1]; })
      .in_file("sliding/omega1", "m", [&p](double g) { return p.sliding_speed(g, 1); })
      .in_file(
          "zeta1", {}, [&p](double g) { return p.specific_sliding(g)[0]; }, 9)
      .in_file(
          "zeta2", {}, [&p](double g) { return p.specific_sliding(g)[1]; }, 9)
      .data();
}

DataTable outline_data(const GearWheel& w) {
  constexpr NumberFormat format{.digits = 7, .after_point = true};
  return {.columns = {{"x", "mm", format}, {"y", "mm", format}},
          .each_row = [&w](const std::function<void(DataRow)>& take) {
            for (const OutlinePoint& q : wheel_outline(w, 16))
              take(std::array<DataCell, 2>{in_millimetres * q.x, in_millimetres * q.y});
          }};
}

Formulas formulas_of(const GearStage& s) {
  Formulas list;
  const GearPair& p = s.pair;
  const double alpha_n = p.data.rack.pressure_angle;
  const MeshedWheel& one = p.wheel[0];
  list.add("Working pressure angle (theory 6.5)", "inv α_wt = inv α_t + 2 tan α_n Σx/(z₁ + z₂)",
           "inv α_wt = {:.8f} + 2 tan {:.4g}° · {:.6g}/({}) = {:.8f},   α_wt = {:.5f}°", involute(one.transverse_angle),
           alpha_n / degree, p.mating_shift_sum, p.data.teeth[0] + p.data.teeth[1], involute(p.working_angle),
           p.working_angle / degree);
  list.add("Centre distance (theory 6.6)", "a_w = ½ m_t (z₁ + z₂) cos α_t/cos α_wt",
           "a_w = ½ · {:.5f} · ({}) · {:.6f}/{:.6f} = {:.4f} mm", in_millimetres * one.transverse_module,
           p.data.teeth[0] + p.data.teeth[1], std::cos(one.transverse_angle), std::cos(p.working_angle),
           in_millimetres * p.centre_distance);
  list.add("Contact ratio (theory 6.9)", "ε_α = (g_E − g_A)/(π m_t cos α_t)",
           "ε_α = ({:.4f} − ({:.4f}))/{:.4f} = {:.4f}", in_millimetres * p.end, in_millimetres * p.start,
           in_millimetres * p.base_pitch, p.contact_ratio);
  list.add("Specific sliding at both ends (theory 6.11)", "ζ₁ = 1 − ρ₂/(u ρ₁),   ζ₂ = 1 − u ρ₁/ρ₂",
           "A: ζ₁ = {}, ζ₂ = {};   E: ζ₁ = {}, ζ₂ = {}", read_as(p.specific_sliding(p.start)[0], {.digits = 5}),
           read_as(p.specific_sliding(p.start)[1], {.digits = 5}), read_as(p.specific_sliding(p.end)[0], {.digits = 5}),
           read_as(p.specific_sliding(p.end)[1], {.digits = 5}));
  list.add("Undercut of wheel 1 (theory 6.4)",
           "x_min = h_Ff* − z sin² α_t/(2 cos β),   h_Ff* = h_f* − ρ_f* (1 − sin α_n)",
           "x_min = {:.5f} − {} · {:.6f}/(2 · {:.6f}) = {:.4f};   x_E = {:.4f}", p.data.rack.straight_depth(),
           one.teeth, std::pow(std::sin(one.transverse_angle), 2), std::cos(p.data.helix), one.least_shift_generated(),
           one.generating_shift);
  list.add("Mesh stiffness, ISO 6336-1 method B (theory 6.13)", "c_γα = c′ (0.75 ε_α + 0.25),   k = c_γα b r_b1²",
           "c_γα = {:.4g} · (0.75 · {:.4f} + 0.25) = {:.4g} N/(mm·µm){}", 1e-9 * s.stiffness.single, p.contact_ratio,
           1e-9 * s.stiffness.mean,
           s.stiffness.torsional > 0 ? fmt::format(",   k = {:.5g} N·m/rad about wheel 1", s.stiffness.torsional) : "")
      .note(fmt::format("An estimate: solid wheels, a load of at least 100 N per mm of width.{}",
                        s.stiffness.within ? "" : " Outside the range that the method was fitted for."));
  return list;
}

// --- all of it ---

double greatest_specific_sliding(const GearPair& p) {
  return std::min(p.specific_sliding(p.start)[0], p.specific_sliding(p.end)[1]);
}

void add_key_figures(Findings& f, const Gears& g) {
  for (const GearStage& s : g.stages) {
    const std::string prefix = g.stages.size() > 1 ? s.name + ": " : "";
    const auto add = [&](const char* name, double value, double error, const char* note, const char* means) {
      const bool known = std::isfinite(error);
      f.key(prefix + name, {value, known ? std::optional(error) : std::nullopt}, means, note, known ? 0 : 3);
    };
    const auto distance = [](const GearPair& p) { return std::abs(p.centre_distance); };
    add("centre distance", in_millimetres * distance(s.pair), in_millimetres * s.error_of(distance), "",
        "centre_distance");
    add("contact ratio ε_α", s.pair.contact_ratio, s.error_of(&GearPair::contact_ratio), "", "contact_ratio");
    add("greatest specific sliding", greatest_specific_sliding(s.pair), s.error_of(greatest_specific_sliding, 1),
        "at the foot of a flank", "specific_sliding");
    add("backlash at wheel 1", 1e3 * s.pair.backlash_angle(0), 1e3 * backlash_error(s, backlash_angle_of(0)), "",
        "backlash_angle");
    if (s.stiffness.torsional > 0)
      add("mesh stiffness about wheel 1", s.stiffness.torsional, stiffness_error(s.stiffness, s.stiffness.torsional),
          s.stiffness.within ? "ISO 6336-1 B, within 8 %" : "ISO 6336-1 B, outside of its range: error not known",
          "mesh_stiffness");
  }
}

void say_stage(Findings& f, const GearStage& s) {
  const Chapter in = f.chapter(s.name);
  std::vector<std::string> verdicts;
  for (const GearVerdict& v : s.verdicts) verdicts.push_back(fmt::format("{}: {}", word_of(v.finding), v.text));
  f.draw(in, [&s] { return Cards{drawing_of(s)}; });
  f.say(in, Sentences{.lines = verdicts, .title = "Verdicts", .terminal = false});
  f.draw(in, [&s] { return plots_of(s); });
  f.show(in, formulas_of(s));
  Rows wheels = wheels_of(s).rows();
  wheels.heading = fmt::format("{}: {}", s.name, shape_of(s.pair));
  f.say(in, std::move(wheels));
  f.say(in, mesh_of(s).rows());
  Rows path = path_table(s);
  path.key = "";
  f.say(in, std::move(path));
  f.say(in, Sentences{.lines = {"", "verdicts"}, .page = false});
  f.say(in, Sentences{.lines = verdicts, .indent = "  ", .page = false});
  f.tables.push_back({s.name + ".path", [&p = s.pair] { return path_data(p); }});
  for (const std::size_t i : {0UL, 1UL})
    f.tables.push_back({fmt::format("{}.wheel{}", s.name, i + 1), [&w = s.pair.wheel[i]] { return outline_data(w); }});
}

}  // namespace

Findings findings_of(const Gears& g) {
  Findings f = Findings::of(g, "Involute geometry after ISO 21771");
  f.page_title = g.scene_file.empty() ? g.title : fmt::format("{}: gear pairs", g.title);
  f.reports_complete = false, f.footer = report_footer();
  f.conclude(true, conclusion_of(g));
  for (const GearStage& s : g.stages)
    for (const GearVerdict& v : s.verdicts)
      if (v.finding >= Finding::warning)
        f.claim(claimed_aside(v.finding > Finding::warning ? Predicate::geometry_faulty : Predicate::geometry_doubtful,
                              v.text, s.name));
  add_key_figures(f, g);
  if (g.scene_file.empty()) f.record("scene", "");
  f.record("pairs", each(g.stages, stage_record));
  for (const GearStage& s : g.stages) say_stage(f, s);
  f.note(f.chapter("Notes"), g.notes);
  if (!g.scene_text.empty()) f.show_scene(g.scene_file, g.scene_text);
  return f;
}

}  // namespace kurbel
