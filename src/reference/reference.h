// The slow, exact renderer: what the rasterizer's pictures are measured against.
//
// The same scene, camera, material model and conventions, but: double precision; visibility by trying every surface at
// each sample, without snapping; textures without mip levels; light from all around by integration over the whole
// environment; no tables. What is random in it (where samples lie, which directions are tried) is drawn from scrambled
// low-discrepancy sequences, so that every pixel comes with an estimate of its own remaining error.
#pragma once

#include <cstddef>
#include <cstdint>
#include <glm/glm.hpp>
#include <limits>
#include <memory>
#include <string>
#include <vector>

#include "base/clock.h"
#include "facet/film.h"
#include "facet/scene.h"
#include "facet/settings.h"
#include "reference/spread_blocks.h"

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
  // Seconds by `clock`, from where the scene is made ready. They are spent on two batches of one block of the picture
  // after the other, spread evenly from the first on; where time is left, on further batches of all pixels. What was
  // not reached is left out; a few blocks are always made. How much is done, and so the picture, then depends on the
  // machine's speed; what is known of a pixel does not.
  double time_budget = std::numeric_limits<double>::infinity();
  Clock clock = SteadySeconds;
  // Another seed, another picture, independent of the first.
  std::uint64_t seed = 0;
};

struct ReferenceFilm {
  int width = 0;
  int height = 0;
  std::vector<glm::dvec4> pixels;          // as in Film: linear light, premultiplied by coverage alpha
  std::vector<glm::dvec4> standard_error;  // of each number of `pixels`: of the mean over the batches
  // What it knows; pixels elsewhere are 0.
  std::vector<PixelBlock> blocks;
  std::size_t known_pixels = 0;
  bool whole = false;           // all of them
  double rms_error = 0.0;       // root of the mean square of R, G and B's standard errors, where it is known
  double relative_error = 0.0;  // that, divided by the root of the mean square of R, G and B; 0 for a black picture
  int batches = 0;
  double seconds = 0.0;            // by the clock
  std::vector<std::string> notes;  // what was replaced or done without, one line each
};

// A reference that is made piece by piece.
//
// Of `settings` it reads the picture's size, threads, scene, animation, time, variant, camera, environment, background,
// what it is without, and progress (called now and then from the thread that waits); no choice of approximation. Apart
// from how much there is time for, the same bits on any number of threads.
class ReferenceRun {
 public:
  // Makes the scene ready, which must outlive it. Throws Error as Render() does, and InvalidUsage for reference
  // settings out of range or a fragment shader of one's own.
  ReferenceRun(const Scene& scene, const RenderSettings& settings, const ReferenceSettings& reference = {});
  ~ReferenceRun();

  // Goes on until `seconds` have gone by since its making began, in place of ReferenceSettings::time_budget. The
  // picture as it is then. Once there is one, a call may find that there is no time left for more.
  const ReferenceFilm& Continue(double seconds);

  // How many seconds, from its making on, it would probably take to have no more `relative_error`. Of a run that has
  // been continued.
  double SecondsFor(double relative_error) const;

 private:
  class Work;
  std::unique_ptr<Work> work_;
};

// The same at once.
ReferenceFilm RenderReference(const Scene& scene, const RenderSettings& settings,
                              const ReferenceSettings& reference = {});

// Rounded to floats, for display and comparison.
Film ToFilm(const ReferenceFilm& reference);

}  // namespace facet
