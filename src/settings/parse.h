// Parses text of the command line and of manifests. Results do not depend on the locale, and trailing characters, NaN
// and infinities are refused. Every function throws Error(InvalidUsage), which names `option`, the text and what is
// accepted.
#pragma once

#include <array>
#include <cstdint>
#include <glm/glm.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "facet/planes.h"

namespace facet {

// An inclusive range.
struct Range {
  double low;
  double high;
};

// A finite decimal number in `range`; a leading '+' is allowed.
double ParseNumber(std::string_view option, std::string_view text, Range range);

// A duration in seconds: a number and one of the units ms, s (the default), min and h. `range`: seconds.
double ParseDuration(std::string_view option, std::string_view text, Range range);

// An amount of memory in bytes, from 1 MiB to 1024 TiB: a number and one of the units MiB, GiB and TiB.
std::uint64_t ParseBytes(std::string_view option, std::string_view text);

// A decimal integer in [low, high].
int ParseInteger(std::string_view option, std::string_view text, int low, int high);

struct Size {
  int width;
  int height;
};

// WIDTHxHEIGHT in pixels, each 1 to 16384. A single number is both.
Size ParseSize(std::string_view option, std::string_view text);

// X,Y,Z: three finite numbers.
glm::dvec3 ParseVec3(std::string_view option, std::string_view text);

// `count` numbers in `range`, separated by commas.
std::vector<double> ParseNumbers(std::string_view option, std::string_view text, std::size_t count, Range range);

// APERTURE,SECONDS,ISO: an f-number, 0.1 to 1000; a shutter time, 1e-6 to 1e6, which may be a fraction such as 1/125; a
// sensitivity, 1 to 1e7.
std::array<double, 3> ParseCameraExposure(std::string_view option, std::string_view text);

// THETA,PHI[,RADIUS]: angles in degrees and a radius in metres. A radius of 0 (or none) frames the scene.
struct Orbit {
  double theta_degrees;
  double phi_degrees;
  std::optional<double> radius;
};
Orbit ParseOrbit(std::string_view option, std::string_view text);

// Converts ASCII letters only.
std::string LowerCase(std::string_view text);

// #rgb, #rrggbb or the name of a CSS colour, in any letter case. Returns sRGB in [0, 1].
glm::vec3 ParseColor(std::string_view option, std::string_view text);

// The index of one of `choices`. Letter case matters.
int ParseChoice(std::string_view option, std::string_view text, const std::vector<std::string_view>& choices);

// The indices of some of `choices`, separated by commas. "none" is the empty list.
std::vector<int> ParseChoices(std::string_view option, std::string_view text,
                              const std::vector<std::string_view>& choices);

// Names of planes separated by commas, each at most once. "none" is the empty list.
std::vector<PlaneKind> ParsePlanes(std::string_view option, std::string_view text);

// The index of the element of `names` that `text` selects. Text of digits only is always an index, any other a name.
// `kind` is the singular word for messages, such as "camera". The message lists the available names.
int Choose(std::string_view option, std::string_view kind, const std::string& text,
           const std::vector<std::string>& names);

}  // namespace facet
