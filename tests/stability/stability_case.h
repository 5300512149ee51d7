// The stability suite's cases. Each measures itself; one program asserts them, another prints the table of
// docs/stability.md from them, so that what is asserted is what is shown.
#pragma once

#include <cmath>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "facet/render.h"
#include "facet/scene.h"

namespace facet::stability {

// What one case measured.
struct Measured {
  double worst = 0.0;                 // largest error that was found, in the case's unit
  std::optional<double> naive;        // the same of the naive formula, where the case computes it beside facet's
  std::vector<std::string> failures;  // promises that were broken, one line each
  std::uint64_t images = 0;           // rendered, each on every instruction set
  std::uint64_t sanitised = 0;        // fragments that were not finite, replaced and counted
  std::string skipped;                // why the case could not be measured here; empty: it was

  void Expect(bool good, const std::string& promise) {
    if (!good && failures.size() < 20) failures.push_back(promise);
  }
  // NaN counts as infinite.
  void Error(double error) { Raise(worst, error); }
  void NaiveError(double error) {
    if (!naive) naive = 0.0;
    Raise(*naive, error);
  }

 private:
  static void Raise(double& largest, double error) {
    largest = std::isnan(error) ? HUGE_VAL : std::fmax(largest, error);
  }
};

struct Case {
  const char* family;
  const char* name;   // a phrase: the table's first column
  const char* naive;  // what goes wrong in a naive renderer
  const char* facet;  // what facet does
  const char* unit;   // of the errors
  double bound;       // that `worst` may reach; its derivation stands beside the case
  Measured (*measure)();
};

std::vector<Case> BrdfCases();
std::vector<Case> ClosureCases();
std::vector<Case> LayerCases();
std::vector<Case> GlassCases();
std::vector<Case> ModelCases();
std::vector<Case> PlacementCases();
std::vector<Case> TriangleCases();
std::vector<Case> TransformCases();
std::vector<Case> TextureCases();
std::vector<Case> LightCases();
std::vector<Case> FilmCases();

// Every family, in the table's order.
std::vector<Case> AllCases();

// --- Curves: error or count over a parameter that goes to its limit -------------------------------------------------

struct CurvePoint {
  double error = 0.0;  // in the curve's unit
  double count = 0.0;  // of the curve's thing: fragments, triangles ...
};

struct Curve {
  const char* name;
  const char* says;  // what the reader sees
  const char* parameter;
  const char* unit;  // of the errors
  const char* counted;
  double error_bound;  // at every point
  double count_bound;  // at every point
  std::vector<double> parameters;
  CurvePoint (*measure)(double parameter, Measured& measured);
};

std::vector<Curve> AllCurves();

// --- Rendering
// ---------------------------------------------------------------------------------------------------------

// Renders, and checks what holds for every image: each number of the film is finite and not negative, alpha is at
// most 1, bytes and counts are the same on every instruction set, and `non_finite` fragments (none, unless the case
// says so) were replaced and counted; that the files made of the film are finite too.
Film Draw(const Scene& scene, const RenderSettings& settings, Measured& measured, RenderStats* stats = nullptr,
          std::uint64_t non_finite = 0);

// Expects that a scene whose parameters are no numbers is refused, with a message that names `culprit`, and not drawn.
void ExpectRefused(const Scene& scene, const RenderSettings& settings, const std::string& culprit, Measured& measured);

// Pixels in which two films of one size differ by more than `tolerance` in any number.
std::size_t DifferingPixels(const Film& a, const Film& b, float tolerance = 0.0f);

// |a - b| / max(|a|, |b|, floor), the largest over all numbers.
double LargestRelativeDifference(const Film& a, const Film& b, double floor);

}  // namespace facet::stability
