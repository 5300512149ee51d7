// The subtypes of DSPBR's material (params-2025x.json of its specification). Those of 2022x are the same, without the
// translucency colour of plastic.
#include <string>

#include "facet/error.h"
#include "facet/models/enterprise.h"

namespace facet {
namespace {

void SetCarPaint(EnterpriseParameters& p) {
  const glm::vec3 blue(0.255f, 0.459f, 0.624f);
  p.albedo.value = {0.009f, 0.013f, 0.028f};
  p.roughness.value = 0.4f;
  p.flake_coverage.value = 0.8f;
  p.flake_color.value = p.flip_flop_color.value = blue;
  p.flake_size.value = 0.05f;
  p.flake_roughness.value = 0.25f;
  p.clearcoat.value = 1.0f;
}

void SetEmissive(EnterpriseParameters& p) {
  p.albedo.value = p.specular_tint.value = glm::vec3(0.0f);
  p.specular.value = 0.0f;
  p.emission_color.value = {0.5f, 0.442f, 0.298f};
  p.emission_value = 10.0f;
}

void SetGlass(EnterpriseParameters& p) {
  p.transparency.value = 1.0f;
  p.thin_walled = false;
  p.attenuation_color = glm::vec3(0.99f);
  p.attenuation_distance = 0.005f;
}

}  // namespace

EnterpriseParameters EnterprisePreset(std::string_view name) {
  const glm::vec3 cloth(0.302f, 0.294f, 0.236f);
  EnterpriseParameters p;
  if (name == "basic") {
    p.albedo.value = glm::vec3(0.284f);
    p.roughness.value = 0.3f;
  } else if (name == "metal") {
    p.albedo.value = glm::vec3(0.5f);
    p.metallic.value = 1.0f;
    p.roughness.value = 0.1f;
  } else if (name == "plastic") {
    p.albedo.value = p.translucency_color.value = glm::vec3(0.004f);
    p.roughness.value = 0.25f;
    p.attenuation_distance = 1e-5f;
  } else if (name == "glass") {
    SetGlass(p);
  } else if (name == "textile") {
    p.albedo.value = cloth;
    p.roughness.value = 0.4f;
    p.sheen_color.value = glm::vec3(0.5f);
    p.sheen_roughness.value = 0.53f;
  } else if (name == "leather") {
    p.albedo.value = cloth;
    p.roughness.value = 0.4f;
  } else if (name == "wood") {
    p.albedo.value = {0.344f, 0.227f, 0.07f};
    p.roughness.value = 0.5f;
    p.clearcoat.value = 1.0f;
  } else if (name == "carpaint") {
    SetCarPaint(p);
  } else if (name == "emissive") {
    SetEmissive(p);
  } else {
    std::string list;
    for (const std::string_view preset : kEnterprisePresets) list += (list.empty() ? "" : ", ") + std::string(preset);
    throw Error(ErrorCode::InvalidUsage, "the model \"enterprise\" has no preset \"" + std::string(name) + "\"", {},
                "use one of " + list);
  }
  return p;
}

}  // namespace facet
