// Computing what a frame does not need, to show that it changes nothing.
#pragma once

#include "facet/settings.h"
#include "plan/frame_plan.h"

namespace facet {

// Enables in a finished plan the features that it disabled, wherever they have a value that changes no bit
// (RenderSettings::omit_unused): white textures of one texel for base colour, metallic-roughness, occlusion and
// emission of every lit material (base colour of unlit ones too), the environment where nothing is lit, a light of no
// intensity, an alpha test that all pass. These stay disabled, because they have no such value:
// - normal textures: no texel of 8 or 16 bits decodes to exactly 0;
// - vertex colours: interpolated ones are multiplied by weights whose sum is 1 but for rounding;
// - blending: coverage is composited per layer and sample, in another order than opaque surfaces are resolved in;
// - the alpha test beside materials that have one: at equal depth opaque surfaces go before tested ones;
// - skins and morph targets: they move vertices through other roundings.
void UseEverything(const RenderSettings& settings, FramePlan& plan);

}  // namespace facet
