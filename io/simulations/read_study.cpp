// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors

#include "treadmark/io/simulations/read_study.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "treadmark/core/missing_file.hpp"
#include "treadmark/io/cases/file_kind.hpp"
#include "treadmark/io/cases/read_case.hpp"
#include "treadmark/io/cases/read_toml.hpp"
#include "treadmark/io/files/sha256.hpp"
#include "treadmark/io/simulations/change_value.hpp"
#include "treadmark/io/simulations/read_simulation.hpp"
#include "treadmark/io/simulations/simulation_keys.hpp"

namespace treadmark::io {

namespace {

using Base = std::variant<SimulationFile, CaseFile>;

/// The file that all runs start from, parsed once.
struct BaseTables {
  std::filesystem::path path;
  CaseTable tables;
  std::string sha256;
  bool simulation = false;

  Base read(std::span<const std::string> overrides) const {
    if (simulation) {
      SimulationFile file = simulation_of(tables, path, overrides);
      file.sha256 = sha256;
      return file;
    }
    CaseFile file = case_file_of(tables, path, overrides);
    file.sha256 = sha256;
    return file;
  }
};

/// The tables of a file without [study] or [evolve].
BaseTables base_of(CaseTable tables, const std::filesystem::path& path, std::string sha256) {
  BaseTables base{path, std::move(tables), std::move(sha256), false};
  std::erase_if(base.tables, [](const CaseEntry& entry) { return entry.key == "study" || entry.key == "evolve"; });
  base.simulation = find_entry(base.tables, "simulation") != nullptr;
  return base;
}

BaseTables read_base(const std::filesystem::path& path) {
  const std::string text = read_text(path);
  return base_of(parse_toml(text, path.string()), path, sha256_hex(text));
}

BaseTables named_base(const TableReader& study, const CaseTable& document, const std::filesystem::path& folder) {
  for (const CaseEntry& entry : document)
    if (entry.key != study.path() && entry.key != "title")
      throw Error(ErrorKind::configuration,
                  fmt::format("{} stands beside {}, which says it all", entry.key, study.path_of("base")),
                  entry.key_where,
                  fmt::format("change keys of the base in [[{}]], or leave {} out", study.path_of("vary"),
                              study.path_of("base")));
  std::string name = study.text("base");
  std::replace(name.begin(), name.end(), '\\', '/');
  const std::filesystem::path path = (folder / name).lexically_normal();
  const SourcePosition& where = study.need("base").where;
  std::error_code code;
  if (!std::filesystem::is_regular_file(path, code))
    throw MissingFile(ErrorKind::configuration,
                      fmt::format("{}: there is no file {}", study.path_of("base"), path.string()), where,
                      advice_on_missing(path, "names count from the folder of the study file"));
  if (path.extension() != ".toml")
    throw Error(ErrorKind::configuration, fmt::format("{} must be a .toml file", study.path_of("base")), where);
  if (is_study_file(path))
    throw Error(ErrorKind::configuration, fmt::format("{} is a study itself", study.path_of("base")), where,
                "name a simulation or case file");
  return read_base(path);
}

/// Overrides of the study, below this table, change its tables, the others are returned.
std::vector<std::string> apply_to_study(CaseTable& document, std::string_view table,
                                        std::span<const std::string> overrides) {
  std::vector<std::string> others;
  for (const std::string& one : overrides) {
    const CaseOverride change = parse_override(one);
    if (change.path == "title" || change.path.starts_with(fmt::format("{}.", table)))
      change_value(document, change.path, change);
    else
      others.push_back(one);
  }
  return others;
}

void check_not_varied(const std::vector<Variation>& variations, const std::vector<std::string>& common) {
  for (const std::string& one : common) {
    const CaseOverride change = parse_override(one);
    for (const Variation& variation : variations)
      for (const VariedValue& value : variation.values)
        for (const std::string& varied : value.overrides)
          if (parse_override(varied).path == change.path)
            throw Error(ErrorKind::configuration, fmt::format("the study varies {} itself", change.path),
                        change.value.where);
  }
}

std::string described(const StudyFile& study, const StudyRun& run) {
  std::string text;
  for (std::size_t v = 0; v < study.variations.size(); ++v) {
    const Variation& variation = study.variations[v];
    const std::string& name = variation.label.empty() ? variation.key : variation.label;
    text += fmt::format("{}{}{}{}", text.empty() ? "" : ", ", name, name.empty() ? "" : " = ",
                        variation.values[run.values[v]].label);
  }
  return text;
}

/// The place in the study file of an override that is to blame.
SourcePosition place_of(const SourcePosition& where, const StudyFile& study, const StudyRun& run) {
  for (std::size_t v = 0; v < study.variations.size(); ++v) {
    const VariedValue& value = study.variations[v].values[run.values[v]];
    for (const std::string& one : value.overrides)
      if (parse_override(one).value.where.file == where.file) return value.where;
  }
  return where;
}

/// Reads the base as every run will; what is wrong is told at the place of the error, with the run.
void check_runs(const StudyFile& study, const BaseTables& base, const RunRange& checked) {
  for (const StudyRun& run : study.runs) {
    if (!checked.has(run)) continue;
    try {
      base.read(run.overrides);
    } catch (const Error& e) {
      if (study.variations.empty()) throw;
      throw Error(e.kind(), fmt::format("run {} ({}): {}", run.number, described(study, run), e.message()),
                  place_of(e.where(), study, run), e.advice());
    }
  }
}

std::string title_of(const CaseTable& document, const TableReader& study, const std::filesystem::path& file) {
  std::string title = study.text_or("title", file.stem().string());
  const CaseEntry* top = find_entry(document, "title");
  if (top == nullptr || study.find("title") != nullptr) return title;
  if (!std::holds_alternative<std::string>(top->value.data))
    throw Error(ErrorKind::configuration, fmt::format("title must be text, found {}", top->value.kind()),
                top->value.where);
  return top->value.text();
}

}  // namespace

StudyTables::StudyTables(const std::filesystem::path& file, std::string_view name,
                         std::span<const std::string> overrides) {
  const std::string text = read_text(file);
  CaseTable parsed = parse_toml(text, file.string());
  document.swap(parsed);
  study.path = file;
  study.sha256 = sha256_hex(text);
  common_ = apply_to_study(document, name, overrides);
  table = find_entry(document, name);
  if (table == nullptr || !table->value.is_table())
    throw Error(ErrorKind::configuration, fmt::format("[{}] is missing", name),
                table == nullptr ? SourcePosition{file.string(), 1, 1} : table->value.where,
                "see docs/simulation-files.md for studies, docs/evolve.md for evolutions");
}

void StudyTables::read_runs(const TableReader& reader, const RunRange& checked) {
  study.title = title_of(document, reader, study.path);
  study.variations = read_variations(reader);
  check_not_varied(study.variations, common_);
  study.runs = runs_of(study.variations, common_);
  const bool named = reader.find("base") != nullptr;
  if (!named && document.size() == 1)
    reader.fail(fmt::format("{} is missing", reader.path_of("base")),
                fmt::format("name a simulation or case file, or give its tables beside [{}]", reader.path()));
  const BaseTables base =
      named ? named_base(reader, document, study.path.parent_path()) : base_of(document, study.path, study.sha256);
  study.base = base.path;
  study.base_is_simulation = base.simulation;
  check_runs(study, base, checked);
}

StudyFile read_study_file(const std::filesystem::path& file, std::span<const std::string> overrides,
                          const RunRange& checked) {
  StudyTables tables(file, "study", overrides);
  const TableReader reader(tables.table->value.table(), tables.table->value.where, "study", study_keys());
  tables.read_runs(reader, checked);
  tables.study.figures = read_figures(reader, tables.study.variations);
  return std::move(tables.study);
}

Base read_study_run(const StudyFile& study, const StudyRun& run) { return read_base(study.base).read(run.overrides); }

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
  if (figure.file != figure.file.filename() || figure.file == "sweep.svg")
    throw Error(ErrorKind::configuration,
                fmt::format("{} = '{}' is no name for a figure", table.path_of("file"), figure.file.string()),
                table.need("file").where, "figures lie in the folder of results: give a name without folders");
  const std::string kind = table.text("kind");
  figure.kind = kind == "history" ? Kind::history : kind == "summary" ? Kind::summary : Kind::patches;
  if (figure.kind != Kind::patches) {
    table.need("x", "the column along the axis");
    table.need("y", "a list of columns");
  }
  figure.x = table.text_or("x", {});
  if (const CaseValue* x = table.find("x")) figure.x_where = x->where;
  figure.y = table.words("y");
  for (std::size_t i = 0; i < figure.y.size(); ++i) figure.y_where.push_back(table.need("y").list()[i].where);
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
