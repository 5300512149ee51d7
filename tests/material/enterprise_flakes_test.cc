// Flakes of the model "enterprise": how much of a surface they cover, what they reflect on average, that they stay
// where they are, and that their mean is what a pixel shows where they are small.
#include <gtest/gtest.h>

#include <algorithm>

#include "material/enterprise_point.h"

namespace facet {
namespace {

namespace lanes = HWY_NAMESPACE;
using lanes::FlakeInputs;
using lanes::FlakeLayer;
using lanes::SurfaceView;
using lanes::Vec3;
using testing::ViewAt;

SurfaceView<double> Seen(double n_dot_v) { return {{0.0, 0.0, 1.0}, ViewAt(n_dot_v), n_dot_v}; }

// A square metre of texture, with about 1000 flakes in each direction.
FlakeInputs<double> Inputs(double coverage, double roughness) {
  FlakeInputs<double> in{};
  in.metres_per_uv = 1.0;
  in.coverage = coverage;
  in.size_mm = 1.0 / 0.80592744885;
  in.roughness = roughness;
  in.color = in.flip_flop_color = {1.0, 1.0, 1.0};
  in.tangent = {1.0, 0.0, 0.0};
  in.bitangent = {0.0, 1.0, 0.0};
  return in;
}

// The mean of visit(layer) over places that are spread evenly over the texture.
template <class Visit>
double Mean(FlakeInputs<double> in, const SurfaceView<double>& at, int count, const Visit& visit) {
  double sum = 0.0;
  for (int i = 0; i < count; ++i) {
    in.at.uv = {std::fmod((i + 0.5) * 0.7548776662466927, 1.0), std::fmod((i + 0.5) * 0.5698402909980532, 1.0)};
    sum += visit(FlakeLayer<double>(in, at));
  }
  return sum / count;
}

TEST(EnterpriseFlakes, CoverTheirShareOfTheSurface) {
  for (const double coverage : {0.0, 0.05, 0.25, 0.5, 0.8, 1.0}) {
    const double share = Mean(Inputs(coverage, 0.2), Seen(1.0), 100000, [](const auto& f) { return f.Share(); });
    EXPECT_NEAR(share, coverage, 1e-2);
    EXPECT_TRUE(share == coverage || (coverage > 0.0 && coverage < 1.0));
  }
}

// D(h) (h.n): cos^2 of the tilt has the distribution function that the specification samples.
TEST(EnterpriseFlakes, AreTiltedAsGgxHasIt) {
  for (const double roughness : {0.1, 0.5, 1.0}) {
    const FlakeLayer<double> any(Inputs(1.0, roughness), Seen(1.0));
    const double a2 = any.widths.tilt * any.widths.tilt;
    for (const double c2 : {0.9, 0.6, 0.3}) {
      // Walter et al., 2007, equation 35: the share of normals within an angle is tan^2 / (alpha^2 + tan^2).
      const double tan2 = 1.0 / c2 - 1.0, expected = tan2 / (a2 + tan2);
      const double within = Mean(Inputs(1.0, roughness), Seen(1.0), 100000,
                                 [&](const auto& f) { return f.flake_normal.z * f.flake_normal.z >= c2 ? 1.0 : 0.0; });
      EXPECT_NEAR(within, expected, 1e-2) << roughness << " " << c2;
    }
  }
}

TEST(EnterpriseFlakes, WidthsAddUp) {
  for (const double roughness : {0.0, 0.05, 0.1, 0.25, 1.0}) {
    const lanes::FlakeWidths<double> w(roughness);
    EXPECT_NEAR(w.tilt * w.tilt + w.cone * w.cone, w.whole * w.whole, 1e-12);
    // The cone's angle is at most 7 degrees.
    EXPECT_LE(1.0 - w.one_minus_cosine, 1.0);
    EXPECT_GE(1.0 - w.one_minus_cosine, std::cos(7.0 / 180.0 * 3.14159265358979324) - 1e-6);
  }
}

// What many flakes reflect of a light, averaged over a patch of directions so that single flakes do not count, is the
// mean that pixels show where flakes are small. A cone does not blur as GGX does, which shows where the cone is nearly
// as wide as the tilts.
TEST(EnterpriseFlakes, TheMeanOfLightsIsThatOfMany) {
  for (const double roughness : {0.15, 0.4}) {
    for (const double n_dot_v : {1.0, 0.6}) {
      const SurfaceView<double> at = Seen(n_dot_v);
      FlakeInputs<double> in = Inputs(1.0, roughness);
      FlakeInputs<double> small = in;
      small.size_mm = 0.0;
      const FlakeLayer<double> many(small, at);
      EXPECT_EQ(many.filtered, 1.0);
      for (const double tilt : {0.0, 0.15}) {
        // A light near the mirror direction.
        const Vec3<double> l =
            lanes::NormalizeOr(Vec3<double>{-at.view.x + tilt, 0.3 * tilt, at.view.z}, Vec3<double>{0.0, 0.0, 1.0});
        const double single = Mean(in, at, 200000, [&](const auto& f) { return f.Direct(at, l).y; });
        EXPECT_NEAR(single, many.Direct(at, l).y, (roughness < 0.2 ? 0.2 : 0.05) * single)
            << roughness << " " << n_dot_v << " " << tilt;
      }
    }
  }
}

Image ConstantImage() {
  Image image{64, 32, 3, ChannelType::F32, Encoding::Linear, {}};
  image.bytes.resize(image.PixelCount() * 3 * sizeof(float));
  for (std::size_t i = 0; i < image.PixelCount() * 3; ++i) image.As<float>()[i] = 1.0f;
  return image;
}

// The same under a white environment, where the mean is a closed form.
TEST(EnterpriseFlakes, TheMeanOfTheEnvironmentIsThatOfMany) {
  const auto environment = PrefilterEnvironment(ConstantImage());
  const LightingData data = testing::EnterpriseLighting(environment.get());
  const lanes::LightingView<double> lighting(data);
  for (const double roughness : {0.0, 0.25, 0.6, 1.0}) {
    for (const double n_dot_v : {1.0, 0.5, 0.1}) {
      const SurfaceView<double> at = Seen(n_dot_v);
      FlakeInputs<double> in = Inputs(0.7, roughness), small = in;
      small.size_mm = 0.0;
      const double many = FlakeLayer<double>(small, at).Environment(at, lighting).y;
      const double single = Mean(in, at, 100000, [&](const auto& f) { return f.Environment(at, lighting).y; });
      EXPECT_NEAR(single, many, 1e-2) << roughness << " " << n_dot_v;
    }
  }
}

// Half of very rough flakes face away; flat ones reflect all.
TEST(EnterpriseFlakes, MeanAlbedoAtItsEnds) {
  for (const double n_dot_v : {1.0, 0.3, 0.01}) {
    const SurfaceView<double> at = Seen(n_dot_v);
    EXPECT_NEAR(FlakeLayer<double>(Inputs(1.0, 1.0), at).MeanAlbedo(n_dot_v), 0.5, 1e-9);
    EXPECT_GT(FlakeLayer<double>(Inputs(1.0, 0.0), at).MeanAlbedo(n_dot_v), 0.9);
  }
  EXPECT_NEAR(FlakeLayer<double>(Inputs(1.0, 0.5), Seen(1.0)).MeanAlbedo(1.0), 1.0 / (1.0 + 0.25), 1e-9);
}

TEST(EnterpriseFlakes, StayWhereTheyAre) {
  FlakeInputs<double> in = Inputs(0.5, 0.3);
  for (int i = 0; i < 1000; ++i) {
    in.at.uv = {i * 0.00137, 0.3 + i * 0.00071};
    in.at.dx = {1e-5, 0.0}, in.at.dy = {0.0, 1e-5};
    const FlakeLayer<double> before(in, Seen(1.0));
    in.at.dx = {2e-4, 1e-5};  // the camera has moved
    const FlakeLayer<double> after(in, Seen(0.4));
    EXPECT_EQ(before.is_flake, after.is_flake);
    EXPECT_EQ(before.flake_normal.x, after.flake_normal.x);
    EXPECT_EQ(before.flake_normal.z, after.flake_normal.z);
  }
}

TEST(EnterpriseFlakes, FadeToTheirMeanBelowAPixel) {
  FlakeInputs<double> in = Inputs(0.5, 0.3);
  const auto filtered = [&](double cells_per_pixel) {
    in.at.dx = {cells_per_pixel * 1e-3, 0.0};
    return FlakeLayer<double>(in, Seen(1.0)).filtered;
  };
  EXPECT_EQ(filtered(0.1), 0.0);
  EXPECT_NEAR(filtered(0.4999), 0.0, 1e-6);
  EXPECT_NEAR(filtered(0.75), 0.5, 1e-6);
  EXPECT_NEAR(filtered(1.0001), 1.0, 1e-6);
  EXPECT_EQ(filtered(50.0), 1.0);
  in.at.dx = {0.0, 0.0};
  in.metres_per_uv = 0.0;
  EXPECT_EQ(FlakeLayer<double>(in, Seen(1.0)).filtered, 1.0) << "without texture coordinates";
}

// At normal incidence the flip-flop colour, at grazing angles that of the flakes.
TEST(EnterpriseFlakes, FlipFlop) {
  FlakeInputs<double> in = Inputs(1.0, 0.3);
  in.size_mm = 0.0;
  in.color = {1.0, 0.0, 0.0};
  in.flip_flop_color = {0.0, 1.0, 0.0};
  const auto share_of_green = [&](double flip_flop, double angle) {
    in.flip_flop = flip_flop;
    const SurfaceView<double> at = Seen(std::cos(angle));
    const Vec3<double> value = FlakeLayer<double>(in, at).Direct(at, {-at.view.x, 0.0, at.view.z});
    return value.y / (value.x + value.y);
  };
  EXPECT_EQ(share_of_green(0.0, 0.0), 0.0);
  EXPECT_NEAR(share_of_green(0.5, 0.0), 1.0, 1e-6);
  EXPECT_NEAR(share_of_green(1.0, 1.0), std::cos(1.0), 1e-6);
  EXPECT_NEAR(share_of_green(0.5, 1.0), std::pow(std::cos(1.0), 4.0), 1e-6);
}

}  // namespace
}  // namespace facet
