// Steady frames, as an interactive viewer or a turntable draws them: the file is loaded, the camera goes round.
//   orbit_bench MODEL [HDRI|none|studio [WIDTH HEIGHT [SAMPLES [THREADS [FRAMES [RADIUS [STEP [ANISOTROPY]]]]]]]]
// STEP: degrees from one frame to the next; 0 draws the same frame again and again, less goes once around.
// It prints one line of JSON: medians over the frames, in milliseconds, without the first frame. Frames are images of
// 8 bits; the environment is the background where it is an image.
#include <algorithm>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <memory>
#include <numbers>
#include <string>
#include <vector>

#include "facet/facet.h"

namespace {

double Now() {
  return std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

double Median(std::vector<double> values) {
  std::sort(values.begin(), values.end());
  return values[values.size() / 2];
}

}  // namespace

int main(int argc, char** argv) try {
  const auto argument = [&](int i, const char* otherwise) { return argc > i ? argv[i] : otherwise; };
  if (argc < 2) {
    std::fprintf(stderr,
                 "usage: orbit_bench MODEL [HDRI|none|studio [W H [SAMPLES [THREADS [FRAMES [RADIUS [STEP "
                 "[ANISOTROPY]]]]]]]]\n");
    return 2;
  }
  const facet::LoadedScene loaded = facet::LoadGltf(argv[1]);
  facet::RenderSettings settings;
  const std::string light = argument(2, "studio");
  if (light == "none") {
    settings.environment.kind = facet::EnvironmentSettings::Kind::None;
  } else if (light != "studio") {
    settings.environment.kind = facet::EnvironmentSettings::Kind::Image;
    settings.environment.image = std::make_shared<const facet::Image>(facet::LoadImage(light));
    settings.background = facet::Background::Environment;
  }
  settings.width = std::atoi(argument(3, "1920"));
  settings.height = std::atoi(argument(4, "1080"));
  settings.samples = std::atoi(argument(5, "1"));
  settings.threads = std::atoi(argument(6, "0"));
  const int frames = std::max(std::atoi(argument(7, "36")), 1);
  const double radius = std::atof(argument(8, "0"));
  const double degrees = std::atof(argument(9, "-1"));
  const double step = (degrees >= 0.0 ? degrees : 360.0 / frames) * std::numbers::pi / 180.0;
  settings.max_anisotropy = std::atoi(argument(10, "8"));

  facet::Renderer renderer(loaded.scene);
  facet::Image image;
  std::vector<double> frame_ms, geometry_ms, raster_ms, fragments, covered;
  double triangles = 0.0;
  for (int i = -1; i < frames; ++i) {
    facet::OrbitCamera camera;
    camera.theta = step * i;
    if (radius > 0.0) camera.radius = radius, camera.target = glm::dvec3(0.0);
    settings.camera = camera;
    facet::RenderStats stats;
    const double start = Now();
    renderer.RenderImage(settings, {}, image, &stats);
    const double rendered = Now();
    if (i < 0) continue;
    frame_ms.push_back(rendered - start);
    geometry_ms.push_back(1e3 * (stats.geometry_seconds + stats.pose_seconds));
    raster_ms.push_back(1e3 * stats.raster_seconds);
    fragments.push_back(double(stats.fragments_shaded + stats.fragments_blended));
    covered.push_back(double(stats.covered_pixels));
    triangles = double(stats.triangles_in);
  }
  std::printf(
      "{\"frame_ms\": %.3f, \"geometry_ms\": %.3f, \"raster_ms\": %.3f, \"fragments\": %.0f, "
      "\"covered_pixels\": %.0f, \"triangles\": %.0f, \"width\": %d, \"height\": %d, \"samples\": %d, \"threads\": "
      "%d}\n",
      Median(frame_ms), Median(geometry_ms), Median(raster_ms), Median(fragments), Median(covered), triangles,
      settings.width, settings.height, settings.samples, settings.threads);
  return 0;
} catch (const std::exception& error) {
  std::fprintf(stderr, "orbit_bench: %s\n", error.what());
  return 1;
}
