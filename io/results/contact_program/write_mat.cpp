// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors

#include "treadmark/io/results/contact_program/write_mat.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <initializer_list>
#include <string_view>

#include "treadmark/core/constants.hpp"
#include "treadmark/core/error.hpp"
#include "treadmark/core/output_file.hpp"
#include "treadmark/core/to_whole.hpp"
#include "treadmark/io/results/field_table.hpp"

namespace treadmark::io {

namespace {

/// A column: its name and value.
struct Entry {
  std::string_view name;
  double value;
};
using Entries = std::vector<Entry>;

std::string lines(const Entries& entries, std::size_t columns) {
  std::vector<std::string_view> names;
  std::vector<double> values;
  for (const Entry& entry : entries) {
    names.push_back(entry.name);
    values.push_back(entry.value);
  }
  return column_head(names) + column_line(values, columns);
}

Entries rail_entries(const MatFileHead& head, std::size_t columns) {
  Entries entries{{"TIM", head.time},
                  {"S_WS", head.s_ws * kMilli},
                  {"TH_WS", head.pitch_ws},
                  {"Y_R", head.rail_y * kMilli},
                  {"Z_R", head.rail_z * kMilli},
                  {"ROLL_R", head.rail_roll},
                  {"RNOM_ROL", head.roller_radius * kMilli}};
  while (entries.size() + 1 < columns) entries.push_back({"-", 0.0});
  entries.push_back({"FMT", static_cast<double>(head.format)});
  return entries;
}

Entries wheel_entries(const MatFileHead& head) {
  return {{"X_W", head.wheel_x * kMilli}, {"Y_W", head.wheel_y * kMilli}, {"Z_W", head.wheel_z * kMilli},
          {"ROLL_W", head.wheel_roll},    {"YAW_W", head.wheel_yaw},      {"RNOM_WHL", head.wheel_radius * kMilli}};
}

Entries reference_entries(const MatFileHead& head, const PatchResult& patch) {
  return {{"X_CP(R)", patch.x_rail * kMilli},
          {"Y_CP(R)", patch.y_rail * kMilli},
          {"Z_CP(R)", patch.z_rail * kMilli},
          {"DELT_CP(R)", patch.has_reference ? patch.angle - head.rail_roll : 0.0},
          {"X_CP(W)", patch.x_wheel * kMilli},
          {"Y_CP(W)", patch.y_wheel * kMilli},
          {"Z_CP(W)", patch.z_wheel * kMilli},
          {"NPATCH", static_cast<double>(head.patches)},
          {"IPATCH", static_cast<double>(head.patch)},
          {"SPINXO", head.spin_x * kMilli},
          {"SPINYO", head.spin_y * kMilli}};
}

Entries grid_entries(const MatFileHead& head, const PatchResult& patch) {
  const Grid2& grid = patch.fields.grid;
  return {{"MX", static_cast<double>(grid.nx)},
          {"MY", static_cast<double>(grid.ny)},
          {"XL", (grid.x0 - 0.5 * grid.dx) * kMilli},
          {"YL", (grid.y0 - 0.5 * grid.dy) * kMilli},
          {"DX", grid.dx * kMilli},
          {"DY", grid.dy * kMilli},
          {"CHI", patch.chi},
          {"DQ", patch.dq * kMilli},
          {"C1", static_cast<double>(head.configuration)},
          {"D", static_cast<double>(head.discretisation)},
          {"YNOM_WHL", head.wheel_y * kMilli}};
}

Entries material_entries(const MatFileHead& head) {
  const Material& m = head.material;
  Entries entries{{"T", static_cast<double>(head.tangential)},
                  {"M", static_cast<double>(head.material_model)},
                  {"GG1", m.shear_modulus_1 * kMega},
                  {"GG2", m.shear_modulus_2 * kMega},
                  {"POISS1", m.poisson_1},
                  {"POISS2", m.poisson_2}};
  if (head.material_model == 1)
    entries.insert(entries.end(), {{"FG1", m.creep_ratio_1},
                                   {"FG2", m.creep_ratio_2},
                                   {"TC1", m.relaxation_time_1},
                                   {"TC2", m.relaxation_time_2}});
  if (head.material_model == 4)
    entries.insert(entries.end(), {{"GG3", head.layer_shear_modulus * kMega},
                                   {"LAYTHK", head.layer_thickness * kMilli},
                                   {"TAU_C0", m.layer_yield * kMega},
                                   {"K_TAU", m.layer_hardening * kMega / kMilli}});
  return entries;
}

Entries friction_entries(const MatFileHead& head, const PatchResult& patch) {
  const FrictionLaw& f = head.friction;
  Entries entries{{"L", static_cast<double>(head.friction_law)},
                  {"H", static_cast<double>(head.heat)},
                  {"VELOC", patch.velocity * kMilli}};
  const auto add = [&](std::initializer_list<Entry> more) { entries.insert(entries.end(), more); };
  const Entry memory_distance{"MEMDST", f.memory_distance * kMilli},
      memory_velocity{"MEM_S0", f.memory_velocity * kMilli};
  if (f.kind == FrictionLaw::Kind::coulomb)
    add({{"FSTAT", f.static_friction()}, {"FKIN", f.kinetic}});
  else if (f.kind == FrictionLaw::Kind::temperature)
    add({{"FREF", f.kinetic},
         {"TREF", f.reference_temperature},
         {"DFHEAT", f.temperature_change},
         {"DTHEAT", f.temperature_range},
         memory_distance,
         memory_velocity});
  else
    add({{"FKIN", f.kinetic},
         {"AMPL1", f.amplitude_1},
         {"SABSH1", f.half_velocity_1 * kMilli},
         {"AMPL2", f.amplitude_2},
         {"SABSH2", f.half_velocity_2 * kMilli},
         memory_distance,
         memory_velocity});
  return entries;
}

double at(const std::vector<double>& field, std::size_t i) { return i < field.size() ? field[i] : 0.0; }

/// The line of element i, in contact or not.
Entries element_entries(const PatchResult& patch, std::size_t i) {
  const PatchFields& f = patch.fields;
  Entries entries{
      {"I", static_cast<double>(i + 1)},
      {"IGS", i < f.state.size() ? static_cast<double>(f.state[i]) : 0.0},
      {"H", at(f.gap, i) * kMilli},
      {"MU", at(f.friction, i)},
      {"PN", at(f.pressure, i) * kMega},
      {"PX", at(f.traction_x, i) * kMega},
      {"PY", at(f.traction_s, i) * kMega},
      {"UN", at(f.displacement_n, i) * kMilli},
      {"UX", at(f.displacement_x, i) * kMilli},
      {"UY", at(f.displacement_s, i) * kMilli},
      {patch.shift ? "SHFT" : "SREL", std::hypot(at(f.slip_x, i), at(f.slip_s, i)) * (patch.shift ? kMilli : 1.0)}};
  if (!f.yield_stress.empty())
    entries.insert(entries.end(), {{"TAUCRT", f.yield_stress[i] * kMega},
                                   {"UPLSX", at(f.plastic_x, i) * kMilli},
                                   {"UPLSY", at(f.plastic_s, i) * kMilli}});
  if (!f.temperature_1.empty())
    entries.insert(entries.end(), {{"TEMP1", f.temperature_1[i]}, {"TEMP2", at(f.temperature_2, i)}});
  return entries;
}

}  // namespace

std::string patch_to_mat(const MatFileHead& head, const PatchResult& patch, bool all_elements) {
  const PatchFields& fields = patch.fields;
  check_field_sizes(fields, head.case_number, head.patch);
  const Entries first = element_entries(patch, 0);
  const std::size_t columns = first.size();
  std::string text = lines(rail_entries(head, columns), columns);
  for (const Entries& entries : {wheel_entries(head), reference_entries(head, patch), grid_entries(head, patch),
                                 material_entries(head), friction_entries(head, patch)})
    text += lines(entries, columns);

  std::vector<std::string_view> names;
  for (const Entry& entry : first) names.push_back(entry.name);
  text += column_head(names);
  std::vector<double> values;
  for (std::size_t i = 0; i < fields.state.size(); ++i) {
    if (!all_elements && fields.state[i] == 0) continue;
    values.clear();
    for (const Entry& entry : element_entries(patch, i)) values.push_back(entry.value);
    text += column_line(values);
  }
  return text;
}

void write_mat(const std::filesystem::path& path, const MatFileHead& head, const PatchResult& patch,
               bool all_elements) {
  write_file(path, patch_to_mat(head, patch, all_elements));
}

std::string case_file_name(const std::string& stem, int case_number, int patch, const std::string& extension) {
  if (patch < 0 || patch > 26)
    throw Error(ErrorKind::configuration, fmt::format("patch {} has no letter for a file name", patch), {},
                "write the files of at most 26 patches");
  const std::string letter = patch == 0 ? "" : std::string(1, static_cast<char>('a' + patch - 1));
  return fmt::format("{}.{:04}{}.{}", stem, case_number, letter, extension);
}

namespace {

constexpr int kWidth = 21;
constexpr double kLargestWhole = 1e9;

std::string column(double value) {
  if (std::isnan(value)) return fmt::format("{:>{}}", "NaN", kWidth);
  if (std::abs(value) < kLargestWhole && value == std::trunc(value))
    return fmt::format("{:>{}d}", to_whole<long long>(value), kWidth);
  return fmt::format("{:>{}.12E}", value, kWidth);
}

}  // namespace

std::string column_head(std::span<const std::string_view> names) {
  std::string line = "%";
  int width = kWidth - 1;
  for (const std::string_view name : names) {
    line += fmt::format("{:>{}}", name, width);
    width = kWidth;
  }
  return line + "\n";
}

std::string column_line(std::span<const double> values, std::size_t count) {
  std::string line;
  for (const double value : values) line += column(value);
  for (std::size_t k = values.size(); k < count; ++k) line += column(0.0);
  return line + "\n";
}

}  // namespace treadmark::io
