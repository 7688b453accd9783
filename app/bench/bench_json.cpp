// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include <cmath>
#include <nlohmann/json.hpp>

#include <fmt/format.h>

#include "treadmark/app/bench/bench_report.hpp"

namespace treadmark::app {
namespace {

using Json = nlohmann::ordered_json;

/// Six significant digits: times have no more.
Json real(double value) {
  if (!std::isfinite(value)) return nullptr;
  return Json::parse(fmt::format("{:.6g}", value));
}

struct Value {
  Json operator()(std::monostate) const { return nullptr; }
  Json operator()(double value) const { return real(value); }
  Json operator()(std::int64_t value) const { return value; }
  Json operator()(const std::string& value) const { return value; }
};

}  // namespace

std::string bench_json(const BenchReport& report) {
  Json out;
  out["treadmark"] = {{"version", report.version}, {"git", report.git}, {"seconds", real(report.seconds)}};
  out["date"] = report.date;
  out["machine"] = report.machine;
  out["threads"] = report.threads;
  out["compiler"] = report.compiler;
  out["libraries"] = Json::object();
  for (const auto& [name, version] : report.libraries) out["libraries"][name] = version;
  out["input"] = {{"file", report.input_file}, {"sha256", report.input_sha256}};
  out["settings"] = report.settings;
  out["seconds_per_measure"] = real(report.seconds_per_measure);
  out["truth"] = report.truth;
  out["complete"] = report.complete;
  out["rows"] = Json::array();
  for (const BenchRow& row : report.rows) {
    Json item;
    for (const io::NamedField& field : bench_fields(row)) {
      Json value = std::visit(Value{}, field.value);
      if (field.name == "agrees") value = row.agrees;
      item[std::string(field.name)] = std::move(value);
    }
    out["rows"].push_back(std::move(item));
  }
  return out.dump(1, ' ', false, Json::error_handler_t::replace) + "\n";
}

}  // namespace treadmark::app
