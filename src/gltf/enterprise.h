// Materials that state parameters of DSPBR, the Dassault Systèmes Enterprise PBR Shading Model, beside glTF's.
#pragma once

#include <functional>
#include <map>
#include <set>
#include <string_view>

#include "facet/scene.h"
#include "gltf/json_fields.h"

namespace facet::gltf {

// Extensions by the draft texts of the specification's repository (gltf_ext, 2022x), and one that states parameters by
// the names that they have in the specification.
inline constexpr std::string_view kEnterpriseExtensions[] = {"3DS_materials_anisotropy",     "3DS_materials_emission",
                                                             "3DS_materials_enterprise_pbr", "3DS_materials_sss",
                                                             "3DS_materials_translucency",   "3DS_materials_volume"};

// The properties of each.
std::map<std::string_view, std::set<std::string_view>> EnterpriseProperties();

bool IsEnterpriseExtension(std::string_view name);

// Whether a material has one of them. Its "extras" count as its extensions, as in the specification's validation suite
// (ParseJson() has moved them).
bool IsEnterprise(const Json& material, const Place& place);

using ReadTextureInfo = std::function<TextureRef(const Json& info, const Place& place)>;

// Turns a material, as core glTF and KHR extensions state it, into one of the model "enterprise" with what the
// extensions add.
void ReadEnterprise(const Json& object, const Place& place, const ReadTextureInfo& read_texture, Material& material);

}  // namespace facet::gltf
