// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/solvers/kalker/plausibility.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

#include "treadmark/core/constants.hpp"
#include "treadmark/model/contact/theories.hpp"
#include "treadmark/solvers/kalker/fastsim/flexibilities.hpp"
#include "treadmark/solvers/kalker/fastsim/kalker_coefficients.hpp"

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

/// Where docs/verification.md sees an error of more than a tenth of the friction bound under spin. Spin in units of
/// what the linear theory needs for the bound.
struct SpinRange {
  double widest, wide_spin;  ///< a/b, and the spin below it
  double longest, long_spin;
};
constexpr SpinRange kFastsimRange{0.2, 0.2, 5.0, 0.7}, kFastripRange{0.3, 0.2, 2.5, 0.7};
/// A flexibility that differs by more from that of a creepage which takes this share of the bound.
constexpr double kOtherFlexibility = 0.15, kShareOfBound = 0.2;
constexpr double kMostExcess = 0.1;   ///< of tractions of the linear theory beyond friction, over friction
constexpr double kLongestKpec = 4.0;  ///< a/b

/// Sum of what tractions exceed friction by, over that of friction.
double excess_over_friction(const ContactSolution& s) {
  double excess = 0.0, bound = 0.0;
  for (std::size_t i = 0; i < std::min(s.pressure.size(), s.traction_x.size()); ++i) {
    const double most = s.friction[i] * s.pressure[i];
    bound += most;
    excess += std::max(0.0, std::hypot(s.traction_x[i], s.traction_y[i]) - most);
  }
  return bound > 0.0 ? excess / bound : 0.0;
}

/// What is beyond the theory of the tractions; empty: nothing.
std::string beyond_tangential(const PatchSetting& p, const ContactSolution& s, const EquivalentEllipse& ellipse) {
  if (theory(p.tangential_model).limits.no_slip) {
    const double excess = excess_over_friction(s);
    return excess <= kMostExcess ? std::string()
                                 : fmt::format(
                                       "tractions of the linear theory exceed friction by {:.2g} of it: the "
                                       "creepages are too large for it, take another theory",
                                       excess);
  }
  const CombinedMaterial material = combine(p.material);
  const KalkerCoefficients k = kalker_coefficients(ellipse.a, ellipse.b, material.poisson);
  const double c = std::sqrt(ellipse.a * ellipse.b), ratio = ellipse.a / ellipse.b,
               unit = material.shear_modulus * c * c / (p.static_friction * s.force_n);
  const double xi = unit * k.c11 * std::abs(s.creepage.xi), eta = unit * k.c22 * std::abs(s.creepage.eta),
               spin = unit * c * k.c23 * std::abs(s.creepage.phi);
  if (p.tangential_model == TangentialModel::fastsim_one_flexibility) {
    const LinearFlexibilities three = linear_flexibilities(k, material.shear_modulus, ellipse.a, ellipse.b);
    double other = 0.0;
    for (const auto& [share, flexibility] :
         {std::pair{xi, three.l1}, std::pair{eta, three.l2}, std::pair{spin, three.l3}})
      if (share > kShareOfBound) other = std::max(other, std::abs(p.flexibility / flexibility - 1.0));
    return other <= kOtherFlexibility
               ? std::string()
               : fmt::format(
                     "the one flexibility of FASTSIM differs by {:.2g} % from those of the linear theory: take "
                     "three flexibilities",
                     1e2 * other);
  }
  const bool strips = theory(p.tangential_model).limits.strips;
  const SpinRange& range = strips ? kFastripRange : kFastsimRange;
  const bool wide = ratio < range.widest && spin > range.wide_spin,
             too_long = ratio > range.longest && spin > range.long_spin;
  return wide || too_long ? fmt::format(
                                "{} under spin on a patch of a/b = {:.2g} misses the exact theory by more than "
                                "a tenth of the friction bound: take the full tangential model",
                                strips ? "FaStrip" : "FASTSIM", ratio)
                          : std::string();
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

  const EquivalentEllipse ellipse = equivalent_ellipse(p.grid, s.pressure);
  if (p.normal_model == NormalModel::kpec && ellipse.a > kLongestKpec * ellipse.b)
    add(RemarkKind::beyond_theory,
        fmt::format("KPEC on a patch {:.2g} times as long as wide: the largest pressure is off by more than 5 %",
                    ellipse.a / ellipse.b));
  if (p.rolling && p.tangential_model != TangentialModel::full && p.static_friction > 0.0 && s.force_n > 0.0)
    if (std::string text = beyond_tangential(p, s, ellipse); !text.empty())
      add(RemarkKind::beyond_theory, std::move(text));

  const Exchange e = exchange(s);
  // Slip below a millionth of rolling (shift: of a millimetre) is what rounding leaves.
  const double noise = 1e-6 * (p.shift ? 1e-3 : 1.0) * p.static_friction * s.force_n / p.grid.cell_area();
  if (e.added > kAddedEnergy * e.dissipated && e.added > noise)
    add(RemarkKind::friction_adds_energy,
        fmt::format("friction adds {:.2g} % of the energy that it dissipates: tractions push where the surfaces slip",
                    1e2 * e.added / std::max(e.dissipated, noise)));
}

void judge_refinement(const Refinement& r, int patch, std::vector<Remark>& remarks) {
  constexpr double kGrowing = 0.2;
  if (r.peak_exponent > kGrowing)
    remarks.push_back(
        {RemarkKind::edge_pressure, patch,
         fmt::format("the largest pressure, at x = {:.4g}, s = {:.4g} mm of the grid, grows with smaller "
                     "elements as their size to the power of -{:.2f}, as at an edge, a kink or the end of "
                     "a surface: it has no limit; forces and mean pressures have",
                     kMilli * r.peak.x(), kMilli * r.peak.y(), r.peak_exponent)});
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
