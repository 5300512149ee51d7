// Sampling of animation channels between their keys.
#pragma once

#include <glm/glm.hpp>
#include <glm/gtc/quaternion.hpp>
#include <vector>

#include "facet/scene.h"

namespace facet {

// `rotation` at unit length; the identity where it has no direction (zero or not finite).
glm::dquat NormalizedOrIdentity(const glm::dquat& rotation);

// Spherical linear interpolation from `a` to `b`, both unit, along the shorter arc; `s` in [0, 1]. Returns a unit
// quaternion, exact to a few ULP also where `a` is nearly equal to `b` or -`b`. Source: Shoemake 1985, Animating
// rotation with quaternion curves; the angle as 2 atan2(|a - b|, |a + b|), which unlike acos(a . b) keeps its precision
// for small angles.
glm::dquat Slerp(const glm::dquat& a, glm::dquat b, double s);

// Sample a valid channel of the matching path, which has at least one key, at `time` seconds, clamped to the keys'
// times. Source: Khronos 2021, glTF 2.0 specification, appendix C.
glm::dvec3 SampleVector(const AnimationChannel& channel, double time);
glm::dquat SampleRotation(const AnimationChannel& channel, double time);  // unit
std::vector<float> SampleWeights(const AnimationChannel& channel, double time);

}  // namespace facet
