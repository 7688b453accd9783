// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
// Files to start from. What a key means is said by the schema of its file, which is that of the reader.
#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <iostream>
#include <span>
#include <sstream>
#include <stdexcept>
#include <string_view>

#include "treadmark/app/cli/command_frame.hpp"
#include "treadmark/core/error.hpp"
#include "treadmark/core/output_file.hpp"
#include "treadmark/core/platform/ranges.hpp"
#include "treadmark/io/cases/case_keys.hpp"
#include "treadmark/io/files/replaced.hpp"
#include "treadmark/io/tables/number.hpp"

namespace treadmark::cli {
namespace {

// Of the texts every "key = value" gets the meaning of the key, and "#key" also its default. FILE and STEM stand for
// the name of the file and what it is without ending.

constexpr const char* kCase = R"(# A wheel on a rail, at some positions across the track.
#   treadmark check FILE -o STEM-check       what is understood, wheel over rail as pictures
#   treadmark run FILE --report STEM.html    solves it; the report opens in any browser
title = "My first case"

# Profiles: y to the right and z down, in mm unless scaled; a wheel's flange lies at y < 0.
[wheel]
shape.standard = "S1002"
#shape.file = "wheel.csv"

[rail]
shape.standard = "60E1"
#shape.file = "rail.csv"

[track]
gauge_mm = 1435.0
cant = "1:40"

[wheelset]
nominal_radius_mm = 460.0
flange_back_distance_mm = 1360.0
flange_back_position_mm = -70.0
vertical_force_N = 100e3
velocity_km_h = 100.0
rolling = "nominal"
#yaw_deg

[friction]
coefficient = 0.3

[discretisation]
#dx_mm
#ds_mm

# A list makes one case for each of its values.
[[cases]]
wheelset.y_mm = [-2.0, 0.0, 2.0, 4.0]
)";

constexpr const char* kStudy =
    R"(# Runs that differ in some keys, on all cores; the same command goes on after an interruption.
#   treadmark check FILE
#   treadmark sweep FILE -o STEM --report STEM.html
[study]
title = "My first study"
base = "case.toml"

# All combinations of the variations, the last one fastest. --set takes the same keys.
[[study.vary]]
key = "wheelset.vertical_force_N"
label = "load [N]"
values = [60e3, 80e3, 100e3, 120e3]

[[study.vary]]
key = "friction.coefficient"
values = [0.2, 0.4]

[[study.figures]]
file = "pressure.svg"
kind = "summary"
x = "wheelset.vertical_force_N"
y = ["pmax_Pa"]
series = "friction.coefficient"
)";

constexpr const char* kVehicle =
    R"(# A wheelset below a guided load. The numbers are of no real vehicle: put in those of yours.
#   treadmark check FILE
# x forward, y to the right, z down from the tops of the rails.
[vehicle]
name = "One wheelset below a guided load"
source = "invented"

[[bodies]]
name = "load"
mass_kg = 9000.0
position_m = [0.0, 0.0, -1.0]
free = ["z"]

[[bodies]]
name = "wheelset"
mass_kg = 1800.0
inertia_kg_m2 = [1100.0, 110.0, 1100.0]
position_m = [0.0, 0.0, -0.46]
free = ["x", "y", "z", "roll", "pitch", "yaw"]

[[wheelsets]]
body = "wheelset"
nominal_radius_mm = 460.0

[[springs]]
name = "primary"
between = ["wheelset", "load"]
at_m = [[0.0, -1.0, -0.46], [0.0, 1.0, -0.46]]
stiffness_N_per_m = [30e6, 4e6, 1.2e6]
damping_N_s_per_m = [15e3, 2e3, 4e3]
)";

constexpr const char* kTrack =
    R"(# Two rails on springs that move along below each wheelset. The numbers are of no real track: put in those of yours.
#   treadmark check FILE
#   treadmark track FILE -o STEM             how it gives way
[track]
name = "Two rails on springs"
source = "invented"
rails = ["left_rail", "right_rail"]

[[bodies]]
name = "left_rail"
mass_kg = 80.0
position_m = [0.0, -0.7535, 0.09]
free = ["y", "z"]

[[bodies]]
name = "right_rail"
mass_kg = 80.0
position_m = [0.0, 0.7535, 0.09]
free = ["y", "z"]

[[springs]]
name = "bed"
stiffness_N_per_m = [0.0, 30e6, 100e6]
damping_N_s_per_m = [0.0, 150e3, 150e3]
places = [
  { between = ["ground", "left_rail"], at_m = [[0.0, -0.7535, 0.17]] },
  { between = ["ground", "right_rail"], at_m = [[0.0, 0.7535, 0.17]] },
]
)";

constexpr const char* kSimulation = R"(# A vehicle on its track in time: its right wheel has a flat.
#   treadmark check FILE
#   treadmark simulate FILE -o STEM --report STEM.html
title = "My first simulation"

[simulation]
vehicle = "vehicle.toml"
track = "track.toml"
speed_km_h = 80.0
distance_m = 1.0

# Wheels with contact in full, step by step; that of all others comes from a table.
[[simulation.wheels]]
wheelset = 1
side = "right"
contact = "full"
pitch_deg = 20.0

[case]
regime = "transient"

[wheel]
shape.standard = "S1002"

[[wheel.flats]]
length_mm = 40.0
depth_mm = 0.4

[rail]
shape.standard = "60E1"

[track]
gauge_mm = 1435.0
cant = "1:40"

[wheelset]
flange_back_distance_mm = 1360.0
flange_back_position_mm = -70.0

[friction]
coefficient = 0.3

[discretisation]
dx_mm = 1.0
ds_mm = 1.0
)";

constexpr const char* kImport = R"(# Settings of the import of a scan; what is not said is decided from the points.
#   treadmark import SCAN.ply --settings FILE -o wheel.slcw --report audit
[scan]
body = "wheel"
unit = "auto"

[placement]
nominal = "auto"
#nominal_radius_mm

[clean]
outlier_factor = 4.5
#hole_limit_mm

[fit]
resolution_mm = 0.5
)";

constexpr const char* kBackend = R"(# A representation of surfaces of one's own. In C++: docs/write-a-backend.md.
#   python3 FILE
import numpy as np

import treadmark as tm


class Steps:
    """The nearest of the samples u [m] along the track; y, z [m] (places, samples across) as in profiles; body: "wheel" or "rail"."""

    def __init__(self, u, y, z, body):
        self.u, self.y, self.z = u, y, z

    def heights(self, u, y):
        """Heights [m] at u (n, m) along and y (n, m) across the track, NaN where there is no surface."""
        nearest = np.searchsorted((self.u[1:] + self.u[:-1]) / 2, u[:, 0])
        return np.array([np.interp(row, self.y, self.z[k], np.nan, np.nan) for row, k in zip(y, nearest)])


tm.register_backend("steps", Steps)

# From here on it is a choice as those that are built in, also in tm.compare and tm.bench. How well does it do?
rail = tm.Surface.standard("60E1").with_defects(squats=[{"length_mm": 40.0, "width_mm": 30.0, "depth_mm": 0.5}])
u, y = np.meshgrid(np.linspace(-0.02, 0.02, 81), np.linspace(-0.01, 0.01, 41), indexing="ij")
for spacing in (4e-3, 2e-3, 1e-3):
    error = abs(rail.represent("steps", spacing).heights(u, y) - rail.heights(u, y)).max()
    print(f"samples every {1e3 * spacing:.0f} mm: heights within {1e6 * error:.1f} um")
)";

struct Start {
  const char* kind;
  const char* ending;
  const char* text;
  std::string (*schema)();              ///< null: no keys
  std::vector<const char*> names = {};  ///< kinds of the files that it names by their usual name
};
const std::vector<Start>& starts() {
  static const std::vector<Start> list{{"case", ".toml", kCase, io::case_file_schema},
                                       {"study", ".toml", kStudy, study_schema, {"case"}},
                                       {"vehicle", ".toml", kVehicle, vehicle_schema},
                                       {"track", ".toml", kTrack, track_schema},
                                       {"simulation", ".toml", kSimulation, simulation_schema, {"vehicle", "track"}},
                                       {"import", ".toml", kImport, import_schema},
                                       {"backend", ".py", kBackend, nullptr}};
  return list;
}
const Start& start_of(std::string_view kind) { return *ranges::find(starts(), kind, &Start::kind); }

using io::Json;

/// What a schema says of a key, "rail.shape.standard".
const Json& schema_at(const Json& schema, std::string_view path) {
  const Json* node = &schema;
  for (std::string_view rest = path; !rest.empty();) {
    const std::string part(rest.substr(0, rest.find('.')));
    rest.remove_prefix(std::min(rest.size(), part.size() + 1));
    if (node->contains("items")) node = &node->at("items");
    if (!node->contains("properties") || !node->at("properties").contains(part))
      throw std::logic_error(fmt::format("the schema has no key {}", path));
    node = &node->at("properties").at(part);
  }
  return *node;
}

std::string meaning_of(const Json& schema) {
  std::string text = schema.value("description", "");
  constexpr std::size_t kMostChoices = 8;
  if (const auto choices = schema.find("enum"); choices != schema.end() && choices->size() <= kMostChoices) {
    text += " (";
    for (const Json& one : *choices) text += (text.back() == '(' ? "" : ", ") + one.get<std::string>();
    text += ')';
  }
  return text;
}

/// The line with the comment behind it, or above it where both are long.
std::string with_comment(const std::string& line, const std::string& comment) {
  constexpr std::size_t kWidth = 120, kColumn = 34;
  if (comment.empty()) return line + '\n';
  if (std::max(line.size(), kColumn) + 3 + comment.size() <= kWidth)
    return fmt::format("{:<{}} # {}\n", line, kColumn, comment);
  std::string above = "#";
  std::istringstream words(comment);
  std::size_t column = 1;
  for (std::string word; words >> word; column += word.size() + 1) {
    if (column + 1 + word.size() > kWidth) {
      above += "\n#";
      column = 1;
    }
    above += ' ' + word;
  }
  return above + '\n' + line + '\n';
}

/// The text of a kind with what its keys mean.
std::string explained(const Start& start) {
  if (start.schema == nullptr) return start.text;
  const Json schema = Json::parse(start.schema());
  std::istringstream lines(start.text);
  std::string out, table;
  for (std::string line; std::getline(lines, line);) {
    const std::size_t name = line.find_first_not_of('[');
    if (line.starts_with('[')) {
      table = line.substr(name, line.find(']') - name);
      out += with_comment(line, meaning_of(schema_at(schema, table)));
      continue;
    }
    const bool off = line.starts_with('#') && !line.starts_with("# ");
    const std::size_t from = off ? 1 : 0, to = std::min(line.find_first_of(" ="), line.size());
    if (to <= from || !ranges::all_of(line.substr(from, to - from),
                                      [](unsigned char c) { return std::isalnum(c) != 0 || c == '_' || c == '.'; })) {
      out += line + '\n';  // a comment, or the rest of a value
      continue;
    }
    const std::string key = line.substr(from, to - from);
    const Json& about = schema_at(schema, table.empty() ? key : fmt::format("{}.{}", table, key));
    if (off) line = "# " + line.substr(1);
    if (off && to == line.size() - 1) line += " = " + about.value("default", Json(0)).dump();
    out += with_comment(line, meaning_of(about));
  }
  return out;
}

void write_start(const Start& start, const std::filesystem::path& file) {
  const std::string named = io::replaced(explained(start), "FILE", file.filename().string());
  write_file(file, io::replaced(named, "STEM", file.stem().string()));
  std::cout << file.string() << '\n';
}

struct NewOptions {
  std::string kind, file;
};

int new_command(const NewOptions& options, const CommonOptions&) {
  namespace fs = std::filesystem;
  const Start& start = start_of(options.kind);
  const fs::path file = options.file.empty() ? options.kind + start.ending : options.file;
  if (fs::exists(file))
    throw Error(ErrorKind::configuration, file.string() + " is there already and stays as it is", {},
                "give another name, or remove it");
  if (file.extension() != start.ending)
    throw Error(ErrorKind::configuration, fmt::format("{} does not end with {}", file.string(), start.ending), {},
                "the ending says what a file is");
  for (const char* kind : start.names) {
    const fs::path named = file.parent_path() / (kind + std::string(".toml"));
    if (named == file)
      throw Error(ErrorKind::configuration, fmt::format("a {} names a {} by this name", start.kind, kind), {},
                  "give another name");
    if (!fs::exists(named)) write_start(start_of(kind), named);
  }
  write_start(start, file);
  return kOk;
}

}  // namespace

std::string text_of_new_case() { return kCase; }

Command add_new(CLI::App& verb) {
  auto options = std::make_shared<NewOptions>();
  std::vector<std::string> kinds;
  for (const Start& start : starts()) kinds.emplace_back(start.kind);
  verb.add_option("KIND", options->kind, "What to begin")->required()->check(CLI::IsMember(kinds));
  verb.add_option("FILE", options->file,
                  "Where to; without it KIND.toml, of a backend backend.py. Files that it names are written beside it "
                  "where they are not there")
      ->check(is_output(true));
  return command(options, new_command);
}

}  // namespace treadmark::cli
