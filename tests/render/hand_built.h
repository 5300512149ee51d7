// Scenes made by hand, for the tests of what the renderer draws. Public headers only.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstring>
#include <functional>
#include <memory>
#include <random>
#include <string>
#include <vector>

#include "facet/render.h"
#include "facet/scene.h"
#include "facet/shader/dispatch.h"

namespace facet {

inline std::vector<Target> AvailableTargets() {
  std::vector<Target> targets;
  for (Target target : {Target::Scalar, Target::Sse4, Target::Avx2, Target::Avx3, Target::Neon}) {
    if (TargetIsAvailable(target)) targets.push_back(target);
  }
  return targets;
}

inline bool SameBytes(const Film& a, const Film& b) {
  return a.width == b.width && a.height == b.height && a.pixels.size() == b.pixels.size() &&
         std::memcmp(a.pixels.data(), b.pixels.data(), a.pixels.size() * sizeof(glm::vec4)) == 0 &&
         std::equal(a.planes.begin(), a.planes.end(), b.planes.begin(), b.planes.end(),
                    [](const Plane& c, const Plane& d) { return c.kind == d.kind && c.bytes == d.bytes; });
}

// Numbers in [0, 1) that are the same everywhere.
class Uniform {
 public:
  explicit Uniform(unsigned seed) : random_(seed) {}
  double operator()() { return double(random_() >> 8) / 16777216.0; }
  double operator()(double low, double high) { return low + (high - low) * (*this)(); }

 private:
  std::mt19937 random_;
};

// Adds a primitive under a node of its own; returns the node.
inline int Add(Scene& scene, Primitive primitive, int material, const Transform& transform = {}) {
  primitive.material = material;
  Mesh mesh;
  mesh.primitives.push_back(std::move(primitive));
  scene.meshes.push_back(std::move(mesh));
  Node node;
  node.mesh = int(scene.meshes.size()) - 1;
  node.transform = transform;
  scene.nodes.push_back(std::move(node));
  return int(scene.nodes.size()) - 1;
}

inline int AddMaterial(Scene& scene, const Material& material) {
  scene.materials.push_back(material);
  return int(scene.materials.size()) - 1;
}

inline Material Unlit(const glm::vec4& color, AlphaMode mode = AlphaMode::Opaque) {
  Material material;
  material.model = ShadingModel::Unlit;
  material.base_color_factor = color;
  material.alpha_mode = mode;
  material.double_sided = true;
  return material;
}

// A rectangle at z = 0 that faces +Z; UVs run from its top left corner, v down.
inline Primitive Rectangle(float x0, float y0, float x1, float y1, float z = 0.0f) {
  Primitive p;
  p.positions = {{x0, y0, z}, {x1, y0, z}, {x1, y1, z}, {x0, y1, z}};
  p.normals.assign(4, glm::vec3(0, 0, 1));
  p.tex_coords = {{{0, 1}, {1, 1}, {1, 0}, {0, 0}}};
  p.indices = {0, 1, 2, 0, 2, 3};
  return p;
}

inline Primitive Sphere(float radius, int rings, int segments) {
  Primitive p;
  p.tex_coords.resize(1);
  for (int i = 0; i <= rings; ++i) {
    for (int k = 0; k <= segments; ++k) {
      const double theta = 3.14159265358979 * i / rings, phi = 2 * 3.14159265358979 * k / segments;
      const glm::dvec3 n(std::sin(theta) * std::cos(phi), std::cos(theta), -std::sin(theta) * std::sin(phi));
      p.normals.emplace_back(n);
      p.positions.emplace_back(n * double(radius));
      p.tex_coords[0].emplace_back(float(k) / float(segments), float(i) / float(rings));
    }
  }
  const auto index = [&](int i, int k) { return std::uint32_t(i * (segments + 1) + k); };
  for (int i = 0; i < rings; ++i) {
    for (int k = 0; k < segments; ++k) {
      for (std::uint32_t v :
           {index(i, k), index(i + 1, k), index(i + 1, k + 1), index(i, k), index(i + 1, k + 1), index(i, k + 1)}) {
        p.indices.push_back(v);
      }
    }
  }
  return p;
}

// Looks along -Z from `eye`; the image's height spans [-half, half].
inline FreeCamera Orthographic(double half, const glm::dvec3& eye = {0, 0, 10}, double aspect = 1.0) {
  FreeCamera camera;
  camera.world_from_camera[3] = glm::dvec4(eye, 1.0);
  camera.lens.orthographic = true;
  camera.lens.xmag = half * aspect;
  camera.lens.ymag = half;
  camera.lens.znear = 0.01;
  camera.lens.zfar = 1000.0;
  return camera;
}

inline FreeCamera Perspective(double yfov, const glm::dvec3& eye) {
  FreeCamera camera;
  camera.world_from_camera[3] = glm::dvec4(eye, 1.0);
  camera.lens.yfov = yfov;
  camera.lens.znear = 0.01;
  return camera;
}

inline RenderSettings Settings(int width, int height, int samples, const CameraChoice& camera) {
  RenderSettings settings;
  settings.width = width;
  settings.height = height;
  settings.samples = samples;
  settings.camera = camera;
  settings.environment.kind = EnvironmentSettings::Kind::None;
  settings.threads = 2;
  return settings;
}

// An image of 8-bit RGBA texels.
inline Image MakeImage(int width, int height, const std::function<glm::u8vec4(int, int)>& texel) {
  Image image;
  image.width = width;
  image.height = height;
  image.channels = 4;
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      const glm::u8vec4 t = texel(x, y);
      for (int c = 0; c < 4; ++c) image.bytes.push_back(std::byte(t[c]));
    }
  }
  return image;
}

inline int AddTexture(Scene& scene, std::shared_ptr<const ImageSource> source, const Sampler& sampler = {}) {
  scene.images.push_back({"", std::move(source)});
  Texture texture;
  texture.image = int(scene.images.size()) - 1;
  texture.sampler = sampler;
  scene.textures.push_back(texture);
  return int(scene.textures.size()) - 1;
}

inline int AddTexture(Scene& scene, Image image, const Sampler& sampler = {}) {
  return AddTexture(scene, MakeImageSource(std::move(image), "picture"), sampler);
}

inline TextureRef Ref(int texture) {
  TextureRef ref;
  ref.texture = texture;
  return ref;
}

// Constant radiance from everywhere.
inline EnvironmentSettings ConstantEnvironment(float radiance) {
  auto image = std::make_shared<Image>();
  image->width = 16;
  image->height = 8;
  image->channels = 3;
  image->type = ChannelType::F32;
  image->encoding = Encoding::Linear;
  image->bytes.resize(image->PixelCount() * 3 * sizeof(float));
  for (std::size_t i = 0; i < image->PixelCount() * 3; ++i) image->As<float>()[i] = radiance;
  EnvironmentSettings environment;
  environment.kind = EnvironmentSettings::Kind::Image;
  environment.image = image;
  return environment;
}

}  // namespace facet
