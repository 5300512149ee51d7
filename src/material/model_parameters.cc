#include "material/model_parameters.h"

#include <utility>
#include <vector>

namespace facet {
namespace {

template <class Block, class Value>
SlotInfo MakeSlot(const ModelParameter<Block, Value>& parameter, std::size_t number) {
  constexpr bool kIsNumber = std::is_same_v<Value, Textured<float>>,
                 kIsDirection = std::is_same_v<Value, TangentSpaceNormal>;
  constexpr bool kHasAlpha = std::is_same_v<Value, Textured<glm::vec4>>;
  SlotInfo slot{};
  slot.slot = static_cast<Slot>(number);
  slot.name = slot.word = slot.key = slot.gltf_name = parameter.name;
  slot.role = kIsNumber || kIsDirection || parameter.is_data ? TextureRole::Data : TextureRole::Color;
  slot.channels = kIsNumber || kHasAlpha ? kRgba : kRgb;
  slot.feature = number == 0 ? Feature::BaseColorTexture : parameter.feature;
  slot.alpha_is_coverage = number == 0 && kHasAlpha;
  slot.needs_light = number != 0;
  slot.tangent_space = kIsDirection;
  slot.white_is_neutral = false;
  return slot;
}

template <class Block>
const std::vector<SlotInfo>& SlotsOfBlock() {
  static_assert(HasSlotsForAll<Block>());
  static const std::vector<SlotInfo> slots = [] {
    std::vector<SlotInfo> made;
    std::size_t row = 0;
    ForEachRow(std::type_identity<Block>(), [&](const auto& parameter) {
      const std::size_t number = SlotNumber<Block>(row++);
      if constexpr (requires { (std::declval<Block>().*parameter.member).texture; })
        made.push_back(MakeSlot(parameter, number));
    });
    return made;
  }();
  return slots;
}

}  // namespace

std::span<const SlotInfo> SlotsOf(ShadingModel model) {
  switch (model) {
    case ShadingModel::Lecture: return SlotsOfBlock<LectureParameters>();
    case ShadingModel::Filament: return SlotsOfBlock<FilamentParameters>();
    case ShadingModel::Enterprise: return SlotsOfBlock<EnterpriseParameters>();
    case ShadingModel::MetallicRoughness:
    case ShadingModel::SpecularGlossiness:
    case ShadingModel::Unlit: break;
  }
  return kSlots;
}

const TextureRef& TextureIn(const Material& material, const SlotInfo& slot) {
  if (material.parameters == nullptr) return material.*slot.ref;
  const TextureRef* found = nullptr;
  std::visit(
      [&]<class Block>(const Block& block) {
        std::size_t row = 0;
        ForEachParameterOf(block, [&](const auto&, const auto& value) {
          const std::size_t number = SlotNumber<Block>(row++);
          if constexpr (requires { value.texture; }) {
            if (number == IndexOf(slot.slot)) found = &value.texture;
          }
        });
      },
      *material.parameters);
  return *found;
}

int ChannelsIn(const Material& material, const SlotInfo& slot) {
  int channels = slot.channels;
  if (material.parameters == nullptr) return channels;
  const TextureRef* const texture = &TextureIn(material, slot);
  ForEachParameterOf(*material.parameters, [&]<class Value>(const auto&, const Value& value) {
    if constexpr (std::is_same_v<Value, Textured<float>>) {
      if (&value.texture == texture) channels = 1 << value.channel;
    }
  });
  return channels;
}

glm::vec4 BaseColorOf(const ModelParameters& parameters) {
  glm::vec4 color(1.0f);
  bool is_first = true;
  ForEachParameterOf(parameters, [&]<class Value>(const auto& parameter, const Value& value) {
    const bool is_base = std::exchange(is_first, false);
    if constexpr (std::is_same_v<Value, Textured<glm::vec4>>) {
      if (is_base) color = value.value;
    } else if constexpr (std::is_same_v<Value, Textured<glm::vec3>>) {
      if (is_base) color = glm::vec4(value.value, color.a);
    } else if constexpr (std::is_same_v<Value, Textured<float>>) {
      if (parameter.is_coverage) color.a = value.value;
    }
  });
  return color;
}

CoverageTexture CoverageOf(const ModelParameters& parameters) {
  CoverageTexture coverage;
  std::visit(
      [&]<class Block>(const Block& block) {
        std::size_t row = 0;
        ForEachParameterOf(block, [&]<class Value>(const auto& parameter, const Value& value) {
          const std::size_t slot = SlotNumber<Block>(row++);
          if constexpr (std::is_same_v<Value, Textured<float>>) {
            if (parameter.is_coverage) coverage = {static_cast<Slot>(slot), value.channel};
          }
        });
      },
      parameters);
  return coverage;
}

ModelParameters WithoutFeatures(const ModelParameters& parameters, FeatureSet disabled, FeatureSet& stated) {
  ModelParameters kept = parameters;
  std::visit(
      [&]<class Block>(Block& block) {
        const Block plain;
        bool is_first = true;
        ForEachParameterOf(block, [&](const auto& parameter, auto& value) {
          const auto& initial = plain.*parameter.member;
          if constexpr (requires { value.texture; }) {
            if (std::exchange(is_first, false) && value.texture) {
              stated.Add(Feature::BaseColorTexture);
              if (disabled.Has(Feature::BaseColorTexture)) value.texture = {};
            }
          }
          if (parameter.feature == Feature{} || value == initial) return;
          stated.Add(parameter.feature);
          if (disabled.Has(parameter.feature)) value = initial;
        });
        if constexpr (requires { RemoveMore(block, disabled, stated, block); }) {
          RemoveMore(std::get<Block>(parameters), disabled, stated, block);
        }
      },
      kept);
  return kept;
}

ModelParameters DefaultsOf(ShadingModel model) {
  switch (model) {
    case ShadingModel::Filament: return FilamentParameters();
    case ShadingModel::Enterprise: return EnterpriseParameters();
    default: return LectureParameters();
  }
}

std::optional<AlphaMode> AlphaModeOf(const ModelParameters& parameters) {
  return std::visit([](const auto& block) { return AlphaModeOf(block); }, parameters);
}

ShadingModel ModelOf(const ModelParameters& parameters) {
  constexpr std::array kInOrder = {ShadingModel::Lecture, ShadingModel::Filament, ShadingModel::Enterprise};
  return kInOrder.at(parameters.index());
}

}  // namespace facet
