// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/app/pages/plain_page.hpp"

#include <fmt/format.h>

#include "treadmark/core/error.hpp"
#include "treadmark/core/platform/ranges.hpp"
#include "treadmark/io/files/text.hpp"
#include "treadmark/io/settings/key_words.hpp"
#include "treadmark/io/tables/number.hpp"

namespace treadmark::app::pages {

using namespace report;

namespace {

namespace fs = std::filesystem;

/// Numbers and texts below a value, named by their keys; no lists.
void add_leaves(Facts& facts, const io::Json& value, const std::string& path) {
  if (value.is_object())
    for (const auto& [key, below] : value.items()) add_leaves(facts, below, path.empty() ? key : path + '.' + key);
  const io::KeyWords words = io::words_of_key(path);
  std::string text = value.is_string()    ? value.get<std::string>()
                     : value.is_boolean() ? (value.get<bool>() ? "yes" : "no")
                     : value.is_number()  ? fmt::format("{:.6g}", value.get<double>())
                                          : "";
  if (!text.empty()) facts.entries.emplace_back(words.name, text + (words.unit.empty() ? "" : " ") + words.unit);
}

}  // namespace

Page plain_page(const std::string& kind, const std::string& lead, const std::string& json,
                std::vector<Figure> pictures) {
  const io::Json all = io::Json::parse(json, nullptr, false);
  if (!all.is_object()) throw Error(ErrorKind::input_data, kind + ".json is no JSON", {}, "let the command write anew");
  Page page{kind, kind, lead};
  for (const char* key : {"name", "title"})
    if (const auto at = all.find(key); at != all.end() && at->is_string()) page.title = at->get<std::string>();
  Facts inputs, origin, numbers;
  for (const auto& [key, value] : all.items())
    add_leaves(key == "input" ? inputs : key == "treadmark" ? origin : numbers, value, key == kind ? "" : key);
  page.sections = {{"overview", "Overview", {std::move(numbers)}}};
  if (!inputs.entries.empty()) page.sections.push_back({"inputs", "Inputs", {std::move(inputs)}});
  if (!pictures.empty()) page.sections.push_back({"pictures", "Pictures", {pictures.begin(), pictures.end()}});
  page.sections.push_back({"origin", "Origin", {std::move(origin)}});
  page.document = json;
  return page;
}

Page plain_page(const fs::path& folder, const std::string& json, const std::string& lead) {
  const auto text_of = [](const fs::path& file) { return io::profiles::read_text(file, "results", {}); };
  std::vector<Figure> pictures;
  for (const auto& entry : fs::directory_iterator(folder)) {
    const std::string name = entry.path().stem().string();
    if (entry.path().extension() == ".svg")
      pictures.push_back({"picture-" + name, io::words_of_key(name).name, PictureView{text_of(entry.path())}});
  }
  ranges::sort(pictures, {}, &Figure::id);
  return plain_page(fs::path(json).stem().string(), lead, text_of(folder / json), std::move(pictures));
}

}  // namespace treadmark::app::pages
