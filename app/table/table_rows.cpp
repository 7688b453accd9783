// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/app/table/force_tables.hpp"

namespace treadmark {
namespace {

using H = app::TableHead;
using N = app::TableNode;
using C = vehicle::ContactUnderLoad;
using P = vehicle::ContactPart;
using access::of;
using access::within;
using unit::kJ;
using unit::kM;
using unit::kN;
using unit::kOne;

constexpr FileUnit kRad{"rad"}, kM2{"m2"}, kSpeed{"m/s"};

// clang-format off
constexpr Column<H> kHead[] = {
    {"load_N", kN, "load", of<&H::load>(), "reference load", kInTable, "reference load", 0},
    {"roll_most_rad", kRad, "roll_most", of<&H::roll_most>(), "rolls covered, to both sides"},
    {"roll_intervals", kOne, "roll_intervals", of<&H::roll_intervals>()},
    {"yaw_most_rad", kRad, "yaw_most", of<&H::yaw_most>(), "yaws covered, to both sides"},
    {"yaw_intervals", kOne, "yaw_intervals", of<&H::yaw_intervals>()},
    {"element_size_m", kM, "element_size", of<&H::element_size>(), "of the problems solved at the nodes"},
    {"rail_y_m", kM, "rail_y", of<&H::rail_y>(), "origin of the rail's profile"},
    {"rail_z_m", kM, "rail_z", of<&H::rail_z>()},
    {"rail_roll_rad", kRad, "rail_roll", of<&H::rail_roll>()},
    {"wheelset_z_m", kM, "wheelset_z", of<&H::wheelset_z>(), "middle of the axle in the central position"},
    {"wheel_y_m", kM, "wheel_y", of<&H::wheel_y>(), "origin of the wheel's profile there"},
    {"wheel_z_m", kM, "wheel_z", of<&H::wheel_z>()},
    {"points", kOne, "points", of<&H::points>(), "of the comparison"},
    {"speed_m_s", kSpeed, "speed", of<&H::speed>(), "of the comparison"},
    {"creepage", kOne, "creepage", of<&H::creepage>(), "greatest of the comparison, longitudinal and lateral", kInTable, "creepages up to", 4},
    {"creep_forces", kOne, "creep_forces", of<&H::creep_forces>(), "", kInTable, "creep forces"}};

constexpr Column<N> kNodes[] = {
    {"roll_rad", kRad, "roll", of<&N::roll>(), "of the wheel against the rail"},
    {"yaw_rad", kRad, "yaw", of<&N::yaw>(), "of the wheelset"},
    {"y_m", kM, "y", of<&N::y>(), "of the wheel against the rail from its central position"},
    {"load_N", kN, "load", of<&N::load>(), "vertical, without friction"},
    {"z_m", kM, "z", within<&N::contact, &C::z>(), "displacement of the wheel downwards"},
    {"elastic_energy_J", kJ, "elastic_energy", within<&N::contact, &C::elastic_energy>()},
    {"slope", kOne, "slope", within<&N::contact, &C::slope>(), "tangent of the contact angle"},
    {"wheel_y_m", kM, "wheel_y", within<&N::contact, &C::wheel_y>(), "place of the resultant on the wheel, from its profile's origin"},
    {"wheel_z_m", kM, "wheel_z", within<&N::contact, &C::wheel_z>()},
    {"share", kOne, "share", within<&N::part, &P::share>(), "of the normal force, that one of the contacts carries"},
    {"angle_rad", kRad, "angle", within<&N::part, &P::angle>(), "of this contact"},
    {"part_y_m", kM, "part_y", within<&N::part, &P::wheel_y>(), "its place on the wheel"},
    {"part_z_m", kM, "part_z", within<&N::part, &P::wheel_z>()},
    {"area_m2", kM2, "area", within<&N::part, &P::area>(), "its area"},
    {"log_aspect", kOne, "log_aspect", within<&N::part, &P::log_aspect>(), "ln(a/b) of its ellipse"}};
// clang-format on

}  // namespace

template <>
std::span<const Column<app::TableHead>> columns() {
  return kHead;
}
template <>
std::span<const Column<app::TableNode>> columns() {
  return kNodes;
}

}  // namespace treadmark
