// The text of `facet info`.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdarg>
#include <cstdio>
#include <numbers>
#include <type_traits>

#include "base/bytes_text.h"
#include "base/printable.h"
#include "cli/camera_text.h"
#include "cli/info_summary.h"
#include "material/model_parameters.h"
#include "material/models/models.h"
#include "material/parameters.h"

namespace facet::cli {
namespace {

constexpr double kDegreesPerRadian = 180.0 / std::numbers::pi;

#if defined(__GNUC__)
__attribute__((format(printf, 1, 2)))
#endif
std::string
Format(const char* format, ...) {
  std::array<char, 256> buffer;
  va_list arguments;
  va_start(arguments, format);
  const int length = std::vsnprintf(buffer.data(), buffer.size(), format, arguments);
  va_end(arguments);
  if (length < 0) return {};
  return std::string(buffer.data(), std::min(static_cast<std::size_t>(length), buffer.size() - 1));
}

// "3 meshes", "1 mesh".
std::string Plural(std::uint64_t count, const char* one, const char* many) {
  return std::to_string(count) + " " + (count == 1 ? one : many);
}

std::string Plural(std::uint64_t count, const char* one) {
  return Plural(count, one, (std::string(one) + "s").c_str());
}

std::string Bytes(std::size_t bytes) {
  if (bytes < 1024) return Plural(bytes, "byte");
  return BytesText(static_cast<double>(bytes));
}

std::string Describe(const Geometry& geometry) {
  std::vector<std::string> parts;
  if (geometry.triangles > 0) parts.push_back(Plural(geometry.triangles, "triangle"));
  if (geometry.lines > 0) parts.push_back(Plural(geometry.lines, "line"));
  if (geometry.points > 0) parts.push_back(Plural(geometry.points, "point"));
  if (geometry.primitives > 0) {
    parts.push_back(Plural(geometry.vertices, "vertex", "vertices"));
    parts.push_back(Plural(geometry.primitives, "primitive"));
  }
  return parts.empty() ? "nothing drawn" : Joined(parts);
}

std::string Describe(const MeshSummary& mesh) {
  std::vector<std::string> parts = {Describe(mesh.geometry)};
  if (!mesh.normals) parts.push_back("no normals");
  if (mesh.tangents) parts.push_back("tangents");
  if (mesh.tex_coord_sets > 0) parts.push_back(Plural(mesh.tex_coord_sets, "UV set"));
  if (mesh.colors) parts.push_back("vertex colours");
  if (mesh.morph_targets > 0) parts.push_back(Plural(mesh.morph_targets, "morph target"));
  if (mesh.influences > 0) parts.push_back(std::to_string(mesh.influences) + " joints a vertex");
  return Joined(parts);
}

std::string Describe(const TextureUse& use) {
  std::string text(use.slot);
  for (char& c : text) {
    if (c == '_') c = ' ';
  }
  if (use.ref.tex_coord > 0) text += " (UV set " + std::to_string(use.ref.tex_coord) + ")";
  if (use.transformed) text += " (transformed)";
  return text;
}

// Each with a blank before it.
std::string Numbers(float value) { return Format(" %g", static_cast<double>(value)); }
std::string Numbers(const glm::vec3& color) { return Numbers(color.x) + Numbers(color.y) + Numbers(color.z); }

std::string Numbers(const glm::vec4& color) { return Numbers(glm::vec3(color)) + Numbers(color.a); }
template <class Value>
std::string Numbers(const Value& value, const RowOptions& options) {
  if constexpr (requires { value.value; }) {
    return Numbers(value.value);
  } else if constexpr (std::is_same_v<Value, bool>) {
    return value ? " true" : " false";
  } else if constexpr (std::is_enum_v<Value>) {
    return std::string(" ") + options.words[std::size_t(value)];
  } else {
    return Numbers(value);
  }
}

std::string Describe(const MaterialSummary& summary) {
  const Material& material = *summary.material;
  std::vector<std::string> parts;
  switch (material.alpha_mode) {
    case AlphaMode::Opaque: parts.push_back("opaque"); break;
    case AlphaMode::Mask: parts.push_back(Format("masked at %g", static_cast<double>(material.alpha_cutoff))); break;
    case AlphaMode::Blend: parts.push_back("blended"); break;
  }
  if (material.double_sided) parts.push_back("double-sided");
  if (material.parameters != nullptr) {
    parts.push_back(InfoOf(material.model).word);
    ForEachStatedParameter(*material.parameters, [&](const auto& parameter, const auto& value) {
      parts.push_back(parameter.name + Numbers(value, parameter));
    });
  } else if (material.model != ShadingModel::MetallicRoughness) {
    parts.push_back(InfoOf(material.model).word);
  } else {
    parts.push_back(Format("metallic %g", static_cast<double>(material.metallic_factor)));
    parts.push_back(Format("roughness %g", static_cast<double>(material.roughness_factor)));
  }
  const Material plain;
  ForEachParameter([&]<class Value>(const Parameter<Value>& parameter) {
    if constexpr (std::is_same_v<Value, float> || std::is_same_v<Value, glm::vec3>) {
      const Value value = material.*parameter.member;
      const bool is_extension = parameter.gltf_group != nullptr && IsExtension(parameter.gltf_group);
      if (!is_extension || parameter.alternative || value == plain.*parameter.member) return;
      parts.push_back(parameter.name + Numbers(value));
    }
  });
  std::string text = Joined(parts);
  std::vector<std::string> textures;
  for (const TextureUse& use : summary.textures) textures.push_back(Describe(use));
  text += textures.empty() ? "; no textures" : "; textures: " + Joined(textures);
  if (!summary.ignored.empty()) {
    text += std::string("; not used because it is ") + InfoOf(material.model).word + ": " + Joined(summary.ignored);
  }
  if (summary.primitives == 0) text += "; not used";
  return text;
}

std::string Describe(const Camera& camera) {
  if (camera.orthographic) return Format("orthographic, %g x %g m", 2.0 * camera.xmag, 2.0 * camera.ymag);
  std::string text = Format("perspective, %.4g degrees high", camera.yfov * kDegreesPerRadian);
  if (camera.aspect) text += Format(", aspect %.4g", *camera.aspect);
  return text;
}

std::string Describe(const Light& light) {
  std::string text =
      Format("%s, %g %s, colour %.3g %.3g %.3g", NameOf(light.type), static_cast<double>(light.intensity),
             light.type == LightType::Directional ? "lx" : "cd", static_cast<double>(light.color.x),
             static_cast<double>(light.color.y), static_cast<double>(light.color.z));
  if (std::isfinite(light.range)) text += Format(", range %g m", static_cast<double>(light.range));
  if (light.type == LightType::Spot) {
    text += Format(", cone %.3g to %.3g degrees", static_cast<double>(light.inner_cone_angle) * kDegreesPerRadian,
                   static_cast<double>(light.outer_cone_angle) * kDegreesPerRadian);
  }
  return text;
}

std::string Describe(const AnimationSummary& animation) {
  std::vector<std::string> paths;
  const auto add = [&paths](std::size_t count, const char* what) {
    if (count > 0) paths.push_back(Plural(count, what));
  };
  add(animation.translations, "translation");
  add(animation.rotations, "rotation");
  add(animation.scales, "scale");
  add(animation.weights, "morph weight");
  return Format("%.4g s, ", animation.duration_seconds) + (paths.empty() ? "no channels" : Joined(paths));
}

std::string Describe(const SceneSummary& scene) {
  std::string text = Plural(scene.nodes, "node") + ", " + Describe(scene.drawn);
  if (!scene.empty) {
    text += Format("; from %.4g %.4g %.4g to %.4g %.4g %.4g", scene.low.x, scene.low.y, scene.low.z, scene.high.x,
                   scene.high.y, scene.high.z);
  }
  return text;
}

std::string Describe(const ExtensionUse& extension) {
  std::string text = extension.required ? "required, " : "used, ";
  return text + (extension.supported  ? "supported"
                 : extension.required ? "NOT SUPPORTED: render refuses the file"
                                      : "not supported: ignored");
}

std::string Describe(const ImageSummary& image) {
  std::vector<std::string> parts;
  if (image.source != image.name) parts.push_back(image.source);
  if (!image.header) {
    parts.push_back("unknown format");
  } else {
    const ImageHeader& header = *image.header;
    if (!header.format.empty()) parts.push_back(header.format);
    const bool sized = header.width > 0 && header.height > 0;
    parts.push_back(sized ? Format("%dx%d", header.width, header.height) : "unknown size");
    if (header.channels > 0 && header.bits > 0) parts.push_back(Format("%d x %d bits", header.channels, header.bits));
    parts.push_back(Bytes(header.bytes));
  }
  parts.push_back(image.textures == 0 ? "not used" : "used by " + Plural(image.textures, "texture"));
  return Joined(parts);
}

std::string Describe(const Skin& skin) { return Plural(skin.joints.size(), "joint"); }

std::string Describe(const std::string&) { return {}; }

// A heading with the number of items, then one line for each item: index, name, description.
class Listing {
 public:
  explicit Listing(std::string& text) : text_(text) {}

  template <class Things, class Name>
  void Add(const char* heading, const Things& things, Name name) {
    if (things.empty()) return;
    text_ += std::string("\n") + heading + ": " + std::to_string(things.size()) + "\n";
    std::vector<std::string> names;
    std::size_t width = 0;
    for (const auto& thing : things) {
      names.push_back(Printable(name(thing)));
      if (names.back().size() <= kWidest) width = std::max(width, names.back().size());
    }
    std::size_t index = 0;
    for (const auto& thing : things) {
      const std::string description = Printable(Describe(thing));
      std::string line = Format("  %3zu  ", index) + names[index];
      if (!description.empty() && (width > 0 || !names[index].empty())) {
        line.append(width > names[index].size() ? width - names[index].size() : 0, ' ') += "  ";
      }
      text_ += line + description + "\n";
      ++index;
    }
  }

 private:
  static constexpr std::size_t kWidest = 32;  // longer names do not widen the column
  std::string& text_;
};

}  // namespace

std::string InfoText(const FileSummary& summary) {
  const Scene& scene = summary.file->scene;
  const LoadReport& report = summary.file->report;
  std::string text =
      Printable(summary.input) + ": glTF " + Printable(report.version) + ", " + Bytes(report.file_bytes) + "\n";
  if (!report.generator.empty()) text += "generator: " + Printable(report.generator) + "\n";
  if (!report.copyright.empty()) text += "copyright: " + Printable(report.copyright) + "\n";
  text += "in all: " + Plural(scene.nodes.size(), "node") + ", " + Plural(scene.meshes.size(), "mesh", "meshes") +
          ", " + Describe(summary.geometry) + ", " + Plural(scene.textures.size(), "texture") + "\n";

  const auto named = [](const auto& thing) { return thing.name; };
  Listing listing(text);
  listing.Add("scenes", summary.scenes, named);
  if (scene.scenes.size() > 1) text += "  default: " + std::to_string(std::max(scene.default_scene, 0)) + "\n";
  text += "default camera: " + CameraText(summary.camera, summary.camera_target_distance) + "\n";
  listing.Add("meshes", summary.meshes, named);
  listing.Add("materials", summary.materials, [](const MaterialSummary& m) { return m.material->name; });
  listing.Add("images", summary.images, named);
  listing.Add("cameras", scene.cameras, named);
  listing.Add("lights", scene.lights, named);
  listing.Add("animations", summary.animations, named);
  listing.Add("skins", scene.skins, named);
  listing.Add("variants", scene.variants, [](const std::string& name) { return name; });
  listing.Add("extensions", report.extensions, named);
  if (!report.warnings.empty()) {
    text += "\nwarnings: " + std::to_string(report.warnings.size()) + "\n";
    for (const std::string& warning : report.warnings) text += "  " + Printable(warning) + "\n";
  }
  return text;
}

}  // namespace facet::cli
