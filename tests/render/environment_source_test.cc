// Environments that come from an EnvironmentSource: when it is asked for what.
#include "light/environment_source.h"

#include <gtest/gtest.h>

#include <map>

#include "facet/error.h"
#include "facet/film.h"
#include "facet/load.h"
#include "light/studio.h"
#include "render/hand_built.h"

namespace facet {
namespace {

// Keeps in memory, and counts.
class Source : public EnvironmentSource {
 public:
  std::shared_ptr<const Image> Decode() const override {
    ++decoded;
    return std::make_shared<const Image>(StudioImage(64, 32));
  }
  std::shared_ptr<const EnvironmentMap> Find(const EnvironmentOptions& options,
                                             const std::function<void(std::uint64_t)>& admit) const override {
    ++asked;
    const auto found = kept.find(options);
    if (found == kept.end()) return nullptr;
    admit(std::uint64_t{1} << 20);
    return found->second;
  }
  std::string Keep(const EnvironmentOptions& options, const EnvironmentMap& map) const override {
    const auto copy = std::make_shared<EnvironmentMap>();
    AssignLevels(map.levels[0].size, *copy);
    copy->texels = map.texels, copy->texel_data = copy->texels.data();
    kept[options] = copy;
    return "kept";
  }

  mutable int decoded = 0, asked = 0;
  mutable std::map<EnvironmentOptions, std::shared_ptr<const EnvironmentMap>> kept;
};

class EnvironmentSourceTest : public testing::Test {
 protected:
  EnvironmentSourceTest() {
    settings_.width = 40;
    settings_.height = 30;
    settings_.environment.kind = EnvironmentSettings::Kind::Image;
    settings_.environment.source = source_;
  }

  const LoadedScene loaded_ = LoadGltf(std::string(FACET_SOURCE_DIR) + "/assets/scenes/animated.glb");
  const std::shared_ptr<const Source> source_ = std::make_shared<const Source>();
  RenderSettings settings_;
};

TEST_F(EnvironmentSourceTest, DecodesOnlyWhatWasNotKept) {
  RenderSettings plain = settings_;
  plain.environment.image = source_->Decode();  // comes first
  const Digest expected = HashFilm(Render(loaded_.scene, plain));
  EXPECT_EQ(source_->asked, 0);
  source_->decoded = 0;

  RenderStats stats;
  EXPECT_EQ(HashFilm(Render(loaded_.scene, settings_, &stats)), expected);
  EXPECT_EQ(source_->decoded, 1);
  EXPECT_EQ(stats.warnings, std::vector<std::string>{"kept"});

  Renderer renderer(loaded_.scene);
  Film film;
  for (int i = 0; i < 2; ++i) {
    renderer.Render(settings_, film, &stats);
    EXPECT_EQ(HashFilm(film), expected);
    EXPECT_TRUE(stats.warnings.empty());
  }
  EXPECT_EQ(source_->decoded, 1);
  EXPECT_EQ(source_->asked, 2);  // the second frame has the first one's

  settings_.environment_samples = 6;
  plain.environment_samples = 6;
  renderer.Render(settings_, film, &stats);
  EXPECT_EQ(HashFilm(film), HashFilm(Render(loaded_.scene, plain)));
  EXPECT_EQ(source_->decoded, 2);
  const auto another = std::make_shared<const Source>();
  settings_.environment.source = another;
  renderer.Render(settings_, film, &stats);
  EXPECT_EQ(another->decoded, 1);
}

TEST_F(EnvironmentSourceTest, IsNotAskedForWhatIsNotNeeded) {
  settings_.without = {Feature::EnvironmentLight};
  Render(loaded_.scene, settings_);
  EXPECT_EQ(source_->asked + source_->decoded, 0);
}

TEST_F(EnvironmentSourceTest, CountsAgainstTheMemoryLimit) {
  Render(loaded_.scene, settings_);
  settings_.memory_limit = std::uint64_t{1} << 20;
  EXPECT_THROW(Render(loaded_.scene, settings_), Error);
}

TEST_F(EnvironmentSourceTest, GivesItsImageToWhoeverNeedsThat) {
  EXPECT_EQ(ImageOf(settings_.environment)->width, 64);
  settings_.environment.image = std::make_shared<const Image>(StudioImage(32, 16));
  EXPECT_EQ(ImageOf(settings_.environment)->width, 32);
}

}  // namespace
}  // namespace facet
