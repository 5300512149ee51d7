// The parameters of the models that are not glTF's. Material files, validation, the hash of a scene, the plan, `facet
// info`, `facet models` and the models themselves loop over the rows of their tables.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <optional>
#include <span>
#include <string_view>
#include <type_traits>
#include <variant>

#include "material/models/enterprise_parameters.h"
#include "material/models/filament_parameters.h"
#include "material/models/lecture_parameters.h"
#include "material/slots.h"

namespace facet {

// Calls visit(parameter, value) for each parameter of a block.
template <class Block, class Visit>
constexpr void ForEachParameterOf(Block& block, const Visit& visit) {
  ForEachRow(std::type_identity<std::remove_const_t<Block>>(),
             [&](const auto& parameter) { visit(parameter, block.*parameter.member); });
}
template <class Visit>
void ForEachParameterOf(const ModelParameters& parameters, const Visit& visit) {
  std::visit([&](const auto& block) { ForEachParameterOf(block, visit); }, parameters);
}

// The same for those whose value is not the default.
template <class Visit>
void ForEachStatedParameter(const ModelParameters& parameters, const Visit& visit) {
  std::visit(
      [&]<class Block>(const Block& block) {
        const Block plain;
        ForEachParameterOf(block, [&](const auto& parameter, const auto& value) {
          if (!(value == plain.*parameter.member)) visit(parameter, value);
        });
      },
      parameters);
}

// --- Texture slots --------------------------------------------------------------------------------------------------

// The textures of a block have slots of their own: the first is that of the base colour; those in tangent space have
// the numbers of glTF's in tangent space, so that they, too, are asked for by kTangentSpaceBits, and the one named
// "normal" has that of glTF's normal texture in every model, so that whoever does not know the model finds it; the
// others follow in the order of the rows. Returns kMaxSlots for a parameter without a texture.
template <class Block>
constexpr std::size_t SlotNumber(std::size_t row) {
  constexpr std::array kBesidesNormal = {Slot::ClearcoatNormal, Slot::Anisotropy};
  constexpr std::array kReserved = {Slot::BaseColor, Slot::Normal, Slot::Emissive, Slot::ClearcoatNormal,
                                    Slot::Anisotropy};
  std::size_t r = 0, in_tangent_space = 0, other = 0, result = kMaxSlots;
  bool is_first = true;
  ForEachRow(std::type_identity<Block>(), [&]<class Value>(const ModelParameter<Block, Value>& parameter) {
    std::size_t number = kMaxSlots;
    if constexpr (std::is_same_v<Value, TangentSpaceNormal>) {
      const bool is_normal = parameter.name == std::string_view("normal");
      number = IndexOf(is_normal ? Slot::Normal : kBesidesNormal.at(in_tangent_space++));
    } else if constexpr (kHasTexture<Value>) {
      if (is_first) {
        number = IndexOf(Slot::BaseColor);
      } else {
        do number = other++;
        while (std::ranges::find(kReserved, static_cast<Slot>(number)) != kReserved.end());
      }
      is_first = false;
    }
    if (r++ == row) result = number;
  });
  return result;
}

// Whether each texture of a block has a slot of its own.
template <class Block>
consteval bool HasSlotsForAll() {
  MaterialFeatures taken = 0;
  std::size_t row = 0;
  bool has = true;
  ForEachRow(std::type_identity<Block>(), [&]<class Value>(const ModelParameter<Block, Value>&) {
    const std::size_t number = SlotNumber<Block>(row++);
    if constexpr (kHasTexture<Value>) {
      has = has && number < kMaxSlots && (taken & MaterialFeatures{1} << number) == 0;
      if (has) taken |= MaterialFeatures{1} << number;
    }
  });
  return has;
}

template <class Value, class Block>
consteval std::size_t RowOf(Value Block::*member) {
  std::size_t row = 0, found = kMaxSlots;
  ForEachRow(std::type_identity<Block>(), [&]<class Other>(const ModelParameter<Block, Other>& parameter) {
    if constexpr (std::is_same_v<Value, Other>) {
      if (parameter.member == member) found = row;
    }
    ++row;
  });
  return found;
}

// The slot of a parameter's texture: SlotOf(&LectureParameters::roughness).
template <class Value, class Block>
consteval Slot SlotOf(Value Block::*member) {
  return static_cast<Slot>(SlotNumber<Block>(RowOf(member)));
}

// The slots of a model's textures, glTF's models included.
std::span<const SlotInfo> SlotsOf(ShadingModel model);
// The material's texture in a slot of its model.
const TextureRef& TextureIn(const Material& material, const SlotInfo& slot);

// The channels of it that are read: bits of ChannelMask.
int ChannelsIn(const Material& material, const SlotInfo& slot);

// Calls body(SlotInfo) for each texture whose bit is set.
template <class Body>
void ForEachSlotOf(ShadingModel model, MaterialFeatures features, const Body& body) {
  for (const SlotInfo& slot : SlotsOf(model)) {
    if ((features & BitOf(slot.slot)) != 0) body(slot);
  }
}

// The base colour, with the coverage as alpha, without textures.
glm::vec4 BaseColorOf(const ModelParameters& parameters);

// The texture that has the coverage, and its channel.
struct CoverageTexture {
  Slot slot = Slot::BaseColor;
  int channel = 3;
};
CoverageTexture CoverageOf(const ModelParameters& parameters);

// The parameters without what the settings disable. Features that they state are added to `stated`.
ModelParameters WithoutFeatures(const ModelParameters& parameters, FeatureSet disabled, FeatureSet& stated);

// Whether a model has parameters of its own: all but glTF's.
constexpr bool HasParameters(ShadingModel model) { return model > ShadingModel::Unlit; }

// The parameters of such a model, as its documentation has them by default.
ModelParameters DefaultsOf(ShadingModel model);

// The alpha mode that parameters state: by Filament's blending. The other models leave it to the material.
template <class Block>
constexpr std::optional<AlphaMode> AlphaModeOf(const Block&) {
  return std::nullopt;
}
std::optional<AlphaMode> AlphaModeOf(const ModelParameters& parameters);

// The model of a parameter block: that of the same name.
ShadingModel ModelOf(const ModelParameters& parameters);

}  // namespace facet
