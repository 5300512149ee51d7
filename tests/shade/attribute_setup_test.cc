// Primitives set up side by side have the numbers that each has alone, on every instruction set.
#include "shade/attribute_setup.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <limits>
#include <random>

#include "facet/shader/dispatch.h"
#include "render/frame_view.h"
#include "scene/topology.h"

namespace facet {
namespace {

constexpr float kUnset = -7.0f;
constexpr int kAnchorX = 64, kAnchorY = 128;

FrameView View(bool orthographic) {
  ResolvedCamera camera;
  camera.world_from_camera = glm::dmat4(glm::mat3_cast(glm::normalize(glm::dquat(0.9, 0.1, -0.3, 0.2))));
  camera.world_from_camera[3] = glm::dvec4(0.3, -0.2, 0.1, 1.0);
  camera.lens.orthographic = orthographic;
  return MakeFrameView(camera, 300, 200);
}

// Points around the eye with the attributes `normals` and `tangents`, some of them useless.
Primitive Soup(std::mt19937& random, Topology topology, bool normals, bool tangents) {
  const auto number = [&] { return std::ldexp(static_cast<float>(random()), -31) - 1.0f; };
  const auto vector = [&] { return glm::vec3(number(), number(), number()); };
  const float huge = std::numeric_limits<float>::infinity();
  const glm::vec3 useless[] = {{0, 0, 0}, {NAN, 0, 0}, {huge, -huge, 1}, {1e-38f, 0, 0}};
  Primitive p;
  p.topology = topology;
  p.tex_coords.resize(1);
  for (int i = 0; i < 90; ++i) {
    // Every sixth repeats its neighbour: triangles without area.
    p.positions.push_back(i % 6 == 5 ? p.positions.back() : vector() * 4.0f - glm::vec3(0, 0, 3));
    if (normals) p.normals.push_back(i % 5 == 0 ? useless[random() % 4] : vector());
    if (tangents) p.tangents.emplace_back(i % 5 == 1 ? useless[random() % 4] : vector(), i % 2 == 0 ? 1.0f : -1.0f);
    p.tex_coords[0].emplace_back(number(), number());
    p.colors.emplace_back(vector(), number());
  }
  p.positions[7] = {3e38f, -3e38f, 3e38f};  // squared it is not finite
  for (int i = 0; i < 120; ++i) p.indices.push_back(static_cast<std::uint32_t>(random() % 90));
  return p;
}

ScreenTriangleKind KindOf(Topology topology) {
  switch (ClassOf(topology)) {
    case PrimitiveClass::Points: return ScreenTriangleKind::Point;
    case PrimitiveClass::Lines: return ScreenTriangleKind::Line;
    case PrimitiveClass::Triangles: break;
  }
  return ScreenTriangleKind::Triangle;
}

// Numbers [first, end) of setups that a material reads.
struct Part {
  int first, end;
};
std::vector<Part> ReadParts(const FrameMaterial& material) {
  std::vector<Part> parts = {{AttributeLayout::kPlanes, AttributeLayout::kPositions}};
  if (material.Has(kLit)) parts.push_back({AttributeLayout::kPositions, AttributeLayout::kTangents});
  if (material.Has(kTangentSpaceBits)) parts.push_back({AttributeLayout::kTangents, AttributeLayout::kColors});
  if (material.vertex_colors) parts.push_back({AttributeLayout::kColors, AttributeLayout::kTexCoords});
  constexpr int kUv = AttributeLayout::kTexCoords;
  if (material.uv_slots > 0) parts.push_back({kUv, kUv + 6 * material.uv_slots});
  return parts;
}

std::vector<FrameMaterial> Materials() {
  std::vector<FrameMaterial> materials(4);
  materials[1].features = kLit;
  materials[2].features = kLit | BitOf(Slot::Normal);
  materials[2].vertex_colors = true;
  materials[2].uv_slots = 1;
  materials[3].vertex_colors = true;  // unlit
  return materials;
}

// Drawables of all topologies, mirrored and not, with and without normals and tangents, and primitives of theirs in a
// random order.
struct Mixture {
  std::vector<Primitive> geometry;
  std::vector<FrameDrawable> drawables;
  std::vector<ScreenTriangle> records;

  Mixture(std::mt19937& random, const FrameView& view) {
    const Topology topologies[] = {Topology::Triangles, Topology::TriangleStrip, Topology::TriangleFan,
                                   Topology::Lines,     Topology::LineLoop,      Topology::Points};
    for (const Topology topology : topologies) {
      for (const int with : {0, 1, 3}) geometry.push_back(Soup(random, topology, (with & 1) != 0, (with & 2) != 0));
    }
    for (const Primitive& p : geometry) {
      for (const double mirror : {1.0, -1.0}) {
        Drawable placed;
        placed.geometry = &p;
        placed.world_from_mesh[0] = {1.5 * mirror, 0.2, 0.0, 0.0};
        placed.world_from_mesh[3] = {0.1, 0.2, -1.0, 1.0};
        drawables.push_back(MakeFrameDrawable(view, placed));
      }
    }
    // Runs of one drawable's, of all lengths.
    while (records.size() < 3000) {
      const auto d = static_cast<std::uint32_t>(random() % drawables.size());
      for (auto left = random() % 40; left > 0; --left) {
        ScreenTriangle r{};
        r.drawable = d;
        r.primitive = static_cast<std::uint32_t>(random() % drawables[d].primitive_count);
        r.kind = KindOf(drawables[d].geometry->topology);
        r.back_facing = random() % 3 == 0;
        records.push_back(r);
      }
    }
  }
};

std::size_t StrideOf(const FrameMaterial& material) { return std::size_t(AttributeLayout::Stride(material.uv_slots)); }

std::vector<float> SetUpAll(const FrameView& view, const Mixture& scene, const FrameMaterial& material,
                            const std::vector<const ScreenTriangle*>& records, std::size_t batch) {
  std::vector<float> setups(records.size() * StrideOf(material), kUnset);
  std::vector<const Primitive*> attributes;
  for (const FrameDrawable& drawable : scene.drawables) attributes.push_back(drawable.geometry);
  for (std::size_t i = 0; i < records.size(); i += batch) {
    SetUpTriangleAttributes({&view, scene.drawables.data(), attributes.data(), &material, kAnchorX, kAnchorY,
                             records.data() + i, std::min(batch, records.size() - i),
                             setups.data() + i * StrideOf(material)});
  }
  return setups;
}

TEST(SetUpTriangleAttributes, GivesEachWhatItHasAlone) {
  std::mt19937 random(41);
  for (const bool orthographic : {false, true}) {
    const FrameView view = View(orthographic);
    const Mixture scene(random, view);
    std::vector<const ScreenTriangle*> records;
    for (const ScreenTriangle& r : scene.records) records.push_back(&r);
    for (const FrameMaterial& material : Materials()) {
      std::vector<float> expected;
      {
        const ScopedTarget scalar(Target::Scalar);
        expected = SetUpAll(view, scene, material, records, 1);
      }
      for (const Target target : {Target::Scalar, Target::Sse4, Target::Avx2, Target::Avx3, Target::Neon}) {
        if (!TargetIsAvailable(target)) continue;
        const ScopedTarget scoped(target);
        for (const std::size_t batch : {1u, 2u, 3u, 7u, 8u, 15u, 16u, 17u, 33u, 64u, 3000u}) {
          SCOPED_TRACE(std::string(TargetName(target)) + ", " + std::to_string(batch) + " at a time");
          const std::vector<float> got = SetUpAll(view, scene, material, records, batch);
          for (std::size_t i = 0; i < records.size(); ++i) {
            for (const Part& part : ReadParts(material)) {
              const std::size_t at = i * StrideOf(material) + std::size_t(part.first);
              ASSERT_EQ(std::memcmp(&got[at], &expected[at], std::size_t(part.end - part.first) * sizeof(float)), 0)
                  << "record " << i << ", numbers from " << part.first;
            }
          }
        }
      }
    }
  }
}

// What a normal that has no direction is replaced by depends on its own triangle alone: flat, and that failing, towards
// the eye.
TEST(SetUpTriangleAttributes, NormalsThatAreUselessBecomeFlat) {
  const FrameView view = View(false);
  std::mt19937 random(42);
  const Mixture scene(random, view);
  std::vector<const ScreenTriangle*> records;
  for (const ScreenTriangle& r : scene.records) records.push_back(&r);
  const std::vector<float> setups = SetUpAll(view, scene, Materials()[1], records, records.size());
  const std::size_t stride = StrideOf(Materials()[1]);
  int flat = 0, toward_eye = 0;
  for (std::size_t i = 0; i < records.size(); ++i) {
    const FrameDrawable& drawable = scene.drawables[records[i]->drawable];
    if (records[i]->kind != ScreenTriangleKind::Triangle || drawable.geometry->normals.empty()) continue;
    const auto vertices = PrimitiveVertices(*drawable.geometry, records[i]->primitive);
    if (std::find(vertices.begin(), vertices.end(), 7u) != vertices.end()) continue;
    const auto vec3 = [&](int at) {
      const float* p = &setups[i * stride + std::size_t(at)];
      return glm::dvec3(p[0], p[1], p[2]);
    };
    const glm::dvec3 a = vec3(AttributeLayout::kPositions), b = vec3(AttributeLayout::kPositions + 3),
                     c = vec3(AttributeLayout::kPositions + 6), across = glm::cross(b - a, c - a);
    const double side = records[i]->back_facing != drawable.mirrored ? -1.0 : 1.0;
    for (int k = 0; k < 3; ++k) {
      const glm::dvec3 given = drawable.geometry->normals[vertices[std::size_t(k)]];
      const glm::dvec3 normal = vec3(AttributeLayout::kNormals + 3 * k);
      ASSERT_NEAR(glm::length(normal), 1.0, 1e-6) << i;
      if (glm::length(given) > 0.0 && std::isfinite(glm::length(given))) continue;
      if (glm::length(across) > 0.05) {
        ++flat;
        EXPECT_LT(glm::length(normal - side * glm::normalize(across)), 1e-4) << i;
      } else if (a == b || b == c || c == a) {
        ++toward_eye;
        EXPECT_LT(glm::length(normal + glm::normalize(a)), 1e-4) << i;
      }
    }
  }
  EXPECT_GT(flat, 20);
  EXPECT_GT(toward_eye, 2);
}

// A matrix with a NaN in it leaves no plane: such a triangle takes everything from its first vertex, as one without
// area does.
TEST(SetUpTriangleAttributes, WhatIsNoNumberTakesItsFirstVertex) {
  const FrameView view = View(false);
  std::mt19937 random(43);
  Mixture scene(random, view);
  std::vector<const ScreenTriangle*> records;
  for (const ScreenTriangle& r : scene.records) {
    if (r.kind == ScreenTriangleKind::Triangle) records.push_back(&r);
  }
  for (int row = 0; row < 3; ++row) {
    for (int column = 0; column < 4; ++column) {
      Mixture broken = scene;
      for (std::size_t d = 0; d < broken.drawables.size(); ++d) {
        broken.drawables[d].screen_from_mesh[row][column] = std::numeric_limits<double>::quiet_NaN();
      }
      for (const Target target : {Target::Scalar, Target::Sse4, Target::Avx2, Target::Avx3, Target::Neon}) {
        if (!TargetIsAvailable(target)) continue;
        const ScopedTarget scoped(target);
        const std::vector<float> setups = SetUpAll(view, broken, Materials()[0], records, records.size());
        for (std::size_t i = 0; i < records.size(); ++i) {
          const float* planes = &setups[i * StrideOf(Materials()[0]) + AttributeLayout::kPlanes];
          const float first[9] = {0, 0, 1, 0, 0, 0, 0, 0, 0};
          ASSERT_TRUE(std::equal(first, first + 9, planes))
              << TargetName(target) << ", NaN in row " << row << ", column " << column << ", record " << i;
        }
      }
    }
  }
}

}  // namespace
}  // namespace facet
