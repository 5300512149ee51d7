// The settings that stand in a picture: the input is their JSON, in a picture that is else in order.
#include <string>

#include "fuzz/fuzz.h"
#include "fuzz/provenance.h"
#include "image/codec.h"
#include "settings/provenance.h"

namespace facet::fuzz {

void Run(std::span<const std::byte> input) {
  const Image dot{.width = 1, .height = 1, .channels = 3, .bytes = std::vector<std::byte>(3)};
  ImageText text = ToImageText({.version = "1", .scene = "scene.glb", .settings = {}, .film = {}, .pixels = {}});
  std::vector<std::byte> png;
  for (auto& [keyword, value] : text) {
    if (keyword == "facet:settings") value = AsText(input);
  }
  if (Try([&] { png = EncodePng(dot, text); }) == Outcome::Done) ReadSettingsOf(AsText(png));
}

}  // namespace facet::fuzz
