// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include <cmath>

#include "treadmark/core/error.hpp"
#include "treadmark/core/parallel.hpp"
#include "treadmark/solvers/kalker/halfspace/toeplitz_operator.hpp"
#include "treadmark/solvers/kalker/subsurface/half_space_body.hpp"
#include "treadmark/solvers/kalker/subsurface/loaded_corners.hpp"

namespace treadmark::kalker {

namespace {

/// Field parts below element centres per unit load on one element, by index offset.
class PartTables {
 public:
  PartTables(const Grid2& grid, double depth, double poisson)
      : nx_(grid.nx), ny_(grid.ny), depth_(depth), poisson_(poisson), corners_(corner_count(grid)) {
    const double least = least_distance(grid);
    parallel_for(static_cast<std::size_t>(2 * ny_), [&](std::size_t row) {
      for (int ix = 0; ix < 2 * nx_; ++ix)
        corners_[row * row_size() + static_cast<std::size_t>(ix)] =
            corner_potentials((ix - nx_ + 0.5) * grid.dx, (static_cast<int>(row) - ny_ + 0.5) * grid.dy, depth, least);
    });
  }

  /// Computes the parts of a load for all offsets.
  void set_load(SurfaceLoad load) {
    parts_.resize(corners_.size());
    parallel_for(static_cast<std::size_t>(2 * ny_ - 1), [&](std::size_t row) {
      for (std::size_t k = row * row_size(); k + 1 < (row + 1) * row_size(); ++k)
        parts_[k] = half_space_field(load, rectangle(k), depth_, poisson_);
    });
  }

  double operator()(std::size_t part, int dix, int diy) const {
    return parts_[static_cast<std::size_t>(diy + ny_ - 1) * row_size() + static_cast<std::size_t>(dix + nx_ - 1)][part];
  }

 private:
  static std::size_t corner_count(const Grid2& grid) { return 4 * grid.size(); }
  std::size_t row_size() const { return static_cast<std::size_t>(2 * nx_); }

  /// Double difference over the four corners, of which k is the one with the least coordinates.
  Potentials rectangle(std::size_t k) const {
    const Potentials &p00 = corners_[k], &p10 = corners_[k + 1];
    const Potentials &p01 = corners_[k + row_size()], &p11 = corners_[k + row_size() + 1];
    Potentials out;
    for (std::size_t i = 0; i < kPotentialCount; ++i) out[i] = (p11[i] - p10[i]) - (p01[i] - p00[i]);
    return out;
  }

  int nx_, ny_;
  double depth_, poisson_;
  std::vector<Potentials> corners_;  ///< 2 nx by 2 ny
  std::vector<FieldParts> parts_;    ///< the last column and row are unused
};

/// The spectra of those tractions that are not zero everywhere; others are empty.
std::array<Spectrum, kSurfaceLoads> traction_spectra(const ToeplitzTransform& transform,
                                                     const SurfaceTractions& tractions) {
  std::array<Spectrum, kSurfaceLoads> spectra;
  std::vector<double> field(transform.size());
  for (std::size_t k = 0; k < kSurfaceLoads; ++k) {
    bool loaded = false;
    for (std::size_t i = 0; i < field.size(); ++i) {
      field[i] = traction(tractions, static_cast<SurfaceLoad>(k), i);
      loaded = loaded || field[i] != 0.0;
    }
    if (!loaded) continue;
    spectra[k].resize(transform.spectrum_size());
    transform.forward(field, spectra[k]);
  }
  return spectra;
}

using PartFields = std::array<std::vector<double>, kFieldPartCount>;

PartFields fields_at_depth(const ToeplitzTransform& transform, const Grid2& grid,
                           const std::array<Spectrum, kSurfaceLoads>& loads, const HalfSpaceBody& body, double depth) {
  PartTables tables(grid, depth, body.poisson);
  std::array<Spectrum, kFieldPartCount> sums;
  for (Spectrum& sum : sums) sum.resize(transform.spectrum_size());
  for (std::size_t k = 0; k < kSurfaceLoads; ++k) {
    if (loads[k].empty()) continue;
    const auto load = static_cast<SurfaceLoad>(k);
    const double sign = body.traction_sign(load);
    tables.set_load(load);
    parallel_for(kFieldPartCount, [&](std::size_t part) {
      Spectrum product = transform.kernel_spectrum([&](int dix, int diy) { return sign * tables(part, dix, diy); });
      multiply(product, loads[k]);
      for (std::size_t i = 0; i < product.size(); ++i) sums[part][i] += product[i];
    });
  }
  PartFields fields;
  parallel_for(kFieldPartCount, [&](std::size_t part) {
    fields[part].resize(transform.size());
    transform.inverse(sums[part], fields[part]);
  });
  return fields;
}

}  // namespace

std::vector<SubsurfacePoint> subsurface_stress_on_grid(const SurfaceTractions& tractions, const Material& material,
                                                       std::span<const double> depths) {
  check_tractions(tractions);
  const Grid2& grid = tractions.grid;
  for (const double z : depths)
    if (!std::isfinite(z)) throw Error(ErrorKind::configuration, "stresses below the surface: a depth is not finite");
  const ToeplitzTransform transform(grid.nx, grid.ny);
  const std::array<Spectrum, kSurfaceLoads> loads = traction_spectra(transform, tractions);
  std::vector<SubsurfacePoint> results(grid.size() * depths.size());
  for (std::size_t iz = 0; iz < depths.size(); ++iz) {
    const HalfSpaceBody body = body_at(material, depths[iz]);
    const PartFields fields = fields_at_depth(transform, grid, loads, body, body.depth(depths[iz]));
    parallel_for(static_cast<std::size_t>(grid.ny), [&](std::size_t iy) {
      for (int ix = 0; ix < grid.nx; ++ix) {
        const std::size_t i = grid.index(ix, static_cast<int>(iy));
        FieldParts parts;
        for (std::size_t part = 0; part < kFieldPartCount; ++part) parts[part] = fields[part][i];
        const Vec3 point(grid.x(ix), grid.y(static_cast<int>(iy)), depths[iz]);
        results[iz * grid.size() + i] = subsurface_point(body, point, parts);
      }
    });
  }
  return results;
}

}  // namespace treadmark::kalker
