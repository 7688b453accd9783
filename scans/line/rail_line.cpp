// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/scans/line/rail_line.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "treadmark/core/constants.hpp"
#include "treadmark/core/error.hpp"
#include "treadmark/core/parallel_blocks.hpp"
#include "treadmark/core/to_whole.hpp"

namespace treadmark::scans {
namespace {

constexpr double kNodes = 0.25;  // between nodes of the frame [m]: its roll is exact to 1e-9 rad on a radius of 100 m
constexpr std::size_t kBlock = 4096;

}  // namespace

RailLine::RailLine(double from, double step, std::vector<Vec3> positions, std::vector<double> rolls, const Vec3& up)
    : from_(from), step_(step), positions_(std::move(positions)), rolls_(std::move(rolls)) {
  if (positions_.size() < 4 || rolls_.size() != positions_.size() || !(step > 0.0))
    throw Error(ErrorKind::input_data, "a line needs at least four coefficients");
  const auto nodes = to_whole<std::size_t>(std::max(1.0, std::ceil(length() / kNodes)));
  node_step_ = length() / static_cast<double>(nodes);
  nodes_.reserve(nodes + 1);
  ups_.reserve(nodes + 1);
  arcs_.reserve(nodes + 1);
  Vec3 tangent = Vec3::Zero();
  for (std::size_t k = 0; k <= nodes; ++k) {
    const double along = from_ + node_step_ * static_cast<double>(k);
    const Local here = local(along);
    const Vec3 ahead = here.first.normalized();
    if (k == 0) {
      const Vec3 across = up - ahead * ahead.dot(up);
      if (!(across.norm() > 0.1 * up.norm()))
        throw Error(ErrorKind::input_data, "the direction out of the rail runs along its line");
      ups_.push_back(across.normalized());
      arcs_.push_back(0.0);
    } else {
      // two reflections: in the plane halfway between the nodes, then in that which lays the tangent right
      const Vec3 chord = here.position - nodes_.back();
      const double square = chord.squaredNorm();
      Vec3 moved = ups_.back();
      if (square > 0.0) {
        moved -= (2.0 / square) * chord.dot(moved) * chord;
        const Vec3 turned = tangent - (2.0 / square) * chord.dot(tangent) * chord, apart = ahead - turned;
        if (apart.squaredNorm() > 0.0) moved -= (2.0 / apart.squaredNorm()) * apart.dot(moved) * apart;
      }
      ups_.push_back((moved - ahead * ahead.dot(moved)).normalized());
      // Gauss and Legendre's three places
      double piece = 0.0;
      for (const auto& [at, weight] :
           {std::pair{-std::sqrt(0.6), 5.0 / 18.0}, std::pair{0.0, 8.0 / 18.0}, std::pair{std::sqrt(0.6), 5.0 / 18.0}})
        piece += weight * node_step_ * local(along - node_step_ * (0.5 - 0.5 * at)).first.norm();
      arcs_.push_back(arcs_.back() + piece);
    }
    nodes_.push_back(here.position);
    tangent = ahead;
  }
}

LineBasis RailLine::basis(double along) const {
  const double place = (along - from_) / step_;
  const std::size_t interval = to_whole<std::size_t>(place, 0.0, static_cast<double>(intervals() - 1));
  const double t = place - static_cast<double>(interval), inside = std::clamp(t, 0.0, 1.0), over = t - inside;
  const double o = 1.0 - inside, q = inside;
  LineBasis out;
  out.first = interval;
  out.value << o * o * o, 4.0 - 6.0 * q * q + 3.0 * q * q * q, 4.0 - 6.0 * o * o + 3.0 * o * o * o, q * q * q;
  out.value /= 6.0;
  out.slope << -o * o, -4.0 * q + 3.0 * q * q, 4.0 * o - 3.0 * o * o, q * q;
  out.slope /= 2.0;
  out.bend << o, -2.0 + 3.0 * q, -2.0 + 3.0 * o, q;
  out.value += over * out.slope + 0.5 * over * over * out.bend;
  out.slope += over * out.bend;
  out.slope /= step_;
  out.bend /= step_ * step_;
  return out;
}

RailLine::Local RailLine::local(double along) const {
  const LineBasis b = basis(along);
  Local out{Vec3::Zero(), Vec3::Zero(), Vec3::Zero()};
  for (std::size_t i = 0; i < 4; ++i) {
    const auto row = static_cast<Eigen::Index>(i);
    const Vec3& c = positions_[b.first + i];
    out.position += b.value[row] * c;
    out.first += b.slope[row] * c;
    out.second += b.bend[row] * c;
  }
  return out;
}

Vec3 RailLine::position(double along) const { return local(along).position; }

double RailLine::roll(double along) const {
  const LineBasis b = basis(along);
  double out = 0.0;
  for (std::size_t i = 0; i < 4; ++i) out += b.value[static_cast<Eigen::Index>(i)] * rolls_[b.first + i];
  return out;
}

Vec3 RailLine::unturned(double along, const Vec3& tangent) const {
  const double place = (along - from_) / node_step_;
  const std::size_t k = to_whole<std::size_t>(place, 0.0, static_cast<double>(nodes_.size() - 2));
  const double share = std::clamp(place - static_cast<double>(k), 0.0, 1.0);
  const Vec3 up = (1.0 - share) * ups_[k] + share * ups_[k + 1];
  return (up - tangent * tangent.dot(up)).normalized();
}

Vec3 RailLine::up(double along) const { return unturned(along, local(along).first.normalized()); }

Pose RailLine::at(double along) const {
  const Local here = local(along);
  const Vec3 x = here.first.normalized(), z0 = -unturned(along, x), y0 = z0.cross(x);
  const double angle = roll(along), c = std::cos(angle), s = std::sin(angle);
  Pose out;
  out.origin = here.position;
  out.rotation << x, c * y0 + s * z0, c * z0 - s * y0;
  return out;
}

LineTurn RailLine::turn(double along) const {
  const Local here = local(along);
  const Pose frame = at(along);
  const double square = here.first.squaredNorm();
  const LineBasis b = basis(along);
  double rate = 0.0;
  for (std::size_t i = 0; i < 4; ++i) rate += b.slope[static_cast<Eigen::Index>(i)] * rolls_[b.first + i];
  return {here.second.dot(frame.rotation.col(1)) / square, here.second.dot(frame.rotation.col(2)) / square,
          rate / std::sqrt(square)};
}

double RailLine::arc(double along) const {
  const double place = (along - from_) / node_step_;
  const std::size_t k = to_whole<std::size_t>(place, 0.0, static_cast<double>(nodes_.size() - 1));
  const double begin = from_ + node_step_ * static_cast<double>(k), part = along - begin;
  double piece = 0.0;
  for (const auto& [at, weight] :
       {std::pair{-std::sqrt(0.6), 5.0 / 18.0}, std::pair{0.0, 8.0 / 18.0}, std::pair{std::sqrt(0.6), 5.0 / 18.0}})
    piece += weight * part * local(begin + part * (0.5 + 0.5 * at)).first.norm();
  return arcs_[k] + piece;
}

std::optional<Vec3> RailLine::locate(const Vec3& p_C, double near) const {
  constexpr int kRounds = 20;
  constexpr double kStill = 1e-12, kLeast = 0.1;  // [m]; part of the speed that the centre of the curve leaves
  constexpr double kRounding = 4e-15;             // of coordinates, far from the origin as those of maps are
  const double still = kStill + kRounding * p_C.cwiseAbs().maxCoeff();
  double along = near;
  for (int round = 0; round < kRounds; ++round) {
    const Local here = local(along);
    const Vec3 apart = p_C - here.position;
    const double slope = here.first.squaredNorm() - apart.dot(here.second);
    if (!(slope > kLeast * here.first.squaredNorm())) return std::nullopt;
    const double step = apart.dot(here.first) / slope;
    along += step;
    if (!std::isfinite(along)) return std::nullopt;
    if (std::fabs(step) > still + kStill * std::fabs(along)) continue;
    const Vec3 p_L = at(along).apply_inverse(p_C);
    return Vec3(along, p_L.y(), p_L.z());
  }
  return std::nullopt;
}

double RailLine::nearest(const Vec3& p_C) const {
  // nodes some apart first, then those about the nearest of them
  const auto stride = std::max<std::size_t>(1, to_whole<std::size_t>(std::sqrt(static_cast<double>(nodes_.size()))));
  std::size_t best = 0;
  double least = kInfinity;
  const auto look = [&](std::size_t k) {
    if (const double square = (nodes_[k] - p_C).squaredNorm(); square < least) least = square, best = k;
  };
  for (std::size_t k = 0; k < nodes_.size(); k += stride) look(k);
  look(nodes_.size() - 1);
  const std::size_t low = best > stride ? best - stride : 0, high = std::min(nodes_.size() - 1, best + stride);
  for (std::size_t k = low; k <= high; ++k) look(k);
  return from_ + node_step_ * static_cast<double>(best);
}

void RailLine::straighten(std::span<Vec3> points) const {
  constexpr double kNear = 0.3;  // of the place before; beyond it the nearest node is looked for [m]
  parallel_blocks(points.size(), kBlock, [&](std::size_t begin, std::size_t end) {
    double near = kInfinity;
    Vec3 before = Vec3::Constant(kInfinity);
    for (std::size_t i = begin; i < end; ++i) {
      if (!((points[i] - before).norm() < kNear)) near = nearest(points[i]);
      before = points[i];
      std::optional<Vec3> place = locate(points[i], near);
      if (!place) place = locate(points[i], nearest(points[i]));
      if (!place) {
        // far off, as behind the centre of a curve: as the nearest frame sees it
        const double at_node = nearest(points[i]);
        place = this->at(at_node).apply_inverse(points[i]) + Vec3(at_node, 0.0, 0.0);
      }
      near = place->x();
      points[i] = *place;
    }
  });
}

}  // namespace treadmark::scans
