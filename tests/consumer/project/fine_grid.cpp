// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "fine_grid.hpp"

#include <memory>

#include "treadmark/detection/detector.hpp"

namespace {

using namespace treadmark;

class FineGrid final : public detection::Detector {
 public:
  FineGrid(const detection::BodyPair& bodies, detection::SearchSettings settings) {
    Grid2& grid = settings.grid_T;
    grid.nx = 2 * grid.nx - 1, grid.ny = 2 * grid.ny - 1, grid.dx *= 0.5, grid.dy *= 0.5;
    search_ = detection::detector_of("full_grid").make(bodies, settings);
  }
  double least_gap() override { return search_->least_gap(); }
  detection::SearchResult at(double wheel_dz) override { return search_->at(wheel_dz); }

 private:
  std::unique_ptr<detection::Detector> search_;
};

std::unique_ptr<detection::Detector> fine_grid(const detection::BodyPair& bodies,
                                               const detection::SearchSettings& settings) {
  return std::make_unique<FineGrid>(bodies, settings);
}

}  // namespace

void register_fine_grid() {
  detection::register_detector({"fine-grid", "every point of a grid twice as fine", fine_grid});
}
