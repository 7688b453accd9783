// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include "treadmark/backends/analytic/defects/cutter.hpp"

namespace treadmark::analytic {

/// Where lines o + t n leave the volume that a cutter removes, for one direction n. One object serves one thread.
class CutterRay {
 public:
  CutterRay(const Cutter& cutter, const Vec3& direction);

  struct Hit {
    double t = 0.0;
    Vec3 gradient = Vec3::Zero();  ///< of the bound through which the line leaves; points out of the material
    Cutter::Bound bound = Cutter::kSection;
  };
  /// If the point at t is removed: the first point beyond it, t increasing, that is not. False: it is not removed.
  bool leave(const Vec3& origin, double t, Hit& hit);

 private:
  double rate_of_x_terms(const Cutter::Place& at) const;
  double descend(double t, const Cutter::Place& from, double least_rate, double t_last, Cutter::Place& at);
  double cross_end(double s_end, double a, double b);
  double march(double t, Cutter::Bound& bound);
  Cutter::Place place(double t) { return cutter_->place(o_ + t * n_, hint_); }
  double x(double t) const { return o_.x() + t * n_.x(); }

  const Cutter* cutter_;
  Vec3 n_, o_ = Vec3::Zero();
  double least_q_ = 0.0, most_s_ = 0.0;  ///< of dq/dt and |ds/dt| for any roll of the path, without the terms in n_x
  double depth_ = 0.0;                   ///< from the base to the section at the line before
  Cutter::Hint hint_;
};

}  // namespace treadmark::analytic
