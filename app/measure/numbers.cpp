// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/app/measure/numbers.hpp"

#include "treadmark/core/constants.hpp"

namespace treadmark::app {
namespace {

using unit::kMm;

constexpr FileUnit kMm2{"mm2", 1e6, "m2"}, kDeg{"deg", 180.0 / kPi, "rad"}, kPerCent{"%", 1e2, "1"}, kDb{"dB"};

template <class Numbers, auto at>
constexpr NumberRow<Numbers> row(std::string_view key, std::string_view label, FileUnit unit) {
  using N = const Numbers&;
  return {{key,
           unit,
           "",
           {[](N n) { return (n.*at).value; }, nullptr, [](N n) { return (n.*at).known(); }, false, nullptr, nullptr,
            [](N n) { return (n.*at).uncertainty; }, [](N n) { return (n.*at).reason; }},
           label,
           kOnlyInFiles,
           label,
           3},
          at};
}

using W = WheelNumbers;
constexpr NumberRow<W> kWheelRows[] = {
    row<W, &W::flange_height>("flange_height_mm", "flange height Sh", kMm),
    row<W, &W::flange_thickness>("flange_thickness_mm", "flange thickness Sd", kMm),
    row<W, &W::flange_gradient>("flange_gradient_mm", "flange gradient qR", kMm),
    row<W, &W::flange_angle>("flange_angle_deg", "flange angle", kDeg),
    row<W, &W::diameter>("diameter_mm", "diameter at the tape line", kMm),
    row<W, &W::hollow>("hollow_mm", "hollow wear", kMm),
    row<W, &W::rollover>("rollover_mm", "tread roll-over", kMm),
    row<W, &W::rim_width>("rim_width_mm", "width of the rim", kMm),
    row<W, &W::tread_wear>("tread_wear_mm", "tread wear", kMm),
    row<W, &W::flange_wear>("flange_wear_mm", "flange wear", kMm),
    row<W, &W::area_lost>("area_lost_mm2", "area lost", kMm2),
    row<W, &W::area_gained>("area_gained_mm2", "area outside the nominal", kMm2),
    row<W, &W::diameter_lost>("diameter_lost_mm", "diameter lost by re-profiling", kMm),
    row<W, &W::runout>("runout_mm", "radial run-out at the tape line", kMm),
    row<W, &W::axial_runout>("axial_runout_mm", "axial run-out of the flange back", kMm),
    row<W, &W::eccentricity>("eccentricity_mm", "eccentricity (order 1)", kMm),
    row<W, &W::flat_depth>("flat_depth_mm", "depth of the deepest flat", kMm),
    row<W, &W::flat_length>("flat_length_mm", "length of the deepest flat", kMm),
    row<W, &W::back_to_back>("back_to_back_mm", "back to back", kMm),
    row<W, &W::active_faces>("active_faces_mm", "active faces (back to back and both Sd)", kMm),
};

using R = RailNumbers;
constexpr NumberRow<R> kRailRows[] = {
    row<R, &R::w1>("w1_mm", "vertical wear W1", kMm),
    row<R, &R::w2>("w2_mm", "side wear W2", kMm),
    row<R, &R::w3>("w3_mm", "wear at 45 degrees W3", kMm),
    row<R, &R::equivalent>("equivalent_wear_mm", "equivalent wear W1 + W2/2", kMm),
    row<R, &R::loss>("loss_mm2", "area lost of the head", kMm2),
    row<R, &R::loss_top>("loss_top_mm2", "of it at the top", kMm2),
    row<R, &R::loss_side>("loss_side_mm2", "of it at the sides", kMm2),
    row<R, &R::loss_part>("loss_percent", "area lost of the head", kPerCent),
    row<R, &R::lip>("lip_mm2", "area outside the nominal", kMm2),
    row<R, &R::face_angle>("face_angle_deg", "inclination of the gauge face", kDeg),
    row<R, &R::head_width>("head_width_mm", "head width 14 mm below the top", kMm),
    row<R, &R::crown_radius>("crown_radius_mm", "radius of the crown", kMm),
    row<R, &R::inclination>("inclination_deg", "inclination", kDeg),
    row<R, &R::roughness_exceedance>("roughness_exceedance_db", "roughness over its limit, at most", kDb),
};

}  // namespace

std::span<const NumberRow<WheelNumbers>> number_rows(const WheelNumbers&) { return kWheelRows; }
std::span<const NumberRow<RailNumbers>> number_rows(const RailNumbers&) { return kRailRows; }

}  // namespace treadmark::app
