// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <string>
#include <string_view>

#include "treadmark/io/cases/case_keys.hpp"

namespace treadmark::io {

/// What names of backends look like; which there are is not known here.
inline constexpr const char* kBackendPattern = "^[a-z][a-z0-9_-]*$";
bool is_backend_name(std::string_view text);

/// tangential_model and the fastsim_... keys under prefix.
template <class Content>
void add_simplified_theory(KeyList& list, const std::string& prefix) {
  using T = TangentialModelInput;
  list.choice<Content, T>(prefix + "tangential_model",
                          {{"full", T::full},
                           {"fastsim", T::fastsim},
                           {"fastsim_one_flexibility", T::fastsim_one_flexibility},
                           {"fastrip", T::fastrip}},
                          "tractions: exact theory, FASTSIM with three flexibilities or with one, or FaStrip",
                          [](Content& c) -> T& { return c.tangential_model; });
  list.number<Content>(prefix + "fastsim_k0", kPositive, "FASTSIM: initial slope reduction",
                       [](Content& c) -> double& { return c.fastsim_k0; });
  list.number<Content>(prefix + "fastsim_alpha", kNotNegative, "FASTSIM: slope at large creepage over the initial one",
                       [](Content& c) -> double& { return c.fastsim_alpha; });
  list.number<Content>(prefix + "fastsim_beta", kNotNegative, "FASTSIM: rate of the slope reduction",
                       [](Content& c) -> double& { return c.fastsim_beta; });
  list.number<Content>(prefix + "fastsim_flexibility_mm_per_MPa", kPositive,
                       "flexibility of \"fastsim_one_flexibility\"",
                       [](Content& c) -> double& { return c.fastsim_flexibility; });
}

/// Keys by subject; see the .cpp of the same name.
void add_general_keys(KeyList& list);
void add_material_keys(KeyList& list);
void add_friction_keys(KeyList& list);
void add_shape_keys(KeyList& list);
void add_part_keys(KeyList& list);
void add_defect_keys(KeyList& list);
void add_wheel_rail_keys(KeyList& list);
void add_balance_keys(KeyList& list);
void add_patch_keys(KeyList& list);
void add_patch_geometry_keys(KeyList& list);
void add_heat_keys(KeyList& list);
void add_subsurface_keys(KeyList& list);

}  // namespace treadmark::io
