// Explain() of facet/explain.h: describes the plan of a frame, and measures the cost of each feature by disabling it.
#include "facet/explain.h"

#include <algorithm>
#include <chrono>
#include <utility>

#include "base/parallel.h"
#include "facet/version.h"
#include "light/environment_source.h"
#include "material/model_parameters.h"
#include "material/models/models.h"
#include "plan/frame_plan.h"
#include "scene/camera.h"
#include "scene/topology.h"
#include "settings/render_request.h"

namespace facet {
namespace {

constexpr int kFewestPairs = 5, kMostPairs = 41;
constexpr double kSecondsOfPairs = 0.3;  // for each feature, if kFewestPairs do not take longer
constexpr double kSecondsOfPreparation = 0.5;

// The features of kFeatureWords that a material uses.
FeatureSet UsedFeatures(const FrameMaterial& material) {
  FeatureSet used;
  ForEachSlotOf(material.ModelOfSlots(), material.features, [&](const SlotInfo& slot) { used.Add(slot.feature); });
  for (const FactorFeature& factor : kFactorFeatures) {
    if (material.Has(factor.bit)) used.Add(factor.feature);
  }
  if (material.Has(kAlphaTest)) used.Add(Feature::AlphaTest);
  if (material.Has(kAlphaBlend)) used.Add(Feature::Blending);
  if (material.vertex_colors) used.Add(Feature::VertexColors);
  return used;
}

ExplainedMaterial Describe(const Scene& scene, const PlannedMaterial& planned) {
  ExplainedMaterial material;
  material.index = planned.material;
  if (planned.material >= 0) material.name = scene.materials[std::size_t(planned.material)].name;
  material.model = InfoOf(planned.frame.ModelOfSlots()).word;
  material.lit = planned.frame.Has(kLit);
  const FeatureSet used = UsedFeatures(planned.frame);
  for (const FeatureWord& known : kFeatureWords) {
    if (used.Has(known.feature)) material.features.emplace_back(known.word);
  }
  if (planned.frame.Has(kDoubleSided)) material.features.emplace_back("double-sided");
  return material;
}

std::vector<ExplainedMaterial> DescribeMaterials(const Scene& scene, const PosedScene& posed, const FramePlan& plan) {
  std::vector<ExplainedMaterial> materials;
  for (const PlannedMaterial& planned : plan.materials) materials.push_back(Describe(scene, planned));
  for (std::size_t i = 0; i < posed.drawables.size(); ++i) {
    ExplainedMaterial& material = materials[std::size_t(plan.material_of_drawable[i])];
    ++material.drawables;
    material.triangles += PrimitiveCount(*posed.drawables[i].geometry);
  }
  return materials;
}

std::vector<ExplainedTexture> DescribeTextures(const Scene& scene, const FramePlan& plan, const RenderStats& stats) {
  std::vector<ExplainedTexture> textures(plan.textures.size());
  for (std::size_t t = 0; t < textures.size(); ++t) {
    const PlannedTexture& planned = plan.textures[t];
    if (planned.image == kWhiteImage) continue;
    const SceneImage& image = scene.images[std::size_t(planned.image)];
    textures[t].image = image.name.empty() ? image.source->Name() : image.name;
    textures[t].file = image.source->Header().value_or(ImageHeader());
    for (const ModelInfo& model : kModels) {
      for (const SlotInfo& slot : SlotsOf(model.model)) {
        const bool reads = std::any_of(plan.materials.begin(), plan.materials.end(), [&](const PlannedMaterial& m) {
          return m.frame.ModelOfSlots() == model.model && m.textures[IndexOf(slot.slot)] == static_cast<int>(t);
        });
        std::vector<std::string>& roles = textures[t].roles;
        if (reads && std::ranges::find(roles, slot.word) == roles.end()) roles.emplace_back(slot.word);
      }
    }
    for (const TextureStats& kept : stats.textures) {
      if (kept.image == planned.image && kept.color == (planned.role == TextureRole::Color)) textures[t].kept = kept;
    }
  }
  return textures;
}

ExplainedLights CountLights(const PosedScene& posed) {
  ExplainedLights lights;
  for (const PosedLight& light : posed.lights) {
    ++(light.light->type == LightType::Directional ? lights.directional
       : light.light->type == LightType::Point     ? lights.point
                                                   : lights.spot);
  }
  return lights;
}

std::int64_t BytesKept(const RenderStats& stats) {
  return static_cast<std::int64_t>(stats.texture_bytes + stats.environment_bytes + stats.pose_bytes);
}

// The value at `share` of the way through the sorted values.
double Quantile(std::vector<double>& values, double share) {
  const auto place = values.begin() + std::ptrdiff_t(share * double(values.size() - 1) + 0.5);
  std::nth_element(values.begin(), place, values.end());
  return *place;
}

// A feature to disable, and the settings of the same frame without it.
struct Ablation {
  std::string feature, option;
  RenderSettings settings;
  bool needs_table = false;  // a table of albedos of its own
};

std::vector<Ablation> Ablations(const RenderSettings& settings, const FramePlan& plan) {
  std::vector<Ablation> ablations;
  const auto add = [&](std::string feature, std::string option) -> RenderSettings& {
    return ablations.emplace_back(Ablation{std::move(feature), std::move(option), settings}).settings;
  };
  std::string already;  // features already disabled, which the new option must list too
  for (const FeatureWord& known : kFeatureWords) {
    if (settings.without.Has(known.feature)) already += std::string(known.word) + ",";
  }
  for (const FeatureWord& known : kFeatureWords) {
    if (!plan.uses.Has(known.feature)) continue;
    const std::string word(known.word);
    add(word, "--without " + already + word).without.Add(known.feature);
    ablations.back().needs_table =
        (known.feature == Feature::Anisotropy && plan.albedo_tables.anisotropic_dfg) ||
        (known.feature == Feature::Sheen && (plan.albedo_tables.sheen || plan.albedo_tables.cloth));
  }
  if (plan.environment_background) add("background", "--background transparent").background = Background::Transparent;
  if (!plan.planes.empty()) add("planes", "--planes none").planes.clear();
  if (settings.samples > 1) add("multisampling", "--samples 1").samples = 1;
  if (settings.max_anisotropy > 1 && !plan.textures.empty()) {
    add("anisotropic-filtering", "--max-anisotropy 1").max_anisotropy = 1;
  }
  if (settings.specular_antialiasing && (plan.environment_light || plan.punctual_lights)) {
    add("specular-antialiasing", "--specular-antialiasing off").specular_antialiasing = false;
  }
  return ablations;
}

class Measurement {
 public:
  Measurement(const Scene& scene, const RenderSettings& settings) : scene_(scene), settings_(settings) {}

  // The very first frame also includes the work that is done once per process.
  void MeasureFrames(Explanation& out) {
    Renderer(scene_).Render(settings_, film_, &out.first);
    prepared_ = FirstFrame(renderer_, settings_);
    renderer_.Render(settings_, film_, &out.steady);
    std::vector<double> seconds;
    Repeat(kFewestPairs, kSecondsOfPairs, [&] { seconds.push_back(Frame(renderer_, settings_)); });
    out.frames = static_cast<int>(seconds.size());
    out.steady_seconds = Quantile(seconds, 0.5);
  }

  FeatureCost Measure(const Ablation& ablation, const RenderStats& first) {
    Renderer renderer(scene_);
    const RenderStats prepared = FirstFrame(renderer, ablation.settings);
    FeatureCost cost;
    cost.feature = ablation.feature;
    cost.option = ablation.option;
    cost.bytes = BytesKept(prepared_) - BytesKept(prepared);
    cost.first_seconds = MeasurePreparation(ablation, prepared);
    // The environment is prepared once per process, so that only the very first frame has its cost; and so are tables.
    if (prepared_.environment_bytes > 0 && prepared.environment_bytes == 0) {
      cost.first_seconds += first.environment_seconds;
    }
    if (ablation.needs_table) cost.first_seconds += first.table_seconds;
    std::vector<double> differences;
    Repeat(kFewestPairs, kSecondsOfPairs, [&] {  // the order alternates, as it may affect the times
      const bool with_first = differences.size() % 2 == 0;
      const double a = with_first ? Frame(renderer_, settings_) : Frame(renderer, ablation.settings);
      const double b = with_first ? Frame(renderer, ablation.settings) : Frame(renderer_, settings_);
      differences.push_back(with_first ? a - b : b - a);
    });
    cost.pairs = static_cast<int>(differences.size());
    cost.seconds = Quantile(differences, 0.5);
    cost.seconds_low = Quantile(differences, 0.25);
    cost.seconds_high = Quantile(differences, 0.75);
    return cost;
  }

 private:
  RenderStats FirstFrame(Renderer& renderer, const RenderSettings& settings) {
    RenderStats stats;
    renderer.Render(settings, film_, &stats);
    return stats;
  }

  // The time for preparing the pose and the textures, for each of them that disabling the feature changes.
  double MeasurePreparation(const Ablation& ablation, const RenderStats& prepared) {
    const bool other_pose = PoseOf(ablation.settings) != PoseOf(settings_);
    const bool other_textures = prepared.texture_bytes != prepared_.texture_bytes;
    if (!other_pose && !other_textures) return 0.0;
    const auto seconds = [&](const RenderSettings& settings) {
      Renderer renderer(scene_);
      const RenderStats stats = FirstFrame(renderer, settings);
      return (other_pose ? stats.pose_seconds : 0.0) + (other_textures ? stats.texture_seconds : 0.0);
    };
    std::vector<double> differences;
    Repeat(1, kSecondsOfPreparation, [&] {
      const double with = seconds(settings_);
      differences.push_back(with - seconds(ablation.settings));
    });
    return Quantile(differences, 0.5);
  }

  double Frame(Renderer& renderer, const RenderSettings& settings) {
    RenderStats stats;
    renderer.Render(settings, film_, &stats);
    return stats.total_seconds;
  }

  template <class Body>
  static void Repeat(int fewest, double enough_seconds, const Body& body) {
    using Clock = std::chrono::steady_clock;
    const auto start = Clock::now();
    for (int i = 0; i < kMostPairs; ++i) {
      if (i >= fewest && std::chrono::duration<double>(Clock::now() - start).count() > enough_seconds) break;
      body();
    }
  }

  const Scene& scene_;
  const RenderSettings& settings_;
  Renderer renderer_{scene_};
  RenderStats prepared_;  // the first frame of renderer_
  Film film_;
};

std::string EnvironmentName(const EnvironmentSettings& environment) {
  switch (environment.kind) {
    case EnvironmentSettings::Kind::None: return {};
    case EnvironmentSettings::Kind::Studio: return "studio";
    case EnvironmentSettings::Kind::Image: break;
  }
  const auto image = ImageOf(environment);
  return std::to_string(image->width) + "x" + std::to_string(image->height);
}

}  // namespace

Explanation Explain(const Scene& scene, const RenderSettings& asked) {
  Explanation out;
  RunWithThreads(asked.threads, [&] {
    RenderSettings settings = asked;
    settings.progress = nullptr;  // progress would restart with every frame
    Measurement measurement(scene, settings);
    measurement.MeasureFrames(out);
    const PosedScene posed = Pose(scene, PoseOf(settings));
    const FramePlan plan = MakeFramePlan(scene, posed, settings);
    out.version = Version();
    out.width = settings.width;
    out.height = settings.height;
    out.samples = settings.samples;
    out.materials = DescribeMaterials(scene, posed, plan);
    out.textures = DescribeTextures(scene, plan, out.steady);
    if (plan.punctual_lights) out.lights = CountLights(posed);
    out.environment_light = plan.environment_light;
    out.environment_background = plan.environment_background;
    out.planes = plan.planes;
    out.environment = EnvironmentName(settings.environment);
    // The camera is fixed, because one that frames the bounds would move if skins are disabled.
    const ResolvedCamera camera = ResolveCamera(settings.camera, scene, posed, settings.width, settings.height);
    settings.camera = FreeCamera{camera.world_from_camera, camera.lens};
    for (const Ablation& ablation : Ablations(settings, plan)) {
      out.costs.push_back(measurement.Measure(ablation, out.first));
    }
  });
  return out;
}

}  // namespace facet
