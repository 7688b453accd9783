// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/backends/registry.hpp"

#include <mutex>
#include <shared_mutex>
#include <utility>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "treadmark/backends/builtin.hpp"
#include "treadmark/core/error.hpp"
#include "treadmark/core/missing_file.hpp"
#include "treadmark/core/parts.hpp"
#include "treadmark/core/platform/ranges.hpp"
#include "treadmark/model/backend_name.hpp"

namespace treadmark {
namespace {

[[noreturn]] void refuse_backend(const Backend& backend, std::string_view why, std::string advice) {
  throw Error(ErrorKind::configuration, fmt::format("the backend '{}' {}", backend.name, why), {}, std::move(advice));
}

bool is_built(const Backend& backend) { return backend.part.empty() || has_part(backend.part); }

const Backend& require_built(const Backend& backend) {
  if (!is_built(backend)) left_out(backend.part, fmt::format("the backend '{}'", backend.name));
  return backend;
}

class Registry {
 public:
  static Registry& the() {
    static Registry registry;
    return registry;
  }

  void add(Backend backend) {
    if (!is_backend_name(backend.name))
      refuse_backend(backend, "has a name that no case file could hold",
                     "begin with a small letter, go on with those, digits, '-' and '_'");
    if (backend.summary.empty()) refuse_backend(backend, "has no summary", "say in one line what it is");
    if (!backend.natural_for != !backend.make_natural)
      refuse_backend(backend, "has only one of natural_for and make_natural", "set both or neither");
    if (!backend.resample && !backend.make_natural) refuse_backend(backend, "makes nothing", "set resample");
    const std::unique_lock lock(mutex_);
    for (const auto& row : rows_)
      if (row->name == backend.name) refuse_backend(backend, "exists already", "choose another name");
    rows_.push_back(std::make_unique<const Backend>(std::move(backend)));
  }

  /// With those that this build leaves out.
  std::vector<const Backend*> all() const {
    const std::shared_lock lock(mutex_);
    std::vector<const Backend*> out;
    for (const auto& row : rows_) out.push_back(row.get());
    return out;
  }

  std::vector<const Backend*> those(bool built) const {
    std::vector<const Backend*> out = all();
    std::erase_if(out, [built](const Backend* row) { return is_built(*row) != built; });
    return out;
  }

 private:
  /// The order is that of all lists.
  Registry() {
    for (const auto rows :
         {analytic_backends, spline_backends, mesh_backends, offset_backends, levelset_backends, shortcut_backends})
      for (Backend& row : rows()) add(std::move(row));
  }

  mutable std::shared_mutex mutex_;
  std::vector<std::unique_ptr<const Backend>> rows_;
};

}  // namespace

void register_backend(Backend backend) { Registry::the().add(std::move(backend)); }

std::vector<const Backend*> backends() { return Registry::the().those(true); }
std::vector<const Backend*> left_out_backends() { return Registry::the().those(false); }

const Backend& backend_of(std::string_view name) {
  const auto all = Registry::the().all();
  const auto found = ranges::find(all, name, &Backend::name);
  if (found == all.end()) {
    const std::vector<std::string_view> known = backend_names();
    throw Error(ErrorKind::configuration, fmt::format("unknown backend '{}'", name), {},
                advice_on_name(name, std::vector<std::string>(known.begin(), known.end())));
  }
  return require_built(**found);
}

const Backend& natural_backend(const SurfaceSpec& spec) {
  for (const Backend* backend : Registry::the().all())
    if (backend->natural_for && backend->natural_for(spec)) return require_built(*backend);
  throw Error(ErrorKind::configuration, "no backend takes shapes of this kind as they are");
}

std::shared_ptr<const Surface> make_natural(const SurfaceSpec& spec) {
  std::string note;
  return natural_backend(spec).make_natural(spec, note);
}

std::vector<BackendChoice> backend_choices(const std::vector<std::string>& names,
                                           const std::vector<double>& resolutions,
                                           const std::vector<const NaturalSurface*>& surfaces) {
  std::vector<const Backend*> chosen;
  for (const std::string& name : names) chosen.push_back(&backend_of(name));
  if (names.empty()) chosen = backends();
  std::vector<BackendChoice> all;
  for (const Backend* backend : chosen) {
    const bool given = ranges::all_of(
        surfaces, [&](const NaturalSurface* natural) { return natural->surface->backend() == backend->name; });
    const bool sampled = static_cast<bool>(backend->resample);
    if (given || (!sampled && !names.empty())) all.push_back({backend->name, 0.0});
    if (!sampled) continue;
    for (const double resolution : resolutions) all.push_back({backend->name, resolution});
  }
  return all;
}

std::vector<std::string_view> backend_names() {
  std::vector<std::string_view> names;
  for (const Backend* backend : backends()) names.push_back(backend->name);
  return names;
}

void require_backend(std::string_view name) { backend_of(name); }

}  // namespace treadmark
