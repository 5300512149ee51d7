#include "gltf/animation.h"

#include <set>
#include <utility>

namespace facet::gltf {
namespace {

std::size_t TargetCount(const Scene& scene, int mesh) {
  if (mesh < 0) return 0;
  const auto& primitives = scene.meshes[static_cast<std::size_t>(mesh)].primitives;
  return primitives.empty() ? 0 : primitives.front().targets.size();
}

// Keeps the keys whose times increase.
void DropStaleKeys(Context& context, AnimationChannel& channel, std::size_t numbers_per_key, const Place& place) {
  std::size_t kept = 0;
  for (std::size_t key = 0; key < channel.times.size(); ++key) {
    if (kept > 0 && !(channel.times[key] > channel.times[kept - 1])) continue;
    if (kept != key) {
      channel.times[kept] = channel.times[key];
      for (std::size_t i = 0; i < numbers_per_key; ++i) {
        channel.values[kept * numbers_per_key + i] = channel.values[key * numbers_per_key + i];
      }
    }
    ++kept;
  }
  if (kept == channel.times.size()) return;
  context.Warn(place, std::to_string(channel.times.size() - kept) + " keys were dropped: their times do not increase");
  channel.times.resize(kept);
  channel.values.resize(kept * numbers_per_key);
}

struct PathShape {
  AnimationPath path;
  int components;
};

std::optional<PathShape> ShapeOf(const std::string& path) {
  if (path == "translation") return PathShape{AnimationPath::Translation, 3};
  if (path == "rotation") return PathShape{AnimationPath::Rotation, 4};
  if (path == "scale") return PathShape{AnimationPath::Scale, 3};
  if (path == "weights") return PathShape{AnimationPath::Weights, 1};
  return std::nullopt;
}

Interpolation InterpolationOf(Context& context, const std::string& name, const Place& place) {
  if (name == "STEP") return Interpolation::Step;
  if (name == "CUBICSPLINE") return Interpolation::CubicSpline;
  if (name != "LINEAR") context.Warn(place, "\"" + name + "\" is unknown; LINEAR is used");
  return Interpolation::Linear;
}

std::optional<AnimationChannel> ReadChannel(Context& context, AccessorReader& reader, const Scene& scene,
                                            const tinygltf::AnimationChannel& from,
                                            const tinygltf::AnimationSampler& sampler, const Place& place) {
  const auto shape = ShapeOf(from.target_path);
  if (!shape) {
    context.Warn(place, "ignored: its path \"" + from.target_path + "\" is unknown");
    return std::nullopt;
  }
  const Node& node = scene.nodes[static_cast<std::size_t>(from.target_node)];
  AnimationChannel channel;
  channel.node = from.target_node;
  channel.path = shape->path;
  std::size_t width = static_cast<std::size_t>(shape->components);
  if (channel.path == AnimationPath::Weights) {
    width = TargetCount(scene, node.mesh);
    if (width == 0) {
      context.Warn(place, "ignored: its node has no morph targets");
      return std::nullopt;
    }
  } else if (node.matrix) {
    context.Warn(place, "ignored: its node has a matrix");
    return std::nullopt;
  }
  channel.interpolation = InterpolationOf(context, sampler.interpolation, place);

  const Place input_place(place, "input"), output_place(place, "output");
  const AccessorView input = reader.View(sampler.input), output = reader.View(sampler.output);
  if (input.type != ComponentType::F32 || input.components != 1) Fail(input_place, "times are not float scalars");
  if (output.is_matrix || output.components != shape->components) {
    Fail(output_place, "values do not have " + std::to_string(shape->components) + " components");
  }
  const std::size_t elements_per_key = (channel.path == AnimationPath::Weights ? width : 1) *
                                       (channel.interpolation == Interpolation::CubicSpline ? 3 : 1);
  if (output.count / elements_per_key != input.count || output.count % elements_per_key != 0) {
    Fail(output_place, "has " + std::to_string(output.count) + " elements for " + std::to_string(input.count) +
                           " keys of " + std::to_string(elements_per_key));
  }
  const std::size_t components = static_cast<std::size_t>(shape->components);
  context.Charge(input.count, sizeof(float), place);
  context.Charge(output.count, components * sizeof(float), place);
  channel.times.resize(input.count);
  channel.values.resize(output.count * components);
  reader.ReadFloats(input, {0, input.count}, 1, channel.times.data(), input_place);
  reader.ReadFloats(output, {0, output.count}, shape->components, channel.values.data(), output_place);
  DropStaleKeys(context, channel, elements_per_key * components, place);
  return channel;
}

}  // namespace

void ReadAnimations(Context& context, AccessorReader& reader, Scene& scene) {
  const Place list_place(context.place, "animations");
  for (std::size_t a = 0; a < context.document.core.animations.size(); ++a) {
    const auto& from = context.document.core.animations[a];
    const Place place(list_place, a);
    const Place channels_place(place, "channels");
    Animation animation;
    animation.name = from.name;
    std::set<std::pair<int, AnimationPath>> taken;
    for (std::size_t c = 0; c < from.channels.size(); ++c) {
      const auto& channel_from = from.channels[c];
      if (channel_from.target_node < 0) continue;  // for extensions, says the specification
      const Place channel_place(channels_place, c);
      auto channel = ReadChannel(context, reader, scene, channel_from,
                                 from.samplers[static_cast<std::size_t>(channel_from.sampler)], channel_place);
      if (!channel) continue;
      if (!taken.insert({channel->node, channel->path}).second) {
        context.Warn(channel_place, "ignored: an earlier channel moves the same");
        continue;
      }
      animation.channels.push_back(*std::move(channel));
    }
    scene.animations.push_back(std::move(animation));
  }
}

}  // namespace facet::gltf
