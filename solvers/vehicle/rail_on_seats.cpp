// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/solvers/vehicle/rail_on_seats.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

#include <fmt/format.h>

#include "treadmark/core/constants.hpp"
#include "treadmark/core/error.hpp"

namespace treadmark::vehicle {
namespace {

void require_sense(const FlexibleTrack& track) {
  const auto refuse = [](const std::string& message) { throw Error(ErrorKind::configuration, message); };
  const auto positive = [](double value) { return value > 0.0 && std::isfinite(value); };
  const auto not_negative = [](double value) { return value >= 0.0 && std::isfinite(value); };
  if (!positive(track.rail.bending_stiffness) || !positive(track.rail.shear_stiffness) || !positive(track.rail.mass) ||
      !not_negative(track.rail.rotary_inertia) || !not_negative(track.rail.damping_time))
    refuse("a rail needs positive stiffnesses in bending and shear and a positive mass");
  if (track.seats.size() < 2) refuse("a flexible track needs at least two seats");
  if (track.bay_elements < 1) refuse("a bay needs at least one element");
  if (track.absorbing_bays < 0 || !not_negative(track.absorption) ||
      2 * static_cast<std::size_t>(track.absorbing_bays) > track.seats.size())
    refuse("both absorbing ends together cannot be longer than the track");
  for (std::size_t i = 0; i < track.seats.size(); ++i) {
    const RailSeat& seat = track.seats[i];
    if (!std::isfinite(seat.x) || (i > 0 && !(seat.x > track.seats[i - 1].x)))
      refuse(fmt::format("seat {} does not lie behind the one before it", i + 1));
    if (!not_negative(seat.pad_stiffness) || !not_negative(seat.pad_damping) || !positive(seat.sleeper_mass) ||
        !not_negative(seat.bed_stiffness) || !not_negative(seat.bed_damping))
      refuse(fmt::format("seat {} needs a positive mass, and stiffnesses and damping that are not negative", i + 1));
    if (seat.pad_stiffness == 0.0 && seat.bed_stiffness == 0.0)
      refuse(fmt::format("nothing holds the sleeper of seat {}", i + 1));
  }
  for (const RailJoint& joint : track.joints)
    if (!std::isfinite(joint.x) || !not_negative(joint.hinge_stiffness) || !not_negative(joint.dip_depth) ||
        !positive(joint.dip_length))
      refuse("a joint needs a place, a stiffness and a dip that are not negative, and a dip of some length");
}

}  // namespace

RailOnSeats::RailOnSeats(const FlexibleTrack& track) {
  require_sense(track);
  const std::vector<RailSeat>& seats = track.seats;
  const std::size_t count = seats.size();
  const double before = 0.5 * (seats[1].x - seats[0].x), behind = 0.5 * (seats[count - 1].x - seats[count - 2].x);

  // Nodes; each seat's sleeper has its coordinate after those of the node above it: from the deflection at one end of
  // an element to the rotation at the other they are four numbers apart.
  const int half = (track.bay_elements + 1) / 2;
  std::vector<int> sleepers;
  int next = 0;
  const auto add_node = [&](double x) {
    nodes_.push_back({x, next});
    next += 2;
  };
  const auto add_nodes = [&](double from, double to, int elements) {
    for (int i = 1; i <= elements; ++i) add_node(i == elements ? to : from + (to - from) * i / elements);
  };
  add_node(seats.front().x - before);
  add_nodes(seats.front().x - before, seats.front().x, half);
  for (std::size_t i = 0; i < count; ++i) {
    sleepers.push_back(next++);
    if (i + 1 < count)
      add_nodes(seats[i].x, seats[i + 1].x, track.bay_elements);
    else
      add_nodes(seats[i].x, seats[i].x + behind, half);
  }
  mass_ = damping_ = stiffness_ = BandedSymmetric<double>(next);

  // Ends of the undamped part.
  const auto absorbing = static_cast<std::size_t>(track.absorbing_bays);
  const double calm_from = absorbing > 0 ? seats[absorbing - 1].x : begin();
  const double calm_to = absorbing > 0 ? seats[count - absorbing].x : end();
  const auto absorption = [&](double x) {
    double part = 0.0;
    if (x < calm_from) part = (calm_from - x) / (calm_from - begin());
    if (x > calm_to) part = (x - calm_to) / (end() - calm_to);
    return track.absorption * part * part;
  };

  std::vector<std::optional<BeamElement::Hinge>> hinges(nodes_.size() - 1);
  for (const RailJoint& joint : track.joints) {
    if (!(joint.x >= begin() && joint.x <= end()))
      throw Error(ErrorKind::configuration,
                  fmt::format("the joint at {:.6g} m is not on the rail, which reaches from {:.6g} to {:.6g} m",
                              joint.x, begin(), end()));
    const std::size_t e = element_at(joint.x);
    if (hinges[e])
      throw Error(ErrorKind::configuration,
                  fmt::format("the joint at {:.6g} m has another one beside it on one element of the rail", joint.x),
                  {}, "keep joints a bay apart, or give the rail more elements in a bay (seats.bay_elements)");
    hinges[e] = {part_of(e, joint.x), joint.hinge_stiffness};
  }
  for (std::size_t e = 0; e + 1 < nodes_.size(); ++e) {
    const BeamElement& element = elements_.emplace_back(track.rail, nodes_[e + 1].x - nodes_[e].x, hinges[e]);
    const BeamMatrix k = element.stiffness(), m = element.mass();
    const double loss = absorption(0.5 * (nodes_[e].x + nodes_[e + 1].x));
    const std::array<int, 4> at{nodes_[e].first, nodes_[e].first + 1, nodes_[e + 1].first, nodes_[e + 1].first + 1};
    for (int i = 0; i < 4; ++i)
      for (int j = 0; j <= i; ++j) {
        const int row = at[static_cast<std::size_t>(i)], column = at[static_cast<std::size_t>(j)];
        stiffness_.add(row, column, k(i, j));
        mass_.add(row, column, m(i, j));
        damping_.add(row, column, loss * m(i, j) + track.rail.damping_time * k(i, j));
      }
  }
  for (std::size_t i = 0; i < count; ++i) {
    const int sleeper = sleepers[i], rail = sleeper - 2;
    const auto add = [&](BandedSymmetric<double>& matrix, double pad, double bed) {
      matrix.add(rail, rail, pad);
      matrix.add(sleeper, rail, -pad);
      matrix.add(sleeper, sleeper, pad + bed);
    };
    add(stiffness_, seats[i].pad_stiffness, seats[i].bed_stiffness);
    add(damping_, seats[i].pad_damping, seats[i].bed_damping);
    mass_.add(sleeper, sleeper, seats[i].sleeper_mass);
  }

  const std::size_t bay = (count - 1) / 2;
  middle_ = 0.5 * (seats[bay].x + seats[bay + 1].x);
  middle_bay_ = seats[bay + 1].x - seats[bay].x;
}

std::size_t RailOnSeats::element_at(double x) const {
  const auto after = std::ranges::upper_bound(nodes_, x, {}, &Node::x);
  return std::min(static_cast<std::size_t>(after - nodes_.begin()), nodes_.size() - 1) - 1;
}

double RailOnSeats::part_of(std::size_t element, double x) const {
  const double from = nodes_[element].x, to = nodes_[element + 1].x;
  return std::min((x - from) / (to - from), 1.0);
}

RailOnSeats::Place RailOnSeats::place(double x) const {
  if (!(x >= begin() && x <= end()))
    throw Error(ErrorKind::configuration,
                fmt::format("the place x = {:.6g} m is not on the rail, which reaches from {:.6g} to {:.6g} m", x,
                            begin(), end()));
  const std::size_t e = element_at(x);
  const double part = part_of(e, x);
  return {{nodes_[e].first, nodes_[e].first + 1, nodes_[e + 1].first, nodes_[e + 1].first + 1},
          elements_[e].deflection(part),
          elements_[e].slope(part),
          elements_[e].own_compliance(part),
          elements_[e].own_compliance_slope(part)};
}

std::vector<std::complex<double>> RailOnSeats::receptance(std::span<const double> x, double frequency) const {
  using Complex = std::complex<double>;
  const double w = 2.0 * kPi * frequency;
  BandedSymmetric<Complex> dynamic(size());
  for (std::size_t i = 0; i < dynamic.values().size(); ++i)
    dynamic.values()[i] = Complex(stiffness_.values()[i] - w * w * mass_.values()[i], w * damping_.values()[i]);
  const bool regular = dynamic.factorise();
  std::vector<Complex> result;
  for (const double at : x) {
    const Place p = place(at);
    BandedSymmetric<Complex>::Column q = BandedSymmetric<Complex>::Column::Zero(size());
    for (std::size_t i = 0; i < 4; ++i) q[p.coordinate[i]] += p.value[static_cast<Eigen::Index>(i)];
    if (regular) dynamic.solve(q);
    Complex value(p.own_compliance, 0.0);
    for (std::size_t i = 0; i < 4; ++i) value += p.value[static_cast<Eigen::Index>(i)] * q[p.coordinate[i]];
    if (!regular || !std::isfinite(value.real()) || !std::isfinite(value.imag()))
      throw Error(ErrorKind::numerical, fmt::format("the track has no receptance at {:.6g} Hz", frequency), {},
                  "nothing holds it, or nothing damps it");
    result.push_back(value);
  }
  return result;
}

std::complex<double> RailOnSeats::receptance(double x, double frequency) const {
  return receptance(std::span(&x, 1), frequency).front();
}

std::vector<double> RailOnSeats::deflection(double force_at, std::span<const double> x) const {
  BandedSymmetric<double> factors = stiffness_;
  const bool regular = factors.factorise();
  const Place force = place(force_at);
  BandedSymmetric<double>::Column q = BandedSymmetric<double>::Column::Zero(size());
  for (std::size_t i = 0; i < 4; ++i) q[force.coordinate[i]] += force.value[static_cast<Eigen::Index>(i)];
  if (regular) factors.solve(q);
  if (!regular || !q.allFinite())
    throw Error(ErrorKind::numerical, "nothing holds the track", {}, "stiffness is missing");
  std::vector<double> result;
  for (const double at : x) {
    const Place p = place(at);
    double value = at == force_at ? p.own_compliance : 0.0;
    for (std::size_t i = 0; i < 4; ++i) value += p.value[static_cast<Eigen::Index>(i)] * q[p.coordinate[i]];
    result.push_back(value);
  }
  return result;
}

}  // namespace treadmark::vehicle
