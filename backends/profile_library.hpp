// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "treadmark/core/grid.hpp"
#include "treadmark/model/shape/profile.hpp"

namespace treadmark {

/// A row of the profiles that StandardProfile::name may name. Capital and small letters, blanks, underscores and
/// hyphens between words make no difference; before a number a hyphen is its sign ("cone -1:20").
struct LibraryProfile {
  std::string name;   ///< "60E1"; of a family with a placeholder: "cone 1:N"
  std::string also;   ///< other names, with commas between them; may be empty
  std::string shape;  ///< arcs from the crown outwards, or what the variants are, in words
  std::string source;
  Body body = Body::rail;
  bool family = false;               ///< the name has a placeholder
  double height = 0.0, width = 0.0;  ///< rail: of the section and its foot; wheel: flange, flange back to field end [m]
  double area = 0.0, mass_per_m = 0.0;  ///< rail, of the whole section [m^2], [kg/m]; 0: head only, or a wheel
};

/// All of them, rails first. Thread-safe.
const std::vector<LibraryProfile>& profile_library();

/// The body of the profile, or nothing where the name is none. Thread-safe. Errors: Error(configuration) for dimensions
/// that the profile does not come in.
std::optional<Body> library_body(std::string_view name);

/// The profile and, of wheels of EN 13715, those that differ in thinner flanges alone, thickest first: what a wheel may
/// be turned to. Errors: as library_body.
std::vector<std::string> thinner_flanges(const std::string& name);

/// The whole outline for pictures [m], z down: rails with web and foot from the middle of the base round, where they
/// are known; of others the profile as points. step: along arcs [m]. Errors: Error(configuration) for an unknown name.
std::vector<Vec2> library_outline(std::string_view name, double step);

}  // namespace treadmark
