// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/io/histories/evolution_model.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "treadmark/model/shape/body_name.hpp"

namespace treadmark {
namespace {

using G = io::Generation;
using B = io::EvolvedBody;
using C = io::EvolvedCase;
using access::of;
using access::within;
using unit::kOne;

constexpr FileUnit kPerMetre{"mm3/m", 1e9, "m3/m"}, kWorkPerMetre{"J/m"};
constexpr unsigned kTableAndCards = kInTable | kInCards, kEverywhere = kInTable | kInChart | kInCards;

double relative(double found, double expected) { return expected != 0.0 ? found / expected - 1.0 : found; }

/// Sum over the cases of a generation, by weight.
template <double C::*number>
double mean(const G& g) {
  double sum = 0.0;
  for (const C& c : g.cases) sum += c.weight * c.*number;
  return sum;
}

double largest_pressure(const G& g) {
  double most = 0.0;
  for (const C& c : g.cases) most = std::max(most, c.pmax);
  return most;
}

double doubts(const G& g) {
  double sum = 0.0;
  for (const C& c : g.cases) sum += c.doubts;
  return sum;
}

double largest_strain(const B& b) {
  double most = 0.0;
  for (const FlowRecord& layer : b.record.flow) most = std::max(most, layer.strain.largest());
  return most;
}

double volume(const B& b) { return b.record.volume.sum(); }
double work(const B& b) { return b.record.work.sum(); }

/// A rail that is the same everywhere is counted by the metre.
bool by_metre(const B& b) { return b.body == Body::rail && b.cells.uniform(); }
bool as_a_whole(const B& b) { return !by_metre(b); }
bool flows(const B& b) { return !b.flow.theory.empty(); }

// A row of a table stays a row: clang-format would give each column a line.
// clang-format off
constexpr Column<G> kGenerationColumns[] = {
    {"", kOne, "number", of<&G::number>()},
    {"", kOne, "progress", of<&G::progress>()},
    {"distance_km", unit::kKm, "distance", of<&G::distance>(), "rolled by the wheel", kTableAndCards},
    {"passages", kOne, "passages", of<&G::passages>(), "of wheels over the rail", kTableAndCards},
    {"", kOne, "next_step", of<&G::next_step>()},
    {"step", kOne, "step", of<&G::step>(), "share of the whole, of the step that led here", kInChart},
    {"refused_steps", kOne, "refused", of<&G::refused>(), "steps that changed pressures too much"},
    {"limits_kept", kOne, "limits_kept", of<&G::limits_kept>(), "0: the smallest step changed more"},
    {"pressure_change", kOne, "pressure_change", of<&G::pressure_change>(),
     "largest change of a case's largest pressure by the step, as a share", kInChart},
    {"pmax_MPa", unit::kMPa, "", {largest_pressure}, "largest pressure of all positions", kEverywhere},
    {"pmax_mean_MPa", unit::kMPa, "", {mean<&C::pmax>}, "largest pressure, mean of the positions by weight", kInChart},
    {"normal_force_N", unit::kN, "", {mean<&C::fn>}, "normal force, sum over the patches, mean by weight", kInChart},
    {"t_gamma_N", unit::kN, "", {mean<&C::t_gamma>}, "power of friction over rolling speed, mean by weight",
     kInTable | kInChart},
    {"doubts", kOne, "", {doubts}, "warnings about contacts"}};

constexpr Column<B> kBodyColumns[] = {
    {"", kOne, "law", of<&B::law>()},
    {"", kOne, "source", of<&B::source>()},
    {"", kOne, "u0", within<&B::cells, &SurfaceCells::u0>()},
    {"", kOne, "du", within<&B::cells, &SurfaceCells::du>()},
    {"", kOne, "nu", within<&B::cells, &SurfaceCells::nu>()},
    {"", kOne, "y0", within<&B::cells, &SurfaceCells::y0>()},
    {"", kOne, "dy", within<&B::cells, &SurfaceCells::dy>()},
    {"", kOne, "ny", within<&B::cells, &SurfaceCells::ny>()},
    {"depth_mm", unit::kMm, "max_depth", of<&B::max_depth>(), "largest depth removed", kEverywhere},
    {"slope", kOne, "max_slope", of<&B::max_slope>(), "largest slope of the depth across", kInChart},
    {"", kOne, "surface_file", of<&B::surface_file>()},
    {"", kOne, "volume_by_law", within<&B::record, &SurfaceRecord::volume_by_law>()},
    {"", kOne, "work_of_contacts", within<&B::record, &SurfaceRecord::work_of_contacts>()},
    {"volume_mm3", unit::kMm3, "", {volume, nullptr, as_a_whole}, "volume removed", kInTable | kInChart},
    {"volume_mm3_per_m", kPerMetre, "", {volume, nullptr, by_metre}, "volume removed", kInTable | kInChart},
    {"volume_balance", kOne, "", {io::volume_balance}, "volume of the geometry over that of the law, less 1"},
    {"work_J", unit::kJ, "", {work, nullptr, as_a_whole}, "work of friction", kInChart},
    {"work_J_per_m", kWorkPerMetre, "", {work, nullptr, by_metre}, "work of friction", kInChart},
    {"work_balance", kOne, "", {io::work_balance}, "work on the surface over that of the contacts, less 1"},
    {"pressure_ever_MPa", unit::kMPa, "", {[](const B& b) { return b.record.pressure.largest(); }},
     "largest pressure that has passed; the present contacts have not", kInChart},
    {"sliding_m", unit::kM, "", {[](const B& b) { return b.record.sliding.largest(); }},
     "largest sliding distance of a point", kInChart},
    {"raised_mm", unit::kMm, "", {[](const B& b) { return b.flow.max_raised; }, nullptr, flows},
     "largest height above the surface as it was", kInChart | kInCards},
    {"strain", kOne, "", {largest_strain, nullptr, flows},
     "largest shear strain that passages have added up at the depths", kInChart}};

constexpr Column<C> kCaseColumns[] = {
    {"", kOne, "run", of<&C::run>(), "position"},
    {"position", kOne, "label", of<&C::label>(), "of the position"},
    {"case", kOne, "number", of<&C::number>(), "case of the position"},
    {"weight", kOne, "weight", of<&C::weight>(), "share"},
    {"status", kOne, "status", of<&C::status>(), "of the case"},
    {"patches", kOne, "patches", of<&C::patches>(), "of contact"},
    {"remarks", kOne, "remarks", of<&C::remarks>(), "of the case"},
    {"doubts", kOne, "doubts", of<&C::doubts>(), "grave ones of them"},
    {"fn_N", unit::kN, "fn", of<&C::fn>(), "sum over the patches"},
    {"fx_N", unit::kN, "fx", of<&C::fx>(), "on the rail, sum over the patches"},
    {"fs_N", unit::kN, "fs", of<&C::fs>(), "on the rail, sum over the patches"},
    {"pmax_MPa", unit::kMPa, "pmax", of<&C::pmax>(), "largest pressure"},
    {"t_gamma_N", unit::kN, "t_gamma", of<&C::t_gamma>(), "power of friction over rolling speed"}};
// clang-format on

/// What is known of a row, its keys behind a prefix.
template <class Row>
void add_known(std::vector<io::EvolutionQuantity>& out, const std::string& prefix, const Row& row,
               std::span<const Column<Row>> columns) {
  for (const Column<Row>& column : columns)
    if (!column.key.empty() && column.known(row))
      out.push_back({prefix + std::string(column.key), std::string(column.unit.name), std::string(column.meaning),
                     column.in_file(row), column.shown});
}

}  // namespace

template <>
std::span<const Column<io::Generation>> columns() {
  return kGenerationColumns;
}
template <>
std::span<const Column<io::EvolvedBody>> columns() {
  return kBodyColumns;
}
template <>
std::span<const Column<io::EvolvedCase>> columns() {
  return kCaseColumns;
}

namespace io {

double volume_balance(const EvolvedBody& body) { return relative(volume(body), body.record.volume_by_law); }

double work_balance(const EvolvedBody& body) { return relative(work(body), body.record.work_of_contacts); }

void forget_records(Generation& g) {
  g.quantities = quantities_of(g);
  for (EvolvedBody& b : g.bodies)
    b.record = SurfaceRecord(b.cells.nu, b.fatigue.known.depths.size(), b.flow.depths.size());
}

double doubts_of(const EvolutionResult& result) {
  double sum = 0.0;
  for (const Generation& g : result.generations) {
    sum += doubts(g);
    for (const EvolutionQuantity& q : g.numbers)
      if (q.name == "doubtful_steps") sum += q.value;
  }
  return sum;
}

std::vector<EvolutionQuantity> quantities_of(const Generation& g) {
  if (!g.quantities.empty()) return g.quantities;
  std::vector<EvolutionQuantity> out;
  add_known(out, "", g, columns<Generation>());
  out.insert(out.end(), g.numbers.begin(), g.numbers.end());
  for (const EvolvedBody& b : g.bodies) {
    const std::string prefix = fmt::format("{}_", body_name(b.body));
    add_known(out, prefix, b, columns<EvolvedBody>());
    const FatigueState state{b.fatigue.known, b.fatigue.contacts, b.record};
    if (!state.contacts.empty())
      for (const FatigueMeasureRow& row : fatigue_measures())
        if (state.known.has(row.measure)) add_known<FatigueState>(out, prefix, state, row.of_body);
    out.insert(out.end(), b.numbers.begin(), b.numbers.end());
  }
  return out;
}

}  // namespace io
}  // namespace treadmark
