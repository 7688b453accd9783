// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include <algorithm>

#include <fmt/format.h>

#include "treadmark/io/simulations/simulation_keys.hpp"
#include "treadmark/io/simulations/study_parts.hpp"

namespace treadmark::io {

namespace {

std::vector<FigureMark> read_marks(const TableReader& figure) {
  std::vector<FigureMark> marks;
  for (const CaseValue* one : figure.tables("mark")) {
    const TableReader table(one->table(), one->where, figure.path_of("mark"), mark_keys());
    marks.push_back({table.number("x"), table.number("y"), table.text_or("label", {})});
  }
  return marks;
}

std::optional<std::array<double, 2>> read_range(const TableReader& figure) {
  if (figure.find("x_range") == nullptr) return std::nullopt;
  const std::vector<double> range = figure.numbers("x_range");
  if (range.size() != 2 || !(range[0] < range[1]))
    throw Error(ErrorKind::configuration, fmt::format("{} must be two increasing numbers", figure.path_of("x_range")),
                figure.need("x_range").where);
  return std::array<double, 2>{range[0], range[1]};
}

/// Which variation makes the lines, by its key or its label.
void read_series(const TableReader& figure, const std::vector<Variation>& variations, StudyFigure& out) {
  out.series = figure.text_or("series", {});
  out.labels = figure.words("labels");
  if (out.series.empty()) return;
  std::vector<std::string> known;
  const Variation* lines = nullptr;
  for (const Variation& variation : variations)
    for (const std::string& name : {variation.key, variation.label}) {
      if (name.empty()) continue;
      known.push_back(name);
      if (name == out.series) lines = &variation;
    }
  check_name(fmt::format("{}: the variation", figure.path_of("series")), out.series, known,
             figure.need("series").where);
  if (!out.labels.empty() && out.labels.size() != lines->values.size())
    throw Error(ErrorKind::configuration,
                fmt::format("{} has {} texts for {} values of {}", figure.path_of("labels"), out.labels.size(),
                            lines->values.size(), out.series),
                figure.need("labels").where);
}

/// Which value of a variation a text means: its label, or its number.
std::size_t value_of(const Variation& variation, const std::string& text, const SourcePosition& where) {
  const auto named = std::find_if(variation.values.begin(), variation.values.end(), [&](const VariedValue& value) {
    return value.label == text || (value.number && fmt::format("{:.15g}", *value.number) == text);
  });
  if (named == variation.values.end())
    throw Error(ErrorKind::configuration, fmt::format("{} has no value '{}'", variation.label, text), where,
                "the values are those of study.vary, as they stand there");
  return static_cast<std::size_t>(named - variation.values.begin());
}

/// "key=value" texts: of each variation named only these values are drawn.
void read_only(const TableReader& figure, const std::vector<Variation>& variations, StudyFigure& out) {
  out.only.assign(variations.size(), {});
  const std::vector<std::string> texts = figure.words("only");
  std::vector<std::string> known;
  for (const Variation& variation : variations)
    for (const std::string& name : {variation.key, variation.label})
      if (!name.empty()) known.push_back(name);
  for (std::size_t i = 0; i < texts.size(); ++i) {
    const SourcePosition& where = figure.need("only").list()[i].where;
    const auto sign = texts[i].find('=');
    if (sign == std::string::npos)
      throw Error(ErrorKind::configuration,
                  fmt::format("{}: '{}' is not \"key=value\"", figure.path_of("only"), texts[i]), where);
    const std::string name = texts[i].substr(0, sign);
    check_name(fmt::format("{}: the variation", figure.path_of("only")), name, known, where);
    const auto variation = std::find_if(variations.begin(), variations.end(),
                                        [&](const Variation& v) { return v.key == name || v.label == name; });
    out.only[static_cast<std::size_t>(variation - variations.begin())].push_back(
        value_of(*variation, texts[i].substr(sign + 1), where));
  }
}

StudyFigure read_figure(const TableReader& table, const std::vector<Variation>& variations) {
  using Kind = StudyFigure::Kind;
  StudyFigure figure;
  figure.file = table.text("file");
  if (figure.file.extension() != ".svg")
    throw Error(ErrorKind::configuration,
                fmt::format("{} = '{}' must end with .svg", table.path_of("file"), figure.file.string()),
                table.need("file").where);
  const std::string kind = table.text("kind");
  figure.kind = kind == "history" ? Kind::history : kind == "summary" ? Kind::summary : Kind::patches;
  if (figure.kind != Kind::patches) {
    table.need("x", "the column along the axis");
    table.need("y", "a list of columns");
  }
  figure.x = table.text_or("x", {});
  figure.y = table.words("y");
  if (figure.kind != Kind::patches && figure.y.empty())
    throw Error(ErrorKind::configuration, fmt::format("{} is empty", table.path_of("y")), table.need("y").where);
  figure.title = table.text_or("title", {});
  figure.x_label = table.text_or("x_label", {});
  figure.y_label = table.text_or("y_label", {});
  figure.x_range = read_range(table);
  read_series(table, variations, figure);
  read_only(table, variations, figure);
  figure.marks = read_marks(table);
  return figure;
}

}  // namespace

std::vector<StudyFigure> read_figures(const TableReader& study, const std::vector<Variation>& variations) {
  std::vector<StudyFigure> figures;
  for (const CaseValue* one : study.tables("figures")) {
    const TableReader table(one->table(), one->where, study.path_of("figures"), figure_keys());
    figures.push_back(read_figure(table, variations));
    const auto same = [&](const StudyFigure& figure) { return figure.file == figures.back().file; };
    if (std::count_if(figures.begin(), figures.end(), same) > 1)
      throw Error(ErrorKind::configuration,
                  fmt::format("two figures would be written to {}", figures.back().file.string()),
                  table.need("file").where);
  }
  return figures;
}

}  // namespace treadmark::io
