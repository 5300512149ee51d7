// The last step of decoding Draco's attributes, from quantised integers to floats. In Draco's library as compiled for
// Arm, multiplications and additions are fused, which gives other bits. The integers are the same on all processors.
#pragma once

namespace draco {
class Mesh;
class MeshDecoder;
}  // namespace draco

namespace facet::gltf {

// Recomputes the quantised attributes of `mesh`, which `decoder` has decoded, with operations that IEEE 754 rounds
// correctly. For bitstreams before 2.0 the decoder keeps no integers, so their attributes are not changed. Source:
// Google, "Draco bitstream specification" (2.2), "Sequential Normal Attribute Decoder" and "Sequential Quantization
// Attribute Decoder", rounded as Draco does where operations are not fused.
void DequantizeDraco(draco::MeshDecoder& decoder, draco::Mesh& mesh);

}  // namespace facet::gltf
