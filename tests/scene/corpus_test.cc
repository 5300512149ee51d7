// Poses of real files.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <string>

#include "base/parallel.h"
#include "facet/error.h"
#include "facet/load.h"
#include "scene/pose.h"
#include "scene/tangents.h"
#include "scene/topology.h"
#include "scene_helpers.h"

namespace facet {
namespace {

namespace fs = std::filesystem;

fs::path Corpus() {
  const char* root = std::getenv("FACET_CORPUS");
  return root != nullptr ? fs::path(root) : fs::path(FACET_SOURCE_DIR) / ".." / "shared" / "corpus";
}

class Corpora : public testing::Test {
 protected:
  void SetUp() override {
    if (!fs::exists(Corpus() / "models")) GTEST_SKIP() << "no test corpus at " << Corpus() << " (set FACET_CORPUS)";
  }
};

class CorpusPose : public Corpora {};
class CorpusTangents : public Corpora {};

Scene Load(const std::string& model) { return LoadGltf(Corpus() / "models" / model).scene; }

double LastKey(const Animation& animation) {
  double last = 0.0;
  for (const AnimationChannel& channel : animation.channels) {
    if (!channel.times.empty()) last = std::max(last, double(channel.times.back()));
  }
  return last;
}

template <class T>
bool FitsOrEmpty(const std::vector<T>& values, std::size_t count) { return values.empty() || values.size() == count; }

bool IsFinite(const glm::vec3& v) { return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z); }

// Everything that pose.h promises of a drawable.
void ExpectPromises(const Scene& scene, const PosedScene& posed) {
  for (const Drawable& drawable : posed.drawables) {
    ASSERT_NE(drawable.geometry, nullptr);
    const Primitive& geometry = *drawable.geometry;
    const std::size_t count = geometry.positions.size();
    EXPECT_TRUE(FitsOrEmpty(geometry.normals, count));
    EXPECT_TRUE(FitsOrEmpty(geometry.tangents, count));
    EXPECT_TRUE(FitsOrEmpty(geometry.colors, count));
    for (const auto& set : geometry.tex_coords) EXPECT_TRUE(FitsOrEmpty(set, count));
    for (const std::uint32_t index : geometry.indices) ASSERT_LT(index, count);
    for (const glm::vec3& p : geometry.positions) ASSERT_TRUE(IsFinite(p));
    for (const glm::vec3& n : geometry.normals) ASSERT_TRUE(IsFinite(n));
    for (const glm::vec4& t : geometry.tangents) ASSERT_EQ(std::fabs(t.w), 1.0f);
    const bool triangles = ClassOf(geometry.topology) == PrimitiveClass::Triangles;
    const Material material = drawable.material < 0 ? Material() : scene.materials[std::size_t(drawable.material)];
    const int normal_map = material.normal_texture.texture;
    if (triangles && material.model != ShadingModel::Unlit && normal_map >= 0 &&
        scene.textures[std::size_t(normal_map)].image >= 0) {
      EXPECT_EQ(geometry.normals.size(), count);
      EXPECT_EQ(geometry.tangents.size(), count);
    }
  }
}

template <class T>
bool SameBits(const std::vector<T>& a, const std::vector<T>& b) {
  return a.size() == b.size() && (a.empty() || std::memcmp(a.data(), b.data(), a.size() * sizeof(T)) == 0);
}

void ExpectSame(const PosedScene& a, const PosedScene& b) {
  ASSERT_EQ(a.drawables.size(), b.drawables.size());
  EXPECT_EQ(std::memcmp(&a.bounds.low, &b.bounds.low, 2 * sizeof(glm::dvec3)), 0);
  for (std::size_t i = 0; i < a.drawables.size(); ++i) {
    EXPECT_EQ(a.drawables[i].world_from_mesh, b.drawables[i].world_from_mesh);
    const Primitive &p = *a.drawables[i].geometry, &q = *b.drawables[i].geometry;
    EXPECT_TRUE(SameBits(p.positions, q.positions) && SameBits(p.normals, q.normals));
    EXPECT_TRUE(SameBits(p.tangents, q.tangents) && SameBits(p.indices, q.indices));
  }
}

// Rest pose and every animation at its ends, between and beyond.
void PoseAtManyMoments(const Scene& scene) {
  std::vector<PoseSettings> moments(1);
  for (int animation = 0; animation < int(scene.animations.size()); ++animation) {
    const double last = LastKey(scene.animations[std::size_t(animation)]);
    for (const double share : {-1.0, 0.0, 0.37, 1.0, 2.0}) {
      moments.push_back({.animation = animation, .time = share * last});
    }
  }
  for (const PoseSettings& moment : moments) {
    const PosedScene posed = Pose(scene, moment);
    ExpectPromises(scene, posed);
    const Bounds bounds = PosedBounds(scene, moment);
    EXPECT_EQ(bounds.empty, posed.bounds.empty);
    EXPECT_EQ(bounds.low, posed.bounds.low);
    EXPECT_EQ(bounds.high, posed.bounds.high);
  }
}

TEST_F(CorpusPose, EveryModelKeepsThePromises) {
  int loaded = 0;
  for (const char* folder : {"models", "asset-generator"}) {
    for (const auto& entry : fs::recursive_directory_iterator(Corpus() / folder)) {
      const std::string extension = entry.path().extension().string();
      if (extension != ".gltf" && extension != ".glb") continue;
      SCOPED_TRACE(entry.path().filename().string());
      LoadOptions options;
      options.ignore_required_extensions = true;
      Scene scene;
      try {
        scene = LoadGltf(entry.path(), options).scene;
      } catch (const Error& error) {
        continue;  // what loads is the loader's test
      }
      ++loaded;
      PoseAtManyMoments(scene);
      if (HasFatalFailure()) return;
    }
  }
  EXPECT_GT(loaded, 200);
}

TEST_F(CorpusPose, AnyNumberOfThreadsGivesTheSameBits) {
  for (const char* model : {"CesiumMan/CesiumMan.glb", "Fox/Fox.glb", "MorphStressTest/MorphStressTest.glb",
                            "DamagedHelmet/DamagedHelmet.glb", "QuadSkin-12Influences/quad_skin.glb"}) {
    SCOPED_TRACE(model);
    const Scene scene = Load(model);
    const PoseSettings settings{.animation = scene.animations.empty() ? -1 : 0, .time = 0.41};
    PosedScene reference;
    RunWithThreads(1, [&] { reference = Pose(scene, settings); });
    for (const int threads : {2, 3}) {
      PosedScene posed;
      RunWithThreads(threads, [&] { posed = Pose(scene, settings); });
      ExpectSame(posed, reference);
    }
  }
}

// From the glTF tutorial: a strip of height 2 whose upper joint, at (0, 1, 0), turns about Z; 90 degrees at 1 s.
TEST_F(CorpusPose, SimpleSkin) {
  const Scene scene = Load("SimpleSkin/SimpleSkin.gltf");
  const PosedScene rest = Pose(scene, {});
  EXPECT_LT(Distance(rest.bounds.low, {-0.5, 0, 0}), 1e-6);
  EXPECT_LT(Distance(rest.bounds.high, {0.5, 2, 0}), 1e-6);
  const PosedScene bent = Pose(scene, {.animation = 0, .time = 1.0});
  const Drawable& strip = bent.drawables[0];
  const auto& positions = scene.meshes[0].primitives[0].positions;
  for (std::size_t i = 0; i < positions.size(); ++i) {
    const glm::dvec3 p(positions[i]);
    const double w = double(scene.meshes[0].primitives[0].weights[0][i].y);
    const glm::dvec3 turned(-(p.y - 1), 1 + p.x, 0);
    EXPECT_LT(Distance(WorldPosition(strip, i), (1 - w) * p + w * turned), 1e-3) << i;
  }
}

// The file's mesh lies along its Z; the skeleton stands it up. Its height must survive.
TEST_F(CorpusPose, CesiumManStands) {
  const Bounds bounds = Pose(Load("CesiumMan/CesiumMan.glb"), {}).bounds;
  EXPECT_NEAR(bounds.high.y - bounds.low.y, 1.50655, 0.05);
  EXPECT_NEAR(bounds.low.y, 0.0, 0.03);
}

TEST_F(CorpusPose, RiggedSimpleBendsWithoutGrowing) {
  const Scene scene = Load("RiggedSimple/RiggedSimple.glb");
  const Bounds rest = Pose(scene, {}).bounds;
  const double length = glm::length(rest.high - rest.low);
  EXPECT_NEAR(std::max({rest.high.x - rest.low.x, rest.high.y - rest.low.y, rest.high.z - rest.low.z}), 9.15, 0.1);
  for (double time = 0.0; time < 2.1; time += 0.3) {
    const Bounds bounds = PosedBounds(scene, {.animation = 0, .time = time});
    EXPECT_LT(glm::length(bounds.high - bounds.low), 1.1 * length);
    EXPECT_GT(glm::length(bounds.high - bounds.low), 0.5 * length);
  }
}

TEST_F(CorpusPose, AnimatedMorphCubeFollowsItsKeys) {
  const Scene scene = Load("AnimatedMorphCube/AnimatedMorphCube.glb");
  const Primitive& cube = scene.meshes[0].primitives[0];
  const AnimationChannel& channel = scene.animations[0].channels[0];
  ASSERT_EQ(channel.path, AnimationPath::Weights);
  ASSERT_EQ(cube.targets.size(), 2u);
  double largest = 0.0;
  for (std::size_t key = 0; key < channel.times.size(); ++key) {
    const PosedScene posed = Pose(scene, {.animation = 0, .time = double(channel.times[key])});
    const Primitive& made = *posed.drawables[0].geometry;
    for (std::size_t i = 0; i < cube.positions.size(); ++i) {
      const glm::vec3 moved = channel.values[2 * key] * cube.targets[0].positions[i] +
                              channel.values[2 * key + 1] * cube.targets[1].positions[i];
      ASSERT_LT(glm::length(made.positions[i] - (cube.positions[i] + moved)), 1e-8f);
      largest = std::max(largest, double(glm::length(moved)));
    }
  }
  EXPECT_GT(largest, 0.005) << "half the cube's half side";
}

// A square of half side 1; all its joints scale by 100 and no more.
TEST_F(CorpusPose, QuadSkinTakesTwelveInfluences) {
  const Scene scene = Load("QuadSkin-12Influences/quad_skin.glb");
  ASSERT_EQ(scene.meshes[0].primitives[0].joints.size(), 3u);
  const PosedScene posed = Pose(scene, {});
  EXPECT_NEAR(glm::length(posed.bounds.high - posed.bounds.low), 200 * std::sqrt(2.0), 1e-3);
  EXPECT_FALSE(posed.owned.empty());
}

// Angles in degrees between the file's own tangents and ours, by corner, sorted; and how many signs differ.
struct Difference {
  std::vector<double> degrees;
  std::size_t wrong_signs = 0;
};

Difference CompareWithFile(const std::string& model) {
  Difference difference;
  for (const Mesh& mesh : Load(model).meshes) {
    for (const Primitive& primitive : mesh.primitives) {
      if (primitive.tangents.empty() || primitive.topology != Topology::Triangles) continue;
      Primitive made = primitive;
      made.tangents.clear();
      MakeTangents(TextureRef(), made);
      for (std::size_t c = 0; c < made.indices.size(); ++c) {
        const glm::dvec4 a(made.tangents[made.indices[c]]);
        const glm::dvec4 b(primitive.tangents[primitive.indices.empty() ? c : primitive.indices[c]]);
        const double sine = glm::length(glm::cross(glm::dvec3(a), glm::dvec3(b)));
        difference.degrees.push_back(std::atan2(sine, glm::dot(glm::dvec3(a), glm::dvec3(b))) * 180 / kTestPi);
        if (a.w != b.w) ++difference.wrong_signs;
      }
    }
  }
  std::sort(difference.degrees.begin(), difference.degrees.end());
  return difference;
}

// Baked by MikkTSpace itself: the mirror test to the last digit.
TEST_F(CorpusTangents, AgreeWithMikkTSpace) {
  for (const char* model : {"NormalTangentMirrorTest/NormalTangentMirrorTest.glb",
                            "AnisotropyStrengthTest/AnisotropyStrengthTest.glb"}) {
    SCOPED_TRACE(model);
    const Difference difference = CompareWithFile(model);
    ASSERT_GT(difference.degrees.size(), 1000u);
    EXPECT_EQ(difference.wrong_signs, 0u);
    EXPECT_LT(difference.degrees.back(), 0.01);
  }
}

// Made by other tools, or before the vertices were rounded. (TwoSidedPlane is left out: its signs are those of a v that
// points up, against the specification.)
TEST_F(CorpusTangents, AreCloseToThoseOfOtherTools) {
  for (const char* model : {"BoomBox/BoomBox.gltf", "SheenCloth/SheenCloth.gltf"}) {
    SCOPED_TRACE(model);
    const Difference difference = CompareWithFile(model);
    ASSERT_FALSE(difference.degrees.empty());
    EXPECT_EQ(difference.wrong_signs, 0u);
    EXPECT_LT(difference.degrees[difference.degrees.size() / 2], 0.5);
  }
}

}  // namespace
}  // namespace facet
