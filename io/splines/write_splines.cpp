// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include <algorithm>
#include <array>
#include <iterator>
#include <vector>

#include <fmt/format.h>

#include "treadmark/core/cancellation.hpp"
#include "treadmark/core/constants.hpp"
#include "treadmark/core/output_file.hpp"
#include "treadmark/core/platform/ranges.hpp"
#include "treadmark/io/splines/read_splines.hpp"

namespace treadmark::io {
namespace {

using Text = std::back_insert_iterator<std::string>;

void write_basis(Text out, const std::array<SplineKnots, 2>& directions, int level) {
  fmt::format_to(out, "<Basis type=\"TensorBSplineBasis2\"");
  if (level >= 0) fmt::format_to(out, " level=\"{}\"", level);
  fmt::format_to(out, ">\n");
  for (std::size_t d = 0; d < 2; ++d) {
    fmt::format_to(out, "<Basis type=\"BSplineBasis\" index=\"{}\">\n<KnotVector degree=\"{}\">", d,
                   directions[d].degree);
    for (const double knot : directions[d].knots) fmt::format_to(out, "{} ", knot);
    fmt::format_to(out, "</KnotVector>\n</Basis>\n");
  }
  fmt::format_to(out, "</Basis>\n");
}

/// Every level has one knot more in the middle of each interval, as G+Smo makes them by itself.
bool all_halved(const SplineSurface& s) {
  for (std::size_t l = 1; l < s.levels.size(); ++l)
    for (std::size_t d = 0; d < 2; ++d) {
      const std::vector<double> a = s.levels[l - 1][d].breaks(), b = s.levels[l][d].breaks();
      if (b.size() != 2 * a.size() - 1 || s.levels[l][d].knots.size() != s.levels[l - 1][d].knots.size() + a.size() - 1)
        return false;
      for (std::size_t i = 0; i < a.size(); ++i)
        if (b[2 * i] != a[i] || (i + 1 < a.size() && b[2 * i + 1] != 0.5 * (a[i] + a[i + 1]))) return false;
    }
  return true;
}

/// See tree_indices of the reader.
std::vector<std::array<std::vector<long>, 2>> box_indices(const SplineSurface& s, bool own_levels,
                                                          const std::filesystem::path& file) {
  std::vector<std::array<std::vector<long>, 2>> out(s.levels.size());
  for (std::size_t d = 0; d < 2; ++d) {
    std::vector<double> before;
    for (std::size_t l = 0; l < s.levels.size(); ++l) {
      std::vector<double> breaks = s.levels[l][d].breaks();
      std::vector<long>& at = out[l][d];
      at.reserve(breaks.size());
      std::size_t c = 0;
      for (std::size_t i = 0; i < breaks.size(); ++i) {
        if (l == 0 || !own_levels) {
          at.push_back(static_cast<long>(i));
        } else if (c < before.size() && breaks[i] == before[c]) {
          at.push_back(2 * out[l - 1][d][c++]);
        } else if (i > 0 && c > 0 && c < before.size() && breaks[i - 1] == before[c - 1]) {
          at.push_back(out[l - 1][d][c - 1] + out[l - 1][d][c]);
        } else {
          throw Error(ErrorKind::configuration,
                      fmt::format("level {} of a hierarchical spline has more than one new knot in an interval", l),
                      {file.string()}, "write it as nurbs");
        }
      }
      before = std::move(breaks);
    }
  }
  return out;
}

void write_surface(Text out, const SplineSurface& s, std::size_t id, const std::filesystem::path& file) {
  const bool rational = std::any_of(s.weights.begin(), s.weights.end(), [](double w) { return w != 1.0; });
  const char* kind = s.hierarchical ? s.truncated ? "THBSpline" : "HBSpline"
                     : rational     ? "TensorNurbs"
                                    : "TensorBSpline";
  fmt::format_to(out, "<Geometry type=\"{}2\" id=\"{}\">\n", kind, id);
  if (s.hierarchical) {
    const bool own_levels = !all_halved(s);
    fmt::format_to(out, "<Basis type=\"{}Basis2\" manualLevels=\"{}\">\n", kind, own_levels);
    write_basis(out, s.levels.front(), own_levels ? 0 : -1);
    for (std::size_t l = 1; own_levels && l < s.levels.size(); ++l) write_basis(out, s.levels[l], static_cast<int>(l));
    const auto at = box_indices(s, own_levels, file);
    for (const SplineBox& b : s.boxes) {
      const auto& of = at[static_cast<std::size_t>(b.level)];
      const auto index = [&](std::size_t d, int i) { return of[d][static_cast<std::size_t>(i)]; };
      fmt::format_to(out, "<box level=\"{}\">{} {} {} {}</box>\n", b.level, index(0, b.lower[0]), index(1, b.lower[1]),
                     index(0, b.upper[0]), index(1, b.upper[1]));
    }
    fmt::format_to(out, "</Basis>\n");
  } else if (rational) {
    fmt::format_to(out, "<Basis type=\"TensorNurbsBasis2\">\n");
    write_basis(out, s.levels.front(), -1);
    fmt::format_to(out, "<weights>");
    for (const double w : s.weights) fmt::format_to(out, "{}\n", w);
    fmt::format_to(out, "</weights>\n</Basis>\n");
  } else {
    write_basis(out, s.levels.front(), -1);
  }
  fmt::format_to(out, "<coefs geoDim=\"3\">");
  for (const Vec3& p : s.points) fmt::format_to(out, "{} {} {}\n", kMilli * p.x(), kMilli * p.y(), kMilli * p.z());
  fmt::format_to(out, "</coefs>\n</Geometry>\n");
}

/// How patches meet: of each interface both patches with their sides, to which direction of the second one the
/// directions of the first lead, and which of them run the same way; across the sides, whether both are of one kind.
void write_patches(Text out, std::size_t patches, std::span<const SplineInterface> interfaces) {
  fmt::format_to(out, "<MultiPatch parDim=\"2\" id=\"{}\">\n<patches type=\"id_range\">0 {}</patches>\n", patches,
                 patches - 1);
  std::vector<bool> meets(4 * patches);
  const auto place = [](std::size_t patch, int side) { return 4 * patch + static_cast<std::size_t>(side) - 1; };
  if (!interfaces.empty()) fmt::format_to(out, "<interfaces>");
  for (const SplineInterface& i : interfaces) {
    meets.at(place(i.first, i.first_side)) = meets.at(place(i.second, i.second_side)) = true;
    const std::size_t across = i.first_side <= 2 ? 0 : 1;
    const int across_second = i.second_side <= 2 ? 0 : 1;
    std::array<int, 2> leads_to{}, same_way{};
    leads_to[across] = across_second, leads_to[1 - across] = 1 - across_second;
    same_way[across] = i.first_side % 2 == i.second_side % 2 ? 1 : 0, same_way[1 - across] = i.reversed ? 0 : 1;
    fmt::format_to(out, "{} {} {} {} {} {} {} {}\n", i.first, i.first_side, i.second, i.second_side, leads_to[0],
                   leads_to[1], same_way[0], same_way[1]);
  }
  if (!interfaces.empty()) fmt::format_to(out, "</interfaces>\n");
  if (ranges::find(meets, false) != meets.end()) {
    fmt::format_to(out, "<boundary>");
    for (std::size_t k = 0; k < meets.size(); ++k)
      if (!meets[k]) fmt::format_to(out, "{} {}\n", k / 4, k % 4 + 1);
    fmt::format_to(out, "</boundary>\n");
  }
  fmt::format_to(out, "</MultiPatch>\n");
}

}  // namespace

void write_splines(const std::filesystem::path& file, std::span<const SplineSurface> surfaces,
                   std::span<const SplineInterface> interfaces) {
  if (!is_spline_file(file))
    throw Error(ErrorKind::configuration, "splines are written as G+Smo's XML", {file.string()}, "use .xml");
  if (surfaces.empty()) throw Error(ErrorKind::configuration, "there is no surface to write", {file.string()});
  OutputFile output(file);
  std::string text =
      "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<!-- lengths in mm: x forward, y to the right, z down; "
      "the axle of a wheel is the y axis -->\n<xml>\n";
  for (std::size_t k = 0; k < surfaces.size(); ++k) {
    check_cancelled();
    write_surface(Text(text), surfaces[k], k, file);
    output.write(text);
    text.clear();
  }
  if (surfaces.size() > 1) write_patches(Text(text), surfaces.size(), interfaces);
  output.write(text + "</xml>\n");
  output.commit();
}

}  // namespace treadmark::io
