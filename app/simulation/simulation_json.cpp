// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include <nlohmann/json.hpp>

#include "treadmark/app/simulation/simulation_outputs.hpp"
#include "treadmark/core/parallel.hpp"

namespace treadmark::app {
namespace {

using Json = nlohmann::ordered_json;

Json named(const std::vector<io::NamedValue>& values) {
  Json out = Json::object();
  for (const io::NamedValue& v : values) out[v.name] = v.value;
  return out;
}

}  // namespace

std::string to_json(const io::SimulationResult& r, const SimulationTimes& t) {
  Json out;
  out["treadmark"] = {{"version", r.version}, {"git", r.git}, {"threads", thread_count()}};
  out["input"] = {{"file", r.input_file}, {"sha256", r.input_sha256}, {"settings", r.settings}};
  for (const auto& [file, hash] : r.geometry_sha256) out["input"]["geometry"][file] = hash;
  out["title"] = r.title;
  out["status"] = r.status;
  out["message"] = r.message;
  out["static"] = named(r.statics);
  out["summary"] = named(r.summary);
  out["modes"] = Json::array();
  for (const io::ModeRow& m : r.modes)
    out["modes"].push_back({{"frequency_Hz", m.frequency_Hz}, {"damping_ratio", m.damping_ratio}, {"shape", m.shape}});
  out["events"] = Json::array();
  for (const io::HistoryEvent& e : r.events)
    out["events"].push_back({{"t_s", e.time}, {"x_m", e.position}, {"wheel", e.wheel}, {"kind", e.kind}});
  out["rows"] = r.rows();
  out["timing"] = {{"build_s", t.build_s},
                   {"equilibrium_s", t.equilibrium_s},
                   {"modes_s", t.modes_s},
                   {"integration_s", t.integration_s},
                   {"search_s", t.contact.search_s},
                   {"distance_s", t.contact.distance_s},
                   {"normal_s", t.contact.normal_s},
                   {"tangential_s", t.contact.tangential_s},
                   {"contact_solutions", t.contact.searches}};
  return out.dump(2) + '\n';
}

}  // namespace treadmark::app
