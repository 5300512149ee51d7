// Conversion of a primitive's attributes, plain or compressed, to the arrays of the Scene.
#pragma once

#include <functional>
#include <glm/glm.hpp>
#include <map>
#include <string>
#include <vector>

#include "gltf/accessor.h"
#include "gltf/draco.h"

namespace facet::gltf {

// The attributes of a primitive (or morph target) by semantic. All arrays that it returns have `range.count` entries.
class AttributeSource {
 public:
  // `draco` may be null. `vertex_count`: the number of elements that all attributes must have.
  AttributeSource(Context& context, AccessorReader& reader, const std::map<std::string, int>& attributes,
                  const DracoMesh* draco, std::size_t vertex_count, Range range, const Place& place)
      : context_(context),
        reader_(reader),
        attributes_(attributes),
        draco_(draco),
        vertex_count_(vertex_count),
        range_(range),
        place_(place) {}

  bool Has(const std::string& semantic) const { return attributes_.count(semantic) != 0; }
  // Checks that there are as many elements as vertices, and enough components. Surplus ones are ignored with a warning.
  AccessorView View(const std::string& semantic, int least_components, int most_components);

  std::vector<glm::vec2> Vec2(const std::string& semantic);
  std::vector<glm::vec3> Vec3(const std::string& semantic, int least = 3, int most = 3);
  std::vector<glm::vec4> Vec4(const std::string& semantic);
  // Colours without alpha get `alpha`. Integers are normalised even if the file does not say so.
  std::vector<glm::vec4> Color(const std::string& semantic, float alpha);
  std::vector<glm::vec4> Weights(const std::string& semantic);
  std::vector<glm::u16vec4> Joints(const std::string& semantic);

  // Warns of semantics that glTF does not define or facet does not read.
  void WarnOfOthers(bool is_target);

 private:
  Context& context_;
  AccessorReader& reader_;
  const std::map<std::string, int>& attributes_;
  const DracoMesh* draco_;
  std::size_t vertex_count_;
  Range range_;
  const Place& place_;
};

// The accessors of an object "attributes", or of a morph target, by semantic. An invalid index is an error if
// `is_needed`(semantic); otherwise the attribute is ignored with a warning.
std::map<std::string, int> ReadAttributeList(Context& context, const Json& object, const Place& place,
                                             const std::function<bool(const std::string&)>& is_needed);

// The n of "NAME_n", or -1. Sets from kMaxSets on are not read.
inline constexpr int kMaxSets = 16;
int SetOf(const std::string& semantic, const char* name);

}  // namespace facet::gltf
