// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/backends/spline/make.hpp"

#include <algorithm>
#include <utility>

#include <fmt/format.h>

#include "treadmark/backends/spline/fit_profile.hpp"
#include "treadmark/backends/spline/given_spline.hpp"
#include "treadmark/backends/spline/nurbs/nurbs_surface.hpp"
#include "treadmark/backends/spline/prismatic_surface.hpp"
#include "treadmark/backends/spline/revolution_surface.hpp"
#include "treadmark/backends/spline/slices/fit_slices.hpp"
#include "treadmark/backends/spline/slices/slice_surface.hpp"
#include "treadmark/backends/spline/thb/thb_fit.hpp"
#include "treadmark/backends/spline/told_spline.hpp"

namespace treadmark::spline {

std::shared_ptr<const Surface> make_profile_surface(const Profile& profile, double nominal_radius) {
  if (profile.body == Body::rail) return std::make_shared<PrismaticSurface>(fit_profile(profile));
  return std::make_shared<RevolutionSurface>(fit_profile(profile), nominal_radius);
}

std::shared_ptr<const Surface> make_slice_surface(const SliceSet& slices, double nominal_radius) {
  if (slices.body == Body::rail) return std::make_shared<SliceRail>(fit_slices(slices), 0.0);
  return std::make_shared<SliceWheel>(fit_slices(slices), nominal_radius);
}

namespace {

NurbsNet nurbs_of(const ArcChain& chain, Body body, double nominal_radius, double x_min, double x_max) {
  return body == Body::rail ? sweep_chain(chain, x_min, x_max) : revolve_chain(chain, nominal_radius);
}

ThbSpline thb_of(std::span<const Vec3> points, Body body, const sampling::Region& region, int degree,
                 std::string& note) {
  ThbFitSettings settings;
  settings.degree = degree;
  ThbFit fit = fit_thb(points, body, region, settings);
  note += fmt::format("{} coefficients in place of {} points, whose noise is {:.2g} um. ", fit.spline.space.functions(),
                      points.size(), 1e6 * fit.noise);
  return std::move(fit.spline);
}

ThbSpline thb_of(const sampling::PointGrid& points, int degree, std::string& note) {
  ThbFitSettings settings;
  settings.degree = degree;
  settings.noise = 0.0;  // of a surface
  ThbFit fit = fit_thb(points, settings);
  note += fmt::format("{} coefficients in place of {} points, at most {:.2g} um off them. ",
                      fit.spline.space.functions(), points.h.size(), 1e6 * fit.most_left);
  return std::move(fit.spline);
}

const char* thb_name(int degree) { return degree == 3 ? "thb" : "thb-quadratic"; }

}  // namespace

std::shared_ptr<const Surface> make_nurbs_surface(const sampling::PointGrid& points) {
  return std::make_shared<NurbsSurface>(fit_point_grid(points), points.body);
}

std::shared_ptr<const Surface> make_nurbs_surface(const ArcChain& chain, Body body, double nominal_radius, double x_min,
                                                  double x_max) {
  return std::make_shared<NurbsSurface>(nurbs_of(chain, body, nominal_radius, x_min, x_max), body);
}

FittedSpline fit_tensor_spline(const sampling::PointGrid& points) {
  NurbsNet net = fit_point_grid(points);
  SplineSurface spline = told_spline(net);
  return {std::move(spline), std::make_shared<NurbsSurface>(std::move(net), points.body)};
}

std::shared_ptr<const Surface> make_thb_surface(std::span<const Vec3> points, Body body, const sampling::Region& region,
                                                int degree, std::string& note) {
  return std::make_shared<NurbsSurface>(extracted(thb_of(points, body, region, degree, note)), body, thb_name(degree));
}

std::shared_ptr<const Surface> make_thb_surface(const sampling::PointGrid& points, int degree, std::string& note) {
  return std::make_shared<NurbsSurface>(extracted(thb_of(points, degree, note)), points.body, thb_name(degree));
}

std::shared_ptr<const Surface> make_given_surface(const SplineSurface& splines, Body body, std::string* note) {
  const GivenSpline given(splines);
  const auto [of_s, of_t] = given.degrees();
  double off = 0.0;
  NurbsNet net = given.net(body, &off);
  if (off > 0.0 && note != nullptr)
    *note += fmt::format("degrees {} x {} by cubics within {:.2g} nm. ", of_s, of_t, 1e9 * off);
  return std::make_shared<NurbsSurface>(std::move(net), body,
                                        given.hierarchical() ? thb_name(std::max(2, std::max(of_s, of_t))) : "nurbs");
}

SplineSurface tell_nurbs(const sampling::PointGrid& points) { return told_spline(fit_point_grid(points)); }

SplineSurface tell_nurbs(const ArcChain& chain, Body body, double nominal_radius, double x_min, double x_max) {
  return told_spline(nurbs_of(chain, body, nominal_radius, x_min, x_max));
}

SplineSurface tell_thb(const sampling::PointGrid& points, int degree, std::string& note) {
  return told_spline(thb_of(points, degree, note));
}

SplineSurface tell_thb(std::span<const Vec3> points, Body body, const sampling::Region& region, int degree,
                       std::string& note) {
  return told_spline(thb_of(points, body, region, degree, note));
}

}  // namespace treadmark::spline
