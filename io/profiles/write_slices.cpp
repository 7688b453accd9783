// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/io/profiles/write_slices.hpp"

#include <cstddef>
#include <iterator>
#include <string>
#include <system_error>
#include <vector>

#include <fmt/format.h>

#include "treadmark/core/constants.hpp"
#include "treadmark/core/error.hpp"
#include "treadmark/core/output_file.hpp"
#include "treadmark/core/parallel.hpp"
#include "treadmark/io/files/extension.hpp"
#include "treadmark/io/files/sha256.hpp"
#include "treadmark/io/files/text.hpp"
#include "treadmark/io/profiles/slice_sum.hpp"
#include "treadmark/model/shape/body_name.hpp"

namespace treadmark::io {
namespace {

constexpr std::size_t kFewestWritten = 4;
constexpr double kLeastStep = 1e-6;
constexpr std::size_t kDigitsOfFolder = 12;  // of the sum of the slices, in the name of their folder

std::string slice_name(std::size_t i) { return fmt::format("slice_{:05}.txt", i + 1); }

void check(const std::filesystem::path& file, const SliceSet& slices) {
  const std::string extension = extension_of(file);
  const char* expected = slices.body == Body::rail ? ".slcs" : ".slcw";
  if (extension != expected)
    throw Error(ErrorKind::configuration,
                fmt::format("slices of a {} are written to a file *{}", body_name(slices.body), expected),
                {file.string()});
  if (is_stream(file))
    throw Error(ErrorKind::configuration, "slices are written to a regular file and a folder beside it",
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

std::uintmax_t write_slices(const std::filesystem::path& file, const SliceSet& slices,
                            std::span<const std::string> comments, std::span<const std::string> covered) {
  check(file, slices);
  const bool rail = slices.body == Body::rail;
  OutputFolder folder(file.parent_path() / (file.filename().string() + "-slices"), OutputFolder::Old::replaced);
  struct Written {
    std::string sum;
    std::uintmax_t bytes = 0;
  };
  std::vector<Written> written(slices.u.size());
  parallel_for(written.size(), [&](std::size_t i) {
    const Profile& profile = slices.profiles[i];
    std::string text;
    for (std::size_t k = 0; k < profile.y.size(); ++k)
      fmt::format_to(std::back_inserter(text), "{:.10f} {:.10f}\n", kMilli * profile.y[k], kMilli * profile.z[k]);
    write_file(folder.path() / slice_name(i), text);
    written[i] = {sha256_hex(text), text.size()};
  });
  std::string sums;
  std::uintmax_t bytes = 0;
  for (const Written& one : written) {
    sums += one.sum + '\n';
    bytes += one.bytes;
  }
  const std::string sum = sha256_hex(sums);
  const std::string name = fmt::format("{}-{}", file.filename().string(), sum.substr(0, kDigitsOfFolder));

  std::string list;
  for (const std::string& comment : covered) list += fmt::format("% {}\n", comment);
  list += fmt::format(
      "\n     0.0   {}   {}_OFFSET [{}], {}_SCALE\n     {}   NSLC\n       0    0    0   NFEAT, NKINK, NACCEL\n"
      "       {}   {}_INTPOL (1=intpol, 2=approx)\n\n",
      rail ? "1.0" : "0.001", rail ? "S" : "TH", rail ? "mm" : "mrad", rail ? "S" : "TH", slices.u.size(),
      slices.approximate_u ? 2 : 1, rail ? "S" : "TH");
  for (std::size_t i = 0; i < slices.u.size(); ++i)
    fmt::format_to(std::back_inserter(list), "   {:.9f}   '{}/{}'\n", kMilli * slices.u[i], name, slice_name(i));
  std::string index = fmt::format("% {}\n", slices.name);
  for (const std::string& comment : comments) index += fmt::format("% {}\n", comment);
  index += fmt::format("{}{}\n{}", kSumOfSlices, sha256_hex(sums + list), list);

  // Until the file names the new slices the old ones stay.
  const FolderLock lock(file.parent_path());
  folder.replace(file.parent_path() / name);
  write_file(file, index);
  remove_other_slices(file);
  return bytes + index.size();
}

void remove_other_slices(const std::filesystem::path& file) noexcept {
  namespace fs = std::filesystem;
  try {
    const std::string start = file.filename().string() + '-', index = profiles::read_text(file, "slices", {});
    std::error_code ignored;
    std::vector<fs::path> old;
    fs::directory_iterator entry(file.has_parent_path() ? file.parent_path() : fs::path("."), ignored);
    for (const fs::directory_iterator end; !ignored && entry != end; entry.increment(ignored)) {
      const std::string name = entry->path().filename().string();
      if (name.starts_with(start) && name.size() == start.size() + kDigitsOfFolder &&
          name.find_first_not_of("0123456789abcdef", start.size()) == std::string::npos &&
          index.find('\'' + name + '/') == std::string::npos)
        old.push_back(entry->path());
    }
    for (const fs::path& folder : old) remove_quietly(folder);
  } catch (...) {  // what is left over disturbs nobody
  }
}

}  // namespace treadmark::io
