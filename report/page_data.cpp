// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/report/page_data.hpp"

#include <cmath>

#include "treadmark/core/constants.hpp"
#include "treadmark/core/platform/ranges.hpp"
#include "treadmark/core/version.hpp"
#include "treadmark/io/files/text.hpp"
#include "treadmark/io/results/quantities.hpp"
#include "treadmark/io/results/summary.hpp"
#include "treadmark/io/tables/number.hpp"
#include "treadmark/report/blob_store.hpp"
#include "treadmark/report/field_catalogue.hpp"
#include "treadmark/report/frame_packer.hpp"
#include "treadmark/report/html_text.hpp"

namespace treadmark::report {
namespace {

using io::Json;
using io::number;

Json to_json(const Packed& packed) {
  Json out = {{"blob", packed.blob}, {"offset", packed.offset}, {"count", packed.count}};
  out["type"] = packed.precision == Precision::byte ? "u8" : packed.precision == Precision::two_bytes ? "u16" : "f32";
  if (packed.precision == Precision::single) return out;
  out["low"] = packed.low;
  out["step"] = packed.step;
  if (packed.none) out["none"] = true;
  return out;
}

/// Least range of an axis as a share of its values: solvers reach forces within a tolerance, which is no trend.
double least_span(const std::string& unit) {
  constexpr double kOfForces = 0.01;
  return unit == "N" || unit == "kN" || unit == "MPa" ? kOfForces : 0.0;
}

const char* to_text(FieldInfo::Kind kind) {
  return kind == FieldInfo::Kind::state ? "state" : kind == FieldInfo::Kind::diverging ? "diverging" : "sequential";
}

Json millimetres(const Vec3& p) { return {number(kMilli * p.x()), number(kMilli * p.y()), number(kMilli * p.z())}; }

Json by_rows(const Mat3& r) {
  Json out = Json::array();
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) out.push_back(number(r(i, j)));
  return out;
}

/// Turns a page into JSON; arrays of many numbers go into blobs.
class Writer {
 public:
  Writer(const Page& page, std::size_t field_budget) : page_(page), field_budget_(field_budget) {}

  std::string text() {
    const PackedSets packed = pack_frames(page_.sets, blobs_, field_budget_);
    Json data = {{"format", "treadmark report 1"}, {"kind", page_.kind}, {"title", page_.title}};
    data["timeline"] = page_.timeline ? timeline(*page_.timeline) : Json();
    data["fields"] = fields(packed);
    Json& sets = data["sets"] = Json::array();
    for (std::size_t i = 0; i < page_.sets.size(); ++i) sets.push_back(frame_set(page_.sets[i], packed[i]));
    Json& surfaces = data["surfaces"] = Json::array();
    for (const auto& surface : page_.surfaces) surfaces.push_back(sampled(surface));
    Json& views = data["views"] = Json::array();
    for (const Section& section : page_.sections)
      for (const Block& block : section.blocks)
        if (const auto* figure = std::get_if<Figure>(&block)) views.push_back(view(*figure));
    Json& blobs = data["blobs"] = Json::array();
    for (const std::string& blob : blobs_.finish()) blobs.push_back(blob);
    constexpr std::size_t kMostDocument = 1'000'000;  // no view reads it; thousands of cases have it beside the page
    const bool kept = !page_.document.empty() && page_.document.size() <= kMostDocument;
    data["document"] = kept ? Json::parse(page_.document, nullptr, false) : Json();
    if (data["document"].is_discarded()) data["document"] = Json();
    if (page_.solving) data["live"] = live(*page_.solving);
    return without_markup(data.dump(-1, ' ', true, Json::error_handler_t::replace));
  }

 private:
  /// No "<" can end the script element.
  static std::string without_markup(const std::string& json) {
    std::string out;
    out.reserve(json.size());
    for (const char c : json) {
      if (c == '<')
        out += "\\u003c";
      else
        out += c;
    }
    return out;
  }

  /// Short arrays as they are, long ones packed.
  Json numbers(const std::vector<double>& values) {
    constexpr std::size_t kShort = 128;
    if (values.size() > kShort) {
      blobs_.begin_blob();
      return to_json(blobs_.add(values, Precision::single));
    }
    Json out = Json::array();
    for (const double value : values) out.push_back(number(value));
    return out;
  }

  Json axis(const Axis& axis) {
    Json out = {{"label", axis.label},
                {"unit", axis.unit},
                {"scale", axis.logarithmic ? "log" : "linear"},
                {"values", numbers(axis.values)}};
    if (!axis.labels.empty()) out["labels"] = axis.labels;
    return out;
  }

  Json timeline(const Timeline& timeline) {
    Json out = {{"label", timeline.label}, {"names", nullptr}, {"count", timeline.count()}, {"frames", nullptr}};
    if (timeline.start > 0) out["start"] = timeline.start;
    if (!timeline.names.empty()) out["names"] = timeline.names;
    if (!timeline.frames.empty()) {
      std::vector<double> frames;
      for (const int frame : timeline.frames) frames.push_back(frame < 0 ? NAN : frame);
      out["frames"] = numbers(frames);
    }
    Json& axes = out["axes"] = Json::array();
    for (const Axis& one : timeline.axes) axes.push_back(axis(one));
    return out;
  }

  /// Those that some patch has.
  static Json fields(const PackedSets& packed) {
    Json out = Json::array();
    for (const FieldInfo& field : field_catalogue()) {
      const bool used = ranges::any_of(packed, [&](const auto& set) {
        return ranges::any_of(set, [&](const PackedFrame& frame) {
          return ranges::any_of(frame.patches, [&](const PackedPatch& patch) {
            return ranges::any_of(patch.values, [&](const auto& value) { return value.first == field.name; });
          });
        });
      });
      if (!used) continue;
      out.push_back(
          {{"name", field.name}, {"label", field.label}, {"unit", field.unit}, {"kind", to_text(field.kind)}});
      if (field.outside != FieldInfo::Outside::nothing)
        out.back()["outside"] = field.outside == FieldInfo::Outside::zero ? "zero" : "value";
    }
    return out;
  }

  /// Numbers of patches that stand beside the views, in their order.
  static std::vector<const io::Quantity<io::PatchResult>*> shown_numbers() {
    using io::Block;
    std::vector<const io::Quantity<io::PatchResult>*> rows;
    for (const Block block :
         {Block::force, Block::pressure, Block::approach, Block::count, Block::creepage, Block::place, Block::angle,
          Block::shape, Block::refined, Block::energy, Block::relative, Block::heat})
      for (const auto& row : io::quantities<io::PatchResult>())
        if (row.block == block && !row.label.page.empty()) rows.push_back(&row);
    return rows;
  }

  /// In a shift, what has another unit there is left out: the names end in units.
  static Json patch_numbers(const io::PatchResult& p) {
    Json out = Json::object();
    for (const auto* row : shown_numbers()) {
      if (!io::has_block(p, row->block) || !row->has(p) || (p.shift && !row->in_shift.si.empty())) continue;
      const double value = row->access.get(p);
      out[std::string(row->label.page)] =
          row->access.whole ? Json(static_cast<int>(value)) : number(row->unit.in_file(value));
    }
    return out;
  }

  static Json patch(const io::PatchResult& p, const PackedPatch& packed, std::size_t index) {
    const Grid2& grid = p.fields.grid;
    const GridPart& part = packed.part;
    Json out = {{"name", p.id > 0 ? "patch " + std::to_string(p.id) : "patch " + std::to_string(index + 1)},
                {"nx", part.nx},
                {"ny", part.ny},
                {"x0_mm", part.nx > 0 ? number(kMilli * grid.x(part.ix0)) : Json(0.0)},
                {"s0_mm", part.ny > 0 ? number(kMilli * grid.y(part.iy0)) : Json(0.0)},
                {"dx_mm", number(kMilli * grid.dx)},
                {"ds_mm", number(kMilli * grid.dy)},
                {"origin_mm", millimetres(p.fields.X_TC.origin)},
                {"rotation", by_rows(p.fields.X_TC.rotation)},
                {"reference_mm", {number(kMilli * p.reference_x), number(kMilli * p.reference_s)}}};
    Json& values = out["values"] = Json::object();
    for (const auto& [name, value] : packed.values) values[name] = to_json(value);
    out["numbers"] = patch_numbers(p);
    return out;
  }

  /// How treadmark.h names what the views show.
  static Json live(const Solving& solving) {
    Json out = {{"version", version() + " (" + git_revision() + ")"},
                {"toml", solving.toml},
                {"profiles", {{"wheel", solving.wheels}, {"rail", solving.rails}}},
                {"backends", solving.backends}};
    Json& files = out["files"] = Json::object();
    for (const auto& [name, bytes] : solving.files) files[name] = io::to_base64(std::as_bytes(std::span(bytes)));
    Json& fields = out["fields"] = Json::array();
    for (const FieldInfo& field : field_catalogue()) {
      if (field.column == nullptr) continue;
      Json columns = Json::array({field.column->name});
      if (field.other != nullptr) columns.push_back(field.other->name);
      Json& row = fields.emplace_back(Json{{"name", field.name}, {"columns", columns}, {"factor", field.factor}});
      if (field.column->unit != field.column->unit_shift) row["shift"] = field.of_shifts;
    }
    Json& numbers = out["numbers"] = Json::array();
    for (const auto* row : shown_numbers()) {
      if (row->key.empty()) continue;
      Json& one = numbers.emplace_back(
          Json{{"key", row->label.page}, {"name", io::si_name(*row)}, {"factor", row->unit.in_file(1.0)}});
      if (!row->in_shift.si.empty()) one["shift"] = false;
    }
    return out;
  }

  Json placed(const std::string& name, const Pose& X) const {
    const int surface = io::surface_index(page_.surfaces, name);
    if (surface < 0) return nullptr;
    return {{"surface", surface}, {"origin_mm", millimetres(X.origin)}, {"rotation", by_rows(X.rotation)}};
  }

  Json frame_set(const FrameSet& set, const std::vector<PackedFrame>& packed) {
    Json out = {{"name", set.name}, {"nominal", set.nominal ? Json(*set.nominal) : Json()}};
    Json& frames = out["frames"] = Json::array();
    for (std::size_t i = 0; i < set.frames.size(); ++i) {
      const io::CaseResult& result = *set.frames[i].result;
      Json frame = {{"name", set.frames[i].name}, {"status", to_string(result.status)}, {"message", io::words(result)}};
      Json& patches = frame["patches"] = Json::array();
      for (std::size_t k = 0; k < packed[i].patches.size(); ++k)
        patches.push_back(patch(result.patches[k], packed[i].patches[k], k));
      frame["wheel"] = result.bodies ? placed(result.wheel_surface, result.bodies->X_TA) : Json();
      frame["rail"] = result.bodies ? placed(result.rail_surface, result.bodies->X_TS) : Json();
      if (!packed[i].trimmed.empty())
        frame["trimmed"] = packed[i].trimmed + (" All fields are in " + page_.full_data + ".");
      frames.push_back(std::move(frame));
    }
    return out;
  }

  Json sampled(const io::SampledSurface& surface) {
    blobs_.begin_blob();
    const auto scaled = [&](const std::vector<double>& metres, double factor) {
      std::vector<double> values = metres;
      for (double& value : values) value *= factor;
      return to_json(blobs_.add(values, Precision::two_bytes));
    };
    Json out = {{"body", surface.body}, {"name", surface.name}, {"nu", surface.nu}, {"nv", surface.nv}};
    out["x"] = scaled(surface.x, kMilli);
    out["y"] = scaled(surface.y, kMilli);
    out["z"] = scaled(surface.z, kMilli);
    out["deviation"] = surface.deviation.empty() ? Json() : scaled(surface.deviation, kMilli);
    out["closed"] = surface.closed;
    return out;
  }

  Json series(const Series& series) {
    Json out = {{"name", series.name}, {"y", numbers(series.y)}};
    if (!series.x.empty()) out["x"] = numbers(series.x);
    out["marks"] = series.marks == Series::Marks::line     ? "line"
                   : series.marks == Series::Marks::points ? "points"
                                                           : "both";
    if (series.dashed) out["dashed"] = true;
    if (!series.texts.empty()) out["texts"] = series.texts;
    if (!series.steps.empty()) out["steps"] = numbers(series.steps);
    return out;
  }

  Json view(const Figure& figure) {
    Json out = {{"type", ""}, {"id", html_id(figure.id)}};
    if (const auto* chart = std::get_if<ChartView>(&figure.view)) {
      out["type"] = "chart";
      out["linked"] = chart->linked;
      if (chart->to_scale) out["to_scale"] = true;
      out["x"] = chart->x ? axis(*chart->x) : Json();
      Json& panels = out["panels"] = Json::array();
      for (const Panel& panel : chart->panels) {
        Json one = {{"label", panel.label}, {"unit", panel.unit}, {"scale", panel.logarithmic ? "log" : "linear"}};
        if (const double span = least_span(panel.unit); span > 0.0) one["least_span"] = span;
        Json& list = one["series"] = Json::array();
        for (const Series& s : panel.series) list.push_back(series(s));
        Json& levels = one["levels"] = Json::array();
        for (const Level& level : panel.levels)
          levels.push_back({{"value", number(level.value)}, {"label", level.label}});
        panels.push_back(std::move(one));
      }
      out["by_step"] = chart->by_step.empty() ? Json() : by_step(*chart);
    } else if (const auto* contact = std::get_if<ContactView>(&figure.view)) {
      out["type"] = "contact";
      out["sets"] = contact->sets;
    } else if (const auto* scene = std::get_if<SceneView>(&figure.view)) {
      out["type"] = "scene";
      out["set"] = scene->set;
    } else if (const auto* section = std::get_if<SectionView>(&figure.view)) {
      out["type"] = "section";
      out["set"] = section->set;
      if (!section->over.empty()) out["over"] = section->over;
    } else if (const auto* track = std::get_if<TrackView>(&figure.view)) {
      out["type"] = "track";
      out["set"] = track->set;
    } else if (const auto* map = std::get_if<MapView>(&figure.view)) {
      add_map(out, *map);
    } else if (const auto* cloud = std::get_if<CloudView>(&figure.view)) {
      add_cloud(out, *cloud);
    } else {
      out["type"] = "picture";
    }
    return out;
  }

  Json by_step(const ChartView& chart) {
    Json out = Json::array();
    for (const ChartView::Curves& curves : chart.by_step) {
      Json one = {{"x", numbers(curves.x)}};
      Json& y = one["y"] = Json::array();
      for (const auto& panel : curves.y) {
        Json list = Json::array();
        for (const std::vector<double>& values : panel) list.push_back(numbers(values));
        y.push_back(std::move(list));
      }
      out.push_back(std::move(one));
    }
    return out;
  }

  void add_map(Json& out, const MapView& map) {
    out["type"] = "map";
    out["x"] = {{"label", map.x.label}, {"unit", map.x.unit}};
    out["y"] = {{"label", map.y.label}, {"unit", map.y.unit}};
    out["value"] = {{"label", map.label}, {"unit", map.unit}, {"kind", map.diverging ? "diverging" : "sequential"}};
    out["nx"] = map.nx;
    out["ny"] = map.ny;
    for (const auto& [name, value] : {std::pair{"x0", map.x0}, {"dx", map.dx}, {"y0", map.y0}, {"dy", map.dy}})
      out[name] = number(value);
    blobs_.begin_blob();
    if (map.by_step.empty()) {
      out["values"] = to_json(blobs_.add(map.values, Precision::two_bytes));
    } else {
      Json& steps = out["by_step"] = Json::array();
      for (const std::vector<double>& values : map.by_step)
        steps.push_back(to_json(blobs_.add(values, Precision::two_bytes)));
      out["values"] = steps.back();
    }
    Json& marks = out["marks"] = Json::array();
    for (const MapView::Mark& mark : map.marks) marks.push_back({{"label", mark.label}, {"points", mark.points}});
  }

  void add_cloud(Json& out, const CloudView& cloud) {
    out["type"] = "cloud";
    out["body"] = cloud.wheel ? "wheel" : "rail";
    blobs_.begin_blob();
    const auto packed = [&](const std::vector<double>& values) {
      return to_json(blobs_.add(values, Precision::two_bytes));
    };
    out["x"] = packed(cloud.x);
    out["y"] = packed(cloud.y);
    out["z"] = packed(cloud.z);
    out["tilt"] = packed(cloud.tilt);
    Json& quantities = out["quantities"] = Json::array();
    for (const CloudView::Quantity& quantity : cloud.quantities)
      quantities.push_back({{"label", quantity.label},
                            {"unit", quantity.unit},
                            {"per_mm", number(quantity.per_mm)},
                            {"span", number(quantity.span)},
                            {"values", packed(quantity.values)}});
    out["others"] = cloud.others;
    out["caption"] = cloud.caption;
  }

  const Page& page_;
  std::size_t field_budget_;
  BlobStore blobs_;
};

}  // namespace

std::string page_data(const Page& page, std::size_t field_budget) { return Writer(page, field_budget).text(); }

}  // namespace treadmark::report
