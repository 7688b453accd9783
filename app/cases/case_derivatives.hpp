// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "treadmark/app/cases/section_heights.hpp"
#include "treadmark/app/surfaces/sampled_surfaces.hpp"
#include "treadmark/app/surfaces/surface_store.hpp"
#include "treadmark/core/progress.hpp"
#include "treadmark/io/cases/case_model.hpp"
#include "treadmark/io/results/listed_number.hpp"
#include "treadmark/io/results/result_model.hpp"
#include "treadmark/solvers/wheelrail/configuration.hpp"
#include "treadmark/solvers/wheelrail/pair_gradient.hpp"

namespace treadmark::app {

/// Adds derivatives to the cases of a result of this file, by keys of the case file that are numbers, also of list
/// elements ("wheel.flats.0.depth_mm"), and by all parameters of a surface ("rail.shape", "wheel.shape"). No keys:
/// placement, motion, load and friction, as far as a case gives them. The store is that of the run. Every case is
/// solved again, more exactly; what has no derivatives says why, and so does a case that has none. After a stop request
/// the other cases have none and the run is not complete. Errors: Error(configuration) for what is no key or no number,
/// and a key that no case has.
void add_derivatives(io::RunResult& result, const io::CaseFile& file, SurfaceStore& store,
                     const std::vector<std::string>& keys, const Progress& progress = {});

/// Derivatives of one case by keys, none: no usual ones, and after them by the factors of heights. Where contact does
/// not follow from a key they are 0. added: heights that its surface has already, of the same body and places; null:
/// none.
io::CaseDerivatives derivatives_by(const io::Case& c, SurfaceStore& store, const SampledRegions& regions,
                                   const std::vector<std::string>& keys, std::span<const SectionHeights> heights,
                                   const SectionHeights* added = nullptr);
/// The numbers that are known of a result and may have derivatives, by their names in JSON and in their units.
std::vector<std::pair<std::string, double>> smooth_numbers(const io::CaseResult& result);

/// The errors that it has, before anything is solved.
void check_derivative_keys(const io::CaseFile& file, const std::vector<std::string>& keys);

/// Over which a number of this value is differenced, in its unit of SI: what moves surfaces by some hundredths of a
/// micrometre, and of others a part of their value that rounding does not swallow.
double difference_step(std::string_view si_unit, double value);

/// A number of results as one that has derivatives by gaps, and how much one of it is of that.
struct GapNumber {
  wheelrail::PairQuantity quantity;
  double factor = 1.0;
};
/// patch: counted from 1. Errors: Error(configuration) for a number without them.
GapNumber gap_number(const io::ListedNumber& number);

}  // namespace treadmark::app
