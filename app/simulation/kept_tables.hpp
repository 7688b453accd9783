// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <functional>
#include <memory>
#include <string>

#include "treadmark/io/files/content_cache.hpp"
#include "treadmark/solvers/vehicle/contacts/contact_table.hpp"
#include "treadmark/solvers/vehicle/contacts/creep_table.hpp"

namespace treadmark::app {

/// What computes here, to the last bit: this build of Treadmark, the mathematical libraries with it, the processor.
/// Empty where it is not known; then nothing is kept.
const std::string& computing_identity();

/// Tables for vehicles as they are kept in a cache from process to process, else made, with the same bytes. cache: null
/// where none is wanted. Thread-safe. Errors: those of making them.

/// bodies: content keys of both surfaces. What it grows by is kept in the same way.
std::shared_ptr<const vehicle::ContactTable> kept_contact_table(const io::ContentCache* cache,
                                                                const std::string& bodies,
                                                                const wheelrail::Geometry& geometry,
                                                                const wheelrail::Problem& prototype, double load);

std::shared_ptr<const vehicle::CreepTable> kept_creep_table(
    const io::ContentCache* cache, double poisson, const vehicle::CreepTableOptions& options = {},
    const std::function<void(std::size_t finished, std::size_t all)>& report = {});

}  // namespace treadmark::app
