#include <optional>
#include <string_view>
#include <type_traits>
#include <vector>

#include "base/parallel.h"
#include "base/sha256.h"
#include "facet/error.h"
#include "facet/scene.h"
#include "material/model_parameters.h"
#include "material/parameters.h"

namespace facet {
namespace {

// Hashes all members of a value in the order of their declaration. Structs are hashed field by field, because padding
// has no defined value.
class Description {
 public:
  template <class T>
  void Add(const T& value) {
    if constexpr (std::is_arithmetic_v<T> || std::is_enum_v<T>) {
      hash_.Add(value);
    } else {
      Fields(value);
    }
  }
  Digest Finish() { return hash_.Finish(); }

 private:
  template <class... T>
  void All(const T&... values) {
    (Add(values), ...);
  }
  template <class T>
  void Fields(const std::vector<T>& values) {
    Add(std::uint64_t(values.size()));
    for (const T& value : values) Add(value);
  }
  template <class T>
  void Fields(const std::optional<T>& value) {
    Add(value.has_value());
    if (value) Add(*value);
  }
  template <glm::length_t L, class T, glm::qualifier Q>
  void Fields(const glm::vec<L, T, Q>& v) {
    for (glm::length_t i = 0; i < L; ++i) Add(v[i]);
  }
  template <glm::length_t C, glm::length_t R, class T, glm::qualifier Q>
  void Fields(const glm::mat<C, R, T, Q>& m) {
    for (glm::length_t i = 0; i < C; ++i) Add(m[i]);
  }
  void Fields(const glm::dquat& q) { All(q.w, q.x, q.y, q.z); }

  template <class T>
  static bool IsSame(const T& a, const T& b) {
    if constexpr (std::is_same_v<T, TextureRef>) {
      return !a && !b;
    } else {
      return a == b;
    }
  }

  void Fields(const Sampler& s) { All(s.wrap_u, s.wrap_v, s.magnification, s.minification, s.mip); }
  void Fields(const Texture& t) { All(t.image, t.sampler); }
  void Fields(const TextureRef& t) { All(t.texture, t.tex_coord, t.offset, t.scale, t.rotation); }
  void Fields(const Material& m) {
    const Material plain;
    int row = 0;
    ForEachParameter([&](const auto& parameter) {
      if (parameter.alternative) return;
      const auto& value = m.*parameter.member;
      if (row++ < kCoreParameters) return Add(value);
      if (IsSame(value, plain.*parameter.member)) return;
      for (const char c : std::string_view(parameter.gltf_group)) Add(c);
      for (const char c : std::string_view(parameter.gltf_name)) Add(c);
      Add(value);
    });
    if (m.parameters == nullptr) return;
    ForEachParameterOf(*m.parameters, [&](const auto& parameter, const auto& value) {
      for (const char c : std::string_view(parameter.name)) Add(c);
      Add(value);
    });
  }
  template <class Value>
  void Fields(const Textured<Value>& t) {
    All(t.value, t.texture, t.channel);
  }
  void Fields(const TangentSpaceNormal& n) { All(n.value, n.texture, n.scale); }
  void Fields(const Primitive& p) { All(p.topology, p.material, p.variant_materials); }  // the rest is geometry
  void Fields(const Mesh& m) { All(m.primitives, m.weights); }
  void Fields(const Skin& s) { All(s.joints, s.inverse_bind); }
  void Fields(const Camera& c) { All(c.orthographic, c.yfov, c.aspect, c.xmag, c.ymag, c.znear, c.zfar); }
  void Fields(const Light& l) { All(l.type, l.color, l.intensity, l.range, l.inner_cone_angle, l.outer_cone_angle); }
  void Fields(const Transform& t) { All(t.translation, t.rotation, t.scale); }
  void Fields(const Node& n) {
    All(n.children, n.transform, n.matrix, n.mesh, n.skin, n.camera, n.light, n.weights, n.visible, n.instances);
  }
  void Fields(const AnimationChannel& c) { All(c.node, c.path, c.interpolation, c.times, c.values); }
  void Fields(const Animation& a) { Add(a.channels); }
  void Fields(const SceneRoots& s) { Add(s.nodes); }
  void Fields(const Scene& s) {
    All(s.textures, s.materials, s.meshes, s.skins, s.cameras, s.lights, s.nodes, s.animations, s.scenes,
        s.default_scene, std::uint64_t(s.variants.size()));
  }

  Sha256 hash_;
};

template <class T>
void AddArrays(Sha256& hash, const std::vector<std::vector<T>>& arrays) {
  hash.Add(std::uint64_t(arrays.size()));
  for (const std::vector<T>& array : arrays) hash.AddArray(array);
}

Digest HashGeometry(const Scene& scene) {
  Sha256 hash;
  for (const Mesh& mesh : scene.meshes) {
    for (const Primitive& p : mesh.primitives) {
      hash.AddArray(p.positions);
      hash.AddArray(p.normals);
      hash.AddArray(p.tangents);
      AddArrays(hash, p.tex_coords);
      hash.AddArray(p.colors);
      AddArrays(hash, p.joints);
      AddArrays(hash, p.weights);
      hash.AddArray(p.indices);
      hash.Add(std::uint64_t(p.targets.size()));
      for (const MorphTarget& target : p.targets) {
        hash.AddArray(target.positions);
        hash.AddArray(target.normals);
        hash.AddArray(target.tangents);
        AddArrays(hash, target.tex_coords);
        hash.AddArray(target.colors);
      }
    }
  }
  return hash.Finish();
}

Digest HashTextures(const Scene& scene) {
  std::vector<Digest> digests(scene.images.size());
  ParallelFor(digests.size(), 1, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      Image image;
      try {
        image = scene.images[i].source->Decode();
      } catch (const Error& error) {  // rendering ignores it as well
        if (error.code() == ErrorCode::OutOfMemory) throw;
      }
      digests[i] = HashImage(image);
    }
  });
  Sha256 hash;
  for (const Digest& digest : digests) hash.Add(std::as_bytes(std::span(digest.bytes)));
  return hash.Finish();
}

}  // namespace

SceneDigests HashScene(const Scene& scene) {
  Description description;
  description.Add(scene);
  return {description.Finish(), HashGeometry(scene), HashTextures(scene)};
}

}  // namespace facet
