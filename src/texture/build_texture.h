// A texture from the rows of a picture as they are decoded: neither the picture nor its levels are ever whole in memory
// but as texels.
#pragma once

#include <vector>

#include "texture/texture.h"

namespace facet {

class TextureBuilder {
 public:
  // `form` is some of the picture's rows, or all; `height` is the whole picture's. The rest as BuildTexture.
  TextureBuilder(const Image& form, int height, TextureRole role, bool mips, TexelBits bits, int channels,
                 bool emission = false);

  // The next rows, top to bottom. Throws Error(InvalidInput) where they are too many, or not of the picture's form.
  void Add(const Image& rows);

  // The texture. Throws Error(InvalidInput) where rows are missing.
  TextureData Finish();

 private:
  void PlaceChannels(int channels);
  bool IsAlpha(int number) const { return channels_ % 2 == 0 && channel_of_[number] == channels_ - 1; }
  void Expand(const std::uint8_t* row);
  template <class Number>
  void Expand(const Number* row);
  float* Plane(int level, int y, int number);
  void FinishRow(int level, int y);
  void PlaceCells();
  void FindLitCells(int y);

  int width_, channels_;     // of the picture
  int channel_of_[4] = {};   // of the picture, for each number of a texel
  ChannelType type_;
  TextureData texture_;
  int next_row_ = 0;
  bool leave_black_ = false;  // texels that are black are not written: their memory is zero
  int cell_level_ = -1;       // whose texels are TextureData::dark's cells
  bool gamma_ = false;                    // codes of colour are not linear
  std::vector<float> linear_, color_;     // of each code; empty for floats
  std::vector<std::vector<float>> rows_;  // of each level its last three rows, channel by channel
};

}  // namespace facet
