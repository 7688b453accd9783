// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/backends/added_offsets.hpp"

#include <variant>

#include "treadmark/backends/offset/make.hpp"
#include "treadmark/core/error.hpp"

namespace treadmark {
namespace {

constexpr double kLeastAddedOffset = 1e-12;  // [m]

bool one_section(const SurfaceSpec& spec) {
  return std::holds_alternative<Profile>(spec.shape) || std::holds_alternative<StandardProfile>(spec.shape) ||
         std::holds_alternative<ArcChain>(spec.shape);
}

}  // namespace

NaturalSurface add_offsets(const NaturalSurface& natural, const OffsetMap& map) {
  if (natural.spec.roller_radius != 0.0)
    throw Error(ErrorKind::configuration, "offsets are added to rails and wheels, not to rollers");
  const auto offsets = offset::offsets_from_map(map, natural.spec.body, kLeastAddedOffset).offsets;
  NaturalSurface out;
  out.surface = offset::make_offset_surface(natural.surface, offsets, offset::Interpolation::bicubic, "offset");
  out.note = natural.note;
  out.spec.body = natural.spec.body;
  out.spec.nominal_radius = natural.spec.nominal_radius;
  out.spec.errors = natural.spec.errors;
  out.spec.doubts = natural.spec.doubts;
  out.spec.shape = SliceSet{};  // known no longer: resampled from the surface
  return out;
}

void write_added_offsets(const std::filesystem::path& file, const NaturalSurface& natural, const OffsetMap& map,
                         const Representation& wanted, const std::string& notes) {
  SurfaceSpec base = natural.spec;
  base.defects = {};
  const bool known = one_section(base);
  if (known && natural.spec.defects.empty()) {
    const auto offsets = offset::offsets_from_map(map, base.body, kLeastAddedOffset).offsets;
    offset::write_vdb(file, {offsets, base, notes});
  } else {
    write_offsets(file, add_offsets(natural, map), wanted, nullptr, known ? &base : nullptr, notes);
  }
}

}  // namespace treadmark
