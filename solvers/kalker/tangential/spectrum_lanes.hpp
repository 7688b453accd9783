// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <cstddef>

#include "treadmark/core/kernel.hpp"
#include "treadmark/core/lanes4.hpp"
#include "treadmark/solvers/kalker/tangential/spectrum_kernel.hpp"

namespace treadmark::kalker {

namespace {

// Lanes hold two complex numbers.
using lanes::load, lanes::store, lanes::V4;

struct AsItIs {
  [[gnu::always_inline]] V4 operator()(std::size_t, const V4& z) const { return z; }
  void one(std::size_t, double&, double&) const {}
};

/// z (c + i s): real c - imaginary s, imaginary c + real s.
[[gnu::always_inline]] inline V4 product(const V4& z, const V4& c, const V4& s) {
  return z * c + __builtin_shufflevector(z, z, 1, 0, 3, 2) * s;
}
inline void multiply(double& real, double& imaginary, double c, double s) {
  const double a = real * c - imaginary * s;
  imaginary = real * s + imaginary * c;
  real = a;
}

struct Turned {
  double c, s;
  [[gnu::always_inline]] V4 operator()(std::size_t, const V4& z) const {
    return product(z, V4{c, c, c, c}, V4{-s, s, -s, s});
  }
  void one(std::size_t, double& real, double& imaginary) const { multiply(real, imaginary, c, s); }
};

struct TurnedEach {
  const double* factors;
  [[gnu::always_inline]] V4 operator()(std::size_t k, const V4& z) const {
    const V4 f = load(factors + 2 * k), s = __builtin_shufflevector(f, f, 1, 1, 3, 3);
    return product(z, __builtin_shufflevector(f, f, 0, 0, 2, 2), s * V4{-1.0, 1.0, -1.0, 1.0});
  }
  void one(std::size_t k, double& real, double& imaginary) const {
    multiply(real, imaginary, factors[2 * k], factors[2 * k + 1]);
  }
};

template <class Last>
[[gnu::always_inline]] inline void multiply_blocks(std::size_t n, const double* __restrict blocks, double* __restrict x,
                                                   double* __restrict y, const Last& last) {
  std::size_t k = 0;
  for (; k + 2 <= n; k += 2) {
    // xx xy yy xx' and yy xx' xy' yy'
    const V4 a = load(blocks + 3 * k), b = load(blocks + 3 * k + 2);
    const V4 xx = __builtin_shufflevector(a, b, 0, 0, 3, 3), xy = __builtin_shufflevector(a, b, 1, 1, 6, 6),
             yy = __builtin_shufflevector(a, b, 2, 2, 7, 7);
    const V4 zx = load(x + 2 * k), zy = load(y + 2 * k);
    store(x + 2 * k, last(k, xx * zx + xy * zy));
    store(y + 2 * k, last(k, xy * zx + yy * zy));
  }
  for (; k < n; ++k) {
    const double *b = blocks + 3 * k, *zx = x + 2 * k, *zy = y + 2 * k;
    double x_real = b[0] * zx[0] + b[1] * zy[0], x_imaginary = b[0] * zx[1] + b[1] * zy[1];
    double y_real = b[1] * zx[0] + b[2] * zy[0], y_imaginary = b[1] * zx[1] + b[2] * zy[1];
    last.one(k, x_real, x_imaginary);
    last.one(k, y_real, y_imaginary);
    x[2 * k] = x_real, x[2 * k + 1] = x_imaginary;
    y[2 * k] = y_real, y[2 * k + 1] = y_imaginary;
  }
}

void blocks_plain(std::size_t n, const double* blocks, double* x, double* y) {
  multiply_blocks(n, blocks, x, y, AsItIs{});
}
void blocks_turned(std::size_t n, const double* blocks, double* x, double* y, double real, double imaginary) {
  multiply_blocks(n, blocks, x, y, Turned{real, imaginary});
}
void blocks_turned_each(std::size_t n, const double* blocks, double* x, double* y, const double* factors) {
  multiply_blocks(n, blocks, x, y, TurnedEach{factors});
}

}  // namespace

TREADMARK_KERNEL(SpectrumKernel, &blocks_plain, &blocks_turned, &blocks_turned_each);

}  // namespace treadmark::kalker
