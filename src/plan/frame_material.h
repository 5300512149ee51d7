// A material as the shading stage reads it: factors, textures, and which of them count.
#pragma once

#include "facet/models.h"
#include "facet/scene.h"
#include "material/features.h"
#include "material/model_parameters.h"
#include "material/parameters.h"
#include "material/slots.h"
#include "texture/texture.h"

namespace facet {

class FragmentShader;  // facet/shader.h

// The most UV sets that one material reads: each of its textures may name another. The attribute setup of a triangle
// stores only those that are read.
inline constexpr int kMaxUvSlots = kMaxSlots;

struct FrameMaterial {
  MaterialFeatures features = 0;
  ShadingModel model = ShadingModel::MetallicRoughness;  // Unlit for points and lines without normals
  const FragmentShader* shader = nullptr;                // replaces the model; null: none
  bool vertex_colors = false;
  AlphaMode alpha_mode = AlphaMode::Opaque;
  bool specular_antialiasing = true;
  bool is_seen_through = false;  // it has transmission, and its shader computes what that does
  MaterialFactors factors;
  const ModelParameters* parameters = nullptr;  // of models that are not glTF's; not owned
  // Where its coverage is read.
  Slot coverage_slot = Slot::BaseColor;
  int coverage_channel = 3;
  int first_uv_slot = 0;          // of TEXCOORD_0, with kFlakes
  int uv_slots = 0;               // number of UV sets that it reads
  int uv_sets[kMaxUvSlots] = {};  // TEXCOORD_n of each
  BoundTexture textures[kMaxSlots];

  // The model whose slots its textures are in. What is Unlit because it has no surface keeps its own.
  ShadingModel ModelOfSlots() const { return parameters != nullptr ? ModelOf(*parameters) : model; }
  bool Has(MaterialFeatures feature) const { return (features & feature) != 0; }
  bool Reads(Slot slot) const { return Has(BitOf(slot)); }
  template <class Block>
  const Block& Parameters() const {
    return *std::get_if<Block>(parameters);
  }
  // Whether its coverage is textured. That of opaque materials does not count.
  bool ReadsCoverage() const { return Reads(coverage_slot) && alpha_mode != AlphaMode::Opaque; }
  const BoundTexture& Texture(Slot slot) const { return textures[IndexOf(slot)]; }
};

}  // namespace facet
