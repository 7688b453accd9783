// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/app/track/track_run.hpp"

#include <cmath>

#include <fmt/format.h>

#include "treadmark/core/cancellation.hpp"
#include "treadmark/core/constants.hpp"
#include "treadmark/core/error.hpp"
#include "treadmark/core/platform/ranges.hpp"
#include "treadmark/solvers/vehicle/frequencies.hpp"
#include "treadmark/solvers/vehicle/track/lateral_track.hpp"
#include "treadmark/solvers/vehicle/track/rail_on_seats.hpp"
#include "treadmark/solvers/vehicle/track/track_receptance.hpp"

namespace treadmark::app {
namespace {

using Complex = std::complex<double>;

/// Heights of the parts of a lumped track [m]: of no influence on vertical motion.
constexpr double kRailHeight = 0.09, kFootHeight = 0.17, kSleeperHeight = 0.28, kBedHeight = 0.39;

std::vector<TrackCurve> lateral_curve(const std::optional<TrackModel>& track, const std::vector<double>& frequency) {
  if (!track) return {};
  const double rest[] = {0.0};
  TrackCurve curve{"rail, lateral", "lateral", vehicle::receptance(*track, Freedom::y, frequency),
                   vehicle::receptance(*track, Freedom::y, rest).front().real()};
  if (!(curve.at_rest > 0.0)) return {};
  return {std::move(curve)};
}

/// What is fitted to their logarithms' mean is nearest to all of them. What takes energy has phases of one half turn.
Complex mean_of(std::span<const Complex> all) {
  Complex sum = 0.0;
  for (const Complex& one : all) sum += std::log(one);
  return std::exp(sum / static_cast<double>(all.size()));
}

/// Fills curves: values gives one number for each of them at a frequency.
template <class Values>
void fill(const std::vector<double>& frequency, std::vector<TrackCurve>& curves, Values&& values) {
  const auto at_rest = values(0.0);
  for (std::size_t c = 0; c < curves.size(); ++c) curves[c].at_rest = at_rest[c].real();
  for (const double f : frequency) {
    check_cancelled();
    const auto at = values(f);
    for (std::size_t c = 0; c < curves.size(); ++c) curves[c].receptance.push_back(at[c]);
  }
}

void run_flexible(const FlexibleTrack& track, TrackResult& result) {
  constexpr int kMeanPlaces = 8;
  const vehicle::RailOnSeats rail(track);
  const double bay = rail.middle_bay(), middle = rail.middle();
  std::vector<double> places{middle, middle + 0.5 * bay};
  for (int i = 0; i < kMeanPlaces; ++i) places.push_back(middle + (i + 0.5) / kMeanPlaces * bay - 0.5 * bay);
  result.curves = {{"between sleepers", "between", {}, 0.0},
                   {"over a sleeper", "over", {}, 0.0},
                   {"mean of a bay", "mean", {}, 0.0}};
  const double aside = result.request.aside;
  std::optional<vehicle::RailOnSeats> sideways;
  if (track.sideways) sideways.emplace(track, vehicle::RailPlane::sideways);
  fill(result.frequency, result.curves, [&](double f) {
    std::vector<Complex> all = rail.receptance(places, f);
    // Beside the middle of the head rolling counts, too.
    if (sideways && aside != 0.0) {
      const std::vector<Eigen::MatrixXcd> more = sideways->receptances(places, f);
      for (std::size_t i = 0; i < all.size(); ++i) all[i] += aside * aside * more[i](1, 1);
    }
    return std::array<Complex, 3>{all[0], all[1], mean_of(std::span(all).subspan(2))};
  });
  if (sideways) {
    result.lateral = {{"lateral, between", "lateral_between", {}, 0.0},
                      {"lateral, over", "lateral_over", {}, 0.0},
                      {"lateral, mean", "lateral", {}, 0.0}};
    if (aside != 0.0) result.lateral.push_back({"vertical by lateral", "cross", {}, 0.0});
    fill(result.frequency, result.lateral, [&](double f) {
      std::vector<Complex> all;
      const std::vector<Eigen::MatrixXcd> at = sideways->receptances(places, f);
      all.reserve(at.size());
      for (const Eigen::MatrixXcd& one : at) all.push_back(one(0, 0));
      return std::array<Complex, 4>{all[0], all[1], mean_of(std::span(all).subspan(2)), aside * at[0](1, 0)};
    });
  } else {
    result.lateral = lateral_curve(vehicle::lateral_track(track), result.frequency);
  }

  TrackResult::Bay& own = result.bay.emplace(TrackResult::Bay{});
  own.seats = track.seats.size();
  own.length = bay;
  own.pinned_pinned = vehicle::pinned_pinned_frequency(track.rail, bay);
  if (sideways)
    own.lateral_pinned_pinned =
        vehicle::pinned_pinned_frequency(vehicle::beam_in(track, vehicle::RailPlane::sideways), bay);
  for (double part = 0.7; part < 1.3; part += 0.002) {
    check_cancelled();
    const std::vector<Complex> pair = rail.receptance(std::span(places).first(2), part * own.pinned_pinned);
    const double ratio = std::abs(pair[0] / pair[1]);
    if (ratio > own.peak_ratio) own.peak_ratio = ratio, own.peak = part * own.pinned_pinned;
  }
  constexpr double kShown = 4.0;  // to either side [m]
  constexpr int kPoints = 161;
  for (int i = 0; i < kPoints; ++i) {
    const double x = kShown * (2.0 * i / (kPoints - 1) - 1.0);
    if (middle + x >= rail.begin() && middle + x <= rail.end()) own.x.push_back(x);
  }
  std::vector<double> shown;
  for (const double x : own.x) shown.push_back(middle + x);
  own.deflection = rail.deflection(middle, shown);
}

void run_lumped(const TrackModel& track, TrackResult& result) {
  const double rest[] = {0.0};
  result.curves = {{"rail", "rail", vehicle::receptance(track, Freedom::z, result.frequency),
                    vehicle::receptance(track, Freedom::z, rest).front().real()}};
  if (!(result.curves.front().at_rest > 0.0))
    throw Error(ErrorKind::configuration, "the rails of this track do not move in z, so it has no receptance");
  result.lateral = lateral_curve(track, result.frequency);
}

}  // namespace

TrackModel lumped_track(const std::string& name, const std::vector<vehicle::LumpedLayer>& layers, double distance,
                        const std::optional<LateralSupport>& lateral) {
  const std::size_t count = layers.size();
  TrackModel track;
  track.name = name;
  for (const char* side : {"left", "right"}) {
    const double y = (side[0] == 'l' ? -0.5 : 0.5) * distance;
    // From the top: head, rail, sleeper, of which fewer layers have the last ones but always a rail.
    std::vector<std::string> names{fmt::format("{}_rail", side)};
    if (count > 1) names.push_back(fmt::format("{}_sleeper", side));
    if (count > 2) names.insert(names.begin(), fmt::format("{}_head", side));
    (side[0] == 'l' ? track.left_rail : track.right_rail) = names.front();
    for (std::size_t i = 0; i < count; ++i) {
      const bool last = i + 1 == count, sleeper = last && count > 1, head = count > 2 && i == 0;
      BodySpec body;
      body.name = names[i];
      body.mass = layers[i].mass;
      body.position = {0.0, y, sleeper ? kSleeperHeight : kRailHeight};
      body.free[static_cast<std::size_t>(Freedom::z)] = true;
      SpringSpec spring;
      spring.name = fmt::format("{}_{}", side, head ? "local" : last ? "bed" : "pad");
      spring.body_a = last ? kGround : names[i + 1];
      spring.body_b = names[i];
      spring.position = {0.0, y, head ? kRailHeight : sleeper ? kBedHeight : kFootHeight};
      spring.stiffness[2] = layers[i].stiffness;
      spring.damping[2] = layers[i].damping;
      if (lateral) {
        body.free[static_cast<std::size_t>(Freedom::y)] = true;
        // A single layer is pad and bed one behind the other; a head moves with its rail as well as it does vertically.
        const auto series = [](double a, double b) { return a > 0.0 && b > 0.0 ? a * b / (a + b) : 0.0; };
        if (head) {
          spring.stiffness[1] = layers[i].stiffness;
          spring.damping[1] = layers[i].damping;
        } else if (count == 1) {
          spring.stiffness[1] = series(lateral->pad_stiffness, lateral->bed_stiffness);
          spring.damping[1] = series(lateral->pad_damping, lateral->bed_damping);
        } else {
          spring.stiffness[1] = last ? lateral->bed_stiffness : lateral->pad_stiffness;
          spring.damping[1] = last ? lateral->bed_damping : lateral->pad_damping;
        }
        if (!sleeper) {
          body.free[static_cast<std::size_t>(Freedom::roll)] = true;
          body.inertia.x() = layers[i].mass * lateral->roll_inertia;
          const double arm = lateral->foot_width * lateral->foot_width / 12.0;  // an even spring below the foot
          spring.stiffness[3] = layers[i].stiffness * arm;
          spring.damping[3] = layers[i].damping * arm;
        }
      }
      track.bodies.push_back(std::move(body));
      track.springs.push_back(std::move(spring));
    }
  }
  return track;
}

TrackResult run_track(const TrackRequest& request) {
  vehicle::frequencies(request.from, request.to, request.count);  // refused before a file is read
  return run_track(request, io::read_any_track_file(request.file, request.overrides));
}

TrackResult run_track(const TrackRequest& request, const io::AnyTrack& any) {
  TrackResult result;
  result.request = request;
  result.frequency = vehicle::frequencies(request.from, request.to, request.count);
  double distance = 0.0;
  std::optional<LateralSupport> lateral;
  if (const auto* flexible = std::get_if<FlexibleTrack>(&any)) {
    result.flexible = true;
    result.name = flexible->name;
    result.source = flexible->source;
    distance = flexible->gauge;
    lateral = flexible->lateral;
    run_flexible(*flexible, result);
  } else {
    const TrackModel& lumped = std::get<TrackModel>(any);
    result.name = lumped.name;
    const auto rail_y = [&](const std::string& name) {
      return ranges::find(lumped.bodies, name, &BodySpec::name)->position.y();
    };
    distance = std::abs(rail_y(lumped.right_rail) - rail_y(lumped.left_rail));
    run_lumped(lumped, result);
  }
  const auto* bending = std::get_if<FlexibleTrack>(&any);
  if (request.aside != 0.0 && (bending == nullptr || !bending->sideways))
    throw Error(ErrorKind::configuration, "only rails that bend and roll are asked beside the middle of their heads");
  if (request.layers > 0) {
    const TrackCurve& target = result.typical();
    TrackResult::Fitted fitted;
    fitted.fit = vehicle::fit_lumped(result.frequency, target.receptance, request.layers);
    fitted.track = lumped_track(fmt::format("{}, {} layers fitted to its receptance", result.name, request.layers),
                                fitted.fit.layers, distance, lateral);
    fitted.curve = {"fitted", "fitted", {}, 0.0};
    for (const double f : result.frequency)
      fitted.curve.receptance.push_back(vehicle::receptance(fitted.fit.layers, f));
    fitted.curve.at_rest = vehicle::receptance(fitted.fit.layers, 0.0).real();
    result.fitted = std::move(fitted);
  }
  return result;
}

}  // namespace treadmark::app
