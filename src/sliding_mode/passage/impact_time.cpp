#include "sliding_mode/passage/impact_time.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "gapscope/base/statistics.h"
#include "sliding_mode/passage/contact_onset.h"
#include "sliding_mode/passage/flight.h"

namespace gapscope::internal::sliding_mode {
namespace {

constexpr double kLeastDoubt = 0.3;   ///< samples: of a contact whose stroke is over within one
constexpr double kOnsetAsGood = 4.0;  ///< in χ²

/// Readings behind the mark that are looked at: as few as show the contact, since what it does later is the
/// law of a contact that nobody knows. Of `study_trust all 1 12 reading` half tells two fewer and loses one
/// more, double tells nine more, of which four miss: their contacts are taken for others.
constexpr double kBehind = 2.0;
constexpr double kFinestOnset = 0.25;  ///< samples, between the instants that are tried for the interval
constexpr double kCoarse = 0.5;        ///< … at least for the best one,
constexpr double kTrials = 40.0;       ///< of which there are so many
constexpr std::size_t kMostOnsetRows = 4000;  ///< that an onset is sought in; of longer stretches every n-th
constexpr double kBeforeOnset = 3.0;          ///< samples before it that the law has to hold in as well
constexpr std::size_t kFewestOfLaw = 20;
constexpr double kAtOnce = 0.5;  ///< of what the contact takes of x1, from which on it is called rigid

/// What the bank saw of an impact.
struct Mark {
  std::size_t start = 0;    ///< sample from which on it shows
  std::size_t latency = 0;  ///< from there to the peak of e [samples]
  double sharing = 1.0;     ///< samples that make one reading, because they share a rounding

  std::size_t samples(double readings) const {
    return static_cast<std::size_t>(std::lround(readings * sharing));
  }
};

/// Where the contact began, by the law of the flight and what begins there.
struct OnsetFit {
  bool found = false;
  bool along = false;  ///< the passage: no contact pushes that way
  Onset best;
  FlightLaw::Fit law;
  double low = 0.0, high = 0.0;  ///< first and last instant that fit almost as well [samples]
};

/// Mean square of what law and contact leave over near the impact [rad²].
double left_over(const MotorTrace& trace, const FlightLaw& law, const OnsetFit& fit, std::size_t from,
                 std::size_t last) {
  double sum = 0.0;
  for (std::size_t i = from; i <= last; ++i) {
    const auto t = static_cast<double>(i);
    const double error = trace.x1[i] - law.state(fit.law, t).position + law.direction() * fit.best(t);
    sum += error * error;
  }
  const double rows = static_cast<double>(last - from) - static_cast<double>(fit.best.count());
  return sum / std::max(rows, 1.0);
}

/// @param first  of the samples that surely belong to the flight
OnsetFit find_onset(const PassageContext& context, const Mark& mark, const FlightLaw& law,
                    std::size_t first) {
  OnsetFit fit;
  const std::size_t last =
      std::min({mark.start + mark.samples(kBehind), law.window().last, context.trace.size() - 1});
  if (last < first + kFewestOfLaw || mark.start < first + 4) return fit;
  const std::size_t stride = (last - first) / kMostOnsetRows + 1;
  const Eigen::VectorXd y = law.columns().positions(first, last, stride);
  const Eigen::MatrixXd columns = law.columns().rows(first, last, stride);
  if (columns.rows() <= columns.cols()) return fit;
  const OnsetScan scan(y, 0, law.direction(), columns, OnsetScan::Start::kImpact);
  const OnsetScan pulled(y, 0, -law.direction(), columns, OnsetScan::Start::kImpact);
  const auto width = static_cast<double>(stride);
  const auto row = [&](double time) { return (time - static_cast<double>(first)) / width; };
  const auto time = [&](double rows) { return static_cast<double>(first) + width * rows; };
  const double end = static_cast<double>(y.size()) - 2.0;
  const double sigma2 = context.facts.noise * context.facts.noise, alike = kAlike * sigma2;
  const std::size_t most = (mark.start - first) / 2;
  std::size_t back = std::min(3 * mark.latency + mark.samples(5.0), most);
  double begin = 0.0, step = 0.0;
  for (;; back = std::min(2 * back, most)) {
    begin = row(static_cast<double>(mark.start - back)), step = std::max(kCoarse, (end - begin) / kTrials);
    fit.best = scan.best(begin, end, step, alike);
    if (fit.best.time > begin + step || back == most) break;  // a least error at the rim is none
  }
  fit.found = true;
  fit.along = pulled.best(begin, end, step, alike).sse < fit.best.sse;
  fit.best.time = time(fit.best.time), fit.best.last = time(fit.best.last);
  Eigen::VectorXd known(static_cast<Eigen::Index>(last - first + 1));
  for (Eigen::Index i = 0; i < known.size(); ++i)
    known(i) = -law.direction() * fit.best(static_cast<double>(first) + static_cast<double>(i));
  fit.law = law.fit_without(first, known);
  const auto from =
      static_cast<std::size_t>(std::max(fit.best.time - kBeforeOnset, static_cast<double>(first)));
  const double left = left_over(context.trace, law, fit, from, last);
  const double limit =
      fit.best.sse + kOnsetAsGood * std::max(sigma2, left) * std::max(1.0, mark.sharing / width);
  const Interval open = scan.within(begin, end, std::min(step, kFinestOnset), limit);
  fit.low = std::min(time(open.low), fit.best.time), fit.high = std::max(time(open.high), fit.best.time);
  return fit;
}

/// k/m1 of the contact, if it is a spring that the motor runs into at its speed and that is seen as long as
/// this, which takes k/m1·v·T³/6 of x1 [1/s²]; 0: it took the speed at once.
/// @param speed  of the motor before it [rad/s]
double stiffness_of(const Onset& onset, double speed, double dt) {
  const double taken = onset(onset.last), duration = (onset.last - onset.time) * dt;
  if (!(taken > 0.0) || onset.numbers(0) > kAtOnce * taken) return 0.0;
  return 6.0 * taken / (speed * duration * duration * duration);
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
  Mark mark{impact.start, impact.latency,
            std::min(context.facts.sharing(std::max(speed * dt, mean_step)),
                     static_cast<double>(context.trace.size()))};
  mark.latency = std::max(mark.latency, mark.samples(1.0));
  const OnsetFit onset = find_onset(context, mark, law, begin_of_law(law, result.core, before_impact.first));
  if (!onset.found) return result;
  const MotorState before = law.state(onset.law, onset.best.time);
  result.found = true;
  result.freed = onset.along;
  result.time = onset.best.time;
  result.half_width = std::max(0.5 * (onset.high - onset.low), kLeastDoubt) * dt;
  result.stiffness = stiffness_of(onset.best, std::abs(before.speed), dt);
  result.position = before.position;
  result.speed = before.speed;
  result.acceleration = before.acceleration;
  result.drive = law.drive(onset.law, onset.best.time);
  return result;
}

}  // namespace gapscope::internal::sliding_mode
