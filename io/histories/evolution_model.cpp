// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/io/histories/evolution_model.hpp"
#include "treadmark/model/body_name.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

namespace treadmark::io {
namespace {

double sum_of(const CellSheet& sheet) {
  double sum = 0.0;
  for (const auto& [j, row] : sheet.rows())
    for (const double value : row) sum += value;
  return sum;
}

double largest_of(const CellSheet& sheet) {
  double largest = 0.0;
  for (const auto& [j, row] : sheet.rows())
    for (const double value : row) largest = std::max(largest, value);
  return largest;
}

double relative(double found, double expected) { return expected != 0.0 ? found / expected - 1.0 : found; }

/// The largest of the present contacts, and of what points have endured.
void add_fatigue(const EvolvedBody& b, const std::string& name, std::vector<EvolutionQuantity>& out) {
  const EvolvedFatigue& f = b.fatigue;
  const auto present = [&](double ContactFatigue::*member) {
    double largest = f.contacts.front().*member;
    for (const ContactFatigue& c : f.contacts) largest = std::max(largest, c.*member);
    return largest;
  };
  const auto ever = [&](CellSheet StressRecord::*sheet) {
    double largest = 0.0;
    for (const StressRecord& s : b.record.stresses) largest = std::max(largest, largest_of(s.*sheet));
    return largest;
  };
  if (f.contacts.empty()) return;
  if (f.has(FatigueMeasure::fi_surf))
    out.push_back(
        {name + "_fi_surf", "1", "largest surface fatigue index, > 0: fatigue", present(&ContactFatigue::fi_surf)});
  if (f.has(FatigueMeasure::shakedown))
    out.push_back({name + "_shakedown", "1", "largest pressure over the limit of the shakedown map, > 1: flow",
                   present(&ContactFatigue::shakedown)});
  if (f.has(FatigueMeasure::whole_life))
    out.push_back({name + "_damage", "1", "largest sum of the damage of passages", largest_of(b.record.damage)});
  if (f.has(FatigueMeasure::subsurface)) {
    out.push_back({name + "_von_mises_ever_MPa", "MPa", "largest von Mises stress at the depths that has passed",
                   1e-6 * ever(&StressRecord::von_mises)});
    out.push_back({name + "_shear_ever_MPa", "MPa", "largest shear amplitude at the depths that has passed",
                   1e-6 * ever(&StressRecord::shear)});
    out.push_back({name + "_yield_share_ever", "1",
                   "largest shear yield that shakedown needs at the depths over that of the material, > 1: flow",
                   ever(&StressRecord::shakedown) / f.shear_yield});
  }
  if (f.has(FatigueMeasure::dang_van))
    out.push_back({name + "_dang_van_ever", "1", "largest equivalent stress of Dang Van over its limit, > 1: fatigue",
                   ever(&StressRecord::dang_van) / f.dang_van_limit});
  if (f.has(FatigueMeasure::martensite)) {
    out.push_back({name + "_temperature_C", "degC", "largest of the surface", present(&ContactFatigue::temperature)});
    out.push_back({name + "_over_austenite_ever_K", "K",
                   "largest temperature that has passed, less that of austenite, > 0: martensite may form",
                   largest_of(b.record.temperature) - f.austenite});
  }
}

}  // namespace

bool EvolvedFatigue::has(FatigueMeasure measure) const {
  const std::string word = fmt::format(" {} ", kFatigueMeasures[static_cast<std::size_t>(measure)].word);
  return fmt::format(" {} ", measures).find(word) != std::string::npos;
}

double volume_balance(const EvolvedBody& body) {
  return relative(sum_of(body.record.volume), body.record.volume_by_law);
}

double work_balance(const EvolvedBody& body) {
  return relative(sum_of(body.record.work), body.record.work_of_contacts);
}

void forget_records(Generation& g) {
  g.quantities = quantities_of(g);
  for (EvolvedBody& b : g.bodies) b.record = SurfaceRecord(b.cells.nu, b.fatigue.depths.size(), b.flow.depths.size());
}

std::vector<EvolutionQuantity> quantities_of(const Generation& g) {
  if (!g.quantities.empty()) return g.quantities;
  std::vector<EvolutionQuantity> out{
      {"distance_km", "km", "rolled by the wheel", 1e-3 * g.distance},
      {"passages", "1", "of wheels over the rail", g.passages},
      {"step", "1", "share of the whole, of the step that led here", g.step},
      {"refused_steps", "1", "steps that changed pressures too much", 1.0 * g.refused},
      {"limits_kept", "1", "0: the smallest step changed more", g.limits_kept ? 1.0 : 0.0},
      {"pressure_change", "1", "largest change of a case's largest pressure by the step, as a share",
       g.pressure_change}};
  double pmax = 0.0, pressure = 0.0, t_gamma = 0.0, force = 0.0, doubts = 0.0;
  for (const EvolvedCase& c : g.cases) {
    pmax = std::max(pmax, c.pmax);
    pressure += c.weight * c.pmax;
    t_gamma += c.weight * c.t_gamma;
    force += c.weight * c.fn;
    doubts += c.doubts;
  }
  out.push_back({"pmax_MPa", "MPa", "largest pressure of all positions", 1e-6 * pmax});
  out.push_back({"pmax_mean_MPa", "MPa", "largest pressure, mean of the positions by weight", 1e-6 * pressure});
  out.push_back({"normal_force_N", "N", "normal force, sum over the patches, mean by weight", force});
  out.push_back({"t_gamma_N", "N", "power of friction over rolling speed, mean by weight", t_gamma});
  out.push_back({"doubts", "1", "warnings about contacts", doubts});
  out.insert(out.end(), g.numbers.begin(), g.numbers.end());
  for (const EvolvedBody& b : g.bodies) {
    const std::string name = body_name(b.body);
    // a rail that is the same everywhere is counted by the metre
    const bool by_metre = b.body == Body::rail && b.cells.uniform();
    const std::string per = by_metre ? "_per_m" : "", per_unit = by_metre ? "/m" : "";
    out.push_back({name + "_depth_mm", "mm", "largest depth removed", 1e3 * b.max_depth});
    out.push_back({name + "_slope", "1", "largest slope of the depth across", b.max_slope});
    out.push_back({fmt::format("{}_volume_mm3{}", name, per), fmt::format("mm3{}", per_unit), "volume removed",
                   1e9 * sum_of(b.record.volume)});
    out.push_back(
        {name + "_volume_balance", "1", "volume of the geometry over that of the law, less 1", volume_balance(b)});
    out.push_back({fmt::format("{}_work_J{}", name, per), fmt::format("J{}", per_unit), "work of friction",
                   sum_of(b.record.work)});
    out.push_back(
        {name + "_work_balance", "1", "work on the surface over that of the contacts, less 1", work_balance(b)});
    out.push_back({name + "_pressure_ever_MPa", "MPa",
                   "largest pressure that has passed; the present contacts have not",
                   1e-6 * largest_of(b.record.pressure)});
    out.push_back({name + "_sliding_m", "m", "largest sliding distance of a point", largest_of(b.record.sliding)});
    if (!b.flow.theory.empty()) {
      double strain = 0.0;
      for (const FlowRecord& layer : b.record.flow) strain = std::max(strain, largest_of(layer.strain));
      out.push_back({name + "_raised_mm", "mm", "largest height above the surface as it was", 1e3 * b.flow.max_raised});
      out.push_back({name + "_strain", "1", "largest shear strain that passages have added up at the depths", strain});
    }
    add_fatigue(b, name, out);
    out.insert(out.end(), b.numbers.begin(), b.numbers.end());
  }
  return out;
}

}  // namespace treadmark::io
