// canvas.cpp — SVG written straight into one string.
#include "studies/sheet/canvas.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cmath>

#include "engine/scene/printable.h"
#include "engine/scene/text.h"
#include "studies/data/xml.h"

namespace kurbel {
namespace {

const char* class_of(Pen pen) {
  constexpr const char* names[] = {"grid",  "thin", "body", "path",   "dashed", "thick",
                                   "drive", "load", "main", "accent", "letter", "edge"};
  return names[static_cast<std::size_t>(pen)];
}

// Micrometres are finer than any printer.
std::string mm(double v) {
  std::string text = fmt::format("{:.3f}", std::abs(v) < 5e-4 ? 0.0 : v);
  text.erase(text.find_last_not_of('0') + 1);
  if (text.back() == '.') text.pop_back();
  return text;
}

// Letters and digits are of the index; powers, primes and signs are not.
std::size_t end_of_index(std::string_view text, std::size_t from) {
  constexpr std::string_view not_in_it[] = {"²", "′", "″", "⁻", "⁺"};
  while (from < text.size()) {
    const auto c = static_cast<unsigned char>(text[from]);
    const bool ends = std::any_of(std::begin(not_in_it), std::end(not_in_it),
                                  [&](std::string_view s) { return text.substr(from).starts_with(s); });
    if (ends || !(std::isalnum(c) || c >= 0x80)) break;
    ++from;
  }
  return from;
}

// Indices as spans that are lowered; what follows one is raised again.
std::string with_indices(std::string_view text) {
  std::string out, plain;
  bool lowered = false;
  const auto flush = [&] {
    if (plain.empty()) return;
    out += lowered ? fmt::format("<tspan dy=\"-.18em\">{}</tspan>", xml_text(plain)) : xml_text(plain);
    lowered = false;
    plain.clear();
  };
  for (std::size_t i = 0; i < text.size(); ++i) {
    if (text[i] != '_' || i + 1 == text.size()) {
      plain += text[i];
      continue;
    }
    flush();
    const std::size_t end = end_of_index(text, i + 1);
    out += fmt::format("<tspan dy=\"{}em\" font-size=\"72%\">{}</tspan>", lowered ? "0" : ".25",
                       xml_text(text.substr(i + 1, end - i - 1)));
    lowered = true;
    i = end - 1;
  }
  flush();
  return out;
}

}  // namespace

std::string xml_text(std::string_view text) { return escaped_xml(printable(text)); }

double width_of(std::string_view text, double size) { return 0.56 * size * static_cast<double>(characters(text)); }

void Canvas::line(Spot a, Spot b, Pen pen) {
  svg_ += fmt::format("<line class=\"{}\" x1=\"{}\" y1=\"{}\" x2=\"{}\" y2=\"{}\"/>\n", class_of(pen), mm(a.x), mm(a.y),
                      mm(b.x), mm(b.y));
}

void Canvas::curve(const std::vector<Spot>& spots, Pen pen, bool closed) {
  if (spots.size() < 2) return;
  svg_ += fmt::format("<path class=\"{}\" d=\"M", class_of(pen));
  for (const Spot& s : spots) svg_ += fmt::format("{} {} ", mm(s.x), mm(s.y));
  svg_.pop_back();
  svg_ += closed ? "Z\"/>\n" : "\"/>\n";
}

void Canvas::arrow(Spot from, Spot to, Pen pen) {
  line(from, to, pen);
  const double angle = std::atan2(to.y - from.y, to.x - from.x), length = 2.6, half = 0.16;
  const auto side = [&](double turn) {
    return Spot{to.x - length * std::cos(angle + turn), to.y - length * std::sin(angle + turn)};
  };
  const Spot a = side(half), b = side(-half);
  svg_ += fmt::format("<path class=\"head {}\" d=\"M{} {} {} {} {} {}Z\"/>\n", class_of(pen), mm(to.x), mm(to.y),
                      mm(a.x), mm(a.y), mm(b.x), mm(b.y));
}

void Canvas::box(const Box& b, Pen pen) {
  svg_ += fmt::format("<rect class=\"{}\" x=\"{}\" y=\"{}\" width=\"{}\" height=\"{}\"/>\n", class_of(pen), mm(b.x),
                      mm(b.y), mm(b.width), mm(b.height));
}

void Canvas::block(Spot c, double width, double height, double turned, Pen pen) {
  svg_ += fmt::format(
      "<rect class=\"paper {}\" x=\"{}\" y=\"{}\" width=\"{}\" height=\"{}\" transform=\"rotate({} {} {})\"/>\n",
      class_of(pen), mm(c.x - width / 2), mm(c.y - height / 2), mm(width), mm(height), mm(turned), mm(c.x), mm(c.y));
}

void Canvas::circle(Spot c, double radius, Pen pen, bool filled) {
  svg_ += fmt::format("<circle class=\"{} {}\" cx=\"{}\" cy=\"{}\" r=\"{}\"/>\n", filled ? "full" : "paper",
                      class_of(pen), mm(c.x), mm(c.y), mm(radius));
}

void Canvas::mark(Spot c, Pen pen, std::string_view attributes) {
  svg_ += fmt::format("<circle class=\"full {}\" cx=\"{}\" cy=\"{}\" r=\"0.6\" {}/>\n", class_of(pen), mm(c.x), mm(c.y),
                      attributes);
}

void Canvas::put_words(Spot at, const std::string& content, const Lettering& how, std::string_view attributes) {
  const std::string turned =
      how.turned == 0 ? "" : fmt::format(" transform=\"rotate({} {} {})\"", mm(how.turned), mm(at.x), mm(at.y));
  svg_ +=
      fmt::format("<text class=\"on-{}{}{}\" x=\"{}\" y=\"{}\" font-size=\"{}\" text-anchor=\"{}\"{}{}{}>{}</text>\n",
                  class_of(how.pen), how.bold ? " bold" : "", how.ground ? " ground" : "", mm(at.x), mm(at.y),
                  mm(how.size), how.at, turned, attributes.empty() ? "" : " ", attributes, content);
}

void Canvas::words(Spot at, std::string_view text, const Lettering& how, std::string_view attributes) {
  put_words(at, xml_text(text), how, attributes);
}

void Canvas::symbols(Spot at, std::string_view text, const Lettering& how) {
  put_words(at, with_indices(text), how, {});
}

void Canvas::begin_group(std::string_view attributes) { svg_ += fmt::format("<g {}>\n", attributes); }
void Canvas::end_group() { svg_ += "</g>\n"; }

void add_lines(Canvas& c, const Box& box, const std::string& text, double size) {
  std::vector<std::string> lines;
  std::string line, word;
  const auto end_word = [&] {
    if (!line.empty() && width_of(line + " " + word, size) > box.width) lines.push_back(line), line.clear();
    line += (line.empty() ? "" : " ") + word;
    word.clear();
  };
  for (const char ch : text + "\n") {
    if (ch != ' ' && ch != '\n') {
      word += ch;
      continue;
    }
    if (!word.empty()) end_word();
    if (ch == '\n' && !line.empty()) lines.push_back(line), line.clear();
  }
  const double step = std::min(1.4 * size, box.height / std::max<double>(1, static_cast<double>(lines.size())));
  for (std::size_t i = 0; i < lines.size(); ++i)
    c.symbols({box.x, box.y + step * static_cast<double>(i + 1) - 0.3 * step}, lines[i],
              {.size = std::min(size, step / 1.15)});
}

}  // namespace kurbel
