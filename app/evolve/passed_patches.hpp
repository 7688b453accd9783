// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <vector>

#include "treadmark/analysis/damage/flow.hpp"
#include "treadmark/analysis/damage/passed_patch.hpp"
#include "treadmark/analysis/damage/record.hpp"
#include "treadmark/io/cases/case_model.hpp"
#include "treadmark/io/results/result_model.hpp"
#include "treadmark/model/damage/fatigue.hpp"

namespace treadmark::app {

/// The patches of a solved case as the own surface of a body sees them: elements in contact, in the coordinates of the
/// profile as it is given (for the right-hand side), with what they do to it as wholes. Errors: Error(configuration)
/// for cases that do not roll or have no tractions.
std::vector<damage::PassedPatch> passed_patches(const io::Case& given, const io::CaseResult& result, Body body,
                                                const FatigueSettings& fatigue = {});

/// Adds to the patches of a case what points below their rows endure, at the depths of the settings: every point sees
/// the stresses of the patch along its row, one after the other. Half-spaces, as in the contact problem. Errors:
/// Error(configuration) for depths of less than an element.
void add_stresses(std::vector<damage::PassedPatch>& patches, const io::Case& given, const io::CaseResult& result,
                  Body body, const FatigueSettings& fatigue);

/// Shear stresses on planes parallel to the surface, at the depths of the law below one of the patches and beside it,
/// where they are above the yield of the fresh material. Half-spaces, as above. Errors: as above.
std::vector<damage::PassedShear> passed_shears(const io::Case& given, const io::CaseResult& result, std::size_t number,
                                               Body body, const FlowLaw& law);

/// Where along a body the contacts of a case are: x of a rail [m], theta of a wheel, within [0, 2 pi) [rad].
double place_along(const io::WheelRailCase& input, Body body);

/// What part of the body each case of a position stands for, in the order of the cases: up to the middle between
/// neighbours; on a wheel the rest of the turn is shared by the first and the last, on a rail these have as much on
/// their outer side as on the inner one (one alone: length). Errors: Error(configuration) for two cases at one place.
std::vector<damage::Stretch> stretches(const std::vector<double>& places, Body body, double length);

}  // namespace treadmark::app
