#pragma once
// Letters for pictures: a single-stroke alphabet, drawn with smooth edges at any size.
#include <string>

#include "report/png_image.h"

namespace pigment::report {

enum class TextAnchor { Start, Middle, End };

// Width in pixels of a line of UTF-8 text whose capitals are cap_height pixels tall.
double text_width(const std::string& text, double cap_height);
// Draws it with its baseline at y. A character that the alphabet lacks appears as a small box.
void draw_text(Image&, double x, double baseline_y, const std::string& text, double cap_height, Colour,
               TextAnchor = TextAnchor::Start);
// A straight line with round ends.
void draw_line(Image&, double x0, double y0, double x1, double y1, double thickness, Colour,
               double opacity = 1);

}  // namespace pigment::report
