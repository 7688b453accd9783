// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/io/cases/key_builder.hpp"

namespace treadmark::io {

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
  const auto hertz_number = [&](const std::string& name, const std::string& doc, double HertzInput::*member) {
    KeyInfo& info =
        list.number<B>("patch.hertz." + name, kPositive, doc, [member](B& c) -> double& { return hertz(c).*member; });
    if (info.default_text == "0") info.default_text.clear();
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
  list.number_list<B>("patch.gap.coefficients_si", "coefficients of the undeformed distance in SI units, see below",
                      [](B& c) -> std::vector<double>& { return gap(c).coefficients; });
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
  }
  KeyInfo coupling = key_info("patch.planform.coupling", KeyType::number_list,
                              "sub_patches: factor on the influence between each two of them: 1-2, 1-3, ..., 2-3, ...");
  coupling.scope = KeyScope::patch;
  coupling.at_least = 0.0;
  coupling.at_most = 1.0;
  list.add(coupling).set = [](Case& c, const CaseValue& v, const std::filesystem::path&) {
    content_of<B>(c).planform.coupling = symmetric(numbers_of(v, 1.0));
  };
}

}  // namespace

void add_patch_geometry_keys(KeyList& list) {
  add_geometry(list);
  add_planform(list);
}

}  // namespace treadmark::io
