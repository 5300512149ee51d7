// A texture from the rows of a picture as they are decoded: neither the picture nor its levels are ever whole in memory
// but as texels.
#pragma once

#include <vector>

#include "texture/texture.h"

namespace facet {

class TextureBuilder {
 public:
  // `form` is some of the picture's rows, or all; `height` is the whole picture's. The rest as BuildTexture.
  TextureBuilder(const Image& form, int height, TextureRole role, bool mips, TexelBits bits);

  // The next rows, top to bottom. Throws Error(InvalidInput) where they are too many, or not of the picture's form.
  void Add(const Image& rows);

  // The texture. Throws Error(InvalidInput) where rows are missing.
  TextureData Finish();

 private:
  float* Plane(int level, int y, int channel);
  void FinishRow(int level, int y);

  int width_, channels_;
  ChannelType type_;
  TextureData texture_;
  int next_row_ = 0;
  std::vector<float> linear_, color_;     // of each code; empty for floats
  std::vector<std::vector<float>> rows_;  // of each level its last three rows, channel by channel
};

}  // namespace facet
