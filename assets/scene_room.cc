#include "scenes.h"

namespace facet::assets {

Glb Room() {
  Glb glb("room");
  const int white = glb.AddMaterial(PlainMaterial("white", {0.73, 0.73, 0.73}, 0, 0.9));
  const int red = glb.AddMaterial(PlainMaterial("red", {0.63, 0.065, 0.05}, 0, 0.9));
  const int green = glb.AddMaterial(PlainMaterial("green", {0.14, 0.45, 0.091}, 0, 0.9));
  const int gloss = glb.AddMaterial(PlainMaterial("glossy plastic", {0.05, 0.16, 0.42}, 0, 0.25));
  const int metal = glb.AddMaterial(PlainMaterial("brushed metal", {0.91, 0.78, 0.42}, 1, 0.35));
  Json lamp_material = PlainMaterial("lamp", {0.8, 0.8, 0.8}, 0, 1);
  lamp_material["emissiveFactor"] = ToJson({1, 0.85, 0.6});
  lamp_material["extensions"] = {{"KHR_materials_emissive_strength", {{"emissiveStrength", 6.0}}}};
  glb.UseExtension("KHR_materials_emissive_strength");
  const int lamp = glb.AddMaterial(lamp_material);

  Shape walls;  // floor, ceiling, back
  walls.Append(Quad({-1, 0, 1}, {1, 0, 1}, {1, 0, -1}, {-1, 0, -1}));
  walls.Append(Quad({-1, 2, -1}, {1, 2, -1}, {1, 2, 1}, {-1, 2, 1}));
  walls.Append(Quad({-1, 0, -1}, {1, 0, -1}, {1, 2, -1}, {-1, 2, -1}));
  glb.AddRootNode({{"name", "white walls"}, {"mesh", glb.AddMesh("white walls", walls, white)}});
  glb.AddRootNode({{"name", "left wall"},
                   {"mesh", glb.AddMesh("left wall", Quad({-1, 0, 1}, {-1, 0, -1}, {-1, 2, -1}, {-1, 2, 1}), red)}});
  glb.AddRootNode({{"name", "right wall"},
                   {"mesh", glb.AddMesh("right wall", Quad({1, 0, -1}, {1, 0, 1}, {1, 2, 1}, {1, 2, -1}), green)}});
  glb.AddRootNode({{"name", "ceiling lamp"},
                   {"mesh", glb.AddMesh("ceiling lamp",
                                        Quad({-0.25, 1.995, -0.25}, {0.25, 1.995, -0.25}, {0.25, 1.995, 0.25},
                                             {-0.25, 1.995, 0.25}),
                                        lamp)}});

  Shape tall, low;
  tall.Append(BevelledBox({0.58, 1.2, 0.58}, 0.015), {-0.36, 0.6, -0.32}, 0.3);
  low.Append(BevelledBox({0.58, 0.58, 0.58}, 0.015), {0.36, 0.29, 0.34}, -0.3);
  glb.AddRootNode({{"name", "tall box"}, {"mesh", glb.AddMesh("tall box", tall, white)}});
  glb.AddRootNode({{"name", "low box"}, {"mesh", glb.AddMesh("low box", low, gloss)}});
  glb.AddRootNode({{"name", "ball"},
                   {"mesh", glb.AddMesh("ball", Sphere(48, 24), metal)},
                   {"translation", ToJson({0.36, 0.8, 0.34})},
                   {"scale", ToJson({0.22, 0.22, 0.22})}});

  AddLight(glb, "point", {{"type", "point"}, {"color", ToJson({1, 0.85, 0.6})}, {"intensity", 4.0}},
           {{"translation", ToJson({0, 1.6, 0})}});
  AddLight(glb, "spot",
           {{"type", "spot"},
            {"color", ToJson({0.45, 0.65, 1})},
            {"intensity", 14.0},
            {"spot", {{"innerConeAngle", 0.15}, {"outerConeAngle", 0.32}}}},
           {{"matrix", LookAt({0.8, 1.9, 1.2}, {-0.4, 0.75, -0.3})}});
  AddLight(glb, "directional", {{"type", "directional"}, {"color", ToJson({1, 1, 1})}, {"intensity", 0.6}},
           {{"matrix", LookAt({0.6, 1.6, 3}, {0, 0.8, 0})}});
  AddPerspectiveCamera(glb, "front", {0, 1, 3.95}, {0, 1, 0}, 0.68);
  return glb;
}

}  // namespace facet::assets
