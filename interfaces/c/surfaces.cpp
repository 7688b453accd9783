// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include <algorithm>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include "treadmark/app/cases/wheelrail_case.hpp"
#include "treadmark/app/surfaces/named_surface.hpp"
#include "treadmark/app/surfaces/sampled_surfaces.hpp"
#include "treadmark/app/surfaces/surface_store.hpp"
#include "treadmark/core/cancellation.hpp"
#include "treadmark/interfaces/c/calls.hpp"
#include "treadmark/interfaces/c/handles.hpp"
#include "treadmark/interfaces/c/surfaces.hpp"

namespace treadmark::c {

Body body_of(tm_body body) {
  require(body == TM_RAIL || body == TM_WHEEL, "body must be TM_RAIL or TM_WHEEL");
  return body == TM_WHEEL ? Body::wheel : Body::rail;
}

std::unique_ptr<tm_surface> natural_surface(NaturalSurface surface) {
  auto made = std::make_shared<const NaturalSurface>(std::move(surface));
  RepresentedSurface itself;
  itself.surface = made->surface;
  return std::make_unique<tm_surface>(tm_surface{std::move(made), std::move(itself)});
}

namespace {

void require_numbers(const double* values, std::size_t n, const char* what) {
  require(values != nullptr, what);
  for (std::size_t i = 0; i < n; ++i) require(std::isfinite(values[i]), what);
}

SurfaceSpec spec_of(tm_body body, double nominal_radius) {
  SurfaceSpec spec;
  spec.body = body_of(body);
  require(std::isfinite(nominal_radius) && (spec.body == Body::rail || nominal_radius > 0.0),
          "the nominal radius of a wheel must be positive");
  if (spec.body == Body::wheel) {
    app::require_wheel_radius(nominal_radius);
    spec.nominal_radius = nominal_radius;
  }
  return spec;
}

constexpr std::size_t kMost = std::size_t{1} << 28;  // numbers of an array

/// Slices at u, each with n points y and z.
std::unique_ptr<tm_surface> from_slices(SurfaceSpec spec, std::vector<double> u, const double* y, const double* z,
                                        std::size_t n) {
  SliceSet slices;
  slices.body = spec.body;
  slices.name = "slices of the caller";
  for (std::size_t i = 0; i < u.size(); ++i) {
    Profile profile;
    profile.body = spec.body;
    profile.name = "slice " + std::to_string(i + 1) + " of the caller";
    profile.y.assign(y + i * n, y + (i + 1) * n);
    profile.z.assign(z + i * n, z + (i + 1) * n);
    slices.profiles.push_back(std::move(profile));
  }
  slices.u = std::move(u);
  spec.shape = std::move(slices);
  return natural_surface(create_natural(std::move(spec)));
}

}  // namespace
}  // namespace treadmark::c

using namespace treadmark;
using namespace treadmark::c;

extern "C" {

tm_status tm_surface_read(const char* file, tm_body body, double nominal_radius, double scale_to_mm, tm_surface** out) {
  return make(out, [&] {
    require(file != nullptr, "file must not be null");
    require(nominal_radius >= 0.0 && std::isfinite(nominal_radius), "the nominal radius must not be negative");
    require(scale_to_mm > 0.0 && std::isfinite(scale_to_mm), "the scale must be positive");
    return natural_surface(app::named_surface(file, {body_of(body), nominal_radius, scale_to_mm, {}}));
  });
}

tm_status tm_surface_of_case(const tm_case* c, tm_body body, tm_surface** out) {
  return make(out, [&] {
    require(c != nullptr, "case must not be null");
    const auto* given = std::get_if<io::WheelRailCase>(&c->content->content);
    require(given != nullptr, "a case of one patch has no surfaces");
    const Body which = body_of(body);
    io::CaseFile file;
    file.cases = {*c->content};
    const app::SampledRegions regions = app::sampled_regions(file);
    app::SurfaceStore store;
    const app::StoredSurface& stored =
        store.get(which == Body::wheel ? given->wheel : given->rail, which, app::profile_radius(*given, which),
                  which == Body::wheel ? regions.wheel : regions.rail);
    return std::make_unique<tm_surface>(tm_surface{stored.natural, stored.represented});
  });
}

tm_status tm_surface_from_profile(tm_body body, const double* y, const double* z, size_t n, double nominal_radius,
                                  double strength, tm_surface** out) {
  return make(out, [&] {
    require(n >= 2 && n <= kMost, "a profile needs two points at least");
    require_numbers(y, n, "y must be n numbers");
    require_numbers(z, n, "z must be n numbers");
    require(strength >= 0.0 && std::isfinite(strength), "the strength must not be negative");
    SurfaceSpec spec = spec_of(body, nominal_radius);
    Profile profile;
    profile.body = spec.body;
    profile.name = "profile of the caller";
    profile.y.assign(y, y + n);
    profile.z.assign(z, z + n);
    profile.smoothing.strength = strength;
    spec.shape = std::move(profile);
    return natural_surface(create_natural(std::move(spec)));
  });
}

tm_status tm_surface_from_slices(tm_body body, const double* u, size_t n_u, const double* y, const double* z, size_t n,
                                 double nominal_radius, tm_surface** out) {
  return make(out, [&] {
    require(n >= 2 && n_u >= 2 && n <= kMost / n_u, "slices need two points, and there must be two of them at least");
    require_numbers(u, n_u, "u must be n_u numbers");
    require_numbers(y, n_u * n, "y must be n_u * n numbers");
    require_numbers(z, n_u * n, "z must be n_u * n numbers");
    return from_slices(spec_of(body, nominal_radius), std::vector<double>(u, u + n_u), y, z, n);
  });
}

tm_status tm_surface_from_triangles(tm_body body, const double* xyz, size_t vertices, const int32_t* corners,
                                    size_t triangles, double nominal_radius, tm_surface** out) {
  return make(out, [&] {
    require(vertices >= 3 && triangles >= 1 && vertices <= kMost && triangles <= kMost,
            "there must be three vertices and a triangle at least");
    require_numbers(xyz, 3 * vertices, "xyz must be three numbers a vertex");
    require(corners != nullptr, "corners must not be null");
    TriangleMesh mesh;
    mesh.name = "triangles of the caller";
    for (std::size_t i = 0; i < vertices; ++i) mesh.vertices.emplace_back(xyz[3 * i], xyz[3 * i + 1], xyz[3 * i + 2]);
    for (std::size_t t = 0; t < triangles; ++t) {
      auto& triangle = mesh.triangles.emplace_back();
      for (std::size_t k = 0; k < 3; ++k) {
        const std::int32_t corner = corners[3 * t + k];
        require(corner >= 0 && static_cast<std::size_t>(corner) < vertices, "a corner must be the index of a vertex");
        triangle[k] = static_cast<std::uint32_t>(corner);
      }
    }
    SurfaceSpec spec = spec_of(body, nominal_radius);
    spec.shape = std::move(mesh);
    return natural_surface(create_natural(std::move(spec)));
  });
}

tm_status tm_surface_from_function(tm_body body, tm_heights heights, void* user, double u_min, double u_max, size_t n_u,
                                   double y_min, double y_max, size_t n, double nominal_radius, tm_surface** out) {
  return make(out, [&] {
    require(heights != nullptr, "the function must not be null");
    require(n >= 2 && n_u >= 2 && n <= kMost / n_u, "two points at least are needed each way");
    require(u_max > u_min && y_max > y_min && std::isfinite(u_max - u_min) && std::isfinite(y_max - y_min),
            "the rectangle must not be empty");
    SurfaceSpec spec = spec_of(body, nominal_radius);
    std::vector<double> u(n_u), y(n_u * n), z(n_u * n);
    for (std::size_t i = 0; i < n_u; ++i) {
      check_cancelled();
      u[i] = u_min + (u_max - u_min) * static_cast<double>(i) / static_cast<double>(n_u - 1);
      for (std::size_t k = 0; k < n; ++k) {
        const double share = static_cast<double>(k) / static_cast<double>(n - 1);
        y[i * n + k] = y_min + (y_max - y_min) * (spec.body == Body::wheel ? 1.0 - share : share);
      }
      if (heights(user, u[i], &y[i * n], n, &z[i * n]) != 0) throw Cancelled();
    }
    require_numbers(z.data(), z.size(), "the function gave a height that is not finite");
    return from_slices(std::move(spec), std::move(u), y.data(), z.data(), n);
  });
}

tm_status tm_surface_represent(const tm_surface* from, const char* backend, double resolution, tm_surface** out) {
  return make(out, [&] {
    require(from != nullptr && backend != nullptr, "surface and backend must not be null");
    require(resolution >= 0.0 && std::isfinite(resolution), "the resolution must not be negative");
    require_backend(backend);
    return std::make_unique<tm_surface>(
        tm_surface{from->natural, represent(*from->natural, {backend, resolution, {}})});
  });
}

tm_status tm_surface_heights(const tm_surface* s, const double origin[3], const double rotation[9], const double* x,
                             const double* y, size_t n, double* z, double* dzdx, double* dzdy) {
  return guarded([&] {
    require(s != nullptr, "surface must not be null");
    require(n <= kMost, "there are too many points");
    Pose X_SP;
    if (origin != nullptr) X_SP.origin = Vec3(origin[0], origin[1], origin[2]);
    if (rotation != nullptr) {
      for (int i = 0; i < 3; ++i)
        for (int k = 0; k < 3; ++k) X_SP.rotation(i, k) = rotation[3 * i + k];
      constexpr double kOrthonormal = 1e-9;
      require((X_SP.rotation * X_SP.rotation.transpose() - Mat3::Identity()).norm() < kOrthonormal &&
                  X_SP.rotation.determinant() > 0.0,
              "rotation must be one");
    }
    require_numbers(X_SP.origin.data(), 3, "origin must be finite");
    if (n == 0) return;
    require_numbers(x, n, "x must be n numbers");
    require_numbers(y, n, "y must be n numbers");
    std::vector<Vec2> points;
    for (std::size_t i = 0; i < n; ++i) points.emplace_back(x[i], y[i]);
    const auto wanted = [&](double* values) {
      return values == nullptr ? std::span<double>() : std::span<double>(values, n);
    };
    s->represented.surface->heights_at(X_SP, points, {wanted(z), wanted(dzdx), wanted(dzdy)});
  });
}

size_t tm_surface_parameters(const tm_surface* s) {
  std::size_t count = 0;
  if (s != nullptr) static_cast<void>(guarded([&] { count = s->represented.surface->parameter_count(); }));
  return count;
}

tm_status tm_surface_parameter_places(const tm_surface* s, double* xyz, size_t n) {
  return guarded([&] {
    require(s != nullptr && (xyz != nullptr || n == 0), "surface and places must not be null");
    const std::vector<ShapeParameter> all = s->represented.surface->parameters();
    require(n == all.size(), "n must be the number of parameters (tm_surface_parameters)");
    for (const ShapeParameter& one : all) xyz = std::copy_n(one.place_S.data(), 3, xyz);
  });
}

const char* tm_surface_backend(const tm_surface* s) {
  return s == nullptr ? nullptr : s->represented.surface->backend().data();  // names of the registry end with a zero
}

void tm_surface_free(tm_surface* s) { delete s; }

}  // extern "C"
