// The reference's images: coverage, textures and blending in closed form; its error estimate, its bits, its bounds.
#include "reference/reference.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <cstring>
#include <limits>
#include <memory>

#include "facet/error.h"
#include "render/hand_built.h"

namespace facet {
namespace {

constexpr double kPi = 3.14159265358979324;

ReferenceSettings Effort(int samples, int environment_samples, int batches) {
  ReferenceSettings settings;
  settings.samples = samples;
  settings.environment_samples = environment_samples;
  settings.batches = batches;
  return settings;
}

// A lit scene with edges, a glossy and a rough ball and a see-through sheet.
Scene Balls() {
  Scene scene;
  Material gloss, rough;
  gloss.roughness_factor = 0.2f;
  gloss.base_color_factor = {0.9f, 0.6f, 0.3f, 1.0f};
  rough.metallic_factor = 0.0f;
  Transform left, right, front;
  left.translation.x = -0.6;
  right.translation.x = 0.6;
  front.translation.z = 1.0;
  Add(scene, Sphere(0.5f, 24, 48), AddMaterial(scene, gloss), left);
  Add(scene, Sphere(0.5f, 24, 48), AddMaterial(scene, rough), right);
  Add(scene, Rectangle(-0.3f, -0.4f, 0.3f, 0.9f), AddMaterial(scene, Unlit({0.2f, 0.3f, 0.9f, 0.5f}, AlphaMode::Blend)),
      front);
  return scene;
}

RenderSettings BallSettings(int size) {
  RenderSettings settings = Settings(size, size, 4, Perspective(0.5, {0, 0, 5}));
  settings.environment.kind = EnvironmentSettings::Kind::Studio;
  return settings;
}

double Rms(const ReferenceFilm& a, const ReferenceFilm& b) {
  double sum = 0.0;
  for (std::size_t i = 0; i < a.pixels.size(); ++i) {
    const glm::dvec3 d(a.pixels[i] - b.pixels[i]);
    sum += glm::dot(d, d);
  }
  return std::sqrt(sum / (3.0 * double(a.pixels.size())));
}

bool SameBits(const ReferenceFilm& a, const ReferenceFilm& b) {
  const auto same = [](const std::vector<glm::dvec4>& x, const std::vector<glm::dvec4>& y) {
    return x.size() == y.size() && std::memcmp(x.data(), y.data(), x.size() * sizeof(glm::dvec4)) == 0;
  };
  return same(a.pixels, b.pixels) && same(a.standard_error, b.standard_error);
}

TEST(Reference, CoverageIsTheSilhouettesArea) {
  Scene scene;
  Add(scene, Sphere(1.0f, 60, 120), AddMaterial(scene, Unlit({0.5f, 0.25f, 1.0f, 1.0f})));
  const ReferenceFilm film = RenderReference(scene, Settings(12, 12, 1, Orthographic(1.2)), Effort(64, 1, 8));
  double area = 0.0, variance = 0.0;
  for (std::size_t i = 0; i < film.pixels.size(); ++i) {
    area += film.pixels[i].w / 25.0;  // a pixel's side is a fifth
    variance += film.standard_error[i].w * film.standard_error[i].w / 625.0;
    EXPECT_NEAR(film.pixels[i].x, 0.5 * film.pixels[i].w, 1e-15);  // premultiplied
  }
  const double polygon = kPi * (1.0 - 2.0 * kPi * kPi / (3.0 * 120.0 * 120.0));  // at most this much is missing
  EXPECT_LT(area, kPi + 5.0 * std::sqrt(variance));
  EXPECT_GT(area, polygon - 5.0 * std::sqrt(variance));
  EXPECT_LT(std::sqrt(variance), 0.01);
}

// Half a pixel, a third of a pixel: the mean over a box one pixel wide.
TEST(Reference, APixelIsTheMeanOverItsArea) {
  Scene scene;
  Add(scene, Rectangle(-3, -3, 1.0f / 3.0f, 0.5f), AddMaterial(scene, Unlit({1.0f, 1.0f, 1.0f, 1.0f})));
  // Two by two pixels of size 1: the upper right one is covered a third by a half.
  const ReferenceFilm film = RenderReference(scene, Settings(2, 2, 1, Orthographic(1.0)), Effort(64, 1, 64));
  const double expected[4] = {0.5, 1.0 / 6.0, 1.0, 1.0 / 3.0};
  for (std::size_t i = 0; i < 4; ++i) {
    EXPECT_NEAR(film.pixels[i].w, expected[i], 5.0 * film.standard_error[i].w + 1e-12) << i;
    EXPECT_NEAR(film.pixels[i].w, expected[i], 0.005) << i;
  }
}

// A chequered plane: pixels that hold whole squares are their mean, whatever the sampler says of mip levels.
TEST(Reference, TexturesAreFilteredBySamples) {
  Scene scene;
  Material material = Unlit(glm::vec4(1.0f));
  Sampler sampler;
  sampler.magnification = sampler.minification = Filter::Nearest;
  const Image board =
      MakeImage(64, 64, [](int x, int y) { return glm::u8vec4((x + y) & 1 ? 255 : 0, x < 32 ? 188 : 0, 0, 255); });
  material.base_color_texture = Ref(AddTexture(scene, board, sampler));
  Add(scene, Rectangle(-1, -1, 1, 1), AddMaterial(scene, material));
  const ReferenceFilm film = RenderReference(scene, Settings(4, 4, 1, Orthographic(1.0)), Effort(1024, 1, 4));
  const double green = std::pow((188 / 255.0 + 0.055) / 1.055, 2.4);
  for (std::size_t i = 0; i < 16; ++i) {
    EXPECT_NEAR(film.pixels[i].x, 0.5, 0.01) << i;
    EXPECT_NEAR(film.pixels[i].x, 0.5, 6.0 * film.standard_error[i].x + 1e-12) << i;
    EXPECT_NEAR(film.pixels[i].y, i % 4 < 2 ? green : 0.0, 1e-12) << i;
  }
}

TEST(Reference, LayersLieOverEachOtherByDepth) {
  const auto sheet = [](Scene& scene, float z, const glm::vec4& color, AlphaMode mode) {
    Material material = Unlit(color, mode);
    material.alpha_cutoff = 0.5f;
    Add(scene, Rectangle(-2, -2, 2, 2, z), AddMaterial(scene, material));
  };
  const auto image = [](const Scene& scene) {
    const ReferenceFilm film = RenderReference(scene, Settings(1, 1, 1, Orthographic(1.0)), Effort(4, 1, 2));
    return film.pixels[0];
  };
  const auto near4 = [](const glm::dvec4& a, const glm::dvec4& b) {
    return glm::all(glm::lessThan(glm::abs(a - b), glm::dvec4(1e-7)));
  };
  {
    Scene scene;  // in the file the nearer one comes first
    sheet(scene, 1.0f, {1, 0, 0, 0.25f}, AlphaMode::Blend);
    sheet(scene, 0.0f, {0, 1, 0, 0.5f}, AlphaMode::Blend);
    EXPECT_TRUE(near4(image(scene), {0.25, 0.75 * 0.5, 0.0, 1.0 - 0.75 * 0.5}));
    sheet(scene, -1.0f, {0, 0, 1, 0.1f}, AlphaMode::Opaque);
    EXPECT_TRUE(near4(image(scene), {0.25, 0.75 * 0.5, 0.75 * 0.5, 1.0}));
    sheet(scene, 0.5f, {1, 1, 1, 0.4f}, AlphaMode::Mask);  // cut away
    EXPECT_TRUE(near4(image(scene), {0.25, 0.75 * 0.5, 0.75 * 0.5, 1.0}));
    sheet(scene, 0.5f, {1, 1, 1, 0.6f}, AlphaMode::Mask);  // hides all but the first
    EXPECT_TRUE(near4(image(scene), {1.0, 0.75, 0.75, 1.0}));
  }
  {
    Scene scene;  // all at one depth
    sheet(scene, 0.0f, {0.5f, 0, 0, 0.5f}, AlphaMode::Blend);
    sheet(scene, 0.0f, {1, 1, 1, 1}, AlphaMode::Mask);
    sheet(scene, 0.0f, {0, 1, 0, 1}, AlphaMode::Opaque);
    sheet(scene, 0.0f, {0, 0, 1, 1}, AlphaMode::Opaque);
    sheet(scene, 0.0f, {0, 0, 0.5f, 0.5f}, AlphaMode::Blend);
    EXPECT_TRUE(near4(image(scene), {0.125, 0.25, 0.25, 1.0}));
  }
}

TEST(Reference, LinesWithoutNormalsEmit) {
  Scene scene;
  Material material;
  material.base_color_factor = {0.25f, 0.5f, 0, 1};
  material.emissive_factor = {0, 0.25f, 1};
  Primitive line;
  line.topology = Topology::Lines;
  line.positions = {{-0.9f, 0, 0}, {0.9f, 0, 0}};
  Add(scene, line, AddMaterial(scene, material));
  const ReferenceFilm film = RenderReference(scene, Settings(4, 4, 1, Orthographic(1.0)), Effort(4, 1, 2));
  double covered = 0.0;
  for (const glm::dvec4& pixel : film.pixels) {
    covered += pixel.a;
    for (int c = 0; c < 3; ++c) EXPECT_NEAR(pixel[c], glm::dvec3(0.25, 0.75, 1.0)[c] * pixel.a, 1e-7);
  }
  EXPECT_GT(covered, 1.0);
}

TEST(Reference, TheEnvironmentBehindTheImage) {
  RenderSettings settings = Settings(4, 2, 1, Perspective(1.0, {0, 0, 0}));
  settings.environment = ConstantEnvironment(0.5f);
  settings.environment.intensity = 3.0;
  settings.background = Background::Environment;
  for (const glm::dvec4& pixel : RenderReference(Scene{}, settings, Effort(4, 1, 2)).pixels) {
    EXPECT_EQ(pixel, glm::dvec4(1.5, 1.5, 1.5, 1.0));
  }
}

// Two images of other seeds differ as their estimates say.
TEST(Reference, TheErrorEstimateIsHonest) {
  const Scene scene = Balls();
  ReferenceSettings effort = Effort(16, 1, 10);
  const ReferenceFilm a = RenderReference(scene, BallSettings(16), effort);
  effort.seed = 1;
  const ReferenceFilm b = RenderReference(scene, BallSettings(16), effort);
  int counted = 0, beyond = 0;
  double sum2 = 0.0;
  for (std::size_t i = 0; i < a.pixels.size(); ++i) {
    const double error = std::hypot(a.standard_error[i].y, b.standard_error[i].y);
    if (error == 0.0) {
      EXPECT_EQ(a.pixels[i].y, b.pixels[i].y);
      continue;
    }
    const double z = (a.pixels[i].y - b.pixels[i].y) / error;
    ++counted;
    beyond += std::fabs(z) > 3.0;
    sum2 += std::min(z * z, 100.0);
  }
  EXPECT_GT(counted, 80);
  EXPECT_LT(beyond, counted / 25);  // Student's t of 18 degrees of freedom: 0.8 %
  EXPECT_GT(sum2 / counted, 0.6);   // its variance is 1.125
  EXPECT_LT(sum2 / counted, 1.9);
  EXPECT_NEAR(Rms(a, b) / std::hypot(a.rms_error, b.rms_error), 1.0, 0.4);
}

TEST(Reference, ConvergesAtLeastAsChanceDoes) {
  const Scene scene = Balls();
  const ReferenceFilm truth = RenderReference(scene, BallSettings(10), Effort(1024, 2, 4));
  const ReferenceFilm few = RenderReference(scene, BallSettings(10), Effort(4, 1, 4));
  const ReferenceFilm many = RenderReference(scene, BallSettings(10), Effort(64, 1, 4));
  EXPECT_LT(Rms(many, truth), Rms(few, truth) / 4.0);
  EXPECT_LT(many.rms_error, few.rms_error / 4.0);
}

TEST(Reference, TheSameBitsOnAnyNumberOfThreads) {
  const Scene scene = Balls();
  RenderSettings settings = BallSettings(12);
  settings.threads = 1;
  const ReferenceFilm one = RenderReference(scene, settings, Effort(4, 2, 3));
  for (int threads : {2, 5}) {
    settings.threads = threads;
    EXPECT_TRUE(SameBits(one, RenderReference(scene, settings, Effort(4, 2, 3)))) << threads;
  }
  ReferenceSettings other = Effort(4, 2, 3);
  other.seed = 7;
  EXPECT_FALSE(SameBits(one, RenderReference(scene, settings, other)));
}

// A clock that goes on by so many seconds whenever somebody looks at it.
Clock TickingClock(double tick_seconds) {
  return [tick_seconds, looks = std::make_shared<std::atomic<int>>(0)] { return tick_seconds * (*looks)++; };
}

TEST(Reference, StopsWhereItIsTold) {
  const Scene scene = Balls();
  ReferenceSettings effort = Effort(4, 1, 40);
  effort.clock = TickingClock(1.0);
  effort.time_budget = 0.0;
  EXPECT_EQ(RenderReference(scene, BallSettings(4), effort).batches, 2);
  effort.time_budget = 30.0;
  const int batches = RenderReference(scene, BallSettings(4), effort).batches;
  EXPECT_GT(batches, 2);
  EXPECT_LT(batches, 30);
  effort.time_budget = std::numeric_limits<double>::infinity();
  EXPECT_EQ(RenderReference(scene, BallSettings(4), effort).batches, 40);
  effort.target_error = 0.1;
  int calls = 0;
  RenderSettings settings = BallSettings(8);
  settings.progress = [&](double share) {
    EXPECT_GT(share, 0.0);
    EXPECT_LE(share, 1.0);
    ++calls;
  };
  const ReferenceFilm film = RenderReference(scene, settings, effort);
  EXPECT_LT(film.batches, 40);
  EXPECT_GE(film.batches, 4);
  EXPECT_GE(calls, film.batches - 1);  // the first two are made together
  EXPECT_LE(film.relative_error, 0.1);
  EXPECT_GT(film.relative_error, 0.0);
}

// What there is no time for is left out; what is there is as it would be with all the time there is.
TEST(Reference, HasAPartOfTheImageWhereThereIsNoTimeForAllOfIt) {
  const Scene scene = Balls();
  const RenderSettings settings = BallSettings(200);  // 169 blocks, most of them with light in them
  ReferenceSettings effort = Effort(1, 1, 2);
  const ReferenceFilm all = RenderReference(scene, settings, effort);
  EXPECT_TRUE(all.whole);
  EXPECT_EQ(all.known_pixels, 40000u);
  EXPECT_EQ(all.blocks.size(), 169u);
  std::size_t before = 0;
  for (const double budget : {0.0, 60.0, 100.0}) {
    effort.clock = TickingClock(1.0);
    effort.time_budget = budget;
    const ReferenceFilm part = RenderReference(scene, settings, effort);
    EXPECT_FALSE(part.whole);
    EXPECT_EQ(part.batches, 2);
    EXPECT_GT(part.blocks.size(), before);
    EXPECT_LT(part.blocks.size(), all.blocks.size());
    before = part.blocks.size();
    std::vector<bool> known(part.pixels.size(), false);
    for (const PixelBlock& block : part.blocks) {
      for (int y = block.y; y < block.y + block.height; ++y) {
        for (int x = block.x; x < block.x + block.width; ++x) known[std::size_t(y * 200 + x)] = true;
      }
    }
    EXPECT_EQ(std::size_t(std::count(known.begin(), known.end(), true)), part.known_pixels);
    double error2 = 0.0, light2 = 0.0;
    for (std::size_t i = 0; i < known.size(); ++i) {
      EXPECT_EQ(part.pixels[i], known[i] ? all.pixels[i] : glm::dvec4(0.0));
      EXPECT_EQ(part.standard_error[i], known[i] ? all.standard_error[i] : glm::dvec4(0.0));
      const glm::dvec3 error(part.standard_error[i]), light(part.pixels[i]);
      error2 += glm::dot(error, error);
      light2 += glm::dot(light, light);
    }
    EXPECT_NEAR(part.rms_error, std::sqrt(error2 / (3.0 * double(part.known_pixels))), 1e-12);
    EXPECT_NEAR(part.relative_error, std::sqrt(error2 / light2), 1e-12);
  }
}

// A few blocks with light in them are made however late it is: without any there would be nothing to compare with.
TEST(Reference, LooksForLightHoweverLateItIs) {
  Scene scene;
  Add(scene, Sphere(0.25f, 12, 24), AddMaterial(scene, Unlit({0.5f, 0.5f, 0.5f, 1.0f})));
  RenderSettings settings = Settings(160, 160, 1, Orthographic(1.0));  // 100 blocks, 12 or 16 of them touched
  ReferenceSettings effort = Effort(1, 1, 2);
  effort.time_budget = 0.0;
  double light = 0.0;
  for (const glm::dvec4& pixel : RenderReference(scene, settings, effort).pixels) light += pixel.x;
  EXPECT_GT(light, 0.0);
}

TEST(Reference, GoesOnWhereItStopped) {
  const Scene scene = Balls();
  ReferenceSettings effort = Effort(2, 1, 6);
  const ReferenceFilm at_once = RenderReference(scene, BallSettings(100), effort);
  effort.clock = TickingClock(1.0);
  ReferenceRun run(scene, BallSettings(100), effort);
  const std::size_t first = run.Continue(0.0).known_pixels;
  EXPECT_LT(first, 10000u);
  const double noise = run.Continue(0.0).relative_error;
  EXPECT_EQ(run.Continue(0.0).known_pixels, first);
  EXPECT_GT(run.Continue(25.0).known_pixels, first);
  // Half of the noise takes four times as many batches.
  EXPECT_NEAR(run.SecondsFor(0.25 * noise) / run.SecondsFor(0.5 * noise), 4.0, 1.0);
  EXPECT_LE(run.SecondsFor(2.0 * noise), 60.0) << "there is that already";
  EXPECT_TRUE(SameBits(run.Continue(std::numeric_limits<double>::infinity()), at_once));
}

TEST(Reference, RefusesWhatIsOutOfRange) {
  const auto refused = [](const RenderSettings& settings, const ReferenceSettings& effort) {
    try {
      RenderReference(Scene{}, settings, effort);
    } catch (const Error& error) {
      return error.code() == ErrorCode::InvalidUsage && !error.hint().empty();
    }
    return false;
  };
  const RenderSettings fine = BallSettings(2);
  EXPECT_TRUE(refused(fine, Effort(0, 1, 2)));
  EXPECT_TRUE(refused(fine, Effort(1, 0, 2)));
  EXPECT_TRUE(refused(fine, Effort(1, 1, 1)));
  EXPECT_FALSE(refused(fine, Effort(1, 1, 2)));
  ReferenceSettings effort;
  effort.time_budget = std::nan("");
  EXPECT_TRUE(refused(fine, effort));
  effort = {};
  effort.target_error = -1.0;
  EXPECT_TRUE(refused(fine, effort));
  RenderSettings bad = fine;
  bad.width = 0;
  EXPECT_TRUE(refused(bad, {}));
  bad = fine;
  bad.environment.kind = EnvironmentSettings::Kind::Image;
  EXPECT_TRUE(refused(bad, {}));
}

TEST(Reference, BrokenImagesAndNumbersAreNoted) {
  class Broken final : public ImageSource {
    Image Decode() const override { throw Error(ErrorCode::InvalidInput, "no picture"); }
    std::string Name() const override { return "broken.png"; }
  };
  Scene scene;
  Material material = Unlit({0.5f, 0.5f, 0.5f, 1.0f});
  material.base_color_texture = Ref(AddTexture(scene, std::make_shared<Broken>()));
  Primitive p = Rectangle(-2, -2, 2, 2);
  p.colors.assign(4, glm::vec4(1.0f, NAN, 1.0f, 1.0f));
  Add(scene, p, AddMaterial(scene, material));
  const ReferenceFilm film = RenderReference(scene, Settings(1, 1, 1, Orthographic(1.0)), Effort(4, 1, 2));
  EXPECT_EQ(film.pixels[0], glm::dvec4(0.0, 0.0, 0.0, 1.0));
  ASSERT_EQ(film.notes.size(), 2u);
  EXPECT_NE(film.notes[0].find("broken.png"), std::string::npos);
  EXPECT_NE(film.notes[1].find("8 samples were not finite"), std::string::npos);
}

}  // namespace
}  // namespace facet
