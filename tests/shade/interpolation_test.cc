// Attributes of fragments against a ray caster in double, on every instruction set.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "shade/interpolation_test.cc"
#include "hwy/foreach_target.h"
// Must come after foreach_target.h.
#include "facet/shader/dispatch.h"
#include "shade/interpolate-inl.h"

#ifndef FACET_TESTS_SHADE_INTERPOLATION_ONCE
#define FACET_TESTS_SHADE_INTERPOLATION_ONCE
namespace facet {

// Position, view, normal, interpolated normal, tangent and handedness, colour, then per UV set uv, duv_dx, duv_dy.
constexpr int kSurfaceComponents = 3 + 3 + 3 + 3 + 4 + 4 + 2 * 6;

}  // namespace facet
#endif

HWY_BEFORE_NAMESPACE();
namespace facet {
namespace HWY_NAMESPACE {

// `out`: kSurfaceComponents arrays of `stride` numbers.
void InterpolateAll(const ShadeTask& task, float* out, std::size_t stride) {
  for (std::size_t i = 0; i < task.count; i += LaneCount()) {
    const Surface<Float> s = InterpolateSurface<Float>(task, i);
    float* p = out + i;
    const auto put = [&](Float value) HWY_ATTR {
      Store(value, p);
      p += stride;
    };
    for (const Vec3<Float>& v : {s.position, s.view, s.normal, s.interpolated_normal}) put(v.x), put(v.y), put(v.z);
    for (const Vec4<Float>& v : {s.tangent, s.color}) put(v.x), put(v.y), put(v.z), put(v.w);
    for (int k = 0; k < 2; ++k) {
      for (const Vec2<Float>& v : {s.uv[k], s.duv_dx[k], s.duv_dy[k]}) put(v.x), put(v.y);
    }
  }
}

}  // namespace HWY_NAMESPACE
}  // namespace facet
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <random>

#include "render/frame_view.h"

namespace facet {
namespace {

FACET_EXPORT(InterpolateAll);

struct Attributes {
  glm::dvec3 position, view, normal, interpolated_normal, tangent;
  double handedness;
  glm::dvec4 color;
  glm::dvec2 uv[2], duv_dx[2], duv_dy[2];
};

class Uniform {
 public:
  explicit Uniform(unsigned seed) : random_(seed) {}
  double operator()(double low = 0.0, double high = 1.0) {
    return low + (high - low) * double(random_() >> 8) / 16777216.0;
  }

 private:
  std::mt19937 random_;
};

ResolvedCamera CameraAt(const glm::dvec3& eye, const glm::dquat& rotation, bool orthographic) {
  ResolvedCamera camera;
  camera.world_from_camera = glm::dmat4(glm::mat3_cast(rotation));
  camera.world_from_camera[3] = glm::dvec4(eye, 1.0);
  camera.lens.yfov = 1.0;
  camera.lens.aspect = 1.0;
  camera.lens.orthographic = orthographic;
  camera.lens.xmag = camera.lens.ymag = 2.0;
  return camera;
}

FrameMaterial ReadsEverything() {
  FrameMaterial material;
  material.features = kLit | BitOf(Slot::Normal);
  material.vertex_colors = true;
  material.uv_slots = 2;
  material.uv_sets[0] = 1;  // slots need not be in the order of the sets
  material.uv_sets[1] = 0;
  return material;
}

// One triangle, seen at the given pixel positions (absolute), all within one anchor square.
std::vector<Attributes> Interpolate(const FrameView& view, const Drawable& placed, const FrameMaterial& material,
                                    const ScreenTriangle& record, const std::vector<glm::dvec2>& at) {
  const int anchor_x = int(std::floor(at[0].x)) & ~63, anchor_y = int(std::floor(at[0].y)) & ~63;
  const FrameDrawable drawable = MakeFrameDrawable(view, placed);
  std::vector<float> setup(std::size_t(AttributeLayout::Stride(material.uv_slots)), -7.0f);
  ScreenTriangle only = record;
  only.drawable = 0;
  const ScreenTriangle* const records[] = {&only};
  SetUpTriangleAttributes({&view, &drawable, &drawable.geometry, &material, anchor_x, anchor_y, records, 1, setup.data()});
  const std::size_t padded = (at.size() + 15) / 16 * 16;
  std::vector<std::int32_t> setups(padded, 0);
  std::vector<float> x(padded, 0.0f), y(padded, 0.0f), out(padded * kSurfaceComponents), first;
  for (std::size_t i = 0; i < at.size(); ++i) x[i] = float(at[i].x - anchor_x), y[i] = float(at[i].y - anchor_y);
  ShadeTask task;
  task.setup = setups.data();
  task.x = x.data();
  task.y = y.data();
  task.count = at.size();
  task.setups = setup.data();
  task.material = &material;
  task.orthographic = !view.perspective;
  const glm::dvec3 toward_eye = glm::dvec3(0.0, 0.0, 1.0) * view.camera_from_world;
  for (int i = 0; i < 3; ++i) task.view_direction[i] = float(toward_eye[i]);
  for (Target target : {Target::Scalar, Target::Sse4, Target::Avx2, Target::Avx3, Target::Neon}) {
    if (!TargetIsAvailable(target)) continue;
    std::fill(out.begin(), out.end(), -1.0f);
    InterpolateAllForTarget(target)(task, out.data(), padded);
    if (first.empty()) first = out;
    for (int k = 0; k < kSurfaceComponents; ++k) {
      EXPECT_EQ(std::memcmp(&first[std::size_t(k) * padded], &out[std::size_t(k) * padded], at.size() * sizeof(float)),
                0)
          << TargetName(target);
    }
  }
  std::vector<Attributes> result;
  for (std::size_t i = 0; i < at.size(); ++i) {
    std::size_t k = 0;
    const auto next = [&] { return double(first[k++ * padded + i]); };
    const auto vec3 = [&] {
      const double a = next(), b = next(), c = next();
      return glm::dvec3(a, b, c);
    };
    const auto vec2 = [&] {
      const double a = next(), b = next();
      return glm::dvec2(a, b);
    };
    Attributes s;
    s.position = vec3(), s.view = vec3(), s.normal = vec3(), s.interpolated_normal = vec3(), s.tangent = vec3();
    s.handedness = next();
    s.color = {0, 0, 0, 0};
    for (int c = 0; c < 4; ++c) s.color[c] = next();
    for (int u = 0; u < 2; ++u) s.uv[u] = vec2(), s.duv_dx[u] = vec2(), s.duv_dy[u] = vec2();
    result.push_back(s);
  }
  return result;
}

// --- The reference
// -----------------------------------------------------------------------------------------------------

// Where the ray through a point of the image meets the plane of a triangle (positions relative to the eye).
struct RayCaster {
  glm::dmat3 world_from_camera;
  bool orthographic;
  int width, height;
  glm::dvec3 corner[3];

  glm::dvec3 Weights(const glm::dvec2& at, glm::dvec3* position = nullptr) const {
    const double x = (at.x - 0.5 * width) / (0.5 * height), y = (0.5 * height - at.y) / (0.5 * height);
    const double half = orthographic ? 2.0 : std::tan(0.5);
    const glm::dvec3 sideways = world_from_camera * glm::dvec3(x * half, y * half, 0.0);
    const glm::dvec3 forward = world_from_camera * glm::dvec3(0, 0, -1);
    const glm::dvec3 origin = orthographic ? sideways : glm::dvec3(0.0);
    const glm::dvec3 direction = orthographic ? forward : forward + sideways;
    // corner0 + b1 e1 + b2 e2 = origin + t direction
    const glm::dvec3 solution =
        glm::inverse(glm::dmat3(corner[1] - corner[0], corner[2] - corner[0], -direction)) * (origin - corner[0]);
    if (position != nullptr) *position = origin + solution.z * direction;
    return {1.0 - solution.x - solution.y, solution.x, solution.y};
  }
};

Primitive RandomTriangle(Uniform& random) {
  Primitive p;
  p.tex_coords.resize(2);
  for (int i = 0; i < 3; ++i) {
    p.tex_coords[0].emplace_back(random(-2, 2), random(-2, 2));
    p.tex_coords[1].emplace_back(random(), random());
    p.colors.emplace_back(random(), random(), random(), random());
    p.normals.push_back(glm::normalize(glm::vec3(random(-1, 1), random(-1, 1), random(-1, 1))));
    const glm::vec3 t = glm::normalize(glm::vec3(random(-1, 1), random(-1, 1), random(-1, 1)));
    p.tangents.emplace_back(t, 1.0f);
  }
  return p;
}

// Strong perspective: distances of the corners differ by up to a hundredfold.
void CompareWithRays(bool orthographic, unsigned seed) {
  Uniform random(seed);
  int compared = 0;
  double worst = 0.0;
  for (int round = 0; round < 600; ++round) {
    const glm::dquat turn = glm::normalize(glm::dquat(random(-1, 1), random(-1, 1), random(-1, 1), random(-1, 1)));
    const glm::dvec3 eye(random(-100, 100), random(-100, 100), random(-100, 100));
    const int size = 192;
    const FrameView view = MakeFrameView(CameraAt(eye, turn, orthographic), size, size);
    RayCaster caster{glm::mat3_cast(turn), orthographic, size, size, {}};
    Primitive p = RandomTriangle(random);
    // The mesh lies near the eye in mesh space; the node takes it there.
    for (int i = 0; i < 3; ++i) {
      const double distance = orthographic ? random(1, 20) : std::exp2(random(-2, 4.6));
      const double spread = orthographic ? 2.5 : 0.7 * distance;
      const glm::dvec3 camera(random(-spread, spread), random(-spread, spread), -distance);
      p.positions.emplace_back(glm::mat3_cast(turn) * camera);
      caster.corner[i] = glm::dvec3(p.positions.back());
    }
    Drawable placed;
    placed.geometry = &p;
    placed.world_from_mesh[3] = glm::dvec4(eye, 1.0);
    const int base_x = 64 * int(random(0, 3)), base_y = 64 * int(random(0, 3));
    std::vector<glm::dvec2> at;
    for (int i = 0; i < 200; ++i) {
      const glm::dvec2 pixel(base_x + int(random(0, 64)) + 0.5, base_y + int(random(0, 64)) + 0.5);
      const glm::dvec3 b = caster.Weights(pixel);
      glm::dvec3 hit;
      caster.Weights(pixel, &hit);
      const double distance = -(glm::transpose(caster.world_from_camera) * hit).z;
      if (b.x > 1e-3 && b.y > 1e-3 && b.z > 1e-3 && (orthographic || distance > 0.0)) at.push_back(pixel);
    }
    if (at.empty()) continue;
    ScreenTriangle record{};
    const FrameMaterial material = ReadsEverything();
    const std::vector<Attributes> got = Interpolate(view, placed, material, record, at);
    double extent = 0.0;
    for (const glm::dvec3& c : caster.corner) extent = std::max(extent, glm::length(c));
    for (std::size_t i = 0; i < at.size(); ++i) {
      glm::dvec3 hit;
      const glm::dvec3 b = caster.Weights(at[i], &hit);
      ++compared;
      // Weights are quotients of planes that are rounded to float at the anchor, so their error is some 2^-24 times the
      // ratio of the planes' largest value in the anchor's square to their sum at the pixel. That ratio follows the
      // distances: at most 1 / (plane sum), which is the distance of the pixel over that of the nearest corner and how
      // much of the triangle lies inside the square. Seen: below 1e-5 of the triangle's extent.
      const double tolerance = 2e-5;
      worst = std::max(worst, glm::length(got[i].position - hit) / extent);
      ASSERT_LT(glm::length(got[i].position - hit), tolerance * extent)
          << round << " weights " << b.x << " " << b.y << " " << b.z;
      for (int slot = 0; slot < 2; ++slot) {
        const auto& set = p.tex_coords[std::size_t(material.uv_sets[slot])];
        const auto uv_at = [&](const glm::dvec2& pixel) {
          const glm::dvec3 w = caster.Weights(pixel);
          return glm::dvec2(set[0]) * w.x + glm::dvec2(set[1]) * w.y + glm::dvec2(set[2]) * w.z;
        };
        ASSERT_LT(glm::length(got[i].uv[slot] - uv_at(at[i])), tolerance * 4.0) << round;
        const double h = 1e-4;
        const glm::dvec2 dx = (uv_at(at[i] + glm::dvec2(h, 0)) - uv_at(at[i] - glm::dvec2(h, 0))) / (2 * h);
        const glm::dvec2 dy = (uv_at(at[i] + glm::dvec2(0, h)) - uv_at(at[i] - glm::dvec2(0, h))) / (2 * h);
        const double scale = glm::length(dx) + glm::length(dy);
        ASSERT_LT(glm::length(got[i].duv_dx[slot] - dx), 1e-3 * scale + 1e-6) << round;
        ASSERT_LT(glm::length(got[i].duv_dy[slot] - dy), 1e-3 * scale + 1e-6) << round;
      }
      const glm::dvec4 color =
          glm::dvec4(p.colors[0]) * b.x + glm::dvec4(p.colors[1]) * b.y + glm::dvec4(p.colors[2]) * b.z;
      for (int c = 0; c < 4; ++c) ASSERT_NEAR(got[i].color[c], color[c], 2 * tolerance);
      const glm::dvec3 normal =
          glm::dvec3(p.normals[0]) * b.x + glm::dvec3(p.normals[1]) * b.y + glm::dvec3(p.normals[2]) * b.z;
      ASSERT_LT(glm::length(got[i].interpolated_normal - normal), 2 * tolerance);
      if (glm::length(normal) > 0.1) {
        ASSERT_LT(glm::length(got[i].normal - glm::normalize(normal)), 1e-3);
      }
      const glm::dvec3 toward = orthographic ? caster.world_from_camera * glm::dvec3(0, 0, 1) : glm::normalize(-hit);
      ASSERT_LT(glm::length(got[i].view - toward), 1e-3);
    }
  }
  EXPECT_GT(compared, 2000);
  testing::Test::RecordProperty("worst", std::to_string(worst));
}

TEST(Interpolation, MeetsRaysInPerspective) { CompareWithRays(false, 31); }
TEST(Interpolation, MeetsRaysInParallel) { CompareWithRays(true, 32); }

// A floor to the horizon, the hardest common case: relative error of the texture coordinate along it.
TEST(Interpolation, AFloorToTheHorizon) {
  const FrameView view = MakeFrameView(CameraAt({0, 1, 0}, {1, 0, 0, 0}, false), 512, 512);
  Primitive p;
  p.positions = {{-1000, 0, -1}, {1000, 0, -1}, {0, 0, -2000}};
  p.tex_coords = {{{-1000, 1}, {1000, 1}, {0, 2000}}, {{0, 0}, {0, 0}, {0, 0}}};
  p.normals.assign(3, glm::vec3(0, 1, 0));
  p.tangents.assign(3, glm::vec4(1, 0, 0, 1));
  p.colors.assign(3, glm::vec4(1));
  Drawable placed;
  placed.geometry = &p;
  const double focal = 256.0 / std::tan(0.5);
  for (int base : {256, 320, 384}) {
    std::vector<glm::dvec2> at;
    for (int y = base; y < base + 64; ++y) {
      const double distance = focal / (y + 0.5 - 256.0);
      if (distance > 1.0 && distance < 1900.0) at.push_back({256.5, y + 0.5});
    }
    const std::vector<Attributes> got = Interpolate(view, placed, ReadsEverything(), ScreenTriangle{}, at);
    for (std::size_t i = 0; i < at.size(); ++i) {
      const double distance = focal / (at[i].y - 256.0);
      ASSERT_NEAR(got[i].uv[1].y / distance, 1.0, 1e-4) << at[i].y;
      ASSERT_NEAR(got[i].duv_dy[1].y / (-distance * distance / focal), 1.0, 2e-4) << at[i].y;
      ASSERT_NEAR(got[i].duv_dx[1].x / (distance / focal), 1.0, 2e-4) << at[i].y;
    }
  }
}

// A million units away from the origin nothing is lost.
TEST(Interpolation, DoesNotDependOnWhereTheWorldsOriginLies) {
  Uniform random(33);
  Primitive p = RandomTriangle(random);
  p.positions = {{-1, -1, -3}, {1.5, -0.5, -4}, {0, 1.25, -2.5}};
  std::vector<glm::dvec2> at;
  for (int i = 0; i < 32; ++i) at.push_back({80.5 + i, 90.5});
  std::vector<Attributes> results[2];
  for (int i = 0; i < 2; ++i) {
    const glm::dvec3 origin = i == 0 ? glm::dvec3(0.0) : glm::dvec3(1e6, -1e6, 3e6);
    Drawable placed;
    placed.geometry = &p;
    placed.world_from_mesh[3] = glm::dvec4(origin, 1.0);
    const FrameView view = MakeFrameView(CameraAt(origin, {1, 0, 0, 0}, false), 192, 192);
    results[i] = Interpolate(view, placed, ReadsEverything(), ScreenTriangle{}, at);
  }
  for (std::size_t i = 0; i < at.size(); ++i)
    EXPECT_EQ(std::memcmp(&results[0][i], &results[1][i], sizeof(Attributes)), 0);
}

// --- Normals and tangents
// ------------------------------------------------------------------------------------------------

struct Placement {
  glm::dmat4 matrix;
  bool mirrored;
};

std::vector<Placement> Placements() {
  std::vector<Placement> placements;
  const glm::dmat3 turn = glm::mat3_cast(glm::normalize(glm::dquat(0.9, 0.2, -0.3, 0.1)));
  for (const glm::dvec3 scale : {glm::dvec3(1), glm::dvec3(3, 0.5, 1), glm::dvec3(-1, 1, 1), glm::dvec3(2, -0.25, 1.5),
                                 glm::dvec3(-1, -2, -3), glm::dvec3(-1, -1, 1)}) {
    glm::dmat3 shear(1.0);
    shear[1][0] = 0.4;
    const glm::dmat3 m = turn * shear * glm::dmat3(scale.x, 0, 0, 0, scale.y, 0, 0, 0, scale.z);
    glm::dmat4 all(m);
    all[3] = glm::dvec4(0.1, -0.2, -5.0, 1.0);
    placements.push_back({all, scale.x * scale.y * scale.z < 0.0});
  }
  return placements;
}

// A tilted triangle whose texture runs along its plane, with the tangent frame that belongs to it.
Primitive TexturedTriangle(bool normals, float handedness) {
  Primitive p;
  p.positions = {{-1, -1, 0.2f}, {1.2f, -0.8f, -0.3f}, {0.1f, 1, 0.4f}};
  const glm::dvec3 e1 = p.positions[1] - p.positions[0], e2 = p.positions[2] - p.positions[0];
  const glm::dvec3 n = glm::normalize(glm::cross(e1, e2));
  const glm::dvec3 t = glm::normalize(e1 + 0.3 * e2), b = glm::cross(n, t) * double(handedness);
  p.tex_coords.resize(2);
  for (const glm::vec3& position : p.positions) {
    p.tex_coords[0].emplace_back(glm::dot(t, glm::dvec3(position)), glm::dot(b, glm::dvec3(position)));
    p.tex_coords[1].emplace_back(0.0f);
    p.tangents.emplace_back(glm::vec3(t), handedness);
    p.colors.emplace_back(1.0f);
    if (normals) p.normals.emplace_back(n);
  }
  return p;
}

// From both sides and under every transform: normals face the viewer and stand on the plane; tangent and bitangent run
// along u and v in front, and the whole frame is turned round for the back, so that what a normal map says there is the
// reverse of the front.
TEST(SetUpAttributesOfOne, FramesUnderTransforms) {
  for (const Placement& placement : Placements()) {
    for (bool with_normals : {true, false}) {
      for (float handedness : {1.0f, -1.0f}) {
        const Primitive p = TexturedTriangle(with_normals, handedness);
        Drawable placed;
        placed.geometry = &p;
        placed.world_from_mesh = placement.matrix;
        for (bool from_behind : {false, true}) {
          const glm::dquat turn = from_behind ? glm::dquat(0, 0, 1, 0) : glm::dquat(1, 0, 0, 0);
          const glm::dvec3 eye(0.1, -0.2, from_behind ? -10.0 : 0.0);
          const FrameView view = MakeFrameView(CameraAt(eye, turn, false), 64, 64);
          glm::dvec3 world[3];
          for (std::size_t i = 0; i < 3; ++i) world[i] = glm::dvec3(placement.matrix * glm::dvec4(p.positions[i], 1.0));
          const glm::dvec3 e1 = world[1] - world[0], e2 = world[2] - world[0];
          // Counter-clockwise in the mesh is the front; a mirror turns it round.
          glm::dvec3 front = glm::normalize(glm::cross(e1, e2)) * (placement.mirrored ? -1.0 : 1.0);
          const glm::dvec3 toward_eye = glm::normalize(eye - (world[0] + world[1] + world[2]) / 3.0);
          ScreenTriangle record{};
          record.back_facing = glm::dot(front, toward_eye) < 0.0;
          const double side = record.back_facing ? -1.0 : 1.0;
          const Attributes s = Interpolate(view, placed, ReadsEverything(), record, {{32.5, 32.5}})[0];
          EXPECT_GT(glm::dot(s.normal, toward_eye), 0.0);
          EXPECT_LT(glm::length(s.normal - front * side), 1e-5);
          EXPECT_NEAR(glm::length(s.normal), 1.0, 1e-5);
          // Derivatives of position by the texture, in the plane.
          const glm::dvec2 d1 = p.tex_coords[0][1] - p.tex_coords[0][0], d2 = p.tex_coords[0][2] - p.tex_coords[0][0];
          const double det = d1.x * d2.y - d1.y * d2.x;
          const glm::dvec3 along_u = (e1 * d2.y - e2 * d1.y) / det, along_v = (e2 * d1.x - e1 * d2.x) / det;
          const glm::dvec3 bitangent = glm::cross(s.interpolated_normal, s.tangent) * s.handedness;
          EXPECT_LT(glm::length(s.tangent - glm::normalize(along_u) * side), 1e-4) << "tangent";
          EXPECT_GT(glm::dot(bitangent, along_v) * side, 0.0)
              << "bitangent, mirrored " << placement.mirrored << " behind " << record.back_facing << " w "
              << handedness;
          EXPECT_NEAR(std::fabs(s.handedness), 1.0, 1e-6);
        }
      }
    }
  }
}

// --- Lines and points
// ------------------------------------------------------------------------------------------------------

TEST(SetUpAttributesOfOne, LinesInterpolateBetweenTheirEndsInPerspective) {
  const int size = 64;
  const FrameView view = MakeFrameView(CameraAt({0, 0, 0}, {1, 0, 0, 0}, false), size, size);
  Primitive p;
  p.topology = Topology::Lines;
  p.positions = {{-0.9f, -0.3f, -2.0f}, {3.0f, 1.5f, -8.0f}};
  p.tex_coords = {{{0, 5}, {1, 7}}, {{0, 0}, {0, 0}}};
  p.colors = {{0, 0, 0, 1}, {1, 1, 1, 0}};
  p.normals.assign(2, glm::vec3(0, 0, 1));
  p.tangents.assign(2, glm::vec4(1, 0, 0, 1));
  Drawable placed;
  placed.geometry = &p;
  ScreenTriangle record{};
  record.kind = ScreenTriangleKind::Line;
  const double focal = size * 0.5 / std::tan(0.5);
  const auto project = [&](const glm::dvec3& v) {
    return glm::dvec2(size * 0.5 + focal * v.x / -v.z, size * 0.5 - focal * v.y / -v.z);
  };
  const glm::dvec2 a = project(p.positions[0]), b = project(p.positions[1]);
  const glm::dvec2 across = glm::normalize(glm::dvec2(-(b - a).y, (b - a).x));
  for (double s : {0.02, 0.25, 0.5, 0.75, 0.98}) {  // share along the line in space
    for (double off : {-0.49, 0.0, 0.3}) {          // pixels beside it: within its width
      const glm::dvec3 point = glm::mix(glm::dvec3(p.positions[0]), glm::dvec3(p.positions[1]), s);
      const Attributes got = Interpolate(view, placed, ReadsEverything(), record, {project(point) + across * off})[0];
      EXPECT_NEAR(got.uv[1].x, s, 1e-4) << off;
      EXPECT_NEAR(got.uv[1].y, 5 + 2 * s, 2e-4);
      EXPECT_NEAR(got.color.r, s, 1e-4);
      EXPECT_NEAR(got.color.a, 1 - s, 1e-4);
      EXPECT_LT(glm::length(got.position - point), 1e-3);
    }
  }
}

TEST(SetUpAttributesOfOne, PointsHaveTheNumbersOfTheirVertex) {
  const FrameView view = MakeFrameView(CameraAt({0, 0, 0}, {1, 0, 0, 0}, false), 64, 64);
  Primitive p;
  p.topology = Topology::Points;
  p.positions = {{0, 0, -5}, {0.1f, 0.2f, -2.0f}};
  p.tex_coords = {{{9, 9}, {0.25f, 0.75f}}, {{0, 0}, {0, 0}}};
  p.colors = {{9, 9, 9, 9}, {0.1f, 0.2f, 0.3f, 0.4f}};
  p.normals.assign(2, glm::vec3(0, 0, 1));
  p.tangents.assign(2, glm::vec4(1, 0, 0, 1));
  Drawable placed;
  placed.geometry = &p;
  ScreenTriangle record{};
  record.kind = ScreenTriangleKind::Point;
  record.primitive = 1;
  for (const glm::dvec2 at : {glm::dvec2(33.5, 28.5), glm::dvec2(10.5, 60.5)}) {
    const Attributes got = Interpolate(view, placed, ReadsEverything(), record, {at})[0];
    EXPECT_EQ(got.uv[1], glm::dvec2(0.25, 0.75));
    EXPECT_EQ(got.color, glm::dvec4(glm::vec4(0.1f, 0.2f, 0.3f, 0.4f)));
    EXPECT_EQ(got.duv_dx[1], glm::dvec2(0.0));
    EXPECT_EQ(got.position, glm::dvec3(glm::vec3(0.1f, 0.2f, -2.0f)));
  }
}

TEST(SetUpAttributesOfOne, DegenerateTrianglesStayFinite) {
  Uniform random(35);
  const FrameView view = MakeFrameView(CameraAt({0, 0, 0}, {1, 0, 0, 0}, false), 64, 64);
  const glm::vec3 shapes[][3] = {
      {{0, 0, -3}, {0, 0, -3}, {0, 0, -3}},
      {{0, 0, -3}, {1, 1, -3}, {2, 2, -3}},
      {{0, 0, -3}, {0, 0, -4}, {0, 0, -5}},  // along the ray
      {{1e-38f, 0, -3}, {0, 1e-38f, -3}, {0, 0, -3}},
      {{1e30f, 0, -3}, {0, 1e30f, -3}, {0, 0, -1e30f}},
      {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}},  // through the eye
  };
  for (const auto& shape : shapes) {
    Primitive p = RandomTriangle(random);
    p.positions.assign(shape, shape + 3);
    p.normals.clear();
    Drawable placed;
    placed.geometry = &p;
    const Attributes got = Interpolate(view, placed, ReadsEverything(), ScreenTriangle{}, {{32.5, 32.5}})[0];
    for (int c = 0; c < 3; ++c) {
      EXPECT_TRUE(std::isfinite(got.position[c]));
      EXPECT_TRUE(std::isfinite(got.normal[c]));
      EXPECT_TRUE(std::isfinite(got.view[c]));
    }
    for (int k = 0; k < 2; ++k) EXPECT_TRUE(std::isfinite(got.uv[k].x) && std::isfinite(got.duv_dx[k].x));
  }
}

}  // namespace
}  // namespace facet
#endif
