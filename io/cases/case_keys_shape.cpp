// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include <algorithm>
#include <cmath>
#include <type_traits>
#include <utility>

#include "treadmark/core/constants.hpp"
#include "treadmark/io/cases/shape_keys.hpp"
#include "treadmark/io/cases/shared_keys.hpp"
#include "treadmark/io/profiles/read_slices.hpp"

namespace treadmark::io {

namespace {

using W = WheelRailCase;

using Solids = std::vector<SolidInput>;

std::vector<ElementKey<SolidInput>> solid_keys() {
  KeyInfo file =
      key_info("file", KeyType::path,
               "closed triangles (.ply .stl .obj .off) or a level set that OpenVDB wrote (.vdb), relative to "
               "the folder of the case file");
  file.required = true;
  KeyInfo use = key_info("use", KeyType::choice,
                         "what is done with it to those before it: join adds it, cut takes it away, common keeps what "
                         "lies in both");
  use.choices = {"join", "cut", "common"};
  use.default_text = "\"join\"";
  KeyInfo scale = key_info("scale_to_mm", KeyType::number, "factor from file units to mm (1000 for a file in m)");
  scale.at_least = 1e-6;
  scale.default_text = "1";
  std::vector<ElementKey<SolidInput>> keys{
      {file,
       [](SolidInput& s, const CaseValue& v) {
         std::string name = v.text();
         std::replace(name.begin(), name.end(), '\\', '/');
         s.file = name;
       },
       {},
       [](const SolidInput& s) { return s.file.empty() ? std::string() : toml_text(s.file.generic_string()); }},
      {use,
       [](SolidInput& s, const CaseValue& v) {
         s.use = v.text() == "cut" ? Solid::Use::cut : v.text() == "common" ? Solid::Use::common : Solid::Use::join;
       },
       {},
       [](const SolidInput& s) {
         return toml_text(s.use == Solid::Use::cut ? "cut" : s.use == Solid::Use::common ? "common" : "join");
       }},
      {scale,
       [](SolidInput& s, const CaseValue& v) { s.scale = v.number(); },
       {},
       [](const SolidInput& s) { return exact_text(s.scale, 1.0); }},
      {key_info("grid", KeyType::text, "name of the level set in its file; without it the only one"),
       [](SolidInput& s, const CaseValue& v) { s.grid = v.text(); },
       {},
       [](const SolidInput& s) { return s.grid.empty() ? s.grid : toml_text(s.grid); }}};
  const char* axes[] = {"x_mm", "y_mm", "z_mm"};
  for (int axis = 0; axis < 3; ++axis)
    keys.push_back(with_default(element_number<SolidInput>(axes[axis], kAnyNumber, "offset of the body",
                                                           [axis](SolidInput& s) -> double& { return s.offset[axis]; }),
                                "0"));
  return keys;
}

/// Keys of wheel.shape or rail.shape.
class ShapeKeys {
 public:
  ShapeKeys(KeyList& list, std::string body, SurfaceSource W::*surface)
      : list_(list), prefix_(body + ".shape."), body_(std::move(body)), surface_(surface) {}

  void add() {
    add_geometry();
    add_file_options();
    if (body_ == "wheel") {
      add_placement();
      add_seam();
    }
    add_offsets();
    KeyInfo backend =
        backend_key(body_ + ".backend",
                    "surface representation: analytic, spline, nurbs, thb, thb-quadratic, mesh, "
                    "mesh-flat, offset, offset-quadratic, offset-bilinear, level-set, chords or prismatic; "
                    "without it the one that fits the shape");
    backend.scope = KeyScope::wheel_rail;
    CaseKey& representation = list_.add(backend);
    representation.set = [surface = surface_](Case& c, const CaseValue& v, const std::filesystem::path&) {
      (content_of<W>(c).*surface).backend = v.text();
    };
    representation.written = [surface = surface_](const Case& c, const std::filesystem::path&) {
      const std::string& name = (std::get<W>(c.content).*surface).backend;
      return name.empty() ? name : toml_text(name);
    };
    list_
        .number<W>(fmt::format("{}.resolution_mm", body_), kPositive,
                   "spacing of the data a re-represented surface is sampled at; without it 1 mm",
                   [surface = surface_](W& c) -> double& { return (c.*surface).resolution; })
        .default_text.clear();
  }

 private:
  KeyInfo info(const std::string& name, KeyType type, std::string doc) const {
    KeyInfo key = key_info(prefix_ + name, type, std::move(doc));
    key.scope = KeyScope::wheel_rail;
    return key;
  }

  void add_geometry() {
    KeyInfo file =
        info("file", KeyType::path,
             "profile, slices, triangles, offsets, CAD or splines (.xml), relative to the folder of the case file");
    file.group = prefix_;
    file.alternative = "file";
    CaseKey& named = list_.add(file);
    named.written = [surface = surface_](const Case& c, const std::filesystem::path& folder) {
      const auto* given = std::get_if<GeometryFile>(&(std::get<W>(c.content).*surface).geometry);
      return given == nullptr ? std::string() : written_path(given->file, folder);
    };
    named.set = [surface = surface_](Case& c, const CaseValue& v, const std::filesystem::path& folder) {
      SurfaceSource& s = content_of<W>(c).*surface;
      if (!std::holds_alternative<GeometryFile>(s.geometry)) s.geometry = GeometryFile{};
      std::string name = v.text();
      std::replace(name.begin(), name.end(), '\\', '/');
      std::get<GeometryFile>(s.geometry).file = (folder / name).lexically_normal();
      s.where = v.where;
    };

    KeyInfo standard = info("standard", KeyType::text, "standard profile by its name: treadmark list profiles");
    standard.group = prefix_;
    standard.alternative = "standard";
    CaseKey& published = list_.add(standard);
    published.written = [surface = surface_](const Case& c, const std::filesystem::path&) {
      const auto* given = std::get_if<StandardProfile>(&(std::get<W>(c.content).*surface).geometry);
      return given == nullptr ? std::string() : toml_text(given->name);
    };
    published.set = [surface = surface_](Case& c, const CaseValue& v, const std::filesystem::path&) {
      SurfaceSource& s = content_of<W>(c).*surface;
      s.geometry = StandardProfile{v.text()};
      s.where = v.where;
    };

    using Segment = ArcChain::Segment;
    KeyInfo arcs = info("arcs", KeyType::table_list, "chain of arcs and straight lines with increasing y");
    arcs.group = prefix_;
    arcs.alternative = "arcs";
    add_list<Segment>(list_, arcs, arc_keys<Segment>(),
                      [surface = surface_](W& c, bool create) -> std::vector<Segment>* {
                        SurfaceSource& s = c.*surface;
                        if (create && !std::holds_alternative<ArcChain>(s.geometry)) s.geometry = ArcChain{};
                        ArcChain* chain = std::get_if<ArcChain>(&s.geometry);
                        return chain == nullptr ? nullptr : &chain->segments;
                      });
    const auto start = [&](const std::string& name, const std::string& doc, double ArcChain::*member) -> KeyInfo& {
      KeyInfo key = info(name, KeyType::number, doc);
      key.default_text = std::string("0");  // a plain literal sets off a false alarm of GCC 12
      CaseKey& added = list_.add(key);
      added.set = [surface = surface_, member, name, unit = unit_of_key(name)](Case& c, const CaseValue& v,
                                                                               const std::filesystem::path&) {
        ArcChain* chain = std::get_if<ArcChain>(&(content_of<W>(c).*surface).geometry);
        if (chain == nullptr)
          throw Error(ErrorKind::configuration, name + " belongs to a shape given by arcs", v.where);
        chain->*member = v.number() * unit;
      };
      added.written = [surface = surface_, member, unit = unit_of_key(name)](const Case& c,
                                                                             const std::filesystem::path&) {
        const auto* chain = std::get_if<ArcChain>(&(std::get<W>(c.content).*surface).geometry);
        return chain == nullptr || chain->*member == 0.0 ? std::string() : exact_text(chain->*member, unit);
      };
      return added.info;
    };
    start("start_y_mm", "y where the chain of arcs starts", &ArcChain::start_y);
    start("start_z_mm", "z where the chain of arcs starts", &ArcChain::start_z);
    for (const std::string unit : {"deg", "rad"}) {
      KeyInfo& angle = start(fmt::format("start_angle_{}", unit),
                             "inclination atan(dz/dy) where the chain of arcs starts", &ArcChain::start_angle);
      angle.group = fmt::format("{}start_angle", prefix_);
      angle.alternative = unit;
    }
    add_solids();
  }

  /// Names of files are relative to the folder of the case file, which only the whole list knows.
  void add_solids() {
    KeyInfo list = info(
        "solids", KeyType::table_list,
        "closed bodies that are joined and cut one after the other, see [level sets](representations.md#level-sets)");
    list.group = prefix_;
    list.alternative = "solids";
    const auto solids_of = [surface = surface_](W& c, bool create) -> Solids* {
      SurfaceSource& s = c.*surface;
      if (create && !std::holds_alternative<SolidsInput>(s.geometry)) s.geometry = SolidsInput{};
      SolidsInput* given = std::get_if<SolidsInput>(&s.geometry);
      return given == nullptr ? nullptr : &given->solids;
    };
    add_list<SolidInput>(list_, list, solid_keys(), solids_of);
    CaseKey& added = list_.keys.back();
    added.set = [set = added.set, solids_of, surface = surface_](Case& c, const CaseValue& v,
                                                                 const std::filesystem::path& folder) {
      set(c, v, folder);
      for (SolidInput& solid : *solids_of(content_of<W>(c), true))
        solid.file = (folder / solid.file).lexically_normal();
      (content_of<W>(c).*surface).where = v.where;
    };
    added.written = [written = added.written, solids_of](const Case& c, const std::filesystem::path& folder) {
      Case relative = c;
      if (Solids* all = solids_of(std::get<W>(relative.content), false))
        for (SolidInput& solid : *all) solid.file = relative_to(solid.file, folder);
      return written(relative, folder);
    };
    added.set_element = [set = added.set_element](Case& c, std::size_t index, const CaseTable& entries,
                                                  const SourcePosition& where) {
      for (const CaseEntry& entry : entries)
        if (entry.key == "file" && std::filesystem::path(entry.value.text()).is_relative())
          throw Error(ErrorKind::configuration, "the file of a solid can only be replaced by one with its full path",
                      where);
      set(c, index, entries, where);
    };
    KeyInfo voxel = info("voxel_mm", KeyType::number,
                         "distance of the nodes at which solids are sampled; without it that of the first level set, "
                         "else 0.5 mm");
    voxel.above = 0.0;
    CaseKey& edge = list_.add(voxel);
    edge.set = [surface = surface_, path = voxel.path](Case& c, const CaseValue& v, const std::filesystem::path&) {
      auto* given = std::get_if<SolidsInput>(&(content_of<W>(c).*surface).geometry);
      if (given == nullptr)
        throw Error(ErrorKind::configuration, path + " belongs to a shape given by solids", v.where);
      given->voxel = v.number() * unit_of_key("voxel_mm");
    };
    edge.written = [surface = surface_](const Case& c, const std::filesystem::path&) {
      const auto* given = std::get_if<SolidsInput>(&(std::get<W>(c.content).*surface).geometry);
      return given == nullptr || given->voxel == 0.0 ? std::string()
                                                     : exact_text(given->voxel, unit_of_key("voxel_mm"));
    };
  }

  /// change: ProfileOptions&, const CaseValue&; written: const ProfileOptions& or const GeometryFile& -> TOML, empty
  /// where the default is meant.
  template <class Change, class Written>
  void option(KeyInfo key, Change change, Written written) {
    const std::string path = key.path;
    CaseKey& added = list_.add(std::move(key));
    added.written = [surface = surface_, written](const Case& c, const std::filesystem::path&) {
      const auto* file = std::get_if<GeometryFile>(&(std::get<W>(c.content).*surface).geometry);
      if (file == nullptr) return std::string();
      if constexpr (std::is_invocable_v<Written, const GeometryFile&>)
        return std::string(written(*file));
      else
        return std::string(written(file->options));
    };
    added.set = [surface = surface_, change, path](Case& c, const CaseValue& v, const std::filesystem::path&) {
      GeometryFile* file = std::get_if<GeometryFile>(&(content_of<W>(c).*surface).geometry);
      if (file == nullptr) throw Error(ErrorKind::configuration, path + " belongs to a shape given by a file", v.where);
      change(file->options, v);
    };
  }

  void add_seam() {
    KeyInfo seam =
        info("open_seam", KeyType::flag,
             "slices all round: constant between the last and the first one, instead of smooth over the seam");
    seam.default_text = "false";
    CaseKey& open = list_.add(seam);
    open.text = [surface = surface_](const Case& c) {
      const auto* file = std::get_if<GeometryFile>(&(std::get<W>(c.content).*surface).geometry);
      return std::string(file != nullptr && file->open_seam ? "true" : "false");
    };
    open.set = [surface = surface_](Case& c, const CaseValue& v, const std::filesystem::path&) {
      GeometryFile* file = std::get_if<GeometryFile>(&(content_of<W>(c).*surface).geometry);
      if (file == nullptr)
        throw Error(ErrorKind::configuration, "wheel.shape.open_seam belongs to a shape given by a file", v.where);
      file->open_seam = v.flag();
    };
  }

  /// Keys of wheel.offsets or rail.offsets.
  void add_offsets() {
    const bool wheel = body_ == "wheel";
    const std::string prefix = body_ + ".offsets.";
    const auto offsets = [surface = surface_](auto& c) -> auto& { return (c.*surface).offsets; };
    const auto key = [&](const char* name, KeyType type, std::string doc) {
      KeyInfo info = key_info(prefix + name, type, std::move(doc));
      info.scope = KeyScope::wheel_rail;
      return info;
    };
    CaseKey& file = list_.add(key(
        "file", KeyType::path,
        wheel ? "table of deviations that are added to the radius: a .csv or .txt matrix (first row y, first column "
                "the place round the wheel) or an .asc grid, relative to the folder of the case file"
              : "table of deviations that are added to z: a .csv or .txt matrix (first row y, first column x) or an "
                ".asc grid, relative to the folder of the case file"));
    file.set = [offsets](Case& c, const CaseValue& v, const std::filesystem::path& folder) {
      OffsetsInput& o = offsets(content_of<W>(c));
      std::string name = v.text();
      std::replace(name.begin(), name.end(), '\\', '/');
      o.file = (folder / name).lexically_normal();
      o.where = v.where;
    };
    file.written = [offsets](const Case& c, const std::filesystem::path& folder) {
      const OffsetsInput& o = offsets(std::get<W>(c.content));
      return o.file.empty() ? std::string() : written_path(o.file, folder);
    };
    const auto unit = [&](const char* name, const char* doc, std::optional<LengthUnit> OffsetsInput::*member) {
      KeyInfo info = key(name, KeyType::choice, doc);
      info.choices.reserve(kLengthUnits.size());
      for (const LengthUnit u : kLengthUnits) info.choices.emplace_back(symbol(u));
      CaseKey& added = list_.add(info);
      added.set = [offsets, member](Case& c, const CaseValue& v, const std::filesystem::path&) {
        offsets(content_of<W>(c)).*member = length_unit(v.text());
      };
      added.written = [offsets, member](const Case& c, const std::filesystem::path&) {
        const auto& given = offsets(std::get<W>(c.content)).*member;
        return given ? toml_text(std::string(symbol(*given))) : std::string();
      };
    };
    unit("unit", "unit of the table's positions; without it what the table says, else mm", &OffsetsInput::unit);
    unit("deviation_unit", "unit of the table's deviations; without it what the table says, else that of the positions",
         &OffsetsInput::deviation_unit);
    if (!wheel) return;
    KeyInfo degrees = key("angles_deg", KeyType::flag,
                          "the table's places round the wheel are degrees; false: lengths at the nominal radius");
    degrees.default_text = "false";
    CaseKey& angles = list_.add(degrees);
    angles.set = [offsets](Case& c, const CaseValue& v, const std::filesystem::path&) {
      offsets(content_of<W>(c)).angles_deg = v.flag();
    };
    angles.text = [offsets](const Case& c) {
      return std::string(offsets(std::get<W>(c.content)).angles_deg ? "true" : "false");
    };
  }

  /// Of a wheel.
  void add_placement() {
    using Placement = ProfileOptions::Placement;
    KeyInfo placement =
        info("placement", KeyType::choice,
             "automatic: y = 0 is put on the tape line, 70 mm from the back of the flange, and z = 0 on "
             "the tread there, where the points show that they count from elsewhere");
    placement.choices = {"automatic", "as_in_file"};
    placement.default_text = "\"automatic\"";
    option(
        placement,
        [](ProfileOptions& o, const CaseValue& v) {
          o.placement = v.text() == "as_in_file" ? Placement::as_in_file : Placement::automatic;
        },
        [](const GeometryFile& f) {
          const bool moved = f.options.placement == Placement::automatic ||
                             (f.options.placement == Placement::reference && is_slices_file(f.file));
          return moved ? "" : "\"as_in_file\"";
        });
  }

  void add_file_options() {
    using Method = SmoothingOptions::Method;
    const ProfileOptions fresh;
    option(
        info("mirror_y", KeyType::flag,
             "negate y of the file; without it a wheel is mirrored whose flange is on the side "
             "of great y"),
        [](ProfileOptions& o, const CaseValue& v) { o.mirror_y = v.flag() ? 1 : -1; },
        [](const ProfileOptions& o) { return o.mirror_y == 0   ? ""
                                             : o.mirror_y == 1 ? "true"
                                                               : "false"; });
    KeyInfo mirror_z = info("mirror_z", KeyType::choice, "negate z of the file; automatic: decide from the data");
    mirror_z.choices = {"automatic", "yes", "no"};
    mirror_z.default_text = "\"automatic\"";
    option(
        mirror_z,
        [](ProfileOptions& o, const CaseValue& v) { o.mirror_z = v.text() == "yes"  ? 1
                                                                 : v.text() == "no" ? -1
                                                                                    : 0; },
        [](const ProfileOptions& o) { return o.mirror_z > 0   ? "\"yes\""
                                             : o.mirror_z < 0 ? "\"no\""
                                                              : ""; });
    KeyInfo scale = info("scale_to_mm", KeyType::number, "factor from file units to mm (1000 for a file in m)");
    scale.at_least = 1e-6;
    scale.default_text = "1";
    option(
        scale, [](ProfileOptions& o, const CaseValue& v) { o.scale = v.number(); },
        [](const ProfileOptions& o) { return o.scale == 1.0 ? std::string() : exact_text(o.scale, 1.0); });

    KeyInfo smoothing =
        info("smoothing", KeyType::number,
             "of a profile's points: auto, as much as their noise asks for; none, a curve through all of "
             "them; a number, as smoothing_wavelength_mm");
    smoothing.choices = {"auto", "none"};
    smoothing.default_text = "\"auto\"";
    KeyInfo lambda = info("smoothing_lambda_mm3", KeyType::number,
                          "smoothing parameter of an unweighted smoothing spline; 0 = interpolate");
    KeyInfo wavelength =
        info("smoothing_wavelength_mm", KeyType::number, "cut-off wavelength of a weighted smoothing spline");
    for (KeyInfo* key : {&smoothing, &lambda, &wavelength}) {
      key->at_least = 0.0;
      key->group = fmt::format("{}smoothing", prefix_);
      key->alternative = key->path;
    }
    option(
        smoothing,
        [](ProfileOptions& o, const CaseValue& v) {
          const bool words = std::holds_alternative<std::string>(v.data);
          o.smoothing.method = !words               ? Method::weighted_spline
                               : v.text() == "auto" ? Method::by_noise
                                                    : Method::spline;
          o.smoothing.strength = words ? 0.0 : v.number() * unit_of_key("wavelength_mm");
        },
        [](const ProfileOptions& o) {
          return o.smoothing.method == Method::spline && o.smoothing.strength == 0.0 ? "\"none\"" : "";
        });
    option(
        lambda,
        [](ProfileOptions& o, const CaseValue& v) {
          o.smoothing.method = Method::spline;
          o.smoothing.strength = v.number() * unit_of_key("lambda_mm3");
        },
        [](const ProfileOptions& o) {
          return o.smoothing.method != Method::spline || o.smoothing.strength == 0.0
                     ? std::string()
                     : exact_text(o.smoothing.strength, unit_of_key("lambda_mm3"));
        });
    option(
        wavelength,
        [](ProfileOptions& o, const CaseValue& v) {
          if (o.smoothing.method != Method::weighted_bspline) o.smoothing.method = Method::weighted_spline;
          o.smoothing.strength = v.number() * unit_of_key("wavelength_mm");
        },
        [](const ProfileOptions& o) {
          return o.smoothing.method != Method::weighted_spline && o.smoothing.method != Method::weighted_bspline
                     ? std::string()
                     : exact_text(o.smoothing.strength, unit_of_key("wavelength_mm"));
        });
    KeyInfo method =
        info("smoothing_method", KeyType::choice, "with smoothing_wavelength_mm: kind of weighted smoothing spline");
    method.choices = {"weighted_spline", "weighted_bspline"};
    method.default_text = "\"weighted_spline\"";
    option(
        method,
        [](ProfileOptions& o, const CaseValue& v) {
          if (o.smoothing.method != Method::weighted_spline && o.smoothing.method != Method::weighted_bspline)
            throw Error(ErrorKind::configuration, "smoothing_method needs smoothing_wavelength_mm", v.where);
          o.smoothing.method = v.text() == "weighted_bspline" ? Method::weighted_bspline : Method::weighted_spline;
        },
        [](const ProfileOptions& o) {
          return o.smoothing.method == Method::weighted_bspline ? "\"weighted_bspline\"" : "";
        });

    // written: of the options, NaN where nothing is to be said.
    const auto angle = [&](const std::string& name, const std::string& doc, double initial, double least, auto change,
                           auto written) {
      KeyInfo key = info(name, KeyType::number, doc);
      key.at_least = least;
      key.at_most = 180.0;
      key.default_text = fmt::format("{:.10g}", initial / unit_of_key("x_deg"));
      option(
          key, [change](ProfileOptions& o, const CaseValue& v) { change(o, v.number() * unit_of_key("x_deg")); },
          [written](const ProfileOptions& o) {
            const double value = written(o);
            return std::isnan(value) ? std::string() : exact_text(value, unit_of_key("x_deg"));
          });
    };
    constexpr double kLeastKink = 0.01, kLeastZigzag = 45.0;
    angle(
        "kink_high_deg", "turning angle above which a point may be a kink; sets kink_low_deg to a fifth",
        fresh.smoothing.kink_high, kLeastKink,
        [](ProfileOptions& o, double value) {
          o.smoothing.kink_high = value;
          o.smoothing.kink_low = value / 5.0;
        },
        [fresh](const ProfileOptions& o) {
          return o.smoothing.kink_high == fresh.smoothing.kink_high ? kNaN : o.smoothing.kink_high;
        });
    angle(
        "kink_low_deg", "turning angle below which the neighbours of a kink must stay", fresh.smoothing.kink_low,
        kLeastKink / 5.0, [](ProfileOptions& o, double value) { o.smoothing.kink_low = value; },
        [fresh](const ProfileOptions& o) {
          const bool usual =
              o.smoothing.kink_low == fresh.smoothing.kink_low && o.smoothing.kink_high == fresh.smoothing.kink_high;
          return usual ? kNaN : o.smoothing.kink_low;
        });
    KeyInfo width =
        info("kink_width_mm", KeyType::number, "arc length on both sides of a kink in which neighbours are looked at");
    width.at_least = 0.0;
    width.default_text = fmt::format("{:.10g}", fresh.smoothing.kink_width / unit_of_key("x_mm"));
    option(
        width, [](ProfileOptions& o, const CaseValue& v) { o.smoothing.kink_width = v.number() * unit_of_key("x_mm"); },
        [fresh](const ProfileOptions& o) {
          return o.smoothing.kink_width == fresh.smoothing.kink_width
                     ? std::string()
                     : exact_text(o.smoothing.kink_width, unit_of_key("x_mm"));
        });
    angle(
        "zigzag_threshold_deg", "two successive turns sharper than this are a zig-zag and averaged",
        fresh.zigzag_threshold, kLeastZigzag, [](ProfileOptions& o, double value) { o.zigzag_threshold = value; },
        [fresh](const ProfileOptions& o) {
          return o.zigzag_threshold == fresh.zigzag_threshold ? kNaN : o.zigzag_threshold;
        });
    KeyInfo omit = info("max_omit", KeyType::number, "share of points that cleaning may remove");
    omit.at_least = 0.0;
    omit.at_most = 1.0;
    omit.default_text = fmt::format("{:.10g}", fresh.max_omit);
    option(
        omit, [](ProfileOptions& o, const CaseValue& v) { o.max_omit = v.number(); },
        [fresh](const ProfileOptions& o) {
          return o.max_omit == fresh.max_omit ? std::string() : exact_text(o.max_omit, 1.0);
        });
  }

  KeyList& list_;
  std::string prefix_, body_;
  SurfaceSource W::*surface_;
};

}  // namespace

void add_shape_keys(KeyList& list) {
  ShapeKeys(list, "rail", &W::rail).add();
  add_part_keys(list);
  ShapeKeys(list, "wheel", &W::wheel).add();
}

std::vector<std::string> given_shape_keys(const SurfaceSource& source, Body body) {
  const std::string prefix = body == Body::wheel ? "wheel.shape." : "rail.shape.";
  const Case fresh;
  Case given;
  (body == Body::wheel ? content_of<W>(given).wheel : content_of<W>(given).rail) = source;
  const auto value = [](const CaseKey& key, const Case& c) { return key.written ? key.written(c, {}) : key.text(c); };
  std::vector<std::string> names;
  for (const CaseKey& key : case_keys())
    if (key.info.path.starts_with(prefix) && key.info.group != prefix)
      if (const std::string text = value(key, given); !text.empty() && text != value(key, fresh))
        names.push_back(key.info.path.substr(prefix.size()));
  return names;
}

}  // namespace treadmark::io
