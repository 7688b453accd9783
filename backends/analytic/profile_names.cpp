// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include <algorithm>
#include <cctype>
#include <cmath>
#include <span>
#include <string>
#include <utility>

#include <fmt/format.h>

#include "treadmark/backends/analytic/chain.hpp"
#include "treadmark/backends/analytic/make.hpp"
#include "treadmark/backends/analytic/rail_sections.hpp"
#include "treadmark/backends/analytic/sample.hpp"
#include "treadmark/backends/analytic/standard_profiles.hpp"
#include "treadmark/backends/analytic/wheel_sections.hpp"
#include "treadmark/backends/profile_library.hpp"
#include "treadmark/core/error.hpp"
#include "treadmark/core/platform/from_chars.hpp"

namespace treadmark::analytic {
namespace {

using Curve = std::variant<ArcChain, GraphCurve>;

bool is_blank(char c) { return c == ' ' || c == '_'; }
bool is_letter(char c) { return std::isalpha(static_cast<unsigned char>(c)) != 0; }

/// As names are compared: capital letters, no blanks and underscores, and no hyphens for which skip(name, at) holds.
template <class Skip>
std::string capitals(std::string_view name, const Skip& skip) {
  std::string out;
  for (std::size_t i = 0; i < name.size(); ++i)
    if (!is_blank(name[i]) && !(name[i] == '-' && skip(name, i)))
      out += static_cast<char>(std::toupper(static_cast<unsigned char>(name[i])));
  return out;
}

/// Names without numbers of one's own: every hyphen but a leading one is a joint.
std::string plain(std::string_view name) {
  return capitals(name, [](std::string_view, std::size_t at) { return at > 0; });
}

/// "circle-R300", but not "circle R-300" nor "circle -R300", where it looks like a sign.
bool joins_letter(std::string_view name, std::size_t at) {
  const std::size_t next = name.find_first_not_of(" _", at + 1), last = name.substr(0, at).find_last_not_of(" _");
  return next != std::string_view::npos && last != std::string_view::npos && is_letter(name[next]) &&
         std::isalnum(static_cast<unsigned char>(name[last])) != 0 && is_blank(name[at - 1]) == is_blank(name[at + 1]);
}

std::string family_name(std::string_view name) { return capitals(name, joins_letter); }

/// "EN-13715 - S-1002/h30": before the dimensions hyphens after letters and between blanks are joints, too.
std::optional<WheelSection> named_section(std::string_view said) {
  return wheel_section(capitals(said, [](std::string_view name, std::size_t at) {
    if (at == 0 || at + 1 == name.size() || name.substr(0, at).find_first_of(":/") != std::string_view::npos)
      return false;
    return joins_letter(name, at) || is_letter(name[at - 1]) || (is_blank(name[at - 1]) && is_blank(name[at + 1]));
  }));
}

/// Rail A of UIC 519 lies inclined in its own axes: three numbers fitted to its printed points (0.4 um rms).
ArcChain rail_a_chain() {
  constexpr double kTurn = 0.0500132, kY = 2.601449e-3, kZ = -0.141472e-3;
  ArcChain chain = rail_uic60_chain();
  const double c = std::cos(kTurn), s = std::sin(kTurn), y = chain.start_y, z = chain.start_z;
  chain.start_y = kY + c * y + s * z;
  chain.start_z = kZ - s * y + c * z;
  chain.start_angle -= kTurn;
  return chain;
}

/// A number that ends the name, beginning with one of the words.
std::optional<double> number_after(std::string_view name, std::string_view word) {
  if (!name.starts_with(word)) return std::nullopt;
  name.remove_prefix(word.size());
  double value = 0.0;
  const auto [end, error] = from_chars(name.data(), name.data() + name.size(), value);
  if (error != std::errc() || end != name.data() + name.size() || !std::isfinite(value)) return std::nullopt;
  return value;
}

double in_range(double value, double low, double high, std::string_view what) {
  if (value >= low && value <= high) return value;
  throw Error(ErrorKind::configuration,
              fmt::format("{} must lie between {:g} and {:g}, not {:g}", what, low, high, value));
}

/// The slope of "cone 1:N", positive where the radius falls towards the field side. The sign stands before 1 or N.
std::optional<double> slope_of_cone(std::string_view said) {
  const std::string name = family_name(said);
  const bool turned = name.starts_with("CONE-");
  const auto n = number_after(name, turned ? "CONE-1:" : "CONE1:");
  if (!n) return std::nullopt;
  const std::size_t minus = said.find('-');
  if (turned && (*n < 0.0 || !is_blank(said[minus - 1]) || is_blank(said[minus + 1])))
    throw Error(ErrorKind::configuration, fmt::format("'{}' does not say which way the cone runs", said), {},
                "write 'cone 1:20', or 'cone -1:20' for one whose radius grows towards the field side");
  const double size = in_range(std::fabs(*n), 1.0, 1e6, "the cone's 1:N");
  return (turned || *n < 0.0 ? -1.0 : 1.0) / size;
}

std::string_view without_railway(std::string_view legacy) {
  return legacy.starts_with("DIN ") ? legacy.substr(4) : legacy;
}

std::optional<Curve> find_curve(std::string_view said) {
  const std::string name = plain(said);
  if (name == "60E1") return rail_60e1_chain();
  if (name == "UIC60") return rail_uic60_chain();
  if (name == "UIC519RAILA") return rail_a_chain();
  for (const RailSection& section : rail_sections())
    if (name == section.name || (!section.legacy_name.empty() && (name == plain(section.legacy_name) ||
                                                                  name == plain(without_railway(section.legacy_name)))))
      return head_chain(section);
  if (name == "S1002") return s1002_curve();
  if (const auto wheel = named_section(said)) return wheel_curve(*wheel);
  if (const auto slope = slope_of_cone(said)) return cone_curve(*slope);
  constexpr double kAngle = 1.2;
  const std::string family = family_name(said);
  if (const auto r = number_after(family, "CIRCLER"))
    return cylinder_chain(1e-3 * in_range(*r, 5.0, 1e5, "the radius in mm"), std::min(kAngle, 36.0 / *r));
  if (const auto r = number_after(family, "HOLLOWR")) return hollow_curve(in_range(*r, 35.0, 1e5, "the radius in mm"));
  return std::nullopt;
}

std::string arcs_of(const RailSection& section) {
  std::string text;
  for (const OutlineElement& e : section.half_outline) {
    if (e.radius == 0.0) break;
    text += fmt::format("{}R{:g}", text.empty() ? "" : " ", e.radius);
  }
  return text;
}

std::vector<LibraryProfile> make_library() {
  std::vector<LibraryProfile> all;
  const auto rail = [&all](std::string name, std::string also, std::string shape,
                           std::string source) -> LibraryProfile& {
    return all.emplace_back(LibraryProfile{std::move(name), std::move(also), std::move(shape), std::move(source)});
  };
  for (const RailSection& s : rail_sections()) {
    const bool newer = s.name == "60E1";  // the older drawing has a row of its own
    LibraryProfile& row =
        rail(std::string(s.name), newer ? "" : std::string(s.legacy_name), arcs_of(s), std::string(s.standard));
    row.height = s.height, row.width = s.foot_width, row.area = s.area, row.mass_per_m = s.mass;
  }
  rail("UIC60", "UIC 60", "R300 R80 R13, head only", "UIC 860");
  rail("UIC519-rail-A", "", "UIC60 inclined 1:20, head only", "UIC 519, EN 15302");
  rail("circle R300", "", "any radius in mm, up to 36 mm to both sides", "a cylinder").family = true;
  const auto wheel = [&](const char* name, const char* also, const char* shape, const char* source, double height,
                         double width) -> LibraryProfile& {
    LibraryProfile& row = rail(name, also, shape, source);
    row.body = Body::wheel, row.height = height, row.width = width;
    return row;
  };
  constexpr double kFlange = 28e-3, kWidth = 130e-3;
  const char* const variants = "/h28 ... h32/e28.5 ... e32.5/6.7% ... 15%; alone: /h28/e32.5/6.7%";
  wheel("S1002", "", variants, "EN 13715", kFlange, kWidth);
  wheel("1:40", "1/40", variants, "EN 13715", kFlange, kWidth);
  wheel("EPS", "", variants, "EN 13715", kFlange, kWidth);
  wheel("cone 1:20", "", "1:N, any N, -1:N opens outwards, 60 mm to both sides, no flange", "a cone", 0.0, 120e-3)
      .family = true;
  wheel("hollow R330", "", "any radius in mm, 30 mm to both sides, no flange", "a circle", 0.0, 60e-3).family = true;
  return all;
}

}  // namespace

Curve standard_curve(std::string_view name) {
  if (auto curve = find_curve(name)) return std::move(*curve);
  throw Error(ErrorKind::configuration, "unknown standard profile '" + std::string(name) + "'", {},
              "such as 60E1, 54E1, S1002, S1002/h30/e31/10%, cone 1:20: treadmark list profiles");
}

Body standard_profile_body(std::string_view name) {
  return std::holds_alternative<ArcChain>(standard_curve(name)) ? Body::rail : Body::wheel;
}

std::span<const std::string_view> standard_profile_names() {
  static const std::vector<std::string_view> names = [] {
    std::vector<std::string_view> list;
    for (const LibraryProfile& row : profile_library())
      if (!row.family) list.push_back(row.name);
    return list;
  }();
  return names;
}

}  // namespace treadmark::analytic

namespace treadmark {

const std::vector<LibraryProfile>& profile_library() {
  static const std::vector<LibraryProfile> library = analytic::make_library();
  return library;
}

std::optional<Body> library_body(std::string_view name) {
  const auto curve = analytic::find_curve(name);
  if (!curve) return std::nullopt;
  return std::holds_alternative<ArcChain>(*curve) ? Body::rail : Body::wheel;
}

std::vector<std::string> thinner_flanges(const std::string& name) {
  std::vector<std::string> all{name};
  const auto section = analytic::named_section(name);
  if (!section) return all;
  constexpr double kThinnest = 28.5, kStep = 0.5;
  const char* const tread = section->tread == analytic::WheelSection::Tread::s1002     ? "S1002"
                            : section->tread == analytic::WheelSection::Tread::cone_40 ? "1:40"
                                                                                       : "EPS";
  for (double e = section->flange_thickness - kStep; e >= kThinnest; e -= kStep)
    all.push_back(fmt::format("{}/h{:g}/e{:g}{}", tread, section->flange_height, e,
                              section->reverse_slope > 0.0 ? fmt::format("/{:g}%", section->reverse_slope) : ""));
  return all;
}

std::vector<Vec2> library_outline(std::string_view name, double step) {
  const std::string wanted = analytic::plain(name);
  for (const analytic::RailSection& section : analytic::rail_sections())
    if (wanted == section.name) return analytic::outline_points(section, step);
  const Profile points = analytic::sample_profile(StandardProfile{std::string(name)}, step);
  std::vector<Vec2> out;
  for (std::size_t i = 0; i < points.y.size(); ++i) out.emplace_back(points.y[i], points.z[i]);
  return out;
}

}  // namespace treadmark
