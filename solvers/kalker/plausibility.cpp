// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/solvers/kalker/plausibility.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "treadmark/core/constants.hpp"

namespace treadmark::kalker {
namespace {

constexpr int kFewElements = 20, kHardlyAny = 5, kFewInStrip = 8;
constexpr double kMuchRefinement = 0.05;
constexpr double kLargeCreepage = 0.1;
constexpr double kMostFriction = 1.0;
constexpr double kAddedEnergy = 0.01;
constexpr double kForceTolerance = 2e-3;

/// Elements in contact at the border of the grid.
struct AtBorder {
  int touching = 0;  ///< all of them
  int cut = 0;       ///< with more pressure than at the edge of a patch that ends within them
};

/// Hertz: within half an element h of its edge, a patch of half-width b has at most p_max sqrt(h / b). A direction of
/// one element has no border where that element is a strip, long against the width of contact: plane strain.
AtBorder at_border(const Grid2& g, const ContactSolution& s) {
  int first_x = g.nx, last_x = -1, first_y = g.ny, last_y = -1;
  for (int iy = 0; iy < g.ny; ++iy)
    for (int ix = 0; ix < g.nx; ++ix)
      if (s.pressure[g.index(ix, iy)] > 0.0) {
        first_x = std::min(first_x, ix), last_x = std::max(last_x, ix);
        first_y = std::min(first_y, iy), last_y = std::max(last_y, iy);
      }
  const int width_x = last_x - first_x + 1, width_y = last_y - first_y + 1;
  constexpr double kStrip = 4.0;  // lengths to widths
  if ((g.nx == 1 && g.ny > 1 && g.dx < kStrip * g.dy * width_y) ||
      (g.ny == 1 && g.nx > 1 && g.dy < kStrip * g.dx * width_x))
    return {s.elements_contact, s.elements_contact};
  const double edge_x = s.max_pressure * std::sqrt(2.0 / width_x), edge_y = s.max_pressure * std::sqrt(2.0 / width_y);
  AtBorder found;
  for (int iy = 0; iy < g.ny; ++iy)
    for (int ix = 0; ix < g.nx; ++ix) {
      const double p = s.pressure[g.index(ix, iy)];
      const bool ends_x = g.nx > 1 && (ix == 0 || ix == g.nx - 1), ends_y = g.ny > 1 && (iy == 0 || iy == g.ny - 1);
      if (p > 0.0 && (ends_x || ends_y)) ++found.touching;
      if ((ends_x && p > edge_x) || (ends_y && p > edge_y)) ++found.cut;
    }
  return found;
}

/// Power (shift: work) that friction adds and dissipates, per area, both positive.
struct Exchange {
  double added = 0.0, dissipated = 0.0;
};

Exchange exchange(const ContactSolution& s) {
  Exchange sum;
  for (std::size_t i = 0; i < std::min(s.slip_x.size(), s.traction_x.size()); ++i) {
    const double w = s.traction_x[i] * s.slip_x[i] + s.traction_y[i] * s.slip_y[i];
    (w > 0.0 ? sum.added : sum.dissipated) += std::abs(w);
  }
  return sum;
}

}  // namespace

double contact_modulus(const Material& material) {
  const CombinedMaterial m = combine(material);
  return m.shear_modulus / (1.0 - m.poisson);
}

void judge(const PatchSetting& p, const ContactSolution& s, int patch, std::vector<Remark>& remarks) {
  const auto add = [&](RemarkKind kind, std::string text) { remarks.push_back({kind, patch, std::move(text)}); };

  if (const AtBorder border = at_border(p.grid, s); border.cut > 0 && p.closed_border)
    add(RemarkKind::grid_bounds_contact,
        fmt::format("{} of {} elements in contact are under pressure at the border of the potential contact area, "
                    "beyond which the bodies may not touch",
                    border.cut, s.elements_contact));
  else if (border.cut > 0)
    add(RemarkKind::grid_cuts_contact,
        fmt::format(
            "{} of {} elements in contact are under pressure at the border of the potential contact area, which "
            "cuts the patch: make it larger",
            border.cut, s.elements_contact));
  else if (border.touching > 0)
    add(RemarkKind::grid_touches_contact,
        fmt::format("{} of {} elements in contact lie at the border of the potential contact area: make it larger",
                    border.touching, s.elements_contact));

  if (s.max_pressure > p.yield_limit && s.max_pressure <= p.pressure_limit)
    add(RemarkKind::beyond_yield,
        fmt::format("the largest pressure of {:.4g} MPa is {:.2g} E': steel yields before, and this is an upper bound",
                    kMega * s.max_pressure, s.max_pressure / contact_modulus(p.material)));
  if (s.max_pressure > p.pressure_limit)
    add(RemarkKind::beyond_half_space,
        fmt::format("the largest pressure of {:.4g} MPa is {:.2g} E' and means a patch that is not small against the "
                    "bodies' radii: look for spikes or edges in the surfaces, or a position that is not meant",
                    kMega * s.max_pressure, s.max_pressure / contact_modulus(p.material)));

  const bool strip = (p.grid.nx == 1) != (p.grid.ny == 1);
  if (s.elements_contact < (strip ? kFewInStrip : kFewElements))
    add(RemarkKind::few_elements,
        fmt::format("{} elements are in contact{}: take smaller ones", s.elements_contact,
                    s.elements_contact < kHardlyAny ? ", so that pressures are an order of magnitude only" : ""));

  if (p.rolling) {
    const double radius = std::sqrt(s.elements_contact * p.grid.cell_area() / kPi);
    const Creepage& c = s.creepage;
    const double largest = std::max({std::abs(c.xi), std::abs(c.eta), std::abs(c.phi) * radius});
    if (largest > kLargeCreepage)
      add(RemarkKind::large_creepage,
          fmt::format("a creepage of {:.3g} is not small against rolling (xi {:.3g}, eta {:.3g}, phi {:.3g} rad/mm)",
                      largest, c.xi, c.eta, 1e-3 * c.phi));
  }

  if (p.static_friction > kMostFriction)
    add(RemarkKind::unusual_friction,
        fmt::format("the coefficient of friction is {:.3g}: is a decimal point missing?", p.static_friction));

  const Exchange e = exchange(s);
  // Slip below a millionth of rolling (shift: of a millimetre) is what rounding leaves.
  const double noise = 1e-6 * (p.shift ? 1e-3 : 1.0) * p.static_friction * s.force_n / p.grid.cell_area();
  if (e.added > kAddedEnergy * e.dissipated && e.added > noise)
    add(RemarkKind::friction_adds_energy,
        fmt::format("friction adds {:.2g} % of the energy that it dissipates: tractions push where the surfaces slip",
                    1e2 * e.added / std::max(e.dissipated, noise)));
}

void judge_refinement(const Refinement& r, int patch, std::vector<Remark>& remarks) {
  if (r.pressure <= kMuchRefinement && r.force <= kMuchRefinement) return;
  remarks.push_back({RemarkKind::coarse_elements, patch,
                     fmt::format("smaller elements would change the largest pressure by about {:.2g} % and forces by "
                                 "{:.2g} %: take smaller ones, or smooth what is rough between them",
                                 1e2 * r.pressure, 1e2 * r.force)});
}

void judge_force(const char* name, double wanted, double found, std::vector<Remark>& remarks, std::string_view meant) {
  const double scale = std::abs(wanted);
  if (std::abs(found - wanted) > kForceTolerance * scale)
    remarks.push_back({meant.empty() ? RemarkKind::force_not_reached : RemarkKind::force_differs, 0,
                       fmt::format("a {} of {:.6g} N is prescribed, found are {:.6g} N{}{}", name, wanted, found,
                                   meant.empty() ? "" : ": ", meant)});
}

}  // namespace treadmark::kalker
