// The roofline of a frame: how fast this machine does what the frame cannot do without, and nothing else, beside the
// frame as facet::Renderer draws it.
//   roofline MODEL HDRI [WIDTH HEIGHT [REPEATS]]     (default: 1920 1080 20)
// The same camera as orbit_bench's first frame at radius 3.2, one sample, the environment as light and background.
//
// What the frame needs is recorded while it is drawn, by a fragment shader in the place of facet's own:
//   texels       each fragment's footprint, trilinear and along its major axis, read as if all textures of the material
//                lay in one texel of 16 bytes: in the order of the frame, from squares of 4 x 4 texels
//   tables       prefiltered environment (two levels), irradiance, albedo tables: 16 reads of 16 bytes in the cache
//   arithmetic   as many additions and multiplications, divisions and roots as facet's shader does for a fragment,
//   counted
//                by running it on numbers that count; in lanes, none waiting for another. Addresses are not counted,
//                nor is the weighing of texels, which is done in integers
//   background   four pixels of the image for each pixel that the model leaves free, and the arithmetic of its
//   direction film         16 bytes a pixel, written once
// Nothing is counted for vertices, triangle set-up and visibility. Each part is timed alone (the least of the repeats)
// with one and two threads; their sum is what the frame is measured against.
#include <algorithm>
#include <barrier>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <functional>
#include <memory>
#include <thread>
#include <vector>

#include "base/pages.h"
#include "counted_float-inl.h"
#include "facet/facet.h"
#include "facet/shader.h"
#include "light/lighting-inl.h"
#include "material/models/metallic_roughness-inl.h"
#include "roofline_kernels.h"
#include "shade/interpolate-inl.h"
#include "shade/material_view-inl.h"
#include "shade/shade_task.h"

HWY_BEFORE_NAMESPACE();
namespace facet {
namespace HWY_NAMESPACE {
template <>
inline constexpr bool kWholeWeights<Counted> = true;  // as lanes filter
}  // namespace HWY_NAMESPACE
namespace {

namespace lanes = HWY_NAMESPACE;
using lanes::Counted;

// A mip pyramid of 16-byte texels.
struct Pyramid {
  int levels = 0;
  std::int32_t width[16] = {}, height[16] = {}, pitch[16] = {}, offset[16] = {};
  PageVector<std::int32_t> words;

  void Allocate(int w, int h) {
    std::int32_t texels = 0;
    for (levels = 0; levels < 16; ++levels) {
      width[levels] = w, height[levels] = h, pitch[levels] = (w + 3) / 4, offset[levels] = texels;
      texels += pitch[levels] * ((h + 3) / 4) * 16;
      if (w == 1 && h == 1) break;
      w = std::max(w / 2, 1), h = std::max(h / 2, 1);
    }
    ++levels;
    words.resize(std::size_t(texels) * 4 + 4096);
    for (std::size_t i = 0; i < words.size(); ++i) words[i] = static_cast<std::int32_t>(i);
  }
};

// Draws nothing, and notes what drawing would have read and computed.
class Recorder final : public FragmentShader {
 public:
  void Shade(const ShadeTask& task) const override {
    for (float* plane : {task.red, task.green, task.blue, task.alpha}) std::fill_n(plane, task.count, 0.0f);
    const FrameMaterial& m = *task.material;
    const BoundTexture* texture = nullptr;  // the textures of one material share their footprint, or are taken to
    for (const BoundTexture& t : m.textures) {
      if (t.data != nullptr && texture == nullptr) texture = &t;
    }
    const lanes::MaterialView<Counted> material(m);
    const lanes::LightingView<Counted> lighting(*task.lighting);
    for (std::size_t i = 0; i < task.count; ++i) {
      if (texture != nullptr) Note(*texture, lanes::InterpolateSurface<float>(task, i));
      if (++fragments % 64 != 0) continue;
      ++counted;
      Count(shading,
            [&] { lanes::MetallicRoughness()(lanes::InterpolateSurface<Counted>(task, i), material, lighting); });
      if (task.lighting->environment != nullptr) {
        Count(background, [&] { lighting.Background(lanes::Vec3<Counted>{0.3f, -0.2f, -0.9f}); });
      }
    }
  }

  mutable std::vector<std::uint32_t> taps;
  mutable Pyramid pyramid;
  mutable std::size_t fragments = 0, counted = 0;
  mutable OperationCounts shading, background;  // sums over the counted ones

 private:
  template <class Work>
  static void Count(OperationCounts& sums, Work work) {
    const auto simple = Counted::simple, divisions = Counted::divisions, roots = Counted::roots;
    work();
    sums.simple += double(Counted::simple - simple);
    sums.divisions += double(Counted::divisions - divisions);
    sums.roots += double(Counted::roots - roots);
  }

  void Note(const BoundTexture& slot, const lanes::Surface<float>& s) const {
    if (pyramid.levels == 0) pyramid.Allocate(slot.data->level_width[0], slot.data->level_height[0]);
    const int k = slot.uv_slot;
    const double w = pyramid.width[0], h = pyramid.height[0];
    const double ux = s.duv_dx[k].x * w, vx = s.duv_dx[k].y * h, uy = s.duv_dy[k].x * w, vy = s.duv_dy[k].y * h;
    // The ellipse's axes: singular values of the map from pixels to texels.
    const double a = ux * ux + uy * uy, b = ux * vx + uy * vy, c = vx * vx + vy * vy;
    const double major = std::sqrt(std::max((a + c) / 2 + std::hypot((a - c) / 2, b), 1e-30));
    const double minor = std::max(std::fabs(ux * vy - uy * vx) / major, 1e-12);
    const int along = major <= 1.0 ? 1 : int(std::clamp(std::ceil(major / minor), 1.0, double{slot.max_anisotropy}));
    const double lod = std::clamp(std::log2(std::max(major / along, minor)), 0.0, double(pyramid.levels - 1));
    const double angle = std::atan2(major * major - a, b);  // of the major axis in texels
    for (int tap = 0; tap < along; ++tap) {
      const double t = ((tap + 0.5) / along - 0.5) * major;
      const double u = s.uv[k].x + t * std::cos(angle) / w, v = s.uv[k].y + t * std::sin(angle) / h;
      for (int level = int(lod); level <= int(std::ceil(lod)); ++level) NoteTap(u, v, level);
    }
  }

  void NoteTap(double u, double v, int level) const {
    const int w = pyramid.width[level], h = pyramid.height[level];
    const auto texel = [](double x, int size) {
      x -= std::floor(x);
      return std::clamp(int(x * size - 0.5), 0, std::max(size - 2, 0));
    };
    const int x = std::isfinite(u) ? texel(u, w) : 0, y = std::isfinite(v) ? texel(v, h) : 0;
    const std::int32_t number =
        pyramid.offset[level] + ((y / 4) * pyramid.pitch[level] + x / 4) * 16 + (y % 4) * 4 + x % 4;
    taps.push_back(std::uint32_t(number) | std::uint32_t(level) << kTapLevelShift);
  }
};

double Now() {
  return std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

volatile double sink;  // what is computed must be wanted

// Milliseconds of work(part, parts) on so many threads, the least of some repeats.
double Time(int threads, int repeats, const std::function<double(int, int)>& work) {
  std::vector<double> results(std::size_t(threads), 0.0);
  std::barrier together(threads);
  const auto run = [&](int t) {
    double best = HUGE_VAL;
    for (int r = 0; r < repeats; ++r) {
      together.arrive_and_wait();
      const double start = Now();
      results[std::size_t(t)] += work(t, threads);
      together.arrive_and_wait();
      best = std::min(best, Now() - start);
    }
    return best;
  };
  std::vector<std::thread> others;
  for (int t = 1; t < threads; ++t) others.emplace_back(run, t);
  const double best = run(0);
  for (std::thread& other : others) other.join();
  for (const double result : results) sink = sink + result;
  return best;
}

int Main(int argc, char** argv) {
  if (argc < 3) {
    std::fprintf(stderr, "usage: roofline MODEL HDRI [WIDTH HEIGHT [REPEATS]]\n");
    return 2;
  }
  const LoadedScene loaded = LoadGltf(argv[1]);
  RenderSettings settings;
  settings.environment.kind = EnvironmentSettings::Kind::Image;
  settings.environment.image = std::make_shared<const Image>(LoadImage(argv[2]));
  settings.background = Background::Environment;
  settings.width = argc > 4 ? std::atoi(argv[3]) : 1920;
  settings.height = argc > 4 ? std::atoi(argv[4]) : 1080;
  const int repeats = std::max(argc > 5 ? std::atoi(argv[5]) : 20, 1);
  settings.samples = settings.threads = 1;
  OrbitCamera camera;
  camera.radius = 3.2, camera.target = glm::dvec3(0.0);
  settings.camera = camera;

  Renderer renderer(loaded.scene);
  Film film;
  Recorder recorder;
  settings.shader = &recorder;
  renderer.Render(settings, film);
  settings.shader = nullptr;
  const auto mean = [&](const OperationCounts& sums) {
    const double n = double(std::max<std::size_t>(recorder.counted, 1));
    return OperationCounts{sums.simple / n, sums.divisions / n, sums.roots / n};
  };
  const OperationCounts shading = mean(recorder.shading), background = mean(recorder.background);
  const std::size_t pixels = film.pixels.size(), covered = recorder.fragments;
  const std::size_t free_pixels = pixels - std::min(pixels, covered);  // right for opaque models
  const Image& image = *settings.environment.image;
  const std::size_t image_width = std::size_t(image.width), image_pixels = image_width * std::size_t(image.height);
  constexpr int kTableBits = 16;  // 1 MiB
  std::vector<std::int32_t> table(std::size_t{4} << kTableBits, 1), panorama(image_pixels * 4, 1);
  std::vector<float> target(pixels * 4, 0.0f);
  // An image's pixel of the panorama is as wide as so many of the frame.
  const float enlarged = float(settings.height) / (45.0f / 180.0f * float(image.height));

  std::printf("%zu fragments, %zu pixels of background, %.2f taps a fragment (of 2 x 2 texels)\n", covered, free_pixels,
              double(recorder.taps.size()) / double(std::max<std::size_t>(covered, 1)));
  std::printf(
      "a fragment: %.0f simple operations, %.1f divisions, %.1f roots; a pixel of background: %.0f, %.1f, %.1f\n\n",
      shading.simple, shading.divisions, shading.roots, background.simple, background.divisions, background.roots);

  struct Part {
    const char* name;
    std::function<double(int, int)> work;
  };
  const auto share = [](std::size_t n, int part, int parts) {  // the first and the number of a part
    const std::size_t first = n * std::size_t(part) / std::size_t(parts);
    return std::pair(first, n * std::size_t(part + 1) / std::size_t(parts) - first);
  };
  const std::vector<Part> parts = {
      {"texels",
       [&](int t, int n) {
         const auto [first, count] = share(recorder.taps.size(), t, n);
         return double(
             ReadTaps(recorder.taps.data() + first, count, recorder.pyramid.words.data(), recorder.pyramid.pitch));
       }},
      {"tables",
       [&](int t, int n) { return double(ReadTable(table.data(), kTableBits, share(covered, t, n).second, 16)); }},
      {"arithmetic", [&](int t, int n) { return double(Compute(shading, share(covered, t, n).second)); }},
      {"background: reads",
       [&](int t, int n) {
         return double(
             ReadImage(panorama.data(), image_pixels, image_width, share(free_pixels, t, n).second, enlarged));
       }},
      {"background: arithmetic",
       [&](int t, int n) { return double(Compute(background, share(free_pixels, t, n).second)); }},
      {"film",
       [&](int t, int n) {
         const auto [first, count] = share(pixels, t, n);
         WritePixels(target.data() + first * 4, count);
         return double{target[first * 4]};
       }},
  };
  std::printf("| part | 1 thread, ms | 2 threads, ms |\n|---|---|---|\n");
  double sum[2] = {}, most[2] = {}, frame[2] = {};
  for (const Part& part : parts) {
    double ms[2];
    for (int i = 0; i < 2; ++i) {
      ms[i] = Time(i + 1, repeats, part.work);
      sum[i] += ms[i];
      most[i] = std::max(most[i], ms[i]);
    }
    std::printf("| %s | %.2f | %.2f |\n", part.name, ms[0], ms[1]);
  }
  for (int i = 0; i < 2; ++i) {
    settings.threads = i + 1;
    renderer.Render(settings, film);
    frame[i] = Time(1, repeats, [&](int, int) { return renderer.Render(settings, film), double{film.pixels[0].r}; });
  }
  std::printf("| **sum** | %.2f | %.2f |\n| frame | %.2f | %.2f |\n", sum[0], sum[1], frame[0], frame[1]);
  std::printf("| frame / sum | %.2f | %.2f |\n", frame[0] / sum[0], frame[1] / sum[1]);
  std::printf("| frame / longest part (all overlapped) | %.2f | %.2f |\n", frame[0] / most[0], frame[1] / most[1]);
  std::printf("| 2 threads' gain: sum, frame | %.2f | %.2f |\n", sum[0] / sum[1], frame[0] / frame[1]);
  return 0;
}

}  // namespace
}  // namespace facet
HWY_AFTER_NAMESPACE();

int main(int argc, char** argv) try { return facet::Main(argc, argv); } catch (const std::exception& error) {
  std::fprintf(stderr, "roofline: %s\n", error.what());
  return 1;
}
