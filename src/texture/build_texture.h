// Builds a texture from the rows of an image as they are decoded. Only the finished texels of all levels are kept: the
// decoded image itself, and the levels in float, are never in memory as a whole.
#pragma once

#include <vector>

#include "texture/texture.h"

namespace facet {

class TextureBuilder {
 public:
  // `form`: some or all rows of the image, of which only the format and the width are used. `height`: of the whole
  // image. The other parameters are those of BuildTexture().
  TextureBuilder(const Image& form, int height, TextureRole role, bool mips, TexelBits bits, int channels,
                 bool emission = false);

  // Adds the next rows, from top to bottom. Throws Error(InvalidInput) for more rows than the image has, and for rows
  // of another format or width.
  void Add(const Image& rows);

  // Returns the texture. Throws Error(InvalidInput) if rows are missing.
  TextureData Finish();

 private:
  void ChooseComponents(int channels);
  bool IsAlpha(int component) const { return channels_ % 2 == 0 && channel_of_[component] == channels_ - 1; }
  void Expand(const std::uint8_t* row);
  template <class Component>
  void Expand(const Component* row);
  float* Plane(int level, int y, int component);
  void FinishRow(int level, int y);
  void ChooseEmptyCells();
  void FindOccupiedCells(int y);

  int width_, channels_;     // of the image
  int channel_of_[4] = {};   // the image's channel that each component of a texel is made from
  ChannelType type_;
  TextureData texture_;
  int next_row_ = 0;
  bool skip_black_ = false;   // black texels are not written: fresh memory is zero already, and stays unallocated
  int cell_level_ = -1;       // the level whose texels are the cells of EmptyCells
  bool gamma_ = false;                    // colour components are encoded with the sRGB curve
  std::vector<float> linear_, color_;     // the linear value of each code, without and with sRGB; empty for floats
  std::vector<std::vector<float>> rows_;  // for each level its last three rows, one plane after the other
};

}  // namespace facet
