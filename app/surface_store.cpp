// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/app/surface_store.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "treadmark/backends/create.hpp"
#include "treadmark/core/error.hpp"
#include "treadmark/io/profiles/read_profile.hpp"
#include "treadmark/io/profiles/read_slices.hpp"
#include "treadmark/io/profiles/sha256.hpp"

namespace treadmark::app {
namespace {

std::string key_of(const io::SurfaceSource& source, Body body, double nominal_radius) {
  std::string key = fmt::format("{} {:.17g} {}", body == Body::rail ? "rail" : "wheel", nominal_radius, source.backend);
  if (const auto* file = std::get_if<io::GeometryFile>(&source.geometry)) {
    const io::ProfileOptions& o = file->options;
    const SmoothingOptions& s = o.smoothing;
    key += fmt::format(" file {} {} {} {:.17g} {:.17g} {:.17g} {} {} {:.17g} {:.17g} {:.17g} {:.17g}", file->file.string(),
                       o.mirror_y, o.mirror_z, o.scale, o.zigzag_threshold, o.max_omit, o.error_handling,
                       static_cast<int>(s.method), s.strength, s.kink_high, s.kink_low, s.kink_width);
  } else if (const auto* standard = std::get_if<StandardProfile>(&source.geometry)) {
    key += " standard " + standard->name;
  } else if (const auto* arcs = std::get_if<ArcChain>(&source.geometry)) {
    key += fmt::format(" arcs {:.17g} {:.17g} {:.17g}", arcs->start_y, arcs->start_z, arcs->start_angle);
    for (const auto& segment : arcs->segments) key += fmt::format(" {:.17g} {:.17g}", segment.length, segment.curvature);
  }
  for (const WheelFlat& f : source.defects.flats)
    key += fmt::format(" flat {} {:.17g} {:.17g} {:.17g} {:.17g} {:.17g}", static_cast<int>(f.shape), f.length, f.depth,
                       f.theta_center, f.y_center, f.width);
  return key;
}

}  // namespace

void SurfaceStore::note_hash(const std::string& file) {
  const bool known = std::any_of(hashes_.begin(), hashes_.end(), [&](const auto& entry) { return entry.first == file; });
  if (!known) hashes_.emplace_back(file, io::sha256_file(file));
}

const StoredSurface& SurfaceStore::get(const io::SurfaceSource& source, Body body, double nominal_radius) {
  const std::string key = key_of(source, body, nominal_radius);
  if (const auto found = surfaces_.find(key); found != surfaces_.end()) return found->second;

  SurfaceSpec spec;
  spec.body = body;
  spec.nominal_radius = nominal_radius;
  spec.defects.flats = source.defects.flats;
  StoredSurface stored;
  stored.constant_profile = source.defects.flats.empty();
  if (const auto* file = std::get_if<io::GeometryFile>(&source.geometry)) {
    if (io::is_slices_file(file->file)) {
      spec.shape = io::read_slices(file->file, body, file->options, source.where);
      stored.constant_profile = false;
    } else {
      spec.shape = io::read_profile(file->file, body, file->options, source.where);
    }
    note_hash(file->file.string());
  } else if (const auto* standard = std::get_if<StandardProfile>(&source.geometry)) {
    spec.shape = *standard;
  } else {
    spec.shape = std::get<ArcChain>(source.geometry);
  }
  try {
    stored.surface = create_surface(spec, source.backend);
  } catch (const Error& e) {
    if (!e.where().file.empty()) throw;
    throw Error(e.kind(), e.message(), source.where, e.advice());
  }
  return surfaces_.emplace(key, std::move(stored)).first->second;
}

}  // namespace treadmark::app
