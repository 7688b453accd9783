// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <memory>
#include <random>
#include <string>
#include <string_view>
#include <vector>

#include "treadmark/detection/contact_search.hpp"

namespace treadmark::testing {

/// Rails and wheels in one representation: a standard rail with a squat and one with waves, a rail with three humps and
/// a step along the track (like the nose of a crossing), a wheel with two flats.
struct Bodies {
  std::vector<std::shared_ptr<const Surface>> rails, wheels;
};
Bodies bodies_in(std::string_view backend);

/// A wheel somewhere over a rail: any lateral position up to the edges of the rail, rolled, yawed and pitched.
detection::BodyPair random_pair(const Bodies& bodies, std::mt19937& random);

/// Windows, rules and fineness of any kind, small enough for brute force.
detection::SearchSettings random_settings(const detection::BodyPair& pair, std::mt19937& random);

/// What differs between two results, in words; empty if nothing does beyond rounding.
std::string difference(const detection::SearchResult& a, const detection::SearchResult& b, double tolerance);

}  // namespace treadmark::testing
