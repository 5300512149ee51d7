#include "gltf/node_tree.h"

#include <algorithm>
#include <optional>
#include <string>
#include <utility>

#include "base/memory_budget.h"

namespace facet::gltf {
namespace {

using Indices = std::vector<int>;

class TreeReader {
 public:
  TreeReader(Context& context, Scene& scene)
      : context_(context),
        scene_(scene),
        nodes_place_(context.place, "nodes"),
        scenes_place_(context.place, "scenes"),
        problems_(context.document.Count("nodes")),
        scene_problems_(context.document.Count("scenes")),
        parents_(problems_.size(), -1),
        marks_(problems_.size(), 0) {}

  std::vector<bool> Read() {
    scene_.nodes.resize(problems_.size());
    scene_.scenes.reserve(scene_problems_.size());
    for (std::size_t i = 0; i < scene_.nodes.size(); ++i) ReadNode(i);
    for (std::size_t i = 0; i < scene_problems_.size(); ++i) ReadScene(i);
    scene_.default_scene =
        LenientIndex(context_.document.root, "scene", scene_.scenes.size(), "scenes", context_.place);
    const std::vector<bool> shown = FindShown();
    FindParents(shown);
    CutCycles();
    DropListedTwice();
    Judge(shown);
    return shown;
  }

 private:
  // The scene that is rendered by default; -1: all nodes.
  int ShownScene() const { return scene_.default_scene >= 0 ? scene_.default_scene : scene_.scenes.empty() ? -1 : 0; }

  // Reads a list of nodes without repetitions. Invalid indices are dropped, and the last is kept as `problem`.
  Indices ReadList(const Json& object, const char* key, const Place& place, std::vector<std::size_t>& marks,
                   std::size_t mark, std::optional<Error>& problem) {
    constexpr std::size_t kMostFailures = 1000;  // of a list that makes its node or scene invalid
    Indices list;
    std::size_t failures = 0;
    try {
      const Json* array = ArrayAt(object, key, place);
      const Place list_place(place, key);
      for (std::size_t k = 0; array && k < array->size(); ++k) {
        const Place element_place(list_place, k);
        if (IsAbsent((*array)[k], element_place)) continue;
        try {
          const int node = AsIndex((*array)[k], scene_.nodes.size(), "nodes", element_place);
          if (std::exchange(marks[std::size_t(node)], mark) == mark) {
            element_place.Warn("ignored: the node stands in the list already");
          } else {
            list.push_back(node);
          }
        } catch (const Error& error) {
          Keep(problem, error);
          if (++failures == kMostFailures) break;
        }
      }
    } catch (const Error& error) {
      Keep(problem, error);
    }
    return list;
  }

  void ReadNode(std::size_t i) {
    const Json& object = context_.Object("nodes", i);
    const Place place(nodes_place_, i);
    Node& node = scene_.nodes[i];
    node.name = NameOf(object, place);
    node.children = ReadList(object, "children", place, marks_, i + 1, problems_[i]);
    constexpr const char* kVisibility = "KHR_node_visibility";
    if (const Json* visibility = ExtensionOf(object, kVisibility, place)) {
      const Place extensions_place(place, "extensions");
      node.visible = LenientBool(*visibility, "visible", Place(extensions_place, kVisibility)).value_or(true);
    }
  }

  void ReadScene(std::size_t i) {
    const Json& object = context_.Object("scenes", i);
    const Place place(scenes_place_, i);
    SceneRoots roots{NameOf(object, place), {}};
    roots.nodes = ReadList(object, "nodes", place, marks_, scene_.nodes.size() + i + 1, scene_problems_[i]);
    scene_.scenes.push_back(std::move(roots));
  }

  // Marks all nodes that can be reached from `open`, whether or not the links form a tree.
  void Reach(Indices open, bool through_hidden, std::vector<bool>& reached) const {
    while (!open.empty()) {
      const auto i = std::size_t(open.back());
      open.pop_back();
      if (reached[i] || (!through_hidden && !scene_.nodes[i].visible)) continue;
      reached[i] = true;
      open.insert(open.end(), scene_.nodes[i].children.begin(), scene_.nodes[i].children.end());
    }
  }

  std::vector<bool> FindShown() const {
    std::vector<bool> shown(scene_.nodes.size(), false);
    Indices starts;
    if (ShownScene() >= 0) {
      starts = scene_.scenes[std::size_t(ShownScene())].nodes;
    } else {
      std::vector<bool> has_parent(scene_.nodes.size(), false), reached = has_parent;
      for (const Node& node : scene_.nodes) {
        for (const int child : node.children) has_parent[std::size_t(child)] = true;
      }
      for (std::size_t i = 0; i < scene_.nodes.size(); ++i) {
        if (!has_parent[i]) starts.push_back(int(i));
      }
      Reach(starts, true, reached);
      for (std::size_t i = 0; i < scene_.nodes.size(); ++i) {
        if (!reached[i]) starts.push_back(int(i));  // on a cycle, or below one
      }
    }
    Reach(starts, false, shown);
    return shown;
  }

  // Of several parents, which glTF does not allow, a node has the last visible one, as in three.js and Babylon.js.
  void FindParents(const std::vector<bool>& shown) {
    for (const bool of_shown : {true, false}) {
      for (std::size_t i = 0; i < scene_.nodes.size(); ++i) {
        if (shown[i] != of_shown) continue;
        std::erase_if(scene_.nodes[i].children, [&](int child) {
          int& parent = parents_[std::size_t(child)];
          if (parent < 0) {
            parent = int(i);
            return false;
          }
          const std::string what =
              "is a child of both nodes[" + std::to_string(parent) + "] and nodes[" + std::to_string(i) + "]";
          if (!of_shown || parent == int(i)) {
            SetProblem(i, what, std::size_t(child));
            return true;
          }
          Place(nodes_place_, std::size_t(child)).Warn(what + "; it is drawn below the latter");
          parent = int(i);
          return false;
        });
      }
    }
    for (std::size_t i = 0; i < scene_.nodes.size(); ++i) {
      std::erase_if(scene_.nodes[i].children, [&](int child) { return parents_[std::size_t(child)] != int(i); });
    }
  }

  // Walks towards the roots: a walk that meets itself has found a cycle, one that meets an earlier walk has not.
  void CutCycles() {
    std::vector<std::size_t> met(scene_.nodes.size(), 0);
    for (std::size_t i = 0; i < scene_.nodes.size(); ++i) {
      for (int at = int(i); at >= 0; at = parents_[std::size_t(at)]) {
        std::size_t& mark = met[std::size_t(at)];
        if (mark == i + 1) {
          SetProblem(std::size_t(at), "is its own ancestor", std::size_t(at));
          std::erase(scene_.nodes[std::size_t(std::exchange(parents_[std::size_t(at)], -1))].children, at);
          break;
        }
        if (mark != 0) break;
        mark = i + 1;
      }
    }
  }

  void SetProblem(std::size_t node, const std::string& what, std::size_t about) {
    if (!problems_[node]) {
      Keep(problems_[node], Error(ErrorCode::InvalidInput, what, Place(nodes_place_, about).Full()));
    }
  }

  void Keep(std::optional<Error>& problem, const Error& error) {
    constexpr std::size_t kError = 512;  // including its texts
    if (!problem) context_.Charge(1, kError, nodes_place_);
    problem = error;
  }

  // If a scene lists a node and one of its ancestors, the node is drawn below the ancestor. A node that is listed
  // without any of its ancestors is a root.
  void DropListedTwice() {
    const auto has_parent = [&](int node) { return parents_[std::size_t(node)] >= 0; };
    std::vector<std::pair<std::size_t, std::size_t>> spans;  // by node: its and its last descendant's place in a walk
    for (std::size_t s = 0; s < scene_.scenes.size(); ++s) {
      Indices& listed = scene_.scenes[s].nodes;
      if (std::none_of(listed.begin(), listed.end(), has_parent)) continue;
      if (spans.empty()) spans = FindSpans();
      Indices by_place = listed;
      std::sort(by_place.begin(), by_place.end(),
                [&](int a, int b) { return spans[std::size_t(a)].first < spans[std::size_t(b)].first; });
      const Place scene_place(scenes_place_, s);
      const Place place(scene_place, "nodes");
      const std::size_t below = scene_.nodes.size() + scene_.scenes.size() + s + 1;  // a unique mark
      int start = -1;
      for (const int node : by_place) {
        if (start >= 0 && spans[std::size_t(node)].first <= spans[std::size_t(start)].second) {
          marks_[std::size_t(node)] = below;
          place.Warn("nodes[" + std::to_string(node) + "] is not a root node; it stays below nodes[" +
                     std::to_string(start) + "]");
          continue;
        }
        start = node;
        if (!has_parent(node)) continue;
        place.Warn("nodes[" + std::to_string(node) + "] is not a root node; the scene begins there, without nodes[" +
                   std::to_string(parents_[std::size_t(node)]) + "]");
      }
      std::erase_if(listed, [&](int node) { return marks_[std::size_t(node)] == below; });
    }
  }

  std::vector<std::pair<std::size_t, std::size_t>> FindSpans() const {
    std::vector<std::pair<std::size_t, std::size_t>> spans(scene_.nodes.size());
    std::size_t place = 0;
    Indices open;
    for (std::size_t i = 0; i < scene_.nodes.size(); ++i) {
      if (parents_[i] < 0) open.push_back(int(i));
    }
    while (!open.empty()) {
      const int node = open.back();
      if (node < 0) {  // all descendants have been visited
        open.pop_back();
        spans[std::size_t(-node - 1)].second = place - 1;
        continue;
      }
      open.back() = -node - 1;
      spans[std::size_t(node)].first = place++;
      const Indices& children = scene_.nodes[std::size_t(node)].children;
      open.insert(open.end(), children.begin(), children.end());
    }
    return spans;
  }

  void Judge(const std::vector<bool>& shown) const {
    for (std::size_t i = 0; i < problems_.size(); ++i) {
      if (!problems_[i]) continue;
      if (shown[i]) throw Error(*problems_[i]);
      Place(nodes_place_, i).Warn("a link to another node is ignored", *problems_[i]);
    }
    for (std::size_t i = 0; i < scene_problems_.size(); ++i) {
      if (!scene_problems_[i]) continue;
      if (int(i) == ShownScene()) throw Error(*scene_problems_[i]);
      Place(scenes_place_, i).Warn("a link to a node is ignored", *scene_problems_[i]);
    }
  }

  Context& context_;
  Scene& scene_;
  const Place nodes_place_, scenes_place_;
  std::vector<std::optional<Error>> problems_, scene_problems_;  // by node, by scene
  Indices parents_;                                              // by node
  std::vector<std::size_t> marks_;                               // by node: the list that had it last
};

void MarkTargets(const std::vector<float>& weights, MeshUse& use) {
  if (use.moving_targets.size() < weights.size()) use.moving_targets.resize(weights.size(), false);
  for (std::size_t t = 0; t < weights.size(); ++t) use.moving_targets[t] = use.moving_targets[t] || weights[t] != 0.0f;
}

// Records the use of a mesh by a visible node.
void MarkMesh(const Context& context, const Json& node, const Place& place, Shown& shown) {
  const int mesh = LenientIndex(node, "mesh", shown.meshes.size(), "meshes", place);
  if (mesh < 0) return;
  MeshUse& use = shown.meshes[std::size_t(mesh)];
  const Place meshes_place(context.place, "meshes");
  if (!use.shown) {  // the mesh's weights apply if the node has none
    MarkTargets(
        LenientFloats(context.Object("meshes", std::size_t(mesh)), "weights", Place(meshes_place, std::size_t(mesh))),
        use);
  }
  MarkTargets(LenientFloats(node, "weights", place), use);
  use.shown = true;
  use.skinned = use.skinned || Find(node, "skin") != nullptr;
}

}  // namespace

Shown ReadNodeTree(Context& context, Scene& scene) {
  Shown shown;
  context.Charge(context.document.Count("nodes"), sizeof(Node), Place(context.place, "nodes"));
  context.Charge(context.document.Count("scenes"), sizeof(SceneRoots), Place(context.place, "scenes"));
  const MemoryLease lease(context.document.Count("nodes") + context.document.Count("scenes"), 2 * sizeof(Error),
                          "the node tree");
  shown.nodes = TreeReader(context, scene).Read();
  shown.skins.resize(context.document.Count("skins"), false);
  context.Charge(context.document.Count("meshes"), sizeof(MeshUse), Place(context.place, "meshes"));
  shown.meshes.resize(context.document.Count("meshes"));
  const Place list_place(context.place, "nodes");
  for (std::size_t i = 0; i < shown.nodes.size(); ++i) {
    if (!shown.nodes[i]) continue;
    const Json& node = context.Object("nodes", i);
    const Place place(list_place, i);
    MarkMesh(context, node, place, shown);
    const int skin = LenientIndex(node, "skin", shown.skins.size(), "skins", place);
    if (skin >= 0) shown.skins[std::size_t(skin)] = true;
  }
  return shown;
}

}  // namespace facet::gltf
