// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/app/bench/bench_report.hpp"
#include "treadmark/io/tables/json_of.hpp"
#include "treadmark/io/tables/read_json.hpp"
#include "treadmark/io/tables/schema_of.hpp"

namespace treadmark::app {
namespace {

using io::Json;

constexpr auto kDigits = Digits::six;  // times have no more

constexpr const char* kBenchSchema =
#include "treadmark/app/bench/bench.schema.json.in"
    ;

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
  for (const auto& [name, value] : report.inputs) out["input"]["values"][name] = value;
  out["settings"] = report.settings;
  out["seconds_per_measure"] = io::number(report.seconds_per_measure, kDigits);
  out["truth"] = report.truth;
  out["complete"] = report.complete;
  out["rows"] = io::json_of(report.rows, kDigits);
  return io::dumped(out) + "\n";
}

std::string bench_schema() { return io::filled_schema(kBenchSchema, {{"row", io::schema_rows<BenchRow>()}}); }

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
  if (const auto values = input.find("values"))
    for (const auto& [name, value] : values->entries()) out.inputs.emplace_back(name, value.text());
  out.settings = root.at("settings").texts();
  out.seconds_per_measure = root.number("seconds_per_measure");
  out.truth = root.text("truth");
  out.complete = root.flag("complete");
  for (const io::JsonTree& node : root.at("rows").items()) {
    BenchRow& row = out.rows.emplace_back();
    io::read_json(node, row);
    row.body = node.at("body").one_of({"wheel", "rail"}) == 0 ? Body::wheel : Body::rail;
    if (const io::JsonTree patches = node.at("patches"); !patches.is_null()) row.patches = patches.integer();
  }
  return out;
}

}  // namespace treadmark::app
