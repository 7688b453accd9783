// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/backends/following_base.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <ranges>
#include <utility>
#include <variant>
#include <vector>

#include <fmt/format.h>

#include "treadmark/backends/builtin.hpp"
#include "treadmark/backends/sampling/sample_points.hpp"
#include "treadmark/core/cancellation.hpp"
#include "treadmark/core/parallel.hpp"
#include "treadmark/core/platform/ranges.hpp"
#include "treadmark/model/shape/natural_view.hpp"

namespace treadmark {
namespace {

constexpr double kApart = 40.0;     // resolutions between sections
constexpr std::size_t kParts = 32;  // into which these distances may be divided
constexpr double kSteep = 2.0;      // [-] slope from which the base alone has to be right
constexpr double kOff = 1e-7;       // so far [m], normal to the surface

/// Places of sections, some of which are kept.
class Sections {
 public:
  explicit Sections(Resampling& r) : r_(r) {
    const double apart = kApart * r.resolution();
    const auto* slices = std::get_if<SliceSet>(&r.spec().shape);
    if (slices != nullptr && !slices->features.empty() && r.spec().defects.empty()) {
      given_ = slices;
      u_ = slices->u;
      profiles_.assign(slices->profiles.begin(), slices->profiles.end());
      kept_.resize(u_.size());
      double last = -std::numeric_limits<double>::infinity();
      for (std::size_t i = 0; i < u_.size(); ++i) {
        // all between which a part begins or ends stay, and so do the outermost
        kept_[i] = u_[i] - last >= apart || i < 2 || i + 2 >= u_.size() || !same_parts(i - 2, i + 2);
        if (kept_[i]) last = u_[i];
      }
    } else {
      constexpr double kBeyond = 9.0;  // resolutions that are sampled outside of the region
      sampling::Region region = r.region();
      region.u_min -= kBeyond * r.resolution();
      region.u_max += kBeyond * r.resolution();
      bool closed = false;
      const std::vector<double> coarse = sampling::stations(r.surface(), Body::rail, 0.0, region, apart, closed);
      u_.reserve(kParts * coarse.size());
      for (std::size_t i = 0; i + 1 < coarse.size(); ++i)
        for (std::size_t k = 0; k < kParts; ++k)
          u_.push_back(coarse[i] + (coarse[i + 1] - coarse[i]) * static_cast<double>(k) / kParts);
      u_.push_back(coarse.back());
      profiles_.resize(u_.size());
      kept_.resize(u_.size());
      for (std::size_t i = 0; i < u_.size(); i += kParts) kept_[i] = true;
      make(kept());
    }
  }

  std::shared_ptr<const Surface> base() const {
    SliceSet some;
    if (given_ != nullptr) {
      some = *given_;
      some.u.clear(), some.profiles.clear(), some.features.clear();
    }
    for (const std::size_t i : kept()) {
      some.u.push_back(u_[i]);
      some.profiles.push_back(*profiles_[i]);
      if (given_ != nullptr) some.features.push_back(given_->features[i]);
    }
    SurfaceSpec spec;
    spec.shape = std::move(some);
    return make_natural(spec);
  }

  /// Keeps more where the base is off; false: there are none.
  bool add(const Surface& base) {
    const std::vector<std::size_t> now = kept();
    // in the middle alone an error may pass through zero
    std::vector<std::size_t> middles, places;
    for (std::size_t k = 0; k + 1 < now.size(); ++k) {
      const std::size_t step = now[k + 1] - now[k];
      if (step == 1) continue;
      middles.push_back(now[k] + step / 2);
      for (const std::size_t quarter : {1, 2, 3})
        places.push_back(now[k] + std::max<std::size_t>(1, quarter * step / 4));
    }
    std::vector<std::size_t> different = places;
    different.erase(std::unique(different.begin(), different.end()), different.end());
    make(different);
    std::vector<char> wanted(places.size());
    parallel_for(places.size(), [&](std::size_t k) { wanted[k] = off(base, places[k]) > kOff; });
    for (std::size_t k = 0; k < places.size(); ++k)
      if (wanted[k] != 0) kept_[middles[k / 3]] = true;
    bool any = ranges::find(wanted, 1) != wanted.end();
    if (any) even_out();
    return any;
  }

  std::size_t count() const { return kept().size(); }

 private:
  std::vector<std::size_t> kept() const {
    std::vector<std::size_t> out;
    for (std::size_t i = 0; i < u_.size(); ++i)
      if (kept_[i]) out.push_back(i);
    return out;
  }

  /// Splines ring where long steps follow short ones.
  void even_out() {
    for (bool again = true; again;) {
      again = false;
      const std::vector<std::size_t> now = kept();
      const auto step = [&](std::size_t k) { return u_[now[k + 1]] - u_[now[k]]; };
      std::vector<std::size_t> more;
      for (std::size_t k = 0; k + 1 < now.size(); ++k) {
        const double shorter = std::min(k > 0 ? step(k - 1) : step(k), k + 2 < now.size() ? step(k + 1) : step(k));
        if (now[k + 1] > now[k] + 1 && step(k) > 2.0 * (1.0 + 1e-6) * shorter)
          more.push_back((now[k] + now[k + 1]) / 2);
      }
      make(more);
      for (const std::size_t i : more) kept_[i] = again = true;
    }
  }

  void make(const std::vector<std::size_t>& which) {
    check_cancelled();
    parallel_for(which.size(), [&](std::size_t k) {
      std::optional<Profile>& profile = profiles_[which[k]];
      if (!profile) profile = r_.section_at(u_[which[k]]);
    });
  }

  /// How far steep parts of the base lie from those of a section [m].
  double off(const Surface& base, std::size_t at) const {
    const std::vector<double>& y = profiles_[at]->y;
    std::vector<double> z(y.size()), slope(y.size()), z_base(y.size());
    section_heights(r_.surface(), Body::rail, u_[at], y, {z, {}, slope});
    section_heights(base, Body::rail, u_[at], y, {z_base, {}, {}});
    double most = 0.0;
    for (std::size_t i = 1; i + 1 < y.size(); ++i) {
      if (std::isnan(z[i])) continue;
      if (std::isnan(z_base[i])) return std::numeric_limits<double>::infinity();
      if (std::fabs(slope[i]) > kSteep) most = std::max(most, std::fabs(z_base[i] - z[i]) / std::hypot(1.0, slope[i]));
    }
    return most;
  }

  /// Whether the same features are there in all slices from a to b.
  bool same_parts(std::size_t a, std::size_t b) const {
    const auto missing = [](double s) { return std::isnan(s); };
    for (std::size_t i = a; i < b; ++i)
      if (!ranges::equal(given_->features[i], given_->features[i + 1], {}, missing, missing)) return false;
    return true;
  }

  Resampling& r_;
  const SliceSet* given_ = nullptr;
  std::vector<double> u_;
  std::vector<std::optional<Profile>> profiles_;
  std::vector<bool> kept_;
};

}  // namespace

std::shared_ptr<const Surface> following_base(Resampling& r) {
  r.limit_rail();
  Sections sections(r);
  std::shared_ptr<const Surface> base = sections.base();
  while (sections.add(*base)) base = sections.base();
  r.add_note(
      fmt::format("offsets over {} sections at most {:g} mm apart. ", sections.count(), 1e3 * kApart * r.resolution()));
  return base;
}

}  // namespace treadmark
