// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/app/surfaces/surface_store.hpp"

#include <algorithm>

#include <fmt/format.h>

#include "treadmark/app/surfaces/read_surface.hpp"
#include "treadmark/backends/registry.hpp"
#include "treadmark/core/error.hpp"
#include "treadmark/io/files/sha256.hpp"
#include "treadmark/io/profiles/read_profile.hpp"
#include "treadmark/model/shape/body_name.hpp"

namespace treadmark::app {
namespace {

/// Everything that tells one geometry from another but its defects.
std::string key_of(const io::SurfaceSource& source, Body body, double radius) {
  std::string key = fmt::format("{} {:.17g}", body_name(body), radius);
  const io::CrossingInput& c = source.crossing;
  if (c.part != io::CrossingInput::Part::none)
    key += fmt::format(" crossing {} {:.17g} {:.17g} {:.17g} {:.17g} {:.17g} {:.17g}", static_cast<int>(c.part), c.x,
                       c.y, c.z, c.slope, c.length, c.rounding);
  for (const io::SurfaceSource& part : source.parts)
    key += fmt::format(" [{} at {:.17g} {:.17g} {:.17g} as {} {:.17g}]", key_of(part, body, radius), part.offset.x(),
                       part.offset.y(), part.offset.z(), part.backend, part.resolution);
  if (const io::OffsetsInput& o = source.offsets; !o.file.empty())
    key += fmt::format(" offsets {} {} {} {}", o.file.string(), o.unit ? symbol(*o.unit) : "-",
                       o.deviation_unit ? symbol(*o.deviation_unit) : "-", o.angles_deg);
  if (const auto* file = std::get_if<io::GeometryFile>(&source.geometry)) {
    const io::ProfileOptions& o = file->options;
    const SmoothingOptions& s = o.smoothing;
    key += fmt::format(" file {} {} {} {} {} {} {:.17g} {:.17g} {:.17g} {} {} {:.17g} {:.17g} {:.17g} {:.17g}",
                       file->file.string(), file->open_seam, o.mirror_y, o.mirror_z, static_cast<int>(o.placement),
                       o.back_told, o.scale, o.zigzag_threshold, o.max_omit, o.error_handling,
                       static_cast<int>(s.method), s.strength, s.kink_high, s.kink_low, s.kink_width);
  } else if (const auto* standard = std::get_if<StandardProfile>(&source.geometry)) {
    key += " standard " + standard->name;
  } else if (const auto* arcs = std::get_if<ArcChain>(&source.geometry)) {
    key += fmt::format(" arcs {:.17g} {:.17g} {:.17g}", arcs->start_y, arcs->start_z, arcs->start_angle);
    for (const auto& segment : arcs->segments)
      key += fmt::format(" {:.17g} {:.17g}", segment.length, segment.curvature);
  } else if (const auto* given = std::get_if<io::SolidsInput>(&source.geometry)) {
    key += fmt::format(" solids {:.17g}", given->voxel);
    for (const io::SolidInput& s : given->solids)
      key += fmt::format(" [{} {} {:.17g} {} at {:.17g} {:.17g} {:.17g}]", s.file.string(), static_cast<int>(s.use),
                         s.scale, s.grid, s.offset.x(), s.offset.y(), s.offset.z());
  }
  return key;
}

bool same(const Region& a, const Region& b) {
  return a.u_min == b.u_min && a.u_max == b.u_max && a.y_min == b.y_min && a.y_max == b.y_max;
}

bool same(const Representation& a, const Representation& b) {
  return a.backend == b.backend && a.resolution == b.resolution && same(a.region, b.region);
}

/// Runs build() with the place in the case file added to errors that have none.
template <class Build>
auto located(const SourcePosition& where, Build build) {
  try {
    return build();
  } catch (const Error& e) {
    if (!e.where().file.empty()) throw;
    throw Error(e.kind(), e.message(), where, e.advice());
  }
}

}  // namespace

void SurfaceStore::note_hashes(const io::SurfaceSource& source) {
  for (const io::SurfaceSource& part : source.parts) note_hashes(part);
  const auto note = [&](const std::string& file, const std::filesystem::path& content) {
    const bool known =
        std::any_of(hashes_.begin(), hashes_.end(), [&](const auto& entry) { return entry.first == file; });
    if (!known) hashes_.emplace_back(file, io::sha256_file(content));
  };
  if (!source.offsets.file.empty()) note(source.offsets.file.string(), source.offsets.file);
  const auto* geometry = std::get_if<io::GeometryFile>(&source.geometry);
  if (const auto* given = std::get_if<io::SolidsInput>(&source.geometry))
    for (const io::SolidInput& solid : given->solids) note(solid.file.string(), solid.file);
  if (geometry != nullptr && source.parts.empty()) note(geometry->file.string(), io::profile_file(geometry->file));
}

std::string SurfaceStore::content_key(const io::SurfaceSource& source, Body body, double radius) {
  note_hashes(source);
  std::string key = key_of(source, body, radius);
  for (const auto& [file, hash] : hashes_)
    if (key.find(file) != std::string::npos) key += " " + hash;
  return key;
}

std::shared_ptr<const NaturalSurface> SurfaceStore::natural(const io::SurfaceSource& source, Body body, double radius) {
  std::string key = key_of(source, body, radius);
  for (const Natural& known : naturals_)
    if (known.key == key && known.defects == source.defects) return known.surface;
  auto surface =
      located(source.where, [&] { return std::make_shared<const NaturalSurface>(read_surface(source, body, radius)); });
  note_hashes(source);
  naturals_.push_back({std::move(key), source.defects, surface});
  return surface;
}

void SurfaceStore::put(const io::SurfaceSource& source, Body body, double radius,
                       std::shared_ptr<const NaturalSurface> surface) {
  note_hashes(source);
  naturals_.push_back({key_of(source, body, radius), source.defects, std::move(surface)});
  replaced_ = true;
}

const StoredSurface& SurfaceStore::get(const io::SurfaceSource& source, Body body, double radius,
                                       const Region& region) {
  const auto given = natural(source, body, radius);
  const Representation wanted{source.backend, source.resolution, region};
  auto found = std::find_if(stored_.begin(), stored_.end(), [&](const auto& s) {
    return s->natural == given.get() && same(s->representation, wanted);
  });
  if (found == stored_.end()) {
    auto entry = std::make_unique<Stored>();
    entry->natural = given.get();
    entry->representation = wanted;
    entry->surface = std::make_unique<StoredSurface>(StoredSurface{given, located(source.where, [&] {
                                                                     RepresentedSurface made =
                                                                         represent(*given, wanted);
                                                                     if (wanted.resolution > 0.0 && !made.resampled)
                                                                       refuse_idle_resolution();
                                                                     return made;
                                                                   })});
    stored_.push_back(std::move(entry));
    found = stored_.end() - 1;
  }
  Stored* entry = found->get();
  if (std::find(used_.begin(), used_.end(), entry) == used_.end()) used_.push_back(entry);
  return *entry->surface;
}

void SurfaceStore::forget_sampled() {
  used_.clear();
  std::erase_if(stored_, [](const auto& entry) { return entry->surface->represented.resampled; });
}

std::vector<io::SurfaceUse> SurfaceStore::uses() {
  std::vector<io::SurfaceUse> uses;
  for (Stored* entry : used_) {
    const StoredSurface& s = *entry->surface;
    if (s.represented.resampled && !entry->fit_known) {
      entry->fit = fit_error(*s.natural, s.represented);
      entry->fit_known = true;
    }
    uses.push_back({body_name(s.body()), std::string(s.represented.surface->backend()), s.represented.resolution,
                    s.represented.build_seconds, s.represented.surface->memory_bytes(), entry->fit,
                    s.represented.note});
  }
  return uses;
}

}  // namespace treadmark::app
