// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/scans/virtual/check_settings.hpp"

#include <cmath>
#include <numbers>
#include <string>

#include <fmt/format.h>

#include "treadmark/core/error.hpp"

namespace treadmark::scans::scanner {
namespace {

constexpr double kMostLost = 0.9;
constexpr double kMostLength = 1.0;  // [m] what is more is most likely another unit
constexpr int kMostPasses = 1000;

[[noreturn]] void refuse(const std::string& what, const std::string& advice = {}) {
  throw Error(ErrorKind::configuration, what, {}, advice);
}

void check_length(double value, const char* what) {
  if (!(value >= 0.0 && value <= kMostLength))
    refuse(fmt::format("{} of a virtual scan must lie between 0 and {:g} mm, it is {:g} mm", what, 1e3 * kMostLength,
                       1e3 * value));
}

void check_share(double value, const char* what) {
  if (!(value >= 0.0 && value <= kMostLost))
    refuse(fmt::format("the share of {} in a virtual scan must lie between 0 and {:g}, it is {:g}", what, kMostLost,
                       value));
}

}  // namespace

void check_settings(const ScannerSettings& s) {
  if (s.body == Body::wheel && !(s.nominal_radius > 0.0 && std::isfinite(s.nominal_radius)))
    refuse("the scan of a wheel needs its nominal radius");
  if (s.body == Body::wheel && s.line) refuse("a wheel does not lie along a line");
  if (!(s.u_min < s.u_max) || !(s.y_min < s.y_max)) refuse("a range must run from a smaller to a greater number");
  check_length(s.spacing, "the spacing");
  check_length(s.noise, "the noise");
  check_length(s.noise_lateral, "the lateral noise");
  check_length(s.registration, "the error of registration");
  check_length(s.hole_size, "the size of holes");
  check_share(s.outliers, "outliers");
  check_share(s.holes, "holes");
  check_share(s.drop_outs, "drop-outs");
  if (s.holes > 0.0 && !(s.hole_size > 0.0)) refuse("holes need a size");
  if (s.spacing == 0.0 && s.points == 0) refuse("a virtual scan needs points or their spacing");
  if (s.spacing == 0.0 && static_cast<double>(s.points) > kMostPoints)
    refuse("a virtual scan has 200 million points at most", "ask for fewer points");
  if (!(s.most_incidence >= 0.0 && s.most_incidence <= 0.5 * std::numbers::pi))
    refuse("the greatest angle of incidence must lie between 0 and 90 degrees");
  if (s.passes < 1 || s.passes > kMostPasses)
    refuse(fmt::format("a virtual scan has 1 to {} passes, not {}", kMostPasses, s.passes));
  if (!s.stands.empty()) {
    if (s.passes != 1 || s.stands.size() > static_cast<std::size_t>(kMostPasses))
      refuse(fmt::format("a scanner makes one pass from each place where it stands, at {} places at most", kMostPasses),
             "leave out the number of passes");
    if (s.line) refuse("a scanner that stands somewhere sees a straight rail", "leave out the line, or the places");
    for (const Vec3& stand : s.stands)
      if (!stand.allFinite()) refuse("a place where the scanner stands is no finite number");
  }
  constexpr double kRigid = 1e-9;
  const Mat3 off = s.X_CS.rotation.transpose() * s.X_CS.rotation - Mat3::Identity();
  if (!s.random_frame &&
      (!s.X_CS.origin.allFinite() || !(off.cwiseAbs().maxCoeff() < kRigid) || !(s.X_CS.rotation.determinant() > 0.0)))
    refuse("the pose of the surface in the cloud is no rigid motion");
}

}  // namespace treadmark::scans::scanner
