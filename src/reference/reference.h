// The slow, exact reference renderer, against which the rasterizer's images are measured.
//
// It has the same scene, camera, material model and conventions, but double precision; visibility by testing every
// surface at each sample, without snapping; textures without mip levels; the environment's light by integration over
// the whole environment; and no tables. Sample positions and directions come from scrambled low-discrepancy sequences,
// so that every pixel has an estimate of its own remaining error.
//
// What is seen through surfaces that transmit light is found by tracing rays through the geometry, where the rasterizer
// looks up the image behind them: refraction where a volume is entered and left, reflection inside where it is total,
// absorption along the way, the scattering of rough surfaces, also of those behind, and an index of refraction for each
// channel are exact. Not exact, and as in the rasterizer: light reaches every surface as if no other were in its way,
// glass included; the inside of a surface reflects nothing unless it reflects all; a mesh that is not closed is a slab
// of the stated thickness. (trace_exact.h has the whole list.)
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

// The image is the mean of `batches` independent ones. More samples per batch converge faster than more batches (about
// as N^-3/4 and N^-1/2); the error is estimated from the differences between batches.
struct ReferenceSettings {
  // Samples per pixel and batch, over a box one pixel wide; best a power of two. 1 to 65536.
  int samples = 64;
  // Directions of each of three kinds (towards bright parts of the environment, by the specular lobe, by the cosine)
  // for each sample of a lit surface; best a power of two. 1 to 1024.
  int environment_samples = 2;
  // The maximum number of batches, 2 to 65536.
  int batches = 16;
  // Stops when ReferenceFilm::relative_error is no larger than this, after at least 4 batches. 0: never.
  double target_error = 0.0;
  // Seconds by `clock`, counted from the preparation of the scene. First, blocks that are spread evenly over the image
  // get two batches each; in the remaining time all pixels get further batches. Blocks that are not reached stay
  // unknown; a few are always rendered. The amount of work, and so the image, depends on the machine's speed; the
  // values of a pixel after so many batches do not.
  double time_budget = std::numeric_limits<double>::infinity();
  Clock clock = SteadySeconds;
  // Different seeds give independent images.
  std::uint64_t seed = 0;
};

struct ReferenceFilm {
  int width = 0;
  int height = 0;
  std::vector<glm::dvec4> pixels;          // as in Film: linear light, premultiplied by coverage alpha
  std::vector<glm::dvec4> standard_error;  // of each component of `pixels`, as a mean over the batches
  std::vector<glm::dvec3> through;         // Film::through
  // The known blocks; pixels elsewhere are 0.
  std::vector<PixelBlock> blocks;
  std::size_t known_pixels = 0;
  bool whole = false;           // all pixels are known
  double rms_error = 0.0;       // root mean square of the standard errors of R, G and B over known pixels
  double relative_error = 0.0;  // rms_error divided by the root mean square of R, G and B; 0 for a black image
  int batches = 0;
  double seconds = 0.0;            // by the clock
  std::vector<std::string> notes;  // what was replaced or ignored, one line each
};

// A reference that can be computed in several steps.
//
// Of `settings` it reads the image's size, threads, scene, animation, time, variant, camera, environment, background,
// disabled features, and progress (called now and then from the waiting thread), but no approximations. Apart from how
// much there is time for, the bits are the same for any number of threads.
class ReferenceRun {
 public:
  // Prepares the scene, which must outlive this object. Throws Error as Render() does, and InvalidUsage for reference
  // settings out of range and for users' fragment shaders.
  ReferenceRun(const Scene& scene, const RenderSettings& settings, const ReferenceSettings& reference = {});
  ~ReferenceRun();

  // Continues until `seconds` have passed since construction, instead of ReferenceSettings::time_budget, and returns
  // the image at that point. After the first call, there may be no time for further work.
  const ReferenceFilm& Continue(double seconds);

  // An estimate of the number of seconds since construction that reaching `relative_error` takes. Only after the image
  // has been computed once.
  double SecondsFor(double relative_error) const;

 private:
  class Work;
  std::unique_ptr<Work> work_;
};

// Computes a reference in one call.
ReferenceFilm RenderReference(const Scene& scene, const RenderSettings& settings,
                              const ReferenceSettings& reference = {});

// Rounded to floats, for display and comparison.
Film ToFilm(const ReferenceFilm& reference);

}  // namespace facet
