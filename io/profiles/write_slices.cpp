// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/io/profiles/write_slices.hpp"

#include <cstddef>
#include <iterator>
#include <string>

#include <fmt/format.h>

#include "treadmark/core/constants.hpp"
#include "treadmark/core/error.hpp"
#include "treadmark/io/files/atomic_file.hpp"
#include "treadmark/io/files/line_scanner.hpp"

namespace treadmark::io {
namespace {

constexpr std::size_t kFewestWritten = 4;
constexpr double kLeastStep = 1e-6;

void check(const std::filesystem::path& file, const SliceSet& slices) {
  const std::string extension = profiles::lower(file.extension().string());
  const char* expected = slices.body == Body::rail ? ".slcs" : ".slcw";
  if (extension != expected)
    throw Error(
        ErrorKind::configuration,
        fmt::format("slices of a {} are written to a file *{}", slices.body == Body::rail ? "rail" : "wheel", expected),
        {file.string()});
  if (slices.u.size() < kFewestWritten)
    throw Error(ErrorKind::configuration, "a slices file needs at least four slices", {file.string()},
                "use a finer resolution or a longer range");
  if (!slices.features.empty())
    throw Error(ErrorKind::configuration, "slices with features cannot be written", {file.string()});
  for (std::size_t i = 1; i < slices.u.size(); ++i)
    if (!(slices.u[i] - slices.u[i - 1] > kLeastStep))
      throw Error(ErrorKind::configuration, "slices this near to each other cannot be written", {file.string()},
                  "use a coarser resolution");
}

}  // namespace

void write_slices(const std::filesystem::path& file, const SliceSet& slices, std::span<const std::string> comments) {
  check(file, slices);
  const std::filesystem::path folder = file.parent_path() / file.stem();
  const bool rail = slices.body == Body::rail;
  std::string index = fmt::format("% {}\n", slices.name);
  for (const std::string& comment : comments) index += fmt::format("% {}\n", comment);
  fmt::format_to(std::back_inserter(index),
                 "\n     0.0   {}   {}_OFFSET [{}], {}_SCALE\n     {}   NSLC\n       0    0    0   NFEAT, NKINK, "
                 "NACCEL\n       {}   {}_INTPOL (1=intpol, 2=approx)\n\n",
                 rail ? "1.0" : "0.001", rail ? "S" : "TH", rail ? "mm" : "mrad", rail ? "S" : "TH", slices.u.size(),
                 slices.approximate_u ? 2 : 1, rail ? "S" : "TH");
  std::string text;
  for (std::size_t i = 0; i < slices.u.size(); ++i) {
    const std::string name = fmt::format("slice_{:05}.txt", i + 1);
    const Profile& profile = slices.profiles[i];
    text.clear();
    for (std::size_t k = 0; k < profile.y.size(); ++k)
      fmt::format_to(std::back_inserter(text), "{:.10f} {:.10f}\n", kMilli * profile.y[k], kMilli * profile.z[k]);
    write_text_file(folder / name, text);
    fmt::format_to(std::back_inserter(index), "   {:.9f}   '{}/{}'\n", kMilli * slices.u[i], file.stem().string(),
                   name);
  }
  write_text_file(file, index);
}

}  // namespace treadmark::io
