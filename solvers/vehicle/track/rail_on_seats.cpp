// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/solvers/vehicle/track/rail_on_seats.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

#include <fmt/format.h>

#include "treadmark/core/constants.hpp"
#include "treadmark/core/error.hpp"
#include "treadmark/core/platform/ranges.hpp"

namespace treadmark::vehicle {
namespace {

void require_sense(const FlexibleTrack& track) {
  const auto refuse = [](const std::string& message) { throw Error(ErrorKind::configuration, message); };
  const auto positive = [](double value) { return value > 0.0 && std::isfinite(value); };
  const auto not_negative = [](double value) { return value >= 0.0 && std::isfinite(value); };
  if (!positive(track.rail.bending_stiffness) || !positive(track.rail.shear_stiffness) || !positive(track.rail.mass) ||
      !not_negative(track.rail.rotary_inertia) || !not_negative(track.rail.damping_time))
    refuse("a rail needs positive stiffnesses in bending and shear and a positive mass");
  if (const std::optional<RailSideways>& side = track.sideways) {
    if (!positive(side->bending_stiffness) || !positive(side->shear_stiffness) || !not_negative(side->rotary_inertia) ||
        !positive(side->torsional_stiffness) || !positive(side->polar_inertia) || !positive(side->height))
      refuse("sideways a rail needs positive stiffnesses in bending, shear and torsion, inertia and height");
    for (const double height : {side->centroid, side->shear_centre})
      if (!(height >= 0.0 && height <= side->height))
        refuse("the centroid and the shear centre of a rail lie between its foot and its top");
  }
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
    for (const double value : {seat.lateral_pad_stiffness, seat.lateral_pad_damping, seat.roll_stiffness,
                               seat.roll_damping, seat.lateral_bed_stiffness, seat.lateral_bed_damping})
      if (!not_negative(value)) refuse(fmt::format("lateral stiffnesses and damping of seat {} are negative", i + 1));
    if (track.sideways && seat.lateral_pad_stiffness == 0.0 && seat.lateral_bed_stiffness == 0.0)
      refuse(fmt::format("nothing holds the sleeper of seat {} sideways", i + 1));
  }
  for (const RailJoint& joint : track.joints)
    if (!std::isfinite(joint.x) || !not_negative(joint.hinge_stiffness) ||
        !not_negative(joint.lateral_hinge_stiffness.value_or(0.0)) || !not_negative(joint.dip_depth) ||
        !positive(joint.dip_length))
      refuse("a joint needs a place, a stiffness and a dip that are not negative, and a dip of some length");
}

constexpr int kRoll = 2;  // among the coordinates of a node

/// Between the coordinates of a node and that of the sleeper below it, which is the last one.
struct SeatSpring {
  std::array<double, 4> by;
  double stiffness, damping;
};

std::vector<SeatSpring> springs_at(const RailSeat& seat, const FlexibleTrack& track, RailPlane plane) {
  if (plane == RailPlane::vertical)
    return {{{1.0, 0.0, -1.0}, seat.pad_stiffness, seat.pad_damping},
            {{0.0, 0.0, 1.0}, seat.bed_stiffness, seat.bed_damping}};
  // The foot lies below the shear centre.
  return {{{1.0, 0.0, -track.sideways->shear_centre, -1.0}, seat.lateral_pad_stiffness, seat.lateral_pad_damping},
          {{0.0, 0.0, 1.0, 0.0}, seat.roll_stiffness, seat.roll_damping},
          {{0.0, 0.0, 0.0, 1.0}, seat.lateral_bed_stiffness, seat.lateral_bed_damping}};
}

std::optional<double> hinge_in(const RailJoint& joint, RailPlane plane) {
  return plane == RailPlane::vertical ? std::optional(joint.hinge_stiffness) : joint.lateral_hinge_stiffness;
}

}  // namespace

RailOnSeats::RailOnSeats(const FlexibleTrack& track, RailPlane plane, double spread) : plane_(plane), spread_(spread) {
  require_sense(track);
  beam_in(track, plane);  // refuses one that there is not
  if (plane == RailPlane::sideways) sideways_ = track.sideways;
  const std::vector<RailSeat>& seats = track.seats;
  const std::size_t count = seats.size();
  const double before = 0.5 * (seats[1].x - seats[0].x), behind = 0.5 * (seats[count - 1].x - seats[count - 2].x);

  // Nodes; each seat's sleeper has its coordinate after those of the node above it: from the first one at one end of an
  // element to the last one at the other they are twice as many numbers apart as a node has.
  const int node = node_coordinates(plane), band = 2 * node;
  const int half = (track.bay_elements + 1) / 2;
  std::vector<int> sleepers;
  int next = 0;
  const auto add_node = [&](double x) {
    nodes_.push_back({x, next});
    next += node;
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
  mass_ = damping_ = stiffness_ = BandedSymmetric<double>(next, band);
  constexpr double kOfElement = 0.9;  // so that it reaches over two of them
  for (std::size_t e = 0; e + 1 < nodes_.size(); ++e)
    spread_ = std::min(spread_, kOfElement * (nodes_[e + 1].x - nodes_[e].x));

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
    const std::optional<double> stiffness = hinge_in(joint, plane);
    if (!stiffness) continue;
    if (!(joint.x >= begin() && joint.x <= end()))
      throw Error(ErrorKind::configuration,
                  fmt::format("the joint at {:.6g} m is not on the rail, which reaches from {:.6g} to {:.6g} m",
                              joint.x, begin(), end()));
    const std::size_t e = element_at(joint.x);
    if (hinges[e])
      throw Error(ErrorKind::configuration,
                  fmt::format("the joint at {:.6g} m has another one beside it on one element of the rail", joint.x),
                  {}, "keep joints a bay apart, or give the rail more elements in a bay (seats.bay_elements)");
    hinges[e] = {part_of(e, joint.x), *stiffness};
  }
  for (std::size_t e = 0; e + 1 < nodes_.size(); ++e) {
    const RailElement& element = elements_.emplace_back(track, plane, nodes_[e + 1].x - nodes_[e].x, hinges[e]);
    const RailMatrix k = element.stiffness(), m = element.mass();
    const double loss = absorption(0.5 * (nodes_[e].x + nodes_[e + 1].x));
    for (int i = 0; i < 2 * node; ++i)
      for (int j = 0; j <= i; ++j) {
        const int row = coordinate(e, i), column = coordinate(e, j);
        stiffness_.add(row, column, k(i, j));
        mass_.add(row, column, m(i, j));
        damping_.add(row, column, loss * m(i, j) + track.rail.damping_time * k(i, j));
      }
  }
  for (std::size_t i = 0; i < count; ++i) {
    const int sleeper = sleepers[i], above = sleeper - node;
    for (const SeatSpring& spring : springs_at(seats[i], track, plane))
      for (int row = 0; row <= node; ++row)
        for (int column = 0; column <= row; ++column) {
          const double by = spring.by[static_cast<std::size_t>(row)] * spring.by[static_cast<std::size_t>(column)];
          stiffness_.add(above + row, above + column, by * spring.stiffness);
          damping_.add(above + row, above + column, by * spring.damping);
        }
    mass_.add(sleeper, sleeper, seats[i].sleeper_mass);
  }

  const std::size_t bay = (count - 1) / 2;
  middle_ = 0.5 * (seats[bay].x + seats[bay + 1].x);
  middle_bay_ = seats[bay + 1].x - seats[bay].x;
}

int RailOnSeats::coordinate(std::size_t element, int i) const {
  const int node = node_coordinates(plane_);
  return i < node ? nodes_[element].first + i : nodes_[element + 1].first + i - node;
}

std::size_t RailOnSeats::element_at(double x) const {
  const auto after = ranges::upper_bound(nodes_, x, {}, &Node::x);
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
  const int node = node_coordinates(plane_);
  const std::size_t e = element_at(x);
  std::size_t first = e, last = e;
  if (sideways_)
    each_below(x, [&](std::size_t i, double, double) { first = std::min(first, i), last = std::max(last, i); });
  Place found;
  const std::size_t nodes = last - first + 2;
  found.value = RailShape::Zero(static_cast<Eigen::Index>(nodes) * node, top_motions(plane_));
  for (std::size_t i = 0; i < nodes; ++i)
    for (int j = 0; j < node; ++j)
      found.coordinate.at(i * static_cast<std::size_t>(node) + static_cast<std::size_t>(j)) =
          nodes_[first + i].first + j;
  const auto row = [&](std::size_t at, int j) { return static_cast<Eigen::Index>(at - first) * node + j; };
  const BeamVector bending = elements_[e].beam().deflection(part_of(e, x));
  for (int end = 0; end < 2; ++end)
    for (int j = 0; j < 2; ++j) found.value(row(e + static_cast<std::size_t>(end), j), 0) = bending[2 * end + j];
  if (sideways_) {
    double length = 0.0;
    each_below(x, [&](std::size_t i, double from, double to) {
      const Eigen::Vector2d roll = elements_[i].roll_between(from, to);
      length += roll.sum();
      found.value(row(i, kRoll), 1) += roll[0];
      found.value(row(i + 1, kRoll), 1) += roll[1];
    });
    found.value.col(1) /= length;
    found.value.col(0) += sideways_->lever() * found.value.col(1);
  }
  found.own_compliance = own_compliance(x);
  constexpr double kPart = 1e-4;  // of the element, within which differences stay
  const double from = nodes_[e].x, to = nodes_[e + 1].x, by = kPart * (to - from), low = std::max(from, x - by),
               high = std::min(std::nextafter(to, from), x + by);
  found.own_slope = (own_compliance(high) - own_compliance(low)) / (high - low);
  return found;
}

/// visit(element, from, to): the parts of elements over which a moment at a place twists the rail.
template <class Visit>
void RailOnSeats::each_below(double x, Visit&& visit) const {
  const double from = std::max(begin(), x - 0.5 * spread_), to = std::min(end(), x + 0.5 * spread_);
  const std::size_t first = element_at(from), last = element_at(to);
  for (std::size_t i = first; i <= last; ++i)
    visit(i, i == first ? part_of(i, from) : 0.0, i == last ? part_of(i, to) : 1.0);
}

/// As under a moment at one place: what spreading takes away, that of a free bar, is added again.
double RailOnSeats::own_roll(double x) const {
  double length = 0.0, sum = 0.0;
  each_below(x, [&](std::size_t i, double from, double to) {
    length += elements_[i].roll_between(from, to).sum();
    sum += elements_[i].own_roll_between(from, to);
  });
  return sum / (length * length) + length / (6.0 * sideways_->torsional_stiffness);
}

RailGive RailOnSeats::own_compliance(double x) const {
  const std::size_t e = element_at(x);
  const double bending = elements_[e].beam().own_compliance(part_of(e, x));
  if (!sideways_) return RailGive::Constant(1, 1, bending);
  const double arm = sideways_->lever(), roll = own_roll(x);
  return (Eigen::Matrix2d() << bending + arm * arm * roll, arm * roll, arm * roll, roll).finished();
}

std::vector<Eigen::MatrixXcd> RailOnSeats::receptances(std::span<const double> x, double frequency) const {
  using Complex = std::complex<double>;
  const double w = 2.0 * kPi * frequency;
  BandedSymmetric<Complex> dynamic(size(), stiffness_.band());
  for (std::size_t i = 0; i < dynamic.values().size(); ++i)
    dynamic.values()[i] = Complex(stiffness_.values()[i] - w * w * mass_.values()[i], w * damping_.values()[i]);
  const bool regular = dynamic.factorise();
  std::vector<Eigen::MatrixXcd> result;
  for (const double at : x) {
    const Place p = place(at);
    Eigen::MatrixXcd& value = result.emplace_back(p.own_compliance.cast<Complex>());
    for (Eigen::Index j = 0; regular && j < value.cols(); ++j) {
      BandedSymmetric<Complex>::Column q = BandedSymmetric<Complex>::Column::Zero(size());
      p.spread(j, 1.0, q);
      dynamic.solve(q);
      for (Eigen::Index i = 0; i < value.rows(); ++i)
        for (Eigen::Index k = 0; k < p.value.rows(); ++k)
          value(i, j) += p.value(k, i) * q[p.coordinate[static_cast<std::size_t>(k)]];
    }
    if (!regular || !value.allFinite())
      throw Error(ErrorKind::numerical, fmt::format("the track has no receptance at {:.6g} Hz", frequency), {},
                  "nothing holds it, or nothing damps it");
  }
  return result;
}

std::vector<std::complex<double>> RailOnSeats::receptance(std::span<const double> x, double frequency) const {
  std::vector<std::complex<double>> first;
  for (const Eigen::MatrixXcd& all : receptances(x, frequency)) first.push_back(all(0, 0));
  return first;
}

std::complex<double> RailOnSeats::receptance(double x, double frequency) const {
  return receptance(std::span(&x, 1), frequency).front();
}

std::vector<double> RailOnSeats::deflection(double force_at, std::span<const double> x) const {
  BandedSymmetric<double> factors = stiffness_;
  const bool regular = factors.factorise();
  const Place force = place(force_at);
  BandedSymmetric<double>::Column q = BandedSymmetric<double>::Column::Zero(size());
  force.spread(0, 1.0, q);
  if (regular) factors.solve(q);
  if (!regular || !q.allFinite())
    throw Error(ErrorKind::numerical, "nothing holds the track", {}, "stiffness is missing");
  std::vector<double> result;
  for (const double at : x) {
    const Place p = place(at);
    result.push_back((at == force_at ? p.own_compliance(0, 0) : 0.0) + p.along(0, q));
  }
  return result;
}

}  // namespace treadmark::vehicle
