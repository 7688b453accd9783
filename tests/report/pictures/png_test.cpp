// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/report/pictures/raster.hpp"

#include <gtest/gtest.h>

#include "treadmark/core/error.hpp"
#include "treadmark/tests/report/pictures/png_reader.hpp"

namespace treadmark {
namespace {

TEST(Png, PixelsComeBack) {
  pictures::PaletteImage image;
  image.width = 37;
  image.height = 11;
  for (int i = 0; i < 200; ++i)
    image.palette.push_back({static_cast<std::uint8_t>(i), static_cast<std::uint8_t>(255 - i),
                             static_cast<std::uint8_t>(7 * i), static_cast<std::uint8_t>(i % 3 == 0 ? 0 : 255)});
  for (std::size_t i = 0; i < image.width * image.height; ++i)
    image.index.push_back(static_cast<std::uint8_t>(i * i % 200));
  const auto bytes = pictures::to_png(image);
  const testing::PngImage read = testing::read_png(bytes);
  ASSERT_EQ(read.width, image.width);
  ASSERT_EQ(read.height, image.height);
  for (std::size_t i = 0; i < read.pixels.size(); ++i)
    for (std::size_t k = 0; k < 4; ++k) ASSERT_EQ(read.pixels[i][k], image.palette[image.index[i]][k]) << i;
  EXPECT_EQ(bytes, pictures::to_png(image));
}

TEST(Png, OnePixel) {
  const testing::PngImage read = testing::read_png(pictures::to_png({1, 1, {{1, 2, 3, 255}}, {0}}));
  EXPECT_EQ(read.pixels, (std::vector<std::array<int, 4>>{{1, 2, 3, 255}}));
}

TEST(Png, RefusesWhatDoesNotFit) {
  EXPECT_THROW(pictures::to_png({}), Error);
  EXPECT_THROW(pictures::to_png({2, 1, {{1, 2, 3, 255}}, {0}}), Error);
  EXPECT_THROW(pictures::to_png({1, 1, {{1, 2, 3, 255}}, {1}}), Error);
  EXPECT_THROW(pictures::to_png({1, 1, {}, {0}}), Error);
  EXPECT_THROW(pictures::to_png({1, 1, std::vector<std::array<std::uint8_t, 4>>(257), {0}}), Error);
}

}  // namespace
}  // namespace treadmark
