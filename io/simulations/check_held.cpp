// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/io/simulations/check_held.hpp"

#include <algorithm>
#include <cmath>
#include <set>

#include <fmt/format.h>
#include <Eigen/Dense>

#include "treadmark/io/simulations/read_vehicle.hpp"

namespace treadmark::io {

namespace {

[[noreturn]] void fail(std::string message, const BodySpec& body, std::string advice = {}) {
  throw Error(ErrorKind::configuration, std::move(message), body.where, std::move(advice));
}

bool is_stiff(const SpringSpec& spring) {
  return std::any_of(spring.stiffness.begin(), spring.stiffness.end(), [](double k) { return k > 0.0; });
}

void check_touched(const std::vector<BodySpec>& bodies, const std::vector<SpringSpec>& springs) {
  for (const BodySpec& body : bodies)
    if (std::none_of(springs.begin(), springs.end(),
                     [&](const SpringSpec& s) { return s.body_a == body.name || s.body_b == body.name; }))
      fail(fmt::format("nothing holds '{}': no spring touches it", body.name), body, "connect it in [[springs]]");
}

void check_connected(const std::vector<BodySpec>& bodies, const std::vector<SpringSpec>& springs,
                     const Foundation& foundation) {
  std::set<std::string> reached(foundation.bodies.begin(), foundation.bodies.end());
  for (bool grows = true; grows;) {
    grows = false;
    for (const SpringSpec& s : springs) {
      if (!is_stiff(s)) continue;
      for (const auto& [from, to] : {std::pair(s.body_a, s.body_b), std::pair(s.body_b, s.body_a)})
        if (reached.contains(from) && to != kGround && reached.insert(to).second) grows = true;
    }
  }
  for (const BodySpec& body : bodies)
    if (!reached.contains(body.name))
      fail(fmt::format("nothing holds '{}': no chain of springs connects it with {}", body.name, foundation.name), body,
           "a spring is missing in [[springs]]");
}

/// Stiffness of small movements about the place at rest, in the directions that need to be held.
class HeldDirections {
 public:
  HeldDirections(const std::vector<BodySpec>& bodies, const Foundation& foundation)
      : bodies_(bodies), column_(bodies.size()) {
    for (std::size_t b = 0; b < bodies.size(); ++b) {
      const auto& ends = foundation.bodies;
      const bool founded = std::find(ends.begin(), ends.end(), bodies[b].name) != ends.end();
      for (std::size_t d = 0; d < kFreedoms; ++d) {
        column_[b].at(d) = -1;
        if (!bodies[b].free.at(d) || (founded && foundation.held.at(d))) continue;
        column_[b].at(d) = static_cast<Eigen::Index>(owner_.size());
        owner_.emplace_back(b, static_cast<int>(d));
      }
    }
    const auto count = static_cast<Eigen::Index>(owner_.size());
    stiffness_.setZero(count, count);
  }

  void add(const SpringSpec& spring) {
    Eigen::MatrixXd stretch = Eigen::MatrixXd::Zero(kFreedoms, stiffness_.cols());
    add_motion(stretch, spring.body_a, spring.position, -1.0);
    add_motion(stretch, spring.body_b, spring.position, 1.0);
    const Eigen::Map<const Eigen::Vector<double, kFreedoms>> k(spring.stiffness.data());
    stiffness_ += stretch.transpose() * k.asDiagonal() * stretch;
  }

  void check() const {
    const Eigen::VectorXd diagonal = stiffness_.diagonal();
    for (Eigen::Index i = 0; i < diagonal.size(); ++i)
      if (!(diagonal[i] > 0.0)) refuse(i, "in");
    if (diagonal.size() == 0) return;
    // Scaled to 1 on the diagonal, so that neither units nor soft springs look like a mechanism.
    constexpr double kMechanism = 1e-10;
    const Eigen::VectorXd scale = diagonal.cwiseSqrt().cwiseInverse();
    const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> modes(scale.asDiagonal() * stiffness_ * scale.asDiagonal());
    if (modes.eigenvalues()[0] > kMechanism) return;
    Eigen::Index most = 0;
    modes.eigenvectors().col(0).cwiseAbs().maxCoeff(&most);
    refuse(most, "against a movement together with others, most of all in");
  }

 private:
  /// Motion of a point of a body by its displacement and small rotation.
  void add_motion(Eigen::MatrixXd& stretch, const std::string& name, const Vec3& point, double sign) const {
    const auto found =
        std::find_if(bodies_.begin(), bodies_.end(), [&](const BodySpec& body) { return body.name == name; });
    if (found == bodies_.end()) return;
    const Vec3 arm = point - found->position;
    const auto& column = column_.at(static_cast<std::size_t>(found - bodies_.begin()));
    for (int d = 0; d < 3; ++d) {
      const Vec3 axis = Vec3::Unit(d);
      if (const Eigen::Index c = column.at(static_cast<std::size_t>(d)); c >= 0) stretch(d, c) += sign;
      const Eigen::Index c = column.at(static_cast<std::size_t>(d + 3));
      if (c < 0) continue;
      stretch.block<3, 1>(0, c) += sign * axis.cross(arm);
      stretch(d + 3, c) += sign;
    }
  }

  [[noreturn]] void refuse(Eigen::Index column, std::string_view how) const {
    const auto& [body, freedom] = owner_.at(static_cast<std::size_t>(column));
    fail(fmt::format("nothing holds '{}' {} {}", bodies_[body].name, how, freedom_word(freedom)), bodies_[body],
         "give a spring that does, or take the direction out of `free`");
  }

  const std::vector<BodySpec>& bodies_;
  std::vector<std::array<Eigen::Index, kFreedoms>>
      column_;                                      ///< of each body's directions; -1: does not move, or is held
  std::vector<std::pair<std::size_t, int>> owner_;  ///< of each column: body and direction
  Eigen::MatrixXd stiffness_;
};

}  // namespace

void check_held(const std::vector<BodySpec>& bodies, const std::vector<SpringSpec>& springs,
                const Foundation& foundation) {
  check_touched(bodies, springs);
  check_connected(bodies, springs, foundation);
  HeldDirections held(bodies, foundation);
  for (const SpringSpec& spring : springs) held.add(spring);
  held.check();
}

}  // namespace treadmark::io
