// Computing what a frame does not need, to show that it changes nothing.
#pragma once

#include "facet/settings.h"
#include "plan/frame_plan.h"

namespace facet {

// Enables in a finished plan the features that it disabled, wherever they have a value that changes no bit
// (RenderSettings::omit_unused): white textures of one texel for every slot of lit materials whose texture is a factor
// (base colour of unlit ones too), layers with factors that make them invisible (is_neutral_at_zero in
// material/slots.h), the environment where nothing is lit, a light of no intensity, an alpha test that all pass. These
// stay disabled, because they have no such value:
// - textures in tangent space: no texel of 8 or 16 bits decodes to exactly 0;
// - anisotropy: of strength 0 it is evaluated by other formulas than equal roughness, and it needs tangents;
// - transmission, volume and dispersion: surfaces that transmit are drawn in an order of their own;
// - vertex colours: interpolated ones are multiplied by weights whose sum is 1 but for rounding;
// - blending: coverage is composited per layer and sample, in another order than opaque surfaces are resolved in;
// - the alpha test beside materials that have one: at equal depth opaque surfaces go before tested ones;
// - skins and morph targets: they move vertices through other roundings.
void UseEverything(const RenderSettings& settings, FramePlan& plan);

}  // namespace facet
