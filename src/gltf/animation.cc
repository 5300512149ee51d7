#include "gltf/animation.h"

#include <set>
#include <utility>

namespace facet::gltf {
namespace {

// The number of morph targets, which is the number of the mesh's weights (see ReadMeshes).
std::size_t TargetCount(const Scene& scene, int mesh) {
  return mesh < 0 ? 0 : scene.meshes[static_cast<std::size_t>(mesh)].weights.size();
}

// Drops the keys whose times decrease.
void DropStaleKeys(AnimationChannel& channel, std::size_t numbers_per_key, const Place& place) {
  std::size_t kept = 0, jumps = 0;
  for (std::size_t key = 0; key < channel.times.size(); ++key) {
    if (kept > 0 && channel.times[key] < channel.times[kept - 1]) continue;
    jumps += kept > 0 && channel.times[key] == channel.times[kept - 1];
    if (kept != key) {
      channel.times[kept] = channel.times[key];
      for (std::size_t i = 0; i < numbers_per_key; ++i) {
        channel.values[kept * numbers_per_key + i] = channel.values[key * numbers_per_key + i];
      }
    }
    ++kept;
  }
  if (jumps) place.Warn(std::to_string(jumps) + " keys have the time of the one before: the values jump there");
  if (kept == channel.times.size()) return;
  place.Warn(std::to_string(channel.times.size() - kept) + " keys were dropped: their times decrease");
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

Interpolation InterpolationOf(const Json& sampler, const Place& place) {
  const std::string name = LenientString(sampler, "interpolation", place).value_or("LINEAR");
  if (name == "STEP") return Interpolation::Step;
  if (name == "CUBICSPLINE") return Interpolation::CubicSpline;
  if (name != "LINEAR") Place(place, "interpolation").Warn("\"" + name + "\" is unknown; LINEAR is used");
  return Interpolation::Linear;
}

// The target of a channel; nothing, perhaps with a warning, if the channel has no effect.
struct Target {
  int node = -1;
  PathShape shape{AnimationPath::Translation, 3};
  std::size_t width = 3;  // components of a key
};

class AnimationReader {
 public:
  AnimationReader(Context& context, AccessorReader& reader, const Scene& scene, const Json& object, const Place& place)
      : context_(context), reader_(reader), scene_(scene), object_(object), place_(place) {}

  Animation Read() {
    Animation animation;
    animation.name = NameOf(object_, place_);
    if (!Find(object_, "channels")) place_.Warn("\"channels\" is missing");
    const Json* channels = LenientArray(object_, "channels", place_);
    samplers_ = LenientArray(object_, "samplers", place_);
    const Place channels_place(place_, "channels");
    for (std::size_t c = 0; channels && c < channels->size(); ++c) {
      const Place place(channels_place, c);
      std::optional<AnimationChannel> channel;
      context_.Try(false, place, "ignored", [&] {
        CheckObject((*channels)[c], place);
        channel = ReadChannel((*channels)[c], place);
      });
      if (channel) animation.channels.push_back(*std::move(channel));
    }
    return animation;
  }

 private:
  std::optional<Target> ReadTarget(const Json& object, const Place& place) const {
    Target target;
    target.node = IndexAt(object, "node", scene_.nodes.size(), "nodes", place);
    if (target.node < 0) return std::nullopt;  // reserved for extensions by the specification
    const std::string path = RequireString(object, "path", place);
    const auto shape = ShapeOf(path);
    if (!shape) Fail(Place(place, "path"), "\"" + path + "\" is unknown");
    const Node& node = scene_.nodes[static_cast<std::size_t>(target.node)];
    target.shape = *shape;
    target.width = static_cast<std::size_t>(shape->components);
    if (shape->path == AnimationPath::Weights) {
      target.width = TargetCount(scene_, node.mesh);
      if (target.width == 0) Fail(place, "its node has no morph targets");
    } else if (node.matrix) {
      Place(place, "node").Warn("has a matrix, which is taken apart into translation, rotation and scale");
    }
    return target;
  }

  std::optional<AnimationChannel> ReadChannel(const Json& object, const Place& place) {
    const auto target = ReadTarget(RequireObject(object, "target", place), Place(place, "target"));
    if (!target) return std::nullopt;
    const std::pair key(target->node, target->shape.path);
    if (taken_.count(key) > 0) {
      place.Warn("ignored: an earlier channel moves the same");
      return std::nullopt;
    }
    const Place samplers_place(place_, "samplers");
    const int index = RequireIndex(object, "sampler", samplers_ ? samplers_->size() : 0, "samplers", place);
    const Place sampler_place(samplers_place, static_cast<std::size_t>(index));
    const Json& sampler = (*samplers_)[static_cast<std::size_t>(index)];
    CheckObject(sampler, sampler_place);
    AnimationChannel channel = ReadCurve(*target, sampler, sampler_place);
    taken_.insert(key);
    return channel;
  }

  AnimationChannel ReadCurve(const Target& target, const Json& sampler, const Place& place) {
    AnimationChannel channel;
    channel.node = target.node;
    channel.path = target.shape.path;
    channel.interpolation = InterpolationOf(sampler, place);
    const std::size_t accessors = context_.document.Count("accessors");
    const Place input_place(place, "input"), output_place(place, "output");
    const AccessorView& input = reader_.View(RequireIndex(sampler, "input", accessors, "accessors", place));
    const AccessorView& output = reader_.View(RequireIndex(sampler, "output", accessors, "accessors", place));
    if (input.components != 1) Fail(input_place, "times are not scalars");
    if (input.type != ComponentType::F32) input_place.Warn("times are not floats");
    if (output.is_matrix || output.components != target.shape.components) {
      Fail(output_place, "values do not have " + std::to_string(target.shape.components) + " components");
    }
    const bool is_cubic = channel.interpolation == Interpolation::CubicSpline;
    const std::size_t per_key = (channel.path == AnimationPath::Weights ? target.width : 1) * (is_cubic ? 3 : 1);
    const std::string sizes = "has " + std::to_string(output.count) + " elements for " + std::to_string(input.count) +
                              " keys of " + std::to_string(per_key);
    if (input.count == 0 || output.count / per_key < input.count) Fail(output_place, sizes);
    const std::size_t values = input.count * per_key;
    if (output.count != values) output_place.Warn(sizes + "; the first are read");
    const auto components = static_cast<std::size_t>(target.shape.components);
    context_.Charge(1, sizeof(AnimationChannel), place);
    context_.Charge(input.count, sizeof(float), place);
    context_.Charge(values, components * sizeof(float), place);
    channel.times.resize(input.count);
    channel.values.resize(values * components);
    reader_.ReadFloats(input, {0, input.count}, 1, channel.times.data(), input_place);
    reader_.ReadFloats(output, {0, values}, target.shape.components, channel.values.data(), output_place);
    DropStaleKeys(channel, per_key * components, place);
    return channel;
  }

  Context& context_;
  AccessorReader& reader_;
  const Scene& scene_;
  const Json& object_;
  const Place& place_;
  const Json* samplers_ = nullptr;
  std::set<std::pair<int, AnimationPath>> taken_;  // targets of the channels so far
};

}  // namespace

void ReadAnimations(Context& context, AccessorReader& reader, Scene& scene) {
  const Place list_place(context.place, "animations");
  context.Charge(context.document.Count("animations"), sizeof(Animation), list_place);
  for (std::size_t a = 0; a < context.document.Count("animations"); ++a) {
    const Place place(list_place, a);
    scene.animations.push_back(AnimationReader(context, reader, scene, context.Object("animations", a), place).Read());
  }
}

}  // namespace facet::gltf
