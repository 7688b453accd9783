// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/app/measure/numbers.hpp"

#include <numbers>

namespace treadmark::app {
namespace {

constexpr double kMilli = 1e-3, kSquare = 1e-6, kDegrees = std::numbers::pi / 180.0, kPerCent = 1e-2;

using W = WheelNumbers;
constexpr NumberRow<W> kWheelRows[] = {
    {"flange_height_mm", "flange height Sh", kMilli, &W::flange_height},
    {"flange_thickness_mm", "flange thickness Sd", kMilli, &W::flange_thickness},
    {"flange_gradient_mm", "flange gradient qR", kMilli, &W::flange_gradient},
    {"flange_angle_deg", "flange angle", kDegrees, &W::flange_angle},
    {"diameter_mm", "diameter at the tape line", kMilli, &W::diameter},
    {"hollow_mm", "hollow wear", kMilli, &W::hollow},
    {"rollover_mm", "tread roll-over", kMilli, &W::rollover},
    {"rim_width_mm", "width of the rim", kMilli, &W::rim_width},
    {"tread_wear_mm", "tread wear", kMilli, &W::tread_wear},
    {"flange_wear_mm", "flange wear", kMilli, &W::flange_wear},
    {"area_lost_mm2", "area lost", kSquare, &W::area_lost},
    {"area_gained_mm2", "area outside the nominal", kSquare, &W::area_gained},
    {"diameter_lost_mm", "diameter lost by re-profiling", kMilli, &W::diameter_lost},
    {"runout_mm", "radial run-out at the tape line", kMilli, &W::runout},
    {"axial_runout_mm", "axial run-out of the flange back", kMilli, &W::axial_runout},
    {"eccentricity_mm", "eccentricity (order 1)", kMilli, &W::eccentricity},
    {"flat_depth_mm", "depth of the deepest flat", kMilli, &W::flat_depth},
    {"flat_length_mm", "length of the deepest flat", kMilli, &W::flat_length},
    {"back_to_back_mm", "back to back", kMilli, &W::back_to_back},
    {"active_faces_mm", "active faces (back to back and both Sd)", kMilli, &W::active_faces},
};

using R = RailNumbers;
constexpr NumberRow<R> kRailRows[] = {
    {"w1_mm", "vertical wear W1", kMilli, &R::w1},
    {"w2_mm", "side wear W2", kMilli, &R::w2},
    {"w3_mm", "wear at 45 degrees W3", kMilli, &R::w3},
    {"equivalent_wear_mm", "equivalent wear W1 + W2/2", kMilli, &R::equivalent},
    {"loss_mm2", "area lost of the head", kSquare, &R::loss},
    {"loss_top_mm2", "of it at the top", kSquare, &R::loss_top},
    {"loss_side_mm2", "of it at the sides", kSquare, &R::loss_side},
    {"loss_percent", "area lost of the head", kPerCent, &R::loss_part},
    {"lip_mm2", "area outside the nominal", kSquare, &R::lip},
    {"face_angle_deg", "inclination of the gauge face", kDegrees, &R::face_angle},
    {"head_width_mm", "head width 14 mm below the top", kMilli, &R::head_width},
    {"crown_radius_mm", "radius of the crown", kMilli, &R::crown_radius},
    {"inclination_deg", "inclination", kDegrees, &R::inclination},
    {"roughness_exceedance_db", "roughness over its limit, at most", 1.0, &R::roughness_exceedance},
};

}  // namespace

std::span<const NumberRow<WheelNumbers>> number_rows(const WheelNumbers&) { return kWheelRows; }
std::span<const NumberRow<RailNumbers>> number_rows(const RailNumbers&) { return kRailRows; }

}  // namespace treadmark::app
