// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/detection/contact_patch.hpp"

#include <algorithm>
#include <cmath>

#include "treadmark/core/to_whole.hpp"

namespace treadmark::detection {
namespace {

double interval_gap(double a_min, double a_max, double b_min, double b_max) {
  return std::max({0.0, b_min - a_max, a_min - b_max});
}

PatchExtent united(const PatchExtent& a, const PatchExtent& b) {
  PatchExtent e;
  e.box = {std::min(a.box.x_min, b.box.x_min), std::max(a.box.x_max, b.box.x_max), std::min(a.box.y_min, b.box.y_min),
           std::max(a.box.y_max, b.box.y_max)};
  e.z_at_y_min = a.box.y_min <= b.box.y_min ? a.z_at_y_min : b.z_at_y_min;
  e.z_at_y_max = a.box.y_max >= b.box.y_max ? a.z_at_y_max : b.z_at_y_max;
  return e;
}

ContactPatch merged(const ContactPatch& a, const ContactPatch& b, bool keep_parts) {
  ContactPatch m = a.least_gap <= b.least_gap ? a : b;
  m.extent = united(a.extent, b.extent);
  m.weight = a.weight + b.weight;
  const double share = m.weight > 0.0 ? a.weight / m.weight : 0.5;
  m.x = share * a.x + (1.0 - share) * b.x;
  m.y = share * a.y + (1.0 - share) * b.y;
  m.inclination = share * a.inclination + (1.0 - share) * b.inclination;
  m.extent.x = m.x, m.extent.y = m.y;
  m.parts = {m.extent};
  if (keep_parts) {
    m.parts = a.parts;
    m.parts.insert(m.parts.end(), b.parts.begin(), b.parts.end());
  }
  return m;
}

// Merges the first pair that satisfies the rule and starts again, until none does.
template <class Rule>
void merge_while(std::vector<ContactPatch>& patches, bool keep_parts, Rule&& rule) {
  for (bool changed = true; changed;) {
    changed = false;
    for (std::size_t i = 0; i < patches.size() && !changed; ++i)
      for (std::size_t j = i + 1; j < patches.size() && !changed; ++j)
        if (rule(patches[i], patches[j])) {
          patches[i] = merged(patches[i], patches[j], keep_parts);
          patches.erase(patches.begin() + static_cast<std::ptrdiff_t>(j));
          changed = true;
        }
  }
}

void extend_by(const ContactPatch& miss, double fraction, ContactPatch& patch) {
  PatchExtent& e = patch.extent;
  const auto pull = [fraction](double& own, double other) { own = (1.0 - fraction) * own + fraction * other; };
  if (miss.x < e.box.x_min) pull(e.box.x_min, miss.x);
  if (miss.x > e.box.x_max) pull(e.box.x_max, miss.x);
  if (miss.y < e.box.y_min) pull(e.box.y_min, miss.y), pull(e.z_at_y_min, miss.deepest_T.z());
  if (miss.y > e.box.y_max) pull(e.box.y_max, miss.y), pull(e.z_at_y_max, miss.deepest_T.z());
  patch.parts = {e};
}

}  // namespace

double patch_distance(const PatchExtent& a, const PatchExtent& b) {
  const double dx = interval_gap(a.box.x_min, a.box.x_max, b.box.x_min, b.box.x_max);
  const double dy = interval_gap(a.box.y_min, a.box.y_max, b.box.y_min, b.box.y_max);
  double dz = 0.0;
  if (dy > 0.0) dz = a.box.y_max < b.box.y_min ? b.z_at_y_min - a.z_at_y_max : a.z_at_y_min - b.z_at_y_max;
  return std::sqrt(dx * dx + dy * dy + dz * dz);
}

double sub_patch_coupling(double distance, const PatchRules& rules) {
  constexpr double kExponent = 0.8;
  if (distance <= rules.combination || rules.separation <= rules.combination) return 1.0;
  return std::pow(std::max(0.0, rules.separation - distance) / (rules.separation - rules.combination), kExponent);
}

std::vector<ContactPatch> combine_patches(std::vector<ContactPatch> patches,
                                          const std::vector<ContactPatch>& near_misses, const PatchRules& rules) {
  // To the nanometre: patches behind one another at the same y must not change places by rounding.
  const auto field_side_first = [](const ContactPatch& a, const ContactPatch& b) {
    const long long y_a = to_whole<long long>(std::round(1e9 * a.y)), y_b = to_whole<long long>(std::round(1e9 * b.y));
    return y_a != y_b ? y_a > y_b : a.x < b.x;
  };
  std::stable_sort(patches.begin(), patches.end(), field_side_first);

  // A region about to open extends the patch it will belong to.
  if (rules.near_miss > 0.0)
    for (const ContactPatch& miss : near_misses)
      for (ContactPatch& patch : patches)
        if (miss.least_gap < rules.near_miss && patch_distance(patch.extent, miss.extent) <= rules.combination)
          extend_by(miss, 1.0 - miss.least_gap / rules.near_miss, patch);

  merge_while(patches, false, [&](const ContactPatch& a, const ContactPatch& b) {
    return std::abs(a.inclination - b.inclination) <= rules.angle_separation &&
           patch_distance(a.extent, b.extent) <= rules.combination;
  });
  merge_while(patches, true, [&](const ContactPatch& a, const ContactPatch& b) {
    return std::abs(a.inclination - b.inclination) <= rules.angle_separation &&
           patch_distance(a.extent, b.extent) <= rules.separation;
  });
  std::stable_sort(patches.begin(), patches.end(), field_side_first);

  // Reference angles of close neighbours turn towards their common one before they merge.
  if (rules.turning > rules.separation) {
    std::vector<double> own(patches.size());
    for (std::size_t i = 0; i < patches.size(); ++i) own[i] = patches[i].inclination;
    for (std::size_t i = 0; i + 1 < patches.size(); ++i) {
      ContactPatch &a = patches[i], &b = patches[i + 1];
      const double distance = patch_distance(a.extent, b.extent);
      if (std::abs(own[i] - own[i + 1]) > rules.angle_separation || distance > rules.turning) continue;
      const double common = (a.weight * own[i] + b.weight * own[i + 1]) / (a.weight + b.weight);
      const double fraction = std::clamp((rules.turning - distance) / (rules.turning - rules.separation), 0.0, 1.0);
      a.inclination += fraction * (common - a.inclination);
      b.inclination += fraction * (common - b.inclination);
    }
  }
  return patches;
}

}  // namespace treadmark::detection
