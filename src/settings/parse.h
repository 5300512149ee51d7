// Text of the command line and of manifests into values. Nothing here depends on the locale, and nothing is half
// accepted: trailing characters, NaN and infinities are refused. Every function throws Error(InvalidUsage) naming
// `option`, the text and what would have been accepted.
#pragma once

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

// A duration in seconds: a number, and one of the units ms, s (also where none stands), min and h. `range`: seconds.
double ParseDuration(std::string_view option, std::string_view text, Range range);

// An amount of memory in bytes, from 1 MiB to 1024 TiB: a number and one of the units MiB, GiB and TiB.
std::uint64_t ParseBytes(std::string_view option, std::string_view text);

// A decimal integer in [low, high].
int ParseInteger(std::string_view option, std::string_view text, int low, int high);

struct Size {
  int width;
  int height;
};

// WIDTHxHEIGHT in pixels, each 1 to 16384; one number is both.
Size ParseSize(std::string_view option, std::string_view text);

// X,Y,Z: three finite numbers.
glm::dvec3 ParseVec3(std::string_view option, std::string_view text);

// THETA,PHI[,RADIUS]: degrees, and metres; a radius of 0 (or none) frames the scene.
struct Orbit {
  double theta_degrees;
  double phi_degrees;
  std::optional<double> radius;
};
Orbit ParseOrbit(std::string_view option, std::string_view text);

// Of ASCII's letters.
std::string LowerCase(std::string_view text);

// #rgb, #rrggbb or a colour's name in CSS, in letters of any case; sRGB in [0, 1].
glm::vec3 ParseColor(std::string_view option, std::string_view text);

// One of `choices`, by index; letter case counts.
int ParseChoice(std::string_view option, std::string_view text, const std::vector<std::string_view>& choices);

// Some of `choices` with commas between them, by index; "none" is none of them.
std::vector<int> ParseChoices(std::string_view option, std::string_view text,
                              const std::vector<std::string_view>& choices);

// Names of planes with commas between them, each once; "none" is none of them.
std::vector<PlaneKind> ParsePlanes(std::string_view option, std::string_view text);

// The index of what `text` picks out of `names`: a number of digits only is always an index, anything else a name.
// `kind` is the singular word for messages, such as "camera"; the message lists what there is.
int Choose(std::string_view option, std::string_view kind, const std::string& text,
           const std::vector<std::string>& names);

}  // namespace facet
