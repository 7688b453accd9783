// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <gtest/gtest.h>

#include <memory>
#include <string>
#include <vector>

#include "treadmark/app/fmu/model_description.hpp"
#include "treadmark/app/fmu/resources.hpp"
#include "treadmark/tests/interfaces/fmi/importer.hpp"
#include "treadmark/tests/support/temporary_folder.hpp"

namespace treadmark::testing {

/// What an FMU would be unpacked to, without packing tens of megabytes of libraries.
class Fmu {
 public:
  /// Of a case file in memory.
  explicit Fmu(const std::string& text, int version = 3, bool wheelset = false) {
    fill(folder_.write("input.toml", text), version, wheelset, {});
  }
  Fmu(const std::filesystem::path& input, int version, const std::vector<std::string>& overrides = {}) {
    fill(input, version, false, overrides);
  }

  const UnpackedFmu& unpacked() const { return unpacked_; }
  std::unique_ptr<Importer> open() const {
    auto opened = Importer::open(unpacked_);
    EXPECT_NE(opened, nullptr);
    return opened;
  }

 private:
  void fill(const std::filesystem::path& input, int version, bool wheelset, const std::vector<std::string>& overrides) {
    fmi::FmuContent content;
    content.input = input;
    content.wheelset = wheelset;
    content.overrides = overrides;
    about_.title = fmi::write_resources(content, folder_.path() / "its resources");
    about_.name = "fmu";
    about_.token = fmi::token_of(folder_.path() / "its resources");
    unpacked_.version = version;
    unpacked_.library = TREADMARK_FMU_LIBRARY;
    unpacked_.resources = folder_.path() / "its resources";
    unpacked_.description = fmi::model_description(*fmi::open_model(unpacked_.resources), about_,
                                                   version == 2 ? fmi::Version::fmi2 : fmi::Version::fmi3);
  }

  TemporaryFolder folder_;
  fmi::Description about_;
  UnpackedFmu unpacked_;
};

}  // namespace treadmark::testing
