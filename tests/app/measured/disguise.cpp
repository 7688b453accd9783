// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/tests/app/measured/disguise.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "treadmark/backends/analytic/sample.hpp"
#include "treadmark/core/random.hpp"
#include "treadmark/model/surface_spec.hpp"

namespace treadmark::testing {
namespace {

using Points = std::vector<Vec2>;
constexpr double kRadius_mm = 460.0;

Points standard(const char* name) {
  const Profile profile = analytic::sample_profile(StandardProfile{name}, 0.02e-3);
  Points points;
  for (std::size_t i = 0; i < profile.y.size(); ++i) points.emplace_back(1e3 * profile.y[i], 1e3 * profile.z[i]);
  if (points.front().x() > points.back().x()) std::reverse(points.begin(), points.end());
  return points;
}

double eased(double t) {
  t = std::clamp(t, 0.0, 1.0);
  return t * t * (3.0 - 2.0 * t);
}

double hollow(double depth, double middle, double half, double y) {
  const double from = std::fabs(y - middle) / half;
  return from < 1.0 ? -0.5 * depth * (1.0 + std::cos(std::numbers::pi * from)) : 0.0;
}

template <class Change>
Points changed(Points points, const Change& change) {
  for (Vec2& p : points) p += change(p);
  return points;
}

template <class Keep>
Points kept(Points points, const Keep& keep) {
  std::erase_if(points, [&](const Vec2& p) { return !keep(p); });
  return points;
}

Points hollow_wheel(double depth) {
  return changed(standard("S1002"), [&](const Vec2& p) { return Vec2(0.0, hollow(depth, 10.0, 35.0, p.x())); });
}

/// The side wears away sideways, all of it from 12 mm below the top on.
Points side_worn(double wear) {
  return changed(standard("60E1"),
                 [&](const Vec2& p) { return Vec2(p.x() < 0.0 ? wear * eased((p.y() - 1.0) / 11.0) : 0.0, 0.0); });
}

Points cut_rail(double depth) {
  return kept(standard("60E1"), [&](const Vec2& p) { return p.y() <= depth; });
}

Points joined(Points points, const std::vector<Vec2>& corners) {
  for (const Vec2& to : corners) {
    const Vec2 from = points.back();
    const int count = std::max(1, static_cast<int>((to - from).norm() / 0.02));
    for (int k = 1; k <= count; ++k) points.push_back(from + (to - from) * k / count);
  }
  return points;
}

Points mirrored(Points points) {
  std::reverse(points.begin(), points.end());
  for (Vec2& p : points) p.x() = -p.x();
  return points;
}

/// Web and foot in straight lines below the head.
Points whole_outline() {
  const Points head = standard("60E1");
  const double y = head.back().x(), z = head.back().y();
  const std::vector<Vec2> half{{y - 1.5, z + 2.0}, {9.0, 52.0},   {8.25, 80.0},  {8.25, 112.0},
                               {12.0, 140.0},      {72.0, 160.5}, {75.0, 164.0}, {75.0, 172.0}};
  std::vector<Vec2> corners = half;
  for (auto p = half.rbegin(); p != half.rend(); ++p) corners.emplace_back(-p->x(), p->y());
  return joined(head, corners);
}

/// A head with a groove of 50 mm beside its gauge side, and a keeper beside that.
Points grooved() {
  const Points head = standard("60E1");
  const double y = -head.front().x(), wall = y + 50.0;
  return mirrored(
      joined(head, {{y, 45.0}, {wall, 45.0}, {wall, 11.0}, {wall + 1.2, 8.2}, {wall + 4.0, 7.0}, {wall + 22.0, 7.0}}));
}

Points with_long_back() {
  Points points = joined({{-70.0, -25.0}}, {standard("S1002").front()});
  for (const Vec2& p : standard("S1002")) points.push_back(p);
  return points;
}

using Seen = std::vector<BaseShape>;

Points resampled(const Points& points, double step) {
  std::vector<double> s{0.0};
  for (std::size_t i = 1; i < points.size(); ++i) s.push_back(s.back() + (points[i] - points[i - 1]).norm());
  const auto count = static_cast<std::size_t>(std::max(2.0, std::round(s.back() / step)));
  Points out;
  for (std::size_t k = 0, i = 0; k <= count; ++k) {
    const double at = s.back() * static_cast<double>(k) / static_cast<double>(count);
    while (i + 2 < points.size() && s[i + 1] < at) ++i;
    const double length = s[i + 1] - s[i];
    out.push_back(points[i] + (length > 0.0 ? (at - s[i]) / length : 0.0) * (points[i + 1] - points[i]));
  }
  return out;
}

double normal(Random& random) {
  const double u = 1.0 - random.uniform(), v = random.uniform();
  return std::sqrt(-2.0 * std::log(u)) * std::cos(2.0 * std::numbers::pi * v);
}

Points measured(const BaseShape& base, const Disguise& how, Random& random) {
  Points points =
      resampled(kept(base.points(), [&](const Vec2& p) { return p.x() >= how.low && p.x() <= how.high; }), how.step);
  for (Vec2& p : points) p += how.noise * Vec2(0.2 * normal(random), normal(random));
  if (how.spike != 0.0) points[points.size() / 2].y() += how.spike;
  const double c = std::cos(how.tilt_deg * std::numbers::pi / 180.0),
               s = std::sin(how.tilt_deg * std::numbers::pi / 180.0);
  for (Vec2& p : points) {
    p = Vec2(c * p.x() - s * p.y() + how.shift_y, s * p.x() + c * p.y() + how.shift_z);
    if (how.mirrored != (how.reader == Disguise::Reader::gensys)) p.x() = -p.x();
    if (how.up) p.y() = -p.y();
    p = (p / how.rounded).array().round().matrix() * how.rounded / how.in_mm;
  }
  if (how.order == Disguise::Order::backwards) std::reverse(points.begin(), points.end());
  if (how.order != Disguise::Order::doubled) return points;
  Points twice;
  for (const Vec2& p : points) twice.insert(twice.end(), {p, p});
  return twice;
}

std::string number(double value, const Disguise& how) {
  const int digits = how.in_mm > 100.0 ? 9 : how.in_mm > 1.0 ? 7 : how.in_mm < 1.0 ? 3 : 6;
  std::string text = fmt::format("{:.{}f}", std::fabs(value), digits);
  if (how.decimal_comma) std::replace(text.begin(), text.end(), '.', ',');
  if (value >= 0.0) return text;
  return how.in_brackets ? "(" + text + ")" : how.minus + text;
}

std::string encoded(const std::string& text, Disguise::Encoding encoding) {
  if (encoding == Disguise::Encoding::with_mark) return "\xEF\xBB\xBF" + text;
  if (encoding == Disguise::Encoding::latin1)
    return "# gepr\xFC"
           "ft\n" +
           text;
  if (encoding == Disguise::Encoding::utf8) return text;
  std::string out = "\xFF\xFE";
  for (std::size_t i = 0; i < text.size(); ++i) {
    auto code = static_cast<unsigned>(static_cast<unsigned char>(text[i]));
    if (code >= 0xE0) {  // three bytes: all that stands here beyond ASCII
      code = ((code & 0xFU) << 12U) | ((static_cast<unsigned char>(text[i + 1]) & 0x3FU) << 6U) |
             (static_cast<unsigned char>(text[i + 2]) & 0x3FU);
      i += 2;
    }
    out += static_cast<char>(code & 0xFFU);
    out += static_cast<char>(code >> 8U);
  }
  return out;
}

void replace_all(std::string& text, const std::string& from, const std::string& to) {
  for (std::size_t at = text.find(from); at != std::string::npos; at = text.find(from, at + to.size()))
    text.replace(at, from.size(), to);
}

std::string column_text(const Points& points, const Disguise& how, Random& random) {
  std::string text;
  if (!how.header.empty()) {
    std::string header = how.header;
    if (how.unit_said)
      header = fmt::format("{0} [{2}]{3}{1} [{2}]", header.substr(0, header.find(' ')),
                           header.substr(header.find(' ') + 1), how.unit, how.delimiter);
    else
      replace_all(header, " ", how.delimiter);
    text += header + "\n";
  } else if (how.unit_said) {
    text += "# unit: " + how.unit + "\n";
  }
  if (!how.count.empty()) {
    std::string count = how.count;
    replace_all(count, "%n", std::to_string(points.size()));
    text += count + "\n";
  }
  std::vector<bool> is_nothing(points.size(), false);
  for (std::size_t k = 0; !how.nothing.empty() && k < 4; ++k)
    is_nothing[how.at_the_ends ? (k < 2 ? k : points.size() - 1 - (k - 2)) : random.bits() % points.size()] = true;
  for (std::size_t i = 0; i < points.size(); ++i)
    text +=
        number(points[i].x(), how) + how.delimiter + (is_nothing[i] ? how.nothing : number(points[i].y(), how)) + "\n";
  return text;
}

// --- trials

using Set = std::function<void(Disguise&, Random&)>;
struct Value {
  const char* name;
  Set set;
};

/// What can be done to a section; one value of a row at a time.
const std::vector<std::vector<Value>>& choices() {
  using D = Disguise;
  static const std::vector<std::vector<Value>> rows{
      {{"m", [](D& d, Random&) { d.in_mm = 1e3, d.unit = "m"; }},
       {"um", [](D& d, Random&) { d.in_mm = 1e-3, d.unit = "um"; }},
       {"inch", [](D& d, Random&) { d.in_mm = 25.4, d.unit = "inch"; }},
       {"m, said", [](D& d, Random&) { d.in_mm = 1e3, d.unit = "m", d.unit_said = true; }},
       {"um, said", [](D& d, Random&) { d.in_mm = 1e-3, d.unit = "um", d.unit_said = true; }},
       {"inch, said", [](D& d, Random&) { d.in_mm = 25.4, d.unit = "inch", d.unit_said = true; }}},
      {{"backwards", [](D& d, Random&) { d.order = D::Order::backwards; }},
       {"doubled", [](D& d, Random&) { d.order = D::Order::doubled; }}},
      {{"mirrored", [](D& d, Random&) { d.mirrored = true; }}},
      {{"z up", [](D& d, Random&) { d.up = true; }}},
      {{"y z", [](D& d, Random&) { d.header = "y z"; }},
       {"x z", [](D& d, Random&) { d.header = "x z"; }},
       {"lateral", [](D& d, Random&) { d.header = "lateral vertical"; }}},
      {{"count", [](D& d, Random&) { d.count = "%n"; }}, {"counts", [](D& d, Random&) { d.count = "%n 2"; }}},
      {{"comma", [](D& d, Random&) { d.delimiter = ","; }},
       {"semicolon", [](D& d, Random&) { d.delimiter = ";"; }},
       {"tab", [](D& d, Random&) { d.delimiter = "\t"; }},
       {"decimal comma", [](D& d, Random&) { d.delimiter = ";", d.decimal_comma = true; }}},
      {{"U+2212", [](D& d, Random&) { d.minus = "\xE2\x88\x92"; }},
       {"brackets", [](D& d, Random&) { d.in_brackets = true; }}},
      {{"BOM", [](D& d, Random&) { d.encoding = D::Encoding::with_mark; }},
       {"UTF-16", [](D& d, Random&) { d.encoding = D::Encoding::utf16; }},
       {"Latin 1", [](D& d, Random&) { d.encoding = D::Encoding::latin1; }}},
      {{"CR LF", [](D& d, Random&) { d.line_end = "\r\n"; }}},
      {{"0.05 mm", [](D& d, Random&) { d.step = 0.05; }},
       {"0.5 mm", [](D& d, Random&) { d.step = 0.5; }},
       {"1 mm", [](D& d, Random&) { d.step = 1.0; }}},
      {{"from the back", [](D& d, Random&) { d.shift_y = 70.0; }},
       {"from the middle of the axle", [](D& d, Random&) { d.shift_y = 750.0; }},
       {"anywhere",
        [](D& d, Random& r) { d.shift_y = 400.0 * r.uniform() - 200.0, d.shift_z = 60.0 * r.uniform() - 30.0; }},
       {"from the axle", [](D& d, Random&) { d.shift_z = kRadius_mm; }}},
      {{"tilted a little", [](D& d, Random& r) { d.tilt_deg = 6.0 * r.uniform() - 3.0; }},
       {"tilted", [](D& d, Random& r) { d.tilt_deg = (r.uniform() < 0.5 ? -1.0 : 1.0) * (4.0 + 6.0 * r.uniform()); }}},
      {{"without the back", [](D& d, Random&) { d.low = -62.0; }},
       {"without the field side", [](D& d, Random&) { d.high = 28.0; }}},
      {{"noise of 1 um", [](D& d, Random&) { d.noise = 1e-3; }},
       {"noise of 3 um", [](D& d, Random&) { d.noise = 3e-3; }},
       {"noise of 10 um", [](D& d, Random&) { d.noise = 10e-3; }},
       {"noise of 30 um", [](D& d, Random&) { d.noise = 30e-3; }}},
      {{"rounded to 1 um", [](D& d, Random&) { d.rounded = 1e-3; }},
       {"rounded to 10 um", [](D& d, Random&) { d.rounded = 10e-3; }},
       {"rounded to 50 um", [](D& d, Random&) { d.rounded = 50e-3; }}},
      {{"spike of 2 mm", [](D& d, Random&) { d.spike = 2.0; }},
       {"spike of 0.5 mm", [](D& d, Random&) { d.spike = 0.5; }}},
      {{"-9999", [](D& d, Random&) { d.nothing = "-9999"; }},
       {"NaN", [](D& d, Random&) { d.nothing = "NaN"; }},
       {"N/A", [](D& d, Random&) { d.nothing = "N/A"; }},
       {"-99.999", [](D& d, Random&) { d.nothing = "-99.999"; }},
       {"-524288", [](D& d, Random&) { d.nothing = "-524288"; }},
       {"NaN at the ends", [](D& d, Random&) { d.nothing = "NaN", d.at_the_ends = true; }}},
  };
  return rows;
}

/// Leaves out what the format of the reader has no place for.
void settle(Disguise& d) {
  using Reader = Disguise::Reader;
  if (d.reader == Reader::columns) {
    if (d.decimal_comma && d.nothing == "-99.999") d.nothing = "-99,999";
    if (d.count.size() > 2) replace_all(d.count, " ", d.delimiter);
    return;
  }
  d.header.clear(), d.count.clear(), d.nothing.clear();
  d.delimiter = " ", d.decimal_comma = false, d.in_brackets = false, d.minus = "-";
  if (d.reader == Reader::simpack) return;
  d.unit_said = false;
  if (d.reader == Reader::gensys) d.shift_y = 0.0;
}

}  // namespace

const std::vector<BaseShape>& base_shapes() {
  const auto wheel = [](const char* name, std::function<Points()> points, const char* true_shape = nullptr) {
    return BaseShape{name, Body::wheel, std::move(points), true_shape == nullptr ? name : true_shape};
  };
  const auto rail = [](const char* name, std::function<Points()> points, const char* true_shape = nullptr) {
    return BaseShape{name, Body::rail, std::move(points), true_shape == nullptr ? name : true_shape};
  };
  static const Seen shapes{
      wheel("new", [] { return standard("S1002"); }),
      wheel("hollow by 0.5 mm", [] { return hollow_wheel(0.5); }),
      wheel("hollow by 1 mm", [] { return hollow_wheel(1.0); }),
      wheel("hollow by 2 mm", [] { return hollow_wheel(2.0); }),
      wheel("hollow by 3 mm", [] { return hollow_wheel(3.0); }),
      wheel("hollow by 4 mm", [] { return hollow_wheel(4.0); }),
      wheel("hollow by 6 mm", [] { return hollow_wheel(6.0); }),
      wheel("thin flange",
            [] {
              return changed(standard("S1002"), [](const Vec2& p) {
                return Vec2(-5.0 * eased((p.x() + 57.0) / 10.0) * eased((-14.0 - p.x()) / 18.0), 0.0);
              });
            }),
      wheel("false flange",
            [] {
              return changed(standard("S1002"), [](const Vec2& p) {
                return Vec2(0.0, hollow(2.5, 3.0, 32.0, p.x()) + 1.5 * std::exp(-std::pow((p.x() - 44.0) / 7.0, 2)));
              });
            }),
      wheel("rising tread",
            [] {
              return changed(standard("S1002"),
                             [](const Vec2& p) { return Vec2(0.0, 4.5 * eased((p.x() + 5.0) / 65.0)); });
            }),
      wheel("long back", with_long_back, "new"),
      rail("60E1", [] { return standard("60E1"); }),
      rail("side worn by 2 mm", [] { return side_worn(2.0); }),
      rail("side worn by 4 mm", [] { return side_worn(4.0); }),
      rail("side worn by 6 mm", [] { return side_worn(6.0); }),
      rail("flat head",
           [] {
             return changed(standard("60E1"), [](const Vec2& p) {
               return Vec2(0.0, 0.5 * (1.0 - p.y() + std::hypot(p.y() - 1.0, 1.2)));
             });
           }),
      rail("grooved", grooved, "60E1"),
      rail(
          "top", [] { return kept(standard("60E1"), [](const Vec2& p) { return std::fabs(p.x()) <= 20.0; }); }, "60E1"),
      rail(
          "cut 5 mm below the top", [] { return cut_rail(5.0); }, "60E1"),
      rail(
          "cut 8 mm below the top", [] { return cut_rail(8.0); }, "60E1"),
      rail(
          "cut 10 mm below the top", [] { return cut_rail(10.0); }, "60E1"),
      rail("whole outline", whole_outline, "60E1"),
  };
  return shapes;
}

const BaseShape& base_shape(const std::string& name) {
  return *std::find_if(base_shapes().begin(), base_shapes().end(), [&](const BaseShape& s) { return name == s.name; });
}

DisguisedFile disguised(const BaseShape& base, const Disguise& how, std::uint64_t seed) {
  Random random(seed);
  const Points points = measured(base, how, random);
  const bool wheel = base.body == Body::wheel;
  std::string text, ending;
  if (how.reader == Disguise::Reader::columns) {
    text = column_text(points, how, random);
    ending = how.delimiter == " " ? ".txt" : ".csv";
  } else {
    for (const Vec2& p : points) text += number(p.x(), how) + " " + number(p.y(), how) + "\n";
    if (how.reader == Disguise::Reader::miniprof) {
      text = fmt::format("#MINI{}PROF\ntrial\nMINIPROF 2020\n\n", wheel ? "WHEEL" : "RAIL") + text;
      ending = wheel ? ".whl" : ".ban";
    } else if (how.reader == Disguise::Reader::simpack) {
      text = fmt::format(
          "header.begin\n version = 1\n type = {}\nheader.end\nspline.begin\n units.len.f = {:.10g}\n"
          " mirror.y = {}\n mirror.z = {}\npoint.begin\n{}point.end\nspline.end\n",
          int{wheel}, how.unit_said ? 1e3 / how.in_mm : 1e3, int{how.mirrored}, int{how.up}, text);
      ending = wheel ? ".prw" : ".prr";
    } else {
      ending = ".wheel";
    }
  }
  if (how.line_end != "\n") replace_all(text, "\n", how.line_end);
  return {ending, encoded(text, how.encoding)};
}

DisguiseTrial disguise_trial(std::uint64_t number) {
  Random random(1000 + number);
  DisguiseTrial trial;
  trial.base = &base_shapes()[number % base_shapes().size()];
  const bool wheel = trial.base->body == Body::wheel;
  constexpr Disguise::Reader kReaders[]{Disguise::Reader::columns, Disguise::Reader::columns,
                                        Disguise::Reader::columns, Disguise::Reader::miniprof,
                                        Disguise::Reader::simpack, Disguise::Reader::gensys};
  const char* const names[]{"columns", "columns", "columns", "MiniProf", "Simpack", "GENSYS"};
  const std::size_t reader = random.bits() % (wheel ? 6 : 5);
  trial.how.reader = kReaders[reader];
  trial.words = fmt::format("trial {}: {}, {}", number, trial.base->name, names[reader]);
  const std::size_t count = random.bits() % 4;
  std::vector<std::size_t> taken;
  while (taken.size() < count) {
    const std::size_t row = random.bits() % choices().size();
    if (std::find(taken.begin(), taken.end(), row) != taken.end()) continue;
    taken.push_back(row);
    const Value& value = choices()[row][random.bits() % choices()[row].size()];
    value.set(trial.how, random);
    trial.words += fmt::format(", {}", value.name);
  }
  settle(trial.how);
  return trial;
}

}  // namespace treadmark::testing
