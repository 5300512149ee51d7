#include "scene/tangents.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>
#include <tuple>

#include "scene_helpers.h"

namespace facet {
namespace {

// A square of two triangles in the plane z = 0; `uv` gives each corner its UV.
template <class F>
Primitive Square(const F& uv) {
  Primitive square;
  square.positions = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}};
  square.normals.assign(4, {0, 0, 1});
  square.indices = {0, 1, 2, 0, 2, 3};
  square.tex_coords.resize(1);
  for (const glm::vec3& p : square.positions) square.tex_coords[0].push_back(uv(p));
  return square;
}

// Of a map that KHR_texture_transform turns, mirrors, moves or stretches: the tangents of the same surface whose UVs
// are written out as the map reads them.
TEST(Tangents, FollowTheTextureTransform) {
  Primitive surface;
  surface.topology = Topology::Triangles;
  for (int i = 0; i < 16; ++i) {
    const float u = float(i % 4) / 3.0f, v = float(i / 4) / 3.0f;
    surface.positions.push_back({u + 0.1f * v, v, 0.3f * u * v});
    surface.normals.push_back(glm::normalize(glm::vec3(-v, -u, 3)));
    surface.tex_coords.resize(2);
    surface.tex_coords[0].push_back({9, 9});
    surface.tex_coords[1].push_back({u + 0.2f * v * v, v - 0.1f * u});
  }
  for (std::uint32_t y = 0; y < 3; ++y) {
    for (std::uint32_t x = 0; x < 3; ++x) {
      const std::uint32_t i = 4 * y + x;
      surface.indices.insert(surface.indices.end(), {i, i + 1, i + 4, i + 1, i + 5, i + 4});
    }
  }
  for (const glm::vec2 scale :
       {glm::vec2(1, 1), glm::vec2(3, 0.5f), glm::vec2(-1, 1), glm::vec2(2, -2), glm::vec2(-1, -1)}) {
    for (const float rotation : {0.0f, 0.4f, 1.5707963f, 3.1415927f, -2.0f}) {
      const TextureRef map{0, 1, {0.25f, -3.0f}, scale, rotation};
      Primitive transformed = surface, baked = surface;
      const double c = std::cos(double(rotation)), s = std::sin(double(rotation));
      for (glm::vec2& uv : baked.tex_coords[1]) {
        const glm::dvec2 scaled = glm::dvec2(scale) * glm::dvec2(uv);
        uv = glm::vec2(glm::dvec2(map.offset) + glm::dvec2(c * scaled.x + s * scaled.y, c * scaled.y - s * scaled.x));
      }
      MakeTangents(map, transformed);
      MakeTangents(TextureRef{0, 1}, baked);
      ASSERT_EQ(transformed.tangents.size(), baked.tangents.size());
      for (std::size_t i = 0; i < baked.tangents.size(); ++i) {
        EXPECT_EQ(transformed.tangents[i].w, baked.tangents[i].w);
        EXPECT_LT(glm::length(glm::vec3(transformed.tangents[i]) - glm::vec3(baked.tangents[i])), 1e-5f) << rotation;
      }
      EXPECT_EQ(transformed.tex_coords[1], surface.tex_coords[1]) << "the texture reader transforms them";
    }
  }
}

// What neither turns nor mirrors keeps every bit.
TEST(Tangents, AreNotTouchedByMovingAndStretching) {
  Primitive plain;
  plain.positions = {{0, 0, 0}, {1, 0.3f, 0}, {0.1f, 1, 0.7f}};
  plain.normals.assign(3, glm::normalize(glm::vec3(0.1f, 0.2f, 1)));
  plain.tex_coords = {{{0.1f, 0.2f}, {0.9f, 0.3f}, {0.4f, 0.7f}}};
  Primitive moved = plain;
  MakeTangents(TextureRef(), plain);
  MakeTangents(TextureRef{0, 0, {5, 7}, {0.3f, 0.3f}, 0.0f}, moved);
  EXPECT_EQ(moved.tangents, plain.tangents);
}

TEST(Tangents, FollowRotatedUvs) {
  for (const double angle : {0.0, 0.3, 1.0, 2.0, 3.0, -1.2}) {
    const float c = float(std::cos(angle)), s = float(std::sin(angle));
    // u along (c, s), v down the perpendicular: an image laid upright on the turned square.
    Primitive square = Square([&](const glm::vec3& p) { return glm::vec2(c * p.x + s * p.y, s * p.x - c * p.y); });
    MakeTangents(TextureRef(), square);
    ASSERT_EQ(square.tangents.size(), 4u);
    for (const glm::vec4& tangent : square.tangents) {
      EXPECT_LT(Distance(glm::dvec3(tangent), {c, s, 0}), 1e-6);
      EXPECT_EQ(tangent.w, 1.0f) << "bitangent = cross(n, t) points up the picture";
    }
  }
}

TEST(Tangents, MirroredUvsTurnTheSign) {
  Primitive square = Square([](const glm::vec3& p) { return glm::vec2(-p.x, -p.y); });
  MakeTangents(TextureRef(), square);
  for (const glm::vec4& tangent : square.tangents) EXPECT_EQ(tangent, glm::vec4(-1, 0, 0, -1));
}

// Two squares side by side share an edge's vertices; the UVs of the right one run back: the vertices must be split.
TEST(Tangents, MirrorSeamsSplitVertices) {
  Primitive seam;
  seam.positions = {{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {0, 1, 0}, {1, 1, 0}, {2, 1, 0}};
  seam.normals.assign(6, {0, 0, 1});
  seam.tex_coords = {{{0, 1}, {1, 1}, {0, 1}, {0, 0}, {1, 0}, {0, 0}}};
  seam.colors = {{0, 0, 0, 1}, {0.1f, 0, 0, 1}, {0.2f, 0, 0, 1}, {0.3f, 0, 0, 1}, {0.4f, 0, 0, 1}, {0.5f, 0, 0, 1}};
  seam.indices = {0, 1, 4, 0, 4, 3, 1, 2, 5, 1, 5, 4};
  const Primitive before = seam;
  MakeTangents(TextureRef(), seam);
  ASSERT_EQ(seam.positions.size(), 8u);
  ASSERT_EQ(seam.tangents.size(), 8u);
  ASSERT_EQ(seam.indices.size(), 12u);
  for (std::size_t c = 0; c < 12; ++c) {
    const std::uint32_t v = seam.indices[c];
    EXPECT_EQ(seam.positions[v], before.positions[before.indices[c]]);
    EXPECT_EQ(seam.tex_coords[0][v], before.tex_coords[0][before.indices[c]]);
    EXPECT_EQ(seam.colors[v], before.colors[before.indices[c]]);
    EXPECT_EQ(seam.tangents[v], c < 6 ? glm::vec4(1, 0, 0, 1) : glm::vec4(-1, 0, 0, -1));
  }
}

// Vertices that a file repeats for each face are one point to the algorithm.
TEST(Tangents, RepeatedVerticesAreWelded) {
  const auto bulge = [](const glm::vec3& p) { return glm::vec2(p.x + 0.2f * p.x * p.y, 1 - p.y); };
  Primitive shared = Square(bulge), repeated = shared;
  for (std::size_t c = 0; c < 6; ++c) {
    if (c == 0) repeated = Primitive();
    repeated.positions.push_back(shared.positions[shared.indices[c]]);
    repeated.normals.push_back({0, 0, 1});
    repeated.tex_coords.resize(1);
    repeated.tex_coords[0].push_back(shared.tex_coords[0][shared.indices[c]]);
  }
  const std::vector<std::uint32_t> indices = shared.indices;
  MakeTangents(TextureRef(), shared);
  MakeTangents(TextureRef(), repeated);
  ASSERT_EQ(repeated.tangents.size(), 6u);
  for (std::size_t c = 0; c < 6; ++c) EXPECT_EQ(repeated.tangents[repeated.indices[c]], shared.tangents[indices[c]]);
}

// The average is weighted by the angle at the corner, in the plane of the normal.
TEST(Tangents, AreWeightedByAngle) {
  Primitive fan;  // two triangles at the origin: 90 degrees with u along +x, 45 degrees with u along another direction
  fan.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {-1, 1, 0}};
  fan.normals.assign(4, {0, 0, 1});
  fan.indices = {0, 1, 2, 0, 2, 3};
  fan.tex_coords = {{{0, 0}, {1, 0}, {0, -1}, {-0.5f, -1.5f}}};
  MakeTangents(TextureRef(), fan);
  // First triangle: dP/du = +x. Second: its edges (0, 1) and (-1, 1) are (0, -1) and (-0.5, -1.5) in UV space: dP/du =
  // (2, 1), dP/dv = (0, -1).
  const glm::dvec3 expected = glm::normalize(kTestPi / 2 * glm::dvec3(1, 0, 0) +
                                             kTestPi / 4 * glm::normalize(glm::dvec3(2, 1, 0)));
  EXPECT_LT(Distance(glm::dvec3(fan.tangents[0]), expected), 1e-6);
  EXPECT_LT(Distance(glm::dvec3(fan.tangents[1]), {1, 0, 0}), 1e-6) << "not touched by the second triangle";
}

// On a sphere with u along the longitude the tangent is the direction of the parallel.
TEST(Tangents, OnASphereRunAlongTheParallels) {
  constexpr int kColumns = 96, kRows = 48;
  Primitive sphere;
  sphere.tex_coords.resize(1);
  for (int row = 0; row <= kRows; ++row) {
    for (int column = 0; column <= kColumns; ++column) {
      const double u = double(column) / kColumns, v = double(row) / kRows;
      const double longitude = 2 * kTestPi * u, polar = kTestPi * v;
      const glm::dvec3 p(std::sin(polar) * std::sin(longitude), std::cos(polar), std::sin(polar) * std::cos(longitude));
      sphere.positions.push_back(glm::vec3(p));
      sphere.normals.push_back(glm::vec3(p));
      sphere.tex_coords[0].push_back({float(u), float(v)});
    }
  }
  for (std::uint32_t row = 0; row < kRows; ++row) {
    for (std::uint32_t column = 0; column < kColumns; ++column) {
      const std::uint32_t a = row * (kColumns + 1) + column, b = a + kColumns + 1;
      sphere.indices.insert(sphere.indices.end(), {a, b, b + 1, a, b + 1, a + 1});
    }
  }
  MakeTangents(TextureRef(), sphere);
  for (std::size_t i = 0; i < sphere.positions.size(); ++i) {
    const glm::dvec3 p(sphere.positions[i]), t(sphere.tangents[i]);
    EXPECT_NEAR(glm::length(t), 1.0, 1e-6);
    EXPECT_NEAR(glm::dot(t, p), 0.0, 1e-6);
    if (std::fabs(p.y) > 0.95) continue;  // the triangles at the poles are slivers
    EXPECT_EQ(sphere.tangents[i].w, 1.0f);
    EXPECT_GT(glm::dot(t, glm::normalize(glm::dvec3(p.z, 0, -p.x))), std::cos(0.04)) << i;
  }
}

TEST(Tangents, TrianglesWithoutUvAreaFollowTheirNeighbours) {
  Primitive square = Square([](const glm::vec3& p) { return glm::vec2(p.x, 1 - p.y); });
  square.tex_coords[0][3] = square.tex_coords[0][0];  // the second triangle collapses
  MakeTangents(TextureRef(), square);
  for (std::size_t c = 0; c < 6; ++c) {
    const glm::vec4 tangent = square.tangents[square.indices[c]];
    if (c != 5) {
      EXPECT_EQ(tangent, square.tangents[square.indices[0]]) << c;
    }
    EXPECT_NEAR(glm::length(glm::dvec3(tangent)), 1.0, 1e-6);
  }
}

TEST(Tangents, DegenerateTrianglesTakeTheirVertexsTangent) {
  Primitive square = Square([](const glm::vec3& p) { return glm::vec2(p.x, 1 - p.y); });
  square.indices.insert(square.indices.begin(), {1, 1, 2});
  MakeTangents(TextureRef(), square);
  ASSERT_EQ(square.positions.size(), 4u) << "nothing to split";
  for (const glm::vec4& tangent : square.tangents) EXPECT_EQ(tangent, glm::vec4(1, 0, 0, 1));
}

TEST(Tangents, WithoutUvsArePerpendicularToTheNormal) {
  std::mt19937 random(3);
  std::uniform_real_distribution<float> uniform(-1.0f, 1.0f);
  Primitive primitive;
  for (int i = 0; i < 300; ++i) {
    primitive.positions.push_back({uniform(random), uniform(random), uniform(random)});
    primitive.normals.push_back(glm::normalize(glm::vec3(uniform(random), uniform(random), uniform(random))));
  }
  primitive.normals[0] = {0, 0, -1};
  primitive.normals[1] = {0, 0, 1};
  MakeTangents(TextureRef(), primitive);
  for (std::size_t i = 0; i < 300; ++i) {
    const glm::dvec3 t(primitive.tangents[i]);
    EXPECT_NEAR(glm::length(t), 1.0, 1e-6);
    EXPECT_NEAR(glm::dot(t, glm::dvec3(primitive.normals[i])), 0.0, 1e-6);
  }
}

// As many tangents around one vertex as triangles: what is quadratic in them outlasts the time limit of a test.
TEST(Tangents, AVertexOfManyTriangles) {
  constexpr std::uint32_t kTriangles = 800000;
  std::mt19937 random(5);
  std::uniform_real_distribution<float> uniform(-1.0f, 1.0f);
  Primitive star;
  star.tex_coords.resize(1);
  const auto add = [&](const glm::vec3& p) {
    star.positions.push_back(p);
    star.normals.push_back({0, 0, 1});
    star.tex_coords[0].push_back({uniform(random), uniform(random)});
  };
  add({0, 0, 0});
  for (std::uint32_t t = 0; t < kTriangles; ++t) {
    const double angle = 2 * kTestPi * t / kTriangles;
    add({float(std::cos(angle)), float(std::sin(angle)), 0});
    add({float(std::cos(angle + 1e-3)), float(std::sin(angle + 1e-3)), 0});
    star.indices.insert(star.indices.end(), {0, 2 * t + 1, 2 * t + 2});
  }
  const Primitive before = star;
  MakeTangents(TextureRef(), star);
  ASSERT_EQ(star.indices.size(), before.indices.size());
  EXPECT_GT(star.positions.size(), before.positions.size() + kTriangles / 4) << "the middle is split";
  // No two copies of the middle are alike, and each triangle's three corners have the one tangent that it asks for.
  std::vector<glm::vec4> middle(star.tangents.begin() + std::ptrdiff_t(before.positions.size()), star.tangents.end());
  middle.push_back(star.tangents[0]);
  const auto less = [](const glm::vec4& a, const glm::vec4& b) {
    return std::tie(a.x, a.y, a.z, a.w) < std::tie(b.x, b.y, b.z, b.w);
  };
  std::sort(middle.begin(), middle.end(), less);
  EXPECT_EQ(std::adjacent_find(middle.begin(), middle.end()), middle.end());
  for (std::size_t c = 0; c < star.indices.size(); c += 3) {
    ASSERT_EQ(star.positions[star.indices[c]], glm::vec3(0));
    ASSERT_EQ(star.tangents[star.indices[c]], star.tangents[star.indices[c + 1]]) << c;
  }
}

// Copies come in the order of the corners that ask for them, and each is made once.
TEST(Tangents, CornersThatAgreeShareACopy) {
  Primitive fans;  // four separate triangles at the origin: u along +x, +y, +x, +y
  fans.tex_coords.resize(1);
  fans.positions = {{0, 0, 0}};
  fans.tex_coords[0] = {{0, 0}};
  for (std::uint32_t t = 0; t < 4; ++t) {
    const float x = t < 2 ? 1.0f : -1.0f, y = t == 0 || t == 3 ? 1.0f : -1.0f;
    const bool turned = t % 2 == 1;
    const bool forward = x * y > 0;  // counter-clockwise
    for (const bool along_x : {forward, !forward}) {  // a quadrant's triangle that touches none of the others
      const glm::vec3 q = along_x ? glm::vec3(x, 0.005f * y, 0) : glm::vec3(0.005f * x, y, 0);
      fans.positions.push_back(q);
      fans.tex_coords[0].push_back(turned ? glm::vec2(q.y, q.x) : glm::vec2(q.x, -q.y));
    }
    fans.indices.insert(fans.indices.end(), {0, 2 * t + 1, 2 * t + 2});
  }
  fans.normals.assign(9, {0, 0, 1});
  MakeTangents(TextureRef(), fans);
  ASSERT_EQ(fans.positions.size(), 10u);
  const std::uint32_t expected[4] = {0, 9, 0, 9};
  for (std::size_t t = 0; t < 4; ++t) EXPECT_EQ(fans.indices[3 * t], expected[t]) << t;
  EXPECT_LT(Distance(glm::dvec3(fans.tangents[0]), {1, 0, 0}), 1e-6);
  EXPECT_LT(Distance(glm::dvec3(fans.tangents[9]), {0, 1, 0}), 1e-6);
}

TEST(Tangents, AreUnitAndFiniteWhateverTheInput) {
  std::mt19937 random(4);
  const auto number = [&](int count) { return float(int(random() % unsigned(count))); };
  for (int trial = 0; trial < 200; ++trial) {
    Primitive soup;
    soup.tex_coords.resize(1);
    const std::uint32_t count = 3 + std::uint32_t(random() % 12);
    for (std::uint32_t i = 0; i < count; ++i) {
      soup.positions.push_back({number(3), number(3), number(2)});
      soup.normals.push_back({number(3) - 1, number(3) - 1, number(3) - 1});  // zero and unnormalised ones too
      soup.tex_coords[0].push_back({number(3), number(3)});
    }
    if (trial % 4 == 0) soup.positions[0].x = std::numeric_limits<float>::quiet_NaN();
    if (trial % 4 == 1) soup.tex_coords[0][0].x = std::numeric_limits<float>::infinity();
    for (int i = 0; i < 60; ++i) soup.indices.push_back(std::uint32_t(random() % count));
    MakeTangents(TextureRef(), soup);
    ASSERT_EQ(soup.tangents.size(), soup.positions.size());
    for (const glm::vec4& tangent : soup.tangents) {
      ASSERT_NEAR(glm::length(glm::dvec3(tangent)), 1.0, 1e-6);
      ASSERT_EQ(std::fabs(tangent.w), 1.0f);
    }
  }
}

}  // namespace
}  // namespace facet
