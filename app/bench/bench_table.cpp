// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include <algorithm>
#include <array>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "treadmark/app/bench/bench_report.hpp"
#include "treadmark/io/tables/shown.hpp"
#include "treadmark/model/shape/body_name.hpp"

namespace treadmark::app {
namespace {

constexpr std::size_t kColumns = 14;
using Line = std::vector<std::string>;

const std::array<Line, 3> kHead{{
    {"backend", "resolution", "body", "differs", "build", "memory", "height", "tilted", "normal", "base", "search",
     "search", "distance", "patches"},
    {"", "", "", "", "", "", "level", "", "", "level", "cold", "warm", "", ""},
    {"", "[mm]", "", "[um]", "[ms]", "[MB]", "[ns]", "[ns]", "[ns]", "[ns]", "[ms]", "[ms]", "[ms]", ""},
}};

Line cells(const BenchRow& row) {
  Line line{row.backend,
            row.resolution > 0.0 ? io::in_short(1e3 * row.resolution) : "-",
            body_name(row.body),
            row.difference < 1e-9 ? "0" : io::in_short(1e6 * row.difference),  // less is rounding
            io::in_short(1e3 * row.build),
            row.memory_bytes > 0 ? io::in_short(1e-6 * static_cast<double>(row.memory_bytes)) : "-",
            io::in_short(1e9 * row.height),
            io::in_short(1e9 * row.height_tilted),
            io::in_short(1e9 * row.normal),
            io::in_short(1e9 * row.base_height),
            io::in_short(1e3 * row.search_cold),
            io::in_short(1e3 * row.search_warm),
            io::in_short(1e3 * row.distance),
            row.patches >= 0 ? fmt::format("{}", row.patches) : "-"};
  if (!row.agrees) line[3] = "NO";
  return line;
}

std::string row_label(const BenchRow& row) {
  return fmt::format("{}{}, {}", row.backend, row.resolution > 0.0 ? fmt::format(" {:g} mm", 1e3 * row.resolution) : "",
                     body_name(row.body));
}

std::string origin(const BenchReport& report) {
  return fmt::format("{}, {} {}, {}, treadmark {} ({}), {}", report.machine, report.threads,
                     report.threads == 1 ? "thread" : "threads", report.compiler, report.version, report.git,
                     report.date);
}

std::string remarks(const BenchReport& report, const char* before) {
  std::string out;
  for (const BenchRow& row : report.rows)
    if (!row.agrees) out += fmt::format("{}{}: does not agree: {}\n", before, row_label(row), row.reason);
  if (!report.complete) out += fmt::format("{}interrupted: some backends are missing\n", before);
  return out;
}

}  // namespace

std::string bench_table(const BenchReport& report) {
  std::vector<Line> lines(kHead.begin(), kHead.end());
  for (const BenchRow& row : report.rows) lines.push_back(cells(row));
  return origin(report) + "\n\n" + io::table_text(lines, {3, 6, 10}) + remarks(report, "");
}

std::string bench_markdown(const BenchReport& report) {
  std::string out = origin(report) + ".\n\n|";
  for (std::size_t i = 0; i < kColumns; ++i) {
    std::string head = kHead[0][i];
    for (const std::size_t more : {1u, 2u})
      if (!kHead[more][i].empty()) head += " " + kHead[more][i];
    out += " " + head + " |";
  }
  out += "\n|";
  for (std::size_t i = 0; i < kColumns; ++i) out += i == 0 || i == 2 ? "---|" : "--:|";
  out += "\n";
  for (const BenchRow& row : report.rows) {
    out += "|";
    for (const std::string& cell : cells(row)) out += " " + cell + " |";
    out += "\n";
  }
  const std::string more = remarks(report, "* ");
  return more.empty() ? out : out + "\n" + more;
}

}  // namespace treadmark::app
