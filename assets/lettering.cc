#include "lettering.h"

#include <cmath>
#include <cstddef>
#include <stdexcept>
#include <vector>

#include "facet/shader/elementary_double.h"

namespace facet::assets {
namespace {

// Letters stand on a grid in which x is four units tall, b six, and the tail of p reaches two below the baseline.
constexpr double kUnitsPerXHeight = 4, kStroke = 0.68, kSpacing = 1.5, kWordSpace = 2.2;

// The middle line of a stroke: an arc of an ellipse from one angle to another (degrees from +X towards +Y), or, where
// `points` are given, straight pieces.
struct Stroke {
  double cx = 0, cy = 0, rx = 0, ry = 0, from = 0, to = 0;
  std::vector<Vec2> points;
};

struct Letter {
  double width = 0;
  std::vector<Stroke> strokes;
};

Stroke Arc(double cx, double cy, double rx, double ry, double from, double to) {
  return {cx, cy, rx, ry, from, to, {}};
}
Stroke Line(std::vector<Vec2> points) { return {0, 0, 0, 0, 0, 0, std::move(points)}; }
Stroke Round(double cx) { return Arc(cx, 2, 1.7, 2, 0, 360); }
Stroke Dot(double x, double y) { return Line({{x, y - 0.35}, {x, y + 0.35}}); }

Letter LetterOf(char c) {
  switch (c) {
    case ' ': return {kWordSpace, {}};
    case '.': return {0, {Dot(0, 0.3)}};
    case '-': return {2.2, {Line({{0, 2}, {2.2, 2}})}};
    case 'a': return {3.4, {Round(1.7), Line({{3.4, 4}, {3.4, 0}})}};
    case 'b': return {3.4, {Round(1.7), Line({{0, 6}, {0, 0}})}};
    case 'c': return {3.0, {Arc(1.7, 2, 1.7, 2, 48, 312)}};
    case 'd': return {3.4, {Round(1.7), Line({{3.4, 6}, {3.4, 0}})}};
    case 'e': return {3.4, {Line({{0, 2.1}, {3.4, 2.1}}), Arc(1.7, 2, 1.7, 2, 3, 312)}};
    case 'f': return {2.2, {Arc(2.2, 4.7, 1.3, 1.3, 80, 180), Line({{0.9, 4.7}, {0.9, 0}}), Line({{0, 4}, {2.1, 4}})}};
    case 'g': return {3.4, {Round(1.7), Line({{3.4, 4}, {3.4, -0.4}}), Arc(1.7, -0.4, 1.7, 1.6, 0, -150)}};
    case 'h': return {3.0, {Line({{0, 6}, {0, 0}}), Arc(1.5, 2.4, 1.5, 1.6, 180, 0), Line({{3, 2.4}, {3, 0}})}};
    case 'i': return {0, {Line({{0, 4}, {0, 0}}), Dot(0, 5.5)}};
    case 'j': return {0.9, {Line({{0.9, 4}, {0.9, -0.9}}), Arc(-0.2, -0.9, 1.1, 1.1, 0, -90), Dot(0.9, 5.5)}};
    case 'k': return {2.9, {Line({{0, 6}, {0, 0}}), Line({{2.7, 4}, {0, 1.6}}), Line({{1.0, 2.4}, {2.9, 0}})}};
    case 'l': return {0, {Line({{0, 6}, {0, 0}})}};
    case 'm':
      return {5.0,
              {Line({{0, 4}, {0, 0}}), Arc(1.25, 2.5, 1.25, 1.5, 180, 0), Line({{2.5, 2.5}, {2.5, 0}}),
               Arc(3.75, 2.5, 1.25, 1.5, 180, 0), Line({{5, 2.5}, {5, 0}})}};
    case 'n': return {3.0, {Line({{0, 4}, {0, 0}}), Arc(1.5, 2.4, 1.5, 1.6, 180, 0), Line({{3, 2.4}, {3, 0}})}};
    case 'o': return {3.4, {Round(1.7)}};
    case 'p': return {3.4, {Round(1.7), Line({{0, 4}, {0, -2}})}};
    case 'q': return {3.4, {Round(1.7), Line({{3.4, 4}, {3.4, -2}})}};
    case 'r': return {2.0, {Line({{0, 4}, {0, 0}}), Arc(1.8, 2.2, 1.8, 1.8, 180, 85)}};
    case 's': return {2.8, {Arc(1.4, 2.97, 1.35, 1.03, 25, 270), Arc(1.4, 0.97, 1.4, 0.97, 90, -155)}};
    case 't': return {2.1, {Line({{0.8, 5.4}, {0.8, 1.2}}), Arc(2.0, 1.2, 1.2, 1.2, 180, 275), Line({{0, 4}, {2, 4}})}};
    case 'u': return {3.0, {Line({{0, 4}, {0, 1.6}}), Arc(1.5, 1.6, 1.5, 1.6, 180, 360), Line({{3, 4}, {3, 0}})}};
    case 'v': return {3.2, {Line({{0, 4}, {1.6, 0}}), Line({{3.2, 4}, {1.6, 0}})}};
    case 'w':
      return {4.8,
              {Line({{0, 4}, {1.25, 0}}), Line({{2.4, 4}, {1.15, 0}}), Line({{2.4, 4}, {3.65, 0}}),
               Line({{4.8, 4}, {3.55, 0}})}};
    case 'x': return {3.0, {Line({{0, 4}, {3, 0}}), Line({{0, 0}, {3, 4}})}};
    case 'y': return {3.2, {Line({{0, 4}, {1.6, 0}}), Line({{3.2, 4}, {0.8, -2}})}};
    case 'z':
      return {2.8, {Line({{0, 3.7}, {2.8, 3.7}}), Line({{2.7, 3.7}, {0.1, 0.3}}), Line({{0, 0.3}, {2.8, 0.3}})}};
    case '0': return {3.4, {Arc(1.7, 3, 1.7, 3, 0, 360)}};
    case '1': return {1.4, {Line({{1.4, 6}, {1.4, 0}}), Line({{0, 4.8}, {1.4, 5.8}})}};
    case '2':
      return {3.2, {Arc(1.6, 4.4, 1.6, 1.6, 170, -25), Line({{3.04, 3.7}, {0.1, 0.3}}), Line({{0, 0.3}, {3.2, 0.3}})}};
    case '3': return {3.2, {Arc(1.5, 4.5, 1.4, 1.5, 155, -90), Arc(1.5, 1.5, 1.6, 1.5, 90, -155)}};
    case '4': return {3.4, {Line({{2.5, 0}, {2.5, 6}}), Line({{2.4, 5.9}, {0.1, 1.7}}), Line({{0, 1.7}, {3.4, 1.7}})}};
    case '5':
      return {3.2,
              {Line({{0.4, 5.7}, {2.9, 5.7}}), Line({{0.5, 5.8}, {0.3, 3.1}}), Arc(1.5, 1.9, 1.7, 1.9, 135, -150)}};
    case '6': return {3.4, {Arc(1.7, 1.9, 1.7, 1.9, 0, 360), Arc(3.4, 1.9, 3.4, 4.1, 180, 105)}};
    case '7': return {3.2, {Line({{0, 5.7}, {3.2, 5.7}}), Line({{3.1, 5.7}, {1.0, 0}})}};
    case '8': return {3.2, {Arc(1.6, 4.55, 1.35, 1.45, 0, 360), Arc(1.6, 1.55, 1.6, 1.55, 0, 360)}};
    case '9': return {3.4, {Arc(1.7, 4.1, 1.7, 1.9, 0, 360), Arc(0, 4.1, 3.4, 4.1, 0, -75)}};
    default: throw std::invalid_argument(std::string("no letter for '") + c + "'");
  }
}

std::vector<Vec2> MiddleLine(const Stroke& stroke) {
  if (!stroke.points.empty()) return stroke.points;
  constexpr double kDegreesPerPiece = 30;
  const int pieces = int(std::ceil(std::fabs(stroke.to - stroke.from) / kDegreesPerPiece));
  std::vector<Vec2> points;
  for (int i = 0; i <= pieces; ++i) {
    const double angle = (stroke.from + (stroke.to - stroke.from) * i / pieces) * kPi / 180;
    points.push_back({stroke.cx + stroke.rx * Cos(angle), stroke.cy + stroke.ry * Sin(angle)});
  }
  return points;
}

// Two points a corner, moved along its mitre, so that neighbouring pieces meet without a gap.
void AppendRibbon(Shape& shape, const std::vector<Vec2>& line, double pen_x, double scale) {
  const std::size_t count = line.size();
  const auto direction = [&](std::size_t i) {
    return Normalize({line[i + 1].x - line[i].x, line[i + 1].y - line[i].y, 0});
  };
  const Vec2 span{line.front().x - line.back().x, line.front().y - line.back().y};
  const bool closed = count > 3 && span.x * span.x + span.y * span.y < 1e-12;
  const std::uint32_t base = std::uint32_t(shape.positions.size());
  for (std::size_t i = 0; i < count; ++i) {
    const Vec3 in = i > 0 ? direction(i - 1) : closed ? direction(count - 2) : direction(0);
    const Vec3 out = i + 1 < count ? direction(i) : closed ? direction(0) : direction(count - 2);
    const Vec3 along = Normalize(in + out);
    const double reach = kStroke / 2 / std::fmax(Dot(along, in), 0.85);  // sharp corners stay blunt
    const Vec3 side{-along.y * reach, along.x * reach, 0}, at{line[i].x + pen_x, line[i].y, 0};
    shape.positions.push_back((at + side) * scale);
    shape.positions.push_back((at - side) * scale);
  }
  for (std::uint32_t i = 0; i + 1 < count; ++i) {
    const std::uint32_t a = base + 2 * i;
    shape.indices.insert(shape.indices.end(), {a, a + 1, a + 3, a, a + 3, a + 2});
  }
}

}  // namespace

Shape Lettering(const std::string& text, double x_height) {
  const double scale = x_height / kUnitsPerXHeight;
  Shape shape;
  double pen_x = 0;
  for (char c : text) {
    const Letter letter = LetterOf(c);
    for (const Stroke& stroke : letter.strokes) AppendRibbon(shape, MiddleLine(stroke), pen_x, scale);
    pen_x += letter.width + kSpacing;
  }
  return shape;
}

double LetteringWidth(const std::string& text, double x_height) {
  double width = -kSpacing;
  for (char c : text) width += LetterOf(c).width + kSpacing;
  return width * x_height / kUnitsPerXHeight;
}

}  // namespace facet::assets
