// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include <cmath>

#include "treadmark/core/to_whole.hpp"
#include "treadmark/io/cases/key_builder.hpp"
#include "treadmark/model/magnitudes.hpp"

namespace treadmark::io {

namespace {

using B = BasicCase;

constexpr KeyLimits kCreep{{}, -kMostCreepage, kMostCreepage};

/// Of keys that say the same for a shift and for rolling, one is written.
void written_in_regime(CaseKey& key, bool shift) {
  key.written = [shift, written = key.written](const Case& c, const std::filesystem::path& folder) {
    return (std::get<B>(c.content).regime == Regime::shift) == shift ? written(c, folder) : std::string();
  };
}

void add_load(KeyList& list) {
  const auto vertical = [&](const std::string& name, KeyLimits limits, const std::string& doc, double B::*member,
                            bool force) {
    list.number<B>("patch." + name, limits, doc, [member](B& c) -> double& { return c.*member; });
    CaseKey& key = list.keys.back();
    key.info.group = "patch normal";
    key.info.alternative = name;
    key.info.default_text.clear();
    key.set = [member, force, unit = unit_of_key(name)](Case& c, const CaseValue& v, const std::filesystem::path&) {
      content_of<B>(c).*member = v.number() * unit;
      content_of<B>(c).normal_force_prescribed = force;
    };
    key.written = [force, written = key.written](const Case& c, const std::filesystem::path& folder) {
      return std::get<B>(c.content).normal_force_prescribed == force ? written(c, folder) : std::string();
    };
  };
  vertical("normal_force_N", kPositive, "normal force (one of this and approach_mm is required)", &B::normal_force,
           true);
  vertical("approach_mm", kAnyNumber, "prescribed approach of the bodies", &B::approach, false);

  // Creepage, shift and force are three ways to say what drives one direction.
  const auto driven = [&](const std::string& name, const std::string& doc, const std::string& direction,
                          double B::*member, std::optional<double> B::*force) {
    list.number<B>("patch." + name, kCreep, doc, [member](B& c) -> double& { return c.*member; });
    CaseKey& key = list.keys.back();
    key.info.group = "patch " + direction;
    key.info.alternative = name;
    key.set = [member, force, unit = unit_of_key(name)](Case& c, const CaseValue& v, const std::filesystem::path&) {
      content_of<B>(c).*member = v.number() * unit;
      (content_of<B>(c).*force).reset();
    };
    key.written = [force, shift = name.starts_with("shift"), written = key.written](
                      const Case& c, const std::filesystem::path& folder) {
      const B& patch = std::get<B>(c.content);
      return patch.*force || (patch.regime == Regime::shift) != shift ? std::string() : written(c, folder);
    };
  };
  const auto forced = [&](const std::string& name, const std::string& doc, const std::string& direction,
                          double B::*member, std::optional<double> B::*force) {
    KeyInfo info = key_info("patch." + name, KeyType::number, doc);
    info.at_least = -1.0;
    info.at_most = 1.0;
    info.group = "patch " + direction;
    info.alternative = name;
    info.scope = KeyScope::patch;
    CaseKey& key = list.add(info);
    key.set = [member, force](Case& c, const CaseValue& v, const std::filesystem::path&) {
      content_of<B>(c).*force = v.number();
      content_of<B>(c).*member = 0.0;
    };
    key.written = [force](const Case& c, const std::filesystem::path&) {
      const auto& value = std::get<B>(c.content).*force;
      return value ? exact_text(*value, 1.0) : std::string();
    };
  };
  driven("creepage_x", "longitudinal creepage (rail - wheel)/V", "x", &B::xi, &B::fx_relative);
  driven("shift_x_mm", "longitudinal shift (regime = \"shift\")", "x", &B::xi, &B::fx_relative);
  forced("force_x_relative", "longitudinal force on body 1 over mu F_n, instead of the creepage", "x", &B::xi,
         &B::fx_relative);
  driven("creepage_y", "lateral creepage", "y", &B::eta, &B::fy_relative);
  driven("shift_y_mm", "lateral shift (regime = \"shift\")", "y", &B::eta, &B::fy_relative);
  forced("force_y_relative", "lateral force on body 1 over mu F_n; needs force_x_relative", "y", &B::eta,
         &B::fy_relative);
  for (const auto& [name, doc] : {std::pair<std::string, std::string>{"spin_rad_m", "spin creepage"},
                                  {"shift_rotation_rad", "rotation of a shift (regime = \"shift\")"}}) {
    KeyInfo& info = list.number<B>("patch." + name, kCreep, doc, [](B& c) -> double& { return c.phi; });
    info.group = "patch rotation";
    info.alternative = name;
    written_in_regime(list.keys.back(), name.starts_with("shift"));
  }
  list.number<B>("patch.spin_center_x_mm", kAnyNumber, "x of the point about which the spin acts",
                 [](B& c) -> double& { return c.spin_x; });
  list.number<B>("patch.spin_center_y_mm", kAnyNumber, "y of the point about which the spin acts",
                 [](B& c) -> double& { return c.spin_y; });
  list.choice<B, SpinSlip>(
      "patch.spin_slip",
      {{"both", SpinSlip::both}, {"longitudinal", SpinSlip::longitudinal}, {"lateral", SpinSlip::lateral}},
      "rigid slip that the spin makes: in both directions, or in one only",
      [](B& c) -> SpinSlip& { return c.spin_slip; });
}

void add_rolling(KeyList& list) {
  list.angle<B>("patch.rolling_direction", kAnyNumber, "rolling direction chi: 0 = +x",
                [](B& c) -> double& { return c.chi; });
  list.number<B>("patch.rolling_step_mm", {0.0, {}, kMostStep}, "distance rolled per step",
                 [](B& c) -> double& { return c.dq; });
  list.number<B>("patch.velocity_m_s", {0.0, {}, kMostSpeed}, "rolling velocity",
                 [](B& c) -> double& { return c.velocity; });
  list.number<B>("patch.spin_offset_factor", kNotNegative,
                 "share of the rolling step by which the spin centre is moved",
                 [](B& c) -> double& { return c.spin_offset_factor; });
  list.choice<B>(
      "patch.normal_model", words_of<B>(kNormalTheories),
      "pressure: solved; the Hertzian ellipsoid, a paraboloid or two half ellipsoids ([patch.hertz] only); or an "
      "approximation (KPEC, ANALYN) at a given approach",
      [](B& c) -> NormalModel& { return c.normal_model; });
  add_simplified_theory<B>(list, "patch.");
}

void add_extra_slip(KeyList& list) {
  // As creepages and shifts: relative velocities in rolling, distances in a shift.
  const auto component = [&](const std::string& name, const std::string& axis, const std::string& doc,
                             std::vector<double> B::*member) {
    KeyInfo& info = list.number_list<B>(
        "patch." + name, doc, [member](B& c) -> std::vector<double>& { return c.*member; }, kCreep);
    info.group = "patch extra " + axis;
    info.alternative = name;
    written_in_regime(list.keys.back(), name.starts_with("extra_shift"));
  };
  component("extra_slip_x", "x", "rigid slip in x added to every element (x fastest), relative to the rolling velocity",
            &B::extra_slip_x);
  component("extra_shift_x_mm", "x", "the same as a distance (regime = \"shift\")", &B::extra_slip_x);
  component("extra_slip_y", "y", "rigid slip in y added to every element", &B::extra_slip_y);
  component("extra_shift_y_mm", "y", "the same as a distance (regime = \"shift\")", &B::extra_slip_y);
}

}  // namespace

void add_patch_keys(KeyList& list) {
  add_load(list);
  add_rolling(list);
  add_extra_slip(list);
}

namespace {

using B = BasicCase;

HertzInput& hertz(B& c) {
  if (!std::holds_alternative<HertzInput>(c.geometry)) c.geometry = HertzInput{};
  return std::get<HertzInput>(c.geometry);
}
GapInput& gap(B& c) {
  if (!std::holds_alternative<GapInput>(c.geometry)) c.geometry = GapInput{};
  return std::get<GapInput>(c.geometry);
}

/// Looking for the one would make it out of the other.
template <class Geometry>
void written_with(CaseKey& key) {
  key.written = [written = key.written](const Case& c, const std::filesystem::path& folder) {
    return std::holds_alternative<Geometry>(std::get<B>(c.content).geometry) ? written(c, folder) : std::string();
  };
}

/// Full matrix with 1 on the diagonal from what stands above it, row by row; a list that fills no triangle stays as it
/// is.
std::vector<double> symmetric(const std::vector<double>& above) {
  std::size_t size = 1;
  while (size * (size - 1) / 2 < above.size()) ++size;
  if (size * (size - 1) / 2 != above.size()) return above;
  std::vector<double> full(size * size, 1.0);
  std::size_t next = 0;
  for (std::size_t i = 0; i < size; ++i)
    for (std::size_t j = i + 1; j < size; ++j) full[i * size + j] = full[j * size + i] = above[next++];
  return full;
}

std::vector<double> above_diagonal(const std::vector<double>& full) {
  const auto size = to_whole<std::size_t>(std::round(std::sqrt(static_cast<double>(full.size()))));
  std::vector<double> above;
  for (std::size_t i = 0; i < size; ++i)
    for (std::size_t j = i + 1; j < size; ++j) above.push_back(full.at(i * size + j));
  return above;
}

void add_geometry(KeyList& list) {
  constexpr double kMost = 4e6;
  list.integer<B>("patch.mx", 1, kMost, "elements in x", [](B& c) -> int& { return c.mx; }).default_text.clear();
  list.integer<B>("patch.my", 1, kMost, "elements in y", [](B& c) -> int& { return c.my; }).default_text.clear();
  list.number<B>("patch.x0_mm", kAnyNumber, "centre of the first element ([patch.gap] only)",
                 [](B& c) -> double& { return c.x0; });
  list.number<B>("patch.y0_mm", kAnyNumber, "centre of the first element ([patch.gap] only)",
                 [](B& c) -> double& { return c.y0; });
  list.number<B>("patch.dx_mm", kPositive, "element size in x ([patch.gap] only)", [](B& c) -> double& { return c.dx; })
      .default_text.clear();
  list.number<B>("patch.dy_mm", kPositive, "element size in y ([patch.gap] only)", [](B& c) -> double& { return c.dy; })
      .default_text.clear();

  list.choice<B, GridBorder>(
      "patch.grid_border", {{"open", GridBorder::open}, {"closed", GridBorder::closed}},
      "bodies go on beyond the elements, so that pressure at the border is a warning; or they may "
      "touch nowhere else",
      [](B& c) -> GridBorder& { return c.grid_border; });

  using Given = HertzInput::Given;
  list.choice<B, Given>("patch.hertz.given",
                        {{"curvatures", Given::curvatures},
                         {"curvature_and_ratio", Given::curvature_and_ratio},
                         {"semi_axes", Given::semi_axes},
                         {"line_curvature", Given::line_curvature},
                         {"line_semi_axis", Given::line_semi_axis},
                         {"semi_double_elliptic", Given::semi_double_elliptic}},
                        "Hertzian contact: what describes it (the grid follows from it, mx, my and scale)",
                        [](B& c) -> Given& { return hertz(c).given; });
  written_with<HertzInput>(list.keys.back());
  const auto hertz_number = [&](const std::string& name, const std::string& doc, double HertzInput::*member) {
    KeyInfo& info =
        list.number<B>("patch.hertz." + name, kPositive, doc, [member](B& c) -> double& { return hertz(c).*member; });
    if (info.default_text == "0") info.default_text.clear();
    written_with<HertzInput>(list.keys.back());
    list.keys.back().written = [written = list.keys.back().written](const Case& c,
                                                                    const std::filesystem::path& folder) {
      const std::string text = written(c, folder);
      return text == "0" ? std::string() : text;  // not given
    };
  };
  hertz_number("curvature_x_per_m", "A = 1/(2 R_x), all but semi-axes cases", &HertzInput::a1);
  hertz_number("curvature_y_per_m", "B = 1/(2 R_y), \"curvatures\"", &HertzInput::b1);
  hertz_number("semi_axis_x_mm", "a, \"semi_axes\", \"line_semi_axis\" and \"semi_double_elliptic\"", &HertzInput::aa);
  hertz_number("semi_axis_y_mm", "b, \"semi_axes\"; half width of a line contact", &HertzInput::bb);
  for (const bool negative : {true, false}) {
    const std::string name = fmt::format("semi_axis_y_{}_mm", negative ? "negative" : "positive");
    hertz_number(name, fmt::format("half width towards {}y, \"semi_double_elliptic\"", negative ? "-" : "+"),
                 negative ? &HertzInput::bb_negative : &HertzInput::bb_positive);
    list.keys.back().set = [negative, unit = unit_of_key(name)](Case& c, const CaseValue& v,
                                                                const std::filesystem::path&) {
      HertzInput& h = hertz(content_of<B>(c));
      (negative ? h.bb_negative : h.bb_positive) = v.number() * unit;
      h.bb = 0.5 * (h.bb_negative + h.bb_positive);
    };
  }
  hertz_number("axis_ratio", "a/b, \"curvature_and_ratio\"", &HertzInput::aob);
  hertz_number("scale", "potential contact area over the ellipse", &HertzInput::scale);

  using Kind = GapInput::Kind;
  list.choice<B, Kind>("patch.gap.kind",
                       {{"quadratic", Kind::quadratic},
                        {"circular", Kind::circular},
                        {"sinusoidal", Kind::sinusoidal},
                        {"per_element", Kind::per_element}},
                       "undeformed distance by formula or for every element",
                       [](B& c) -> Kind& { return gap(c).kind; });
  written_with<GapInput>(list.keys.back());
  list.number_list<B>("patch.gap.coefficients_si", "coefficients of the undeformed distance in SI units, see below",
                      [](B& c) -> std::vector<double>& { return gap(c).coefficients; });
  written_with<GapInput>(list.keys.back());
}

void add_planform(KeyList& list) {
  using Kind = PlanformInput::Kind;
  list.choice<B, Kind>(
      "patch.planform.kind",
      {{"free", Kind::free},
       {"quadratic", Kind::quadratic},
       {"two_rectangles", Kind::two_rectangles},
       {"sub_patches", Kind::sub_patches}},
      "where contact can be: anywhere, where a quadratic is negative, in two rectangles, or in rectangles with scaled "
      "influence on each other",
      [](B& c) -> Kind& { return c.planform.kind; });
  for (const auto& [name, doc] :
       {std::pair<std::string, std::string>{"coefficients_si", "quadratic: b1 ... b6 in SI units, see below"},
        {"rectangles_mm", "x low, x high, y low, y high of each rectangle, one after the other"}}) {
    KeyInfo& info = list.number_list<B>("patch.planform." + name, doc,
                                        [](B& c) -> std::vector<double>& { return c.planform.coefficients; });
    info.group = "patch planform";
    info.alternative = name;
    CaseKey& key = list.keys.back();
    key.written = [quadratic = name == "coefficients_si", written = key.written](const Case& c,
                                                                                 const std::filesystem::path& folder) {
      const bool is_quadratic = std::get<B>(c.content).planform.kind == Kind::quadratic;
      return is_quadratic == quadratic ? written(c, folder) : std::string();
    };
  }
  KeyInfo coupling = key_info("patch.planform.coupling", KeyType::number_list,
                              "sub_patches: factor on the influence between each two of them: 1-2, 1-3, ..., 2-3, ...");
  coupling.scope = KeyScope::patch;
  coupling.at_least = 0.0;
  coupling.at_most = 1.0;
  CaseKey& factors = list.add(coupling);
  factors.set = [](Case& c, const CaseValue& v, const std::filesystem::path&) {
    content_of<B>(c).planform.coupling = symmetric(numbers_of(v, 1.0));
  };
  factors.written = [](const Case& c, const std::filesystem::path&) {
    const std::vector<double> above = above_diagonal(std::get<B>(c.content).planform.coupling);
    return above.empty() ? std::string() : exact_list(above, 1.0);
  };
}

}  // namespace

void add_patch_geometry_keys(KeyList& list) {
  add_geometry(list);
  add_planform(list);
}

}  // namespace treadmark::io
