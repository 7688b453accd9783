// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include <cmath>

#include <fmt/format.h>

#include "treadmark/app/bench/bench_report.hpp"
#include "treadmark/io/json/json_tree.hpp"
#include "treadmark/io/tables/number.hpp"

namespace treadmark::app {
namespace {

using io::Json;

constexpr auto kDigits = Digits::six;  // times have no more

struct Value {
  Json operator()(std::monostate) const { return nullptr; }
  Json operator()(double value) const { return io::number(value, kDigits); }
  Json operator()(std::int64_t value) const { return value; }
  Json operator()(const std::string& value) const { return value; }
};

}  // namespace

std::string bench_json(const BenchReport& report) {
  Json out;
  out["treadmark"] = {
      {"version", report.version}, {"git", report.git}, {"seconds", io::number(report.seconds, kDigits)}};
  out["date"] = report.date;
  out["machine"] = report.machine;
  out["threads"] = report.threads;
  out["compiler"] = report.compiler;
  out["libraries"] = Json::object();
  for (const auto& [name, version] : report.libraries) out["libraries"][name] = version;
  out["input"] = {{"file", report.input_file}, {"sha256", report.input_sha256}};
  out["settings"] = report.settings;
  out["seconds_per_measure"] = io::number(report.seconds_per_measure, kDigits);
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
  return io::dumped(out) + "\n";
}

namespace {

BenchRow row_in(const io::JsonTree& node) {
  BenchRow out;
  out.backend = node.text("backend");
  if (const auto resolution = node.find("resolution_mm")) out.resolution = resolution->number() / 1e3;
  out.body = node.at("body").one_of({"wheel", "rail"}) == 0 ? Body::wheel : Body::rail;
  out.agrees = node.flag("agrees");
  out.reason = node.text("reason");
  out.difference = node.number("difference_um") / 1e6;
  out.build = node.number("build_s");
  out.memory_bytes = node.count("memory_bytes");
  out.points = node.count("points");
  out.height = node.number("ns_per_height") / 1e9;
  out.height_tilted = node.number("ns_per_height_tilted") / 1e9;
  out.normal = node.number("ns_per_normal") / 1e9;
  out.base_height = node.number("base_ns_per_height") / 1e9;
  out.search_cold = node.number("search_cold_s");
  out.search_warm = node.number("search_warm_s");
  out.distance = node.number("distance_s");
  if (const io::JsonTree patches = node.at("patches"); !patches.is_null()) out.patches = patches.integer();
  return out;
}

}  // namespace

BenchReport read_bench(const std::filesystem::path& file) {
  const io::JsonTree root = io::read_json_file(file), made = root.at("treadmark"), input = root.at("input");
  BenchReport out;
  out.version = made.text("version");
  out.git = made.text("git");
  out.seconds = made.number("seconds");
  out.date = root.text("date");
  out.machine = root.text("machine");
  out.threads = root.at("threads").integer();
  out.compiler = root.text("compiler");
  for (const auto& [name, version] : root.at("libraries").entries()) out.libraries.emplace_back(name, version.text());
  out.input_file = input.text("file");
  out.input_sha256 = input.text("sha256");
  out.settings = root.at("settings").texts();
  out.seconds_per_measure = root.number("seconds_per_measure");
  out.truth = root.text("truth");
  out.complete = root.flag("complete");
  for (const io::JsonTree& node : root.at("rows").items()) out.rows.push_back(row_in(node));
  return out;
}

}  // namespace treadmark::app
