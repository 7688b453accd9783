// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/io/settings/magnitudes.hpp"

#include <fmt/format.h>

namespace treadmark::io {
namespace {

// Longer endings first. Rigid bodies are made of stiff springs and hard materials, planes of large radii.
constexpr Magnitudes kMagnitudes[] = {
    {"_per_mm", 1e12, 1e-12}, {"_per_m", 1e15, 1e-15}, {"_per_s", 1e15, 1e-15}, {"_per_rad", 1e15, 1e-15},
    {"_rad_m", 1e12, 1e-12},  {"_mm_s", 1e12, 1e-12},  {"_m_s", 1e9, 1e-12},    {"_rad_s", 1e9, 1e-12},
    {"_mm3", 1e15, 1e-15},    {"_kg_m2", 1e12, 1e-12}, {"_mm", 1e12, 1e-9},     {"_um", 1e15, 1e-9},
    {"_m", 1e9, 1e-12},       {"_us", 1e12, 1e-9},     {"_s", 1e9, 1e-12},      {"_kg", 1e9, 1e-9},
    {"_N", 1e12, 1e-9},       {"_deg", 1e9, 1e-9},     {"_rad", 1e12, 1e-12},   {"_C", 1e6, 1e-6},
    {"_K", 1e9, 1e-9},        {"", 1e15, 1e-15}};

}  // namespace

const Magnitudes& magnitudes_of(std::string_view path) {
  const Magnitudes* row = kMagnitudes;
  while (!path.ends_with(row->ending)) ++row;  // the last one fits everything
  return *row;
}

std::string magnitude_table() {
  std::string text =
      "| keys that end with | greatest magnitude | least, where they must be positive |\n|---|---|---|\n";
  for (const Magnitudes& row : kMagnitudes)
    text +=
        fmt::format("| {} | {:g} | {:g} |\n", row.ending.empty() ? "anything else" : fmt::format("`{}`", row.ending),
                    row.greatest, row.least);
  return text;
}

}  // namespace treadmark::io
