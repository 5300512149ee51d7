// The blend stage of frames that have surfaces with transmission. As in composite.h, every fragment in front of the
// opaque surface counts, at each sample, in the order of depth; here each also tints what is behind it, and shifts and
// blurs it as it refracts.
#pragma once

#include <glm/glm.hpp>
#include <span>
#include <vector>

#include "blend/backdrop.h"
#include "blend/layers_by_pixel.h"
#include "frame/tile.h"

namespace facet {

// Light of the environment that is seen past all surfaces. The compositor leaves it to be added to pixels: weight times
// the radiance from the direction of the point (x, y) of the image, in pixels.
struct EnvironmentSeen {
  std::vector<float> x, y, roughness;  // perceptual
  std::vector<glm::vec3> weight;
  std::vector<std::uint32_t> pixel;

  std::size_t Size() const { return pixel.size(); }
  void Clear() { x.clear(), y.clear(), roughness.clear(), weight.clear(), pixel.clear(); }
};

// Where a frame's compositing takes place.
struct ThroughView {
  bool perspective = true;
  float pixels_per_tangent = 0.0f;  // ShadeTask::pixels_per_tangent
  bool environment_behind = false;  // otherwise the background is transparent
};

// Keeps its working memory from tile to tile. Not thread-safe: one per worker.
//
// At each sample the layers' own light is multiplied by the tints of those in front. Where none of them refracts or
// blurs, the sample's own opaque surface (or `background`) is seen. Otherwise shifts add up, and squares of blurs, and
// the backdrop answers there. Not seen is what is nearer than the rearmost refracting layer. What such surfaces hide is
// not known; the holes that they leave are filled from around, with wider and wider blurs, which take over from one
// another without a seam. Where all of the picture is nearer, the sample's own opaque surface answers. Outside of the
// picture there is only the background.
class ThroughCompositor {
 public:
  // Replaces those of `pixels` (tile_size a row) that layers cover. Arguments as Compositor::Run(). `through`: the
  // share of a transparent background that shows, by channel, of the same pixels.
  void Run(const ThroughView& view, const TileBuffers& tile, const ShadedFragments& opaque,
           const ShadedFragments& layers, std::span<const ScreenTriangle* const> records, const Backdrop& backdrop,
           const std::vector<glm::vec4>& background, std::vector<glm::vec4>& pixels, std::vector<glm::vec3>& through,
           EnvironmentSeen& environment);

 private:
  // What is seen through the layers of a pixel that refract or blur, by channel.
  struct Seen {
    glm::vec3 light{0.0f}, coverage{0.0f};  // of the backdrop, premultiplied
    glm::vec3 open{0.0f};  // the share of the background, outside of the picture or where nothing is opaque
    glm::vec3 own{0.0f};   // the share of the sample's own opaque surface
    float x[3] = {}, y[3] = {}, roughness = 0.0f;  // where, in the image
  };
  // What the layers of a sample let pass, and their own light.
  struct Passed {
    glm::vec3 light{0.0f};
    glm::vec3 all{1.0f};       // the product of what each of them lets pass
    glm::vec3 straight{1.0f};  // the part that passes by those that refract, because they do not cover everything
  };
  // A layer at a pixel. They are gathered once for all samples, because fragments of one pixel lie far apart in memory:
  // thousands of layers would wait for each number.
  struct LayerHere {
    glm::vec3 light, passes, straight;  // `light`: not multiplied by alpha
    float alpha;
    std::uint8_t samples;
    bool bends;
  };
  LayerHere Gather(const ShadedFragments& layers, std::uint32_t fragment) const;
  Passed WalkLayers();  // by sorted_; fills bending_
  Seen Look(const ThroughView& view, const ShadedFragments& layers, int x, int y, const TileBuffers& tile,
            const Backdrop& backdrop) const;
  void SeeEnvironment(const Seen& seen, const glm::vec3& weight, std::uint32_t pixel, EnvironmentSeen& out) const;

  FragmentsByPixel layers_of_, opaque_of_;
  std::vector<BlockDepth> planes_;  // of the pixel's layers
  std::vector<LayerHere> here_;     // by index of `planes_`
  // Of a sample and of the one before, from the back; Layer::fragment is an index of `planes_`.
  std::vector<Layer> sorted_, before_;
  std::vector<std::uint32_t> bending_, known_;  // indices of `planes_`: refracting layers, from the front
  std::vector<std::uint32_t> fragment_of_;      // by index of `planes_`
};

}  // namespace facet
