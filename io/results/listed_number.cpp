// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/io/results/listed_number.hpp"

#include <fmt/format.h>

#include <limits>

#include "treadmark/core/error.hpp"
#include "treadmark/core/missing_file.hpp"
#include "treadmark/core/platform/from_chars.hpp"
#include "treadmark/core/platform/ranges.hpp"

namespace treadmark::io {
namespace {

constexpr double kUnknown = std::numeric_limits<double>::quiet_NaN();
constexpr std::string_view kPatches = "npatch", kOnePatch = "patch_";

constexpr std::string_view kUsual[] = {"wheelset.y_mm",
                                       "wheelset.z_mm",
                                       "wheelset.yaw_rad",
                                       "wheelset.pitch_rad",
                                       "force_on_rail.fx_tr_N",
                                       "force_on_rail.fy_tr_N",
                                       "force_on_rail.fz_tr_N",
                                       "npatch",
                                       "reference.x_tr_mm",
                                       "reference.y_tr_mm",
                                       "reference.z_tr_mm",
                                       "reference.angle_rad",
                                       "reference.y_rail_mm",
                                       "reference.y_wheel_mm",
                                       "kinematics.xi",
                                       "kinematics.eta",
                                       "kinematics.phi",
                                       "fn_N",
                                       "fx_N",
                                       "fs_N",
                                       "mn_Nmm",
                                       "pmax_MPa",
                                       "approach_mm",
                                       "dissipated_W",
                                       "t_gamma_N",
                                       "slip_share",
                                       "elements.ncon",
                                       "pmax_refinement"};

template <class T>
const Quantity<T>* row_named(std::string_view name, Names names) {
  for (const Quantity<T>& row : quantities<T>())
    if (!row.key.empty() && (names == Names::in_file ? name_of(row) : si_name(row)) == name) return &row;
  return nullptr;
}

[[noreturn]] void refuse(std::string_view name, Names names) {
  std::vector<std::string> known{std::string(kPatches)};
  const auto add = [&](const auto& rows) {
    for (const auto& row : rows)
      if (!row.key.empty()) known.push_back(names == Names::in_file ? name_of(row) : si_name(row));
  };
  add(quantities<CaseResult>());
  add(quantities<PatchResult>());
  throw Error(ErrorKind::configuration, fmt::format("no number of results has the name '{}'", name), {},
              advice_on_name(std::string(name), known, "docs/results.md lists them"));
}

/// The patch that "patch_2." at the start of a name means, which is taken off; 0: none.
int taken_patch(std::string_view& name) {
  if (!name.starts_with(kOnePatch)) return 0;
  int patch = 0;
  const char *const first = name.data() + kOnePatch.size(), *const last = name.data() + name.size();
  const auto [end, trouble] = from_chars(first, last, patch);
  if (trouble != std::errc() || patch < 1 || end == last || *end != '.') return 0;
  name = name.substr(static_cast<std::size_t>(end + 1 - name.data()));
  return patch;
}

const PatchResult* patch_of(const CaseResult& result, int patch) {
  if (patch > 0)
    return static_cast<std::size_t>(patch) <= result.patches.size()
               ? &result.patches[static_cast<std::size_t>(patch) - 1]
               : nullptr;
  const auto most = ranges::max_element(result.patches, {}, &PatchResult::fn);
  return most == result.patches.end() ? nullptr : &*most;
}

/// Of a case that failed without any, or that shows none, nobody knows how many there are.
double patches_in(const CaseResult& result) {
  const bool unknown = !result.shown || result.status == Status::failed;
  return unknown && result.patches.empty() ? kUnknown : static_cast<double>(result.patches.size());
}

template <class T>
bool is_known(const Quantity<T>& row, const T& item) {
  return has_block(item, row.block) && row.has(item);
}

}  // namespace

std::string_view ListedNumber::unit() const {
  const std::string_view si = of_case != nullptr    ? of_case->unit.si
                              : of_patch != nullptr ? of_patch->unit.si
                                                    : std::string_view();
  return si.empty() ? "1" : si;
}

double ListedNumber::si(const CaseResult& result) const {
  if (of_case != nullptr) return is_known(*of_case, result) ? of_case->access.get(result) : kUnknown;
  if (of_patch == nullptr) return patches_in(result);
  const PatchResult* found = patch_of(result, patch);
  return found != nullptr && is_known(*of_patch, *found) ? of_patch->access.get(*found) : kUnknown;
}

double ListedNumber::in_file(double si, bool shift) const {
  if (of_case != nullptr) return of_case->unit.in_file(si);
  return of_patch != nullptr ? of_patch->unit_in(shift).in_file(si) : si;
}

ListedNumber listed_number(std::string_view name, Names names) {
  if (name == kPatches) return {std::string(name), std::string(name), "contact patches", nullptr, nullptr, 0};
  std::string_view rest = name;
  const int patch = taken_patch(rest);
  const std::string before = patch > 0 ? fmt::format("{}{}.", kOnePatch, patch) : std::string();
  if (patch == 0)
    if (const auto* row = row_named<CaseResult>(rest, names); row != nullptr)
      return {name_of(*row), si_name(*row), std::string(row->meaning), row, nullptr, 0};
  if (const auto* row = row_named<PatchResult>(rest, names); row != nullptr)
    return {before + name_of(*row), before + si_name(*row), std::string(row->meaning), nullptr, row, patch};
  refuse(name, names);
}

std::vector<ListedNumber> usual_numbers(bool wheel_on_rail) {
  std::vector<ListedNumber> out;
  for (const std::string_view name : kUsual) {
    ListedNumber number = listed_number(name);
    const bool of_both =
        (number.of_case != nullptr && number.of_case->block == Block::wheelset) ||
        (number.of_patch != nullptr && flag_of<PatchResult>(number.of_patch->block) == &PatchResult::has_reference);
    if (wheel_on_rail || !of_both) out.push_back(std::move(number));
  }
  return out;
}

}  // namespace treadmark::io
