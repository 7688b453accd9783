// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/io/imports/import_report.hpp"

namespace treadmark {
namespace {

using access::flag;
using access::of;
using access::part;
using unit::kMm;
using unit::kMm3;
using unit::kOne;
using Input = io::ImportReport::Input;
using Pass = io::ImportReport::Pass;
using Hole = io::ImportReport::Hole;
using Damage = io::ImportReport::Damage;
using Level = io::ImportReport::Level;
using Output = io::ImportReport::Output;
using ErrorPart = io::ImportReport::ErrorPart;
using Step = io::ImportReport::Step;
using Distances = io::ImportReport::Distances;
using Kept = io::ImportReport::Sections;
using Line = io::ImportReport::Line;
using LinePlace = io::ImportReport::LinePlace;
using Track = io::ImportReport::Track;
using TrackPlace = io::ImportReport::TrackPlace;
using NoiseClass = io::ImportReport::NoiseClass;
using Registration = io::ImportReport::Registration;

constexpr FileUnit kUm{"\u00b5m", 1e6, "m"}, kMm2{"mm\u00b2", 1e6, "m2"}, kCubicMm{"mm\u00b3", 1e9, "m3"},
    kMrad{"mrad", 1e3, "rad"}, kPerM{"1/m"}, kMradPerM{"mrad/m", 1e3, "rad/m"};

// A row of a table stays a row: clang-format would give each column a line.
// clang-format off
constexpr Column<Input> kInputs[] = {
    {"file", kOne, "", of<&Input::file>(), "", 0, "file"},
    {"sha256", kOne, "", of<&Input::sha256>()},
    {"format", kOne, "", of<&Input::format>(), "", 0, "format"},
    {"points", kOne, "", of<&Input::points>(), "", 0, "points"},
    {"not_finite", kOne, "", of<&Input::not_finite>(), "", 0, "not finite"},
    {"", kOne, "", of<&Input::sha256>(), "", 0, "SHA-256"}};  // people read it last

constexpr Column<Pass> kPasses[] = {
    {"pass", kOne, "", of<&Pass::pass>(), "", 0, "pass"},
    {"points", kOne, "", of<&Pass::points>(), "", 0, "points"},
    {"", kMm, "", part<&Pass::shift_S, 0>(), "", 0, "shift x"},
    {"", kMm, "", part<&Pass::shift_S, 1>(), "", 0, "shift y"},
    {"", kMm, "", part<&Pass::shift_S, 2>(), "", 0, "shift z"},
    {"", kMrad, "", part<&Pass::turn_S, 0>(), "", 0, "turn x"},
    {"", kMrad, "", part<&Pass::turn_S, 1>(), "", 0, "turn y"},
    {"", kMrad, "", part<&Pass::turn_S, 2>(), "", 0, "turn z"}};

constexpr Column<Hole> kHoles[] = {
    {"diameter_mm", kMm, "", of<&Hole::diameter>(), "", 0, "diameter"},
    {"area_mm2", kMm2, "", of<&Hole::area>(), "", 0, "area"},
    {"filled", kOne, "", flag<&Hole::filled>()},
    {"", kOne, "", access::word(+[](const Hole& hole) { return std::string(hole.filled ? "by the fit" : "stays open"); }), "", 0, "filled"}};

constexpr Column<Damage> kDamage[] = {
    {"length_mm", kMm, "", of<&Damage::length>(), "along u", 0, "length"},
    {"width_mm", kMm, "", of<&Damage::width>(), "along the section", 0, "width"},
    {"depth_mm", kMm, "", of<&Damage::depth>(), "negative: stands out", 0, "depth"},
    {"volume_mm3", kCubicMm, "", of<&Damage::volume>(), "missing; negative: stands out", 0, "missing volume"}};

constexpr Column<Level> kLevels[] = {
    {"knot_a_mm", kMm, "", of<&Level::knot_a>(), "", 0, "knots along"},
    {"knot_s_mm", kMm, "", of<&Level::knot_s>(), "", 0, "knots across"},
    {"functions", kOne, "", of<&Level::functions>(), "", 0, "functions"},
    {"used", kOne, "", of<&Level::used>(), "", 0, "used"},
    {"iterations", kOne, "", of<&Level::iterations>(), "", 0, "iterations"}};

constexpr Column<Output> kOutputs[] = {
    {"file", kOne, "", of<&Output::file>(), "", 0, "file"},
    {"kind", kOne, "", of<&Output::kind>(), "", 0, "kind"},
    {"", kOne, "", of<&Output::details>(), "", 0, "content"},
    {"sha256", kOne, "", of<&Output::sha256>()},
    {"bytes", {"bytes"}, "", of<&Output::bytes>(), "", 0, "size"},
    {"details", kOne, "", of<&Output::details>()},
    {"height_max_um", kUm, "", of<&Output::height_max>(), "distance of the written surface, read back, from the fitted one", 0, "largest distance"},
    {"height_rms_um", kUm, "", of<&Output::height_rms>(), "", 0, "rms distance"},
    {"", kOne, "", of<&Output::sha256>(), "", 0, "SHA-256"}};

constexpr Column<Step> kSteps[] = {
    {"step", kOne, "", of<&Step::name>(), "", 0, "step"},
    {"seconds", {"s"}, "", of<&Step::seconds>(), "", 0, "time"}};

constexpr Column<Distances> kDistances[] = {
    {"mean_um", kUm, "", of<&Distances::mean>(), "positive: the surface stands out of the reference"},
    {"rms_um", kUm, "", of<&Distances::rms>()},
    {"largest_um", kUm, "", of<&Distances::largest>(), "without sign"},
    {"within_95_um", kUm, "", of<&Distances::within_95>(), "95 % are no farther than this"},
    {"within_99_um", kUm, "", of<&Distances::within_99>(), "99 % are no farther than this"}};

constexpr Column<Kept> kKept[] = {
    {"count", kOne, "", of<&Kept::count>()},
    {"fewest_points", kOne, "", of<&Kept::fewest_points>()},
    {"most_points", kOne, "", of<&Kept::most_points>()},
    {"least_gap_mm", kMm, "", of<&Kept::least_gap>()},
    {"widest_gap_mm", kMm, "", of<&Kept::widest_gap>()},
    {"spread_mm", kMm, "", of<&Kept::spread>(), "farthest that a point lies from its section, along the band"},
    {"smoothing_lambda_mm3", kMm3, "", of<&Kept::smoothing>(), "of triangles and offsets made of sections that noise does not smooth"},
    {"smoothed_um", kUm, "", of<&Kept::smoothed>(), "points moved by their noise: root mean square of what they were moved by"}};

constexpr Column<Line> kLine[] = {
    {"bent", kOne, "", flag<&Line::bent>(), "the surface is straightened along it; else straight by what the points tell"},
    {"deviation_mm", kMm, "", of<&Line::deviation>(), "farthest that it lies off a straight line"},
    {"given_largest_mm", kMm, "", of<&Line::given_largest>(), "farthest that it lies off the line that was given"},
    {"given_rms_mm", kMm, "", of<&Line::given_rms>()}};

constexpr Column<LinePlace> kLinePlaces[] = {
    {"x_mm", kMm, "", of<&LinePlace::x>(), "along the rail"},
    {"place_x_mm", kMm, "", part<&LinePlace::place, 0>(), "where the x axis of the surface is in the cloud"},
    {"place_y_mm", kMm, "", part<&LinePlace::place, 1>()},
    {"place_z_mm", kMm, "", part<&LinePlace::place, 2>()},
    {"curvature_per_m", kPerM, "", of<&LinePlace::curvature>(), "positive to the right"},
    {"curvature_error_per_m", kPerM, "", of<&LinePlace::curvature_error>(), "standard error"},
    {"vertical_per_m", kPerM, "", of<&LinePlace::vertical>(), "curvature, positive down"},
    {"vertical_error_per_m", kPerM, "", of<&LinePlace::vertical_error>(), "standard error"},
    {"twist_mrad_per_m", kMradPerM, "", of<&LinePlace::twist>(), "of the section about x"},
    {"twist_error_mrad_per_m", kMradPerM, "", of<&LinePlace::twist_error>(), "standard error"},
    {"roll_mrad", kMrad, "", of<&LinePlace::roll>(), "right side low: from level where placement.up was given, else from the first place"},
    {"gradient_mrad", kMrad, "", of<&LinePlace::gradient>(), "up, where placement.up was given"}};

constexpr Column<Track> kTrack[] = {
    {"gauge_least_mm", kMm, "", of<&Track::gauge_least>(), "of the places"},
    {"gauge_greatest_mm", kMm, "", of<&Track::gauge_greatest>()},
    {"gauge_mean_mm", kMm, "", of<&Track::gauge_mean>()}};

constexpr Column<TrackPlace> kTrackPlaces[] = {
    {"x_mm", kMm, "", of<&TrackPlace::x>(), "along the right rail", 0, "x"},
    {"place_x_mm", kMm, "", part<&TrackPlace::place, 0>(), "between the tops of both heads, in the cloud"},
    {"place_y_mm", kMm, "", part<&TrackPlace::place, 1>()},
    {"place_z_mm", kMm, "", part<&TrackPlace::place, 2>()},
    {"gauge_mm", kMm, "", of<&TrackPlace::gauge>(), "least distance of the heads down to 14 mm below their tops; null where one was not scanned so far down", 0, "gauge"},
    {"cant_mm", kMm, "", of<&TrackPlace::cant>(), "how much higher the left rail is, where placement.up was given", 0, "cant"}};

constexpr Column<NoiseClass> kNoiseClasses[] = {
    {"class", kOne, "", of<&NoiseClass::name>(), "pass, angle to the beam or intensity", 0, "of"},
    {"points", kOne, "", of<&NoiseClass::points>(), "", 0, "points"},
    {"factor", kOne, "", of<&NoiseClass::factor>(), "of their standard deviation over the usual one at their place", 0, "times the noise"}};

constexpr Column<Registration> kRegistrations[] = {
    {"pass", kOne, "", of<&Registration::pass>(), "", 0, "scan"},
    {"points", kOne, "", of<&Registration::points>(), "", 0, "points"},
    {"overlap", kOne, "", of<&Registration::overlap>(), "part of its surface that others have seen, too", 0, "overlap"},
    {"apart_um", kUm, "", of<&Registration::apart>(), "from these, after it was moved: standard deviation", 0, "apart"},
    {"shift_error_um", kUm, "", of<&Registration::shift_error>(), "standard error, of what the overlap determines", 0, "error of shift"},
    {"turn_error_mrad", kMrad, "", of<&Registration::turn_error>(), "", 0, "error of turn"},
    {"open", kOne, "", of<&Registration::open>(), "directions of six that the overlap does not determine", 0, "left open"}};
constexpr Column<ErrorPart> kErrorParts[] = {
    {"source", kOne, "", of<&ErrorPart::source>(), "lateral placement, tilt, height, registration, smoothing, filled holes or scanner", 0, "source"},
    {"lateral_mm", kMm, "", of<&ErrorPart::lateral>(), "standard deviation of where the section lies across", 0, "across"},
    {"vertical_mm", kMm, "", of<&ErrorPart::vertical>(), "along z, of a wheel of its radius, with it", 0, "down"},
    {"roll_mrad", kMrad, "", of<&ErrorPart::roll>(), "y towards z, with it", 0, "roll"},
    {"heights_um", kUm, "", of<&ErrorPart::heights>(), "standard deviation of heights, the largest", 0, "heights, at most"},
    {"length_mm", kMm, "", of<&ErrorPart::length>(), "places so far apart have errors of their own; 0: alike everywhere", 0, "alike over"}};

constexpr Column<ErrorSize> kErrors[] = {
    {"rms_um", kUm, "", of<&ErrorSize::rms>()},
    {"largest_um", kUm, "", of<&ErrorSize::largest>()}};

}  // namespace

template <> std::span<const Column<Input>> columns() { return kInputs; }
template <> std::span<const Column<Pass>> columns() { return kPasses; }
template <> std::span<const Column<Hole>> columns() { return kHoles; }
template <> std::span<const Column<Damage>> columns() { return kDamage; }
template <> std::span<const Column<Level>> columns() { return kLevels; }
template <> std::span<const Column<Output>> columns() { return kOutputs; }
template <> std::span<const Column<Step>> columns() { return kSteps; }
template <> std::span<const Column<Distances>> columns() { return kDistances; }
template <> std::span<const Column<Kept>> columns() { return kKept; }
template <> std::span<const Column<Line>> columns() { return kLine; }
template <> std::span<const Column<LinePlace>> columns() { return kLinePlaces; }
template <> std::span<const Column<Track>> columns() { return kTrack; }
template <> std::span<const Column<TrackPlace>> columns() { return kTrackPlaces; }
template <> std::span<const Column<NoiseClass>> columns() { return kNoiseClasses; }
template <> std::span<const Column<Registration>> columns() { return kRegistrations; }
template <> std::span<const Column<ErrorSize>> columns() { return kErrors; }
template <> std::span<const Column<ErrorPart>> columns() { return kErrorParts; }
// clang-format on

}  // namespace treadmark
