// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/app/simulation/history_summary.hpp"

#include <algorithm>
#include <string>

namespace treadmark::app {

HistorySummary::HistorySummary(const BuiltVehicle& built, const vehicle::Simulation& simulation)
    : simulation_(simulation), watched_(built.watched_wheel()), has_pressure_(built.full[watched_] != nullptr) {}

void HistorySummary::note() {
  const vehicle::ContactReaction& r = simulation_.reactions()[watched_];
  const double time = simulation_.state().time, q = r.on_rail.force.z();
  // The first of equal ones counts.
  const auto larger = [&](Extreme& e, double value) {
    if (!begun_ || value > e.value) e = {value, time};
  };
  const auto smaller = [&](Extreme& e, double value) {
    if (!begun_ || value < e.value) e = {value, time};
  };
  larger(highest_, q);
  smaller(lowest_, q);
  larger(ty_max_, r.lateral_creep_force);
  smaller(ty_min_, r.lateral_creep_force);
  larger(pmax_, r.max_pressure);
  if (!begun_) at_rest_ = q;
  begun_ = true;
}

std::vector<io::NamedValue> HistorySummary::values() const {
  std::vector<io::NamedValue> summary;
  if (!begun_) return summary;
  const auto add = [&](const char* name, double value, const char* unit, const char* description) {
    summary.push_back({name, value, unit, description});
  };
  add("q_max_N", highest_.value, "N", "largest vertical force");
  add("q_max_t_s", highest_.time, "s", "when");
  add("q_max_x_m", highest_.time * simulation_.vehicle().speed, "m", "where");
  add("q_min_N", lowest_.value, "N", "least vertical force");
  add("q_static_N", at_rest_, "N", "vertical force at the start");
  add("q_max_over_static", highest_.value / at_rest_, "1", "largest vertical force over that at the start");
  add("ty_max_N", ty_max_.value, "N", "largest lateral creep force");
  add("ty_min_N", ty_min_.value, "N", "least lateral creep force");
  if (has_pressure_) add("pmax_Pa", pmax_.value, "Pa", "largest contact pressure");
  add("contact_lost",
      static_cast<double>(std::ranges::count(simulation_.events(), false, &vehicle::ContactEvent::regained)), "1",
      "how often a wheel lost contact");
  const vehicle::EnergyBalance &e = simulation_.energy(), &start = simulation_.energy_at_start();
  const double turnover = std::max(e.turnover, 1e-300);
  add("energy_turnover_J", e.turnover, "J", "work of contacts and dampers, all counted positive");
  add("energy_integration_error", e.integration_error(start) / turnover, "1", "over the turnover");
  add("energy_contact_error", e.contact_error(start) / turnover, "1", "over the turnover");
  add("steps", static_cast<double>(simulation_.counts().steps), "1", "accepted time steps");
  add("steps_rejected", static_cast<double>(simulation_.counts().rejected), "1", "time steps that were repeated");
  add("contact_rounds", static_cast<double>(simulation_.counts().evaluations), "1", "evaluations of all contacts");
  return summary;
}

void HistorySummary::save(ByteWriter& out) const {
  out.put(begun_);
  out.put(at_rest_);
  for (const Extreme* e : {&highest_, &lowest_, &ty_max_, &ty_min_, &pmax_}) out.put(e->value), out.put(e->time);
}

void HistorySummary::restore(ByteReader& in) {
  in.get(begun_);
  in.get(at_rest_);
  for (Extreme* e : {&highest_, &lowest_, &ty_max_, &ty_min_, &pmax_}) in.get(e->value), in.get(e->time);
}

}  // namespace treadmark::app
