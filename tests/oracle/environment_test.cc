// Light from all around: what a constant one is reflected as, occlusion, and which way an environment lies.
#include <gtest/gtest.h>

#include <memory>

#include "oracle/brdf.h"
#include "oracle/gltf_file.h"

namespace oracle {
namespace {

constexpr int kWidth = 64, kHeight = 32;  // of environments' images

std::shared_ptr<const facet::Image> Environment(const std::function<Vec(int x, int y)>& radiance) {
  auto image = std::make_shared<facet::Image>();
  image->width = kWidth;
  image->height = kHeight;
  image->channels = 3;
  image->type = facet::ChannelType::F32;
  image->encoding = facet::Encoding::Linear;
  image->bytes.resize(kWidth * kHeight * 3 * sizeof(float));
  for (int i = 0; i < kWidth * kHeight; ++i) {
    const Vec v = radiance(i % kWidth, i / kWidth);
    image->As<float>()[3 * i] = float(v.x);
    image->As<float>()[3 * i + 1] = float(v.y);
    image->As<float>()[3 * i + 2] = float(v.z);
  }
  return image;
}

std::function<void(facet::RenderSettings&)> LitBy(std::shared_ptr<const facet::Image> image) {
  return [image](facet::RenderSettings& settings) {
    settings.environment.kind = facet::EnvironmentSettings::Kind::Image;
    settings.environment.image = image;
    settings.environment_size = 64;
  };
}

std::string Material(const Surface& s, const std::string& more = "") {
  return R"({"pbrMetallicRoughness":{"baseColorFactor":)" + List({s.base.x, s.base.y, s.base.z, 1.0}) +
         R"(,"metallicFactor":)" + Number(s.metallic) + R"(,"roughnessFactor":)" + Number(s.roughness) + "}" + more +
         "}";
}

// A wall turned by `angle` from the eye, in constant light.
TEST(Environment, ConstantLightIsReflectedByTheAlbedo) {
  const Vec light = {1.0, 2.0, 0.5};
  const auto environment = Environment([&](int, int) { return light; });
  for (const double metallic : {0.0, 0.4, 1.0}) {
    for (const double roughness : {0.2, 0.5, 1.0}) {
      for (const double angle : {0.0, 0.8, 1.3}) {
        SCOPED_TRACE(Number(metallic) + ", " + Number(roughness) + ", " + Number(angle));
        const Surface surface{{0.9, 0.3, 0.05}, metallic, roughness};
        GltfFile file;
        AddSquare(file, 4.0, Material(surface), "", R"(,"rotation":)" + Numbers(Turn({0, 1, 0}, angle)));
        AddStraightCamera(file, 0.1);
        const Vec normal = Rotated({0, 0, 1}, {0, 1, 0}, angle);
        ExpectColor(Draw(file, 2, 2, LitBy(environment)), 1, 0, ReflectAll(surface, normal, {0, 0, 1}) * light,
                    kLitTolerance, kLitFloor);
      }
    }
  }
}

// White gives back all that comes in.
TEST(Environment, WhiteFurnace) {
  const auto environment = Environment([](int, int) { return Vec{1, 1, 1}; });
  for (const double metallic : {0.0, 0.5, 1.0}) {
    for (const double roughness : {0.1, 0.4, 0.7, 1.0}) {
      GltfFile file;
      AddSquare(file, 4.0, Material({{1, 1, 1}, metallic, roughness}), "",
                R"(,"rotation":)" + Numbers(Turn({1, 0, 0}, 1.0)));
      AddStraightCamera(file, 0.1);
      ExpectColor(Draw(file, 1, 1, LitBy(environment)), 0, 0, {1, 1, 1}, kLitTolerance);
    }
  }
}

// 3.9.3: 1 + strength (red - 1), on light from all around alone: not on lamps, not on emission.
TEST(Environment, OcclusionDimsItAlone) {
  const Surface surface{{0.6, 0.6, 0.6}, 0.0, 0.7};
  GltfFile file;
  const int texture = file.Texture(MakeTexels(1, 1, [](int, int) { return std::vector<int>{64, 255, 10, 255}; }));
  file.Light(R"({"type":"directional","intensity":1.5})", R"(,"rotation":)" + Numbers(Turn({0, 1, 0}, 0.4)));
  AddSquare(file, 1.0,
            Material(surface, R"(,"emissiveFactor":[0.2,0,0],"occlusionTexture":{"strength":0.75,"index":)" +
                                  std::to_string(texture) + "}"));
  AddStraightCamera(file, 1.0);
  const Vec up = {0, 0, 1}, toward = -Rotated({0, 0, -1}, {0, 1, 0}, 0.4);
  const double occlusion = 1.0 + 0.75 * (64 / 255.0 - 1.0);
  const Image image = Draw(file, 2, 2, LitBy(Environment([](int, int) { return Vec{1, 1, 1}; })));
  ExpectColor(image, 0, 0,
              Vec{0.2, 0, 0} + Reflect(surface, up, up, toward) * 1.5 + ReflectAll(surface, up, up) * occlusion,
              kLitTolerance);
}

// docs/conventions.md: u = 1/2 + atan2(z, x) / 2 pi, v = acos(y) / pi; a rotation turns it counter-clockwise seen from
// above. The background shows it.
TEST(Environment, LiesAsTheConventionsSay) {
  // An image whose red is its column and whose green is its row.
  const auto environment = Environment([](int x, int y) { return Vec{(x + 0.5) / kWidth, (y + 0.5) / kHeight, 0.25}; });
  for (const double rotation : {0.0, 0.7}) {
    // Nothing of the image's left and right edge, where red jumps, nor of the poles, is looked at.
    for (const double around : {-1.2, 0.3, 1.1}) {
      for (const double up : {-0.5, 0.4}) {
        SCOPED_TRACE(Number(rotation) + ", " + Number(around) + ", " + Number(up));
        GltfFile file;
        file.Add("cameras", R"({"type":"perspective","perspective":{"yfov":0.01,"aspectRatio":1,"znear":0.1}})");
        // -Z turned up, then around +Y from +X: the direction (cos up cos around, sin up, -cos up sin around).
        file.Add("nodes", R"({"rotation":)" + Numbers(Turn({0, 1, 0}, around - kPi / 2.0)) + R"(,"children":[1]})");
        file.Add("nodes", R"({"camera":0,"rotation":)" + Numbers(Turn({1, 0, 0}, up)) + "}");
        file.Roots({0});
        const Vec seen = {std::cos(up) * std::cos(around), std::sin(up), -std::cos(up) * std::sin(around)};
        const Vec in_image = Rotated(seen, {0, 1, 0}, -rotation);
        const double u = 0.5 + std::atan2(in_image.z, in_image.x) / (2.0 * kPi), v = std::acos(in_image.y) / kPi;
        const auto lit = LitBy(environment);
        const Image image = Draw(file, 1, 1, [&](facet::RenderSettings& settings) {
          lit(settings);
          settings.background = facet::Background::Environment;
          settings.environment.rotation = rotation;
          settings.environment.intensity = 2.0;
        });
        ExpectColor(image, 0, 0, Vec{u, v, 0.25} * 2.0, 1e-4, 1.0);
      }
    }
  }
}

}  // namespace
}  // namespace oracle
