// How much a part of the reference's image tells of the whole: the table of docs/accuracy.md. Nothing here is a time.
//   reference_parts [--size N] MODEL...
// The default settings with the studio, against a reference of 2 x 16 samples a pixel; parts of 100 orders of its
// blocks.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <filesystem>

#include "facet/compare.h"
#include "facet/film.h"
#include "facet/load.h"
#include "facet/render.h"
#include "measure/measure.h"
#include "reference/reference.h"

namespace {

struct Spread {
  double sum = 0.0, sum2 = 0.0;
  int count = 0;

  void Add(double value) { sum += value, sum2 += value * value, ++count; }
  double Mean() const { return sum / count; }
  double RootMeanSquare() const { return std::sqrt(sum2 / count); }
  double Deviation() const { return std::sqrt(std::max(sum2 / count - Mean() * Mean(), 0.0)); }
};

void PrintScene(const std::filesystem::path& path, int size) {
  const facet::LoadedScene loaded = facet::LoadGltf(path);
  facet::RenderSettings settings;
  settings.width = settings.height = size;
  settings.environment.kind = facet::EnvironmentSettings::Kind::Studio;
  facet::ReferenceSettings effort;
  effort.samples = 16;
  effort.batches = 2;
  const facet::ReferenceFilm whole = facet::RenderReference(loaded.scene, settings, effort);
  const facet::Film used = facet::Render(loaded.scene, settings);
  settings.samples = 1;
  const facet::Film cheap = facet::Render(loaded.scene, settings);
  const double of_used = facet::ErrorOf(used, whole).relative_rmse;
  const double ratio = facet::ErrorOf(cheap, whole).relative_rmse / of_used;

  facet::ReferenceFilm part = whole;
  part.whole = false;
  const facet::Image encoded = facet::EncodeFilm(facet::ToFilm(whole), {}), image = facet::EncodeFilm(used, {});
  const double flip = facet::FlipJudge(whole, encoded).Judge(image).mean;
  const double flip_by_blocks = facet::FlipJudge(part, encoded).Judge(image).mean;
  for (const double share : {0.03, 0.1, 0.33}) {
    Spread errors, said, ratios;
    for (std::uint64_t seed = 0; seed < 100; ++seed) {
      part.blocks = facet::SpreadBlocks(size, size, seed);
      part.blocks.resize(std::size_t(std::ceil(share * double(part.blocks.size()))));
      part.known_pixels = 0;
      for (const facet::PixelBlock& block : part.blocks) part.known_pixels += std::size_t(block.width * block.height);
      const facet::FilmError error = facet::ErrorOf(used, part);
      errors.Add(error.relative_rmse);
      said.Add(error.standard_error);
      if (error.relative_rmse > 0.0) ratios.Add(facet::ErrorOf(cheap, part).relative_rmse / error.relative_rmse);
    }
    std::printf("| %s | %.0f %% | %.4f | %.4f | %.4f | %.4f | %.2f | %.2f | %.2f | %+.1f %% |\n", path.stem().c_str(),
                100.0 * share, of_used, errors.Mean(), errors.Deviation(), said.RootMeanSquare(), ratio, ratios.Mean(),
                ratios.Deviation(), 100.0 * (flip_by_blocks / flip - 1.0));
  }
}

}  // namespace

int main(int argc, char** argv) try {
  int size = 512, first = 1;
  if (argc > 2 && std::strcmp(argv[1], "--size") == 0) size = std::atoi(argv[2]), first = 3;
  if (argc <= first || size < 1) {
    std::fprintf(stderr, "usage: reference_parts [--size N] MODEL...\n");
    return 2;
  }
  std::printf(
      "| scene | blocks | relative RMSE of all | mean of parts | their deviation | standard error | 1 sample / default "
      "of all | mean of parts | their deviation | FLIP by blocks |\n|---|---|---|---|---|---|---|---|---|---|\n");
  for (int i = first; i < argc; ++i) PrintScene(argv[i], size);
  return 0;
} catch (const std::exception& error) {
  std::fprintf(stderr, "reference_parts: %s\n", error.what());
  return 1;
}
