// The slow, exact renderer: what the rasterizer's pictures are measured against.
//
// The same scene, camera, material model and conventions, but: double precision; visibility by trying every surface at
// each sample, without snapping; textures without mip levels; light from all around by integration over the whole
// environment; no tables. What is random in it (where samples lie, which directions are tried) is drawn from scrambled
// low-discrepancy sequences, so that every pixel comes with an estimate of its own remaining error.
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <limits>
#include <string>
#include <vector>

#include "facet/film.h"
#include "facet/render.h"
#include "facet/scene.h"

namespace facet {

// The picture is the mean of `batches` independent ones. More samples to a batch converge faster than more batches
// (about as N^-3/4 and N^-1/2); batches are what the error is estimated from.
struct ReferenceSettings {
  // Samples per pixel and batch, over a box one pixel wide. Best are powers of two. 1 to 65536.
  int samples = 64;
  // Of each of three kinds (towards bright parts of the environment, the specular lobe, the cosine), for each sample of
  // a lit surface. Best are powers of two. 1 to 1024.
  int environment_samples = 2;
  // The most batches, 2 to 65536.
  int batches = 16;
  // Stops as soon as ReferenceFilm::relative_error is no larger and there are 4 batches at least. 0: never.
  double target_error = 0.0;
  // Seconds; no batch is begun that would probably end later, but two are always made. The number of batches, and so
  // the picture, then depends on the machine's speed.
  double time_budget = std::numeric_limits<double>::infinity();
  // Seconds: where those two are not made by then there is no picture, but an Error(InvalidUsage).
  double give_up_after = std::numeric_limits<double>::infinity();
  // Another seed, another picture, independent of the first.
  std::uint64_t seed = 0;
};

struct ReferenceFilm {
  int width = 0;
  int height = 0;
  std::vector<glm::dvec4> pixels;          // as in Film: linear light, premultiplied by coverage alpha
  std::vector<glm::dvec4> standard_error;  // of each number of `pixels`: of the mean over the batches
  double rms_error = 0.0;                  // root of the mean square of R, G and B's standard errors
  double relative_error = 0.0;  // that, divided by the root of the mean square of R, G and B; 0 for a black picture
  int batches = 0;
  double seconds = 0.0;            // wall clock
  std::vector<std::string> notes;  // what was replaced or done without, one line each
};

// Of `settings` it reads the picture's size, threads, scene, animation, time, variant, camera, environment, background,
// what it is without, and progress (called from this thread after each batch); no choice of approximation. Apart from
// `time_budget`, the same bits on any number of threads. Throws Error as Render() does, and InvalidUsage for reference
// settings out of range or a fragment shader of one's own.
ReferenceFilm RenderReference(const Scene& scene, const RenderSettings& settings,
                              const ReferenceSettings& reference = {});

// Rounded to floats, for display and comparison.
Film ToFilm(const ReferenceFilm& reference);

}  // namespace facet
