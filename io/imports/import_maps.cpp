// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/io/imports/import_maps.hpp"

#include <fmt/format.h>

#include <cmath>
#include <span>

#include "treadmark/core/error.hpp"
#include "treadmark/core/to_whole.hpp"
#include "treadmark/io/hdf5/hdf5_reader.hpp"
#include "treadmark/io/hdf5/hdf5_writer.hpp"
#include "treadmark/io/imports/import_words.hpp"

namespace treadmark::io {
namespace {

constexpr const char* kFormat = "treadmark import maps 1";

struct MapName {
  const char* group;
  const char* unit;
  const char* meaning;
  BandMap ImportReport::*map;
};

constexpr MapName kMaps[] = {
    {"density", "1/m^2", "points before cleaning", &ImportReport::density},
    {"removed", "1/m^2", "points that were removed", &ImportReport::removed_map},
    {"fitted", "m", "distance of the fitted surface from its section, positive out of the material",
     &ImportReport::fitted},
    {"residual", "m", "mean of measured less fitted", &ImportReport::residual},
    {"noise", "m", "standard deviation of the points", &ImportReport::noise_map},
    {"error", "m", "standard deviation of the surface, by all that is known of its errors", &ImportReport::error_map},
    {"truth", "m", "the surface less the reference, best aligned", &ImportReport::truth_map},
};

using Cloud = ImportReport::CloudSample;
struct CloudColumn {
  const char* name;
  const char* unit;
  const char* meaning;
  std::vector<float> Cloud::*values;
};

constexpr CloudColumn kCloud[] = {
    {"x", "m", "in the frame of the surface", &Cloud::x},
    {"y", "m", "in the frame of the surface", &Cloud::y},
    {"z", "m", "in the frame of the surface", &Cloud::z},
    {"residual", "m", "measured less fitted; NaN: removed", &Cloud::residual},
    {"distance", "m", "from the section, positive out of the material; NaN: removed", &Cloud::distance},
    {"tilt", "rad", "of the section's normal from straight out towards +y; NaN: removed", &Cloud::tilt},
};
constexpr const char* kPoints = "points";

struct CloudCount {
  const char* name;
  const char* meaning;
  std::size_t Cloud::*count;
};
constexpr CloudCount kCounts[] = {
    {"of", "points that these are some of", &Cloud::all},
    {"of_removed", "removed ones among them", &Cloud::removed},
    {"far", "removed points that are not among these: too far from all others", &Cloud::far},
};

std::vector<double> edges(double from, double to, std::size_t cells) {
  std::vector<double> out;
  for (std::size_t i = 0; i < cells; ++i)
    out.push_back(from + (to - from) * static_cast<double>(i) / static_cast<double>(cells));
  out.push_back(to);
  return out;
}

[[noreturn]] void refuse(const std::filesystem::path& file, const std::string& what) {
  throw Error(ErrorKind::input_data, "the file of maps " + what, {file.string(), 0, 0},
              "give a file that this program wrote");
}

/// Ends and number of cells of equal size.
void read_edges(const std::filesystem::path& file, const Hdf5GroupReader& group, const char* name, double& from,
                double& to, std::size_t& cells) {
  const std::vector<double> values = group.numbers(name);
  if (values.size() < 2) refuse(file, fmt::format("has no cells in {}", name));
  cells = values.size() - 1;
  from = values.front();
  to = values.back();
  const std::vector<double> wanted = edges(from, to, cells);
  const double step = (to - from) / static_cast<double>(cells);
  for (std::size_t i = 0; i < values.size(); ++i)
    if (!(step > 0.0 && std::fabs(values[i] - wanted[i]) <= 1e-6 * step))
      refuse(file, fmt::format("has cells of unequal size in {}", name));
}

BandMap read_map(const std::filesystem::path& file, const Hdf5GroupReader& group, const char* name) {
  BandMap map;
  read_edges(file, group, "a_edges", map.a_min, map.a_max, map.rows);
  read_edges(file, group, "s_edges", map.s_min, map.s_max, map.columns);
  const std::vector<double> values = group.numbers("value");
  if (values.size() / map.columns != map.rows || values.size() % map.columns != 0)
    refuse(file, fmt::format("has {} values for {} times {} cells in {}", values.size(), map.rows, map.columns, name));
  map.value.reserve(values.size());
  for (const double value : values) map.value.push_back(static_cast<float>(value));
  return map;
}

}  // namespace

void write_import_maps(const std::filesystem::path& path, const ImportReport& report) {
  Hdf5Writer file(path);
  file.root().add(Attribute{"format", std::string(kFormat)});
  file.root().add(Attribute{"body", std::string(body_name(report.body))});
  file.root().write({"nominal_radius", {}, "m", "of a wheel, else 0"},
                    std::span<const double>(&report.nominal_radius, 1));
  for (const MapName& name : kMaps) {
    const BandMap& map = report.*name.map;
    if (map.value.empty()) continue;
    const Hdf5GroupWriter group = file.root().make_group(name.group);
    const std::vector<double> a = edges(map.a_min, map.a_max, map.rows), s = edges(map.s_min, map.s_max, map.columns);
    group.write(
        {"a_edges", {a.size()}, "m", "of the rows: along the track, or the circumference at the nominal radius"}, a);
    group.write({"s_edges", {s.size()}, "m", "of the columns: along the section"}, s);
    const std::vector<double> values(map.value.begin(), map.value.end());
    group.write({"value", {map.rows, map.columns}, name.unit, name.meaning, true}, values);
  }
  if (!report.cloud.x.empty()) {
    const Hdf5GroupWriter group = file.root().make_group(kPoints);
    for (const CloudCount& count : kCounts) {
      const auto value = static_cast<double>(report.cloud.*count.count);
      group.write({count.name, {}, "1", count.meaning}, std::span<const double>(&value, 1));
    }
    for (const CloudColumn& column : kCloud) {
      const std::vector<float>& values = report.cloud.*column.values;
      group.write({column.name, {values.size()}, column.unit, column.meaning, true},
                  std::vector<double>(values.begin(), values.end()));
    }
  }
  file.commit();
}

namespace {

Cloud read_cloud(const std::filesystem::path& file, const Hdf5GroupReader& group) {
  Cloud cloud;
  for (const CloudCount& count : kCounts) {
    const std::vector<double> values = group.numbers(count.name);
    constexpr double kMost = 1e15;
    if (values.size() != 1 || !(values.front() >= 0.0 && values.front() <= kMost))
      refuse(file, fmt::format("has no count {} of points", count.name));
    cloud.*count.count = to_whole<std::size_t>(values.front());
  }
  for (const CloudColumn& column : kCloud) {
    const std::vector<double> values = group.numbers(column.name);
    (cloud.*column.values).assign(values.begin(), values.end());
    if (values.size() != cloud.x.size())
      refuse(file, fmt::format("has {} of points where {} have x", values.size(), cloud.x.size()));
  }
  return cloud;
}

}  // namespace

void read_import_maps(const std::filesystem::path& path, ImportReport& report) {
  const Hdf5Reader file(path);
  const Hdf5GroupReader& root = file.root();
  if (const std::string format = root.text("format"); format != kFormat)
    refuse(path, fmt::format("holds \"{}\" where \"{}\" is read", format, kFormat));
  if (const std::string body = root.text("body"); body != body_name(report.body))
    refuse(path, fmt::format("is of \"{}\"", body));
  const std::vector<double> radius = root.numbers("nominal_radius");
  if (radius.size() != 1) refuse(path, "has no nominal radius");
  report.nominal_radius = radius.front();
  for (const MapName& name : kMaps)
    if (root.has(name.group)) report.*name.map = read_map(path, root.open_group(name.group), name.group);
  if (root.has(kPoints)) report.cloud = read_cloud(path, root.open_group(kPoints));
}

ImportReport read_import_report(const std::filesystem::path& folder) {
  ImportReport report = read_import_json(folder / "report.json");
  const auto is_there = [&](const char* name) {
    std::error_code code;
    return std::filesystem::is_regular_file(folder / name, code);
  };
  if (is_there("maps.h5")) read_import_maps(folder / "maps.h5", report);
  if (is_there("times.json")) read_import_times(folder / "times.json", report);
  return report;
}

}  // namespace treadmark::io
