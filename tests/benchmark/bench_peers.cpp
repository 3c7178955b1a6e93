// General integrators on the simulator's problem: the same drive, held input and events. Each works at the
// loosest tolerance (in half decades) at which x1 stays within the asked accuracy of the simulator run with
// steps 64 times shorter. Counters: that tolerance and its error, the simulator's own error, and how many
// times slower the peer is. Both are timed in turn and the least of each counts; read the median of the
// ratio.
#include <cmath>
#include <limits>
#include <memory>
#include <string>

#include "benchmark/measure.h"
#include "benchmark/peers.h"
#include "gapscope/simulation/simulate.h"

namespace gapscope::benchmarks {
namespace {

using benchmark_peers::Peer;
using MakePeer = std::unique_ptr<Peer> (*)(const DriveParameters<double>&);

/// x1 at the start of each sample of 1/kRate, from `finer` steps within each.
std::vector<double> positions(const std::vector<double>& u, int finer) {
  DriveStepper<double> stepper(plant_model(test::paper_rig(), {}), 1.0 / (finer * kRate));
  std::vector<double> x1;
  for (const double v : u) {
    x1.push_back(stepper.state().x1);
    for (int i = 0; i < finer; ++i) stepper.step(v);
  }
  return x1;
}

double largest_difference(const std::vector<double>& a, const std::vector<double>& b) {
  double largest = 0.0;
  for (std::size_t i = 0; i < a.size(); ++i) largest = std::max(largest, std::abs(a[i] - b[i]));
  return largest;
}

/// One peer on one input.
class Comparison {
 public:
  Comparison(MakePeer make, double accuracy, std::vector<double> u)
      : peer_(make(test::paper_rig())), accuracy_(accuracy), u_(std::move(u)), x1_(u_.size()) {}

  void run(benchmark::State& state) {
    if (reference_.empty()) find_loosest_tolerance();
    if (!(error_ <= accuracy_)) return state.SkipWithError("the accuracy is not reached at any tolerance");
    DriveStepper<double> stepper(plant_model(test::paper_rig(), {}), 1.0 / kRate);
    double own = 1e9, other = 1e9;
    for (auto _ : state) {
      for (int i = 0; i < 10; ++i) own = std::min(own, seconds([&] { play(stepper, u_); }));
      const double t = seconds([this] { run_peer(); });
      state.SetIterationTime(t);
      other = std::min(other, t);
    }
    state.counters["events"] = static_cast<double>(events_);
    state.counters["tolerance"] = tolerance_;
    state.counters["error_rad"] = error_;
    state.counters["own_error_rad"] = largest_difference(positions(u_, 1), reference_);
    state.counters["own_s"] = own;
    state.counters["times_slower"] = other / own;
  }

 private:
  template <class F>
  static double seconds(const F& work) {
    const double start = cpu_seconds();
    work();
    return cpu_seconds() - start;
  }

  void run_peer() { events_ = peer_->run(u_, 1.0 / kRate, tolerance_, x1_); }

  void find_loosest_tolerance() {
    reference_ = positions(u_, 64);
    for (int half_decades = 4; half_decades <= 26 && !(error_ <= accuracy_); ++half_decades) {
      tolerance_ = std::pow(10.0, -0.5 * half_decades);
      run_peer();
      error_ = largest_difference(x1_, reference_);
    }
  }

  std::unique_ptr<Peer> peer_;
  double accuracy_;  ///< [rad]
  std::vector<double> u_, x1_, reference_;
  double tolerance_ = 0.0;
  double error_ = std::numeric_limits<double>::infinity();  ///< [rad]
  long events_ = 0;
};

[[maybe_unused]] void add(const std::string& name, MakePeer make, double accuracy, int repetitions,
                          int iterations) {
  const auto run = [&](const std::string& input, const std::vector<double>& u) {
    const auto comparison = std::make_shared<Comparison>(make, accuracy, u);
    repeat(benchmark::RegisterBenchmark((name + "/" + input).c_str(),
                                        [=](benchmark::State& s) { comparison->run(s); })
               ->UseManualTime()
               ->Iterations(iterations),
           repetitions);
  };
  run("sine", test::sine(kAmplitude, 1.0, kRate, kDuration));
  run("several_sines", test::several_sines(kAmplitude, kRate, kDuration));
}

const bool kRegistered = [] {
#ifdef GAPSCOPE_HAS_ODEINT
  add("peer/odeint_dopri5/1e-8", benchmark_peers::make_odeint_peer, 1e-8, 9, 10);
  add("peer/odeint_dopri5/1e-11", benchmark_peers::make_odeint_peer, 1e-11, 9, 10);
#endif
#ifdef GAPSCOPE_HAS_CVODE
  add("peer/cvode_bdf/1e-8", benchmark_peers::make_cvode_bdf_peer, 1e-8, 5, 1);
  add("peer/cvode_adams/1e-8", benchmark_peers::make_cvode_adams_peer, 1e-8, 5, 1);
#endif
  return true;
}();

}  // namespace
}  // namespace gapscope::benchmarks
