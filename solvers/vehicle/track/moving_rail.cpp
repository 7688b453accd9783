// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/solvers/vehicle/track/moving_rail.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include <fmt/format.h>

#include "treadmark/core/error.hpp"
#include "treadmark/core/platform/ranges.hpp"
#include "treadmark/core/to_whole.hpp"

namespace treadmark::vehicle {
namespace {

constexpr Eigen::Index kZ = 1;  // among the motions of a place

/// Which motions of a place are those of a plane.
Eigen::Index motion_of(RailPlane plane, Eigen::Index i) {
  constexpr std::array<Eigen::Index, 2> kSideways{0, 2};
  return plane == RailPlane::vertical ? kZ : kSideways[static_cast<std::size_t>(i)];
}

/// Where the numbers of a plane stand among those of all motions.
std::vector<Eigen::Index> numbers_of(const RailInTime& plane, Eigen::Index places) {
  std::vector<Eigen::Index> all;
  for (Eigen::Index place = 0; place < places; ++place)
    for (int i = 0; i < top_motions(plane.plane()); ++i)
      all.push_back(place * MovingRail::kMotions + motion_of(plane.plane(), i));
  return all;
}

MovingRail::Answer no_motion(Eigen::Index places) {
  const Eigen::Index n = places * MovingRail::kMotions;
  return {Eigen::VectorXd::Zero(n), Eigen::MatrixXd::Zero(n, n)};
}

}  // namespace

MovingRail::MovingRail(const FlexibleTrack& track, const SpeedProfile& speed, const std::vector<double>& start,
                       double spectral_radius, double length)
    : track_(track), speed_(speed) {
  const RailOnSeats whole(track);  // refuses what makes no sense
  track_.bay_elements = std::min(track.bay_elements, kMostBayElements);
  constexpr double kFarthest = 1e6;  // [m]
  const auto goes_on = [](double v) { return v > 0.0 && std::isfinite(v); };
  if (speed.speed.empty() || speed.time.size() != speed.speed.size() || !ranges::all_of(speed.speed, goes_on))
    throw Error(ErrorKind::configuration, "the speed along a rail must be positive");
  if (start.empty()) throw Error(ErrorKind::configuration, "nothing moves along a rail");
  for (const double one : start) {
    if (!(std::abs(one) <= kFarthest))
      throw Error(ErrorKind::configuration, "a rail begins within 1000 km of the middle of its seats");
    start_.push_back(whole.middle() + one);
  }
  if (!(spectral_radius >= 0.5 && spectral_radius <= 1.0))
    throw Error(ErrorKind::configuration, "the spectral radius must lie between 0.5 and 1");
  const RailScheme scheme = RailScheme::of(spectral_radius);
  planes_.emplace_back(RailPlane::vertical, scheme);
  if (track.sideways) planes_.emplace_back(RailPlane::sideways, scheme);

  constexpr double kFewest = 20.0, kMost = 1e4;
  const std::vector<RailSeat>& seats = track.seats;
  const double bay = (seats.back().x - seats.front().x) / static_cast<double>(seats.size() - 1);
  std::vector<double> ordered = start_;
  ranges::sort(ordered);
  const double reach = ordered.back() - ordered.front();
  if (!(length > 0.0 && length + reach <= kMost * bay))
    throw Error(ErrorKind::configuration, "the part of a rail that is looked at has a length of at most 10000 bays");
  double longest_bay = 0.0;
  for (std::size_t i = 1; i < seats.size(); ++i) longest_bay = std::max(longest_bay, seats[i].x - seats[i - 1].x);
  for (std::size_t i = 1; i < ordered.size(); ++i)
    if (!(ordered[i] - ordered[i - 1] > longest_bay / track_.bay_elements))
      throw Error(ErrorKind::configuration,
                  fmt::format("two wheels on one rail are {:.6g} m apart, not more than an element of the rail is long",
                              ordered[i] - ordered[i - 1]),
                  {}, "give the rail more elements in a bay (seats.bay_elements), at most 8 are used");
  seats_about_ = to_whole<std::int64_t>(std::max(kFewest, std::ceil(length / bay)));
  // As many more as the forces reach over where seats are closest.
  std::int64_t within = 0, front = 0;
  for (std::int64_t i = 0; reach > 0.0 && i < static_cast<std::int64_t>(seats.size()); ++i) {
    while (seat(front).x < seat(i).x + reach) ++front;
    within = std::max(within, front - i);
  }
  seats_ = seats_about_ + within;

  std::int64_t before = 0;  // seat before the hindmost force
  while (seat(before).x > ordered.front()) --before;
  while (seat(before + 1).x <= ordered.front()) ++before;
  look_from(before - (seats_about_ - 1) / 2);
  motion_at_rest_ = rate_at_rest_ = no_motion(places());
  for (RailInTime& plane : planes_) {
    plane.rest(start_, speed_.speed.front());
    const std::vector<Eigen::Index> numbers = numbers_of(plane, places());
    motion_at_rest_.compliance(numbers, numbers) = plane.compliance_at_rest();
    rate_at_rest_.compliance(numbers, numbers) = plane.rates_at_rest();
  }
  for (const double place : start_) run_.push_back({place, 0.0, 0.0});
  for (std::size_t i = 0; i < start_.size(); ++i)
    motion_at_rest_.free[static_cast<Eigen::Index>(i) * kMotions + kZ] = dip(start_[i]);
}

/// Also those that continue the track.
RailSeat MovingRail::seat(std::int64_t index) const {
  const std::vector<RailSeat>& seats = track_.seats;
  const auto last = static_cast<std::int64_t>(seats.size()) - 1;
  if (index >= 0 && index <= last) return seats[static_cast<std::size_t>(index)];
  RailSeat beyond = index < 0 ? seats.front() : seats.back();
  if (index < 0)
    beyond.x += static_cast<double>(index) * (seats[1].x - seats[0].x);
  else
    beyond.x += static_cast<double>(index - last) * (beyond.x - seats[seats.size() - 2].x);
  return beyond;
}

/// Makes the part that begins with this seat the one that is looked at.
void MovingRail::look_from(std::int64_t first_seat) {
  first_seat_ = first_seat;
  FlexibleTrack part = track_;
  part.seats.clear();
  for (std::int64_t i = 0; i < seats_; ++i) part.seats.push_back(seat(first_seat + i));
  const double begin = part.seats[0].x - 0.5 * (part.seats[1].x - part.seats[0].x),
               end = part.seats.back().x + 0.5 * (part.seats.back().x - part.seats[part.seats.size() - 2].x);
  std::erase_if(part.joints, [&](const RailJoint& joint) { return !(joint.x >= begin && joint.x <= end); });
  part.absorbing_bays = std::min(track_.absorbing_bays, static_cast<int>(seats_about_ / 4));
  for (RailInTime& plane : planes_) plane.look_at(part);
  next_place_ = seat(first_seat + (seats_about_ - 1) / 2 + 1).x;
  trial_time_ = -1.0;
}

/// Forces go on as they did in the last step, beside what the speed says.
void MovingRail::find_places(double time) {
  const Travel travel = travel_at(speed_, time);
  before_.clear(), now_.clear(), speeds_.clear();
  for (std::size_t i = 0; i < run_.size(); ++i) {
    const Run& run = run_[i];
    before_.push_back(run.place);
    now_.push_back(start_[i] + travel.distance + run.ahead + run.rate * (time - time_));
    speeds_.push_back(travel.speed + run.rate);
  }
}

double MovingRail::dip(double x) const {
  double sum = 0.0;
  for (const RailJoint& joint : track_.joints) sum += joint.depth(x - joint.x);
  return sum;
}

const MovingRail::Answer& MovingRail::after(double time) {
  if (trial_time_ == time) return motion_;
  // Differences of times vary in their last digits, which are not worth a factorisation.
  trial_length_ = static_cast<float>(time - time_);
  trial_time_ = time;
  motion_ = rate_ = no_motion(places());
  find_places(time);
  for (RailInTime& plane : planes_) {
    plane.step(trial_length_, before_, now_, speeds_);
    const std::vector<Eigen::Index> numbers = numbers_of(plane, places());
    motion_.free(numbers) = plane.motions().free;
    motion_.compliance(numbers, numbers) = plane.motions().compliance;
    rate_.free(numbers) = plane.rates().free;
    rate_.compliance(numbers, numbers) = plane.rates().compliance;
  }
  for (std::size_t i = 0; i < now_.size(); ++i)
    motion_.free[static_cast<Eigen::Index>(i) * kMotions + kZ] += dip(now_[i]);
  return motion_;
}

Eigen::Vector3d MovingRail::slope(Eigen::Index place, const Forces& forces) const {
  Eigen::Vector3d slope = Eigen::Vector3d::Zero();
  if (!(trial_length_ > 0.0)) return slope;
  for (const RailInTime& plane : planes_) {
    const Forces own = forces(numbers_of(plane, places()));
    for (int i = 0; i < top_motions(plane.plane()); ++i) slope[motion_of(plane.plane(), i)] = plane.rise(place, i, own);
  }
  const double from = before_[static_cast<std::size_t>(place)], to = now_[static_cast<std::size_t>(place)];
  slope[kZ] += dip(to) - dip(from);
  return slope / (to - from);
}

MovingRail::Moved MovingRail::moved(const Forces& forces) {
  Moved all;
  for (RailInTime& plane : planes_) {
    const RailInTime::Moved one = plane.moved(forces(numbers_of(plane, places())));
    all.energy += one.energy;
    if (trial_length_ > 0.0) all.power += one.dissipated / trial_length_;
  }
  return all;
}

MovingRail::Moved MovingRail::moved_at_rest(const Forces& forces) const {
  Moved all;
  for (const RailInTime& plane : planes_) {
    const RailInTime::Moved one = plane.moved_at_rest(forces(numbers_of(plane, places())));
    all.energy += one.energy;
    all.power += one.dissipated;
  }
  return all;
}

void MovingRail::begin(const Forces& forces) {
  time_ = 0.0;
  run_.clear();
  for (const double start : start_) run_.push_back({start, 0.0, 0.0});
  trial_time_ = -1.0;
  for (RailInTime& plane : planes_) plane.begin(forces(numbers_of(plane, places())));
}

void MovingRail::accept(const Forces& forces, const std::vector<double>& ahead) {
  for (RailInTime& plane : planes_) plane.accept(forces(numbers_of(plane, places())));
  for (std::size_t i = 0; i < run_.size(); ++i) {
    Run& run = run_[i];
    run.place = now_[i];
    if (ahead.empty()) continue;
    run.rate = trial_length_ > 0.0 ? (ahead[i] - run.ahead) / trial_length_ : 0.0;
    run.ahead = ahead[i];
  }
  time_ = trial_time_;
  trial_time_ = -1.0;
  const double hindmost = ranges::min(run_, {}, &Run::place).place;
  while (hindmost >= next_place_) {
    for (RailInTime& plane : planes_) plane.move_on(track_.bay_elements);
    look_from(first_seat_ + 1);
  }
}

void MovingRail::save(ByteWriter& out) const {
  out.put(time_);
  out.put(first_seat_);
  for (const Run& run : run_) out.put(run.place), out.put(run.ahead), out.put(run.rate);
  for (const RailInTime& plane : planes_) plane.save(out);
}

void MovingRail::restore(ByteReader& in) {
  constexpr std::int64_t kFarthest = 1'000'000'000;  // [seats]
  const auto foreign = [] {
    throw Error(ErrorKind::input_data, "a saved state belongs to another track", {}, "start anew");
  };
  in.get(time_);
  const auto first = in.get<std::int64_t>();
  if (!(std::abs(first) < kFarthest)) foreign();
  look_from(first);
  run_.resize(start_.size());
  for (Run& run : run_) in.get(run.place), in.get(run.ahead), in.get(run.rate);
  for (RailInTime& plane : planes_)
    if (!plane.restore(in)) foreign();
}

}  // namespace treadmark::vehicle
