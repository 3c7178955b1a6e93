#include "report/svg_canvas.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "report/rich_text.h"

namespace gapscope::internal::report {
namespace {

/// Hundredths of a pixel, without what says nothing: "12.5", "-3".
std::string coordinate(double value) {
  const double hundredths = std::round(100.0 * std::clamp(value, -1e5, 1e5));
  std::string text = fmt::format("{:.2f}", hundredths / 100.0 + 0.0);
  text.erase(text.find_last_not_of('0') + 1);
  if (text.back() == '.') text.pop_back();
  return text == "-0" ? "0" : text;
}

std::string hex(Colour c) { return fmt::format("#{:02x}{:02x}{:02x}", c.red, c.green, c.blue); }

std::string points_of(const Polyline& line) {
  std::string text;
  for (const Point& p : line) text += (text.empty() ? "" : " ") + coordinate(p.x) + "," + coordinate(p.y);
  return text;
}

std::string box_of(const Box& b) {
  return fmt::format("x=\"{}\" y=\"{}\" width=\"{}\" height=\"{}\"", coordinate(b.x), coordinate(b.y),
                     coordinate(b.width), coordinate(b.height));
}

std::string circle(Point at, double radius, const std::string& colour) {
  return fmt::format("<circle cx=\"{}\" cy=\"{}\" r=\"{}\" fill=\"{}\"/>\n", coordinate(at.x),
                     coordinate(at.y), coordinate(radius), colour);
}

}  // namespace

void SvgCanvas::fill(const Box& box, Colour colour) {
  body_ += fmt::format("<rect {} fill=\"{}\" shape-rendering=\"crispEdges\"/>\n", box_of(box), hex(colour));
}

void SvgCanvas::path(const Polyline& points, const LineStyle& style, const std::string& more) {
  if (points.empty()) return;
  std::string dashes;
  for (const double part : style.dashes) dashes += (dashes.empty() ? "" : " ") + coordinate(part);
  body_ += fmt::format("<polyline points=\"{}\" stroke=\"{}\" stroke-width=\"{}\"{}{}/>\n", points_of(points),
                       hex(style.colour), coordinate(style.width),
                       dashes.empty() ? "" : " stroke-dasharray=\"" + dashes + "\"", more);
}

void SvgCanvas::line(const Polyline& points, const LineStyle& style) { path(points, style, ""); }

void SvgCanvas::line(const Polyline& points, const LineStyle& style, const Box& clip) {
  path(points, style, " clip-path=\"url(#" + clip_name(clip) + ")\"");
}

std::string SvgCanvas::clip_name(const Box& clip) {
  const auto same = [&](const Box& b) { return b.holds(clip) && clip.holds(b); };
  const auto found = std::find_if(clips_.begin(), clips_.end(), same);
  const auto number = found - clips_.begin();
  if (found == clips_.end()) clips_.push_back(clip);
  return fmt::format("{}frame{}", prefix_, number + 1);
}

void SvgCanvas::marker(Point at, Marker marker, Colour colour, double size) {
  switch (marker) {
    case Marker::kNone:
      return;
    case Marker::kDisc:
    case Marker::kCircle:
      body_ += circle(at, size / 2, hex(colour));
      if (marker == Marker::kCircle) body_ += circle(at, size / 2 - kRing, "#ffffff");
      return;
    case Marker::kTriangleUp:
    case Marker::kTriangleDown:
      body_ += fmt::format("<polygon points=\"{}\" fill=\"{}\"/>\n", points_of(triangle(at, marker, size)),
                           hex(colour));
      return;
    case Marker::kCross:
      for (const Polyline& stroke : cross(at, size)) path(stroke, {colour, kCrossWidth, {}}, "");
  }
}

void SvgCanvas::run(Point origin, const PlacedRun& p, const TextStyle& style) {
  body_ += fmt::format(
      "<text x=\"{}\" y=\"{}\" font-size=\"{}\" fill=\"{}\"{}{} textLength=\"{}\" "
      "lengthAdjust=\"spacingAndGlyphs\" xml:space=\"preserve\">{}</text>\n",
      coordinate(origin.x + p.x), coordinate(origin.y + p.y), coordinate(p.size), hex(style.colour),
      style.bold ? " font-weight=\"bold\"" : "", p.run.italic ? " font-style=\"oblique\"" : "",
      coordinate(p.width), markup_text(p.run.text));
  if (!p.run.hat) return;
  Polyline hat = typesetter_.hat_of(p, style.bold);
  for (Point& corner : hat) corner = {origin.x + corner.x, origin.y + corner.y};
  path(hat, {style.colour, Typesetter::hat_width(p, style.bold), {}}, "");
}

void SvgCanvas::text(Point at, const std::string& markup, const TextStyle& style) {
  const double width = typesetter_.measure(markup, style.size, style.bold).width;
  const double before = style.align == Align::kLeft ? 0.0 : style.align == Align::kCentre ? width / 2 : width;
  if (style.upwards)
    body_ +=
        fmt::format("<g transform=\"translate({} {}) rotate(-90)\">\n", coordinate(at.x), coordinate(at.y));
  const Point origin = style.upwards ? Point{-before, 0.0} : Point{at.x - before, at.y};
  for (const PlacedRun& placed : typesetter_.place(markup, style.size, style.bold))
    run(origin, placed, style);
  if (style.upwards) body_ += "</g>\n";
}

void SvgCanvas::plot(const Box& frame, const AxisPlan& x, const AxisPlan& y) {
  const auto axis = [](const char* name, const AxisPlan& a) {
    return fmt::format(" data-{0}=\"{1}\" data-{0}low=\"{2:.9g}\" data-{0}high=\"{3:.9g}\"", name,
                       markup_text(plain_text(a.label)), a.range.low / a.factor, a.range.high / a.factor);
  };
  body_ +=
      fmt::format("<rect class=\"plot\" {} fill=\"none\" pointer-events=\"all\" data-clip=\"{}\"{}{}/>\n",
                  box_of(frame), clip_name(frame), axis("x", x), axis("y", y));
}

std::string SvgCanvas::clips() const {
  std::string text = clips_.empty() ? "" : "<defs>\n";
  for (std::size_t i = 0; i < clips_.size(); ++i)
    text +=
        fmt::format("<clipPath id=\"{}frame{}\"><rect {}/></clipPath>\n", prefix_, i + 1, box_of(clips_[i]));
  return text + (clips_.empty() ? "" : "</defs>\n");
}

std::string SvgCanvas::element(double width, double height, const std::string& title,
                               const std::string& more) const {
  return fmt::format(
             "<svg viewBox=\"0 0 {} {}\" role=\"img\" aria-label=\"{}\" font-family=\"DejaVu Sans, Verdana, "
             "sans-serif\" stroke-linejoin=\"round\" fill=\"none\"{}>\n",
             coordinate(width), coordinate(height), markup_text(title), more) +
         clips() + body_ + "</svg>\n";
}

std::string SvgCanvas::document(double width, double height, double pixel, const std::string& title,
                                const std::string& reading) const {
  const double centimetres = 100.0 * pixel;
  std::string text = fmt::format(
      "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n"
      "<svg xmlns=\"http://www.w3.org/2000/svg\" version=\"1.1\" width=\"{}cm\" height=\"{}cm\" "
      "viewBox=\"0 0 {} {}\" role=\"img\" font-family=\"DejaVu Sans, Verdana, sans-serif\" "
      "stroke-linejoin=\"round\" fill=\"none\">\n<title>{}</title>\n",
      coordinate(width * centimetres), coordinate(height * centimetres), coordinate(width),
      coordinate(height), markup_text(title));
  if (!reading.empty()) text += "<desc>" + markup_text(reading) + "</desc>\n";
  return text + clips() + fmt::format("<rect {} fill=\"#ffffff\"/>\n", box_of({0.0, 0.0, width, height})) +
         body_ + "</svg>\n";
}

}  // namespace gapscope::internal::report
