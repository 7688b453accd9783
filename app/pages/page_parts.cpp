// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors

#include "treadmark/app/pages/page_parts.hpp"

#include <fmt/format.h>

#include <cmath>
#include <filesystem>
#include <iterator>

#include "treadmark/core/constants.hpp"
#include "treadmark/core/to_whole.hpp"
#include "treadmark/io/files/text.hpp"

namespace treadmark::app::pages {

using namespace report;

Facts origin_facts(const Origin& origin) {
  Facts facts;
  facts.entries.emplace_back("Version",
                             origin.git.empty() ? origin.version : fmt::format("{} ({})", origin.version, origin.git));
  facts.entries.emplace_back("Input", origin.input_file);
  facts.entries.emplace_back("SHA-256 of the input", origin.input_sha256);
  for (const auto& [file, sha256] : origin.geometry_sha256) facts.entries.emplace_back(file, sha256);
  std::string settings;
  for (const std::string& setting : origin.settings) settings += (settings.empty() ? "" : ", ") + setting;
  facts.entries.emplace_back("Settings", settings.empty() ? "as in the input" : settings);
  return facts;
}

void add_origin(Page& page, const Origin& origin) { add_origin(page, origin, origin_facts(origin)); }

void add_origin(Page& page, const Origin& origin, Facts facts) {
  if (!origin.inputs.empty())
    page.sections.insert(page.sections.begin() + 1, {"inputs", "Inputs", {Facts{origin.inputs}}});
  page.sections.push_back({"origin", "Origin", {std::move(facts)}});
}

double in_file(double value) { return std::isfinite(value) ? io::rounded(value) : kNaN; }

std::string title_of(const std::string& title, const std::string& input_file) {
  if (!title.empty()) return title;
  const std::string stem = std::filesystem::path(input_file).stem().string();
  return stem.empty() ? "result" : stem;
}

std::string counted(std::size_t count, const std::string& word) {
  return fmt::format("{} {}{}", count, word, count == 1 ? "" : "s");
}

std::string duration_text(double seconds) {
  if (!std::isfinite(seconds) || seconds < 0.0) return "–";
  if (seconds < 60.0) return fmt::format("{:.3g} s", seconds);
  const long whole = to_whole<long>(std::round(seconds));
  if (whole < 3600) return fmt::format("{} min {} s", whole / 60, whole % 60);
  return fmt::format("{} h {} min", whole / 3600, whole % 3600 / 60);
}

std::pair<double, std::string> force_unit(const std::vector<double>& newtons) {
  constexpr double kFewest = 2e3;  // [N]
  for (const double force : newtons)
    if (std::fabs(force) > kFewest) return {1e-3, "kN"};
  return {1.0, "N"};
}

bool OptionalFiles::has(const std::string& file, const std::string& what) {
  std::error_code code;
  if (std::filesystem::is_regular_file(path(file), code)) return true;
  missing_.push_back(fmt::format("{} ({})", file, what));
  return false;
}

std::vector<Block> OptionalFiles::picture(const std::string& file, const std::string& id, const std::string& title,
                                          const std::string& note) {
  if (!has(file, "a picture")) return {};
  return {Figure{id, title, PictureView{io::profiles::read_text(path(file), "picture", {})}, note}};
}

std::string OptionalFiles::text(const std::string& file, const std::string& what) {
  return has(file, what) ? io::profiles::read_text(path(file), "text", {}) : std::string();
}

std::vector<Block> OptionalFiles::note() const {
  if (missing_.empty()) return {};
  std::string files;
  for (const std::string& file : missing_) files += (files.empty() ? "" : ", ") + file;
  return {Banner{Banner::Kind::note,
                 "Files that are not in the folder:", fmt::format("{}. The page shows what is left.", files)}};
}

void append(std::vector<Block>& to, std::vector<Block> blocks) {
  to.insert(to.end(), std::make_move_iterator(blocks.begin()), std::make_move_iterator(blocks.end()));
}

}  // namespace treadmark::app::pages
