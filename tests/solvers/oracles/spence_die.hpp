// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

namespace treadmark::kalker::testing {

/// Compression with finite friction of an elastic half-space by a rigid sphere, or of two dissimilar bodies (Spence
/// 1975): sticking within the same share k = c/a of the contact radius at any load.
struct SpenceCompression {
  double friction = 0.0;      ///< mu for which the sticking radius is k a
  double force_ratio = 0.0;   ///< force over that of Hertz (no friction) at the same approach
  double radius_ratio = 0.0;  ///< contact radius over that of Hertz at the same approach
};

/// Solves Spence's eigenvalue problem extrapolated from n/2 and n elements in each zone, independently of any contact
/// grid. beta: Dundurs' constant, K/(1 - nu) in Kalker's notation; 0 < k < 1.
SpenceCompression spence_compression(double k, double beta, int n);

}  // namespace treadmark::kalker::testing
