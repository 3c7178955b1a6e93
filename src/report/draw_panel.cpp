#include <cmath>

#include "report/draw_figure.h"

namespace gapscope::internal::report {
namespace {

constexpr double kMarkerSize = 22.0;

/// One panel at its place on the paper.
class PanelPainter {
 public:
  PanelPainter(Canvas& canvas, const Panel& panel, const PanelPlan& plan, Point corner,
               const Typesetter& typesetter)
      : canvas_(canvas),
        panel_(panel),
        plan_(plan),
        frame_{corner.x, corner.y, plan.width, plan.height},
        typesetter_(typesetter) {}

  void background() {
    for (const Band& band : panel_.x_bands)
      shade(x_of(band.range.low), x_of(band.range.high), true, band.colour);
    for (const Band& band : panel_.y_bands)
      shade(y_of(band.range.high), y_of(band.range.low), false, band.colour);
    const LineStyle grid{kGrid, 1.5, {}};
    for (const double v : plan_.x.ticks.values) vertical(x_of(v * plan_.x.factor), grid);
    for (const double v : plan_.y.ticks.values) horizontal(y_of(v * plan_.y.factor), grid);
  }

  void tiles() {
    for (const Tile& tile : panel_.tiles) {
      const double x = x_of(tile.x.low), y = y_of(tile.y.high);
      const Box box{x, y, x_of(tile.x.high) - x, y_of(tile.y.low) - y};
      canvas_.fill(tile.text.empty() ? box : box.grown(-1.5), tile.colour);
      if (tile.text.empty()) continue;
      const double above = tile.note.empty() ? 0.36 : -0.15, below = 0.98;
      canvas_.text({box.centre().x, box.centre().y + above * kTickSize}, tile.text,
                   {kTickSize, Align::kCentre, tile.ink});
      if (!tile.note.empty())
        canvas_.text({box.centre().x, box.centre().y + below * kTickSize}, tile.note,
                     {kTickSize, Align::kCentre, tile.ink});
    }
  }

  void data() {
    for (const Mark& mark : panel_.x_marks) vertical(x_of(mark.at), mark.style);
    for (const Mark& mark : panel_.y_marks) horizontal(y_of(mark.at), mark.style);
    for (const Series& s : panel_.series) series(s);
    canvas_.line({{frame_.x, frame_.y},
                  {frame_.right(), frame_.y},
                  {frame_.right(), frame_.bottom()},
                  {frame_.x, frame_.bottom()},
                  {frame_.x, frame_.y}},
                 {kFrame, 2.0, {}});
  }

  void ticks() {
    const LineStyle tick{kFrame, 2.0, {}};
    for (std::size_t i = 0; i < plan_.x.ticks.values.size(); ++i) {
      const double x = x_of(plan_.x.ticks.values[i] * plan_.x.factor);
      if (!has_fields()) canvas_.line({{x, frame_.bottom()}, {x, frame_.bottom() - 10.0}}, tick);
      if (panel_.x_labels)
        canvas_.text({x, frame_.bottom() + kToTicks + 0.8 * kTickSize}, plan_.x.tick_text(i),
                     {kTickSize, Align::kCentre});
    }
    for (std::size_t i = 0; i < plan_.y.ticks.values.size(); ++i) {
      const double y = y_of(plan_.y.ticks.values[i] * plan_.y.factor);
      if (!has_fields()) canvas_.line({{frame_.x, y}, {frame_.x + 10.0, y}}, tick);
      canvas_.text({frame_.x - kSpace, y + 0.36 * kTickSize}, plan_.y.tick_text(i),
                   {kTickSize, Align::kRight});
    }
    categories();
  }

  void labels(double left_margin) {
    if (panel_.x_labels && !plan_.x.label.empty())
      canvas_.text({frame_.centre().x, frame_.bottom() + plan_.below - 0.26 * kTextSize}, plan_.x.label,
                   {kTextSize, Align::kCentre});
    double x = frame_.x - left_margin;
    for (const std::string& line : plan_.y.lines) {
      const TextMetrics metrics = typesetter_.measure(line, kTextSize);
      canvas_.text({x + metrics.ascent, frame_.centre().y}, line,
                   {kTextSize, Align::kCentre, kInk, false, true});
      x += metrics.height();
    }
  }

  /// The strip above the frame: title, legend, names of the vertical marks.
  void above() {
    double y = frame_.y - plan_.above;
    for (const std::string& line : plan_.title) {
      const TextMetrics metrics = typesetter_.measure(line, kTextSize, true);
      canvas_.text({frame_.x, y + metrics.ascent}, line, {kTextSize, Align::kLeft, kInk, true});
      y += metrics.height() + kTitleGap;
    }
    legend({frame_.x, y});
    mark_names();
  }

  void dimensions() {
    for (const Dimension& dimension : panel_.dimensions) {
      const double x = frame_.right() + 2 * kSpace;
      const double low = y_of(dimension.range.low), high = y_of(dimension.range.high);
      const LineStyle ink{kInk, 2.5, {}};
      for (const double y : {low, high}) canvas_.line({{frame_.right(), y}, {x + kSpace, y}}, ink);
      canvas_.line({{x, low}, {x, high}}, ink);
      const double inwards = std::abs(low - high) > 60.0 ? 1.0 : -1.0;  // a small one is held from outside
      arrow({x, std::max(low, high)}, -inwards);
      arrow({x, std::min(low, high)}, inwards);
      at_the_right(x, (low + high) / 2, dimension.label);
    }
  }

 private:
  /// Named fields need no ticks.
  bool has_fields() const { return !panel_.tiles.empty() && !panel_.tiles.front().text.empty(); }
  double x_of(double x) const { return frame_.x + plan_.x.fraction(x) * frame_.width; }
  double y_of(double y) const { return frame_.bottom() - plan_.y.fraction(y) * frame_.height; }
  /// Upright beside the frame; a name longer than the frame hangs down from its top.
  void at_the_right(double x, double centre, const std::string& label) {
    const TextMetrics metrics = typesetter_.measure(label, kTextSize);
    const double half = metrics.width / 2;
    const double middle =
        std::clamp(centre, frame_.y + half, std::max(frame_.y + half, frame_.bottom() - half));
    canvas_.text({x + 2 * kSpace + metrics.ascent, middle}, label,
                 {kTextSize, Align::kCentre, kInk, false, true});
  }

  void vertical(double x, const LineStyle& style) {
    canvas_.line({{x, frame_.y}, {x, frame_.bottom()}}, style, frame_);
  }
  bool within(double x, double y) const {
    const double fx = plan_.x.fraction(x), fy = plan_.y.fraction(y);
    return fx >= 0.0 && fx <= 1.0 && fy >= 0.0 && fy <= 1.0;  // false for NaN
  }
  void horizontal(double y, const LineStyle& style) {
    canvas_.line({{frame_.x, y}, {frame_.right(), y}}, style, frame_);
  }

  void shade(double from, double to, bool upright, Colour colour) {
    const double low = upright ? frame_.x : frame_.y, high = upright ? frame_.right() : frame_.bottom();
    from = std::clamp(from, low, high);
    to = std::clamp(to, low, high);
    if (to <= from) return;
    canvas_.fill(upright ? Box{from, frame_.y, to - from, frame_.height}
                         : Box{frame_.x, from, frame_.width, to - from},
                 colour);
  }

  void series(const Series& s) {
    for (const Polyline& line : polylines_of(s, plan_)) {
      Polyline moved;
      for (const Point& p : line) moved.push_back({frame_.x + p.x, frame_.y + p.y});
      canvas_.line(moved, s.style, frame_);
    }
    const LineStyle bar{s.style.colour, 4.0, {}};
    for (std::size_t i = 0; i < s.x_intervals.size(); ++i) {
      const double y = y_of(s.y[i]), low = x_of(s.x_intervals[i].low), high = x_of(s.x_intervals[i].high);
      canvas_.line({{low, y}, {high, y}}, bar, frame_);
      if (s.stems) continue;
      for (const double x : {low, high}) canvas_.line({{x, y - 12.0}, {x, y + 12.0}}, bar, frame_);
    }
    for (std::size_t i = 0; i < s.y_intervals.size(); ++i)
      canvas_.line({{x_of(s.x[i]), y_of(s.y_intervals[i].low)}, {x_of(s.x[i]), y_of(s.y_intervals[i].high)}},
                   bar, frame_);
    for (std::size_t i = 0; i < s.x.size() && s.marker != Marker::kNone; ++i)
      if (within(s.x[i], s.y[i]))
        canvas_.marker({x_of(s.x[i]), y_of(s.y[i])}, s.marker, s.style.colour, kMarkerSize);
  }

  void categories() {
    for (std::size_t i = 0; i < panel_.y.categories.size(); ++i) {
      const double y = y_of(static_cast<double>(i)) + 0.36 * kTextSize;
      canvas_.text({frame_.x - kSpace, y}, panel_.y.categories[i], {kTextSize, Align::kRight});
      if (i < panel_.y.remarks.size() && !panel_.y.remarks[i].empty())
        canvas_.text({frame_.right() + kSpace, y}, panel_.y.remarks[i], {kTextSize});
    }
  }

  void legend(Point corner) {
    for (std::size_t i = 0; i < plan_.entries.size(); ++i) {
      const LegendEntry& entry = plan_.entries[i];
      const Point at{corner.x + plan_.legend.places[i].x, corner.y + plan_.legend.places[i].y};
      const double middle = at.y - 0.36 * kTextSize;
      if (entry.shade) canvas_.fill({at.x, middle - 14.0, kSample, 28.0}, entry.style.colour);
      if (entry.joined) canvas_.line({{at.x, middle}, {at.x + kSample, middle}}, entry.style);
      canvas_.marker({at.x + kSample / 2, middle}, entry.marker, entry.style.colour, kMarkerSize);
      canvas_.text({at.x + kSample + kSpace, at.y}, entry.label, {kTextSize});
    }
  }

  /// Names stand above their marks; where two would meet they move apart, and a short line leads to the mark.
  void mark_names() {
    std::vector<Mark> marks;
    for (const Mark& mark : panel_.x_marks)
      if (!mark.label.empty()) marks.push_back(mark);
    std::sort(marks.begin(), marks.end(), [](const Mark& a, const Mark& b) { return a.at < b.at; });
    std::vector<double> centres = spread(marks);
    for (std::size_t i = 0; i < marks.size(); ++i) {
      canvas_.text({centres[i], frame_.y - 0.5 * kTextSize}, marks[i].label, {kTextSize, Align::kCentre});
      canvas_.line({{centres[i], frame_.y - 0.2 * kTextSize}, {x_of(marks[i].at), frame_.y}},
                   {kFrame, 2.0, {}});
    }
  }

  std::vector<double> spread(const std::vector<Mark>& marks) const {
    std::vector<double> centres, halves;
    for (const Mark& mark : marks) {
      halves.push_back(typesetter_.measure(mark.label, kTextSize).width / 2 + kSpace / 2);
      const double first = frame_.x + halves.back();  // a name longer than the frame begins with it
      centres.push_back(std::clamp(x_of(mark.at), first, std::max(first, frame_.right() - halves.back())));
    }
    for (std::size_t i = 1; i < centres.size(); ++i)
      centres[i] = std::max(centres[i], centres[i - 1] + halves[i - 1] + halves[i]);
    for (std::size_t i = centres.size(); i-- > 0;) {
      const double limit = i + 1 < centres.size() ? centres[i + 1] - halves[i + 1] : frame_.right();
      centres[i] = std::min(centres[i], limit - halves[i]);
    }
    return centres;
  }

  void arrow(Point tip, double down) {
    canvas_.line({{tip.x - 7.0, tip.y + down * 16.0}, tip, {tip.x + 7.0, tip.y + down * 16.0}},
                 {kInk, 2.5, {}});
  }

  Canvas& canvas_;
  const Panel& panel_;
  const PanelPlan& plan_;
  Box frame_;
  const Typesetter& typesetter_;
};

}  // namespace

void draw_panel(Canvas& canvas, const Panel& panel, const PanelPlan& plan, Point corner, double left_margin,
                const Typesetter& typesetter) {
  PanelPainter painter(canvas, panel, plan, corner, typesetter);
  painter.background();
  painter.tiles();
  painter.data();
  painter.ticks();
  painter.labels(left_margin);
  painter.above();
  painter.dimensions();
}

}  // namespace gapscope::internal::report
