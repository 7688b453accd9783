// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/backends/mesh/vertex_fit.hpp"

#include <Eigen/Dense>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <span>

#include "treadmark/backends/mesh/fit.hpp"
#include "treadmark/backends/mesh/sectors.hpp"
#include "treadmark/core/kernel.hpp"
#include "treadmark/core/parallel.hpp"

namespace treadmark::mesh {

namespace {

constexpr std::size_t kMargin = 2;        ///< points wanted beyond the number of coefficients
constexpr double kIllConditioned = 2e-3;  ///< least over greatest diagonal of R, columns of unit length
constexpr double kTurnedAway =
    0.5;  ///< cosine: points whose surface turned farther are no height over the tangent plane
constexpr std::size_t kEnough = 14;       ///< neighbours to have after three rings
constexpr std::size_t kMostPoints = 128;  ///< nearest rings only, at vertices of very many triangles

/// Terms of the polynomials, best first; the long axis of the neighbourhood is u.
constexpr int kCubic[] = {0, 1, 2, 3, 4, 5, 6, 7, 8}, kQuadratic[] = {0, 1, 2, 3, 4}, kAcross[] = {0, 1, 3, 4, 8},
              kParabola[] = {0, 1, 4}, kPlane[] = {0, 1};

void powers(double u, double v, double (&p)[9]) {
  const double all[9] = {u, v, u * u, u * v, v * v, u * u * u, u * u * v, u * v * v, v * v * v};
  std::copy(all, all + 9, p);
}

/// Sectors reached over one more ring of triangles; the first entry is the centre. One object serves one after the
/// other.
class Rings {
 public:
  explicit Rings(const Sectors& sectors) : sectors_(sectors) {}
  void start(std::uint32_t centre) {
    members_.assign(1, centre);
    grown_ = 0;
    table_.fill(kNone);
    table_[centre % kSlots] = centre;
  }
  void grow() {
    const std::size_t end = members_.size();
    for (std::size_t i = grown_; i < end && members_.size() < kMostPoints; ++i)
      for (const std::uint32_t t : sectors_.around(members_[i]))
        for (const std::uint32_t s : sectors_.of_corner[t])
          if (is_new(s)) members_.push_back(s);
    grown_ = end;
  }
  std::span<const std::uint32_t> others() const { return {members_.data() + 1, members_.size() - 1}; }

 private:
  static constexpr std::size_t kSlots = 512, kMostInTable = kSlots / 2;

  /// Whether it is no member yet. A table of members while they are few, as nearly always.
  bool is_new(std::uint32_t s) {
    if (members_.size() > kMostInTable) return std::find(members_.begin(), members_.end(), s) == members_.end();
    std::size_t slot = s % kSlots;
    for (; table_[slot] != kNone; slot = (slot + 1) % kSlots)
      if (table_[slot] == s) return false;
    table_[slot] = s;
    return true;
  }

  const Sectors& sectors_;
  std::vector<std::uint32_t> members_;
  std::size_t grown_ = 0;
  std::array<std::uint32_t, kSlots> table_;
};

/// Points in the tangent frame, divided by their spread along u and v.
struct Cloud {
  std::vector<Vec3> points;
  double scale_u = 1.0, scale_v = 1.0;
};

/// Turns the tangent axes to the longest and shortest spread of the points, or axis_u to `along`, so that both can be
/// scaled.
Cloud gather(const PreparedMesh& mesh, const Sectors& sectors, const std::vector<Vec3>& normals,
             std::span<const std::uint32_t> others, VertexFit& fit, const Vec3* along = nullptr) {
  Cloud cloud;
  double suu = 0.0, suv = 0.0, svv = 0.0;
  if (along) {
    fit.axis_u = (*along - along->dot(fit.normal) * fit.normal).normalized();
    fit.axis_v = fit.normal.cross(fit.axis_u);
  }
  for (const std::uint32_t s : others) {
    if (normals[s].dot(fit.normal) < kTurnedAway) continue;
    const Vec3 d = mesh.vertices[sectors.vertex[s]] - fit.origin;
    const Vec3 p(fit.axis_u.dot(d), fit.axis_v.dot(d), fit.normal.dot(d));
    cloud.points.push_back(p);
    suu += p.x() * p.x(), suv += p.x() * p.y(), svv += p.y() * p.y();
  }
  if (cloud.points.empty()) return cloud;
  if (!along) {
    const double angle = 0.5 * std::atan2(2.0 * suv, suu - svv), cos = std::cos(angle), sin = std::sin(angle);
    const Vec3 u = cos * fit.axis_u + sin * fit.axis_v;
    fit.axis_v = fit.normal.cross(u);
    fit.axis_u = u;
    suu = svv = 0.0;
    for (Vec3& p : cloud.points) {
      p = Vec3(cos * p.x() + sin * p.y(), cos * p.y() - sin * p.x(), p.z());
      suu += p.x() * p.x(), svv += p.y() * p.y();
    }
  }
  const auto count = static_cast<double>(cloud.points.size());
  const double least = 1e-12 * std::sqrt(std::max(suu, svv) / count);
  cloud.scale_u = std::max(least, std::sqrt(suu / count));
  cloud.scale_v = std::max(least, std::sqrt(svv / count));
  for (Vec3& p : cloud.points) p = Vec3(p.x() / cloud.scale_u, p.y() / cloud.scale_v, p.z());
  return cloud;
}

/// Direction of strips of long triangles: the shortest of the long edges round a vertex, because the others are
/// diagonals.
Vec3 along_strips(const PreparedMesh& mesh, const Sectors& sectors, std::uint32_t sector) {
  constexpr double kLong = 0.9;
  const Vec3& from = mesh.vertices[sectors.vertex[sector]];
  double longest = 0.0;
  for (const std::uint32_t t : sectors.around(sector))
    for (const std::uint32_t v : mesh.triangles[t]) longest = std::max(longest, (mesh.vertices[v] - from).norm());
  Vec3 best = Vec3::UnitX();
  double shortest = 2.0 * longest;
  for (const std::uint32_t t : sectors.around(sector))
    for (const std::uint32_t v : mesh.triangles[t]) {
      const Vec3 edge = mesh.vertices[v] - from;
      const double length = edge.norm();
      if (length < kLong * longest || length >= shortest) continue;
      shortest = length;
      best = edge;
    }
  return best;
}

/// False if the points do not determine the terms well.
bool solve(const Cloud& cloud, std::span<const int> terms, VertexFit& fit) {
  const auto n = static_cast<Eigen::Index>(cloud.points.size()), m = static_cast<Eigen::Index>(terms.size());
  const std::size_t margin = terms.size() > 2 ? kMargin : 0;
  if (cloud.points.size() < terms.size() + margin) return false;
  Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, 0, kMostPoints * 8, 9> A(
      std::min<Eigen::Index>(n, kMostPoints * 8), m);
  Eigen::Matrix<double, Eigen::Dynamic, 1, 0, kMostPoints * 8, 1> z(A.rows());
  for (Eigen::Index i = 0; i < A.rows(); ++i) {
    const Vec3& p = cloud.points[static_cast<std::size_t>(i)];
    double all[9];
    powers(p.x(), p.y(), all);
    const double weight = 1.0 / (0.25 + p.x() * p.x() + p.y() * p.y());
    for (Eigen::Index k = 0; k < m; ++k) A(i, k) = weight * all[terms[static_cast<std::size_t>(k)]];
    z[i] = weight * p.z();
  }
  Eigen::Matrix<double, Eigen::Dynamic, 1, 0, 9, 1> lengths(m);
  for (Eigen::Index k = 0; k < m; ++k) {
    lengths[k] = A.col(k).norm();
    if (!(lengths[k] > 0.0)) return false;
    A.col(k) /= lengths[k];
  }
  const Eigen::ColPivHouseholderQR<decltype(A)> qr(A);
  if (!(std::fabs(qr.matrixR()(m - 1, m - 1)) > kIllConditioned * std::fabs(qr.matrixR()(0, 0)))) return false;
  const Eigen::Matrix<double, Eigen::Dynamic, 1, 0, 9, 1> c = qr.solve(z);
  if (!c.allFinite()) return false;
  double unit[9];
  powers(1.0 / cloud.scale_u, 1.0 / cloud.scale_v, unit);
  fit.c.fill(0.0);
  for (Eigen::Index k = 0; k < m; ++k) {
    const auto term = static_cast<std::size_t>(terms[static_cast<std::size_t>(k)]);
    fit.c[term] = c[k] / lengths[k] * unit[term];
  }
  return true;
}

/// The vertex of a sector with a frame of its tangent plane.
VertexFit framed(const PreparedMesh& mesh, const Sectors& sectors, const std::vector<Vec3>& normals,
                 std::uint32_t sector) {
  VertexFit fit;
  fit.origin = mesh.vertices[sectors.vertex[sector]];
  fit.normal = normals[sector];
  fit.axis_u = fit.normal.unitOrthogonal();
  fit.axis_v = fit.normal.cross(fit.axis_u);
  return fit;
}

VertexFit fit_one(const PreparedMesh& mesh, const Sectors& sectors, const std::vector<Vec3>& normals,
                  std::uint32_t sector, Rings& rings) {
  VertexFit fit = framed(mesh, sectors, normals, sector);
  rings.start(sector);
  rings.grow();
  rings.grow();
  const Cloud two = gather(mesh, sectors, normals, rings.others(), fit);
  if (solve(two, kCubic, fit)) return fit;
  const VertexFit frame_of_two = fit;
  rings.grow();
  // strips of triangles and their corners have few neighbours a ring
  for (int more = 0; more < 3 && rings.others().size() < kEnough; ++more) rings.grow();
  const Cloud three = gather(mesh, sectors, normals, rings.others(), fit);
  if (solve(three, kCubic, fit)) return fit;
  if (solve(three, kQuadratic, fit)) return fit;
  // a polynomial that is linear along must not be skew to the strips
  const Vec3 along = along_strips(mesh, sectors, sector);
  VertexFit strip = fit;
  if (solve(gather(mesh, sectors, normals, rings.others(), strip, &along), kAcross, strip)) return strip;
  fit = frame_of_two;
  if (solve(two, kQuadratic, fit) || solve(two, kParabola, fit) || solve(two, kPlane, fit)) return fit;
  fit.c.fill(0.0);
  return fit;
}

/// Up to four sectors at a time. Where two rings determine a cubic beyond doubt that is fit_one's result; the others
/// are left to it.
void fit_some(const PreparedMesh& mesh, const Sectors& sectors, const std::vector<Vec3>& normals, std::uint32_t first,
              std::uint32_t end, Rings& rings, std::vector<KeptFit>& fits) {
  FitBlock block;
  std::array<bool, FitBlock::kLanesOfFit> fine{};
  std::memset(block.from, 0, sizeof block.from);
  for (std::uint32_t s = first; s < first + FitBlock::kLanesOfFit; ++s) {
    const std::size_t lane = s - first;
    const VertexFit fit = framed(mesh, sectors, normals, std::min(s, end - 1));
    int count = 0;
    bool fits_in = s < end;
    if (fits_in) {
      rings.start(s);
      rings.grow();
      rings.grow();
      fits_in = rings.others().size() <= static_cast<std::size_t>(FitBlock::kMostRows);
    }
    if (fits_in)
      for (const std::uint32_t other : rings.others()) {
        if (normals[other].dot(fit.normal) < kTurnedAway) continue;
        const Vec3 d = mesh.vertices[sectors.vertex[other]] - fit.origin;
        for (std::size_t k = 0; k < 3; ++k) block.from[count][k][lane] = d[static_cast<int>(k)];
        ++count;
      }
    fine[lane] = fits_in && static_cast<std::size_t>(count) >= std::size(kCubic) + kMargin;
    block.rows = std::max(block.rows, count);
    block.count[lane] = count;
    for (std::size_t k = 0; k < 3; ++k) {
      block.normal[k][lane] = fit.normal[static_cast<int>(k)];
      block.axis_u[k][lane] = fit.axis_u[static_cast<int>(k)];
    }
  }
  fastest_kernel<FitKernel>().cubics(block);
  for (std::uint32_t s = first; s < std::min(end, first + FitBlock::kLanesOfFit); ++s) {
    const std::size_t lane = s - first;
    VertexFit fit;
    bool finite = true;
    for (std::size_t k = 0; k < fit.c.size(); ++k) finite = finite && std::isfinite(fit.c[k] = block.cubic[k][lane]);
    // what pivots leave last is no smaller than the least singular value
    if (!(fine[lane] && finite && block.least_singular_value[lane] > kIllConditioned)) {
      fits[s] = kept(fit_one(mesh, sectors, normals, s, rings));
      continue;
    }
    fit.normal = normals[s];
    for (std::size_t k = 0; k < 3; ++k) fit.axis_u[static_cast<int>(k)] = block.axis_u[k][lane];
    fits[s] = kept(fit);
  }
}

}  // namespace

KeptFit kept(const VertexFit& fit) {
  KeptFit out{};
  for (int k = 0; k < 3; ++k) {
    out.normal[k] = static_cast<float>(fit.normal[k]);
    out.axis_u[k] = static_cast<float>(fit.axis_u[k]);
  }
  for (std::size_t k = 0; k < fit.c.size(); ++k) out.cubic[k] = static_cast<float>(fit.c[k]);
  return out;
}

VertexFit restored(const KeptFit& kept, const Vec3& origin) {
  VertexFit fit;
  fit.origin = origin;
  fit.normal = Eigen::Map<const Eigen::Vector3f>(kept.normal).cast<double>();
  fit.axis_u = Eigen::Map<const Eigen::Vector3f>(kept.axis_u).cast<double>();
  fit.axis_v = fit.normal.cross(fit.axis_u);
  std::copy(std::begin(kept.cubic), std::end(kept.cubic), fit.c.begin());
  return fit;
}

VertexFits fit_vertices(const PreparedMesh& mesh, double crease_angle) {
  Sectors sectors = find_sectors(mesh, crease_angle);
  const std::size_t n = sectors.size();
  constexpr std::size_t kChunk = 256;
  const std::size_t chunks = (n + kChunk - 1) / kChunk;
  VertexFits result;
  result.fits.resize(n);
  const auto for_all = [&](const auto& body) {
    parallel_for(chunks, [&](std::size_t chunk) {
      for (std::size_t s = chunk * kChunk; s < std::min(n, (chunk + 1) * kChunk); ++s) body(s);
    });
  };
  for_all([&](std::size_t s) {
    Vec3 sum = Vec3::Zero();
    for (const std::uint32_t t : sectors.around(static_cast<std::uint32_t>(s))) sum += doubled_area(mesh, t);
    if (!(sum.norm() > 0.0)) sum = doubled_area(mesh, sectors.around(static_cast<std::uint32_t>(s)).front());
    sum.normalize();
    for (int k = 0; k < 3; ++k) result.fits[s].normal[k] = static_cast<float>(sum[k]);
  });
  // As they are kept; by way of memory, because GCC 12 leaves out a rounding to float and back.
  std::vector<Vec3> normals(n);
  for_all([&](std::size_t s) { normals[s] = Eigen::Map<const Eigen::Vector3f>(result.fits[s].normal).cast<double>(); });
  parallel_for(chunks, [&](std::size_t chunk) {
    Rings rings(sectors);
    const auto end = static_cast<std::uint32_t>(std::min(n, (chunk + 1) * kChunk));
    for (auto s = static_cast<std::uint32_t>(chunk * kChunk); s < end; s += FitBlock::kLanesOfFit)
      fit_some(mesh, sectors, normals, s, end, rings, result.fits);
  });
  if (sectors.of_corner != mesh.triangles) result.of_corner = std::move(sectors.of_corner);
  return result;
}

}  // namespace treadmark::mesh
