#include <gtest/gtest.h>

#include "gltf_files.h"

namespace facet {
namespace {

using testing::FileMaker;
using testing::LoadBytes;
using testing::LoadError;
using testing::Pack;

// A file with one animation of one channel; `times` and `values` are accessors made by the caller.
std::string Animated(FileMaker& file, int times, int values, const std::string& path,
                     const std::string& interpolation) {
  file.RootMore() +=
      ",\"animations\":[{\"name\":\"a\",\"channels\":[{\"sampler\":0,\"target\":{\"node\":0,\"path\":\"" + path +
      "\"}}],\"samplers\":[{\"input\":" + std::to_string(times) + ",\"output\":" + std::to_string(values) +
      (interpolation.empty() ? "" : ",\"interpolation\":\"" + interpolation + "\"") + "}]}]";
  return file.AsGlb();
}

const AnimationChannel& First(const LoadedScene& loaded) { return loaded.scene.animations.at(0).channels.at(0); }

TEST(Animation, PathsAndInterpolations) {
  FileMaker file;
  file.Attribute("POSITION", file.Triangle());
  const int times = file.Floats({0, 2}, "SCALAR", 1);
  const int values = file.Floats({1, 2, 3, 4, 5, 6}, "VEC3", 3);
  const LoadedScene loaded = LoadBytes(Animated(file, times, values, "translation", ""));
  EXPECT_EQ(loaded.scene.animations[0].name, "a");
  EXPECT_EQ(First(loaded).path, AnimationPath::Translation);
  EXPECT_EQ(First(loaded).interpolation, Interpolation::Linear);
  EXPECT_EQ(First(loaded).times, (std::vector<float>{0, 2}));
  EXPECT_EQ(First(loaded).values, (std::vector<float>{1, 2, 3, 4, 5, 6}));

  FileMaker cubic;
  cubic.Attribute("POSITION", cubic.Triangle());
  const int cubic_times = cubic.Floats({0, 2}, "SCALAR", 1);
  const int cubic_values = cubic.Floats({0, 0, 0, 1, 1, 1, 2, 2, 2, 3, 3, 3, 4, 4, 4, 5, 5, 5}, "VEC3", 3);
  const LoadedScene loaded_cubic = LoadBytes(Animated(cubic, cubic_times, cubic_values, "scale", "CUBICSPLINE"));
  EXPECT_EQ(First(loaded_cubic).interpolation, Interpolation::CubicSpline);
  EXPECT_EQ(First(loaded_cubic).path, AnimationPath::Scale);
  EXPECT_EQ(First(loaded_cubic).values.size(), 18u);
}

TEST(Animation, NormalizedRotations) {
  for (const auto& [type, bytes, unit] :
       {std::tuple<int, std::string, float>{5120, Pack<std::int8_t>({-128, 0, 0, 127}), 127.0f},
        {5121, Pack<std::uint8_t>({0, 0, 0, 255}), 255.0f},
        {5122, Pack<std::int16_t>({-32768, 0, 0, 32767}), 32767.0f},
        {5123, Pack<std::uint16_t>({0, 0, 0, 65535}), 65535.0f}}) {
    FileMaker file;
    file.Attribute("POSITION", file.Triangle());
    const int times = file.Floats({0}, "SCALAR", 1);
    const int values = file.Accessor(file.View(bytes), type, 1, "VEC4", ",\"normalized\":true");
    const LoadedScene loaded = LoadBytes(Animated(file, times, values, "rotation", "STEP"));
    EXPECT_EQ(First(loaded).interpolation, Interpolation::Step);
    EXPECT_EQ(First(loaded).values[3], 1.0f) << type;
    EXPECT_EQ(First(loaded).values[0], type == 5120 || type == 5122 ? -1.0f : 0.0f) << type;
  }
}

TEST(Animation, MorphWeightsHaveOneNumberForEachTarget) {
  FileMaker file;
  const int triangle = file.Triangle();
  file.Attribute("POSITION", triangle);
  file.PrimitiveMore() = ",\"targets\":[{\"POSITION\":0},{\"POSITION\":0}]";
  const int times = file.Floats({0, 1, 2}, "SCALAR", 1);
  const int values =
      file.Accessor(file.View(Pack<std::uint8_t>({0, 255, 51, 0, 255, 0})), 5121, 6, "SCALAR", ",\"normalized\":true");
  const LoadedScene loaded = LoadBytes(Animated(file, times, values, "weights", "LINEAR"));
  EXPECT_EQ(First(loaded).values, (std::vector<float>{0, 1, 51.0f / 255.0f, 0, 1, 0}));
}

void ExpectIgnored(const std::string& file) {
  const LoadedScene loaded = LoadBytes(file);
  EXPECT_TRUE(loaded.scene.animations.at(0).channels.empty());
  ASSERT_EQ(loaded.report.warnings.size(), 1u);
  EXPECT_EQ(loaded.report.warnings[0].rfind("animations[0].channels[0]: ignored (animations[0].samplers[0]", 0), 0u)
      << loaded.report.warnings[0];
}

TEST(Animation, ChannelsOfWrongSizesAndTypesAreIgnored) {
  {
    FileMaker file;
    file.Attribute("POSITION", file.Triangle());
    const int times = file.Floats({0, 1, 2}, "SCALAR", 1);
    ExpectIgnored(Animated(file, times, file.Floats({1, 2, 3, 4, 5, 6}, "VEC3", 3), "translation", ""));
  }
  {
    FileMaker file;
    file.Attribute("POSITION", file.Triangle());
    const int times = file.Floats({0, 1}, "SCALAR", 1);
    ExpectIgnored(Animated(file, times, file.Floats({1, 2, 3, 4, 5, 6}, "VEC3", 3), "rotation", ""));
  }
  {
    FileMaker file;
    file.Attribute("POSITION", file.Triangle());
    const int times = file.Floats({0, 1, 2, 3}, "VEC2", 2);
    ExpectIgnored(Animated(file, times, file.Floats({1, 2, 3, 4, 5, 6}, "VEC3", 3), "scale", ""));
  }
  {
    FileMaker file;  // a cubic spline needs three values for each key
    file.Attribute("POSITION", file.Triangle());
    const int times = file.Floats({0, 1}, "SCALAR", 1);
    ExpectIgnored(Animated(file, times, file.Floats({1, 2, 3, 4, 5, 6}, "VEC3", 3), "scale", "CUBICSPLINE"));
  }
  {
    FileMaker file;  // of no keys
    file.Attribute("POSITION", file.Triangle());
    const int times = file.Accessor(-1, 5126, 0, "SCALAR");
    ExpectIgnored(Animated(file, times, file.Floats({1, 2, 3, 4, 5, 6}, "VEC3", 3), "scale", ""));
  }
}

TEST(Animation, KeysWhoseTimesDecreaseAreDropped) {
  FileMaker file;
  file.Attribute("POSITION", file.Triangle());
  const int times = file.Floats({0, 1, 1, 0.5f, 2}, "SCALAR", 1);
  const int values = file.Floats({0, 0, 0, 1, 1, 1, 2, 2, 2, 3, 3, 3, 4, 4, 4}, "VEC3", 3);
  const LoadedScene loaded = LoadBytes(Animated(file, times, values, "translation", ""));
  EXPECT_EQ(First(loaded).times, (std::vector<float>{0, 1, 1, 2})) << "two at one time make a jump";
  EXPECT_EQ(First(loaded).values, (std::vector<float>{0, 0, 0, 1, 1, 1, 2, 2, 2, 4, 4, 4}));
  EXPECT_EQ(loaded.report.warnings.size(), 2u);
}

TEST(Animation, TimesOfIntegersAndValuesTooManyAreRead) {
  FileMaker file;
  file.Attribute("POSITION", file.Triangle());
  const int times = file.Accessor(file.View(Pack<std::uint16_t>({0, 3})), 5123, 2, "SCALAR");
  const LoadedScene loaded =
      LoadBytes(Animated(file, times, file.Floats({1, 2, 3, 4, 5, 6, 7, 8, 9}, "VEC3", 3), "scale", ""));
  EXPECT_EQ(First(loaded).times, (std::vector<float>{0, 3}));
  EXPECT_EQ(First(loaded).values, (std::vector<float>{1, 2, 3, 4, 5, 6}));
  EXPECT_EQ(loaded.report.warnings.size(), 2u);
}

TEST(Animation, ChannelsThatMoveNothingAreIgnored) {
  FileMaker weights;
  weights.Attribute("POSITION", weights.Triangle());
  const int times = weights.Floats({0}, "SCALAR", 1);
  const LoadedScene loaded = LoadBytes(Animated(weights, times, times, "weights", ""));
  EXPECT_TRUE(loaded.scene.animations.at(0).channels.empty());
  EXPECT_EQ(loaded.report.warnings.size(), 1u);

  FileMaker matrix;
  matrix.Attribute("POSITION", matrix.Triangle());
  matrix.NodeMore() = ",\"matrix\":[1,0,0,0,0,1,0,0,0,0,1,0,0,0,0,1]";
  const int key = matrix.Floats({0}, "SCALAR", 1);
  const LoadedScene loaded_matrix = LoadBytes(Animated(matrix, key, matrix.Floats({1, 2, 3}, "VEC3", 3), "scale", ""));
  EXPECT_EQ(loaded_matrix.scene.animations.at(0).channels.size(), 1u) << "the matrix is taken apart";
  EXPECT_EQ(loaded_matrix.report.warnings.size(), 1u);
}

}  // namespace
}  // namespace facet
