#include "report/stroke_font.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <vector>

namespace pigment::report {
namespace {

// A glyph is its advance width and its strokes. A point is two base-36 digits, x and y; capitals stand from y
// = 6 to k (20), small letters reach g (16), descenders 1. A stroke is a polyline; after '~' a smooth curve
// through its points, after 'o' a smooth closed curve.
struct Glyph {
  double advance;
  const char* strokes;
};

const std::map<char32_t, Glyph>& alphabet() {
  static const std::map<char32_t, Glyph> glyphs = {
      {U' ', {6, ""}},
      {U'0', {12, "o4k7i8d7846180d1i"}},
      {U'1', {12, "1h5k56"}},
      {U'2', {12, "~0h1j4k7j8g6c06 0686"}},
      {U'3', {12, "~0h1j4k7j8g7e4d ~4d7c8a77461709"}},
      {U'4', {12, "6k0a9a 6k66"}},
      {U'5', {12, "7k1k0d ~0d2e4f7e8b78461708"}},
      {U'6', {12, "~7j4k1h0a o4e7d8a7746170a1d"}},
      {U'7', {12, "0k8k36"}},
      {U'8', {12, "o4k6j7h6e4d2e1h2j o4d7c8a7746170a1c"}},
      {U'9', {12, "o4c1d0g1j4k7j8g7d ~1746798g"}},
      {U'A', {14, "065ka6 2b8b"}},
      {U'B', {13, "060k 0k4k ~4k7j8h7e4d 4d0d ~4d8c9a8746 4606"}},
      {U'C', {13, "~9h8j5k2j0f0b27568799"}},
      {U'D', {13, "060k 0k4k 4606 ~4k8i9d8846"}},
      {U'E', {12, "8k0k0686 0d7d"}},
      {U'F', {11, "8k0k06 0d7d"}},
      {U'G', {13, "~9h8j5k2j0f0b27568799 999c5c"}},
      {U'H', {13, "060k 969k 0d9d"}},
      {U'I', {4, "060k"}},
      {U'J', {10, "~6k6a57361709"}},
      {U'K', {12, "060k 8k0c 3e96"}},
      {U'L', {10, "0k0676"}},
      {U'M', {14, "060k59aka6"}},
      {U'N', {13, "060k969k"}},
      {U'O', {14, "o5k8jafab8756270b0f2j"}},
      {U'P', {12, "060k 0k5k 0c5c ~5k8j9g8d5c"}},
      {U'Q', {14, "o5k8jafab8756270b0f2j 6aa5"}},
      {U'R', {13, "060k 0k5k 0c5c ~5k8j9g8d5c 5c96"}},
      {U'S', {12, "~8h7j4k1j0g1e4d7c8a77461709"}},
      {U'T', {13, "0kak 5k56"}},
      {U'U', {12, "0k0b ~0b1746778b 8b8k"}},
      {U'V', {13, "0k56ak"}},
      {U'W', {16, "0k366i96ck"}},
      {U'X', {13, "0k96 9k06"}},
      {U'Y', {13, "0k5dak 5d56"}},
      {U'Z', {13, "0k9k0696"}},
      {U'a', {11, "o3g6f7b6736170b1f 7g76"}},
      {U'b', {11, "0k06 o4g6f7b6746170b1f"}},
      {U'c', {10, "~7e6f4g1f0b17466778"}},
      {U'd', {11, "o3g6f7b6736170b1f 7k76"}},
      {U'e', {11, "~7b6f4g1f0b17466778 0b7b"}},
      {U'f', {8, "~5k3k2h 2h26 0g5g"}},
      {U'g', {11, "o3g6f7b6736170b1f 7g74 ~74623112"}},
      {U'h', {11, "0k06 ~0c2f4g6f7c 7c76"}},
      {U'i', {4, "0g06 0k0k"}},
      {U'j', {6, "2g23 ~231101 2k2k"}},
      {U'k', {10, "0k06 6g0a 2c76"}},
      {U'l', {4, "0k06"}},
      {U'm', {14, "0g06 ~0c2f3g5f5c 5c56 ~5c7f8gafac aca6"}},
      {U'n', {11, "0g06 ~0c2f4g6f7c 7c76"}},
      {U'o', {12, "o4g7f8b7746170b1f"}},
      {U'p', {11, "0g01 o4g6f7b6746170b1f"}},
      {U'q', {11, "o3g6f7b6736170b1f 7g71"}},
      {U'r', {8, "0g06 ~0c1f3g5g"}},
      {U's', {10, "~6e5f3g1f0d1c5a6957361708"}},
      {U't', {8, "2j29 ~29374656 0g5g"}},
      {U'u', {11, "0g0a ~0a1736577a 7g76"}},
      {U'v', {11, "0g468g"}},
      {U'w', {15, "0g366f96cg"}},
      {U'x', {10, "0g76 7g06"}},
      {U'y', {11, "0g46 8g21"}},
      {U'z', {10, "0g7g0676"}},
      {U'µ', {11, "0g01 ~0a1736577a 7g76"}},
      {U'.', {4, "0606"}},
      {U',', {5, "1604"}},
      {U':', {4, "0606 0e0e"}},
      {U';', {5, "1604 1e1e"}},
      {U'-', {9, "0b5b"}},
      {U'−', {12, "0b8b"}},
      {U'+', {12, "0b8b 4f47"}},
      {U'=', {12, "0d8d 0989"}},
      {U'(', {6, "~3l1h0c1733"}},
      {U')', {6, "~0l2h3c2703"}},
      {U'/', {9, "046l"}},
      {U'|', {4, "0l03"}},
      {U'%', {14, "169k o2k4h2e0h o8ca98669"}},
      {U'°', {7, "o2k4i2g0i"}},
      {U'²', {8, "~0i2k4i0d 0d4d"}},
      {U'·', {5, "0c0c"}},
      {U'×', {12, "1e78 7e18"}},
      {U'<', {12, "8f0b87"}},
      {U'>', {12, "0f8b07"}},
      {U'_', {11, "0575"}},
  };
  return glyphs;
}

struct Point {
  double x, y;
};
using Polyline = std::vector<Point>;

double digit(char c) { return c <= '9' ? c - '0' : c - 'a' + 10; }

// Catmull-Rom spline through the points, eight pieces a span.
Polyline smooth(const Polyline& p, bool closed) {
  const int n = static_cast<int>(p.size());
  const auto at = [&](int i) {
    return p[static_cast<std::size_t>(closed ? (i % n + n) % n : std::clamp(i, 0, n - 1))];
  };
  Polyline out;
  for (int i = 0; i < (closed ? n : n - 1); ++i)
    for (int k = 0; k < 8; ++k) {
      const double t = k / 8.0;
      const Point a = at(i - 1), b = at(i), c = at(i + 1), d = at(i + 2);
      const auto value = [&](double pa, double pb, double pc, double pd) {
        return 0.5 *
               (2 * pb + t * (pc - pa + t * (2 * pa - 5 * pb + 4 * pc - pd + t * (3 * (pb - pc) + pd - pa))));
      };
      out.push_back({value(a.x, b.x, c.x, d.x), value(a.y, b.y, c.y, d.y)});
    }
  out.push_back(closed ? out.front() : p.back());
  return out;
}

std::vector<Polyline> strokes_of(const Glyph& glyph) {
  std::vector<Polyline> strokes;
  char kind = ' ';
  Polyline points;
  const auto close = [&] {
    if (points.empty()) return;
    strokes.push_back(kind == ' ' ? points : smooth(points, kind == 'o'));
    points.clear();
    kind = ' ';
  };
  for (const char* c = glyph.strokes; *c;) {
    if (*c == ' ') {
      close();
      ++c;
    } else if (points.empty() && kind == ' ' && (*c == '~' || *c == 'o')) {
      kind = *c++;
    } else {
      points.push_back({digit(c[0]), digit(c[1]) - 6});
      c += 2;
    }
  }
  close();
  return strokes;
}

std::u32string decoded(const std::string& utf8) {
  std::u32string out;
  for (std::size_t i = 0; i < utf8.size();) {
    const auto lead = static_cast<unsigned char>(utf8[i]);
    const std::size_t length = lead < 0x80 ? 1 : lead < 0xe0 ? 2 : lead < 0xf0 ? 3 : 4;
    char32_t code = length == 1 ? lead : lead & (0xffu >> (length + 1));
    for (std::size_t k = 1; k < length && i + k < utf8.size(); ++k)
      code = code << 6 | (static_cast<unsigned char>(utf8[i + k]) & 0x3fu);
    out += code == U'μ' ? U'µ' : code;  // Greek letter and micro sign look alike
    i += length;
  }
  return out;
}

const Glyph& glyph_of(char32_t c) {
  static const Glyph missing{11, "060g7g7606"};
  const auto found = alphabet().find(c);
  return found == alphabet().end() ? missing : found->second;
}

double distance_to_segment(double x, double y, Point a, Point b) {
  const double dx = b.x - a.x, dy = b.y - a.y, length2 = dx * dx + dy * dy;
  const double t = length2 > 0 ? std::clamp(((x - a.x) * dx + (y - a.y) * dy) / length2, 0.0, 1.0) : 0.0;
  return std::hypot(x - a.x - t * dx, y - a.y - t * dy);
}

// Fills everything within half a thickness of the lines, each pixel once, with smooth edges.
void draw_strokes(Image& image, const std::vector<Polyline>& strokes, double thickness, Colour colour,
                  double opacity) {
  double left = 1e9, right = -1e9, top = 1e9, bottom = -1e9;
  for (const Polyline& s : strokes)
    for (const Point p : s)
      left = std::min(left, p.x), right = std::max(right, p.x), top = std::min(top, p.y),
      bottom = std::max(bottom, p.y);
  const double pad = 0.5 * thickness + 1;
  const int x0 = std::max(0, static_cast<int>(std::floor(left - pad))),
            x1 = std::min(image.width - 1, static_cast<int>(std::ceil(right + pad)));
  const int y0 = std::max(0, static_cast<int>(std::floor(top - pad))),
            y1 = std::min(image.height - 1, static_cast<int>(std::ceil(bottom + pad)));
  for (int y = y0; y <= y1; ++y)
    for (int x = x0; x <= x1; ++x) {
      double nearest = 1e9;
      for (const Polyline& s : strokes)
        for (std::size_t i = 0; i < s.size(); ++i)
          nearest = std::min(nearest, distance_to_segment(x + 0.5, y + 0.5, s[i ? i - 1 : 0], s[i]));
      image.blend(x, y, colour, opacity * std::clamp(0.5 + 0.5 * thickness - nearest, 0.0, 1.0));
    }
}

constexpr double cap_units = 14;

}  // namespace

double text_width(const std::string& text, double cap_height) {
  double units = 0;
  for (const char32_t c : decoded(text)) units += glyph_of(c).advance;
  return std::max(0.0, units - 4) * cap_height / cap_units;  // without the space behind the last letter
}

void draw_text(Image& image, double x, double baseline_y, const std::string& text, double cap_height,
               Colour colour, TextAnchor anchor) {
  const double scale = cap_height / cap_units, thickness = std::max(1.15, 0.135 * cap_height);
  const double width = text_width(text, cap_height);
  double pen = x - (anchor == TextAnchor::Middle ? 0.5 * width : anchor == TextAnchor::End ? width : 0.0);
  for (const char32_t c : decoded(text)) {
    std::vector<Polyline> strokes = strokes_of(glyph_of(c));
    for (Polyline& s : strokes)
      for (Point& p : s) p = {pen + scale * p.x, baseline_y - scale * p.y};
    if (!strokes.empty()) draw_strokes(image, strokes, thickness, colour, 1);
    pen += scale * glyph_of(c).advance;
  }
}

void draw_line(Image& image, double x0, double y0, double x1, double y1, double thickness, Colour colour,
               double opacity) {
  draw_strokes(image, {{{x0, y0}, {x1, y1}}}, thickness, colour, opacity);
}

}  // namespace pigment::report
