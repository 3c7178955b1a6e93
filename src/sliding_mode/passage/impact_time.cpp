#include "sliding_mode/passage/impact_time.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "gapscope/base/statistics.h"
#include "sliding_mode/kink_fit.h"
#include "sliding_mode/passage/flight.h"

namespace gapscope::internal::sliding_mode {
namespace {

constexpr double kReaches[] = {2.4, 1.4, 0.8};  ///< after the impact, in times from start to peak of e
constexpr double kTrust = 0.12;      ///< doubt about a kink, over its distance from where e left its floor
constexpr double kLeastDoubt = 0.3;  ///< samples: contacts are not quite the strokes that are tried
constexpr double kHidden = 0.4;  ///< of the time that a contact acts before it shows: doubt about its begin
constexpr double kLeastReach = 0.5;
constexpr double kKinkHolds = 3.0;  ///< standard deviations that the mean square error may exceed the noise
constexpr double kKinkAlmostAsGood = 4.0;  ///< in χ²

constexpr double kSlowest = 4.0;  ///< half period of a contact, in times of the window
constexpr double kApart = 1.3;    ///< half periods that are tried, from one to the next, at least
constexpr double kFirstKnocks[] = {0.35, 0.7};  ///< ρ: of the speed that a load takes in bounces

/// Contacts to try: their half period from two samples to four times the window, light and heavy damping; the
/// rigid impact is the limit of the fast ones. Bounces that fade in the same times: a light load with
/// friction is hit again and again, and takes speed from the motor long after t2.
/// @param after   of the window, behind where the impact shows
/// @param before  … and before it: a soft contact begins there
std::vector<KinkShape> contact_shapes(std::size_t after, std::size_t before) {
  constexpr int kRates = 9;
  std::vector<KinkShape> shapes{{1}};
  const double closest = std::pow(0.5 * kSlowest * static_cast<double>(after), 1.0 / (kRates - 1.0));
  const double longest = kSlowest * static_cast<double>(after + before);
  for (double half_period = 2.0; half_period < 1.01 * longest; half_period *= std::max(closest, kApart)) {
    for (const double damping : {0.05, 0.3}) shapes.push_back({0, kPi / half_period, damping});
    for (const double first : kFirstKnocks) shapes.push_back({0, 0.0, 0.0, first, 1.0 / half_period});
  }
  return shapes;
}

/// What the bank saw of an impact.
struct Mark {
  std::size_t start = 0;    ///< sample from which on it shows
  std::size_t latency = 0;  ///< from there to the peak of e [samples]
  double sharing = 1.0;     ///< samples that make one reading, because they share a rounding

  std::size_t samples(double readings) const {
    return static_cast<std::size_t>(std::lround(readings * sharing));
  }
};

/// What fits around an impact: the law of the flight and a kink, and how far the kink may be moved.
struct Kink {
  bool found = false, holds = false;  ///< holds: within the noise
  bool along = false;                 ///< the passage: no contact pushes that way
  KinkFit best;
  FlightLaw::Fit law;
  double time = 0.0;             ///< [samples]
  double low = 0.0, high = 0.0;  ///< first and last instant that fit almost as well [samples]
  double contact = 0.0;          ///< ω of the best contact of those that the window can tell [rad/sample]
  double hidden = 0.0;           ///< how long it acts before x1 is one standard deviation off [samples]
};

/// A contact begins softly: the samples until it has moved x1 by `sigma`, at most `most`.
double hidden_time(const KinkFit& kink, double sigma, double most) {
  if (std::abs(kink(kink.time + most)) <= sigma) return most;
  double low = 0.0, high = most;
  while (high - low > 0.01) {
    const double middle = 0.5 * (low + high);
    (std::abs(kink(kink.time + middle)) < sigma ? low : high) = middle;
  }
  return high;
}

/// Mean square of what law and kink leave over from sample `from` on [rad²].
double left_over(const MotorTrace& trace, const FlightLaw& law, const Kink& kink, std::size_t from,
                 std::size_t last) {
  double sum = 0.0;
  for (std::size_t i = from; i <= last; ++i) {
    const auto t = static_cast<double>(i);
    const double error = trace.x1[i] - law.state(kink.law, t).position - kink.best(t);
    sum += error * error;
  }
  return sum / static_cast<double>(last - from + 1);
}

/// The kink of least squared error with a begin in [from, to], each shape's into `fits`.
KinkFit best_of(const KinkScan& scan, std::span<const KinkShape> shapes, double from, double to, double step,
                std::vector<KinkFit>& fits) {
  fits.clear();
  for (const KinkShape& shape : shapes) fits.push_back(scan.best(shape, from, to, step));
  return *std::ranges::min_element(fits, {}, &KinkFit::sse);
}

/// ω of the best of those contacts that are not much slower than the time they are seen for; 0: rigid, or
/// bounces [rad/sample].
double contact_told(std::span<const KinkFit> fits, std::size_t after) {
  const double slowest = kPi / (kSlowest * static_cast<double>(after));
  const KinkFit* best = &fits.front();
  for (const KinkFit& fit : fits) {
    const bool slow = fit.shape.omega > 0.0 && fit.shape.omega < 0.99 * slowest;
    if (!slow && fit.sse < best->sse) best = &fit;
  }
  return best->shape.omega;
}

Kink find_kink(const PassageContext& context, const Mark& mark, const FlightLaw& law, std::size_t first,
               std::size_t after) {
  Kink kink;
  const std::size_t last = std::min({mark.start + after, law.window().last, context.trace.size() - 1});
  const std::size_t most = (mark.start - first) / 2, to = std::min(mark.start + mark.latency, last) - 2;
  std::size_t back = std::min(3 * mark.latency + mark.samples(5.0), most);
  if (last < first + 20 || to <= mark.start - back) return kink;
  const std::span<const double> y(&context.trace.x1[first], last - first + 1);
  const KinkScan scan(y, first, law.columns().rows(first, last));
  const double end = static_cast<double>(to);
  double begin = 0.0, step = 0.0;
  std::vector<KinkFit> fits;
  for (;; back = std::min(2 * back, most)) {
    begin = static_cast<double>(mark.start - back), step = std::max(0.5, static_cast<double>(back) / 20.0);
    kink.best = best_of(scan, contact_shapes(after, back), begin, end, step, fits);
    if (kink.best.time > begin + step || back == most) break;  // a least error at the rim is none
  }
  Eigen::VectorXd known(static_cast<Eigen::Index>(y.size()));
  for (Eigen::Index i = 0; i < known.size(); ++i)
    known(i) = kink.best(static_cast<double>(first) + static_cast<double>(i));
  kink.law = law.fit_without(first, known);
  kink.found = true;
  kink.along = law.direction() * kink.best.amplitude > 0.0;
  const std::size_t from = mark.start - back;
  const double sigma2 = context.facts.noise * context.facts.noise,
               left = left_over(context.trace, law, kink, from, last);
  const double readings = static_cast<double>(last - from + 1) / mark.sharing;
  kink.holds = left <= sigma2 * (1.0 + kKinkHolds * std::sqrt(2.0 / readings));
  const double limit = kink.best.sse + kKinkAlmostAsGood * std::max(sigma2, left) * mark.sharing;
  kink.time = kink.low = kink.high = kink.best.time;
  kink.contact = contact_told(fits, after);
  for (const KinkFit& fit : fits) {
    if (fit.sse > limit) continue;
    scan.widen(fit.shape, begin, end, step, limit, kink.low, kink.high);
    kink.hidden =
        std::max(kink.hidden, hidden_time(fit, context.facts.noise, static_cast<double>(last - from)));
  }
  return kink;
}

/// Over the longest stretch after the impact that one contact explains, and over the least: they err in other
/// ways (where a load sticks, rings or meets the motor again; by noise), so the middle of both is taken.
Kink find_kinks(const PassageContext& context, const Mark& mark, const FlightLaw& law, std::size_t first) {
  const auto within = [&](double reach) {
    const auto after = static_cast<std::size_t>(std::lround(reach * static_cast<double>(mark.latency)));
    return find_kink(context, mark, law, first, std::max(mark.samples(3.0), after));
  };
  Kink kink = within(kLeastReach);
  if (!kink.found) return kink;
  for (const double reach : kReaches) {
    const Kink longer = within(reach);
    if (!longer.found || !longer.holds) continue;
    kink.along = kink.along || longer.along;
    kink.low = std::min(kink.low, longer.low);
    kink.high = std::max(kink.high, longer.high);
    kink.hidden = std::max(kink.hidden, longer.hidden);
    kink.time = 0.5 * (kink.time + longer.time);
    break;
  }
  return kink;
}

/// Where the law that leads to the impact begins. The stretch that the noise allows reaches back into the
/// contact before t1, which bends the law and lets t2 be read early: only what surely lies after t1 is used.
std::size_t begin_of_law(const FlightLaw& law, std::size_t core, std::size_t grown) {
  const FreeFlight flight = law.find_release(core);
  if (!flight.found) return grown;
  return std::max(grown, static_cast<std::size_t>(std::ceil(std::max(flight.latest.time, 0.0))));
}

}  // namespace

ImpactTime refine_impact(const PassageContext& context, const BankEvent& impact, const Reversal& reversal,
                         const FlightLaw& law) {
  ImpactTime result;
  const std::size_t flight = impact.start - std::min(reversal.last, impact.start);
  const bool turned = reversal.rise >= context.facts.least_way();
  const std::size_t sure = std::max<std::size_t>(2, turned ? flight / 10 : impact.latency);
  result.core = impact.start - std::min(impact.start, sure);
  FlightLaw::Fit before_impact;
  if (!law.fit_before(result.core, before_impact)) return result;
  const double dt = context.trace.dt;
  const double speed = std::abs(law.state(before_impact, static_cast<double>(result.core)).speed);
  const double mean_step = reversal.rise / static_cast<double>(std::max<std::size_t>(flight, 1));
  Mark mark{impact.start, impact.latency, context.facts.sharing(std::max(speed * dt, mean_step))};
  mark.latency = std::max(mark.latency, mark.samples(1.0));
  const Kink kink = find_kinks(context, mark, law, begin_of_law(law, result.core, before_impact.first));
  if (!kink.found) return result;
  const MotorState before = law.state(kink.law, kink.time);
  result.found = true;
  result.freed = kink.along;
  result.time = kink.time;
  const double away = std::abs(kink.time - static_cast<double>(impact.start));
  const double doubt = std::max({0.5 * (kink.high - kink.low), kTrust * away, kLeastDoubt});
  result.contact = kink.contact / dt;
  result.hidden = kink.hidden * dt;
  result.half_width = std::hypot(doubt * dt, kHidden * result.hidden);
  result.position = before.position;
  result.speed = before.speed;
  result.acceleration = before.acceleration;
  result.drive = law.drive(kink.law, kink.time);
  return result;
}

}  // namespace gapscope::internal::sliding_mode
