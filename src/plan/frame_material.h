// A material as the shading stage reads it: factors, textures, and which of them count.
#pragma once

#include "facet/scene.h"
#include "material/features.h"
#include "material/parameters.h"
#include "material/slots.h"
#include "texture/texture.h"

namespace facet {

class FragmentShader;  // facet/shader.h

// The most UV sets that one material reads: each of its textures may name another. The attribute setup of a triangle
// stores only those that are read.
inline constexpr int kMaxUvSlots = kSlotCount;

struct FrameMaterial {
  MaterialFeatures features = 0;
  ShadingModel model = ShadingModel::MetallicRoughness;  // Unlit for points and lines without normals
  const FragmentShader* shader = nullptr;                // replaces the model; null: none
  bool vertex_colors = false;
  AlphaMode alpha_mode = AlphaMode::Opaque;
  bool specular_antialiasing = true;
  bool is_seen_through = false;  // it has transmission, and its shader computes what that does
  MaterialFactors factors;
  int uv_slots = 0;               // number of UV sets that it reads
  int uv_sets[kMaxUvSlots] = {};  // TEXCOORD_n of each
  BoundTexture textures[kSlotCount];

  bool Has(MaterialFeatures feature) const { return (features & feature) != 0; }
  bool Reads(Slot slot) const { return Has(BitOf(slot)); }
  const BoundTexture& Texture(Slot slot) const { return textures[IndexOf(slot)]; }
};

}  // namespace facet
