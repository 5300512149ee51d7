// The table of docs/models/lecture.md: what share of a white furnace's light the model reflects, by its choices.
#pragma once

#include <algorithm>
#include <array>
#include <cstdio>
#include <functional>
#include <string>
#include <vector>

#include "material/lecture_model.h"

namespace facet {

struct LectureChoice {
  const char* name;
  bool of_image;  // the split sum; else lights from all directions
  std::function<void(LectureParameters&)> choose;
};

inline std::vector<LectureChoice> LectureChoices() {
  using P = LectureParameters;
  return {
      {"defaults: ggx, schlick-ggx, schlick", false, [](P&) {}},
      {"geometry smith", false, [](P& p) { p.geometry = LectureGeometry::Smith; }},
      {"distribution beckmann, geometry smith", false,
       [](P& p) {
         p.distribution = LectureDistribution::Beckmann;
         p.geometry = LectureGeometry::Smith;
       }},
      {"distribution blinn-phong", false, [](P& p) { p.distribution = LectureDistribution::BlinnPhong; }},
      {"distribution abc (roughness in G only)", false, [](P& p) { p.distribution = LectureDistribution::Abc; }},
      {"specular blinn-phong", false, [](P& p) { p.specular = LectureSpecular::BlinnPhong; }},
      {"fresnel exact (gold's red)", false, [](P& p) { p.fresnel = LectureFresnel::Exact; }},
      {"alpha roughness", false, [](P& p) { p.alpha = LectureAlpha::Roughness; }},
      {"ambient image", true, [](P&) {}},
      {"ambient image, geometry smith", true, [](P& p) { p.geometry = LectureGeometry::Smith; }},
      {"ambient image, alpha roughness", true, [](P& p) { p.alpha = LectureAlpha::Roughness; }},
  };
}

inline constexpr std::array kLectureRoughnesses = {0.0f, 0.25f, 0.5f, 0.75f, 1.0f};
inline constexpr std::array kLectureMetalnesses = {0.0f, 0.5f, 1.0f};
inline constexpr std::array kLectureCosines = {1.0, 0.5, 0.1};

// In the order of metalnesses, then of cosines.
using LectureEnergyRow = std::array<double, kLectureMetalnesses.size() * kLectureCosines.size()>;

inline LectureEnergyRow LectureEnergy(const LectureChoice& choice, float roughness) {
  LectureEnergyRow row{};
  std::size_t i = 0;
  for (const float metalness : kLectureMetalnesses) {
    for (const double n_dot_v : kLectureCosines) {
      LectureParameters p;
      p.roughness.value = roughness;
      p.metalness.value = metalness;
      choice.choose(p);
      row[i++] = choice.of_image ? LectureImageAlbedo(p, n_dot_v) : LectureAlbedo(p, n_dot_v);
    }
  }
  return row;
}

inline std::string LectureEnergyTable() {
  std::string text =
      "| choice | roughness | metalness 0: n·v 1 | 0.5 | 0.1 | metalness 0.5: 1 | 0.5 | 0.1 "
      "| metalness 1: 1 | 0.5 | 0.1 |\n|---|---|---|---|---|---|---|---|---|---|---|\n";
  for (const LectureChoice& choice : LectureChoices()) {
    for (const float roughness : kLectureRoughnesses) {
      char number[32];
      std::snprintf(number, sizeof number, "%.2f", double{roughness});
      text += std::string("| ") + choice.name + " | " + number;
      for (const double share : LectureEnergy(choice, roughness)) {
        std::snprintf(number, sizeof number, " | %.2f", share);
        text += number;
      }
      text += " |\n";
    }
  }
  return text;
}

}  // namespace facet
