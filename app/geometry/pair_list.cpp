// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include <fmt/format.h>

#include <cmath>
#include <filesystem>
#include <optional>

#include "treadmark/app/geometry/geometry_run.hpp"
#include "treadmark/core/constants.hpp"
#include "treadmark/core/error.hpp"
#include "treadmark/core/number_text.hpp"
#include "treadmark/io/files/text.hpp"

namespace treadmark::app {
namespace {

using PairKey = io::SettingKey<GeometryRequest>;

/// The key of a column; nullptr: the name of the pair.
const PairKey* key_of(const std::string& column, const SourcePosition& where) {
  if (column == "name") return nullptr;
  std::string names = "name";
  for (const PairKey& key : geometry_keys().rows) {
    if ((key.factors & kOfPair) == 0) continue;
    if (key.info.path == column) return &key;
    names += ", " + key.info.path;
  }
  throw Error(ErrorKind::input_data, fmt::format("'{}' is no column of a list of pairs", column), where,
              "the first line names the columns: " + names);
}

/// A name in the list: a file beside it, or the name of a profile.
std::string resolved(const std::filesystem::path& folder, const std::string& cell) {
  const std::filesystem::path file = io::profiles::portable_path(cell);
  return !file.is_absolute() && std::filesystem::exists(folder / file) ? (folder / file).string() : cell;
}

void set_cell(GeometryRequest& request, const PairKey* key, const std::string& cell,
              const std::filesystem::path& folder, const SourcePosition& where) {
  if (key == nullptr) {
    request.label = cell;
    return;
  }
  io::CaseValue value{where, (key->factors & kFileOfPair) == kFileOfPair ? resolved(folder, cell) : cell};
  if (key->info.type == io::KeyType::number) {
    const std::optional<double> number = finite_number(cell);
    if (!number)
      throw Error(ErrorKind::input_data, fmt::format("'{}' is no number for {}", cell, key->info.path), where);
    value.data = *number;
  }
  io::check_value(key->info, value);
  // one of the two places the rails
  const void* member = key->member(request);
  if (member == &request.gauge) request.rail_origins.reset();
  if (member == &request.rail_origins) request.gauge.reset();
  key->set(request, value, {});
}

}  // namespace

std::vector<GeometryRequest> read_pair_list(const std::string& file, const GeometryRequest& usual) {
  const std::string text = io::profiles::read_text(file, "list of pairs", {});
  const std::filesystem::path folder = std::filesystem::path(file).parent_path();
  std::vector<const PairKey*> columns;
  std::vector<GeometryRequest> out;
  int number = 0;
  for (std::size_t at = 0; at < text.size();) {
    const std::size_t end = std::min(text.find('\n', at), text.size());
    const std::string line = text.substr(at, end - at);
    at = end + 1;
    ++number;
    if (line.find_first_not_of(" \t\r") == std::string::npos || line.front() == '#') continue;
    const std::vector<std::string> cells = io::csv_cells(line);
    const SourcePosition where{file, number, 0};
    if (columns.empty()) {
      for (const std::string& cell : cells) columns.push_back(key_of(cell, where));
      continue;
    }
    if (cells.size() > columns.size())
      throw Error(
          ErrorKind::input_data,
          fmt::format("the line has more cells ({}) than the list has columns ({})", cells.size(), columns.size()),
          where);
    GeometryRequest request = usual;
    for (std::size_t k = 0; k < cells.size(); ++k)
      if (!cells[k].empty()) set_cell(request, columns[k], cells[k], folder, where);
    if (request.label.empty()) request.label = fmt::format("{}", out.size() + 1);
    out.push_back(std::move(request));
  }
  if (out.empty()) throw Error(ErrorKind::input_data, "there are no pairs in the list", {file});
  return out;
}

ResultList run_pairs(const std::vector<GeometryRequest>& requests, const std::filesystem::path& kept,
                     const Progress& progress) {
  ResultList list;
  list.title = "Contact geometry of pairs";
  list.things = "pairs";
  list.words = {"wheel", "wheel_left", "rail", "rail_left"};
  for (const Column<GeometryResult>& column : columns<GeometryResult>())
    if (!column.listed.empty()) list.numbers.push_back({std::string(column.listed), (column.shown & kInTable) != 0});
  if (!requests.empty()) {
    const geometry::AnalysisSettings& s = requests.front().settings;
    list.settings = io::settings_text(geometry_keys(), requests.front(), geometry_request({}), kOfPair);
    for (const double a : s.amplitudes)
      list.numbers.push_back({fmt::format("tan_gamma_e_at_{:g}mm", kMilli * a), false});
  }
  SectionStore store;
  ListWork work;
  work.count = requests.size();
  work.name = [&](std::size_t i) { return requests[i].label; };
  work.sources = [&](std::size_t i) {
    const GeometryRequest& r = requests[i];
    return std::vector<std::string>{r.label, r.wheel,     r.wheel_left,
                                    r.rail,  r.rail_left, io::written_lines(geometry_keys(), r)};
  };
  work.make = [&](std::size_t i) {
    GeometryRequest request = requests[i];
    request.settings.second = 0.0;
    request.settings.harmonic = false;
    ListRow row{request.label, "ok", {}, {request.wheel, request.wheel_left, request.rail, request.rail_left}};
    try {
      const GeometryResult result = run_geometry(request, store);
      for (const Column<GeometryResult>& column : columns<GeometryResult>())
        if (!column.listed.empty()) row.numbers.push_back(column.in_file(result));
      for (const geometry::Conicity& c : result.analysis.conicity) row.numbers.push_back(c.tan_gamma);
      row.badness = result.analysis.single.tan_gamma;
    } catch (const Error& error) {
      row.status = "failed";
      row.error = error.what();
    }
    return row;
  };
  make_rows(list, work, kept, progress);
  return list;
}

}  // namespace treadmark::app
