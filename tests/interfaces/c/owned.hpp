// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <gtest/gtest.h>

#include <cstddef>
#include <memory>
#include <string>
#include <vector>

#include "treadmark.h"

// Objects of the C interface that free themselves, and what tests ask of them.
namespace treadmark::testing {

inline const std::string kText = R"(
[case]
regime = "steady"
[rail]
shape.standard = "60E1"
[wheel]
shape.standard = "S1002"
[track]
gauge_mm = 1435.0
cant = "1:40"
[wheelset]
y_mm = 2.0
nominal_radius_mm = 460
vertical_force_N = 80e3
velocity_m_s = 20
vpitch_rad_s = -43.5
[friction]
coefficient = 0.3
[discretisation]
dx_mm = 1.0
ds_mm = 1.0
)";

template <class Handle, void (*free_it)(Handle*)>
struct Freed {
  void operator()(Handle* handle) const { free_it(handle); }
};
using CaseOf = std::unique_ptr<tm_case, Freed<tm_case, tm_case_free>>;
using SurfaceOf = std::unique_ptr<tm_surface, Freed<tm_surface, tm_surface_free>>;
using PairOf = std::unique_ptr<tm_pair, Freed<tm_pair, tm_pair_free>>;
using PatchOf = std::unique_ptr<tm_patch, Freed<tm_patch, tm_patch_free>>;
using SolutionOf = std::unique_ptr<tm_solution, Freed<tm_solution, tm_solution_free>>;
using StateOf = std::unique_ptr<tm_state, Freed<tm_state, tm_state_free>>;

inline CaseOf case_of(const std::string& text) {
  tm_case* out = nullptr;
  EXPECT_EQ(tm_case_parse(text.data(), text.size(), nullptr, 1, &out), TM_OK) << tm_message();
  return CaseOf(out);
}
inline PairOf pair_of(const tm_case* c) {
  tm_pair* out = nullptr;
  EXPECT_EQ(tm_pair_of_case(c, &out), TM_OK) << tm_message();
  return PairOf(out);
}
inline SolutionOf solved(tm_pair* pair, const tm_case* c, tm_status expected = TM_OK) {
  tm_solution* out = nullptr;
  EXPECT_EQ(tm_pair_solve(pair, c, &out), expected) << tm_message();
  return SolutionOf(out);
}
inline double number(tm_solution* s, const char* name) {
  double value = 0.0;
  EXPECT_EQ(tm_solution_number(s, name, &value), TM_OK) << tm_message();
  return value;
}
inline double number(tm_solution* s, std::size_t patch, const char* name) {
  double value = 0.0;
  EXPECT_EQ(tm_patch_number(s, patch, name, &value), TM_OK) << tm_message();
  return value;
}
inline std::vector<double> field(tm_solution* s, std::size_t patch, const char* name) {
  int nx = 0, ny = 0;
  EXPECT_EQ(tm_patch_grid(s, patch, &nx, &ny, nullptr, nullptr, nullptr, nullptr), TM_OK);
  const double* values = nullptr;
  EXPECT_EQ(tm_patch_field(s, patch, name, &values), TM_OK) << tm_message();
  if (values == nullptr) return {};
  return {values, values + nx * ny};
}

}  // namespace treadmark::testing
