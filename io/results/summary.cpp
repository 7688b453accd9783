// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/io/results/summary.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "treadmark/core/platform/ranges.hpp"
#include "treadmark/core/to_whole.hpp"
#include "treadmark/io/files/text.hpp"
#include "treadmark/io/results/derivative_table.hpp"
#include "treadmark/io/results/quantities.hpp"
#include "treadmark/io/tables/shown.hpp"

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

std::string in_digits(double value, Label::Digits digits) {
  const double size = std::abs(value) < kShownAsZero ? 0.0 : value;  // less is rounding
  switch (digits) {
    case Label::Digits::four_decimals:
      return shown_number(value, 4);
    case Label::Digits::five:
      return significant(size, 5, 1e-3);
    case Label::Digits::four:
      return fmt::format("{:.4g}", size);
    case Label::Digits::whole:
      return fmt::format("{}", to_whole<int>(value));
  }
  return {};
}

std::string cells(const Vec3& values, Label::Digits digits) {
  std::string text;
  for (const double value : values) text += fmt::format("{:>{}}", in_digits(value, digits), kColumn);
  return text;
}

void add_wheelset(Table& table, const CaseResult& result) {
  using enum Label::Digits;
  table.line(fmt::format("  {:<{}}{:<9}{}", "wheelset s, y, z", kLabel, "[mm]",
                         cells(1e3 * Vec3(result.s, result.y, result.z), four_decimals)));
  table.line(fmt::format("  {:<{}}{:<9}{}", "wheelset roll, yaw, pitch", kLabel, "[deg]",
                         cells(kDegrees * Vec3(result.roll, result.yaw, result.pitch), four_decimals)));
  table.line(fmt::format("  {:<{}}{:<9}{:>{}}", "wheelset pitch rate", kLabel, "[rad/s]",
                         in_digits(result.vpitch, five), kColumn));
  if (const auto& d = result.rail_deflection)
    table.line(fmt::format("  {:<{}}{:<9}{:>{}}{:>{}}", "rail deflection y, z", kLabel, "[mm]",
                           in_digits(d->x() * 1e3, four_decimals), kColumn, in_digits(d->y() * 1e3, four_decimals),
                           kColumn));
  table.line(fmt::format("  {:<{}}{:<9}{}", "force on rail x, y, z", kLabel, "[N]", cells(result.force_tr, five)));
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
      const auto known = [&](const PatchResult& p) { return row.has(p) && std::isfinite(row.access.get(p)); };
      if (ranges::none_of(patches, known)) continue;
      const Unit& unit = row.unit_in(shift);
      table.row(shift && !row.label.in_shift.empty() ? row.label.in_shift : row.label.text,
                unit.shown.empty() ? "" : fmt::format("[{}]", unit.shown), patches, [&](const PatchResult& p) {
                  return known(p) ? in_digits(unit.to_shown(row.access.get(p)), row.label.digits) : "";
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
  const auto doubts = ranges::count_if(result.remarks, &Remark::grave);
  if (doubts > 0) heading += fmt::format(", {} warning{}", doubts, doubts > 1 ? "s" : "");
  table.line(heading + fmt::format(", {:.3f} s", result.seconds));
  if (result.has_wheelset) add_wheelset(table, result);
  if (!result.patches.empty()) add_patches(table, result.patches);
  for (const Remark& remark : result.remarks) table.line("  " + to_line(remark));
  return table.take() + (result.uncertainty ? uncertainty_text(*result.uncertainty) : "") +
         (result.derivatives ? derivatives_text(*result.derivatives) : "");
}

std::string summary_list(std::span<const CaseResult> cases) {
  using enum Label::Digits;
  const bool posed = ranges::any_of(cases, &CaseResult::has_wheelset);
  std::size_t status = 6;
  for (const CaseResult& c : cases) status = std::max(status, status_word(c).size());
  // Rows of 80 characters where no status is longer than "no_contact".
  constexpr const char *kCase = "{:>4} {:<{}}", *kPose = " {:>7} {:>7} {:>8}",
                       *kContact = " {:>3} {:>7} {:>7} {:>7} {:>6} {:>4}\n";
  std::string text = fmt::format(kCase, "case", "status", status);
  if (posed) text += fmt::format(kPose, "y", "z", "pitch");
  text += fmt::format(kContact, "no.", "Fx", posed ? "Fy" : "Fs", posed ? "Fz" : "Fn", "pmax", "slip");
  text += fmt::format(kCase, "", "", status);
  if (posed) text += fmt::format(kPose, "mm", "mm", "deg");
  text += fmt::format(kContact, "", "N", "N", "N", "MPa", "%");
  std::string said;
  for (const CaseResult& c : cases) {
    text += fmt::format(kCase, c.number, status_word(c), status);
    if (posed)
      text += fmt::format(kPose, in_digits(1e3 * c.y, four_decimals), in_digits(1e3 * c.z, four_decimals),
                          in_digits(c.pitch * kDegrees, four_decimals));
    if (c.patches.empty()) {
      text += fmt::format(" {:>3}\n", 0);
    } else {
      const PatchResult& first = c.patches.front();
      const Vec3 force = c.has_wheelset ? c.force_tr : Vec3(first.fx, first.fs, first.fn);
      double pressure = 0.0;
      int slip = 0, contact = 0;
      for (const PatchResult& p : c.patches) {
        pressure = std::max(pressure, p.pmax);
        slip += p.nslip, contact += p.ncon;
      }
      text += fmt::format(kContact, c.patches.size(), in_digits(force.x(), five), in_digits(force.y(), five),
                          in_digits(force.z(), five), in_digits(1e-6 * pressure, five),
                          contact > 0 ? fmt::format("{:.0f}", 100.0 * slip / contact) : "");
    }
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
