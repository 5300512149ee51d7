#include "gltf/attributes.h"

#include <algorithm>
#include <cstring>

#include "base/memory_budget.h"

namespace facet::gltf {

int SetOf(const std::string& semantic, const char* name) {
  const std::size_t length = std::strlen(name);
  if (semantic.size() < length + 2 || semantic.compare(0, length, name) != 0 || semantic[length] != '_') return -1;
  int set = 0;
  for (std::size_t i = length + 1; i < semantic.size(); ++i) {
    if (semantic[i] < '0' || semantic[i] > '9' || set > 999) return -1;
    set = set * 10 + (semantic[i] - '0');
  }
  return set;
}

AccessorView AttributeSource::View(const std::string& semantic, int least_components, int most_components) {
  const Place place(place_, semantic);
  AccessorView view;
  const int accessor = attributes_.at(semantic);
  if (draco_ && draco_->attributes.count(semantic)) {
    view = draco_->attributes.at(semantic);
  } else {
    const std::size_t count = reader_.Count(accessor);
    const std::string what =
        "has " + std::to_string(count) + " elements, and the primitive " + std::to_string(vertex_count_) + " vertices";
    if (count < vertex_count_) Fail(place, what);
    if (count > vertex_count_) place.Warn(what);
    view = reader_.View(accessor);
  }
  if (view.is_matrix || view.components < least_components) {
    Fail(place, "does not have " + std::to_string(least_components) +
                    (most_components > least_components ? " to " + std::to_string(most_components) : "") +
                    " components");
  }
  if (view.components > most_components) {
    place.Warn("has " + std::to_string(view.components) + " components; the first " + std::to_string(most_components) +
               " are read");
    view.components = most_components;
  }
  return view;
}

std::vector<glm::vec2> AttributeSource::Vec2(const std::string& semantic) {
  const AccessorView view = View(semantic, 2, 2);
  const Place place(place_, semantic);
  context_.Charge(range_.count, sizeof(glm::vec2), place);
  std::vector<glm::vec2> out(range_.count, glm::vec2(0.0f));
  reader_.ReadFloats(view, range_, 2, &out.data()->x, place);
  return out;
}

std::vector<glm::vec3> AttributeSource::Vec3(const std::string& semantic, int least, int most) {
  const AccessorView view = View(semantic, least, most);
  const Place place(place_, semantic);
  context_.Charge(range_.count, sizeof(glm::vec3), place);
  std::vector<glm::vec3> out(range_.count, glm::vec3(0.0f));
  reader_.ReadFloats(view, range_, 3, &out.data()->x, place);
  return out;
}

std::vector<glm::vec4> AttributeSource::Vec4(const std::string& semantic) {
  const AccessorView view = View(semantic, 4, 4);
  const Place place(place_, semantic);
  context_.Charge(range_.count, sizeof(glm::vec4), place);
  std::vector<glm::vec4> out(range_.count, glm::vec4(0.0f));
  reader_.ReadFloats(view, range_, 4, &out.data()->x, place);
  return out;
}

std::vector<glm::vec4> AttributeSource::Color(const std::string& semantic, float alpha) {
  AccessorView view = View(semantic, 3, 4);
  const Place place(place_, semantic);
  if (view.type != ComponentType::F32 && !view.normalized) {
    place.Warn("integers are not marked as normalized; they are read as if they were");
    view.normalized = true;
  }
  context_.Charge(range_.count, sizeof(glm::vec4), place);
  std::vector<glm::vec4> out(range_.count, glm::vec4(0.0f, 0.0f, 0.0f, alpha));
  reader_.ReadFloats(view, range_, 4, &out.data()->x, place);
  return out;
}

std::vector<glm::vec4> AttributeSource::Weights(const std::string& semantic) {
  AccessorView view = View(semantic, 4, 4);
  const Place place(place_, semantic);
  if (view.type != ComponentType::F32) view.normalized = true;  // integers make sense only if normalised
  context_.Charge(range_.count, sizeof(glm::vec4), place);
  std::vector<glm::vec4> out(range_.count, glm::vec4(0.0f));
  reader_.ReadFloats(view, range_, 4, &out.data()->x, place);
  std::size_t negative = 0;
  for (glm::vec4& weight : out) {
    for (int c = 0; c < 4; ++c) {
      negative += weight[c] < 0.0f;
      weight[c] = std::max(weight[c], 0.0f);
    }
  }
  if (negative) place.Warn(std::to_string(negative) + " negative weights were replaced by 0");
  return out;
}

std::vector<glm::u16vec4> AttributeSource::Joints(const std::string& semantic) {
  const AccessorView view = View(semantic, 4, 4);
  const Place place(place_, semantic);
  context_.Charge(range_.count, sizeof(glm::u16vec4), place);
  std::vector<glm::u16vec4> out(range_.count);
  if (view.type == ComponentType::U8 || view.type == ComponentType::U16) {
    const MemoryLease lease(range_.count, 4 * sizeof(std::uint32_t), "reading joints");
    std::vector<std::uint32_t> raw(range_.count * 4);
    reader_.ReadUnsigned(view, range_, 4, raw.data());
    for (std::size_t i = 0; i < raw.size(); ++i) {
      out[i / 4][static_cast<int>(i % 4)] = static_cast<std::uint16_t>(raw[i]);
    }
    return out;
  }
  // Old exporters wrote floats and other integers; whatever fits is taken.
  const MemoryLease lease(range_.count, 4 * sizeof(float), "reading joints");
  std::vector<float> raw(range_.count * 4);
  reader_.ReadFloats(view, range_, 4, raw.data(), place);
  place.Warn("joints are neither unsigned bytes nor unsigned shorts");
  for (std::size_t i = 0; i < raw.size(); ++i) {
    if (!(raw[i] >= 0.0f && raw[i] <= 65535.0f)) Fail(place, "holds what is no joint index");
    out[i / 4][static_cast<int>(i % 4)] = static_cast<std::uint16_t>(raw[i]);
  }
  return out;
}

void AttributeSource::WarnOfOthers(bool is_target) {
  for (const auto& [semantic, accessor] : attributes_) {
    if (semantic.empty() || semantic[0] == '_') continue;  // the application's own
    const int uv = SetOf(semantic, "TEXCOORD"), color = SetOf(semantic, "COLOR");
    const int joints = SetOf(semantic, "JOINTS"), weights = SetOf(semantic, "WEIGHTS");
    if (semantic == "POSITION" || semantic == "NORMAL" || semantic == "TANGENT") continue;
    if ((uv >= 0 && uv < kMaxSets) || color == 0) continue;
    if (!is_target && ((joints >= 0 && joints < kMaxSets) || (weights >= 0 && weights < kMaxSets))) continue;
    const bool known = uv >= 0 || color >= 0 || (!is_target && (joints >= 0 || weights >= 0));
    Place(place_, semantic).Warn(known ? "ignored: facet does not read this set" : "ignored: unknown attribute");
  }
}

std::map<std::string, int> ReadAttributeList(Context& context, const Json& object, const Place& place,
                                             const std::function<bool(const std::string&)>& is_needed) {
  std::map<std::string, int> attributes;
  for (const auto& item : object.items()) {
    const std::string& semantic = item.key();
    context.Try(is_needed(semantic), Place(place, semantic), "ignored", [&] {
      const int accessor = IndexAt(object, semantic.c_str(), context.document.Count("accessors"), "accessors", place);
      if (accessor >= 0) attributes.emplace(semantic, accessor);
    });
  }
  return attributes;
}

}  // namespace facet::gltf
