// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/io/results/summary.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "treadmark/io/files/text.hpp"
#include "treadmark/io/results/quantities.hpp"

namespace treadmark::io {
namespace {

constexpr double kDegrees = 180.0 / std::numbers::pi;
constexpr int kLabel = 26;   // width of the first column
constexpr int kColumn = 14;  // width of a column of numbers

/// "label  unit  value value ..." with the values right-aligned under one another.
class Table {
 public:
  void line(const std::string& text) { text_ += text + "\n"; }

  template <class Value>
  void row(std::string_view label, const std::string& unit, const std::vector<PatchResult>& patches, Value value) {
    text_ += fmt::format("  {:<{}}{:<9}", label, kLabel, unit);
    for (const PatchResult& patch : patches) text_ += fmt::format("{:>{}}", value(patch), kColumn);
    text_ += "\n";
  }

  std::string take() { return std::move(text_); }

 private:
  std::string text_;
};

/// Four decimals; a rounded zero has no sign.
std::string four_decimals(double value) {
  std::string text = fmt::format("{:.4f}", value);
  return text == "-0.0000" ? text.substr(1) : text;
}

/// 0 for what is nothing but rounding.
double without_rounding(double value) { return std::abs(value) < kShownAsZero ? 0.0 : value; }

/// Five significant digits, without an exponent where the number is of ordinary size.
std::string five_digits(double value) {
  value = without_rounding(value);
  const double size = std::abs(value);
  if (!(size >= 1e-3 && size < 1e9)) return fmt::format("{:.5g}", value);
  return fmt::format("{:.{}f}", value, decimals_of(value, 5));
}

std::string in_digits(double value, Label::Digits digits) {
  switch (digits) {
    case Label::Digits::four_decimals:
      return four_decimals(value);
    case Label::Digits::five:
      return five_digits(value);
    case Label::Digits::four:
      return fmt::format("{:.4g}", without_rounding(value));
    case Label::Digits::whole:
      return fmt::format("{}", static_cast<int>(value));
  }
  return {};
}

std::string three(double a, double b, double c) {
  std::string text;
  for (const double value : {a, b, c}) text += fmt::format("{:>{}}", four_decimals(value), kColumn);
  return text;
}

std::string three_forces(const Vec3& force) {
  std::string text;
  for (const double value : force) text += fmt::format("{:>{}}", five_digits(value), kColumn);
  return text;
}

void add_wheelset(Table& table, const CaseResult& result) {
  table.line(fmt::format("  {:<{}}{:<9}{}", "wheelset s, y, z", kLabel, "[mm]",
                         three(result.s * 1e3, result.y * 1e3, result.z * 1e3)));
  table.line(fmt::format("  {:<{}}{:<9}{}", "wheelset roll, yaw, pitch", kLabel, "[deg]",
                         three(result.roll * kDegrees, result.yaw * kDegrees, result.pitch * kDegrees)));
  table.line(fmt::format("  {:<{}}{:<9}{:>{}}", "wheelset pitch rate", kLabel, "[rad/s]", five_digits(result.vpitch),
                         kColumn));
  if (const auto& d = result.rail_deflection)
    table.line(fmt::format("  {:<{}}{:<9}{:>{}}{:>{}}", "rail deflection y, z", kLabel, "[mm]",
                           four_decimals(d->x() * 1e3), kColumn, four_decimals(d->y() * 1e3), kColumn));
  table.line(fmt::format("  {:<{}}{:<9}{}", "force on rail x, y, z", kLabel, "[N]", three_forces(result.force_tr)));
}

void add_patches(Table& table, const std::vector<PatchResult>& patches) {
  std::string heading = fmt::format("  {:<{}}{:<9}", "patch", kLabel, "");
  for (std::size_t i = 1; i <= patches.size(); ++i) heading += fmt::format("{:>{}}", i, kColumn);
  table.line(heading);

  const bool shift = patches.front().shift;
  for (const Block block : {Block::place, Block::angle, Block::force, Block::approach, Block::pressure, Block::refined,
                            Block::creepage, Block::energy, Block::relative, Block::heat, Block::count})
    for (const Quantity<PatchResult>& row : quantities<PatchResult>()) {
      if (row.block != block || row.label.text.empty() || !has_block(patches.front(), block)) continue;
      const Unit& unit = row.unit_in(shift);
      table.row(shift && !row.label.in_shift.empty() ? row.label.in_shift : row.label.text,
                unit.shown.empty() ? "" : fmt::format("[{}]", unit.shown), patches, [&](const PatchResult& p) {
                  return row.has(p) ? in_digits(unit.to_shown(row.access.get(p)), row.label.digits) : "";
                });
    }
  table.row("  adhesion / slip", "", patches,
            [](const PatchResult& p) { return fmt::format("{} / {}", p.nadh, p.nslip); });
}

}  // namespace

std::string summary(const CaseResult& result) {
  Table table;
  std::string heading = fmt::format("case {}: {}", result.number, status_word(result));
  if (!result.message.empty()) heading += " (" + result.message + ")";
  if (result.patches.size() > 1) heading += fmt::format(", {} patches", result.patches.size());
  const auto doubts = std::ranges::count_if(result.remarks, &Remark::grave);
  if (doubts > 0) heading += fmt::format(", {} warning{}", doubts, doubts > 1 ? "s" : "");
  table.line(heading + fmt::format(", {:.3f} s", result.seconds));
  if (result.has_wheelset) add_wheelset(table, result);
  if (!result.patches.empty()) add_patches(table, result.patches);
  for (const Remark& remark : result.remarks) table.line("  " + to_line(remark));
  return table.take();
}

std::string summary_list(std::span<const CaseResult> cases) {
  const bool posed = std::ranges::any_of(cases, &CaseResult::has_wheelset);
  constexpr const char* kPose = " {:>9} {:>9} {:>9}";
  std::string text = fmt::format("{:>6}  {:<13}", "case", "status");
  if (posed) text += fmt::format(kPose, "y [mm]", "z [mm]", "pitch [°]");
  text += fmt::format(" {:>7} {:>9} {:>9} {:>9} {:>10} {:>7}\n", "patches", "Fx [N]", posed ? "Fy [N]" : "Fs [N]",
                      posed ? "Fz [N]" : "Fn [N]", "pmax [MPa]", "slip");
  std::string said;
  for (const CaseResult& c : cases) {
    text += fmt::format("{:>6}  {:<13}", c.number, status_word(c));
    if (posed)
      text += fmt::format(kPose, four_decimals(1e3 * c.y), four_decimals(1e3 * c.z), four_decimals(c.pitch * kDegrees));
    text += fmt::format(" {:>7}", c.patches.size());
    if (!c.patches.empty()) {
      const PatchResult& first = c.patches.front();
      const Vec3 force = c.has_wheelset ? c.force_tr : Vec3(first.fx, first.fs, first.fn);
      double pressure = 0.0;
      int slip = 0, contact = 0;
      for (const PatchResult& p : c.patches) {
        pressure = std::max(pressure, p.pmax);
        slip += p.nslip, contact += p.ncon;
      }
      text += fmt::format(" {:>9} {:>9} {:>9} {:>10} {:>7}", five_digits(force.x()), five_digits(force.y()),
                          five_digits(force.z()), five_digits(1e-6 * pressure),
                          contact > 0 ? fmt::format("{:.0f} %", 100.0 * slip / contact) : "");
    }
    text += "\n";
    if (!c.message.empty()) said += fmt::format("case {}: {}\n", c.number, c.message);
    for (const Remark& remark : c.remarks) said += fmt::format("case {}: {}\n", c.number, to_line(remark));
  }
  return text + said;
}

std::string words(const CaseResult& result) {
  std::string text = result.message;
  for (const Remark& remark : result.remarks) text += (text.empty() ? "" : "; ") + to_line(remark);
  return text;
}

std::string summary(const SurfaceUse& use) {
  std::string text = fmt::format("{} as {} at {:g} mm", use.body, use.backend, 1e3 * use.resolution);
  if (use.fit.points > 0)
    text += fmt::format(": at most {:.3g} um and {:.3g} mrad from the surface it was sampled from (rms {:.3g} um)",
                        1e6 * use.fit.height_max, 1e3 * use.fit.slope_max, 1e6 * use.fit.height_rms);
  if (use.fit.missing > 0)
    text += fmt::format(", missing at {} of {} points", use.fit.missing, use.fit.missing + use.fit.points);
  text +=
      fmt::format("; {:.3g} MB, built in {:.2g} s", 1e-6 * static_cast<double>(use.memory_bytes), use.build_seconds);
  return use.note.empty() ? text : text + "; " + use.note;
}

}  // namespace treadmark::io
