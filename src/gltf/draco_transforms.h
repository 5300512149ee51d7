// The last step of unpacking Draco's attributes, from quantised integers to floats. Draco's own library, as it is
// compiled for Arm, fuses its multiplications and additions and gives other bits there; the integers are the same
// everywhere.
#pragma once

namespace draco {
class Mesh;
class MeshDecoder;
}  // namespace draco

namespace facet::gltf {

// Computes the quantised attributes of `mesh` anew, which `decoder` has decoded, by what IEEE 754 rounds exactly. Of
// bitstreams before 2.0 the decoder keeps no integers: their attributes stay as they are.
// Source: Google, "Draco bitstream specification" (2.2), "Sequential Normal Attribute Decoder" and "Sequential
// Quantization Attribute Decoder", rounded as Draco does where operations are not fused.
void DequantizeDraco(draco::MeshDecoder& decoder, draco::Mesh& mesh);

}  // namespace facet::gltf
