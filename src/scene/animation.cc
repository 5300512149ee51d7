#include "scene/animation.h"

#include <algorithm>
#include <cmath>

#include "math/elementary.h"
#include "math/round_to_float.h"

namespace facet {
namespace {

// The keys on both sides of a time, and its position between them.
struct Span {
  std::size_t key = 0;
  std::size_t next = 0;   // equal to `key` exactly at a key and beyond the ends
  double share = 0.0;     // [0, 1)
  double duration = 0.0;  // seconds
};

// Of several keys at the same time the last one counts at that time; the interval before ends at the first.
Span FindSpan(const std::vector<float>& times, double time) {
  if (time >= double(times.back())) return {times.size() - 1, times.size() - 1, 0.0, 0.0};
  const auto after = std::upper_bound(times.begin(), times.end(), time, [](double t, float key) { return t < key; });
  const std::size_t next = std::size_t(after - times.begin());
  if (next <= 1 && !(time > double(times.front()))) return {};
  const double start = double(times[next - 1]);
  const double duration = double(times[next]) - start;
  return {next - 1, next, (time - start) / duration, duration};
}

// Component `c` of the value of a key, which has `width` components.
double SampleComponent(const AnimationChannel& channel, const Span& span, std::size_t width, std::size_t c) {
  const std::vector<float>& values = channel.values;
  if (channel.interpolation == Interpolation::CubicSpline) {
    const auto at = [&](std::size_t key, std::size_t part) { return double(values[(key * 3 + part) * width + c]); };
    if (span.next == span.key) return at(span.key, 1);
    const double s = span.share, s2 = s * s, s3 = s2 * s;
    return (2.0 * s3 - 3.0 * s2 + 1.0) * at(span.key, 1) + span.duration * (s3 - 2.0 * s2 + s) * at(span.key, 2) +
           (3.0 * s2 - 2.0 * s3) * at(span.next, 1) + span.duration * (s3 - s2) * at(span.next, 0);
  }
  const double from = double(values[span.key * width + c]);
  if (channel.interpolation == Interpolation::Step || span.next == span.key) return from;
  return (1.0 - span.share) * from + span.share * double(values[span.next * width + c]);
}

glm::dquat KeyRotation(const AnimationChannel& channel, std::size_t key) {
  const float* v = &channel.values[key * 4];
  return NormalizedOrIdentity(glm::dquat(double(v[3]), double(v[0]), double(v[1]), double(v[2])));
}

}  // namespace

glm::dquat NormalizedOrIdentity(const glm::dquat& rotation) {
  const double length = std::sqrt(glm::dot(rotation, rotation));
  if (!(length > 0.0) || !std::isfinite(length)) return glm::dquat(1.0, 0.0, 0.0, 0.0);
  return rotation / length;
}

glm::dquat Slerp(const glm::dquat& a, glm::dquat b, double s) {
  if (glm::dot(a, b) < 0.0) b = -b;
  const glm::dquat difference = b - a, sum = a + b;
  const double angle =
      2.0 * Atan2(std::sqrt(glm::dot(difference, difference)), std::sqrt(glm::dot(sum, sum)));  // [0, pi/2]
  // Below this angle the chord and the arc agree to the last bit, and the sines' quotient is 0 / 0 in the limit.
  if (angle < 1e-8) return NormalizedOrIdentity(a * (1.0 - s) + b * s);
  return NormalizedOrIdentity(a * Sin((1.0 - s) * angle) + b * Sin(s * angle));
}

glm::dvec3 SampleVector(const AnimationChannel& channel, double time) {
  const Span span = FindSpan(channel.times, time);
  return {SampleComponent(channel, span, 3, 0), SampleComponent(channel, span, 3, 1),
          SampleComponent(channel, span, 3, 2)};
}

glm::dquat SampleRotation(const AnimationChannel& channel, double time) {
  const Span span = FindSpan(channel.times, time);
  if (channel.interpolation == Interpolation::Linear) {
    const glm::dquat from = KeyRotation(channel, span.key);
    return span.next == span.key ? from : Slerp(from, KeyRotation(channel, span.next), span.share);
  }
  const double x = SampleComponent(channel, span, 4, 0), y = SampleComponent(channel, span, 4, 1),
               z = SampleComponent(channel, span, 4, 2), w = SampleComponent(channel, span, 4, 3);
  return NormalizedOrIdentity(glm::dquat(w, x, y, z));
}

std::vector<float> SampleWeights(const AnimationChannel& channel, double time) {
  const Span span = FindSpan(channel.times, time);
  const std::size_t parts = channel.interpolation == Interpolation::CubicSpline ? 3 : 1;
  const std::size_t width = channel.values.size() / (channel.times.size() * parts);
  std::vector<float> weights(width);
  for (std::size_t c = 0; c < width; ++c) weights[c] = RoundToFloat(SampleComponent(channel, span, width, c));
  return weights;
}

}  // namespace facet
