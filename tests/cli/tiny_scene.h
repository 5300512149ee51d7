// A small scene with one of everything, as the text of a .gltf file that needs no other.
#pragma once

#include <string>

namespace facet::test {

// Scene 0 "Main": a square of side 2 around the origin, facing +Z, unlit and red (blue in the variant "Blue", number
// 1). Scene 1 "Small": the same at a quarter of its size. Scene 2 "Lit": white, diffuse and lit. Camera 0 "Front":
// perspective, at z = 3. Camera 1 "Flat": orthographic, at z = 3, 8 units high and wide. Animation 0 "Slide": scene 0's
// square moves from the origin to x = 10 in one second. `extra` goes into the top-level object, such as
// "\"extensionsUsed\": [\"ABC\"],".
std::string TinyScene(const std::string& extra = {});

}  // namespace facet::test
